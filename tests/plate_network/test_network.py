#!/usr/bin/env python3
"""What the shipped network is to keep: it belongs to the shipped polar, rests where nothing moves, works on the
motion as the flow computations do, and marches without following its time step. Needs AEROM, the program. Python 3
standard library."""

import json
import os
import unittest

import build_network
import plunging
import ask

AEROM = os.environ["AEROM"]


class Network(unittest.TestCase):
    def march(self, angle, speed, step):
        return build_network.march(AEROM, angle, speed, step, build_network.SHIPPED)

    def test_it_adds_to_the_shipped_polar(self):
        document = json.loads(build_network.NETWORK.read_text(encoding="utf-8"))
        identity = self.march(-45, 5.0, 1e-3)["identity"]
        self.assertEqual(document["polar_hash"], identity["polar"]["hash"])
        self.assertIs(identity["network_forced"], False)

    def test_it_rests_where_nothing_moves(self):
        """In c_l by less than the meshes differ of which the polar and the records are made."""
        worst = build_network.rest_error(AEROM)
        self.assertLess(worst["cl"], build_network.mesh_difference(build_network.KNEE_DEG)["cl"])
        self.assertLess(worst["cm"], 0.02)

    def test_works_have_the_sign_of_the_computations(self):
        for name, mean, amplitude, frequency, sign in (("attached", 2.5, 5, 0.125, -1.0),
                                                       ("through stall", 8, 6, 0.06, 1.0),
                                                       ("fast", 5, 7, 0.25, -1.0)):
            with self.subTest(name=name):
                text = ask.run(AEROM, "loop", "--dynamic", "network", "--network", "plate-4pct", "--mean-deg", mean,
                               "--amplitude-deg", amplitude, "--frequency", frequency, "--cycles", 6)
                self.assertGreater(sign * float(text.splitlines()[-1].split()[2]), 0.0)

    def test_small_plunging_meets_the_shedding(self):
        """Fed below its frequency, damped more than twice as in theory at it, damped by less beyond: as in the flow
        computations, on whose mesh and step the work hangs by up to 0.8 of that of theory."""
        rows = {row["name"]: row for row in ask.rows(build_network.CFD / "harmonics.csv")}
        for name, least, most in (("plunge_m4.5_w0.0039_f0.43", -1.5, -0.3), ("plunge_m5.5_w0.0027_f0.49", -2.5, -0.5),
                                  ("plunge_m4.5_w0.005_f0.59", 2.0, 4.0), ("plunge_m5.5_w0.0032_f0.68", 2.5, 4.5),
                                  ("plunge_m5_w0.007_f0.98", 0.2, 1.2)):
            with self.subTest(name=name):
                row = rows[name]
                theory, network = (plunging.work(AEROM, dynamic, row["mean_deg"], float(row["plunge_c"]),
                                                 float(row["frequency"]))
                                   for dynamic in (plunging.THEORY, build_network.SHIPPED_OPTIONS))
                for work in (float(row["work"]), network):
                    self.assertTrue(least < work / theory < most, (work / theory, least, most))

    def test_marches_stay_in_the_hull_and_do_not_follow_their_step(self):
        for angle, speed in ((-45, 3.0), (-45, 7.0), (45, 6.0)):
            with self.subTest(angle=angle, speed=speed):
                runs = [self.march(angle, speed, step) for step in build_network.STEPS]
                self.assertEqual(*(r["verdict"] for r in runs))
                for r in runs:
                    steps = r["timing"]["steps"]
                    self.assertLess(r["counters"]["outside_hull"], 0.01 * 16 * steps)
                    self.assertLess(r["counters"]["load_alternations"], 0.05 * steps)


if __name__ == "__main__":
    unittest.main()
