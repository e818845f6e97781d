"""The life of jobs over HTTP."""
import json
import math
import resource
import signal
import sqlite3
import threading
import time

from pathlib import Path

from daemon import DaemonTest, simulation

ROOT = Path(__file__).resolve().parents[2]

# A run that no test waits for: a million steps of the dearer integrator.
LONG = {"duration": 200.0, "integrator": "rk4_adaptive"}


class Jobs(DaemonTest):
    def test_submit_wait_results(self):
        d = self.start().wait_ready()
        status, headers, body = d.request("POST", "/v1/jobs", simulation())
        self.assertEqual(status, 202)
        self.assertFalse(body["reused"])
        self.assertEqual(headers["Location"], "/v1/jobs/" + body["id"])
        job = d.wait(body["id"])
        self.assertEqual(job["state"], "done", job)
        self.assertEqual(job["progress"], 1)
        self.assertEqual(job["attempt"], 1)
        path = "/v1/jobs/" + body["id"]

        status, _, summary = d.request("GET", path + "/summary")
        self.assertEqual(status, 200)
        self.assertEqual(job["verdict"], summary["verdict"])
        self.assertGreater(summary["timing"]["cpu_s"], 0)
        self.assertEqual(summary["timing"]["steps"], 100)
        self.assertEqual(summary["identity"]["content_hash"], body["content_hash"])
        self.assertEqual(len(summary["modes"]), 4)
        for document in ("damping", "loads", "modes", "section"):
            status, _, result = d.request("GET", f"{path}/{document}")
            self.assertEqual((document, status), (document, 200))
            self.assertTrue(result)

        # The canonical case is the same case again.
        status, _, case = d.request("GET", path + "/case")
        self.assertEqual(status, 200)
        self.assertEqual(case["beam"]["section"]["chordwise_curvature"], "free")
        status, _, again = d.request("POST", "/v1/jobs", case)
        self.assertEqual((status, again["reused"], again["id"]), (200, True, body["id"]))

    def test_loop(self):
        """A section in prescribed motion: the work is the area of the loop of its series."""
        d = self.start().wait_ready()
        job = d.submit({"schema_version": 1, "kind": "loop",
                        "aerodynamics": {"polar": "plate-4pct-channel",
                                         "dynamic": {"type": "dynamic_stall"}},
                        "motion": {"type": "sine", "mean_deg": 8, "amplitude_deg": 6,
                                   "frequency_c_v": 0.06, "cycles": 3}})
        self.assertEqual(d.wait(job)["state"], "done")
        _, _, summary = d.request("GET", f"/v1/jobs/{job}/summary")
        _, _, series = d.request("GET", f"/v1/jobs/{job}/series")
        self.assertEqual(set(series["channels"]), {"alpha_deg", "w", "cl", "cm", "cd"})
        self.assertEqual((series["samples"], series["step_s"]), (1201, summary["step_c_v"]))
        alpha, cm = (series["channels"][name]["value"][-401:] for name in ("alpha_deg", "cm"))
        area = sum(0.5 * (cm[i] + cm[i + 1]) * math.radians(alpha[i + 1] - alpha[i])
                   for i in range(400))
        self.assertAlmostEqual(summary["work"]["pitch"], area, delta=1e-3 * abs(area))
        self.assertGreater(area, 0.005)  # through stall slow pitch is fed
        status, _, _ = d.request("GET", f"/v1/jobs/{job}/modes")
        self.assertEqual(status, 404)

    def test_series(self):
        d = self.start().wait_ready()
        job = d.submit(simulation(duration=1.0))
        d.wait(job)
        path = f"/v1/jobs/{job}/series"
        headers = {"Accept": "text/csv"}
        status, headers, text = d.request("GET", path + "?format=csv", headers=headers)
        self.assertEqual(status, 200)
        self.assertTrue(headers["Content-Type"].startswith("text/csv"))
        rows = text.decode().split("\r\n" if b"\r\n" in text else "\n")
        names = rows[0].split(",")
        self.assertIn("tip_plunge_m", names)
        self.assertIn("modal_amplitude[4]", names)
        samples = [r for r in rows[1:] if r and not r.startswith("#")]
        self.assertEqual(len(samples), 5001)  # more than one stored chunk
        plunge = [float(r.split(",")[names.index("tip_plunge_m")]) for r in samples]
        self.assertEqual(plunge[0], 0.0)
        self.assertGreater(max(abs(v) for v in plunge), 1e-4)

        status, _, part = d.request("GET", path + "?channels=tip_plunge_m&from_s=0.8&to_s=0.9")
        self.assertEqual(status, 200)
        self.assertEqual(part["channels"]["tip_plunge_m"]["value"], plunge[4000:4501])
        status, _, problem = d.request("GET", path + "?channels=lift_n")
        self.assertGreaterEqual(status, 400)
        self.assertIn("lift_n", json.dumps(problem))

    def test_kinds_without_time(self):
        d = self.start().wait_ready()
        case = simulation()
        modes = {k: case[k] for k in ("schema_version", "beam")}
        section = {"schema_version": 1, "kind": "section",
                   "beam": {"section": case["beam"]["section"]}}
        for document in ({**modes, "kind": "modes"}, section):
            job = d.submit(document)
            self.assertEqual(d.wait(job)["state"], "done")
            self.assertEqual(d.request("GET", f"/v1/jobs/{job}/section")[0], 200)
            self.assertEqual(d.request("GET", f"/v1/jobs/{job}/series")[0], 404)

    def test_stability(self):
        """Goland's wing, and a range in which nothing happens."""
        d = self.start().wait_ready()
        case = json.loads((ROOT / "data/cases/goland-stability.json").read_text())
        job = d.submit(case)
        done = d.wait(job)
        self.assertEqual((done["state"], done["verdict"]), ("done", "flutter"))
        status, _, stability = d.request("GET", f"/v1/jobs/{job}/stability")
        self.assertEqual(status, 200)
        self.assertAlmostEqual(stability["flutter"]["speed_m_s"] / 137.2, 1, delta=0.015)
        self.assertAlmostEqual(stability["divergence"]["speed_m_s"] / 252.7, 1, delta=0.005)
        speeds = stability["speeds_m_s"]
        self.assertEqual(len(speeds), case["stability"]["count"])
        for branch in stability["branches"]:
            self.assertEqual(len(branch["frequency_hz"]), len(speeds))
        flutters = stability["branches"][stability["flutter"]["mode"] - 1]
        for speed, ratio in zip(speeds, flutters["damping_ratio"]):
            self.assertEqual(ratio < 0, speed > stability["flutter"]["speed_m_s"], speed)
        self.assertEqual(d.request("GET", f"/v1/jobs/{job}/series")[0], 404)
        case["stability"] = {"from_m_s": 20, "to_m_s": 60}
        calm = d.submit(case)
        self.assertEqual(d.wait(calm)["verdict"], "stable")
        summary = d.request("GET", f"/v1/jobs/{calm}/summary")[2]
        self.assertEqual((summary["flutter"], summary["divergence"]), ("none_in_range", "none_in_range"))
        self.assertGreater(summary["least_damped"]["damping_ratio"], 0)

    def test_static(self):
        """Tip deflection of an isotropic strip against P L^3 / (3 E I)."""
        d = self.start().wait_ready()
        ply = {"material": "aluminium", "thickness_m": 0.004}
        case = {"schema_version": 1, "kind": "static",
                "beam": {"length_m": 0.8, "section": {"type": "strip", "chord_m": 0.05, "layup": [ply]}},
                "loads": {"tip": {"force_y_n": 2}}, "output": {"stress_at_m": [0]}}
        job = d.submit(case)
        self.assertEqual(d.wait(job)["state"], "done")
        status, _, static = d.request("GET", f"/v1/jobs/{job}/static")
        self.assertEqual(status, 200)
        expected = 2 * 0.8 ** 3 / (3 * 70e9 * 0.05 * 0.004 ** 3 / 12)
        self.assertAlmostEqual(static["tip"]["plunge_m"] / expected, 1, places=5)
        self.assertEqual(static["span"]["plunge_m"][-1], static["tip"]["plunge_m"])
        self.assertEqual(len(static["stress"][0]["plies"]), 1)
        self.assertIsNone(static["first_ply_failure"])  # no strengths
        self.assertEqual(d.request("GET", f"/v1/jobs/{job}/summary")[2]["tip"], static["tip"])
        self.assertEqual(d.request("GET", f"/v1/jobs/{job}/modes")[0], 404)
        listed = d.request("GET", "/v1/jobs?kind=static")[2]["jobs"]
        self.assertEqual([j["id"] for j in listed], [job])
        section = {"type": "box", "width_m": 0.1, "height_m": 0.1, "layup": [ply], "walls": {}}
        status, _, problem = d.request("POST", "/v1/jobs", {**case, "beam": {
            "length_m": 1, "section": section}})
        self.assertEqual(status, 422)
        self.assertIn(("/beam/section/layup", "layup_twice"),
                      [(e["pointer"], e["code"]) for e in problem["errors"]])

    def test_batch_is_all_or_nothing(self):
        d = self.start("--workers", "0").wait_ready()
        bad = simulation(speed=3)
        bad["beam"]["length_m"] = -1
        status, _, problem = d.request("POST", "/v1/jobs", {"jobs": [simulation(speed=2), bad]})
        self.assertIn(status, (400, 422))
        self.assertIn("/jobs/1/beam/length_m", [e["pointer"] for e in problem["errors"]])
        self.assertEqual(d.request("GET", "/v1/jobs")[2]["jobs"], [])
        batch = {"jobs": [simulation(speed=2), simulation(speed=3), simulation(speed=2)]}
        status, _, body = d.request("POST", "/v1/jobs", batch)
        self.assertEqual(status, 202)
        self.assertEqual([j["reused"] for j in body["jobs"]], [False, False, True])
        self.assertEqual(body["jobs"][0]["id"], body["jobs"][2]["id"])
        self.assertEqual(len(d.request("GET", "/v1/jobs")[2]["jobs"]), 2)

    def test_cancel_queued_and_running(self):
        d = self.start("--workers", "1").wait_ready()
        running = d.submit(simulation(**LONG))
        d.wait(running, ["running"])
        queued = d.submit(simulation(speed=5))
        status, _, job = d.request("DELETE", "/v1/jobs/" + queued)
        self.assertIn(status, (200, 202))
        self.assertEqual(d.wait(queued)["state"], "cancelled")
        self.assertEqual(d.request("GET", f"/v1/jobs/{queued}/summary")[0], 409)
        progress = d.request("GET", "/v1/jobs/" + running)[2]["progress"]
        self.assertTrue(0 <= progress < 1)
        start = time.monotonic()
        status, _, job = d.request("DELETE", "/v1/jobs/" + running)
        self.assertIn(job["state"], ("cancelling", "cancelled"))
        self.assertEqual(d.wait(running)["state"], "cancelled")
        self.assertLess(time.monotonic() - start, 5)
        self.assertIn(d.request("DELETE", "/v1/jobs/" + running)[0], (200, 202))  # again
        # The worker is free, and a cancelled job answers no equal case.
        again = d.submit(simulation(speed=5))
        self.assertNotEqual(again, queued)
        self.assertEqual(d.wait(again)["state"], "done")

    def test_list_pages_and_filters(self):
        d = self.start("--workers", "0").wait_ready()
        ids = [d.submit(simulation(speed=1 + i)) for i in range(5)]
        seen, path = [], "/v1/jobs?limit=2&state=queued&kind=simulation"
        while path:
            status, headers, page = d.request("GET", path)
            self.assertEqual(status, 200)
            self.assertLessEqual(len(page["jobs"]), 2)
            seen += [j["id"] for j in page["jobs"]]
            link = headers.get("Link")
            path = link[link.index("<") + 1:link.index(">")] if link else None
        self.assertEqual(seen, ids[::-1])
        self.assertEqual(d.request("GET", "/v1/jobs?state=done")[2]["jobs"], [])

    def test_drain_hands_running_jobs_back(self):
        d = self.start("--workers", "1").wait_ready()
        long, short = d.submit(simulation(**LONG)), d.submit(simulation(speed=5))
        d.wait(long, ["running"])
        self.assertEqual(d.stop(signal.SIGINT), 0)
        with sqlite3.connect(d.store) as db:
            rows = db.execute("SELECT id, state, attempt, lost FROM job JOIN queue ON job = seq "
                              "ORDER BY seq").fetchall()
        self.assertEqual(rows, [(long, "queued", 1, 0), (short, "queued", 0, 0)])
        d = self.start("--workers", "1").wait_ready()
        self.assertEqual(d.wait(long, ["running"])["attempt"], 2)
        d.request("DELETE", "/v1/jobs/" + long)
        self.assertEqual(d.wait(short)["state"], "done")
        self.assertEqual(d.stop(), 0)

    def test_second_daemon_is_kept_out(self):
        self.start().wait_ready()
        start = time.monotonic()
        second = self.start()
        self.assertEqual(second.process.wait(timeout=30), 3)
        self.assertLess(time.monotonic() - start, 5)
        self.assertIn("in use by another daemon", second.log())

    def test_full_queue_says_so(self):
        d = self.start("--workers", "0", "--queue-limit", "2").wait_ready()
        for speed in (1, 2):
            d.submit(simulation(speed=speed))
        status, headers, _ = d.request("POST", "/v1/jobs", simulation(speed=3))
        self.assertEqual(status, 503)
        self.assertIn("Retry-After", headers)
        self.assertEqual(d.request("GET", "/readyz")[0], 503)
        self.assertEqual(d.request("GET", "/healthz")[0], 200)

    def test_files_that_cannot_grow(self):
        """Writes fail while the process lives: refused with 5xx, nothing acknowledged is lost."""
        size = 4 << 20
        d = self.start("--workers", "0", limit=lambda: resource.setrlimit(
            resource.RLIMIT_FSIZE, (size, size))).wait_ready()
        accepted, status = [], 202
        while status == 202 and len(accepted) < 2000:
            status, _, body = d.request("POST", "/v1/jobs", simulation(1 + 0.01 * len(accepted)))
            if status == 202:
                accepted.append(body["id"])
        self.assertIn(status, (500, 503, 507))
        self.assertGreater(len(accepted), 5)
        self.assertEqual(d.request("GET", "/healthz")[0], 200)
        self.assertEqual(d.request("GET", "/v1/jobs/" + accepted[-1])[0], 200)
        d.stop()
        d = self.start("--workers", "0").wait_ready()
        for job in accepted:
            self.assertEqual(d.request("GET", "/v1/jobs/" + job)[0], 200)
        self.assertEqual(len(d.request("GET", "/v1/jobs?limit=1000")[2]["jobs"]), len(accepted))
        self.assertEqual(d.request("POST", "/v1/jobs", simulation(99))[0], 202)

    def test_many_clients(self):
        d = self.start().wait_ready()
        failures, lock = [], threading.Lock()

        def client(first):
            try:
                for i in range(10):
                    job = d.submit(simulation(speed=2 + 0.01 * (first + i), duration=0.002))
                    body = d.wait(job)
                    if body["state"] != "done":
                        raise AssertionError(body)
            except Exception as error:  # reported by the main thread
                with lock:
                    failures.append(error)

        threads = [threading.Thread(target=client, args=(10 * k,)) for k in range(8)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        self.assertEqual(failures, [])
        self.assertEqual(d.stop(), 0)
