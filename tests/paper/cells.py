"""The paper's beam as cases and studies of a daemon of its own. Python 3 standard library."""

import copy
import json
import math
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
import daemon  # noqa: E402

CASE = ROOT / "data" / "cases" / "paper-beam.json"
ANGLE, SPEED, DYNAMIC = "/beam/section/layup/0/angle_deg", "/flow/speed_m_s", "/aerodynamics/dynamic"
# E* of the paper's beam at 1 m/s: E_l of Table 1, thickness over chord, density of the air.
E_STAR_1 = 141.96e9 * 0.04 ** 3 / (0.5 * 1.225)


def speed_of(e_star):
    return math.sqrt(E_STAR_1 / e_star)


def e_star_of(speed):
    return E_STAR_1 / speed ** 2


def put(document, pointer, value):
    """Sets the member a JSON pointer leads to, making objects on the way."""
    *path, last = pointer.strip("/").split("/")
    for key in path:
        document = document[int(key)] if isinstance(document, list) else document.setdefault(key, {})
    document[int(last) if isinstance(document, list) else last] = value


def case_of(changes):
    """The paper's beam at 5 deg with changes (pointer, value)."""
    case = copy.deepcopy(json.loads(CASE.read_text(encoding="utf-8")))
    case["name"] = ""
    put(case, "/solver/stop", {"plunge_max_lengths": 5})
    for pointer, value in changes:
        put(case, pointer, value)
    return case


def axis(pointer, values):
    return {"pointer": pointer, "values": list(values)}


class Service:
    """A daemon in a folder that goes with it."""

    def __init__(self, aeromd, workers):
        self.folder = tempfile.TemporaryDirectory()
        self.daemon = daemon.Daemon(self.folder.name, "--workers", str(workers), program=aeromd).wait_ready()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.daemon.stop()
        self.folder.cleanup()

    def get(self, path):
        status, _, body = self.daemon.request("GET", path)
        if status != 200:
            raise RuntimeError("%s: %s %s" % (path, status, body))
        return body

    def submit(self, path, document):
        """Posts a job or a study and waits for its end: its path."""
        status, _, body = self.daemon.request("POST", path, document)
        if status not in (200, 202):
            raise RuntimeError("%s: %s" % (status, json.dumps(body)[:2000]))
        item = "%s/%s" % (path, body["id"])
        while True:
            state = self.get(item)["state"]
            if state == "done":
                return item
            if state in ("failed", "cancelled"):
                raise RuntimeError("%s: %s" % (item, self.get(item)))
            time.sleep(0.2)

    def study(self, kind, changes, **members):
        """Path of a finished study of the changed case."""
        return self.submit("/v1/studies", {"schema_version": 1, "kind": "study", "type": kind, "name": "",
                                           "case": case_of(changes), **members})

    def grid(self, changes, axes, values):
        """{value: nested lists} of a grid."""
        item = self.study("grid", changes, vary=[axis(*a) for a in axes])
        return {value: self.get("%s/map?value=%s" % (item, value))["values"] for value in values}
