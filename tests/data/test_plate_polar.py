#!/usr/bin/env python3
"""The polar of the plate: symmetry, and its values against means taken here from the records."""

import csv
import json
import unittest
from pathlib import Path

DATA = Path(__file__).resolve().parents[2] / "data"
POLAR = json.loads((DATA / "polars" / "plate-4pct-channel.json").read_text(encoding="utf-8"))
SIGN = {"cl": -1.0, "cd": 1.0, "cm": -1.0}


def value(key, angle, plunge):
    return POLAR[key][POLAR["plunge_c"].index(plunge)][POLAR["alpha_deg"].index(angle)]


def mean_of(name, key, after):
    with open(DATA / "cfd" / "records" / (name + ".csv"), newline="", encoding="ascii") as file:
        values = [float(row[key]) for row in csv.DictReader(file) if float(row["t"]) > after + 0.01]
    return sum(values) / len(values)


class PlatePolar(unittest.TestCase):
    def test_mirror_image(self):
        for key, sign in SIGN.items():
            for plunge in POLAR["plunge_c"]:
                for angle in POLAR["alpha_deg"]:
                    self.assertAlmostEqual(value(key, -angle, -plunge),
                                           sign * value(key, angle, plunge), places=9)

    def test_nodes_are_the_means_of_their_records(self):
        for key in SIGN:
            for name, angle in (("static_a02_coarse", 2), ("static_a12_coarse", 12),
                                ("static_a20_coarse", 20)):
                with self.subTest(name=name, key=key):
                    self.assertAlmostEqual(value(key, angle, 0), mean_of(name, key, 20.0), delta=2e-5)

    def test_off_the_middle_the_difference_is_that_of_the_production_mesh(self):
        for key in SIGN:
            for off, middle, angle, plunge, sign in (
                    ("static_a10_w1", "static_a10", 10, 1, 1.0),
                    ("static_a03_w0.5", "static_a03", 3, 0.5, 1.0),
                    ("static_a-20_w1", "static_a20", -20, 1, SIGN[key])):
                with self.subTest(name=off, key=key):
                    difference = mean_of(off, key, 20.0) - sign * mean_of(middle, key, 20.0)
                    self.assertAlmostEqual(value(key, angle, plunge) - value(key, angle, 0), difference,
                                           delta=4e-5)

    def test_covers_what_it_says(self):
        self.assertEqual((POLAR["alpha_deg"][0], POLAR["alpha_deg"][-1]), (-20, 20))
        self.assertTrue(all(c > 0.0 for row in POLAR["cd"] for c in row))
        # The lift slope of the blunt edge: above that of a thin plate in this channel, 6.44 per rad.
        slope = (value("cl", 2, 0) - value("cl", 0, 0)) / 0.0349066
        self.assertGreater(slope, 9.0)
        self.assertLess(slope, 10.0)


if __name__ == "__main__":
    unittest.main()
