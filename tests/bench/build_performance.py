#!/usr/bin/env python3
"""Writes docs/PERFORMANCE.md from measurements on this machine: everything on the page is from this run.

Usage: build_performance.py [--bin build/release/bin] [--rounds 21] [--no-map | --map FILE...] [--output docs/PERFORMANCE.md]

Needs python3-numpy and python3-scipy beside the programs of tests/bench; perf for the profile. The map takes
some two minutes on a machine that does nothing else, and its wall-clock figures mean nothing on another."""

import argparse
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BENCH = ROOT / "tests" / "bench"
STATIONS, MODES, HIDDEN, N_IN, N_OUT, TANH = 16, 4, 50, 4, 2, 24

# What the paper states of its cost (section 3.2): processor seconds of a time step, hours of a simulation.
PAPER = {"CFD/CSD": (2e4, 430.0), "reduced-order model": (2.2, 3.0)}

GROUPS = (
    ("network", r"kernel_(avx|port)|network_"),
    ("lifting line: residual, Newton step", r"residual_|gemv_|^newton|lifting_line|^evaluate|damped_step|start_values|shortfall"),
    ("lifting line: pieces of the polar", r"polar_piece_at|take_piece|ask_polar"),
    ("lifting line: inverse of the Jacobian (LAPACK)", r"\blibopenblas|\bliblapack"),
    ("polar: three coefficients", r"polar_at|polar_is_stalled"),
    ("kinematics and modal loads", r"loads_evaluate|modal_loads|kinematics|to_stations|wake_lag|excitation"),
    ("record, means, totals", r"record_push|span_mean|loads_total|tip_of|apparent_mass"),
    ("modal step, load history", r"march_run|exponential_step|load_polynomial|accelerations|num_all_finite"),
)


def run(command, **options):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True, **options).stdout


def machine():
    text = Path("/proc/cpuinfo").read_text(encoding="ascii")
    name = re.search(r"model name\s*:\s*(.+)", text).group(1)
    compiler = run(["cc", "--version"]).splitlines()[0]
    return f"{name}, {os.cpu_count()} cores; {compiler}; release preset"


def profile(program):
    """Shares of the march by part; None without perf."""
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "perf.data"
        try:
            run(["perf", "record", "-e", "cpu-clock", "-F", "4000", "-o", data, program, "15000", "60"])
            report = run(["perf", "report", "-i", data, "--no-children", "--stdio", "-g", "none"])
        except (OSError, subprocess.CalledProcessError):
            return None
    share, rest = dict.fromkeys([g[0] for g in GROUPS], 0.0), 0.0
    for line in report.splitlines():
        match = re.match(r"\s*([\d.]+)%\s+\S+\s+(\S+)\s+\[.\]\s+(\S+)", line)
        if not match:
            continue
        part, library, symbol = float(match.group(1)), match.group(2), match.group(3)
        name = next((g[0] for g in GROUPS if re.search(g[1], symbol) or re.search(g[1], library)), None)
        if name:
            share[name] += part
        else:
            rest += part
    total = sum(share.values()) + rest
    return [(k, v / total) for k, v in share.items()] + [("the rest (memory, system)", rest / total)]


def operations(numpy):
    """Additions, multiplications and divisions of a step, by part."""
    n, its = STATIONS, numpy["iterations"]
    evaluation = 2 * n * n + 14 * n
    return [
        ("network", n * (HIDDEN * (2 * N_IN + 1 + TANH + 2 * N_OUT) + 2 * (N_IN + N_OUT))),
        ("lifting line", (its + 1) * evaluation + its * (2 * n * n + 2 * n)),
        ("inverse of the Jacobian", numpy["inverses"] * 2 * n ** 3),
        ("polar", n * (3 * 23 + 12 + 2 * 4)),
        ("kinematics, loads, record", 7 * 2 * n * MODES + 6 * n * MODES + 60 * n + 40 * MODES),
    ]


def table(head, rows):
    out = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return out + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows] + [""]


def numpy_of(binary, rounds):
    code = ("import json,sys; sys.path.insert(0, %r); import step_numpy; "
            "print(json.dumps(step_numpy.compare(%r, 1500, %d)))" % (str(BENCH), str(binary / "step_model"), rounds))
    return json.loads(run([sys.executable, "-c", code]))


def step_section(binary, rounds):
    text = run([binary / "bench_step", rounds])
    models = re.findall(r"^(.+?)\s+([\d.]+) us/step$", text, re.M)
    network = re.search(r"network 4-50-2\s+([\d.]+) ns/station\s+plain libm\s+([\d.]+)", text)
    head = json.loads(run([binary / "step_model", 15000, rounds]))
    out = ["## The step", "The paper's case: 16 elements, 4 modes, 15,000 steps of 0.2 ms from rest at 6 m/s. "
           "Processor time of one thread, medians of %d interleaved rounds." % rounds, ""]
    out += table(("model", "µs a step, whole run"), models)
    out += ["A whole run has the record, the means and the damping in it. The march alone with lifting line and network: "
            "**%.2f µs a step**, %.1f Newton steps of the lifting line in it." % (
                head["us_per_step"], head["iterations"] / head["steps"]), ""]
    return out, head, (float(network.group(1)), float(network.group(2)))


def profile_section(binary, head):
    shares = profile(binary / "step_model")
    if shares is None:
        return ["No profile: perf is not there.", ""]
    return ["Where the time of that march goes (`perf`, samples of the processor clock):", ""] + table(
        ("part", "share", "µs"), [(k, f"{100 * v:.0f} %", f"{v * head['us_per_step']:.2f}") for k, v in shares])


def limit_section(binary, head, numpy):
    peaks = dict(re.findall(r"peak (\w+) ([\d.]+)", run([binary / "bench_peak"])))
    widest, peak = list(peaks.items())[-1]
    parts = operations(numpy)
    total = sum(v for _, v in parts)
    out = ["## Against the machine and against NumPy",
           "Additions, multiplications and divisions of a step, counted from the formulas:", ""]
    out += table(("part", "operations"), [(k, f"{v:,.0f}") for k, v in parts] + [("sum", f"{total:,.0f}")])
    ideal = total / (1e3 * float(peak))
    out += [f"One core does {float(peak):.0f} Gflop/s in the widest vectors ({widest}, fused; `bench_peak`), so the step cannot cost less than {ideal:.2f} µs: "
            f"it reaches {100 * ideal / head['us_per_step']:.0f} % of that limit. What is missing: division and table look-up, chains of "
            "dependent sums at 16 stations, and everything that is no arithmetic.", ""]
    out += [f"The same step in NumPy {numpy['version']}, vectorised over the stations (`step_numpy.py`), in the same run: "
            f"{numpy['numpy']:.0f} µs against {numpy['core']:.2f} µs, **ratio {numpy['numpy'] / numpy['core']:.0f}**; after "
            f"{numpy['steps']} steps the two states are {numpy['apart']:.0e} of their size apart.", ""]
    return out


def network_section(own, numpy):
    fast, plain = own
    rows = [("core, 16 stations", f"{fast:.0f}"), ("plain C with libm", f"{plain:.0f}")]
    rows += [(f"NumPy, {n} stations in a call", f"{v:.0f}") for n, v in numpy["network"].items()]
    return ["## Network 4-50-2", "tanh is a polynomial and one division, within 3e-16 absolute and 5e-16 relative "
            "(`test_network.c` holds it to 4e-16 and 8e-16); the network agrees with plain libm to 1e-13, and all "
            "instruction sets give the same bits.", ""] + table(("", "ns a station"), rows)


def other_section(binary):
    out = ["## Other figures", "```"]
    for command in ((sys.executable, BENCH / "bench_structure.py", "--program", binary / "bench_structure"),
                    (binary / "bench_stability",)):
        out += ["$ " + Path(command[-1] if len(command) == 1 else command[1]).name] + run(command).rstrip().splitlines() + [""]
    return out[:-1] + ["```", ""]


def map_section(binary, files):
    results = [json.loads(Path(f).read_text(encoding="utf-8")) for f in files]
    results = results or [json.loads(run([sys.executable, BENCH / "bench_map.py", "--bin", binary, "--json"]))]
    rows = [(r["cells"], f"{r['steps']:,}", r["workers"], f"{r['cpu']:.1f}", f"{r['own']:.1f}", f"{1e6 * r['own'] / r['steps']:.2f}",
             f"{100 * (r['cpu'] / r['own'] - 1):.1f} %", f"{r['wall']:.0f}", f"{result['load_before']:.0f}")
            for result in results for r in result["runs"]]
    out = ["## The map: fibre angles × speeds × 3 s", "Through HTTP (`bench_map.py`), lifting line and network on, a daemon of its own; the "
           "paper's map is 37 × 29 = 1,073 cells. Cells that stop early, at the amplitude limit, take fewer steps than 15,000. "
           "Wall-clock seconds were measured beside other work when the load is not about zero: then only the processor's count.", ""]
    out += table(("cells", "steps", "workers", "processor [s]", "of it in the cells [s]", "µs a step", "beside the cells", "wall [s]",
                  "load before"), rows)
    cells = json.loads(run([sys.executable, BENCH / "bench_cells.py", "--bin", binary, "--json"]))
    out += ["Beside the cells: models, content hashes, storing, HTTP. It hardly depends on what a cell computes, so that its share is small "
            "for marches and large for cells of little work (`bench_cells.py`, one worker):", ""]
    out += table(("kind", "cells", "a cell [ms]", "beside it [ms]", "share"),
                 [(r["kind"], r["cells"], f"{r['own_ms']:.2f}", f"{r['beside_ms']:.2f}", f"{100 * r['beside_ms'] / r['own_ms']:.1f} %")
                  for r in cells])
    return out + [""]


def paper_section(head):
    with open(ROOT / "data/cfd/index.csv", encoding="utf-8") as f:
        records = [r for r in csv.DictReader(f) if r["core_s"]]
    core = sum(float(r["core_s"]) for r in records)
    own = 1e-6 * head["us_per_step"]
    rows = [(name, f"{step:g}", f"{step / own:.1e}", f"{hours:g} h", f"{3600 * hours / (own * head['steps']):.1e}")
            for name, (step, hours) in PAPER.items()]
    out = ["## Against the paper's cost", f"The paper states processor seconds of a time step and the duration of a simulation. Here: "
           f"{head['us_per_step']:.2f} µs a step, {own * head['steps']:.3f} s for 15,000 steps on one core.", ""]
    out += table(("the paper's", "s a step", "times this step", "a simulation", "times 15,000 steps here"), rows)
    return out + ["Their machines and the length of their simulations are others, so these are orders of magnitude. What the speed is "
                  f"bought with: the flow computations behind polar and network, {len(records)} of two-dimensional flow and "
                  f"{core:,.0f} core-seconds ({core / 3600:.1f} h, `data/cfd/index.csv`), once for all beams.", ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", default="build/release/bin", type=Path)
    parser.add_argument("--rounds", type=int, default=21)
    parser.add_argument("--no-map", action="store_true")
    parser.add_argument("--map", nargs="+", default=[], metavar="FILE", help="answers of bench_map.py --json, instead of running it")
    parser.add_argument("--output", default=str(ROOT / "docs/PERFORMANCE.md"))
    given = parser.parse_args()
    step, head, network = step_section(given.bin, given.rounds)
    numpy = numpy_of(given.bin, given.rounds)
    lines = ["# Performance", "", "Made by `tests/bench/build_performance.py`; the words are its own, the numbers are from one machine. "
             "Processor time of one thread unless it says otherwise.", "", machine() + ".", ""]
    lines += step + profile_section(given.bin, head) + limit_section(given.bin, head, numpy)
    lines += network_section(network, numpy)
    lines += [] if given.no_map else map_section(given.bin, given.map)
    lines += paper_section(head) + other_section(given.bin)
    Path(given.output).write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
