"""From the solver's coefficients to a record: one CSV a run, with the motion that was prescribed.

A record has the columns COLUMNS at equal distances in time [c/V] from 0: angle [deg], its rates [rad per
c/V and (c/V)^2], plunge [c] and its rates, lift, drag and moment coefficient, the latter about mid-chord
and nose-up. Forces are those on the outer surface, without the inertia of the section.
"""

import math

import motion
from case import FORCE_INTERVAL

COLUMNS = ("t", "alpha_deg", "alpha_dot", "alpha_ddot", "w", "w_dot", "w_ddot", "cl", "cd", "cm")
DIGITS = (2, 4, 5, 5, 5, 5, 5, 5, 5, 5)
# Distance of samples [c/V] by the highest frequency of the motion: 30 or more a period; a section at
# rest sheds at about f = 0.7.
INTERVALS = ((0.0, 0.1), (0.3, 0.08), (math.inf, 0.04))
COEFFICIENT_MAX = 20.0  # beyond it the solver has diverged, whatever it says


class Diverged(Exception):
    """The run gave no usable coefficients."""


def interval_of(row):
    highest = motion.highest_frequency(row["pitch"], row["plunge"])
    return next(interval for limit, interval in INTERVALS if highest <= limit)


def coefficients(path):
    """Lines (t, c_l, c_d, c_m about the fixed reference point) of the solver's output."""
    names, lines = [], []
    for line in path.read_text(encoding="ascii").splitlines():
        if line.startswith("#"):
            names = line.lstrip("# ").split()
            continue
        values = dict(zip(names, map(float, line.split())))
        lines.append((values["Time"], values["Cl"], values["Cd"], values["CmPitch"]))
    return lines


def samples(row, lines):
    """Rows of the record, as numbers. Raises Diverged when a value is missing or absurd."""
    end = float(row["end"])
    pitch, plunge = motion.parse(row["pitch"]), motion.parse(row["plunge"])
    stride = round(interval_of(row) / FORCE_INTERVAL)
    result = []
    for t, cl, cd, cm in lines:
        index = round(t / FORCE_INTERVAL)
        if abs(t - index * FORCE_INTERVAL) > 1e-6 or index % stride:
            continue
        if not all(abs(value) < COEFFICIENT_MAX for value in (cl, cd, cm)):
            raise Diverged("coefficients beyond %g at t = %g" % (COEFFICIENT_MAX, t))
        angle, rate, acceleration, w, w_rate, w_acceleration = motion.state(pitch, plunge, t, end)
        # The solver's reference point stays at the mean position: the moment moves with the section.
        result.append((t, float(row["mean_deg"]) + angle, rate, acceleration,
                       float(row["plunge_c"]) + w, w_rate, w_acceleration, cl, cd, cm - w * cd))
    expected = math.floor(end / (stride * FORCE_INTERVAL) + 1e-6)
    if len(result) != expected:
        raise Diverged("%d samples instead of %d" % (len(result), expected))
    return result


def number(value, digits):
    text = ("%.*f" % (digits, value)).rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def text_of(rows):
    lines = [",".join(COLUMNS)]
    lines += [",".join(map(number, values, DIGITS)) for values in rows]
    return "\n".join(lines) + "\n"
