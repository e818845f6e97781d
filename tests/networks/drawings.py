"""The drawings of docs/NETWORKS.md. Python 3 standard library."""

import statistics
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "support"), str(TESTS / "loops")]
import build_loops  # noqa: E402
import svg  # noqa: E402
from study import MEMORY, NETWORKS, of, quantile  # noqa: E402

CASE = "pitch_m2.5_a5_f0.125"  # of Fig. B.16
TRAINED, HELD = svg.BLUE, svg.ORANGE
DRAWN = {("lm", 2): ("2 neurons", svg.ORANGE), ("lm", 50): ("50 neurons", svg.BLUE),
         ("lstm", 7): ("LSTM", svg.RED)}
PREFERRED = ("pitch_m5_a7_f0.25", "pitch_m8_a6_f0.06", "pitchplunge_m2.5_a4_w0.15_f0.125")
QUANTILES = (0.1, 0.25, 0.5, 0.75, 0.9)
WIDEST = 2.0  # energy errors beyond are drawn there


def examples(cycles):
    """[(part, record)] of Fig. B.19: two that are trained, two held out, and the case of Fig. B.16."""
    part = {c["name"]: c["part"] for c in cycles}
    pitching = [n for n in PREFERRED if n in part] + sorted(n for n in part if n.startswith("pitch"))
    found = []
    for wanted in ("trained", "held"):
        names = [n for n in dict.fromkeys(pitching) if part[n] == wanted and n != CASE]
        found += [(wanted, n) for n in names[:2]]
    return found + ([(part[CASE], CASE)] if CASE in part else [])


def text_of(part):
    return "held out" if part == "held" else part


def caption(cycles):
    shown = [(p, n) for p, n in examples(cycles) if n != CASE]
    yield "From left to right: %s." % ", ".join("`%s` (%s)" % (n, text_of(p)) for p, n in shown)
    part = dict((n, p) for p, n in examples(cycles)).get(CASE)
    if part:
        yield "The motion of Fig. B.16 is %s in this draw." % text_of(part)


def energy_unknown(study):
    """Median of what the flow computations do not know of the work of the pitch, by that work."""
    rows = build_loops.ask.rows(build_loops.CFD / "harmonics.csv")
    parts = build_loops.uncertainty.shares(rows)
    works = {study.records[r]["name"]: abs(study.records[r]["work_pitch"]) for r in study.pitching()}
    return statistics.median(build_loops.uncertainty.of_pitch_work(row, parts) / works[row["name"]]
                             for row in rows if row["name"] in works)


def energy(study):
    networks = [n for n in NETWORKS if n[0] == "lm"] + [MEMORY]
    ticks = [(i, "LSTM" if n == MEMORY else "%d" % n[1]) for i, n in enumerate(networks)]
    share = [(0.5 * k, "%d" % (50 * k)) for k in range(-4, 5)]
    parts, unknown = [], energy_unknown(study)
    for left, part, colour in ((70, "trained", TRAINED), (540, "held", HELD)):
        panel = svg.Panel(left, 46, 400, 300, svg.Axis(-0.6, len(networks) - 0.4, ticks, label="neurons"),
                          svg.Axis(-WIDEST, WIDEST, share, label="energy error [%]" if part == "trained" else ""),
                          "records %s" % text_of(part))
        for level in (-unknown, 0.0, unknown):
            panel.curve((-0.6, len(networks) - 0.4), (level, level), svg.BLACK, 1, dash="4 4" if level else "")
        for i, network in enumerate(networks):
            errors = study.energy_errors(network, part)
            panel.box(i, [quantile(errors, q) for q in QUANTILES], colour)
        parts.append(panel)
    notes = ("box: quartiles and median; line: 10 to 90 %; beyond 200 % drawn at 200 %; -100 %: no work at all, the polar alone",
             "dashed: how well the flow computations know it, ±%.0f %% (median)" % (100.0 * unknown))
    return svg.document(960, 446, "Energy error of a cycle over the number of neurons", parts + [
        '<text x="70" y="%d">%s</text>' % (408 + 20 * k, note) for k, note in enumerate(notes)])


def median_curve(rows, column):
    """Median over the draws at each epoch that all have."""
    by_epoch = {}
    for row in rows:
        by_epoch.setdefault(row["epoch"], []).append(row[column])
    draws = len({row["draw"] for row in rows})
    return [(e, statistics.median(v)) for e, v in sorted(by_epoch.items()) if len(v) == draws and e > 0]


def epochs(study):
    kinds = ((("lm", 50), "50 neurons, Levenberg-Marquardt", svg.BLUE), (("adam", 50), "50 neurons, Adam", svg.GREEN),
             (("lstm", 7), "LSTM, 7 cells, Adam", svg.RED))
    curves = [(median_curve(of(study.tables["curve"], network), column), colour, column)
              for network, _, colour in kinds for column in ("trained", "held")]
    values = [v for curve, _, _ in curves for _, v in curve]
    panels = []
    for left, column in ((70, "trained"), (540, "held")):
        panel = svg.Panel(left, 46, 400, 300,
                          svg.Axis(1, max(e for c, _, _ in curves for e, _ in c), log=True, label="epoch"),
                          svg.Axis.of(values, log=True, label="mean square error" if column == "trained" else ""),
                          "records %s" % text_of(column))
        for curve, colour, of_column in curves:
            if of_column == column:
                panel.curve(*zip(*curve), colour, 2)
        panels.append(panel)
    return svg.document(960, 430, "Mean square error over the epochs, median of the draws",
                        panels + svg.legend([(colour, name) for _, name, colour in kinds], 70, 412, 290))


def cycles_of(study, name):
    """{network: columns of its cycle}"""
    found = {}
    for row in study.tables["cycle"]:
        if row["name"] == name:
            columns = found.setdefault((row["model"], int(row["hidden"])), {k: [] for k in row})
            for key, value in row.items():
                columns[key].append(value)
    return found


def curves_of(cycles, networks, coefficient):
    """(values, colour, width) of record, polar and networks."""
    first = next(iter(cycles.values()))
    yield first["record_" + coefficient], svg.BLACK, 2.5
    yield first["steady_" + coefficient], svg.GREY, 1.5
    for network in networks:
        yield cycles[network][coefficient], DRAWN[network][1], 1.5


def names_of(networks):
    return ([(svg.BLACK, "flow computation"), (svg.GREY, "polar alone")]
            + [(DRAWN[n][1], DRAWN[n][0]) for n in networks])


def loop_panel(place, cycles, networks, coefficient, title, label, percent):
    angles = next(iter(cycles.values()))["alpha_deg"]
    curves = list(curves_of(cycles, networks, coefficient))
    panel = svg.Panel(*place, svg.Axis.of(angles, label=label),
                      svg.Axis.of([v for values, _, _ in curves for v in values]), title)
    for values, colour, width in curves:
        panel.curve(angles, values, colour, width, closed=True)
    build_loops.error_bar(panel, curves[0][0], percent[coefficient])
    return panel


def power_panel(place, cycles, networks):
    rate = next(iter(cycles.values()))["alpha_dot"]
    phase = [k / (len(rate) - 1) for k in range(len(rate))]
    curves = [([a * b for a, b in zip(values, rate)], colour, width)
              for values, colour, width in curves_of(cycles, networks, "cm")]
    panel = svg.Panel(*place, svg.Axis(0, 1, label="part of the period"),
                      svg.Axis.of([v for values, _, _ in curves for v in values]), "power c_p = c_m alpha_dot c/V")
    for values, colour, width in curves:
        panel.curve(phase, values, colour, width)
    return panel


def case(study):
    cycles, networks = cycles_of(study, CASE), (("lm", 2), ("lm", 50))
    label, percent = "angle of attack [deg]", build_loops.loop_uncertainty()[CASE]
    parts = [loop_panel((60, 46, 240, 260), cycles, networks, "cl", "c_l", label, percent),
             loop_panel((380, 46, 240, 260), cycles, networks, "cm", "c_m", label, percent),
             power_panel((700, 46, 240, 260), cycles, networks)]
    return svg.document(960, 412, "Pitch of 2.5 deg, amplitude 5 deg at f c/V = 0.125: 2 and 50 neurons",
                        parts + svg.legend(names_of(networks), 60, 372, 200) + [build_loops.bar_note(60, 396)])


def loops(study):
    networks, parts = (("lm", 50), ("lstm", 7)), []
    percent = build_loops.loop_uncertainty()
    shown = [(p, n) for p, n in examples(study.tables["cycle"]) if n != CASE]
    for i, (part, name) in enumerate(shown):
        cycles = cycles_of(study, name)
        for top, coefficient, label in ((46, "cl", ""), (300, "cm", "angle of attack [deg]")):
            parts.append(loop_panel((50 + 240 * i, top, 175, 190), cycles, networks, coefficient,
                                    "%s, %s" % (coefficient[0] + "_" + coefficient[1], text_of(part)), label, percent[name]))
    return svg.document(960, 602, "Loops of records trained and held out", parts +
                        svg.legend(names_of(networks), 60, 562, 200) + [build_loops.bar_note(60, 586)])


def all_of(study):
    """(file, text) of every drawing."""
    yield "energy.svg", energy(study)
    yield "epochs.svg", epochs(study)
    yield "loops.svg", loops(study)
    if any(row["name"] == CASE for row in study.tables["cycle"]):
        yield "case.svg", case(study)
