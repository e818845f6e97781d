#!/usr/bin/env python3
"""The step of the paper's case (16 elements, 4 modes, lifting line, network) in NumPy beside the core, in
one run on one thread. Both must reach the same modal state; exit code 1 when they do not.

Usage: step_numpy.py [--program build/release/bin/step_model] [--steps 1500] [--rounds 5]

The program marches the case, times it and writes its model as numbers. The NumPy march is the same
algorithm, vectorised over the stations: exact modal step, kinematics by matrix products, Newton on the
lifting line with an inverse kept while it serves, polar by one gather, network by two matrix products,
sliding mean in a ring. What can be computed once is computed before the clock starts."""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"  # before NumPy is loaded

try:
    import numpy as np
except ImportError:
    sys.exit("needs python3-numpy")

STATIONS = 16
TOLERANCE = 1e-6  # of the modal state at the end, relative to its largest entry


def slopes(x, y):
    """Fritsch & Carlson's slopes with the mean of Fritsch & Butland, down the columns of y."""
    h, d = np.diff(x)[:, None], np.diff(y, axis=0) / np.diff(x)[:, None]
    out = np.zeros_like(y)
    w0, w1 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    same = d[:-1] * d[1:] > 0
    safe = np.where(same, d[:-1], 1.0), np.where(same, d[1:], 1.0)
    out[1:-1] = np.where(same, (w0 + w1) / (w0 / safe[0] + w1 / safe[1]), 0.0)
    for end, (h0, h1, d0, d1) in ((0, (h[0], h[1], d[0], d[1])), (-1, (h[-1], h[-2], d[-1], d[-2]))):
        s = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
        s = np.where(s * d0 <= 0, 0.0, s)
        out[end] = np.where((d0 * d1 <= 0) & (abs(s) > 3 * abs(d0)), 3 * d0, s)
    return out


class Polar:
    def __init__(self, m):
        self.alpha, self.plunge = np.array(m["alpha"]), np.array(m["plunge"])
        shape = (len(self.plunge), len(self.alpha))
        cubic = np.empty((len(self.plunge), len(self.alpha) - 1, 3, 4))
        for k, name in enumerate(("cl", "cd", "cm")):
            y = np.array(m[name]).reshape(shape).T
            h, s = np.diff(self.alpha)[:, None], slopes(self.alpha, y)
            d = np.diff(y, axis=0) / h
            parts = y[:-1], s[:-1], (3 * d - 2 * s[:-1] - s[1:]) / h, (s[:-1] + s[1:] - 2 * d) / h ** 2
            for a, part in enumerate(parts):
                cubic[:, :, k, a] = part.T
        self.cubic = cubic

    def place(self, plunge):
        """Rows and weights of the plunge, once a step."""
        p = np.clip(plunge, self.plunge[0], self.plunge[-1])
        row = np.clip(np.searchsorted(self.plunge, p, "right") - 1, 0, len(self.plunge) - 2)
        return row, (p - self.plunge[row]) / (self.plunge[row + 1] - self.plunge[row])

    def interval(self, alpha):
        i = np.clip(np.searchsorted(self.alpha, alpha, "right") - 1, 0, len(self.alpha) - 2)
        return i, np.clip(alpha, self.alpha[0], self.alpha[-1]) - self.alpha[i]

    def lift(self, alpha, row, weight):
        i, t = self.interval(alpha)
        a = self.cubic[row, i, 0]
        a = a + weight[:, None] * (self.cubic[row + 1, i, 0] - a)
        a0, a1, a2, a3 = a.T
        return a0 + t * (a1 + t * (a2 + t * a3)), a1 + t * (2 * a2 + t * 3 * a3)

    def all(self, alpha, row, weight):
        i, t = self.interval(alpha)
        a = self.cubic[row, i]
        a = a + weight[:, None, None] * (self.cubic[row + 1, i] - a)
        return (a[..., 0] + t[:, None] * (a[..., 1] + t[:, None] * (a[..., 2] + t[:, None] * a[..., 3]))).T


class March:
    def __init__(self, m):
        self.m, n = m, m["modes"]
        self.v, self.theta, self.u = (np.array(m["station_" + k]).reshape(n, STATIONS).T.copy()
                                      for k in ("v", "theta", "u"))
        self.shape = np.vstack((self.u, self.v, self.theta)).T.copy()  # (modes x 3 stations)
        self.induced = np.stack([np.array(m[f"induced{j}"]) for j in range(STATIONS)], axis=1)
        self.p = [np.array(m[f"p{k}"]) for k in range(4)]
        self.w = {k: np.array(m[k]) for k in ("w00", "w01", "w10", "w11")}
        self.omega2, self.damping, self.gravity = (np.array(m[k]) for k in ("omega2", "damping", "gravity"))
        self.chord = np.array(m["chord"])
        self.polar = Polar(m)
        h = len(m["net_b1"])
        self.w1 = np.array(m["net_w1"]).reshape(h, 4) / np.array(m["net_scale"])
        self.b1 = np.array(m["net_b1"])[:, None]
        self.w2 = np.array(m["net_w2"]).reshape(2, h) * np.array(m["net_out"])[:, None]
        self.b2 = (np.array(m["net_b2"]) * np.array(m["net_out"]))[:, None]
        self.q, self.qd, self.qdd, self.before = (np.zeros(n) for _ in range(4))
        self.ring, self.ring_sum, self.next, self.count = np.zeros((m["window"], STATIONS)), 0.0, 0, 0
        self.cl, self.solved, self.inverse = np.zeros(STATIONS), [], None
        self.eye = np.eye(STATIONS)
        self.inverses = 0
        self.input = np.empty((4, STATIONS))

    def solve(self, geometric, row, weight):
        """Lifting line: the start continues up to three earlier solutions."""
        s = self.solved
        cl = (self.polar.lift(geometric, row, weight)[0] if not s else s[0] if len(s) == 1 else
              2 * s[0] - s[1] if len(s) == 2 else 3 * (s[0] - s[1]) + s[2])
        alpha = geometric - self.induced @ cl
        table, slope = self.polar.lift(alpha, row, weight)
        residual = cl - table
        size = np.abs(residual).max()
        while size > self.m["tolerance"]:
            if self.inverse is None:
                self.inverses += 1
                self.inverse = np.linalg.inv(self.eye + slope[:, None] * self.induced)
            cl = cl - self.inverse @ residual
            alpha = geometric - self.induced @ cl
            table, slope = self.polar.lift(alpha, row, weight)
            residual = cl - table
            before, size = size, np.abs(residual).max()
            if size > 0.3 * before:
                self.inverse = None
        self.solved = [cl] + s[:2]
        return alpha, geometric - alpha

    def mean(self, alpha, steady):
        window = len(self.ring)
        if steady:
            self.count = self.next = 0
            self.ring_sum = np.zeros(STATIONS)
        if self.count == window:
            self.ring_sum -= self.ring[self.next]
        else:
            self.count += 1
        self.ring[self.next] = alpha
        self.ring_sum += alpha
        self.next = (self.next + 1) % window
        return self.ring_sum / self.count

    def loads(self, steady):
        m = self.m
        speed, step, q = m["speed"], m["dt"], m["pressure"]
        plunge = self.v @ self.q / self.chord
        geometric = m["incidence"] + self.theta @ self.q - self.v @ self.qd / speed
        row, weight = self.polar.place(plunge)
        alpha, induced = self.solve(geometric, row, weight)
        cl, cd, cm = self.polar.all(alpha, row, weight)
        cd = cd + cl * induced
        mean = self.mean(alpha, steady)
        time_unit = self.chord / speed
        x = self.input
        x[0], x[1] = mean, alpha - mean
        x[2] = (self.theta @ self.qd - self.v @ self.qdd / speed) * time_unit
        jerk = (self.qdd - self.before) / step
        x[3] = (self.theta @ self.qdd - self.v @ jerk / speed) * time_unit ** 2
        y = self.w2 @ np.tanh(self.w1 @ x + self.b1) + self.b2
        cl, cm = cl + y[0], cm + y[1]
        lift, drag = q * self.chord * cl, q * self.chord * cd
        c, s = np.cos(m["incidence"]), np.sin(m["incidence"])
        force = np.concatenate((lift * s - drag * c, lift * c + drag * s, q * self.chord ** 2 * cm))
        return self.shape @ force * m["strip"] + self.gravity

    def run(self, steps):
        for _ in range(2):
            self.solved = self.solved[:3]
            load = self.loads(True)
            self.qdd = load - self.damping * self.qd - self.omega2 * self.q
            self.before = self.qdd
        last = load
        start = time.process_time()
        for k in range(steps):
            rate = load - last if k else np.zeros_like(load)
            self.before = self.qdd
            q, qd = self.q, self.qd
            self.q = self.p[0] * q + self.p[1] * qd + self.w["w00"] * load + self.w["w10"] * rate
            self.qd = self.p[2] * q + self.p[3] * qd + self.w["w01"] * load + self.w["w11"] * rate
            self.qdd = load + rate - self.damping * self.qd - self.omega2 * self.q
            last, load = load, self.loads(False)
        return 1e6 * (time.process_time() - start) / steps


def network_ns(m, stations, rounds):
    """Nanoseconds a station of the network alone, at so many stations in one call."""
    march, x = March(m), np.linspace(-0.1, 0.1, 4 * stations).reshape(4, stations)
    calls = max(1, 20000 // stations)
    cost = []
    for _ in range(rounds):
        start = time.process_time()
        for _ in range(calls):
            march.w2 @ np.tanh(march.w1 @ x + march.b1) + march.b2
        cost.append(1e9 * (time.process_time() - start) / (calls * stations))
    return statistics.median(cost)


def compare(program, steps, rounds):
    """Figures of both, and the difference of the states they reach."""
    m = json.loads(subprocess.run([program, str(steps), str(rounds)], check=True, capture_output=True,
                                  text=True).stdout)
    cost = []
    for _ in range(rounds):
        march = March(m)
        cost.append(march.run(steps))
    scale = np.abs(m["q"]).max(), np.abs(m["qd"]).max()
    apart = max(np.abs(march.q - m["q"]).max() / scale[0], np.abs(march.qd - m["qd"]).max() / scale[1])
    return {"core": m["us_per_step"], "numpy": statistics.median(cost), "apart": float(apart),
            "iterations": m["iterations"] / steps, "inverses": march.inverses / steps, "steps": steps,
            "version": np.__version__, "network": {n: network_ns(m, n, rounds) for n in (STATIONS, 4096)}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/bin/step_model")
    parser.add_argument("--steps", type=int, default=1500)
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    r = compare(given.program, given.steps, given.rounds)
    print(f"step, lifting line and network: core {r['core']:.2f} us, NumPy {r['numpy']:.0f} us, "
          f"ratio {r['numpy'] / r['core']:.0f}; states {r['apart']:.1e} apart after {r['steps']} steps")
    return 0 if r["apart"] < TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
