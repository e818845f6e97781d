#!/usr/bin/env python3
"""Builds ../design.csv, the list of all runs in the order in which they are to be computed.

Every prefix of the list is useful: first the angles of the polar at mid-channel, then all blocks in
proportion. Points of the sines come from a Halton sequence, the phases of the broadband records from
seeded random numbers, so that the same list is built anywhere. `--check` compares only.
"""

import argparse
import csv
import io
import math
import random
import sys
from pathlib import Path

TARGET = Path(__file__).resolve().parents[1] / "design.csv"
COLUMNS = ("name", "block", "mean_deg", "plunge_c", "re", "mesh", "thickness", "edge", "step", "end",
           "pitch", "plunge", "cycles_skipped", "cycles")
ATTACHED_DEG = 4.5  # above it the bubble of the leading edge opens and cycles differ
SETTLE = 8.0        # [c/V] of forced motion left out before cycles are counted
FAST = 0.2          # frequencies from here on take the short step and cost little
W_DOT_MAX = 0.12    # largest plunge rate of one tone [V]


def halton(index, base):
    """The index-th number of the Halton sequence of a base, in [0, 1)."""
    result, scale = 0.0, 1.0
    while index > 0:
        scale /= base
        index, digit = divmod(index, base)
        result += scale * digit
    return result


def between(low, high, share):
    return low + (high - low) * share


def log_between(low, high, share):
    return low * (high / low) ** share


def run(name, block, **settings):
    """One row of the design; what is not said is the standard: production mesh, Re 20,000, 4 %."""
    row = dict(mean_deg=0.0, plunge_c=0.0, re=20000, mesh="production", thickness=0.04, edge="square",
               step=0.01, end=40.0, pitch="", plunge="", cycles_skipped=0, cycles=0)
    row.update(settings, name=name, block=block)
    return row


def sine(name, block, mean, frequency, pitch=0.0, plunge=0.0, phase=0.0, **settings):
    """Pitch and plunge of one frequency, plunge ahead of pitch by `phase` degrees. The incidence
    the plunge rate makes counts when the record is sorted into attached or separated."""
    incidence = abs(mean) + math.hypot(pitch, math.degrees(2.0 * math.pi * frequency * plunge))
    skipped = max(1, math.ceil(SETTLE * frequency))
    cycles = 2 if incidence <= ATTACHED_DEG else 4
    cycles = max(cycles, math.ceil(1.5 * SETTLE * frequency))
    values = dict(step=0.01 if frequency >= FAST else 0.02, cycles_skipped=skipped, cycles=cycles,
                  end=math.ceil(2.0 + (skipped + cycles) / frequency))
    if pitch:
        values["pitch"] = "%g@%g+0" % (pitch, frequency)
    if plunge:
        values["plunge"] = "%g@%g+%g" % (plunge, frequency, phase)
    values.update(settings)
    return run(name, block, mean_deg=mean, **values)


def statics():
    """The polar at mid-channel: even angles first, then the odd ones."""
    for angle in list(range(0, 21, 2)) + list(range(1, 21, 2)):
        yield run("static_a%02d" % angle, "static", mean_deg=angle, end=40.0 if angle <= 6 else 60.0)


def statics_off_centre():
    """The effect of the plunge position; w < 0 follows by symmetry."""
    for plunge in (1.0, 0.5):
        for angle in (3, -3, 10, -10, 20, -20, 6, -6, 0, 15, -15):
            sign = "-" if angle < 0 else ""
            yield run("static_a%s%02d_w%g" % (sign, abs(angle), plunge), "static_plunge",
                      mean_deg=angle, plunge_c=plunge, end=30.0 if abs(angle) <= 6 else 50.0)


def statics_coarse():
    """The angles of the polar again on the coarse mesh, which is the next finer one; those of
    `slope_checks` are not repeated. On the production mesh the shedding of 13 to 17 deg dies out in the
    middle of the channel, and with it a fifth of the lift."""
    for angle in (14, 20, 18, 8, 10, 4, 0, 5, 3, 1):
        yield run("static_a%02d_coarse" % angle, "static_coarse", mean_deg=angle, mesh="coarse",
                  end=30.0 if angle <= 6 else 60.0)


def slow(share):
    return round(log_between(0.03, 0.16, share), 3)


def fast(share):
    return round(log_between(FAST, 0.8, share), 2)


def mean_angle(share):
    return round(2.0 * between(0.0, 12.0, share)) / 2.0


def pitch_amplitude(frequency, share):
    """1 to 8 deg slowly, less where the rate would be larger than a beam's."""
    return round(between(1.0, 8.0, share) * min(1.0, 0.25 / frequency), 1)


def plunge_amplitude(frequency, share):
    return float("%.2g" % (between(0.2, 1.0, share) * min(0.35, W_DOT_MAX / (2.0 * math.pi * frequency))))


def name_of(kind, mean, a, w, f):
    name = "%s_m%g" % ("pitchplunge" if kind == "both" else kind, mean)
    return name + ("_a%g" % a if a else "") + ("_w%g" % w if w else "") + "_f%g" % f


def sines():
    """Pitch, plunge and both at one frequency: slow ones between 0.03 and 0.16, where bending is, and
    fast ones up to 0.8, where torsion is."""
    for kind, slow_count, fast_count, offset in (("pitch", 20, 8, 1), ("plunge", 14, 6, 41),
                                                 ("both", 14, 6, 71)):
        for group, count, frequency_of in (("slow", slow_count, slow), ("fast", fast_count, fast)):
            start = offset if group == "slow" else offset + 200
            for i in range(start, start + count):
                f = frequency_of(halton(i, 2))
                mean = mean_angle(halton(i, 3))
                a = pitch_amplitude(f, halton(i, 5)) if kind != "plunge" else 0.0
                w = plunge_amplitude(f, halton(i, 7)) if kind != "pitch" else 0.0
                phase = 45.0 * math.floor(8.0 * halton(i, 11)) if kind == "both" else 0.0
                yield sine(name_of(kind, mean, a, w, f), "sine_%s_%s" % (kind, group), mean, f, a, w, phase)


def alternate(groups):
    """The rows of all groups, each at the same pace, so that a beginning of the list has some of each."""
    ranked = [((i + 0.5) / len(group), k, row) for k, group in enumerate(groups) for i, row in enumerate(group)]
    return [entry[2] for entry in sorted(ranked, key=lambda entry: entry[:2])]


def small_sines():
    """Motions that stay below stall, a peak angle of 2 to 7.5 deg with the incidence of the plunge: the
    other sines, drawn over all mean angles, leave few records there, and of small amplitude hardly any."""
    groups = []
    for kind, slow_count, fast_count, offset in (("pitch", 14, 18, 301), ("plunge", 10, 16, 341),
                                                 ("both", 8, 16, 371)):
        for group, count, frequency_of in (("slow", slow_count, slow), ("fast", fast_count, fast)):
            start = offset if group == "slow" else offset + 200
            groups.append([])
            for i in range(start, start + count):
                f = frequency_of(halton(i, 2))
                peak = between(2.0, 7.5, halton(i, 5))
                mean = round(2.0 * between(0.0, peak - 1.0, halton(i, 3))) / 2.0
                a, w, phase = 0.0, 0.0, 0.0
                if kind != "plunge":
                    a = round((peak - mean) * min(1.0, FAST / f), 1)
                if kind != "pitch":
                    w = float("%.2g" % (math.radians(peak - mean) / (2.0 * math.pi * f)))
                if kind == "both":  # half of it each, in the worst case one on top of the other
                    a, w = round(0.5 * a, 1), float("%.2g" % (0.5 * w))
                    phase = 45.0 * math.floor(8.0 * halton(i, 7))
                groups[-1].append(sine(name_of(kind, mean, a, w, f), "sine_small", mean, f, a, w, phase))
    return alternate(groups)


def torsion_sines():
    """Torsion past stall, where a stall flutter of torsion grows or ends: peak angles of 8 to 15 deg at
    f = 0.2 to 0.45, pitch alone and with the little plunge that a torsion mode has."""
    groups = []
    for kind, count, start in (("pitch", 22, 601), ("both", 12, 641)):
        groups.append([])
        for i in range(start, start + count):
            f = round(log_between(FAST, 0.45, halton(i, 2)), 2)
            peak = between(8.0, 15.0, halton(i, 5))
            mean = round(2.0 * between(0.0, 8.0, halton(i, 3))) / 2.0
            a = round(min(peak - mean, 9.0) * min(1.0, 0.3 / f), 1)
            w, phase = 0.0, 0.0
            if kind == "both":
                w = float("%.2g" % (between(0.02, 0.06, halton(i, 7)) / (2.0 * math.pi * f)))
                phase = 45.0 * math.floor(8.0 * halton(i, 11))
            groups[-1].append(sine(name_of(kind, mean, a, w, f), "sine_torsion", mean, f, a, w, phase))
    return alternate(groups)


def swings(block, kinds, frequencies, digits, means, incidences, pitch_share):
    """Small motions about an angle: `kinds` are (kind, count, start of the sequence), pitch a share of the swing
    of incidence, frequencies to so many digits."""
    groups = []
    for kind, count, start in kinds:
        groups.append([])
        for i in range(start, start + count):
            f = round(log_between(*frequencies, halton(i, 2)), digits)
            mean = round(2.0 * between(*means, halton(i, 3))) / 2.0
            swing = between(*incidences, halton(i, 5))
            a = round(pitch_share * swing, 1) if kind != "plunge" else 0.0
            w = float("%.2g" % (math.radians(swing) / (2.0 * math.pi * f))) if kind != "pitch" else 0.0
            phase = 45.0 * math.floor(8.0 * halton(i, 7)) if kind == "both" else 0.0
            groups[-1].append(sine(name_of(kind, mean, a, w, f), block, mean, f, a, w, phase))
    return alternate(groups)


def knee_sines():
    """About angles at which the bubble opens, at the frequencies at which sections on springs and the second bending
    of a beam begin to flutter: there the damping hangs on records like these."""
    return swings("sine_knee", (("pitch", 8, 701), ("plunge", 4, 721), ("both", 4, 741)), (0.1, 0.35), 3,
                  (3.5, 7.0), (0.5, 1.5), 1.0)


def shedding_sines():
    """About angles at which the flow sheds vortices, at their frequency and beyond, where the second and third bending
    of a beam are: mostly plunge, which other records hardly have there."""
    return swings("sine_shedding", (("plunge", 8, 801), ("both", 3, 821)), (0.5, 1.6), 2, (3.5, 8.0), (0.5, 1.2), 0.5)


def bubble_sines():
    """About angles at which the bubble is open, below the frequency of the shedding and at it, where the damping of small
    plunging changes fastest with the frequency and second bending and torsion of a beam are."""
    return swings("sine_bubble", (("plunge", 12, 901), ("both", 9, 921), ("pitch", 7, 941)), (0.3, 0.9), 2, (3.5, 8.0),
                  (0.4, 1.2), 0.7)


def beyond_sines():
    """Faster than the shedding, with swings that stand out of its scatter: what damps third bending there."""
    return swings("sine_beyond", (("plunge", 12, 1001), ("both", 6, 1021)), (0.85, 1.8), 2, (2.0, 8.0), (1.5, 3.5), 0.3)


def anchors(block, suffix="", points=None, **settings):
    """Cases of the literature and of earlier studies, repeated under other settings."""
    for mean, amplitude, frequency in points or ((2.5, 5, 0.125), (8, 6, 0.06), (5, 7, 0.25),
                                                 (0, 1, 0.125)):
        yield sine("pitch_m%g_a%g_f%g%s" % (mean, amplitude, frequency, suffix), block, mean,
                   frequency, amplitude, **settings)


def tones(rng, amplitude_of, count=8):
    """Tones between 0.03 and 0.8, five of eight below 0.15, random phases."""
    terms = []
    for i in range(count):
        low, high, j, n = (0.03, 0.15, i, 5) if i < 5 else (0.15, 0.8, i - 5, count - 5)
        f = round(log_between(low, high, (j + rng.random()) / n), 3)
        terms.append("%g@%g+%d" % (amplitude_of(f), f, 360.0 * rng.random()))
    return " ".join(terms)


def multisine(name, block, number, mean, pitch_scale=0.0, plunge_scale=0.0, **settings):
    """Eight tones in pitch, in plunge or in both (then of different frequencies). A pitch scale of 1
    is a tone of 1 deg up to f = 0.15 and of constant rate above; a plunge scale of 1 is a tone with a
    rate of 0.03 V, at most 0.12 c."""
    rng = random.Random(number)
    values = dict(step=0.02, end=102.0)
    if pitch_scale:
        values["pitch"] = tones(rng, lambda f: round(pitch_scale * min(1.0, 0.15 / f), 3))
    if plunge_scale:
        values["plunge"] = tones(
            rng, lambda f: round(plunge_scale * min(0.12, 0.03 / (2.0 * math.pi * f)), 4))
    values.update(settings)
    return run(name, block, mean_deg=mean, **values)


def broadband():
    """Records with many frequencies: multisines and linear sweeps."""
    pitch_means, both_means, plunge_means = ((2, 6, 0, 9, 4, 12), (3, 7, 0, 10, 5, 1, 8, 12, 2, 6),
                                             (2, 6, 10, 4))
    for i, mean in enumerate(pitch_means):
        yield multisine("multisine_pitch_m%g_%d" % (mean, i + 1), "broadband_pitch", 100 + i, mean,
                        pitch_scale=(2.0, 1.0)[i % 2])
    for i, mean in enumerate(both_means):
        yield multisine("multisine_pitchplunge_m%g_%d" % (mean, i + 1), "broadband_both", 200 + i, mean,
                        pitch_scale=(1.0, 1.6, 0.5)[i % 3], plunge_scale=(1.0, 1.4, 0.6)[i // 2 % 3])
    for i, mean in enumerate(plunge_means):
        yield multisine("multisine_plunge_m%g_%d" % (mean, i + 1), "broadband_plunge", 300 + i, mean,
                        plunge_scale=(1.4, 0.8)[i % 2])
    for mean, sweep in ((3, "5@0.03>0.2+0"), (8, "4@0.03>0.2+0"), (4, "1.5@0.2>0.8+0"),
                        (9, "1@0.2>0.8+0")):
        slow_sweep = ">0.2+" in sweep
        yield run("sweep_pitch_m%g_%s" % (mean, "slow" if slow_sweep else "fast"), "broadband_pitch",
                  mean_deg=mean, pitch=sweep, step=0.02 if slow_sweep else 0.01,
                  end=82.0 if slow_sweep else 42.0)
    for mean, sweep in ((2, "0.15@0.03>0.15+0"), (7, "0.15@0.03>0.15+0"), (5, "0.03@0.15>0.8+0")):
        slow_sweep = ">0.15+" in sweep
        yield run("sweep_plunge_m%g_%s" % (mean, "slow" if slow_sweep else "fast"), "broadband_plunge",
                  mean_deg=mean, plunge=sweep, step=0.02 if slow_sweep else 0.01,
                  end=82.0 if slow_sweep else 42.0)


def reynolds():
    """Two other Reynolds numbers: angles, sines, one broadband record each."""
    for re in (6000, 50000):
        for angle in (2, 10, 4, 6, 14):
            yield run("static_a%02d_re%d" % (angle, re), "reynolds", mean_deg=angle, re=re,
                      end=30.0 if angle <= 6 else 50.0)
        yield from anchors("reynolds", "_re%d" % re, ((2.5, 5, 0.125), (8, 6, 0.06)), re=re)
        yield multisine("multisine_pitchplunge_m6_re%d" % re, "reynolds", 400, 6, pitch_scale=1.0,
                        plunge_scale=1.0, re=re, end=62.0)


def slope_checks():
    """What the polar owes to mesh, thickness and leading edge."""
    def check(angle, suffix, **settings):
        settings.setdefault("end", 30.0 if angle <= 6 else 50.0)
        return run("static_a%02d_%s" % (angle, suffix), "check_static", mean_deg=angle, **settings)

    coarse, medium = dict(mesh="coarse", step=0.005), dict(mesh="medium", step=0.0025)
    return [check(2, "coarse", **coarse), check(16, "coarse", **coarse), check(12, "coarse", **coarse),
            check(6, "coarse", **coarse), check(2, "medium", end=24.0, **medium),
            check(2, "round", edge="round"), check(6, "round", edge="round"),
            check(2, "t2", thickness=0.02), check(12, "round", edge="round"),
            check(2, "t1", thickness=0.01)]


def motion_checks():
    """Sines again at half the step and on the coarse mesh."""
    first, stalled = (2.5, 5, 0.125), (8, 6, 0.06)
    yield from anchors("check_sine", "_step0.01", (first, stalled), step=0.01)
    yield from anchors("check_sine", "_coarse", (first,), mesh="coarse", step=0.005, cycles=2, end=26.0)
    yield sine("plunge_m4_w0.15_f0.08_step0.01", "check_sine", 4, 0.08, plunge=0.15, step=0.01)
    yield from anchors("check_sine", "_coarse", ((5, 7, 0.25),), mesh="coarse", step=0.005)
    yield sine("pitch_m12_a4_f0.06", "check_sine", 12, 0.06, 4)
    yield sine("pitch_m12_a4_f0.06_coarse", "check_sine", 12, 0.06, 4, mesh="coarse", step=0.01)


def drawn_checks():
    """Every seventh of the sines over the open bubble, of those at the knee, and of the small ones with those of torsion,
    in the order they are drawn in, on the coarse mesh with half the step: the anchors above are large motions. The
    first lot is drawn so that plunging about 4.5 deg at f = 0.43 is in it, where the flow feeds it."""
    for row in bubble_sines()[5::7] + knee_sines()[3::7] + (small_sines() + torsion_sines())[3::7]:
        yield dict(row, name=row["name"] + "_coarse", block="check_drawn", mesh="coarse", step=0.5 * row["step"])


def plunge_anchors():
    yield sine("plunge_m4_w0.15_f0.08", "sine_plunge_slow", 4, 0.08, plunge=0.15)
    yield sine("plunge_m8_w0.15_f0.08", "sine_plunge_slow", 8, 0.08, plunge=0.15)
    yield sine("pitchplunge_m2.5_a4_w0.15_f0.125", "sine_both_slow", 2.5, 0.125, 4, 0.15, 90.0)


def both_checks():
    """Pitch with plunge at half the step and on the coarse mesh: the work of the pitch is a small
    difference there."""
    for suffix, settings in (("step0.01", dict(step=0.01)), ("coarse", dict(mesh="coarse", step=0.01)),
                             ("step0.005", dict(step=0.005, cycles=2, end=26.0))):
        yield sine("pitchplunge_m2.5_a4_w0.15_f0.125_" + suffix, "check_sine_both", 2.5, 0.125, 4, 0.15,
                   90.0, **settings)


def document_rows():
    """All rows in order. Within a block the i-th of n rows has the rank x = (i + 1/2) / n, turned into
    a + b x: forward where others wait for it; the angles at mid-channel come before everything, the
    small sines, those of torsion and those at the knee after all other motions, the other Reynolds numbers after
    everything."""
    place = {"static": (0.0, 0.0), "static_coarse": (0.0, 0.04), "static_plunge": (0.0, 0.05),
             "check_static": (0.0, 0.15), "check_sine_both": (0.0, 0.1), "sine_small": (1.0, 0.5),
             "sine_torsion": (1.0, 0.5), "sine_knee": (1.5, 0.0), "sine_shedding": (1.5, 0.0),
             "sine_bubble": (1.5, 0.0), "sine_beyond": (1.5, 0.0),
             "check_drawn": (1.5, 0.5), "reynolds": (1.0, 1.0)}
    blocks = {}
    for source in (statics(), anchors("sine_pitch_slow"), plunge_anchors(), sines(), broadband(),
                   statics_off_centre(), statics_coarse(), slope_checks(), reynolds(), motion_checks(), both_checks(),
                   small_sines(), torsion_sines(), knee_sines(), shedding_sines(), bubble_sines(), beyond_sines(),
                   drawn_checks()):
        for row in source:
            blocks.setdefault(row["block"], []).append(row)
    ranked = []
    for k, (block, rows) in enumerate(blocks.items()):
        first, factor = place.get(block, (0.0, 1.0))
        ranked += [(first + factor * (i + 0.5) / len(rows), k, i, row) for i, row in enumerate(rows)]
    return [entry[3] for entry in sorted(ranked, key=lambda entry: entry[:3])]


def text_of(rows):
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in rows:
        writer.writerow(["%g" % row[c] if isinstance(row[c], float) else row[c] for c in COLUMNS])
    return buffer.getvalue()


def main():
    parser = argparse.ArgumentParser(description="Build design.csv.")
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail when the committed file differs")
    text = text_of(document_rows())
    if not parser.parse_args().check:
        TARGET.write_text(text, encoding="ascii")
        return 0
    if TARGET.exists() and TARGET.read_text(encoding="ascii") == text:
        return 0
    print("%s differs from what its script builds: run the script without --check" % TARGET,
          file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
