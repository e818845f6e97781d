#!/usr/bin/env python3
"""What a cell of a study costs beside its own computation, by kind of case: processor milliseconds of a daemon with one
worker, through HTTP, from the answer to the submission to the end. Python 3 standard library.

Usage: bench_cells.py [--bin build/release/bin] [--json]"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import bench_map
from daemon import Daemon

ROOT = bench_map.ROOT
ANGLE = "/beam/section/layup/0/angle_deg"
# Kind, example case, cells; all are varied over the fibre angle.
KINDS = (("section", "paper-section", 6000), ("modes", "paper-section", 3000), ("stability", "paper-beam-stability", 300),
         ("simulation", "paper-beam-network", 60))
POLL_S = 0.5


def study(kind, name, cells):
    case = json.loads((ROOT / "data/cases" / (name + ".json")).read_text(encoding="utf-8"))
    case["kind"] = kind
    if kind == "modes":
        case["beam"].update(length_m=0.37, elements=16)
    return {"schema_version": 1, "kind": "study", "type": "grid", "case": case,
            "vary": [{"pointer": ANGLE, "from": -90, "to": 90, "count": cells}]}


def measure(binary, kind, name, cells):
    with tempfile.TemporaryDirectory(prefix="aerom-cells-") as folder:
        daemon = Daemon(folder, "--workers", "1", program=str(Path(binary) / "aeromd")).wait_ready()
        try:
            status, _, answer = daemon.request("POST", "/v1/studies", study(kind, name, cells))
            assert status in (200, 202), answer
            start, path = bench_map.processor_seconds(daemon.process.pid), "/v1/studies/" + answer["id"]
            while daemon.request("GET", path)[2]["state"] in ("queued", "running"):
                time.sleep(POLL_S)
            used, state = bench_map.processor_seconds(daemon.process.pid) - start, daemon.request("GET", path)[2]
            assert state["state"] == "done" and state["cells"]["failed"] == 0, state
        finally:
            daemon.stop()
    own = state["cpu_s"]
    return {"kind": kind, "cells": cells, "own_ms": 1e3 * own / cells, "beside_ms": 1e3 * (used - own) / cells}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", default="build/release/bin")
    parser.add_argument("--json", action="store_true", help="one JSON document instead of text")
    given = parser.parse_args()
    rows = [measure(given.bin, *kind) for kind in KINDS]
    if given.json:
        print(json.dumps(rows))
        return
    for r in rows:
        print(f"{r['kind']:12} {r['cells']:6} cells  {r['own_ms']:8.3f} ms a cell, {r['beside_ms']:6.3f} ms beside it "
              f"({100 * r['beside_ms'] / r['own_ms']:.1f} %)")


if __name__ == "__main__":
    sys.exit(main())
