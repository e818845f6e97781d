#!/usr/bin/env python3
"""Builds docs/NETWORKS.md, its drawings and tables: how networks of several sizes and kinds learn the records of
data/cfd (App. B of the paper).

    build_networks.py [--program build/release/bin/network_study] [--draws 6]
    build_networks.py --redraw        from the tables in docs/networks, without training

Python 3 standard library."""

import argparse
import statistics
import subprocess
import sys
from pathlib import Path

import drawings
from study import COLUMNS, FOLDER, MEMORY, NAMES, NETWORKS, PAPER, Study, of, parse, quantile, read, write

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "NETWORKS.md"
def run(program, draws):
    """{table: rows of text} of a new study. What needs few digits keeps few."""
    lines = subprocess.run([program, str(ROOT / "data" / "cfd"), str(draws)], check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    tables = {kind: [] for kind in COLUMNS}
    for line in lines:
        kind, *cells = line.split(",")
        tables[kind].append(cells)
    drawn = {name for _, name in drawings.examples(parse("cycle", tables["cycle"]))}
    tables["cycle"] = [row for row in tables["cycle"]
                       if row[2] in drawn and (row[0], int(row[1])) in drawings.DRAWN]
    return tables


def percent(value):
    return "%.0f %%" % (100.0 * value + 0.0)


def neuron_table(study):
    yield ("| neurons | weights | epoch kept | mean square error, trained and held out | rms c_l, c_m held out "
           "| energy error trained | energy error held out | of the mean size |")
    yield "|---|---|---|---|---|---|---|---|"
    for network in NETWORKS:
        cells = [NAMES.get(network, "%d" % network[1]), "%d" % study.median(network, "weights"),
                 "%.0f" % study.median(network, "kept"),
                 "%.2f, %.2f" % (study.median(network, "trained"), study.median(network, "held")),
                 ", ".join(percent(statistics.median(study.misfits(network, "held", c))) for c in ("cl", "cm"))]
        for part in ("trained", "held"):
            errors = study.energy_errors(network, part)
            cells.append("%s (%s to %s)" % tuple(percent(quantile(errors, q)) for q in (0.5, 0.25, 0.75)))
        cells.append(", ".join(percent(study.energy_share(network, part)) for part in ("trained", "held")))
        yield "| " + " | ".join(cells) + " |"
    steady = [statistics.median(study.records[e["record"]]["steady_" + c] / study.records[e["record"]]["range_" + c]
                                for e in of(study.tables["error"], PAPER, part="held")) for c in ("cl", "cm")]
    yield "| none: the polar alone | | | | %s | -100 %% | -100 %% | 100 %%, 100 %% |" % ", ".join(
        percent(s) for s in steady)


def memory_table(study):
    yield "| | weights | rms c_l, c_m trained | rms c_l, c_m held out | training [s] | 1 section [ns] | 8 sections, each [ns] |"
    yield "|---|---|---|---|---|---|---|"
    for network in (PAPER, ("adam", 50), MEMORY):
        cells = [NAMES.get(network, "50, Levenberg-Marquardt"), "%d" % study.median(network, "weights")]
        cells += [", ".join(percent(statistics.median(study.misfits(network, part, c))) for c in ("cl", "cm"))
                  for part in ("trained", "held")]
        cells.append("%.1f" % study.median(network, "seconds"))
        cells += ["%.0f" % cost if cost else "" for cost in (study.cost(network, 1), study.cost(network, 8))]
        yield "| " + " | ".join(cells) + " |"


def facts(study):
    moving = len(study.records)
    held = len(of(study.tables["error"], PAPER, part="held", draw=1.0))
    yield ("%d records, %d of them held out in each of %d draws; %d sines pitch. Every network of a draw sees the same "
           "records." % (moving, held, study.draws, len(study.pitching())))


def comparison(study):
    cl, cm = (study.better(MEMORY, PAPER, c) for c in ("cl", "cm"))
    yield ("Record by record, held out in the same draw, the LSTM has the smaller error of c_l in %d of %d cases and "
           "of c_m in %d of %d." % (*cl, *cm))


def page(study):
    parts = {"facts": facts, "neurons": neuron_table, "memory": memory_table, "comparison": comparison,
             "examples": lambda s: drawings.caption(s.tables["cycle"])}
    with open(Path(__file__).with_name("text.md"), encoding="utf-8") as file:
        for line in file.read().splitlines():
            if line.startswith("<!-- ") and line.endswith(" -->"):
                yield from parts[line[5:-4]](study)
            else:
                yield line


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "bin" / "network_study"))
    parser.add_argument("--draws", type=int, default=6)
    parser.add_argument("--redraw", action="store_true")
    arguments = parser.parse_args()
    if not arguments.redraw:
        write(run(arguments.program, arguments.draws))
    study = Study(read())
    for name, text in drawings.all_of(study):
        (FOLDER / name).write_text(text, encoding="utf-8")
    PAGE.write_text("\n".join(page(study)) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
