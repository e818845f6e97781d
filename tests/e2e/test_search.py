"""Boundaries, optima and uncertainties through the real daemon: against a fine grid, with any number
of workers, over a kill -9."""
import glob
import json
import os
import sqlite3
import unittest

import test_study
from daemon import DaemonTest, simulation
from test_study import ANGLE, ROOT, SPEED, grid, span

LENGTH = "/beam/length_m"


def search(kind, case, **members):
    return {"schema_version": 1, "kind": "study", "type": kind, "case": case, **members}


def attached(**more):
    case = simulation(duration=1.0)
    case["aerodynamics"]["dynamic"] = {"type": "attached"}
    return case | more


def critical_speed(*angles, tolerance=0.05):
    return search("boundary", attached(), name="critical speed",
                  over=[{"pointer": ANGLE, "values": list(angles)}],
                  field={"pointer": SPEED, "from": 6, "to": 14, "tolerance": tolerance},
                  criterion={"verdict": "stable"})


class Search(DaemonTest):
    post, get, wait_cells = test_study.Study.post, test_study.Study.get, test_study.Study.wait_cells

    def forget(self, d):
        """The next daemon begins with an empty store."""
        d.stop()
        for path in glob.glob(d.store + "*"):
            os.remove(path)

    @staticmethod
    def answers(path):
        """Time each stored answer took, by its content."""
        db = sqlite3.connect(path)
        rows = db.execute("SELECT content_hash, cpu_s FROM cell_result").fetchall()
        db.close()
        return dict(rows)

    def answer(self, d, study, document):
        key = self.post(d, study)
        self.assertEqual(d.wait(key)["state"], "done")
        return self.get(d, key, "/" + document)

    def test_the_boundary_of_a_fine_grid(self):
        d = self.start("--workers", "2").wait_ready()
        found = self.answer(d, critical_speed(-45, 30), "boundary")
        speeds = 81  # 0.1 m/s
        key = self.post(d, grid(attached(), {"pointer": ANGLE, "values": [-45, 30]},
                                span(SPEED, 6, 14, speeds)))
        d.wait(key)
        verdicts = self.get(d, key, "/map?value=verdict")["values"]
        for row, line in zip(found["rows"], verdicts):
            first = next(i for i, v in enumerate(line) if v != "stable")
            self.assertEqual(row["outcome"], "found")
            self.assertLessEqual(row["upper"] - row["lower"], 0.05)
            # The first change of the grid and the bracket have a speed in common.
            self.assertLessEqual(row["lower"], 6 + 0.1 * first)
            self.assertGreaterEqual(row["upper"], 6 + 0.1 * (first - 1))
        self.assertEqual(found["runs"], sum(row["evaluations"] for row in found["rows"]))
        self.assertLess(5 * found["runs"], 2 * speeds)
        print(f"{found['runs']} runs instead of {2 * speeds}")
        over = d.request("GET", f"/v1/studies/{key}/map?format=svg&boundary={found['study']}")
        self.assertEqual(over[0], 200)
        self.assertIn(b"<title>boundary</title><path d=\"M", over[2])
        status, _, why = d.request("GET", f"/v1/studies/{key}/map?format=svg&boundary={key}")
        self.assertEqual((status, why["errors"][0]["pointer"]), (400, "?boundary"))
        key = self.post(d, critical_speed(-45, 30))
        drawing = d.request("GET", f"/v1/studies/{key}/map?format=svg")[2]
        self.assertIn(b">boundary<", drawing)
        self.assertEqual(self.get(d, key, "/map")["values"],
                         [row["boundary"] for row in found["rows"]])
        self.assertEqual(d.request("GET", f"/v1/studies/{key}/optimum")[0], 404)

    def test_any_number_of_workers_and_a_kill(self):
        """The same rows to the last bit from one worker, from three, and after two kills."""
        study = critical_speed(-45, -30, -15, 0, 15, 30, 45, tolerance=1e-4)
        d = self.start("--workers", "1").wait_ready()
        alone = self.answer(d, study, "boundary")
        self.forget(d)
        d = self.start("--workers", "3").wait_ready()
        together = self.answer(d, study, "boundary")
        self.assertEqual(together["rows"], alone["rows"])
        self.forget(d)
        d = self.start("--workers", "2").wait_ready()
        key = self.post(d, study)
        stored = {}
        for least in (1, 3):
            self.wait_cells(d, key, least)
            d.kill()
            before = self.answers(d.store)
            self.assertEqual({name: before[name] for name in stored}, stored)
            stored = before
            d = self.start("--workers", "2").wait_ready()
        d.wait(key)
        after = self.answers(d.store)
        self.assertEqual({name: after[name] for name in stored}, stored)
        # Every evaluation is an answer of its own beside that of its cell, also of those under way.
        self.assertEqual(len(after), 7 + alone["runs"])
        self.assertGreater(len(stored), 3)
        self.assertEqual(self.get(d, key, "/boundary")["rows"], alone["rows"])
        self.assertEqual(self.get(d, key)["cells"]["done"], 7)

    def test_uncertainty(self):
        """The first frequency goes with 1/L^2: quantiles of a uniform length are known."""
        case = simulation(duration=0.05)
        case = {"schema_version": 1, "kind": "modes", "beam": case["beam"]}
        d = self.start("--workers", "2").wait_ready()
        length = case["beam"]["length_m"]
        found = self.answer(d, search("uncertainty", case, samples=256, result="modes.0.frequency_hz",
                                      tolerances=[{"pointer": LENGTH, "spread": 0.1 * length}]),
                            "uncertainty")
        nominal = self.answer(d, grid(case, {"pointer": LENGTH, "values": [length]}),
                              "map?value=modes.0.frequency_hz")["values"][0]
        self.assertEqual((found["counted"], found["without_value"]), (256, 0))
        for q in found["quantiles"]:
            exact = nominal / (1 + 0.1 * (1 - 2 * q["p"])) ** 2
            self.assertAlmostEqual(q["value"] / exact, 1, delta=3e-3)
            self.assertTrue(q["lower"] < exact < q["upper"])

    def test_an_optimum_from_several_starts(self):
        """The longest beam of at least 4 Hz has its fibres along the span."""
        case = {"schema_version": 1, "kind": "modes", "beam": simulation(duration=0.05)["beam"]}
        d = self.start("--workers", "2").wait_ready()
        study = search("optimum", case, starts=3, evaluations_max=60, maximise="boundary", tolerance=0.01,
                       variables=[{"pointer": ANGLE, "from": -80, "to": 80, "start": -60}],
                       field={"pointer": LENGTH, "from": 0.1, "to": 1, "tolerance": 1e-4},
                       criterion={"value": "modes.0.frequency_hz", "level": 4},
                       constraints=[{"value": "section.mass_kg_m", "max": 1}])
        found = self.answer(d, study, "optimum")
        self.assertEqual(found["outcome"], "found")
        self.assertAlmostEqual(found["best"]["point"][ANGLE], 0, delta=3)
        self.assertEqual(len(found["starts"]), 3)
        self.assertEqual(found["best"]["objective"], max(s["objective"] for s in found["starts"]))
        self.assertEqual([len(s["history"]) for s in found["starts"]],
                         [s["evaluations"] for s in found["starts"]])

    def test_examples(self):
        """The shipped definitions are accepted."""
        d = self.start("--workers", "1").wait_ready()
        for path in sorted((ROOT / "data" / "studies").glob("*.json")):
            key = self.post(d, json.loads(path.read_text()))
            d.request("DELETE", "/v1/studies/" + key)


if __name__ == "__main__":
    unittest.main()
