#!/usr/bin/env python3
"""Takes finished runs into the tree: records into ../records, one line each into ../index.csv.

    collect.py [--work DIR]

A run whose settings are no longer those of ../design.csv is refused."""

import argparse
import csv
import json
import shutil
import sys
from pathlib import Path

import record
from run import DESIGN, INDEX, publish

RECORDS = INDEX.parent / "records"
RESULT_COLUMNS = ("status", "step_used", "interval", "samples", "core_s", "courant_max", "solver",
                  "note")


def read_table(path):
    with open(path, newline="", encoding="ascii") as file:
        return list(csv.DictReader(file))


def index_row(account):
    row = dict(account["settings"])
    row.update({key: account[key] for key in RESULT_COLUMNS if key in account})
    row["interval"] = record.interval_of(row)
    return {key: str(value) for key, value in row.items()}


def text_of(columns, rows):
    lines = [",".join(columns)]
    for row in rows:
        cells = [row[column] for column in columns]
        lines.append(",".join('"%s"' % c.replace('"', "'") if "," in c else c for c in cells))
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--work", type=Path, default=Path("/var/tmp/aeromd-cfd"),
                        help="folder the runs were computed in (default: %(default)s)")
    done = parser.parse_args().work / "done"
    design = read_table(DESIGN)
    by_name = {row["name"]: row for row in design}
    known = {row["name"]: row for row in read_table(INDEX)} if INDEX.exists() else {}
    RECORDS.mkdir(exist_ok=True)
    added = 0
    for path in sorted(done.glob("*.json")):
        account = json.loads(path.read_text(encoding="ascii"))
        name = account["name"]
        if name in known:
            continue
        if by_name.get(name) != account["settings"]:
            print("%s: not a run of the present design, left out" % name, file=sys.stderr)
            continue
        if account["status"] == "done":
            shutil.copyfile(done / (name + ".csv"), RECORDS / (name + ".csv"))
        known[name] = index_row(account)
        added += 1
    rows = [known[row["name"]] for row in design if row["name"] in known]
    publish(INDEX, text_of(tuple(design[0]) + RESULT_COLUMNS, rows))
    print("%d added, %d of %d runs in the index" % (added, len(rows), len(design)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
