#!/usr/bin/env python3
"""What the shipped network is to keep: it belongs to the shipped polar, rests where nothing moves, works on the
motion as the flow computations do, and marches without following its time step. Needs AEROM, the program. Python 3
standard library."""

import json
import os
import unittest

import build_network
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
