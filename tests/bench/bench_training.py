#!/usr/bin/env python3
"""Levenberg-Marquardt training of the 4-50-2 network on all records of data/cfd, with one thread and with
two, beside the same algorithm in NumPy (Debian's python3-numpy) with one: same samples, same start, same epochs, in one
run, seconds of the clock. The errors of the first epochs must agree; exit code 1 when they do not.

Usage: bench_training.py [--program build/release/bin/bench_training]"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"  # before NumPy is loaded, and for the program

try:
    import numpy as np
except ImportError:
    sys.exit("needs python3-numpy")

ROOT = Path(__file__).resolve().parents[2]
N_IN, HIDDEN, N_OUT = 4, 50, 2
DECAY, BLOCK = 1e-4, 1024
DAMPING_START, DAMPING_LEAST, DAMPING_MOST, FACTOR = 1e-2, 1e-12, 1e10, 10.0
COMPARED, TOLERANCE = 5, 1e-6  # epochs, relative: later ones spread by rounding


def read(path):
    numbers = np.fromfile(path)
    sizes, numbers = [int(v) for v in numbers[:3]], numbers[3:]
    parts = []
    for n in sizes[:2]:
        x, numbers = numbers[:N_IN * n].reshape(n, N_IN), numbers[N_IN * n:]
        t, numbers = numbers[:N_OUT * n].reshape(n, N_OUT), numbers[N_OUT * n:]
        parts.append((x, t))
    return parts[0], parts[1], numbers.copy()


def weights(p):
    w1, rest = p[:N_IN * HIDDEN].reshape(HIDDEN, N_IN), p[N_IN * HIDDEN:]
    b1, rest = rest[:HIDDEN], rest[HIDDEN:]
    return w1, b1, rest[:N_OUT * HIDDEN].reshape(N_OUT, HIDDEN), rest[N_OUT * HIDDEN:]


def error(p, x, t):
    w1, b1, w2, b2 = weights(p)
    return np.mean((np.tanh(x @ w1.T + b1) @ w2.T + b2 - t) ** 2)


def normal_equations(p, x, t):
    """J'J/m and J'e/m, block by block."""
    w1, b1, w2, b2 = weights(p)
    gram, slope = np.zeros((p.size, p.size)), np.zeros(p.size)
    for first in range(0, len(x), BLOCK):
        xb, tb = x[first:first + BLOCK], t[first:first + BLOCK]
        h = np.tanh(xb @ w1.T + b1)
        e = h @ w2.T + b2 - tb
        for o in range(N_OUT):
            back = w2[o] * (1.0 - h * h)
            j = np.zeros((len(xb), p.size))
            j[:, :N_IN * HIDDEN] = (back[:, :, None] * xb[:, None, :]).reshape(len(xb), -1)
            j[:, N_IN * HIDDEN:(N_IN + 1) * HIDDEN] = back
            j[:, (N_IN + 1 + o) * HIDDEN:(N_IN + 2 + o) * HIDDEN] = h
            j[:, p.size - N_OUT + o] = 1.0
            gram += j.T @ j
            slope += j.T @ e[:, o]
    m = t.size
    return gram / m, slope / m


def train(trained, p, epochs):
    """Errors of the trained samples after each epoch."""
    weight, damping = DECAY / p.size, DAMPING_START
    now = error(p, *trained)
    total, errors = now + weight * p @ p, [now]
    for _ in range(epochs):
        gram, slope = normal_equations(p, *trained)
        slope += weight * p
        while damping <= DAMPING_MOST:
            trial = p - np.linalg.solve(gram + (weight + damping) * np.eye(p.size), slope)
            new = error(trial, *trained)
            if new + weight * trial @ trial < total:
                p, now, total = trial, new, new + weight * trial @ trial
                damping = max(damping / FACTOR, DAMPING_LEAST)
                break
            damping *= FACTOR
        errors.append(now)
    return errors


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "bin" / "bench_training"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "samples")
        lines = subprocess.run([options.program, str(ROOT / "data" / "cfd"), path], check=True, text=True,
                               stdout=subprocess.PIPE).stdout.splitlines()
        trained, _, start = read(path)
    one, two = map(float, lines[0].split())
    errors = [float(line.split()[1]) for line in lines[1:]]
    begin = time.monotonic()
    own = train(trained, start, len(errors) - 1)
    python = time.monotonic() - begin
    worst = max(abs(a / b - 1.0) for a, b in zip(errors[:COMPARED + 1], own))
    print("NumPy %s, one BLAS thread; %d samples, %d epochs" % (np.__version__, len(trained[0]), len(errors) - 1))
    print("%-14s%10.2f s   last error %.5f" % ("C, one thread", one, errors[-1]))
    print("%-14s%10.2f s   %.2f times as fast, same bits" % ("C, two threads", two, one / two))
    print("%-14s%10.2f s   last error %.5f" % ("NumPy", python, own[-1]))
    print("NumPy to C with one thread %.2f; largest relative difference of the errors of %d epochs: %.1e" % (
        python / one, COMPARED, worst))
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
