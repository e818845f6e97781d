"""Studies through the real daemon: maps, reuse, cancel, fairness, kill -9, any number of workers."""
import csv
import io
import json
import sqlite3
import struct
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

from daemon import DaemonTest, simulation

ANGLE = "/beam/section/layup/0/angle_deg"
SPEED = "/flow/speed_m_s"
ROOT = Path(__file__).resolve().parents[2]


def grid(case, *vary, **more):
    return {"schema_version": 1, "kind": "study", "type": "grid", "case": case,
            "vary": list(vary), **more}


def span(pointer, first, last, count):
    return {"pointer": pointer, "from": first, "to": last, "count": count}


class Study(DaemonTest):
    def post(self, d, study):
        status, headers, body = d.request("POST", "/v1/studies", study)
        self.assertIn(status, (200, 202), body)
        self.assertEqual(headers["Location"], "/v1/studies/" + body["id"])
        return body["id"]

    def get(self, d, study, tail=""):
        status, _, body = d.request("GET", f"/v1/studies/{study}{tail}")
        self.assertEqual(status, 200, body)
        return body

    def wait_cells(self, d, study, least, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            cells = self.get(d, study)["cells"]
            if cells["done"] + cells["failed"] >= least:
                return cells
            time.sleep(0.01)
        raise AssertionError(f"{cells}: {d.log()}")

    def check_forms(self, d, key, values):
        """The same map as a table, an array, a file and a drawing; by name or by type."""
        path = f"/v1/studies/{key}/map?value=means.cl"
        flat = [v for row in values for v in row]
        _, headers, table = d.request("GET", path, headers={"Accept": "text/csv"})
        self.assertTrue(headers["Content-Type"].startswith("text/csv"))
        rows = list(csv.reader(io.StringIO(table.decode())))
        self.assertEqual([float(r[-2]) for r in rows[1:]], flat)
        raw = d.request("GET", path + "&format=npy")[2]
        self.assertIn(b"'shape': (3,2,)", raw[:128])
        self.assertEqual(list(struct.unpack("<6d", raw[-48:])), flat)
        self.assertEqual(d.request("GET", path + "&format=hdf5")[2][:4], b"\x89HDF")
        drawing = d.request("GET", path + "&format=svg")[2]
        self.assertTrue(xml.etree.ElementTree.fromstring(drawing).tag.endswith("}svg"))
        tag = d.request("GET", path + "&format=svg")[1]["ETag"]
        self.assertEqual(d.request("GET", path + "&format=svg", headers={"If-None-Match": tag})[0], 304)

    def test_a_grid(self):
        d = self.start("--workers", "2").wait_ready()
        study = grid(simulation(duration=0.05), span(ANGLE, -45, 45, 3),
                     {"pointer": SPEED, "values": [4, 6], "zip": "air"},
                     {"pointer": "/flow/incidence_deg", "values": [5, 3], "zip": "air"}, name="map")
        job = d.submit(simulation(speed=6, duration=0.05) | {"flow": {"speed_m_s": 6,
                                                                      "incidence_deg": 3}})
        d.wait(job)
        key = self.post(d, study)
        self.assertEqual(d.wait(key)["kind"], "study")
        cells = self.get(d, key)["cells"]
        self.assertEqual(cells, {"total": 6, "done": 6, "failed": 0, "pending": 0, "reused": 1})
        # A cell is the run of its case: one was the job above, another one becomes a job.
        self.assertTrue(self.get(d, key, "/cells/1")["reused"])
        cell = self.get(d, key, "/cells/4")
        self.assertEqual(cell["point"], {ANGLE: 45, SPEED: 4, "/flow/incidence_deg": 5})
        again = d.submit(cell["case"])
        self.assertEqual(d.wait(again)["content_hash"], cell["content_hash"])
        alone = d.request("GET", f"/v1/jobs/{again}/summary")[2]
        self.assertEqual(alone | {"timing": 0}, cell["summary"] | {"timing": 0})
        found = self.get(d, key, "/map?value=means.cl")
        self.assertEqual(found["shape"], [3, 2])
        self.assertEqual([a["dimension"] for a in found["axes"]], [0, 1, 1])
        self.assertEqual(found["values"][2][0], cell["summary"]["means"]["cl"])
        self.assertEqual(found["status"], [["done"] * 2] * 3)
        self.check_forms(d, key, found["values"])
        pages = self.get(d, key, "/cells?limit=4")
        rest = self.get(d, key, f"/cells?from={pages['next']}")
        self.assertEqual([c["cell"] for c in pages["cells"] + rest["cells"]], list(range(6)))
        # Known as a whole, and its cells to other studies.
        status, _, body = d.request("POST", "/v1/jobs", study)
        self.assertEqual((status, body["id"], body["reused"]), (200, key, True))
        study["vary"][0]["count"] = 5
        more = self.post(d, study)
        d.wait(more)
        self.assertEqual(self.get(d, more)["cells"]["reused"], 6)
        self.assertEqual(d.stop(), 0)

    def test_a_cell_fails_alone(self):
        d = self.start("--workers", "1").wait_ready()
        case = simulation(duration=0.02, start={"type": "equilibrium"})
        case["beam"]["section"]["layup"][0]["angle_deg"] = 45
        case["aerodynamics"] = {"polar": "plate-4pct-channel", "lifting_line": None}
        key = self.post(d, grid(case, {"pointer": SPEED, "values": [3, 60, 4]}))
        self.assertEqual(d.wait(key)["state"], "done")
        cells = self.get(d, key, "/cells")["cells"]
        self.assertEqual([c["state"] for c in cells], ["done", "failed", "done"])
        self.assertEqual(cells[1]["error"]["code"], "no_equilibrium")
        self.assertIsNone(self.get(d, key, "/cells/1")["summary"])
        self.assertEqual(self.get(d, key, "/map?value=cl")["values"][1], None)
        self.assertEqual(d.stop(), 0)

    def test_refused(self):
        d = self.start("--workers", "1").wait_ready()
        for vary, code in (({"pointer": "/flow/speed", "values": [1]}, "unknown_pointer"),
                           (span(SPEED, 3, -1, 5), "out_of_range"),
                           (span(SPEED, 3, 3, 5), "contradictory"),
                           (span(SPEED, 3, 4, 100001), "out_of_range")):
            status, _, body = d.request("POST", "/v1/studies", grid(simulation(), vary))
            self.assertEqual((status, body["errors"][0]["code"]), (422, code), body)
        self.assertEqual(d.request("GET", "/v1/studies")[2]["studies"], [])
        self.assertEqual(d.stop(), 0)

    def test_any_number_of_workers(self):
        """The same bits from one worker and from three, in whatever order units are taken."""
        case = simulation(duration=0.2)
        case["aerodynamics"] = {"polar": "plate-4pct-channel", "dynamic": {"type": "attached"},
                                "lifting_line": {"walls": "root"}}
        study = grid(case, span(SPEED, 2, 9, 8), span(ANGLE, -90, 90, 7))
        found = []
        for workers in ("1", "3"):
            d = self.start("--workers", workers).wait_ready()
            key = self.post(d, study)
            d.wait(key)
            found.append([self.get(d, key, f"/cells/{i}")["summary"] | {"timing": 0}
                          for i in range(56)])
            self.assertEqual(d.stop(), 0)
            Path(d.store).unlink()
        self.assertEqual(found[0], found[1])
        self.assertGreater(len({c["means"]["cl"] for c in found[0]}), 50)

    def long_study(self, d, seconds, count):
        """A study whose cells take about so long each; its key."""
        case = simulation(duration=0.1)
        probe = self.post(d, grid(case, {"pointer": SPEED, "values": [1.5]}))
        d.wait(probe)
        cpu = self.get(d, probe, "/cells/0")["summary"]["timing"]["cpu_s"]
        case["solver"]["duration_s"] = round(max(0.1 * seconds / cpu, 0.01), 3)
        return self.post(d, grid(case, span(ANGLE, -90, 90, count // 20), span(SPEED, 2, 4, 20)))

    def test_cancel_keeps_what_is_done(self):
        d = self.start("--workers", "2").wait_ready()
        key = self.long_study(d, 0.05, 2000)
        self.wait_cells(d, key, 1)
        running = self.get(d, key)
        self.assertEqual(running["state"], "running")
        self.assertGreater(running["progress"], 0)
        partial = self.get(d, key, "/map?value=cl")
        self.assertIn(None, partial["values"][-1])
        self.assertEqual(d.request("DELETE", "/v1/studies/" + key)[0], 200)
        self.assertEqual(d.wait(key)["state"], "cancelled")
        cells = self.get(d, key)["cells"]
        self.assertGreaterEqual(cells["done"], 1)
        self.assertGreater(cells["pending"], 1000)
        self.assertEqual(len(self.get(d, key, "/cells?limit=1000")["cells"]), cells["done"])
        self.assertTrue(d.request("GET", "/readyz")[0] == 200)
        self.assertEqual(d.stop(), 0)

    def test_jobs_get_their_turn(self):
        """Jobs and another study come through while a big study keeps the only worker busy."""
        d = self.start("--workers", "1").wait_ready()
        key = self.long_study(d, 0.05, 4000)
        self.wait_cells(d, key, 1)
        jobs = [d.submit(simulation(speed=7 + 0.1 * i)) for i in range(3)]
        small = self.post(d, grid(simulation(), {"pointer": SPEED, "values": [3, 4]}))
        for job in jobs + [small]:
            self.assertEqual(d.wait(job, seconds=60)["state"], "done")
        self.assertEqual(self.get(d, key)["state"], "running")
        d.request("DELETE", "/v1/studies/" + key)
        d.wait(key)
        self.assertEqual(d.stop(), 0)

    def test_kill_in_the_middle(self):
        """A thousand cells, four kills: each cell once, none that was finished computed again."""
        d = self.start("--workers", "2").wait_ready()
        key = self.long_study(d, 0.006, 1000)
        stored, kept = {}, []
        for least in (50, 250, 450, 650):
            self.wait_cells(d, key, least)
            d.kill()
            before = self.rows(d.store, key)
            self.assertEqual({cell: before[cell] for cell in stored}, stored)
            stored = before
            kept.append(len(stored))
            d = self.start("--workers", "2").wait_ready()
        self.assertEqual(d.wait(key)["state"], "done")
        self.assertEqual(self.get(d, key)["cells"],
                         {"total": 1000, "done": 1000, "failed": 0, "pending": 0, "reused": 0})
        self.assertEqual(d.stop(), 0)
        after = self.rows(d.store, key)
        self.assertEqual({cell: after[cell] for cell in stored}, stored)
        self.assertEqual(sorted(after), list(range(1000)))
        self.assertEqual(len(set(after.values())), 1000)
        db = sqlite3.connect(d.store)
        self.assertEqual(db.execute("PRAGMA foreign_key_check").fetchall(), [])
        self.assertEqual(db.execute("SELECT count(*) FROM study_unit").fetchone(), (0,))
        self.assertEqual(db.execute("SELECT count(*) FROM study WHERE open = 1").fetchone(), (0,))
        self.assertEqual(db.execute("SELECT count(*) FROM cell_result").fetchone(), (1001,))
        db.close()
        self.assertTrue(0 < kept[0] < kept[-1] < 1000, kept)
        print(f"stored at the kills: {kept}")

    @staticmethod
    def rows(path, key):
        """Answer of each finished cell, with the time it took."""
        db = sqlite3.connect(path)
        rows = db.execute("SELECT cell, result, cpu_s FROM study_cell JOIN cell_result ON cell_result.id = result "
                          "JOIN job ON seq = study WHERE job.id = ?", (key,)).fetchall()
        db.close()
        return {cell: (result, cpu) for cell, result, cpu in rows}


if __name__ == "__main__":
    unittest.main()
