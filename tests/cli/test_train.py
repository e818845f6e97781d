#!/usr/bin/env python3
"""aerom train: a folder of records to a network that other commands take. Needs AEROM, the program. Python 3
standard library."""

import csv
import json
import math
import os
import pty
import subprocess
import tempfile
import unittest
from pathlib import Path

from program import AEROM, aerom


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

    def test_a_terminal_shows_how_far_it_is(self):
        """And only a terminal: a pipe gets nothing on stderr."""
        self.assertEqual(self.train().stderr, "")
        master, slave = pty.openpty()
        try:
            run = subprocess.Popen([AEROM, "train", self.folder, "--output", self.output, "--hidden", "20", "--members", "8",
                                    "--polar", "flat-plate-linear", "--inputs", "delta_alpha,alpha_rate"],
                                   stdout=subprocess.DEVNULL, stderr=slave)
            self.assertEqual(run.wait(250), 0)
            shown = os.read(master, 65536).decode()
        finally:
            os.close(master)
            os.close(slave)
        self.assertRegex(shown, r"^(\r +\d+ %)+\r +\r$")

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
        self.assertEqual(document["input_offset"], [0, 0])
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


if __name__ == "__main__":
    unittest.main()
