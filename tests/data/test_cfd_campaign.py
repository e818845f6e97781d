#!/usr/bin/env python3
"""The scripts of the flow computations: motion, mesh, records and harmonics, without a solver."""

import csv
import math
import re
import sys
import tempfile
import unittest
from pathlib import Path

CFD = Path(__file__).resolve().parents[2] / "data" / "cfd"
sys.path.insert(0, str(CFD / "campaign"))

import build_harmonics  # noqa: E402
import free_case        # noqa: E402
import mesh             # noqa: E402
import motion           # noqa: E402
import record           # noqa: E402
import run              # noqa: E402
import run_free         # noqa: E402

END = 40.0
TERMS = ("5@0.125+0", "3@0.05+20 0.5@0.7+300", "4@0.03>0.2+45")


def row_of(**settings):
    row = dict(name="r", mean_deg="2", plunge_c="0.5", re="20000", mesh="production", thickness="0.04",
               edge="square", step="0.02", end="4", pitch="", plunge="", cycles_skipped="0", cycles="0")
    row.update(settings)
    return row


def table(name):
    with open(CFD / name, newline="", encoding="ascii") as file:
        return list(csv.DictReader(file))


class Motion(unittest.TestCase):
    def test_rates_are_those_of_the_position(self):
        h = 1e-4  # central differences: error of order h^2, and 1e-16 / h^2 of rounding
        for text in TERMS:
            terms = motion.parse(text)
            for t in (2.3, 3.1, 5.9, 17.0, 33.3):
                with self.subTest(text=text, t=t):
                    low, mid, high = (motion.value(terms, t + d, END) for d in (-h, 0.0, h))
                    self.assertAlmostEqual((high[0] - low[0]) / (2.0 * h), mid[1], delta=1e-5)
                    self.assertAlmostEqual((high[1] - low[1]) / (2.0 * h), mid[2], delta=1e-4)

    def test_starts_at_rest_and_ends_as_asked(self):
        for text in TERMS:
            terms = motion.parse(text)
            for t in (0.0, motion.START):
                self.assertEqual(motion.value(terms, t, END), (0.0, 0.0, 0.0))
        sine = motion.parse("5@0.125+0")
        self.assertAlmostEqual(motion.value(sine, motion.START + 8.0 + 2.0, END)[0], 5.0, places=12)

    def test_sweep_ends_at_its_last_frequency(self):
        # The fastest rate over the last period is amplitude times 2 pi f.
        terms = motion.parse("1@0.1>0.5+0")
        rates = [abs(motion.value(terms, END - 2.0 + 0.001 * i, END)[1]) for i in range(2000)]
        self.assertAlmostEqual(max(rates), 2.0 * math.pi * 0.5, delta=0.02 * math.pi)

    def test_table_of_the_solver_turns_the_other_way(self):
        rows = motion.table(motion.parse("5@0.125+0"), motion.parse("0.1@0.125+90"), 20.0).splitlines()
        found = [re.fullmatch(r"\((\S+) \(\(0 (\S+) 0\) \(0 0 (\S+)\)\)\)", line) for line in rows[2:-1]]
        self.assertEqual(int(rows[0]), len(found))
        values = {float(m.group(1)): (float(m.group(2)), float(m.group(3))) for m in found}
        w, angle = values[12.0]  # a quarter period after the start of the second cycle
        self.assertAlmostEqual(angle, -5.0, places=6)
        self.assertAlmostEqual(w, 0.0, places=6)

    def test_a_word_that_is_no_term_is_refused(self):
        with self.assertRaises(ValueError):
            motion.parse("5 deg")


class Mesh(unittest.TestCase):
    def test_expansion_fills_the_length(self):
        for length, cells, first in ((0.6, 26, 2e-3), (0.5, 20, 1.2e-2), (4.45, 10, 0.1)):
            growth = mesh.expansion(length, cells, first) ** (1.0 / (cells - 1))
            total = sum(first * growth ** i for i in range(cells))
            self.assertAlmostEqual(total, length, delta=1e-9 * length)

    def test_blocks_are_right_handed_and_fill_the_channel(self):
        for angle, plunge, thickness in ((0, 0, 0.04), (20, 1.0, 0.04), (-20, 1.0, 0.04), (12, 0, 0.01)):
            with self.subTest(angle=angle, plunge=plunge):
                text = mesh.block_mesh("production", thickness, "square", angle, plunge)
                head = text[:text.index("blocks")]
                points = [tuple(map(float, m)) for m in
                          re.findall(r"^\((\S+) (\S+) \S+\)$", head, re.M)]
                areas = []
                for corners in re.findall(r"hex \((\d+) (\d+) (\d+) (\d+) ", text):
                    p = [points[int(i)] for i in corners]
                    areas.append(0.5 * sum(p[i - 1][0] * p[i][1] - p[i][0] * p[i - 1][1]
                                           for i in range(4)))
                self.assertEqual(len(areas), 12)
                self.assertGreater(min(areas), 0.0)
                whole = (mesh.OUTLET - mesh.INLET) * 2.0 * mesh.WALL
                self.assertAlmostEqual(sum(areas), whole - thickness, places=6)

    def test_nose_up_lifts_the_leading_edge(self):
        points = mesh.corner_points(0.04, "square", 10.0, 0.0)
        self.assertLess(points["snw"][0], points["sne"][0])
        self.assertGreater(points["snw"][1], points["sne"][1])


class Record(unittest.TestCase):
    def lines(self, row, cl=0.5):
        return [(0.02 * i, cl, 0.1, 0.05) for i in range(1, round(float(row["end"]) / 0.02) + 1)]

    def test_moment_moves_with_the_section(self):
        row = row_of(plunge="0.2@0.5+90")
        samples = record.samples(row, self.lines(row))
        for values in samples:
            w = values[4] - 0.5
            self.assertAlmostEqual(values[9], 0.05 - w * 0.1, places=12)
        self.assertGreater(max(abs(values[4] - 0.5) for values in samples), 0.15)

    def test_absurd_or_missing_values_are_a_divergence(self):
        row = row_of()
        for lines in (self.lines(row, cl=1e6), self.lines(row, cl=math.nan), self.lines(row)[:-1]):
            with self.assertRaises(record.Diverged):
                record.samples(row, lines)

    def test_names_of_columns_decide(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "coefficient.dat"
            path.write_text("# text\n# Time Cd Cs Cl CmRoll CmPitch CmYaw\n0.02 1 2 3 4 5 6\n")
            self.assertEqual(record.coefficients(path), [(0.02, 3.0, 1.0, 5.0)])

    def test_committed_records_have_the_prescribed_motion(self):
        for row in table("index.csv"):
            if row["status"] != "done":
                continue
            pitch, plunge = motion.parse(row["pitch"]), motion.parse(row["plunge"])
            values = table("records/%s.csv" % row["name"])
            for line in values[::37]:
                state = motion.state(pitch, plunge, float(line["t"]), float(row["end"]))
                expected = (float(row["mean_deg"]) + state[0], state[1], state[2],
                            float(row["plunge_c"]) + state[3], state[4], state[5])
                keys = ("alpha_deg", "alpha_dot", "alpha_ddot", "w", "w_dot", "w_ddot")
                for key, value in zip(keys, expected):
                    # Half a unit of the last digit kept.
                    self.assertAlmostEqual(float(line[key]), value, delta=6e-5, msg=row["name"])


class FreeSections(unittest.TestCase):
    def test_springs_have_the_frequencies_asked_for(self):
        row = row_of(mass="50", inertia="5", f_plunge="0.1", f_pitch="0.2", zeta_plunge="0.01",
                     zeta_pitch="0.02")
        (k_w, c_w), (k_a, c_a) = free_case.springs(row)
        self.assertAlmostEqual(math.sqrt(k_w / 50.0) / (2.0 * math.pi), 0.1, places=12)
        self.assertAlmostEqual(math.sqrt(k_a / 5.0) / (2.0 * math.pi), 0.2, places=12)
        self.assertAlmostEqual(c_w / (2.0 * math.sqrt(k_w * 50.0)), 0.01, places=12)
        self.assertAlmostEqual(c_a / (2.0 * math.sqrt(k_a * 5.0)), 0.02, places=12)

    def test_motion_of_the_solver_is_turned_nose_up(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "state.dat"
            line = "%g (0 0.1 0.05) (0 0.1 0.05) (0 0 %g) (0 0.2 0) (0 0 -90)\n"
            path.write_text("# head\n" + line % (0.4, -3.0) + line % (0.41, -9.0))  # every step is written
            motion = run_free.motion_lines(path)
            angle, rate, w, w_rate = motion[20]
            self.assertEqual((angle, w, w_rate), (3.0, 0.1, 0.2))
            self.assertAlmostEqual(rate, 0.5 * math.pi, places=12)
            samples = run_free.samples(row_of(), [(t, 0.5, 0.1, 0.05) for t in (0.39, 0.4, 0.41)], motion)
            self.assertEqual([values[0] for values in samples], [0.4])
            self.assertAlmostEqual(samples[0][7], 0.05 - 0.1 * 0.1, places=12)

    def test_committed_records_obey_their_equations_of_motion(self):
        """m w'' + c w' + k w = c_l/2 and the same of the pitch, with differences of the recorded rates."""
        for row in table("free/index.csv"):
            (k_w, c_w), (k_a, c_a) = free_case.springs(row)
            lines = [{k: float(v) for k, v in line.items()}
                     for line in table("free/records/%s.csv" % row["name"])]
            for inertia, k, c, x, x_dot, load, rest, unit in (
                    (float(row["mass"]), k_w, c_w, "w", "w_dot", "cl", 0.0, 1.0),
                    (float(row["inertia"]), k_a, c_a, "alpha_deg", "alpha_dot", "cm",
                     float(row["mean_deg"]), math.pi / 180.0)):
                errors, loads = [], []
                for before, now, after in zip(lines[50:], lines[51:], lines[52:]):
                    bend = (after[x_dot] - before[x_dot]) / (after["t"] - before["t"])
                    force = inertia * bend + c * now[x_dot] + k * (now[x] - rest) * unit
                    errors.append(force - 0.5 * now[load])
                    loads.append(inertia * bend)
                rms = [math.sqrt(sum(e * e for e in some) / len(some)) for some in (errors, loads)]
                self.assertLess(rms[0], 0.02 * rms[1], (row["name"], x))


class Queue(unittest.TestCase):
    def test_every_pending_run_is_handed_out_once(self):
        with tempfile.TemporaryDirectory() as folder:
            work = Path(folder)
            (work / "done").mkdir()
            waiting = [row["name"] for row in run.pending(work, "")]
            if len(waiting) > 2:
                (work / "done" / (waiting[0] + ".json")).write_text("{}")
                queue = run.Queue(work, "", 2)
                self.assertEqual([queue.take()["name"], queue.take()["name"], queue.take()],
                                 waiting[1:3] + [None])


class Harmonics(unittest.TestCase):
    def test_known_coefficients_give_their_derivatives_and_work(self):
        # c_m = 0.1 + 2 alpha - 0.3 (alpha_dot / omega), c_l = 4 alpha; alpha = 5 deg sin.
        a, f = math.radians(5.0), 0.1
        omega = 2.0 * math.pi * f
        times = [0.08 * (i + 1) for i in range(700)]
        phases = [omega * (t - motion.START) for t in times]
        series = {"cl": [4.0 * a * math.sin(p) for p in phases], "cd": [0.05] * 700,
                  "cm": [0.1 + a * (2.0 * math.sin(p) - 0.3 * math.cos(p)) for p in phases]}
        row = row_of(interval="0.08", cycles_skipped="1", cycles="3")
        cycles = build_harmonics.cycles_of(row, series, f)
        self.assertEqual(len(cycles), 3)
        inside, outside = build_harmonics.harmonic(cycles[1]["cm"], a)
        self.assertAlmostEqual(inside, 2.0, delta=1e-4)
        self.assertAlmostEqual(outside, -0.3, delta=1e-4)
        pitch, plunge = build_harmonics.works(cycles[1], (a, f, None, 0.0), None, f)
        self.assertAlmostEqual(pitch, -0.3 * math.pi * a * a, delta=1e-6)
        self.assertEqual(plunge, 0.0)
        self.assertLess(build_harmonics.spread(cycles, cycles[1], "cm"), 1e-4)


if __name__ == "__main__":
    unittest.main()
