#!/usr/bin/env python3
"""Cost of a section solve (100 elements along the wall) and of the modes of the paper's beam, beside
the same computations in NumPy and SciPy (Debian's python3-numpy, python3-scipy), in one run on one
thread. Both must give the same numbers; exit code 1 when they do not.

Usage: bench_structure.py [--program build/release/bin/bench_structure] [--rounds 101]

The program prints `name seconds` lines and `value name number` lines. The comparison: laminate,
warping of the five strains without shear force (the program solves the seven with shear as well),
5 x 5 stiffness and 7 x 7 mass by arrays over all Gauss points and banded solves; beam by one element matrix,
scipy.linalg.eigh for the wanted modes."""

import argparse
import os
import statistics
import subprocess
import sys
import time

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"  # before NumPy is loaded

try:
    import numpy as np
    import scipy.linalg
except ImportError:
    sys.exit("needs python3-numpy and python3-scipy")

LENGTH, CHORD, BEAM_ELEMENTS, MODES = 0.37, 0.1, 16, 4
SKIN = dict(e_l=141.96e9, e_t=9.78e9, g=6e9, nu=0.42, density=1445.0)
FOAM = dict(e_l=15e6, e_t=15e6, g=8e6, nu=0.28, density=35.0)
PLIES = ((SKIN, np.radians(-45.0), 0.00013), (FOAM, 0.0, 0.00387))
TOLERANCE = 1e-6

XI = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)])
WEIGHT = np.array([5.0, 8.0, 5.0]) / 9.0
NODE, INNER = 7, 2
GAUSS, GAUSS_WEIGHT = np.polynomial.legendre.leggauss(4)


def ply_stiffness(material, angle):
    """Plane-stress stiffness in axes z (span), s, zs."""
    d = 1.0 - material["nu"] ** 2 * material["e_t"] / material["e_l"]
    q12 = material["nu"] * material["e_t"] / d
    q = np.array([[material["e_l"] / d, q12, 0.0], [q12, material["e_t"] / d, 0.0],
                  [0.0, 0.0, material["g"]]])
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s],
                     [-2 * c * s, 2 * c * s, c * c - s * s]])  # strains of the ply
    return turn.T @ q @ turn


def laminate():
    """Reduced stiffness for (eps_zz, gamma_sz, kappa_zz, kappa_sz) with N_ss = L_ss = 0, and the
    mass moments m0, m1, m2."""
    k, mass = np.zeros((6, 6)), np.zeros(3)
    low = -0.5 * sum(p[2] for p in PLIES)
    for material, angle, thickness in PLIES:
        high = low + thickness
        moment = [(high ** (n + 1) - low ** (n + 1)) / (n + 1) for n in range(3)]
        q = ply_stiffness(material, angle)
        k += np.block([[q * moment[0], q * moment[1]], [q * moment[1], q * moment[2]]])
        mass += material["density"] * np.array(moment)
        low = high
    keep, drop = [0, 2, 3, 5], [1, 4]
    return (k[np.ix_(keep, keep)] - k[np.ix_(keep, drop)]
            @ np.linalg.solve(k[np.ix_(drop, drop)], k[np.ix_(drop, keep)]), mass)


def section(elements):
    """5 x 5 stiffness for (w', psi', phi', theta', theta'') and 7 x 7 mass for (u, v, w, v', u',
    theta, theta') of the strip, from the leading to the trailing edge; quadratic elements."""
    reduced, (m0, m1, m2) = laminate()
    n, h = 2 * elements + 1, CHORD / elements
    shape = np.stack([0.5 * XI * (XI - 1.0), 1.0 - XI * XI, 0.5 * XI * (XI + 1.0)], axis=1)
    slope = np.stack([XI - 0.5, -2.0 * XI, XI + 0.5], axis=1) * 2.0 / h
    node = 2 * np.arange(elements)[:, None] + np.arange(3)
    x = 0.5 * CHORD - h * (np.arange(elements)[:, None] + 0.5 * (1.0 + XI))
    weight = np.broadcast_to(WEIGHT * 0.5 * h, x.shape)

    # The matrix of g' R_gg g', banded for a Cholesky factorisation with node 0 held.
    local = reduced[1, 1] * np.einsum("q,qa,qb->ab", WEIGHT * 0.5 * h, slope, slope)
    band = np.zeros((3, n))
    for a in range(3):
        for b in range(a + 1):
            band[a - b, b:b + 2 * elements:2] += local[a, b]
    factor = scipy.linalg.cholesky_banded(band[:, 1:], lower=True)

    # Bare strains at the Gauss points: (points, wall strain, section strain).
    strain = np.zeros(x.shape + (4, 5))
    strain[..., 0, 0] = 1.0
    strain[..., 0, 1] = -x
    strain[..., 2, 2] = 1.0
    strain[..., 3, 3] = 2.0
    strain[..., 2, 4] = -x  # r_t = x dx/ds

    def solve(columns):
        flow = np.einsum("eq,qa,j,eqjk->eak", weight, slope, reduced[1], strain[..., columns])
        load = np.zeros((n, len(columns)))
        np.subtract.at(load, node, flow)
        g = np.zeros_like(load)
        g[1:] = scipy.linalg.cho_solve_banded((factor, True), load[1:])
        return g

    def warped(g, columns):
        strain[..., 1, columns] += np.einsum("qa,eak->eqk", slope, g[node])

    g = solve([0, 1, 2, 3])
    warped(g, [0, 1, 2, 3])
    axial = np.einsum("eq,j,eqj->eq", weight, reduced[0], strain[..., 0])
    couple = np.einsum("eq,j,eqj->eq", weight, reduced[2], strain[..., 0])
    at_points = np.einsum("qa,eak->eqk", shape, g[node])
    twist = at_points[..., 3] - (np.sum(axial * at_points[..., 3]) - np.sum(couple * x)) / np.sum(
        axial)
    strain[..., 0, 4] = twist
    warped(solve([4]), [4])
    stiffness = np.einsum("eq,eqia,ij,eqjb->ab", weight, strain, reduced, strain, optimize=True)

    # Motion of the middle of the wall and its change across it: (points, component, freedom).
    mid, across = np.zeros(x.shape + (3, 7)), np.zeros(x.shape + (3, 7))
    mid[..., 0, 0] = mid[..., 1, 1] = mid[..., 2, 2] = 1.0
    mid[..., 1, 5] = x
    mid[..., 2, 4] = -x
    mid[..., 2, 6] = twist
    across[..., 0, 5] = -1.0
    across[..., 2, 3] = -1.0
    across[..., 2, 6] = -x
    flat = [a.reshape(-1, 7) for a in (mid, across)]
    w3 = np.repeat(weight.ravel(), 3)[:, None]
    cross = flat[0].T @ (w3 * flat[1])
    mass = (m0 * flat[0].T @ (w3 * flat[0]) + m2 * flat[1].T @ (w3 * flat[1])
            + m1 * (cross + cross.T))
    return stiffness, mass


def element(stiffness, mass, h):
    """Stiffness and mass (14 x 14) of a beam element, two internal modes of w condensed."""
    k, m = np.zeros((2, 2 * NODE + INNER, 2 * NODE + INNER))
    for t, weight in zip(0.5 * (1.0 + GAUSS), 0.5 * h * GAUSS_WEIGHT):
        value = np.array([1 - 3 * t**2 + 2 * t**3, h * (t - 2 * t**2 + t**3), 3 * t**2 - 2 * t**3,
                          h * (t**3 - t**2)])
        first = np.array([(6 * t**2 - 6 * t) / h, 1 - 4 * t + 3 * t**2, (6 * t - 6 * t**2) / h,
                          3 * t**2 - 2 * t])
        second = np.array([(12 * t - 6) / h**2, (6 * t - 4) / h, (6 - 12 * t) / h**2,
                           (6 * t - 2) / h])
        strain, motion = np.zeros((5, 16)), np.zeros((7, 16))
        u, v, theta, w = [1, 2, 8, 9], [3, 4, 10, 11], [5, 6, 12, 13], [0, 7, 14, 15]
        strain[0, w] = [-1 / h, 1 / h, (1 - 2 * t) / h, (-6 * t**2 + 6 * t - 1) / h]
        motion[2, w] = [1 - t, t, t * (1 - t), t * (1 - t) * (2 * t - 1)]
        strain[1, u], strain[2, v] = second, -second
        strain[3, theta], strain[4, theta] = first, second
        motion[0, u], motion[4, u] = value, first
        motion[1, v], motion[3, v] = value, first
        motion[5, theta], motion[6, theta] = value, first
        k += weight * strain.T @ stiffness @ strain
        m += weight * motion.T @ mass @ motion
    recover = np.vstack([np.eye(14), -np.linalg.solve(k[14:, 14:], k[14:, :14])])
    return recover.T @ k @ recover, recover.T @ m @ recover


def modes(contour_elements):
    """The lowest frequencies [Hz] of the clamped beam."""
    ke, me = element(*section(contour_elements), LENGTH / BEAM_ELEMENTS)
    n = NODE * (BEAM_ELEMENTS + 1)
    k, m = np.zeros((2, n, n))
    for e in range(BEAM_ELEMENTS):
        part = slice(NODE * e, NODE * (e + 2))
        k[part, part] += ke
        m[part, part] += me
    lam = scipy.linalg.eigh(k[NODE:, NODE:], m[NODE:, NODE:], eigvals_only=True,
                            subset_by_index=[0, MODES - 1])
    return np.sqrt(lam) / (2.0 * np.pi)


def median_time(function, rounds):
    function()
    seconds = []
    for _ in range(rounds):
        start = time.process_time()
        result = function()
        seconds.append(time.process_time() - start)
    return statistics.median(seconds), result


def run_program(path, rounds):
    seconds, values = {}, {}
    out = subprocess.run([path, str(rounds)], check=True, capture_output=True, text=True).stdout
    for line in out.splitlines():
        words = line.split()
        if words[0] == "value":
            values[words[1]] = float(words[2])
        else:
            seconds[words[0]] = float(words[1])
    return seconds, values


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="build/release/bin/bench_structure")
    parser.add_argument("--rounds", type=int, default=101)
    options = parser.parse_args()
    seconds, values = run_program(options.program, options.rounds)
    rows = {}
    rows["section_100"], (stiffness, _) = median_time(lambda: section(100), options.rounds)
    rows["modes"], hz = median_time(lambda: modes(16), options.rounds)
    own = {f"stiffness_{i}{i}": stiffness[i, i] for i in range(5)}
    own.update({f"frequency_{j + 1}": hz[j] for j in range(MODES)})
    worst = max(abs(values[name] / number - 1.0) for name, number in own.items())
    print(f"NumPy {np.__version__}, SciPy {scipy.__version__}, one thread, "
          f"median of {options.rounds} rounds")
    print(f"{'':14}{'C':>12}{'Python':>12}{'ratio':>8}")
    for name, python in rows.items():
        print(f"{name:14}{1e3 * seconds[name]:9.3f} ms{1e3 * python:9.3f} ms"
              f"{python / seconds[name]:8.1f}")
    print(f"largest relative difference of {len(own)} numbers: {worst:.1e}")
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
