"""How far records can be trusted: what the same motion gives on another mesh or with another step.

The work of a cycle is a small difference of large loads: half the range of a load times the amplitude of
the motion, times pi, is what it would be a quarter cycle out of phase. Its error is counted in shares of
that size. Rows are those of ../harmonics.csv. Python 3 standard library."""

import math

# Beyond, the production mesh loses the vortices that leave the plate (../README.md): it says little of work there.
DEEP_DEG = 14.1
# A motion that never comes below it swings over a bubble that stays open, and sheds on its own.
OPEN_DEG = 3.0
ATTACHING, OPEN, DEEP = KINDS = ("attaching", "open", "deep")
CHANGES = ("_step0.01", "_step0.005", "_coarse")


def sizes(row):
    """Largest work that pitch and plunge could do with loads of this size."""
    amplitudes = (("cm", math.radians(float(row["pitch_deg"]))), ("cl", float(row["plunge_c"])))
    return [0.5 * math.pi * (float(row[c + "_max"]) - float(row[c + "_min"])) * a for c, a in amplitudes]


def checks(rows):
    """(row, the same motion computed otherwise) for all that were computed again."""
    by_name = {row["name"]: row for row in rows}
    for row in rows:
        for change in CHANGES:
            base = by_name.get(row["name"].removesuffix(change))
            if row["name"].endswith(change) and base is not None:
                yield base, row


def reach_deg(row):
    """Least and largest angle of the chord in the relative stream, the incidence of the plunge with it."""
    pitch, phase = float(row["pitch_deg"]), math.radians(float(row["phase_deg"] or 0.0))
    incidence = math.degrees(2.0 * math.pi * float(row["frequency"]) * float(row["plunge_c"]))
    mean, swing = abs(float(row["mean_deg"])), math.hypot(pitch + incidence * math.sin(phase), incidence * math.cos(phase))
    return mean - swing, mean + swing


def kind(row):
    """What the work of a row is known by."""
    least, largest = reach_deg(row)
    return DEEP if largest > DEEP_DEG else OPEN if least > OPEN_DEG else ATTACHING


def shares(rows):
    """Largest difference of the work in the checks, in shares of its size: {kind: share}."""
    found = dict.fromkeys(KINDS, 0.0)
    for base, other in checks(rows):
        for key, size in zip(("work_pitch", "work_plunge"), sizes(base)):
            if size > 0.0:
                part = abs(float(other[key]) - float(base[key])) / size
                found[kind(base)] = max(found[kind(base)], part)
    return found


def of_work(row, parts):
    """Uncertainty of the work of a row: mesh and step, a part of the size, and the scatter of its cycles."""
    return math.hypot(*(parts[kind(row)] * size for size in sizes(row)), float(row["work_sd"]))


def of_pitch_work(row, parts):
    """The same of the work of the pitch alone."""
    return math.hypot(parts[kind(row)] * sizes(row)[0], float(row["work_pitch_sd"]))
