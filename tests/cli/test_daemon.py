#!/usr/bin/env python3
"""aerom with a real daemon. Needs AEROM, the program, and AEROMD, the daemon. Python 3 standard library."""

import json
import os
import re
import socket
import subprocess
import tempfile
import time
import unittest
import urllib.request
from pathlib import Path

import test_studies
from program import CASES, ROOT, aerom, short_case


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
        studies = test_studies.Studies
        study = json.loads(studies.study([studies.ANGLES, studies.SPEEDS]))
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
