#!/usr/bin/env python3
"""The paper's damping map through HTTP: 37 fibre angles x 29 speeds x 3 s (16 elements, 4 modes, lifting
line, network), computed by a daemon of its own with one and with two workers. Prints wall-clock and
processor seconds, the scaling, and what a cell costs beside its own computation.

Usage: bench_map.py [--bin build/release/bin] [--angles 37] [--speeds 29] [--workers 1,2] [--dynamic network]

`network` has the paper's size (4-50-2) and small outputs, its cost is that of a trained one; `plate-4pct` is the shipped one,
with its lags and dynamic stall below it; other words are types of the dynamic part. Wall-clock
seconds mean something on a machine that does nothing else; processor seconds always."""

import argparse
import json
import os
import random
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from daemon import Daemon  # noqa: E402

POLL_S = 0.2
SHIPPED = "plate-4pct"


def network():
    draw = random.Random(1)

    def matrix(rows, columns):
        return [[draw.uniform(-1, 1) for _ in range(columns)] for _ in range(rows)]

    return {"name": "bench", "activation": "tanh",
            "inputs": ["mean_alpha", "delta_alpha", "alpha_rate", "alpha_acceleration"],
            "outputs": ["cl", "cm"], "hidden": 50, "input_offset": [0] * 4, "input_scale": [0.2] * 4,
            "output_offset": [0, 0], "output_scale": [2e-4, 2e-4], "hull_min": [-1] * 4, "hull_max": [1] * 4,
            "w1": matrix(50, 4), "b1": matrix(1, 50)[0], "w2": matrix(2, 50), "b2": [0, 0]}


def study(angles, speeds, dynamic):
    case = json.loads((ROOT / "data/cases/paper-beam.json").read_text(encoding="utf-8"))
    if dynamic == "network":
        case["networks"] = [network()]
        case["aerodynamics"]["dynamic"] = {"type": "network", "name": "bench"}
    elif dynamic == SHIPPED:
        case["aerodynamics"]["dynamic"] = {"type": "network", "name": SHIPPED}
    else:
        case["aerodynamics"]["dynamic"] = {"type": dynamic}
    return {"schema_version": 1, "kind": "study", "type": "grid", "name": "map", "case": case, "vary": [
        {"pointer": "/beam/section/layup/0/angle_deg", "from": -90, "to": 90, "count": angles},
        {"pointer": "/flow/speed_m_s", "from": 2, "to": 9, "count": speeds}]}


def processor_seconds(pid):
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def own_seconds(daemon, job, cells):
    """What the cells say they cost, added up, and the steps they took."""
    cpu = steps = 0
    for n in range(cells):
        summary = daemon.request("GET", f"/v1/studies/{job}/cells/{n}")[2]["summary"]
        cpu += summary["timing"]["cpu_s"]
        steps += summary["timing"]["steps"]
    return cpu, steps


def measure(binary, body, workers):
    with tempfile.TemporaryDirectory(prefix="aerom-map-") as folder:
        daemon = Daemon(folder, "--workers", str(workers), program=str(Path(binary) / "aeromd")).wait_ready()
        try:
            idle, start = processor_seconds(daemon.process.pid), time.monotonic()
            status, _, answer = daemon.request("POST", "/v1/studies", body)
            assert status in (200, 202), answer
            while daemon.request("GET", "/v1/studies/" + answer["id"])[2]["state"] in ("queued", "running"):
                time.sleep(POLL_S)
            wall, used = time.monotonic() - start, processor_seconds(daemon.process.pid) - idle
            state = daemon.request("GET", "/v1/studies/" + answer["id"])[2]
            assert state["state"] == "done", state
            cells = body["vary"][0]["count"] * body["vary"][1]["count"]
            own, steps = own_seconds(daemon, answer["id"], cells)
        finally:
            daemon.stop()
    return {"workers": workers, "cells": cells, "steps": steps, "wall": wall, "cpu": used, "own": own}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", default="build/release/bin")
    parser.add_argument("--angles", type=int, default=37)
    parser.add_argument("--speeds", type=int, default=29)
    parser.add_argument("--workers", default="1,2")
    parser.add_argument("--dynamic", default="network")
    parser.add_argument("--json", action="store_true", help="one JSON document instead of text")
    given = parser.parse_args()
    body = study(given.angles, given.speeds, given.dynamic)
    load = os.getloadavg()[0]
    rows = [measure(given.bin, body, int(w)) for w in given.workers.split(",")]
    if given.json:
        print(json.dumps({"load_before": load, "dynamic": given.dynamic, "runs": rows}))
        return
    print(f"load before {load:.1f}; {rows[0]['cells']} cells, {rows[0]['steps']} steps, {given.dynamic}")
    for r in rows:
        print(f"{r['workers']} worker(s): wall {r['wall']:.1f} s, processor {r['cpu']:.1f} s, of it "
              f"{r['own']:.1f} s in the cells ({1e6 * r['own'] / r['steps']:.2f} us a step); "
              f"overhead {100 * (r['cpu'] / r['own'] - 1):.1f} %, "
              f"faster than the first by {rows[0]['wall'] / r['wall']:.2f}")


if __name__ == "__main__":
    main()
