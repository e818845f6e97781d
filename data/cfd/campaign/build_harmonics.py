#!/usr/bin/env python3
"""Builds ../harmonics.csv: means, first harmonics and work per cycle of every sine record.

The means are over the cycles the design counts, after those it skips; `_sd` is the standard deviation
over these cycles. Derivatives are those of the coefficient by the motion, per radian of pitch or per
chord of plunge: `_in` in phase with the motion, `_out` in phase with its rate; with both motions at once
they cannot be told apart and are left empty. Work per cycle: pitch = integral of c_m d(alpha), plunge =
integral of c_l dw; negative when the flow damps. `--check` compares only."""

import argparse
import csv
import math
import statistics
import sys
from pathlib import Path

import motion

FOLDER = Path(__file__).resolve().parents[1]
TARGET = FOLDER / "harmonics.csv"
POINTS = 256  # a cycle
COLUMNS = ("name", "mean_deg", "pitch_deg", "plunge_c", "phase_deg", "frequency", "re", "mesh", "edge",
           "step", "cycles", "cl_mean", "cd_mean", "cm_mean", "cl_min", "cl_max", "cm_min", "cm_max",
           "cl_in", "cl_out", "cm_in", "cm_out", "work_pitch", "work_pitch_sd", "work_plunge",
           "work_plunge_sd", "work", "work_sd", "spread_cl", "spread_cm")


def cubic(values, x):
    """Third-order interpolation of equidistant values at the position x, in samples."""
    i = min(max(int(x), 1), len(values) - 3)
    s = x - i
    a, b, c, d = values[i - 1:i + 3]
    return (b + 0.5 * s * (c - a + s * (2.0 * a - 5.0 * b + 4.0 * c - d
                                        + s * (3.0 * (b - c) + d - a))))


def read(path):
    with open(path, newline="", encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    return {key: [float(row[key]) for row in rows] for key in ("t", "cl", "cd", "cm")}


def cycles_of(row, series, frequency):
    """For each counted cycle the coefficients at POINTS equal phases from the start of a period."""
    interval = float(row["interval"])
    result = []
    for n in range(int(row["cycles"])):
        first = motion.START + (int(row["cycles_skipped"]) + n) / frequency
        # Sample i is at (i + 1) intervals.
        places = [(first + j / (POINTS * frequency)) / interval - 1.0 for j in range(POINTS)]
        result.append({key: [cubic(series[key], x) for x in places] for key in ("cl", "cd", "cm")})
    return result


def works(cycle, pitch, plunge, frequency):
    """Work of the flow on the section in one cycle, by pitch and by plunge."""
    total = [0.0, 0.0]
    for j in range(POINTS):
        psi = 2.0 * math.pi * j / POINTS
        for k, key, term in ((0, "cm", pitch), (1, "cl", plunge)):
            if term:
                total[k] += cycle[key][j] * term[0] * math.cos(psi + term[3])
    return [2.0 * math.pi / POINTS * value for value in total]


def harmonic(values, amplitude):
    """In-phase and quadrature part of the first harmonic per unit of a sine of this amplitude."""
    psi = [2.0 * math.pi * j / POINTS for j in range(POINTS)]
    return (2.0 / POINTS / amplitude * math.fsum(v * math.sin(p) for v, p in zip(values, psi)),
            2.0 / POINTS / amplitude * math.fsum(v * math.cos(p) for v, p in zip(values, psi)))


def spread(cycles, average, key):
    """Deviation of the cycles from their average, rms over range."""
    square = statistics.fmean((c[key][j] - average[key][j]) ** 2 for c in cycles for j in range(POINTS))
    return math.sqrt(square) / (max(average[key]) - min(average[key]))


def summary(row):
    """The line of one sine record."""
    pitch, plunge = (terms[0] if terms else None
                     for terms in (motion.parse(row["pitch"]), motion.parse(row["plunge"])))
    pitch = pitch and (math.radians(pitch[0]),) + pitch[1:]
    frequency = (pitch or plunge)[1]
    cycles = cycles_of(row, read(FOLDER / "records" / (row["name"] + ".csv")), frequency)
    average = {key: [statistics.fmean(c[key][j] for c in cycles) for j in range(POINTS)]
               for key in ("cl", "cd", "cm")}
    line = {key: row[key] for key in ("name", "mean_deg", "re", "mesh", "edge", "cycles")}
    line.update(step=row["step_used"], frequency="%g" % frequency,
                pitch_deg="%g" % math.degrees(pitch[0]) if pitch else "0",
                plunge_c="%g" % plunge[0] if plunge else "0",
                phase_deg="%g" % math.degrees(plunge[3]) if pitch and plunge else "")
    numbers = {key + "_mean": statistics.fmean(average[key]) for key in average}
    for key in ("cl", "cm"):
        numbers[key + "_min"], numbers[key + "_max"] = min(average[key]), max(average[key])
        numbers["spread_" + key] = spread(cycles, average, key)
        if not (pitch and plunge):
            numbers[key + "_in"], numbers[key + "_out"] = harmonic(average[key], (pitch or plunge)[0])
    each = [works(c, pitch, plunge, frequency) for c in cycles]
    for k, key in ((0, "work_pitch"), (1, "work_plunge")):
        numbers[key] = statistics.fmean(w[k] for w in each)
        numbers[key + "_sd"] = statistics.pstdev(w[k] for w in each)
    numbers["work"] = statistics.fmean(map(sum, each))
    numbers["work_sd"] = statistics.pstdev(map(sum, each))
    line.update({key: "%.5f" % (value + 0.0) for key, value in numbers.items()})
    return line


def text():
    with open(FOLDER / "index.csv", newline="", encoding="ascii") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "done" and int(row["cycles"])]
    lines = [summary(row) for row in rows]
    return "\n".join([",".join(COLUMNS)] + [",".join(line.get(c, "") for c in COLUMNS)
                                            for line in lines]) + "\n"


def main():
    parser = argparse.ArgumentParser(description="Build harmonics.csv.")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail when the committed file differs")
    if not parser.parse_args().check:
        TARGET.write_text(text(), encoding="ascii")
        return 0
    if TARGET.exists() and TARGET.read_text(encoding="ascii") == text():
        return 0
    print("%s differs from what its script builds: run the script without --check" % TARGET,
          file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
