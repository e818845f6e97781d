#!/usr/bin/env python3
"""aerom as a user sees it: standard output, stderr, exit code.

Needs AEROM, the program; the class Daemon also AEROMD, the daemon. Python 3 standard library."""

import csv
import http.server
import json
import math
import os
import re
import socket
import subprocess
import tempfile
import threading
import time
import unittest
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "data" / "cases"
AEROM = os.environ["AEROM"]
POUND, INCH = 4.4482216152605, 0.0254


def aerom(*arguments, text=None, url=None):
    environment = dict(os.environ)
    environment.pop("AEROM_URL", None)
    if url:
        environment["AEROM_URL"] = url
    return subprocess.run([AEROM, *map(str, arguments)], input=text, capture_output=True, text=True,
                          env=environment, timeout=250, check=False)


def short_case(**solver):
    """The paper's case, cut to 0.2 s so that it is quick under a sanitizer."""
    case = json.loads((CASES / "paper-beam.json").read_text(encoding="utf-8"))
    case["solver"].update({"duration_s": 0.2}, **solver)
    return case


class Arguments(unittest.TestCase):
    def test_version_names_the_core(self):
        result = aerom("--version")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stdout, r"^aerom \d+\.\d+\.\d+ \(core \d+\.\d+\.\d+\+[0-9a-f]{8}\)\n$")

    def test_help_names_every_command(self):
        result = aerom("help")
        self.assertEqual(result.returncode, 0)
        for command in ("run", "loop", "free", "train", "submit", "wait", "get", "show", "cancel", "list"):
            self.assertIn("aerom %s " % command, result.stdout)

    def test_wrong_arguments_end_with_2_and_the_usage(self):
        for arguments in ([], ["nothing"], ["run"], ["run", "a", "b"], ["run", "--wait", "a"],
                          ["run", "--unknown", "a"], ["get"], ["get", "1", "secrets"],
                          ["wait", "1", "--timeout", "soon"], ["list", "--state", "a b"]):
            with self.subTest(arguments=arguments):
                result = aerom(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stdout, "")
                self.assertIn("aerom", result.stderr)


class Train(unittest.TestCase):
    """A folder of records to a network that other commands take."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "records").mkdir()
        names = ["s%d" % i for i in range(4)]
        index = ["name,block,status,pitch,plunge,cycles_skipped"]
        for i, name in enumerate(names):
            self.write_record(name, 0.1 + 0.05 * i)
            index.append("%s,sine_pitch_slow,done,4@%g+0,,1" % (name, 0.1 + 0.05 * i))
        index += ["later,sine_pitch_slow,failed,4@0.1+0,,1", "rest,static,done,,,0"]
        (self.folder / "index.csv").write_text("\n".join(index) + "\n", encoding="ascii")
        self.output = self.folder / "net.json"

    def write_record(self, name, frequency, scale=1.0):
        """Quasi-steady lift of four degrees and what follows the rate of the angle."""
        lines = ["t,alpha_deg,alpha_dot,alpha_ddot,w,w_dot,w_ddot,cl,cd,cm"]
        omega, size = 2.0 * math.pi * frequency, math.radians(4.0)
        for i in range(600):
            t = 0.08 * (i + 1)
            x = t * omega
            angle, rate = size * math.sin(x), size * omega * math.cos(x)
            values = [t, math.degrees(angle) * scale, rate, -omega * omega * angle, 0, 0, 0,
                      6.0 * angle + rate, 0.05, 0.5 * angle - 0.3 * rate]
            lines.append(",".join("%.6g" % v for v in values))
        (self.folder / "records" / (name + ".csv")).write_text("\n".join(lines) + "\n",
                                                               encoding="ascii")

    def train(self, *arguments):
        return aerom("train", self.folder, "--output", self.output, "--hidden", 3,
                     "--polar", "flat-plate-linear", "--inputs", "delta_alpha,alpha_rate", *arguments)

    def test_a_network_is_trained_the_same_twice_and_reproduces_its_records(self):
        first = self.train("--name", "first", "--description", "a test")
        self.assertEqual(first.returncode, 0, first.stderr)
        written = self.output.read_bytes()
        again = self.train("--name", "first", "--description", "a test")
        self.assertEqual((again.stdout, self.output.read_bytes()), (first.stdout, written))
        document = json.loads(written)
        self.assertEqual(document["name"], "first")
        self.assertEqual(document["inputs"], ["delta_alpha", "alpha_rate"])
        note = document["provenance"]
        self.assertEqual(note["polar"], "flat-plate-linear")
        self.assertRegex(note["polar_hash"], "^[0-9a-f]{64}$")
        self.assertEqual(sorted(note["records_trained"] + note["records_held"]),
                         ["s0", "s1", "s2", "s3"])
        self.assertEqual(len(note["records_held"]), 1)
        curve, table = first.stdout.split("# kept")
        errors = [float(line.split(",")[1]) for line in curve.splitlines()[1:]]
        self.assertLess(errors[-1], 0.01 * errors[0])
        rows = list(csv.DictReader(table.splitlines()[1:]))
        self.assertEqual([row["record"] for row in rows], ["s0", "s1", "s2", "s3"])
        for row in rows:
            self.assertLess(float(row["cl_rms"]), 0.05 * float(row["cl_range"]))
            self.assertLess(abs(float(row["energy_error"])), 0.05)
        loop = aerom("loop", "--polar", "flat-plate-linear", "--dynamic", "network", "--network",
                     self.output, "--amplitude-deg", 4, "--frequency", 0.15, "--cycles", 2)
        self.assertEqual(loop.returncode, 0, loop.stderr)
        work = float(loop.stdout.splitlines()[-1].split()[2])
        # c_m = -0.3 alpha_dot: pi times amplitude squared times omega.
        exact = -0.3 * math.pi * math.radians(4.0) ** 2 * 2.0 * math.pi * 0.15
        self.assertLess(abs(work / exact - 1.0), 0.05)

    def test_lags_a_base_members_and_folds(self):
        arguments = ("--base", "attached", "--lags", "0.5,2", "--oscillators", "0.7:0.2",
                     "--inputs", "alpha_lag_1,alpha_oscillator_rate_1", "--members", 2, "--folds", 2, "--samples", 50, "--epochs", 20)
        result = self.train(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(self.output.read_text())
        self.assertEqual((document["base"], document["lags_c_v"], document["hidden"]),
                         ("attached", [0.5, 2], 6))
        self.assertEqual(document["oscillators"], [{"f_c_v": 0.7, "damping": 0.2}])
        self.assertEqual(document["polar_hash"], document["provenance"]["polar_hash"])
        self.assertEqual(len(document["provenance"]["members"]), 2)
        self.assertIn("# member 2 of 2", result.stdout)
        rows = list(csv.DictReader(result.stdout[result.stdout.index("record,part"):].splitlines()))
        self.assertEqual([row["record"] for row in rows if row["part"] == "fold"],
                         ["s0", "s1", "s2", "s3"])
        motion = aerom("loop", "--polar", "flat-plate-linear", "--dynamic", "network", "--network",
                       self.output, "--motion", self.folder / "records" / "s1.csv")
        self.assertEqual(motion.returncode, 0, motion.stderr)
        other = ("loop", "--dynamic", "network", "--network", self.output, "--frequency", 0.1,
                 "--cycles", 1)
        refused = aerom(*other)
        self.assertEqual((refused.returncode, refused.stdout), (1, ""))
        self.assertIn("another polar", refused.stderr)
        self.assertEqual(aerom(*other, "--force").returncode, 0)

    def test_a_symmetric_network_is_made_of_pairs(self):
        result = self.train("--symmetric", "--hidden", 4, "--balance", 0.2, "--tolerance", 0.1, "--epochs", 10)
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(self.output.read_text())
        self.assertEqual((document["hidden"], document["b2"]), (4, [0, 0]))
        self.assertEqual(document["w1"][0::2], document["w1"][1::2])
        self.assertEqual(document["b1"][0::2], [-b for b in document["b1"][1::2]])
        self.assertEqual(document["input_offset"], [0] * 4)
        self.assertEqual(document["hull_min"], [-h for h in document["hull_max"]])
        self.assertEqual([document["provenance"][key] for key in ("symmetric", "balance", "tolerance")],
                         [True, 0.2, 0.1])

    def test_adam_and_another_seed_make_another_network(self):
        texts = set()
        for arguments in (("--seed", 1), ("--seed", 2), ("--optimiser", "adam")):
            result = self.train("--epochs", 3, *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            texts.add(json.dumps(json.loads(self.output.read_text())["w1"]))
        self.assertEqual(len(texts), 3)

    def test_what_is_wrong_is_named(self):
        for arguments, word in ((("--optimiser", "newton"), "--optimiser"),
                                (("--epochs", 0), "--epochs"), (("--decay", -1), "--decay"),
                                (("--seed", 0.5), "--seed"), (("--polar", "none"), "--polar"),
                                (("--inputs", "alpha_dot"), "--inputs"),
                                (("--inputs", "alpha_lag_1"), "/inputs/0"),
                                (("--inputs", "alpha,stall_lost"), "/inputs/1"),
                                (("--base", "wake"), "--base"), (("--lags", "1,x"), "--lags"),
                                (("--lags", "1,2,3,4,5"), "--lags"), (("--lags", 0), "/lags_c_v/0"),
                                (("--oscillators", "0.7"), "--oscillators"),
                                (("--oscillators", "1:0.5,1:0.5,1:0.5"), "--oscillators"),
                                (("--oscillators", "1:1"), "/oscillators/0/damping"),
                                (("--members", 0), "--members"), (("--folds", 1), "--folds"),
                                (("--samples", 0), "--samples"), (("--anchors", -1), "--anchors"),
                                (("--balance", 2), "--balance"), (("--tolerance", -1), "--tolerance"),
                                (("--symmetric", "--hidden", 5), "/hidden"),
                                (("--inputs", "alpha_rate,alpha_rate"), "--inputs"),
                                (("--inputs", "plunge_rate"), "plunge_rate")):
            with self.subTest(arguments=arguments):
                result = self.train(*arguments)
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn(word, result.stderr)
        self.assertFalse(self.output.exists())

    def test_faults_of_the_records_are_named(self):
        self.write_record("s2", 0.2, scale=180.0 / math.pi)
        result = self.train()
        self.assertEqual(result.returncode, 1)
        self.assertIn("/s2/alpha_deg", result.stderr)
        (self.folder / "records" / "s2.csv").write_text("t,cl\n1,2\n", encoding="ascii")
        self.assertIn("no column 'alpha_deg'", self.train().stderr)
        (self.folder / "records" / "s2.csv").unlink()
        self.assertIn("s2.csv", self.train().stderr)
        (self.folder / "index.csv").write_text("name\ns0\n", encoding="ascii")
        self.assertIn("too few records", self.train().stderr)
        (self.folder / "index.csv").write_text("title\ns0\n", encoding="ascii")
        self.assertIn("no column 'name'", self.train().stderr)
        (self.folder / "index.csv").write_text("name\n../s0\n", encoding="ascii")
        self.assertIn("no name of a record", self.train().stderr)


class Free(unittest.TestCase):
    """A plate on springs past its knee: stall flutter in pitch, which attached flow does not know."""

    SECTION = ("mass=50", "inertia=5", "plunge_frequency=0.084", "pitch_frequency=0.105", "plunge_damping=0.05",
               "pitch_damping=0.05", "rest_deg=4", "pitch_rate_deg=1", "duration=300")

    def free(self, dynamic):
        result = aerom("free", *self.SECTION, "--dynamic", dynamic)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertRegex(lines[-1], r"^# stop duration outside_polar \d+ outside_hull 0$")
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines[:-1])]

    def test_limit_cycle_and_decay(self):
        for dynamic, low, high in (("dynamic_stall", 5.0, 15.0), ("attached", 0.0, 0.01)):
            rows = self.free(dynamic)
            self.assertEqual(rows[0]["alpha_deg"], 4.0)
            last = [row["alpha_deg"] for row in rows[-1000:]]
            self.assertTrue(low <= 0.5 * (max(last) - min(last)) <= high, (dynamic, max(last), min(last)))

    def test_what_is_no_field_or_out_of_range_is_named(self):
        for words, text in ((("mass=50", "weight=3"), "'weight=3'"), (("mass=heavy",), "'heavy' is no number"),
                            (("mass=-1", "plunge_frequency=0.1", "pitch_frequency=0.1"), "mass"),
                            (("step=0.1",), "plunge_frequency")):
            result = aerom("free", *words)
            self.assertEqual(result.returncode, 1)
            self.assertIn(text, result.stderr)
        self.assertEqual(aerom("free").returncode, 2)


class Loop(unittest.TestCase):
    """The flow works on the motion of the plate: through stall it feeds slow pitch, it damps fast."""

    def loop(self, *arguments):
        result = aerom("loop", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertRegex(lines[-1], r"^# work \S+ pitch \S+ plunge \S+ outside_polar \d+ outside_hull \d+$")
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(lines[:-1])]
        return rows, float(lines[-1].split()[2])

    def test_work_of_the_loop_is_the_integral(self):
        rows, work = self.loop("--polar", "flat-plate-linear", "--dynamic", "attached",
                               "--amplitude-deg", 2, "--frequency", 0.125, "--cycles", 20)
        self.assertEqual(len(rows), 20 * 400 + 1)
        last = rows[-401:]
        area = sum(0.5 * (a["cm"] + b["cm"]) * math.radians(b["alpha_deg"] - a["alpha_deg"])
                   for a, b in zip(last, last[1:]))
        self.assertAlmostEqual(work, area, delta=1e-3 * abs(work))
        # Theodorsen, k = pi f: work = pi amplitude^2 Im(c_m) = -0.3758 pi amplitude^2.
        self.assertAlmostEqual(work, -0.3758 * math.pi * math.radians(2) ** 2, delta=0.01 * abs(work))

    def test_columns_and_the_short_name_of_a_network(self):
        motion = ("--polar", "plate-4pct-channel", "--mean-deg", 2.5, "--amplitude-deg", 5, "--frequency", 0.125,
                  "--cycles", 3)
        short = aerom("loop", "--dynamic", "network:plate-4pct", *motion)
        self.assertEqual(short.returncode, 0, short.stderr)
        self.assertEqual(short.stdout.splitlines()[0], "t,alpha_deg,cl,cd,cm")
        self.assertEqual(short.stdout, aerom("loop", "--dynamic", "network", "--network", "plate-4pct", *motion).stdout)
        plunging = aerom("loop", "--dynamic", "network:plate-4pct", *motion, "--plunge", 0.1)
        self.assertEqual(plunging.stdout.splitlines()[0], "t,alpha_deg,cl,cd,cm,w")
        for wrong in (("network:nobody",), ("network:",), ("network:plate-4pct", "--network", "plate-4pct")):
            with self.subTest(wrong=wrong):
                refused = aerom("loop", "--dynamic", *wrong, *motion)
                self.assertEqual((refused.returncode, refused.stdout), (1, ""))
                self.assertRegex(refused.stderr, "^aerom: --(dynamic|network): ")

    def test_text_of_a_case(self):
        text = aerom("run", CASES / "plate-loop.json", "--text").stdout
        self.assertRegex(text, r"work fed into the motion.*\n  pitch +0\.01\d+")

    def test_energy_through_stall(self):
        _, slow = self.loop("--dynamic", "dynamic_stall", "--mean-deg", 8, "--amplitude-deg", 6,
                            "--frequency", 0.06)
        _, fast = self.loop("--dynamic", "dynamic_stall", "--mean-deg", 5, "--amplitude-deg", 7,
                            "--frequency", 0.25)
        self.assertGreater(slow, 0.005)
        self.assertLess(fast, -0.005)

    def test_polar_of_a_file(self):
        polar = json.loads((ROOT / "data" / "polars" / "plate-4pct-channel.json").read_text())
        polar["dynamic_stall"] = {"lift_slope_per_rad": 9.5}
        motion = ("--dynamic", "dynamic_stall", "--amplitude-deg", 3, "--frequency", 0.1)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "own.json"
            path.write_text(json.dumps(polar), encoding="utf-8")
            rows, _ = self.loop("--polar", path, *motion)
            shipped, _ = self.loop(*motion)
            self.assertNotEqual(rows[-1], shipped[-1])
            path.write_text("{", encoding="utf-8")
            self.assertEqual(aerom("loop", "--polar", path, *motion).returncode, 1)
            polar["dynamic_stall"] = {"vortex_lag": -1}
            path.write_text(json.dumps(polar), encoding="utf-8")
            result = aerom("loop", "--polar", path, *motion)
            self.assertEqual(result.returncode, 1)
            self.assertIn("/dynamic_stall/vortex_lag", result.stderr)

    def test_network_of_a_file(self):
        """A network whose only neuron stays in the linear range: c_l + 0.5 of the rate of the angle."""
        network = {"name": "rate", "activation": "tanh", "inputs": ["alpha_rate"], "outputs": ["cl"],
                   "hidden": 1, "input_offset": [0], "input_scale": [1], "output_offset": [0],
                   "output_scale": [1], "hull_min": [-1], "hull_max": [1], "w1": [[1e-4]], "b1": [0],
                   "w2": [[5e3]], "b2": [0]}
        motion = ("--polar", "flat-plate-linear", "--amplitude-deg", 4, "--frequency", 0.1,
                  "--cycles", 1)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "net.json"
            path.write_text(json.dumps(network), encoding="utf-8")
            rows, _ = self.loop("--dynamic", "network", "--network", path, *motion)
            path.write_text(json.dumps({**network, "b1": [0, 0]}), encoding="utf-8")
            result = aerom("loop", "--dynamic", "network", "--network", path, *motion)
            self.assertEqual(result.returncode, 1)
            self.assertIn("/b1", result.stderr)
        plain, _ = self.loop(*motion)
        omega = 2 * math.pi * 0.1
        for with_net, without in zip(rows, plain):
            rate = math.radians(4) * omega * math.cos(omega * without["t"])
            self.assertAlmostEqual(with_net["cl"] - without["cl"], 0.5 * rate, delta=2e-6)

    def test_motion_of_a_table(self):
        """The sine of one cycle as a table, with a column more and the times of its own."""
        omega, amplitude = 2 * math.pi * 0.1, math.radians(3)
        lines = ["t,cl,alpha_deg,alpha_dot,alpha_ddot"]
        for i in range(401):
            x = omega * i / 40
            lines.append("%.4f,0,%.9f,%.9f,%.9f" % (
                5 + i / 40, 3 * math.sin(x), amplitude * omega * math.cos(x),
                -amplitude * omega ** 2 * math.sin(x)))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "motion.csv"
            path.write_text("\n".join(lines) + "\n", encoding="ascii")
            rows, _ = self.loop("--dynamic", "dynamic_stall", "--motion", path)
            sine, _ = self.loop("--dynamic", "dynamic_stall", "--amplitude-deg", 3, "--frequency", 0.1,
                                "--cycles", 1)
            self.assertEqual((len(rows), rows[0]["t"]), (401, 5))
            for a, b in zip(rows, sine):
                self.assertAlmostEqual(a["cl"], b["cl"], delta=2e-6)
                self.assertAlmostEqual(a["cm"], b["cm"], delta=2e-6)
            for change, word in ((("alpha_ddot", "other"), "alpha_ddot"), (("5.0500", "5.0510"), "equal"),
                                 (("5.0500,0", "5.0500,x"), "line 4"), (("5.0500,0,", "5.0500,"), "line 4")):
                path.write_text("\n".join(lines).replace(*change), encoding="ascii")
                result = aerom("loop", "--motion", path)
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn(word, result.stderr)
            path.write_text(lines[0] + "\n", encoding="ascii")
            self.assertIn("2..1000000", aerom("loop", "--motion", path).stderr)

    def run_case(self, case, folder):
        """Summary and series of a case of kind loop."""
        path = Path(folder) / "series.csv"
        result = aerom("run", "-", "--series", path, text=json.dumps(
            {"schema_version": 1, "kind": "loop", **case}))
        self.assertEqual(result.returncode, 0, result.stderr)
        with path.open(encoding="ascii") as file:
            return json.loads(result.stdout), list(csv.DictReader(file))

    def test_case_gives_the_same_numbers(self):
        """`aerom run` of a case of kind loop and `aerom loop`, for a sine and a table."""
        sine = {"type": "sine", "mean_deg": 8, "amplitude_deg": 6, "plunge_c": 0.2, "phase_deg": 30,
                "frequency_c_v": 0.06, "cycles": 2, "steps": 200}
        options = ("--mean-deg", 8, "--amplitude-deg", 6, "--plunge", 0.2, "--phase-deg", 30,
                   "--frequency", 0.06, "--cycles", 2, "--steps", 200)
        omega, amplitude = 2 * math.pi * 0.1, math.radians(3)
        x = [omega * i / 40 for i in range(401)]
        table = {"alpha_deg": [3 * math.sin(v) for v in x],
                 "alpha_dot": [amplitude * omega * math.cos(v) for v in x],
                 "alpha_ddot": [-amplitude * omega ** 2 * math.sin(v) for v in x],
                 "w": [0.1 * math.sin(v) for v in x], "w_dot": [0.1 * omega * math.cos(v) for v in x],
                 "w_ddot": [-0.1 * omega ** 2 * math.sin(v) for v in x]}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "motion.csv"
            with path.open("w", encoding="ascii", newline="") as file:
                rows = csv.writer(file)
                rows.writerow(["t", *table])
                rows.writerows([i / 40, *(repr(v[i]) for v in table.values())] for i in range(401))
            for motion, arguments in ((sine, options),
                                      ({"type": "table", "step_c_v": 0.025, **table}, ("--motion", path))):
                with self.subTest(motion=motion["type"]):
                    loop, work = self.loop("--dynamic", "dynamic_stall", *arguments)
                    summary, series = self.run_case(
                        {"aerodynamics": {"polar": "plate-4pct-channel",
                                          "dynamic": {"type": "dynamic_stall"}}, "motion": motion}, folder)
                    self.assertAlmostEqual(summary["work"]["total"], work, delta=1e-8)
                    self.assertEqual(len(series), len(loop))
                    for a, b in zip(series, loop):
                        self.assertAlmostEqual(float(a["time_s"]), b["t"], delta=1e-4)
                        for name in ("alpha_deg", "w", "cl", "cd", "cm"):
                            self.assertAlmostEqual(float(a[name]), b[name], delta=2e-6)

    def test_bad_case(self):
        sine = {"type": "sine", "frequency_c_v": 0.1}
        table = {"type": "table", "step_c_v": 0.1, "alpha_deg": [0, 0, 0], "alpha_dot": [0, 0, 0],
                 "alpha_ddot": [0, 0, 0]}
        for motion, pointer in (
                (None, "/motion"), ({"type": "sine"}, "/motion/frequency_c_v"),
                ({**sine, "frequency_c_v": 0}, "/motion/frequency_c_v"),
                ({**sine, "cycles": 1000, "steps": 1000}, "/motion/steps"),
                ({**sine, "type": "walk"}, "/motion/type"), ({**sine, "w": [0, 0]}, "/motion/w"),
                ({**table, "alpha_dot": [0, 0]}, "/motion/alpha_dot"),
                ({**table, "w": [0, 0, 0]}, "/motion/w_dot"),
                ({**table, "w_dot": [0, 0, 0], "w_ddot": [0, 0, 0]}, "/motion/w"),
                ({**table, "step_c_v": 0}, "/motion/step_c_v"),
                ({k: [0] if k != "type" and k != "step_c_v" else v for k, v in table.items()},
                 "/motion/alpha_deg")):
            with self.subTest(pointer=pointer):
                case = {"schema_version": 1, "kind": "loop",
                        "aerodynamics": {"polar": "plate-4pct-channel"}}
                result = aerom("run", "-", text=json.dumps(case if motion is None else
                                                           {**case, "motion": motion}))
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn("  %s: " % pointer, result.stderr)

    def test_bad_motion(self):
        for arguments, code, word in (
                ((), 2, "usage"), (("--frequency", "fast"), 2, "fast"),
                (("--motion", "a.csv", "--frequency", 1), 2, "usage"),
                (("--motion", "a.csv", "--mean-deg", 1), 2, "usage"),
                (("--frequency", 0), 1, "--frequency"), (("--frequency", 0.1, "--cycles", 1.5), 1,
                                                         "--cycles"),
                (("--frequency", 0.1, "--polar", "none"), 1, "--polar"),
                (("--frequency", 0.1, "--dynamic", "stalled"), 1, "--dynamic"),
                (("--frequency", 0.1, "--dynamic", "network"), 1, "--network"),
                (("--frequency", 0.1, "--dynamic", "network", "--network", "n"), 1, "'n'"),
                (("--frequency", 0.1, "--amplitude-deg", -1), 1, "--amplitude-deg")):
            with self.subTest(arguments=arguments):
                result = aerom("loop", *arguments)
                self.assertEqual((result.returncode, result.stdout), (code, ""))
                self.assertIn(word, result.stderr)


class Run(unittest.TestCase):
    def test_summary_of_every_example(self):
        for path in sorted(CASES.glob("*.json")):
            with self.subTest(case=path.name):
                result = aerom("run", path)
                self.assertEqual(result.returncode, 0, result.stderr)
                summary = json.loads(result.stdout)
                self.assertEqual(len(summary["identity"]["content_hash"]), 64)
                kind = json.loads(path.read_text(encoding="utf-8"))["kind"]
                wanted = {"simulation": {"verdict", "verdict_reason", "e_star", "reynolds", "modes",
                                         "means", "damping", "modal_contribution", "counters",
                                         "timing", "identity"},
                          "modes": {"modes", "section"},
                          "section": {"section", "stiffness", "stiffness_condensed", "mass"},
                          "static": {"tip", "reactions", "first_ply_failure", "section"},
                          "stability": {"verdict", "divergence", "flutter", "least_damped", "section"},
                          "loop": {"work", "outside_polar", "outside_hull", "cl", "cm", "cd"}}[kind]
                self.assertEqual(wanted - set(summary), set())

    def test_standard_input_gives_the_same_answer(self):
        text = (CASES / "aluminium-modes.json").read_text(encoding="utf-8")
        by_name, by_input = aerom("run", CASES / "aluminium-modes.json"), aerom("run", "-", text=text)
        self.assertEqual(by_input.returncode, 0, by_input.stderr)
        self.assertEqual(json.loads(by_name.stdout)["modes"], json.loads(by_input.stdout)["modes"])

    def test_other_document(self):
        result = aerom("run", CASES / "aluminium-modes.json", "--document", "section")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([len(row) for row in json.loads(result.stdout)["stiffness"]], [7] * 7)
        result = aerom("run", CASES / "aluminium-modes.json", "--document", "damping")
        self.assertEqual((result.returncode, result.stdout), (1, ""))

    def test_composite_box_against_nabsa(self):
        """Box [15]6 CAS: NABSA's stiffness (0.537 in deep), in pounds and inches, within 5 %."""
        case = json.loads((CASES / "box-cas15-modes.json").read_text(encoding="utf-8"))
        section = {**case["beam"]["section"], "height_m": 0.537 * INCH}
        result = aerom("run", "-", text=json.dumps({"schema_version": 1, "kind": "section",
                                                    "beam": {"section": section}}))
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads(result.stdout)
        order = summary["order"]
        for row, column, inches, expected in (("w'", "w'", 0, 1.37e6), ("theta'", "theta'", 2, 1.73e4),
                                              ("phi'", "phi'", 2, 6.08e4), ("psi'", "psi'", 2, 1.43e5),
                                              ("phi'", "theta'", 2, 1.80e4),
                                              ("gamma_yz", "gamma_yz", 0, 3.95e4)):
            with self.subTest(entry=row + column):
                value = summary["stiffness"][order.index(row)][order.index(column)]
                self.assertLess(abs(abs(value) / (POUND * INCH ** inches) / expected - 1), 0.05)

    def test_static_box_is_reciprocal(self):
        """Twist of a tip force over half the length is the slope of a tip torque, L = 30 in."""
        case = json.loads((CASES / "box-cas15-static.json").read_text(encoding="utf-8"))
        tip = {}
        for key in ("force_y_n", "moment_z_n_m"):
            result = aerom("run", "-", text=json.dumps({**case, "loads": {"tip": {key: 1}}}))
            self.assertEqual(result.returncode, 0, result.stderr)
            tip[key] = json.loads(result.stdout)["tip"]
        twist = math.radians(tip["force_y_n"]["twist_deg"])
        self.assertGreater(abs(twist), 1e-4)
        self.assertAlmostEqual(tip["moment_z_n_m"]["plunge_m"] / twist, 1, places=6)

    def test_static_text(self):
        result = aerom("run", "--text", CASES / "box-cas15-static.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in ("plunge_m", "reactions of the clamp", "first ply fails at", "at z = 0 m"):
            self.assertIn(word, result.stdout)

    def test_text(self):
        result = aerom("run", "--text", "-", text=json.dumps(short_case()))
        self.assertEqual(result.returncode, 0, result.stderr)
        for word in ("verdict: ", "natural modes", "torsion", "damping of tip_twist", "us per step"):
            self.assertIn(word, result.stdout)

    def test_series_has_every_sample_of_every_column(self):
        case = short_case()
        case["output"] = {"channels": ["tip_twist_deg", "modal_amplitude"], "sample_every": 10}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "series.csv"
            result = aerom("run", "-", "--series", path, text=json.dumps(case))
            self.assertEqual(result.returncode, 0, result.stderr)
            rows = list(csv.reader(path.read_text(encoding="ascii").splitlines()))
        self.assertEqual(rows[0], ["time_s", "tip_twist_deg"] + ["modal_amplitude[%d]" % (i + 1)
                                                           for i in range(4)])
        times = [float(row[0]) for row in rows[1:]]
        self.assertEqual(len(times), 101)  # 1000 steps of 2e-4 s, every 10th, and the start
        self.assertAlmostEqual(times[0], 0.0)
        self.assertAlmostEqual(times[-1], 0.2, places=12)
        self.assertTrue(any(float(row[1]) != 0.0 for row in rows[1:]))

    def test_problems_name_the_fields(self):
        case = short_case()
        case["beam"]["length_m"] = -1
        case["beam"]["section"]["layup"][0]["material"] = "unobtainium"
        case["surprise"] = 1
        result = aerom("run", "-", text=json.dumps(case))
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        for pointer in ("/beam/length_m: ", "/beam/section/layup/0/material: ", "/surprise: "):
            self.assertIn(pointer, result.stderr)

    def test_what_is_not_a_case(self):
        for text in ("", "{", "[]", '{"schema_version":1} trailing', '{"a":1,"a":2}'):
            with self.subTest(text=text):
                result = aerom("run", "-", text=text)
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertNotEqual(result.stderr, "")

    def test_files_that_fail(self):
        self.assertIn("No such file", aerom("run", "/does/not/exist.json").stderr)
        result = aerom("run", "-", "--series", "/does/not/exist.csv", text=json.dumps(short_case()))
        self.assertEqual(result.returncode, 1)
        result = aerom("run", CASES / "aluminium-modes.json", "--series", "/dev/null")
        self.assertEqual((result.returncode, result.stdout), (1, ""))


class Studies(unittest.TestCase):
    """Studies computed without a daemon."""

    @staticmethod
    def study(vary, **solver):
        return json.dumps({"schema_version": 1, "kind": "study", "type": "grid",
                           "case": short_case(**solver), "vary": vary})

    SPEEDS = {"pointer": "/flow/speed_m_s", "values": [3, 6]}
    ANGLES = {"pointer": "/beam/section/layup/0/angle_deg", "from": -45, "to": 45, "count": 3}

    def test_map_is_that_of_single_runs(self):
        result = aerom("run", "-", "--value", "means.cl", text=self.study([self.ANGLES, self.SPEEDS]))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        found = json.loads(result.stdout)
        self.assertEqual(found["shape"], [3, 2])
        for i, angle in enumerate((-45, 0, 45)):
            for j, speed in enumerate((3, 6)):
                case = short_case()
                case["beam"]["section"]["layup"][0]["angle_deg"] = angle
                case["flow"]["speed_m_s"] = speed
                alone = json.loads(aerom("run", "-", text=json.dumps(case)).stdout)
                self.assertEqual(found["values"][i][j], alone["means"]["cl"])

    def test_what_is_wrong_is_named(self):
        wrong = dict(self.SPEEDS, pointer="/flow/sped")
        result = aerom("run", "-", text=self.study([wrong]))
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("/vary/0/pointer", result.stderr)
        self.assertIn("speed_m_s", result.stderr)
        for more in (["--value", "nothing"], ["--value", "means"], ["--text"], ["--document", "modes"]):
            with self.subTest(more=more):
                result = aerom("run", "-", *more, text=self.study([self.SPEEDS], duration_s=0.01))
                self.assertEqual((result.returncode, result.stdout), (1, ""))
                self.assertIn("--value", result.stderr)
        result = aerom("run", "-", "--value", "cl", text=json.dumps(short_case()))
        self.assertEqual(result.returncode, 1)

    def test_a_cell_fails_alone(self):
        study = json.loads(self.study([dict(self.SPEEDS, values=[3, 60])], duration_s=0.02))
        study["case"]["solver"]["start"] = {"type": "equilibrium"}
        study["case"]["beam"]["section"]["layup"][0]["angle_deg"] = 45
        study["case"]["aerodynamics"] = {"polar": "plate-4pct-channel", "lifting_line": None}
        result = aerom("run", "-", text=json.dumps(study))
        self.assertEqual(result.returncode, 0)
        self.assertEqual(json.loads(result.stdout)["status"], ["done", "failed"])
        self.assertIn("cell 1 failed (no_equilibrium)", result.stderr)

    def test_shipped_study_is_good(self):
        for path in sorted((ROOT / "data" / "studies").glob("*.json")):
            study = json.loads(path.read_text(encoding="utf-8"))
            study["case"]["solver"]["duration_s"] = 0.01
            for axis in study["vary"]:
                axis["count"] = 2
            with self.subTest(study=path.name):
                self.assertEqual(aerom("run", "-", text=json.dumps(study)).returncode, 0)


class Scripted(http.server.BaseHTTPRequestHandler):
    """Answers each request with the next (status, document) of the server's script and keeps what
    was asked."""

    def answer(self):
        size = int(self.headers.get("Content-Length", 0))
        self.server.asked.append((self.command, self.path, self.rfile.read(size).decode(),
                                  self.headers.get("Content-Type")))
        status, document = self.server.script.pop(0)
        body = (document if isinstance(document, str) else json.dumps(document)).encode()
        self.send_response(status)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    do_GET = do_POST = do_DELETE = answer

    def log_message(self, *_):
        pass


def job(state, **more):
    return dict({"id": "0190-a", "kind": "simulation", "state": state, "progress": 0.5, "name": "x"},
                **more)


class Remote(unittest.TestCase):
    """The client alone, against a server that plays a script."""

    def setUp(self):
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Scripted)
        self.server.asked = []
        self.thread = threading.Thread(target=self.server.serve_forever, daemon=True)
        self.thread.start()
        self.url = "http://127.0.0.1:%d" % self.server.server_port

    def tearDown(self):
        self.server.shutdown()
        self.server.server_close()
        self.thread.join()

    def play(self, *script, arguments):
        self.server.script = list(script)
        result = aerom(*arguments, url=self.url)
        self.assertEqual(self.server.script, [], "not every answer was asked for")
        return result

    def test_submit_sends_the_file_as_it_is(self):
        path = CASES / "aluminium-modes.json"
        result = self.play((202, job("queued")), (200, dict(job("done"), reused=True)),
                           arguments=["submit", path, path])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "0190-a queued %s\n0190-a done %s (reused)\n" % (path, path))
        sent = ("POST", "/v1/jobs", path.read_text(encoding="utf-8"), "application/json")
        self.assertEqual(self.server.asked, [sent, sent])

    def test_submit_goes_on_after_a_refused_case(self):
        path = CASES / "aluminium-modes.json"
        problem = {"title": "The case is not admissible", "status": 422, "errors": [
            {"pointer": "/beam/length_m", "code": "range", "detail": "is not positive",
             "expected": "> 0", "got": "-1"}]}
        result = self.play((422, problem), (202, job("queued")), arguments=["submit", path, path])
        self.assertEqual(result.returncode, 1)
        self.assertIn("422 The case is not admissible", result.stderr)
        self.assertIn("/beam/length_m: is not positive (expected > 0, got -1)", result.stderr)
        self.assertEqual(result.stdout.count("\n"), 1)

    def test_submit_wait(self):
        result = self.play((202, job("queued")), (200, job("running")), (200, job("done")),
                           arguments=["submit", "--wait", CASES / "aluminium-modes.json"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([a[1] for a in self.server.asked],
                         ["/v1/jobs", "/v1/jobs/0190-a", "/v1/jobs/0190-a"])

    def test_wait_tells_how_a_job_ended(self):
        failed = job("failed", error={"code": "not_finite", "detail": "at 0.3 s"})
        for final, code in ((job("done"), 0), (failed, 1), (job("cancelled"), 1)):
            with self.subTest(state=final["state"]):
                result = self.play((200, job("running")), (200, final), arguments=["wait", "0190-a"])
                self.assertEqual(result.returncode, code)
                self.assertEqual(result.stdout, "")
        self.assertIn("at 0.3 s", self.play((200, failed), arguments=["wait", "1"]).stderr)

    def test_wait_gives_up(self):
        start = time.monotonic()
        result = self.play((200, job("running")), arguments=["wait", "1", "--timeout", "0"])
        self.assertEqual(result.returncode, 3)
        self.assertLess(time.monotonic() - start, 10)

    def test_get_and_cancel(self):
        for word, path in (("summary", "/summary"), ("case", "/case"), ("modes", "/modes"),
                           ("damping", "/damping"), ("loads", "/loads"), ("section", "/section"), ("series", "/series"),
                           ("job", "")):
            self.server.asked.clear()
            result = self.play((200, {"a": 1}), arguments=["get", "j", word])
            self.assertEqual((result.returncode, result.stdout), (0, '{"a": 1}\n'))
            self.assertEqual(self.server.asked[0][:2], ("GET", "/v1/jobs/j" + path))
        self.server.asked.clear()
        result = self.play((202, job("cancelling")), arguments=["cancel", "j"])
        self.assertEqual((result.returncode, result.stdout), (0, "0190-a cancelling\n"))
        self.assertEqual(self.server.asked[0][:2], ("DELETE", "/v1/jobs/j"))

    def test_list(self):
        result = self.play((200, {"jobs": [job("done", verdict="stable")], "next": None}),
                           arguments=["list", "--state", "done", "--kind", "simulation",
                                      "--limit", "5"])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.split(), ["0190-a", "simulation", "done", "50", "%", "stable", "x"])
        self.assertEqual(self.server.asked[0][1], "/v1/jobs?state=done&kind=simulation&limit=5")

    def test_ids_cannot_change_the_path(self):
        for name in ("../polars", "..", "a/b", "a?b", "", "a%2e"):
            with self.subTest(id=name):
                result = self.play(arguments=["get", name])
                self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(self.server.asked, [])

    def test_answers_that_are_no_documents(self):
        for body in ("", "<html>", "[]", "{}", '{"id": 5}'):
            with self.subTest(body=body):
                self.assertEqual(self.play((200, body), arguments=["wait", "j"]).returncode, 1)
        self.assertEqual(self.play((502, "<html>bad gateway"), arguments=["show", "j"]).returncode, 1)
        self.assertEqual(self.play((200, "<html>"), arguments=["list"]).returncode, 1)

    def test_nobody_there(self):
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            closed = "http://127.0.0.1:%d" % s.getsockname()[1]
        result = aerom("list", "--url", closed)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn(closed, result.stderr)


@unittest.skipUnless("AEROMD" in os.environ, "AEROMD names no daemon")
class Daemon(unittest.TestCase):
    """The client against the real daemon."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            port = s.getsockname()[1]
        cls.url = "http://127.0.0.1:%d" % port
        cls.log = open(Path(cls.folder.name) / "log", "w+", encoding="utf-8")
        cls.process = subprocess.Popen(
            [os.environ["AEROMD"], "--listen", "127.0.0.1:%d" % port,
             "--store", "sqlite:%s/jobs.db" % cls.folder.name], stderr=cls.log)
        for _ in range(300):
            try:
                urllib.request.urlopen(cls.url + "/readyz", timeout=5).close()
                return
            except OSError:
                time.sleep(0.1)
        cls.tearDownClass()
        raise AssertionError("the daemon did not become ready")

    @classmethod
    def tearDownClass(cls):
        cls.process.terminate()
        code = cls.process.wait(timeout=60)
        cls.log.seek(0)
        log = cls.log.read()
        cls.log.close()
        cls.folder.cleanup()
        assert code == 0, "the daemon ended with %d:\n%s" % (code, log)

    def submit(self, case):
        path = Path(self.folder.name) / "case.json"
        path.write_text(json.dumps(case), encoding="utf-8")
        result = aerom("submit", path, "--wait", "--timeout", "120", url=self.url)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.split()[0], path

    def test_daemon_and_run_agree(self):
        job_id, path = self.submit(short_case())
        remote = json.loads(aerom("get", job_id, url=self.url).stdout)
        local = json.loads(aerom("run", path).stdout)
        for summary in (remote, local):
            for key in ("cpu_s", "us_per_step"):
                self.assertGreater(summary["timing"].pop(key), 0)
        self.assertEqual(remote, local)

    def test_series_agree(self):
        case = short_case(modal_damping_ratio=0.01)
        case["output"] = {"channels": ["tip_twist_deg", "modal_velocity"]}
        job_id, path = self.submit(case)
        remote = aerom("get", job_id, "series", "--csv", url=self.url).stdout
        local = aerom("run", path, "--series", "-", "--document", "modes").stdout
        self.assertGreater(remote.count("\n"), 1000)
        self.assertTrue(local.endswith(remote), "the two CSV texts differ")

    def test_every_document(self):
        job_id, _ = self.submit(short_case(modes=3))
        for word in ("job", "summary", "case", "series", "damping", "modes", "section"):
            with self.subTest(document=word):
                result = aerom("get", job_id, word, url=self.url)
                self.assertEqual(result.returncode, 0, result.stderr)
                json.loads(result.stdout)
        self.assertIn("verdict: ", aerom("show", job_id, url=self.url).stdout)
        listed = aerom("list", "--state", "done", "--kind", "simulation", url=self.url).stdout
        self.assertIn(job_id, listed)

    def test_training(self):
        """Submitted, waited for, its documents read; a run without a daemon names the way."""
        job_id, path = self.submit({
            "schema_version": 1, "kind": "training",
            "training": {"network": "cli", "dataset": "plate-4pct", "polar": "plate-4pct-channel",
                         "inputs": ["delta_alpha", "alpha_rate"], "hidden": 2, "epochs": 2,
                         "samples_max": 10, "anchors": 10}})
        summary = json.loads(aerom("get", job_id, url=self.url).stdout)
        curves = json.loads(aerom("get", job_id, "training", url=self.url).stdout)
        self.assertEqual(len(curves["members"][0]["curve"]["trained"]),
                         summary["members"][0]["epochs"] + 1)
        network = json.loads(aerom("get", job_id, "network", url=self.url).stdout)
        self.assertEqual((network["name"], network["hidden"]), ("cli", 2))
        shown = aerom("show", job_id, url=self.url)
        self.assertIn("cl_rms_of_range_polar", shown.stdout)
        local = aerom("run", path)
        self.assertEqual(local.returncode, 1)
        self.assertIn("aerom train", local.stderr)

    def test_refused_case(self):
        path = Path(self.folder.name) / "bad.json"
        case = short_case()
        case["flow"]["speed_m_s"] = 0
        path.write_text(json.dumps(case), encoding="utf-8")
        remote, local = aerom("submit", path, url=self.url), aerom("run", path)
        self.assertEqual((remote.returncode, local.returncode), (1, 1))
        line = [x for x in local.stderr.splitlines() if "/flow/speed_m_s" in x]
        self.assertEqual(len(line), 1)
        self.assertIn(line[0], remote.stderr.splitlines())

    def test_examples_of_the_readme(self):
        """The curl lines of README.md, as they stand, on the paper's case."""
        self.submit(json.loads((CASES / "paper-beam.json").read_text(encoding="utf-8")))
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)
        answers = [subprocess.run(["bash", "-ec", block.replace("http://127.0.0.1:8080", self.url)],
                                  cwd=ROOT, capture_output=True, text=True, timeout=60, check=True)
                   for block in blocks]
        submitted, damping = (json.loads(answer.stdout) for answer in answers)
        self.assertEqual((submitted["state"], submitted["reused"]), ("done", True))
        root = damping["tip_twist"]["roots"][0]
        printed = re.search(r'"frequency_hz":([0-9.]+),"ratio":([-0-9.]+)', text)
        self.assertAlmostEqual(root["frequency_hz"] / float(printed.group(1)), 1, delta=1e-3)
        self.assertAlmostEqual(root["ratio"], float(printed.group(2)), delta=1e-4)

    def test_study_through_the_daemon_and_without(self):
        study = json.loads(Studies.study([Studies.ANGLES, Studies.SPEEDS]))
        job_id, path = self.submit(study)
        there = aerom("get", job_id, "map", "--value", "damping.tip_plunge", url=self.url)
        here = aerom("run", path, "--value", "damping.tip_plunge")
        self.assertEqual((there.returncode, here.returncode), (0, 0), there.stderr + here.stderr)
        there, here = json.loads(there.stdout), json.loads(here.stdout)
        self.assertEqual(there["values"], here["values"])
        self.assertEqual(there["axes"], here["axes"])
        progress = json.loads(aerom("get", job_id, "study", url=self.url).stdout)
        self.assertEqual(progress["cells"]["done"], 6)
        cells = json.loads(aerom("get", job_id, "cells", url=self.url).stdout)["cells"]
        self.assertEqual([c["cell"] for c in cells], list(range(6)))
        self.assertEqual(aerom("get", job_id, "summary", url=self.url).returncode, 1)
        self.assertEqual(aerom("get", job_id, "study", "--value", "cl", url=self.url).returncode, 2)

    def test_unknown_job(self):
        result = aerom("get", "00000000-0000-7000-8000-000000000000", url=self.url)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("404", result.stderr)

    def test_cancel(self):
        case = short_case(duration_s=100)
        path = Path(self.folder.name) / "long.json"
        case["output"] = {"channels": ["tip_twist_deg"], "sample_every": 100}
        path.write_text(json.dumps(case), encoding="utf-8")
        submitted = aerom("submit", path, url=self.url)
        self.assertEqual(submitted.returncode, 0, submitted.stderr)
        job_id = submitted.stdout.split()[0]
        self.assertEqual(aerom("cancel", job_id, url=self.url).returncode, 0)
        self.assertEqual(aerom("wait", job_id, "--timeout", "60", url=self.url).returncode, 1)
        self.assertIn("cancelled", aerom("get", job_id, "job", url=self.url).stdout)


if __name__ == "__main__":
    unittest.main()
