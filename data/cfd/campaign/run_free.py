#!/usr/bin/env python3
"""Computes the sections on springs of ../free/design.csv that are not there yet, in their order.

    run_free.py [--work DIR] [--jobs N] [--only REGEX]

As run.py: everything is computed below --work, and a finished run leaves its record in ../free/records and
its line in ../free/index.csv. The solver's own rigid body moves the section: explicit, so that the loads
come one step late (`free_case.py`)."""

import math
import re
import shutil
import sys
import threading
from pathlib import Path

import case
import free_case
import record
from collect import read_table, text_of
from run import (START_FIELDS, Solver, courant_max, last_time, options_of, publish, side_by_side,
                 solver_version)

FREE = Path(__file__).resolve().parents[1] / "free"
DESIGN, INDEX, RECORDS = FREE / "design.csv", FREE / "index.csv", FREE / "records"
COLUMNS = ("t", "alpha_deg", "alpha_dot", "w", "w_dot", "cl", "cd", "cm")
DIGITS = (2, 4, 6, 6, 6, 5, 5, 5)
INTERVAL = 0.2  # [c/V] between two samples: a fiftieth of a period
RESULT_COLUMNS = ("status", "samples", "core_s", "courant_max", "solver", "note")


def sample_number(t):
    """Of a time at which the prescribed records have a line, else None: the solver writes every step."""
    index = round(t / case.FORCE_INTERVAL)
    return index if abs(t - index * case.FORCE_INTERVAL) < 1e-6 else None


def motion_lines(path):
    """t -> (angle [deg] nose-up off the mean, its rate [rad], plunge, its rate) of the solver's log."""
    result = {}
    for line in path.read_text(encoding="ascii").splitlines():
        if not line.startswith("#"):
            v = [float(word) for word in re.sub("[()]", " ", line).split()]
            # Time, centre of rotation, centre of mass, rotation and velocity, rotation rate: [deg].
            result[sample_number(v[0])] = (-v[9], -math.radians(v[15]), v[5], v[11])
    return result


def samples(row, coefficients, motion):
    stride, result = round(INTERVAL / case.FORCE_INTERVAL), []
    for t, cl, cd, cm in coefficients:
        index = sample_number(t)
        if index is None or index % stride or index not in motion:
            continue
        angle, rate, w, w_rate = motion[index]
        if not all(abs(value) < record.COEFFICIENT_MAX for value in (cl, cd, cm)):
            raise record.Diverged("coefficients beyond %g at t = %g" % (record.COEFFICIENT_MAX, t))
        # The solver's reference point stays where it is: the moment moves with the section.
        result.append((t, float(row["mean_deg"]) + angle, rate, w, w_rate, cl, cd, cm - w * cd))
    return result


def attempt(row, folder, solver):
    steady, transient = folder / "steady", folder / "transient"
    shutil.rmtree(folder, ignore_errors=True)
    flow = dict(row, pitch="", plunge="", plunge_c="0")
    case.write_steady(steady, flow)
    free_case.write_transient(transient, row, float(row["step"]))
    for place, program in ((steady, "blockMesh"), (steady, "simpleFoam"), (transient, "blockMesh")):
        if not solver.run(place, program):
            raise record.Diverged("%s failed" % program)
    for name in START_FIELDS:
        shutil.copyfile(steady / str(case.STEADY_ITERATIONS) / name, transient / "0" / name)
    ended = solver.run(transient, "pimpleFoam")
    found = transient / "postProcessing"
    rows = samples(row, record.coefficients(found / "coefficients/0/coefficient.dat"),
                   motion_lines(found / "motion/0/sixDoFRigidBodyState.dat"))
    return rows, "" if ended else "the mesh or the solver gave up at t = %s" % last_time(transient)


def compute(row, work, lock):
    folder, solver, rows = work / "free" / row["name"], Solver("/usr/share/openfoam/etc/bashrc"), []
    try:
        rows, note = attempt(row, folder, solver)
        status = "ended" if note else "done"
    except record.Diverged as error:
        note, status = str(error), "failed"
    line = dict(row, status=status, samples=str(len(rows)), core_s="%.1f" % solver.core_s,
                courant_max="%.1f" % (courant_max(folder) if rows else 0.0),
                solver=solver_version(folder), note=note)
    with lock:
        if rows:
            RECORDS.mkdir(exist_ok=True)
            publish(RECORDS / (row["name"] + ".csv"), "\n".join(
                [",".join(COLUMNS)] + [",".join(map(record.number, v, DIGITS)) for v in rows]) + "\n")
        known = {r["name"]: r for r in (read_table(INDEX) if INDEX.exists() else [])}
        known[row["name"]] = line
        ordered = [known[r["name"]] for r in read_table(DESIGN) if r["name"] in known]
        publish(INDEX, text_of(tuple(row) + RESULT_COLUMNS, ordered))
    print("%(status)s %(name)s: %(core_s)s core-s %(note)s" % line, flush=True)


def main():
    arguments = options_of(__doc__).parse_args()
    known = {row["name"] for row in read_table(INDEX)} if INDEX.exists() else set()
    waiting = [row for row in read_table(DESIGN)
               if row["name"] not in known and re.search(arguments.only, row["name"])]
    lock, waiting_lock = threading.Lock(), threading.Lock()

    def worker():
        while True:
            with waiting_lock:
                if not waiting:
                    return
                row = waiting.pop(0)
            compute(row, arguments.work, lock)

    side_by_side(arguments.jobs, worker)
    return 0


if __name__ == "__main__":
    sys.exit(main())
