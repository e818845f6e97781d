#!/usr/bin/env python3
"""Speeds of flutter and divergence over the fibre angle: what turning the fibres does, and the guide shows what the
program computes. Needs AEROM, the program. Python 3 standard library."""

import os
import unittest

import build_fibre

GUIDE = build_fibre.ROOT / "docs" / "GUIDE.md"


class Fibre(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = build_fibre.speeds(os.environ["AEROM"])
        cls.divergence = dict(cls.found["divergence"])
        cls.flutter = dict(cls.found["flutter"])

    def test_every_angle_has_both(self):
        self.assertEqual(sorted(self.divergence), list(build_fibre.ANGLES))
        self.assertEqual(sorted(self.flutter), list(build_fibre.ANGLES))

    def test_a_turn_by_180_degrees_is_none(self):
        for kind in (self.divergence, self.flutter):
            self.assertAlmostEqual(kind[-90] / kind[90], 1.0, delta=1e-5)

    def test_wash_out_prevents_divergence(self):
        for angle in range(15, 75, 15):
            self.assertGreater(self.divergence[-angle], self.divergence[angle])
        self.assertIn(max(self.divergence, key=self.divergence.get), (-35, -30, -25))
        self.assertIn(min(self.divergence, key=self.divergence.get), (25, 30, 35))

    def test_uncoupled_angles_agree_with_each_other(self):
        # Without coupling only GJ counts, and fibres along and across the span have the same.
        self.assertAlmostEqual(self.divergence[0] / self.divergence[90], 1.0, delta=6e-3)

    def test_the_guide_has_these_numbers(self):
        text = GUIDE.read_text(encoding="utf-8")
        for row in list(build_fibre.table(self.found))[2:]:
            self.assertIn(row, text)


if __name__ == "__main__":
    unittest.main()
