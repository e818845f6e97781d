"""kill -9 while jobs are submitted and run: nothing acknowledged is lost, nothing is done twice."""
import http.client
import random
import sqlite3
import threading
import time

from daemon import DaemonTest, simulation

ROUNDS = 20
JOBS_A_ROUND = 6


class Kill(DaemonTest):
    def calibrate(self):
        """Simulated seconds that take about 60 ms in this build."""
        d = self.start("--workers", "1").wait_ready()
        d.wait(d.submit(simulation(speed=4.0, duration=0.05)))
        job = d.submit(simulation(speed=4.1, duration=0.05))
        d.wait(job)
        cpu = d.request("GET", f"/v1/jobs/{job}/summary")[2]["timing"]["cpu_s"]
        d.stop()
        return min(max(round(0.05 * 0.06 / cpu, 3), 0.01), 3.0)

    def submit_until_killed(self, daemon, duration, first, accepted):
        for i in range(JOBS_A_ROUND):
            try:
                accepted.append(daemon.submit(simulation(5 + 0.001 * (first + i), duration)))
            except (OSError, http.client.HTTPException, ValueError):
                return  # killed before it answered: not acknowledged

    def test_rounds(self):
        chance = random.Random(20260101)
        duration = self.calibrate()
        accepted = []
        for k in range(ROUNDS):
            d = self.start().wait_ready()
            client = threading.Thread(target=self.submit_until_killed,
                                      args=(d, duration, k * JOBS_A_ROUND, accepted))
            client.start()
            time.sleep(chance.uniform(0.0, 0.25))
            d.kill()
            client.join()
        d = self.start().wait_ready()
        for job in accepted:
            self.assertEqual(d.wait(job)["state"], "done")
        for job in d.request("GET", "/v1/jobs?limit=1000")[2]["jobs"]:
            d.wait(job["id"])  # also those whose acknowledgement was cut off
        self.assertEqual(d.stop(), 0)
        self.check_database(d.store, accepted)

    def check_database(self, path, accepted):
        db = sqlite3.connect(path)
        self.assertEqual(db.execute("PRAGMA quick_check").fetchall(), [("ok",)])
        self.assertEqual(db.execute("PRAGMA foreign_key_check").fetchall(), [])
        self.assertEqual(len(set(accepted)), len(accepted))
        done = dict(db.execute("SELECT id, attempt FROM job JOIN result ON result.job = seq "
                               "WHERE state = 'done' AND result.fence = job.attempt").fetchall())
        self.assertEqual(set(accepted) - set(done), set())  # each once, by its last claim
        # Those whose acknowledgement was cut off are also done once, and nothing else exists.
        self.assertEqual(db.execute("SELECT count(*) FROM job").fetchone()[0], len(done))
        self.assertEqual(db.execute("SELECT count(*) FROM result").fetchone()[0], len(done))
        self.assertEqual(db.execute("SELECT count(*) FROM queue").fetchone()[0], 0)
        self.assertEqual(db.execute("SELECT count(DISTINCT job) FROM series").fetchone()[0],
                         len(done))
        documents = db.execute("SELECT DISTINCT n FROM (SELECT count(*) AS n FROM document "
                               "GROUP BY job)").fetchall()
        self.assertEqual(documents, [(5,)])
        db.close()
        # The test is worth something only if jobs were cut off.
        self.assertGreater(sum(1 for attempt in done.values() if attempt > 1), 0)
        print(f"{len(accepted)} accepted, {len(done)} done, "
              f"{sum(attempt - 1 for attempt in done.values())} runs cut off by {ROUNDS} kills")
