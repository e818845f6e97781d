#!/usr/bin/env python3
"""What docs/FREE.md is to show: which models see the flutter of the section on springs, and how near they come
to the flow computations. Needs AEROM, the program. Python 3 standard library."""

import math
import os
import tempfile
import unittest

import build_free
import build_loops


class Turning(unittest.TestCase):
    def test_growing_swing_gives_its_frequency_and_growth(self):
        times = [0.2 * i for i in range(500)]
        values = [4.0 + math.exp(0.013 * t) * math.sin(2.0 * math.pi * 0.11 * t) for t in times]
        found = build_free.summary(times, values)
        self.assertAlmostEqual(found["frequency"], 0.11, delta=1e-4)
        self.assertAlmostEqual(found["growth"], 0.013, delta=1e-4)
        self.assertAlmostEqual(found["end_growth"], 0.013, delta=1e-4)

    def test_what_does_not_swing_has_no_summary(self):
        self.assertIsNone(build_free.summary([0.2 * i for i in range(300)], [1.0] * 300)["growth"])

    def test_limit_cycle_is_told_from_growth(self):
        times = [0.2 * i for i in range(1000)]
        swing = [math.sin(0.7 * t) for t in times]
        self.assertEqual(build_free.limit_cycle(build_free.summary(times, [5.0 * s for s in swing])), "5.0 deg")
        growing = [5.0 * math.exp(0.01 * (t - 200.0)) * s for t, s in zip(times, swing)]
        self.assertIn("growth +0.0100", build_free.limit_cycle(build_free.summary(times, growing)))


class Flutter(unittest.TestCase):
    """Small pushes only: the growth of the first swings."""

    @classmethod
    def setUpClass(cls):
        aerom, cls.items = os.environ["AEROM"], []
        with tempfile.TemporaryDirectory() as folder:
            own, _ = build_loops.own_slope(folder)
            for row in build_free.index_rows():
                if not (build_free.standard(row) and build_free.is_push(row)):
                    continue
                series = build_free.record_of(row)
                item = {"row": row, "cfd": build_free.summary(series["t"], series["alpha_deg"])}
                for key, options, _, _ in build_free.MODELS:
                    polar = own if key == "own" else build_loops.POLAR
                    model, _ = build_free.march(aerom, options, polar, row)
                    item[key] = build_free.summary(model["t"], model["alpha_deg"])
                cls.items.append(item)

    def test_flow_computation_flutters_between_its_cases(self):
        self.assertGreaterEqual(len(self.items), 4)
        signs = {item["cfd"]["growth"] > 0.0 for item in self.items}
        self.assertEqual(signs, {False, True})

    def test_models_without_stall_see_none_of_it(self):
        for item in self.items:
            self.assertLess(item["none"]["growth"], 0.0)
            self.assertLess(item["attached"]["growth"], 0.0)

    def test_stall_models_come_near(self):
        for item in self.items:
            for key, rate in (("stall", 0.02), ("own", 0.006)):
                with self.subTest(row=item["row"]["name"], key=key):
                    self.assertAlmostEqual(item[key]["frequency"], item["cfd"]["frequency"],
                                           delta=0.03 * item["cfd"]["frequency"])
                    self.assertAlmostEqual(item[key]["growth"], item["cfd"]["growth"], delta=rate)
            self.assertGreater(item["own"]["growth"] * item["cfd"]["growth"], 0.0)

    def test_networks_meet_onset_and_limit_cycles(self):
        """Onset within 10 %, limit cycles within 20 % of the flow computation."""
        aerom, rows = os.environ["AEROM"], {row["name"]: row for row in build_free.index_rows()}
        cfd = build_free.cfd_onset(self.items)
        for key, options, _, _ in build_free.MODELS:
            if key not in build_free.NETWORKS:
                continue
            onset = build_free.model_onset(aerom, options, build_loops.POLAR, self.items[0]["row"])
            self.assertAlmostEqual(onset, cfd, delta=0.1 * cfd)
            for name in ("free_f0.130_large", "free_f0.120"):
                series = build_free.record_of(rows[name])
                size = build_free.summary(series["t"], series["alpha_deg"])["end"]
                model, _ = build_free.march(aerom, options, build_loops.POLAR, rows[name], duration="600")
                found = build_free.summary(model["t"], model["alpha_deg"])["end"]
                self.assertAlmostEqual(found, size, delta=0.2 * size, msg=name)


if __name__ == "__main__":
    unittest.main()
