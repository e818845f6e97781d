#!/usr/bin/env python3
"""aerom run of a study: maps without a daemon. Needs AEROM, the program. Python 3 standard library."""

import json
import unittest

from program import ROOT, aerom, short_case


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
            for axis in study.get("vary", []) + study.get("over", []):
                axis["count"] = 2
            with self.subTest(study=path.name):
                self.assertEqual(aerom("run", "-", text=json.dumps(study)).returncode, 0)


if __name__ == "__main__":
    unittest.main()
