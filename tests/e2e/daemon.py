"""Starts and talks to a real aeromd; checks at the end that no sanitizer has complained."""
import http.client
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

AEROMD = os.environ.get("AEROMD", "aeromd")
SANITIZER = re.compile(r"(WARNING: ThreadSanitizer|ERROR: (Address|Leak)Sanitizer|runtime error:)")


class Daemon:
    """One process on port 0; `log` collects what it writes to stderr."""

    def __init__(self, directory, *flags, env=None, limit=None, program=AEROMD):
        self.log_path = os.path.join(directory, f"log-{time.monotonic_ns()}")
        self.store = os.path.join(directory, "a.db")
        command = [program, "--listen", "127.0.0.1:0", "--store", "sqlite:" + self.store,
                   "--disk-reserve-mb", "1", *flags]
        with open(self.log_path, "wb") as log:
            self.process = subprocess.Popen(command, stderr=log, preexec_fn=limit,
                                            env={**os.environ, **(env or {})})
        self.port = None

    def log(self):
        with open(self.log_path, errors="replace") as f:
            return f.read()

    def wait_log(self, text, seconds=10):
        """A line is written after what it reports has happened: wait for it."""
        end = time.monotonic() + seconds
        while text not in self.log():
            assert time.monotonic() < end, f"no '{text}' in {self.log()}"
            time.sleep(0.01)

    def wait_ready(self, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = re.search(r"listening url=http://127\.0\.0\.1:(\d+)", self.log())
            if found:
                self.port = int(found.group(1))
                return self
            if self.process.poll() is not None:
                raise AssertionError(f"daemon ended with {self.process.returncode}: {self.log()}")
            time.sleep(0.01)
        raise AssertionError("daemon did not start: " + self.log())

    def request(self, method, path, body=None, headers=None):
        """(status, headers, body); a JSON body comes back decoded."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            if body is not None and not isinstance(body, (bytes, str)):
                body = json.dumps(body)
            if body is not None:
                headers = {"Content-Type": "application/json", **(headers or {})}
            connection.request(method, path, body=body, headers=headers or {})
            response = connection.getresponse()
            data = response.read()
            kind = response.getheader("Content-Type", "")
            if "json" in kind and data:
                data = json.loads(data)
            return response.status, response.headers, data
        finally:
            connection.close()

    def submit(self, case):
        status, _, body = self.request("POST", "/v1/jobs", case)
        assert status in (200, 202), (status, body)
        return body["id"]

    def wait(self, job, states=("done", "failed", "cancelled"), seconds=120):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            status, _, body = self.request("GET", "/v1/jobs/" + job)
            assert status == 200, (status, body)
            if body["state"] in states:
                return body
            time.sleep(0.01)
        raise AssertionError(f"job {job} is still {body['state']}: {self.log()}")

    def kill(self):
        self.process.kill()
        self.process.wait()

    def stop(self, signal_number=signal.SIGTERM):
        """Drains; the exit code."""
        if self.process.poll() is None:
            self.process.send_signal(signal_number)
        return self.process.wait(timeout=60)


class DaemonTest(unittest.TestCase):
    """A temporary directory and the daemons started in it."""

    def setUp(self):
        self.directory = tempfile.mkdtemp(prefix="aerom-e2e-")
        self.daemons = []

    def start(self, *flags, **options):
        daemon = Daemon(self.directory, *flags, **options)
        self.daemons.append(daemon)
        return daemon

    def tearDown(self):
        for daemon in self.daemons:
            if daemon.process.poll() is None:
                daemon.kill()
        logs = [daemon.log() for daemon in self.daemons]
        shutil.rmtree(self.directory)
        for log in logs:
            self.assertIsNone(SANITIZER.search(log), log)


def simulation(speed=6.0, duration=0.02, **solver):
    """The paper's beam with a short record."""
    return {
        "schema_version": 1, "kind": "simulation", "name": "e2e",
        "beam": {"length_m": 0.37, "elements": 16,
                 "section": {"type": "strip", "chord_m": 0.1, "layup": [
                     {"material": "AS4/3501-6", "angle_deg": -45, "thickness_m": 0.00013},
                     {"material": "foam", "thickness_m": 0.00387}]}},
        "flow": {"speed_m_s": speed, "incidence_deg": 5},
        "aerodynamics": {"polar": "plate-4pct-channel"},
        "solver": {"modes": 4, "time_step_s": 2e-4, "duration_s": duration, **solver},
        "output": {"channels": ["tip_plunge_m", "tip_twist_deg", "modal_amplitude"]},
    }
