#!/usr/bin/env python3
"""What docs/LOOPS.md is to show: dynamic stall is nearer to the flow computations than the models without
it, and its work has their sign. Needs AEROM, the program. Python 3 standard library."""

import os
import statistics
import unittest

import build_loops


class Loops(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.items = [build_loops.compare(os.environ["AEROM"], row, build_loops.POLAR)
                     for row in build_loops.sine_rows()]

    def median(self, key, coefficient):
        return statistics.median(i[key]["misfit"][coefficient] for i in self.items)

    def test_there_are_records(self):
        self.assertGreaterEqual(len(self.items), 3)

    def test_work_of_pitch_has_the_sign_of_the_computation(self):
        """In four of five decided loops, the slow one through stall among them."""
        uncertain, _ = build_loops.work_uncertainties()
        decided = [i for i in self.items
                   if not i["plunge"] and abs(i["work"]) > uncertain[i["row"]["name"]]]
        right = [i["row"]["name"] for i in decided if i["stall"]["work"] * i["work"] > 0.0]
        self.assertGreaterEqual(len(right), 0.8 * len(decided))
        self.assertIn("pitch_m8_a6_f0.06", right)

    def test_dynamic_stall_is_nearest(self):
        for coefficient in ("cl", "cm"):
            for other in ("none", "attached"):
                with self.subTest(coefficient=coefficient, other=other):
                    self.assertLess(self.median("stall", coefficient),
                                    self.median(other, coefficient))

    def test_cycle_of_the_model_lies_at_the_phases_of_the_record(self):
        """Attached thin-aerofoil pitch turned by a phase is the same loop, begun elsewhere."""
        row = {"mean_deg": "0"}
        polar = build_loops.ROOT / "data" / "polars" / "flat-plate-linear.json"
        options = ("--dynamic", "attached")
        quarter = 0.5 * build_loops.math.pi
        plain = build_loops.model_cycle(os.environ["AEROM"], options, polar, row, (2.0, 0.1, 0.0), None)
        ahead = build_loops.model_cycle(os.environ["AEROM"], options, polar, row, (2.0, 0.1, quarter),
                                        None)
        n = build_loops.POINTS // 4
        self.assertEqual(plain["cl"][n:] + plain["cl"][:n], ahead["cl"])


if __name__ == "__main__":
    unittest.main()
