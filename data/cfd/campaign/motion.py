"""Prescribed motion of the section: pitch and plunge about a mean position, with exact rates.

A motion is a list of terms that fade in together. A term is written `amplitude@frequency+phase` (a tone)
or `amplitude@first>last+phase` (a linear sweep until the end of the record); frequency is f c / V, phase
in degrees, the amplitude in degrees (pitch, nose-up) or chords (plunge, up). Terms are joined by blanks.
Time in c/V.
"""

import math
import re

START = 2.0      # the section rests at its mean position until then
FADE_SHORT = 1.0  # a single tone fades in over a quarter of its period, but not faster than this
FADE_LONG = 4.0  # several tones and sweeps
TERM = re.compile(r"([\d.]+)@([\d.]+)(?:>([\d.]+))?\+([\d.]+)$")


def parse(text):
    """Terms (amplitude, first frequency, last frequency or None, phase [rad]) of one column."""
    terms = []
    for word in text.split():
        match = TERM.match(word)
        if not match:
            raise ValueError("not a term of a motion: %r" % word)
        amplitude, first, last, phase = match.groups()
        terms.append((float(amplitude), float(first), float(last) if last else None,
                      math.radians(float(phase))))
    return terms


def highest_frequency(*columns):
    """Highest f c / V of all terms, 0 for a section at rest."""
    return max((max(first, last or 0.0) for column in columns
                for _, first, last, _ in parse(column)), default=0.0)


def fade(t, length):
    """Quintic step from START to START + length, with its first two derivatives."""
    s = (t - START) / length
    if s <= 0.0:
        return 0.0, 0.0, 0.0
    if s >= 1.0:
        return 1.0, 0.0, 0.0
    return (s ** 3 * (10.0 - 15.0 * s + 6.0 * s * s),
            30.0 * (s * (1.0 - s)) ** 2 / length,
            60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / length ** 2)


def fade_length(terms):
    if len(terms) == 1 and terms[0][2] is None:
        return max(0.25 / terms[0][1], FADE_SHORT)
    return FADE_LONG


def value(terms, t, end):
    """Sum of the terms at time t with its first two time derivatives, in the unit of the amplitudes."""
    total = [0.0, 0.0, 0.0]
    x = t - START
    for amplitude, first, last, phase in terms:
        rate = 0.0 if last is None else 2.0 * math.pi * (last - first) / (end - START)
        omega = 2.0 * math.pi * first + rate * x
        psi = (2.0 * math.pi * first + 0.5 * rate * x) * x + phase
        total[0] += amplitude * math.sin(psi)
        total[1] += amplitude * omega * math.cos(psi)
        total[2] += amplitude * (rate * math.cos(psi) - omega * omega * math.sin(psi))
    e0, e1, e2 = fade(t, fade_length(terms)) if terms else (0.0, 0.0, 0.0)
    return (e0 * total[0], e1 * total[0] + e0 * total[1],
            e2 * total[0] + 2.0 * e1 * total[1] + e0 * total[2])


def state(pitch, plunge, t, end):
    """(angle [deg], its rates [rad per c/V, rad per (c/V)^2], plunge and its rates) off the mean."""
    a = value(pitch, t, end)
    w = value(plunge, t, end)
    return (a[0], math.radians(a[1]), math.radians(a[2])) + w


def table(pitch, plunge, end, step=0.02):
    """Rows of the solver's motion table; a few stand before 0 and beyond the end for its spline."""
    rows = []
    for i in range(-5, int(math.ceil((end + 1.0) / step))):
        angle, _, _, w, _, _ = state(pitch, plunge, i * step, end)
        # The solver turns about +z in degrees, anticlockwise; nose-up is clockwise.
        rows.append("(%.4f ((0 %.9g 0) (0 0 %.9g)))" % (i * step, w, -angle))
    return "%d\n(\n%s\n)\n" % (len(rows), "\n".join(rows))
