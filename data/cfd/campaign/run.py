#!/usr/bin/env python3
"""Computes the runs of ../design.csv that are not there yet, in their order.

    run.py [--work DIR] [--jobs N] [--only REGEX] [--limit N]

Needs OpenFOAM 1912 (Debian package `openfoam`). Everything is computed below --work, outside the source
tree; a finished run leaves NAME.csv and NAME.json in DIR/done, whence `collect.py` takes them. Runs in
DIR/done or in ../index.csv are skipped, so that the same command resumes. A run that diverges is
repeated once at half the step; one that diverges again is recorded as failed. The design is read again
before every run. To stop, press Ctrl-C or end the whole process group; what is under way is dropped.
"""

import argparse
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import case
import record

HERE = Path(__file__).resolve().parent
DESIGN = HERE.parent / "design.csv"
INDEX = HERE.parent / "index.csv"
START_FIELDS = ("U", "p", "k", "omega", "nut")


class Solver:
    """Runs programs of OpenFOAM in its own environment and adds up their processor time."""

    def __init__(self, shell_setup):
        self.shell_setup = shell_setup
        self.core_s = 0.0

    def run(self, folder, program):
        """True when the program ended well; what it said is in FOLDER/log.PROGRAM."""
        command = ". %s >/dev/null 2>&1; exec %s" % (self.shell_setup, program)
        with open(folder / ("log." + program), "wb") as log:
            process = subprocess.Popen(["bash", "-c", command], cwd=folder, stdout=log,
                                       stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.core_s += usage.ru_utime + usage.ru_stime
        return process.returncode == 0


def attempt(row, step, folder, solver):
    """One run at one step: its samples. Raises record.Diverged."""
    steady, transient = folder / "steady", folder / "transient"
    shutil.rmtree(folder, ignore_errors=True)
    case.write_steady(steady, row)
    for program in ("blockMesh", "simpleFoam"):
        if not solver.run(steady, program):
            raise record.Diverged("%s failed on the steady start" % program)
    case.write_transient(transient, row, step)
    if not solver.run(transient, "blockMesh"):
        raise record.Diverged("blockMesh failed")
    for name in START_FIELDS:
        shutil.copyfile(steady / str(case.STEADY_ITERATIONS) / name, transient / "0" / name)
    if not solver.run(transient, "pimpleFoam"):
        raise record.Diverged("pimpleFoam stopped at t = %s" % last_time(transient))
    lines = record.coefficients(transient / "postProcessing/coefficients/0/coefficient.dat")
    return record.samples(row, lines)


def last_time(folder):
    times = re.findall(r"^Time = (\S+)", (folder / "log.pimpleFoam").read_text(errors="replace"), re.M)
    return times[-1] if times else "0"


def solver_version(folder):
    log = folder / "transient/log.pimpleFoam"
    match = re.search(r"^Build\s*:\s*(.+)$", log.read_text(errors="replace"), re.M) if log.exists() else None
    return "OpenFOAM " + match.group(1).strip() if match else "unknown"


def courant_max(folder):
    """Largest Courant number of the run that gave the record."""
    text = (folder / "transient/log.pimpleFoam").read_text(errors="replace")
    return max(map(float, re.findall(r"Courant Number mean: \S+ max: (\S+)", text)), default=0.0)


def compute(row, work, shell_setup):
    """Computes one run and puts its record and its account into WORK/done, the account last."""
    folder, done = work / "running" / row["name"], work / "done"
    solver, notes, rows = Solver(shell_setup), [], None
    step = float(row["step"])
    for step in (step, 0.5 * step):
        try:
            rows = attempt(row, step, folder, solver)
            break
        except record.Diverged as error:
            notes.append("step %g: %s" % (step, error))
    account = {
        "name": row["name"], "status": "failed" if rows is None else "done", "step_used": step,
        "samples": len(rows or ()), "core_s": round(solver.core_s, 1),
        "courant_max": round(courant_max(folder), 1) if rows else 0.0,
        "solver": solver_version(folder), "note": "; ".join(notes), "settings": row}
    if rows is not None:
        publish(done / (row["name"] + ".csv"), record.text_of(rows))
    publish(done / (row["name"] + ".json"), json.dumps(account, indent=1) + "\n")
    if rows is None:
        (work / "failed").mkdir(exist_ok=True)
        shutil.rmtree(work / "failed" / row["name"], ignore_errors=True)
        folder.rename(work / "failed" / row["name"])
    else:
        shutil.rmtree(folder)
    return account


def publish(path, text):
    """The file appears whole or not at all."""
    draft = path.with_suffix(path.suffix + ".draft")
    draft.write_text(text, encoding="ascii")
    draft.rename(path)


def pending(work, only):
    """Rows of the design without a record, in order."""
    known = {path.stem for path in (work / "done").glob("*.json")}
    if INDEX.exists():
        with open(INDEX, newline="", encoding="ascii") as file:
            known.update(row["name"] for row in csv.DictReader(file))
    with open(DESIGN, newline="", encoding="ascii") as file:
        return [row for row in csv.DictReader(file)
                if row["name"] not in known and re.search(only, row["name"])]


class Queue:
    """Hands out the pending runs, each once, at most `limit`; any thread."""

    def __init__(self, work, only, limit):
        self.work, self.only, self.left = work, only, limit
        self.lock = threading.Lock()  # guards `left` and `taken`
        self.taken = set()

    def take(self):
        """The next run, or None when there is none."""
        with self.lock:
            rows = [row for row in pending(self.work, self.only) if row["name"] not in self.taken]
            if not rows or self.left == 0:
                return None
            self.taken.add(rows[0]["name"])
            self.left = None if self.left is None else self.left - 1
            return rows[0]


def worker(queue, shell_setup):
    while (row := queue.take()) is not None:
        account = compute(row, queue.work, shell_setup)
        print("%s %s: %.0f core-s, step %g, Courant number %g %s" % (
            account["status"], row["name"], account["core_s"], account["step_used"],
            account["courant_max"], account["note"]), flush=True)


def options_of(description):
    """Options of every runner."""
    parser = argparse.ArgumentParser(description=description.split("\n", 1)[0])
    parser.add_argument("--work", type=Path, default=Path("/var/tmp/aeromd-cfd"),
                        help="folder to compute in (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, one core each")
    parser.add_argument("--only", default="", metavar="REGEX", help="only runs whose name matches")
    return parser


def side_by_side(jobs, work):
    """Calls work() in `jobs` threads and waits for them; Ctrl-C ends them all."""
    threads = [threading.Thread(target=work, daemon=True) for _ in range(jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def main():
    parser = options_of(__doc__)
    parser.add_argument("--limit", type=int, default=None, metavar="N", help="stop after N runs")
    parser.add_argument("--setup", default="/usr/share/openfoam/etc/bashrc", metavar="FILE",
                        help="shell set-up of OpenFOAM (default: %(default)s)")
    arguments = parser.parse_args()
    (arguments.work / "done").mkdir(parents=True, exist_ok=True)
    queue = Queue(arguments.work, arguments.only, arguments.limit)
    side_by_side(arguments.jobs, lambda: worker(queue, arguments.setup))
    return 0


if __name__ == "__main__":
    sys.exit(main())
