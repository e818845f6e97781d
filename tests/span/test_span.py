#!/usr/bin/env python3
"""Loads along the span: their sum is the mean of the run, walls and far walls order the lift, and the guide shows
what the program computes. Needs AEROM, the program. Python 3 standard library."""

import os
import unittest

import build_span

GUIDE = build_span.ROOT / "docs" / "GUIDE.md"


class Span(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = build_span.variants(os.environ["AEROM"])

    def test_loads_sum_up_to_the_means(self):
        for name, _, means, loads in self.found:
            with self.subTest(walls=name):
                element = 0.37 / len(loads["z_m"])
                self.assertAlmostEqual(element * sum(loads["lift_n_m"]), means["lift_n"], delta=1e-9)
                self.assertAlmostEqual(element * sum(loads["drag_n_m"]), means["drag_n"], delta=1e-9)
                self.assertAlmostEqual(means["lift_n"] / means["drag_n"], means["efficiency"], delta=1e-9)

    def test_every_wall_adds_lift(self):
        lift = [means["lift_n"] for _, _, means, _ in self.found]
        self.assertEqual(lift, sorted(lift, reverse=True))

    def test_walls_along_the_span(self):
        strip, far, root, free = (loads for _, _, _, loads in self.found)
        self.assertEqual(set(strip["induced_deg"]), {0})
        self.assertEqual(max(root["cl"]), root["cl"][0])  # falls from the mirror to the tip
        self.assertLess(root["cl"][-1], 0.7 * root["cl"][0])
        self.assertGreater(far["cl"][-1], root["cl"][-1])
        self.assertLess(free["cl"][0], 0.8 * max(free["cl"]))  # a tip at the root, too

    def test_the_guide_has_these_numbers(self):
        text = GUIDE.read_text(encoding="utf-8")
        for name, _, means, _ in self.found:
            row = next(line for line in text.splitlines() if line.startswith("| %s |" % name))
            shown = [float(cell) for cell in row.split("|")[2:5]]
            for value, key in zip(shown, ("cl", "cd", "efficiency")):
                self.assertAlmostEqual(value / means[key], 1.0, delta=2e-3, msg=row)


if __name__ == "__main__":
    unittest.main()
