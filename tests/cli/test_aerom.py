#!/usr/bin/env python3
"""aerom as a user sees it: standard output, stderr, exit code.

Needs AEROM, the program. Python 3 standard library."""

import csv
import json
import math
import tempfile
import unittest
from pathlib import Path

from program import CASES, POUND, INCH, ROOT, aerom, short_case


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


if __name__ == "__main__":
    unittest.main()
