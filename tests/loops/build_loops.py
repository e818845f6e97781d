#!/usr/bin/env python3
"""Builds docs/LOOPS.md and its drawings: the dynamic models beside the flow computations of data/cfd.

    build_loops.py [--aerom build/release/bin/aerom]

Every sine and broadband record of the index in the middle of the channel at Re 20,000 is run through
`aerom loop` with the shipped polar: of sines the last of 20 cycles is compared with the average cycle of the
record, of the others all samples after the start. Python 3 standard library."""

import argparse
import json
import math
import statistics
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CFD = ROOT / "data" / "cfd"
sys.path.insert(0, str(CFD / "campaign"))
sys.path.insert(0, str(ROOT / "tests" / "support"))
import ask  # noqa: E402
import build_harmonics  # noqa: E402
import motion  # noqa: E402
import uncertainty  # noqa: E402
import svg  # noqa: E402

PAGE = ROOT / "docs" / "LOOPS.md"
DRAWINGS = ROOT / "docs" / "loops"
POLAR = ROOT / "data" / "polars" / "plate-4pct-channel.json"
POINTS = build_harmonics.POINTS
CYCLES = 20
SETTLED = 6.0  # broadband records count from here on, in c/V
MODELS = (  # key, options of aerom, name, colour
    ("none", ("--dynamic", "none"), "quasi-steady", svg.GREY),
    ("attached", ("--dynamic", "attached"), "attached", svg.BLUE),
    ("stall", ("--dynamic", "dynamic_stall"), "dynamic stall", svg.RED),
    ("own", ("--dynamic", "dynamic_stall"), "dynamic stall, slope of the polar", None),
)
DRAWN = ("pitch_m0_a1_f0.125", "pitch_m2.5_a5_f0.125", "pitch_m5_a7_f0.25", "pitch_m8_a6_f0.06",
         "pitchplunge_m2.5_a4_w0.15_f0.125", "plunge_m4_w0.15_f0.08", "plunge_m8_w0.15_f0.08")


def index_rows(kind):
    """Lines of the index that are comparable, of the blocks of one kind, in the order of the design."""
    return [row for row in ask.rows(CFD / "index.csv") if row["status"] == "done"
            and row["block"].startswith(kind) and float(row["plunge_c"]) == 0.0 and row["re"] == "20000"]


def sine_rows():
    return index_rows("sine_")


def terms(row):
    """Pitch and plunge as (amplitude, frequency, phase [rad]); None where there is no motion."""
    result = []
    for column in ("pitch", "plunge"):
        parsed = motion.parse(row[column])
        result.append((parsed[0][0], parsed[0][1], parsed[0][3]) if parsed else None)
    return result


def average_cycle(row, frequency):
    """Mean of the counted cycles, and these."""
    record = build_harmonics.read(CFD / "records" / (row["name"] + ".csv"))
    cycles = build_harmonics.cycles_of(row, record, frequency)
    average = {key: [statistics.fmean(c[key][j] for c in cycles) for j in range(POINTS)]
               for key in ("cl", "cd", "cm")}
    return average, cycles


def work(cycle, pitch, plunge):
    """Integral of c_m d(alpha) + c_l dw over one cycle, positive when the flow feeds the motion."""
    total = 0.0
    for j in range(POINTS):
        psi = 2.0 * math.pi * j / POINTS
        if pitch:
            total += cycle["cm"][j] * math.radians(pitch[0]) * math.cos(psi + pitch[2])
        if plunge:
            total += cycle["cl"][j] * plunge[0] * math.cos(psi + plunge[2])
    return 2.0 * math.pi / POINTS * total


def model_cycle(aerom, options, polar, row, pitch, plunge):
    """The last cycle of a model, at the phases of the record."""
    frequency = (pitch or plunge)[1]
    options = [*options, "--polar", polar, "--mean-deg", row["mean_deg"], "--frequency", "%r" % frequency,
               "--cycles", CYCLES, "--steps", 2 * POINTS]
    shift = pitch[2] if pitch else 0.0  # the command counts phase from that of the pitch
    if pitch:
        options += ["--amplitude-deg", "%r" % pitch[0]]
    if plunge:
        options += ["--plunge", "%r" % plunge[0], "--phase-deg", "%r" % math.degrees(plunge[2] - shift)]
    last = ask.loop(aerom, *options)[-2 * POINTS - 1:-1][::2]
    turn = round(shift / (2.0 * math.pi) * POINTS)
    last = last[turn:] + last[:turn]
    return {key: [point[key] for point in last] for key in ("cl", "cd", "cm")}


def misfit(model, reference, key):
    """Rms of the difference over the range of the reference, in per cent."""
    square = statistics.fmean((a - b) ** 2 for a, b in zip(model[key], reference[key]))
    return 100.0 * math.sqrt(square) / (max(reference[key]) - min(reference[key]))


def own_slope(folder):
    """The shipped polar whose potential flow has its own slope, the largest of c_l/alpha in the linear
    range, and its own centre at small angles."""
    polar = json.loads(POLAR.read_text(encoding="utf-8"))
    row = min(range(len(polar["plunge_c"])), key=lambda i: abs(polar["plunge_c"][i]))
    points = [(a, cl, cm) for a, cl, cm in zip(polar["alpha_deg"], polar["cl"][row], polar["cm"][row])
              if 0 < a <= polar["linear_to_deg"]]
    best = (max(cl / math.radians(a) for a, cl, _ in points), points[0][2] / points[0][1])
    polar["dynamic_stall"] = {"lift_slope_per_rad": best[0], "lift_centre_c": best[1]}
    path = Path(folder) / "own.json"
    path.write_text(json.dumps(polar), encoding="utf-8")
    return path, best


def work_uncertainties():
    """{name: uncertainty of the work} of all sines, and the shares of its size it stands for."""
    rows = ask.rows(CFD / "harmonics.csv")
    parts = uncertainty.shares(rows)
    return {row["name"]: uncertainty.of_work(row, parts) for row in rows}, parts


def compare(aerom, row, own):
    pitch, plunge = terms(row)
    reference, _ = average_cycle(row, (pitch or plunge)[1])
    result = {"row": row, "pitch": pitch, "plunge": plunge, "cfd": reference,
              "work": work(reference, pitch, plunge)}
    for key, options, _, _ in MODELS:
        cycle = model_cycle(aerom, options, own if key == "own" else POLAR, row, pitch, plunge)
        result[key] = {"cycle": cycle, "work": work(cycle, pitch, plunge),
                       "misfit": {c: misfit(cycle, reference, c) for c in ("cl", "cd", "cm")}}
    return result


def compare_broadband(aerom, row, own):
    """Misfits over a whole record, and the mean power of the flow on the motion."""
    path = CFD / "records" / (row["name"] + ".csv")
    record = ask.record(path)
    first = next(i for i, line in enumerate(record) if line["t"] >= SETTLED)

    def series(lines):
        lines = lines[first:]
        power = statistics.fmean(c["cm"] * m["alpha_dot"] + c["cl"] * m["w_dot"]
                                 for c, m in zip(lines, record[first:]))
        return {"power": power, **{key: [line[key] for line in lines] for key in ("cl", "cd", "cm")}}

    result = {"row": row, "cfd": series(record)}
    for key, options, _, _ in MODELS:
        answer = series(ask.loop(aerom, *options, "--polar", own if key == "own" else POLAR, "--motion", path))
        result[key] = {"power": answer["power"],
                       "misfit": {c: misfit(answer, result["cfd"], c) for c in ("cl", "cd", "cm")}}
    return result


def relative_angle(item):
    """Angle of the chord in the relative stream, alpha - w_dot/V [deg], at the phases."""
    angles = []
    for j in range(POINTS):
        psi = 2.0 * math.pi * j / POINTS
        angle = float(item["row"]["mean_deg"])
        if item["pitch"]:
            angle += item["pitch"][0] * math.sin(psi + item["pitch"][2])
        if item["plunge"]:
            amplitude, frequency, phase = item["plunge"]
            angle -= math.degrees(2.0 * math.pi * frequency * amplitude * math.cos(psi + phase))
        angles.append(angle)
    return angles


def error_bar(panel, cycle, percent):
    """What meshes and steps make a record differ by, at the left edge of a panel."""
    low, high = min(cycle), max(cycle)
    middle, half = 0.5 * (low + high), 0.01 * percent * (high - low)
    x = panel.x_axis.low + 0.03 * (panel.x_axis.high - panel.x_axis.low)
    panel.curve((x, x), (middle - half, middle + half), svg.BLACK, 5)


def bar_note(left, top):
    """Says what error_bar draws."""
    text = "bar at the left: what other meshes and steps differ by (±, rms, the largest found)"
    return '<text x="%d" y="%d">%s</text>' % (left, top, text)


def drawing(item, percent):
    angles = relative_angle(item)
    drawn = [(svg.BLACK, item["cfd"], 2.5)]
    drawn += [(colour, item[key]["cycle"], 1.5) for key, _, _, colour in MODELS if colour]
    parts = []
    for left, key, title in ((60, "cl", "c_l"), (530, "cm", "c_m about mid-chord, nose-up")):
        panel = svg.Panel(left, 46, 400, 300,
                          svg.Axis.of(angles, label="angle of the chord in the relative stream [deg]"),
                          svg.Axis.of([v for _, cycle, _ in drawn for v in cycle[key]]), title)
        for colour, cycle, width in drawn:
            panel.curve(angles[::2], cycle[key][::2], colour, width, closed=True)
        error_bar(panel, item["cfd"][key], percent[key])
        parts.append(panel)
    names = [(svg.BLACK, "flow computation")] + [(c, n) for _, _, n, c in MODELS if c]
    return svg.document(960, 446, "Lift and moment of %s: flow computation and models" % item["row"]["name"],
                        parts + svg.legend(names, 60, 412, 190) + [bar_note(60, 434)])


def motion_text(item):
    parts = ["%g deg" % float(item["row"]["mean_deg"])]
    if item["pitch"]:
        parts.append("pitch %g deg" % item["pitch"][0])
    if item["plunge"]:
        parts.append("plunge %g c" % item["plunge"][0])
    if item["pitch"] and item["plunge"]:
        parts.append("%g deg ahead" % math.degrees(item["plunge"][2] - item["pitch"][2]))
    return ", ".join(parts)


def checks():
    """The same motion on other meshes and with other steps: (name, what changed, pitch, plunge, the two average
    cycles)."""
    again = index_rows("check_sine") + index_rows("check_drawn")
    base = {row["name"]: row for row in sine_rows() + again}
    for row in again:
        name, change = row["name"].rsplit("_", 1)
        if name in base:
            pitch, plunge = terms(row)
            frequency = (pitch or plunge)[1]
            yield (name, change, pitch, plunge,
                   *(average_cycle(r, frequency)[0] for r in (base[name], row)))


def loop_uncertainty():
    """{name of a sine: largest misfits of c_l and c_m between meshes and steps, in per cent of the range, in motions of
    its kind}; of deep stall there is but one check, and no drawing."""
    kinds = {row["name"]: uncertainty.kind(row) for row in ask.rows(CFD / "harmonics.csv")}
    worst = {kind: {"cl": 0.0, "cm": 0.0} for kind in uncertainty.KINDS}
    for name, *_, reference, other in checks():
        found = worst[kinds[name]]
        for c in found:
            found[c] = max(found[c], misfit(other, reference, c))
    return {name: worst[kind] for name, kind in kinds.items()}


def check_table():
    """What the flow computation does not know itself."""
    lines = []
    for name, change, pitch, plunge, reference, other in checks():
        lines.append("| `%s` | %s | %.1f %%, %.1f %% | %s, %s |" % (
            name, change, misfit(other, reference, "cl"), misfit(other, reference, "cm"),
            signed(work(reference, pitch, plunge)), signed(work(other, pitch, plunge))))
    if lines:
        yield "| record | changed | difference of c_l, c_m | work before, after |"
        yield "|---|---|---|---|"
        yield from lines


def broadband_table(items):
    yield "| record | mean power | " + " | ".join("%s: c_l, c_m, power" % name
                                                   for _, _, name, _ in MODELS) + " |"
    yield "|---|---|" + "---|" * len(MODELS)
    for item in items:
        cells = ["`%s`" % item["row"]["name"], signed(item["cfd"]["power"])]
        cells += ["%.0f %%, %.0f %%, %s" % (item[key]["misfit"]["cl"], item[key]["misfit"]["cm"],
                                          signed(item[key]["power"])) for key, _, _, _ in MODELS]
        yield "| " + " | ".join(cells) + " |"
    if len(items) > 1:
        cells = ["median", ""]
        cells += ["%.0f %%, %.0f %%" % tuple(statistics.median(i[key]["misfit"][c] for i in items)
                                             for c in ("cl", "cm")) for key, _, _, _ in MODELS]
        yield "| " + " | ".join(cells) + " |"


def same_sign(model, reference):
    """Rounding has no sign."""
    return abs(model) > 1e-6 and model * reference > 0.0


def signed(value):
    return "%+.5f" % (value + 0.0)


def table(items, uncertain):
    yield "| motion | f c/V | work | " + " | ".join(
        "%s: c_l, c_m, work" % name for _, _, name, _ in MODELS) + " |"
    yield "|---|---|---|" + "---|" * len(MODELS)
    for item in items:
        cells = [motion_text(item), "%g" % (item["pitch"] or item["plunge"])[1],
                 "%s ± %.5f" % (signed(item["work"]), uncertain[item["row"]["name"]])]
        cells += ["%.0f %%, %.0f %%, %s" % (item[key]["misfit"]["cl"], item[key]["misfit"]["cm"],
                                          signed(item[key]["work"])) for key, _, _, _ in MODELS]
        yield "| " + " | ".join(cells) + " |"


def uncertainty_lines(parts):
    yield ("Mesh and step change the work of the records computed again by at most %.1f %% of its size up to a peak angle of "
           "%.0f deg; by up to %.0f %% in small motions that stay above %.1f deg, where the bubble behind the edge never closes; by %.0f %% "
           "beyond %.0f deg, where the mesh loses the vortices that leave the plate: there no sign is known that is not the work of the plunge."
           % (100.0 * parts[uncertainty.ATTACHING], uncertainty.DEEP_DEG, 100.0 * parts[uncertainty.OPEN], uncertainty.OPEN_DEG,
              100.0 * parts[uncertainty.DEEP], uncertainty.DEEP_DEG))


def summary(items, uncertain):
    yield "| | " + " | ".join(name for _, _, name, _ in MODELS) + " |"
    yield "|---|" + "---|" * len(MODELS)
    for title, value in (
            ("c_l, median of the misfits", lambda i, k: i[k]["misfit"]["cl"]),
            ("c_m, median", lambda i, k: i[k]["misfit"]["cm"]),
            ("c_d, median", lambda i, k: i[k]["misfit"]["cd"])):
        yield "| %s | " % title + " | ".join(
            "%.0f %%" % statistics.median(value(i, key) for i in items) for key, _, _, _ in MODELS) + " |"
    pitching = [i for i in items if not i["plunge"]]
    if pitching:
        decided = [i for i in pitching if abs(i["work"]) > uncertain[i["row"]["name"]]]
        yield "| pitch: sign of the work right, where it is known | " + " | ".join(
            "%d of %d" % (sum(same_sign(i[key]["work"], i["work"]) for i in decided), len(decided))
            for key, _, _, _ in MODELS) + " |"
        scale = statistics.fmean(abs(i["work"]) for i in pitching)
        yield "| pitch: mean error of the work, over its mean size | " + " | ".join(
            "%.0f %%" % (100.0 * statistics.fmean(abs(i[key]["work"] - i["work"]) for i in pitching)
                         / scale) for key, _, _, _ in MODELS) + " |"


def page(items, broadband, own, uncertain, parts):
    with open(Path(__file__).with_name("text.md"), encoding="utf-8") as file:
        before, after = file.read().split("<!-- numbers -->\n")
    yield before.rstrip("\n")
    yield ""
    checks = list(check_table())
    if checks:
        yield "Records computed again on another mesh or with another step:"
        yield ""
        yield from checks
        yield ""
        yield from uncertainty_lines(parts)
        yield ""
    yield "%d sines. The slope and centre of the last column are the polar's own: %.2f per rad and %.3f c." % (
        len(items), own[0], own[1])
    yield ""
    yield from summary(items, uncertain)
    for title, moves in (("Pitch", (True, False)), ("Plunge", (False, True)), ("Pitch and plunge", (True, True))):
        group = [i for i in items if (bool(i["pitch"]), bool(i["plunge"])) == moves]
        if group:
            yield ""
            yield "## " + title
            yield ""
            yield from table(group, uncertain)
            for item in group:
                if item["row"]["name"] in DRAWN:
                    yield ""
                    yield "![%s at f c/V = %g](loops/%s.svg)" % (
                        motion_text(item), (item["pitch"] or item["plunge"])[1], item["row"]["name"])
    if broadband:
        yield ""
        yield "## Broadband"
        yield ""
        yield ("Several tones or a sweep at once, in pitch, plunge or both (data/cfd/design.csv); the "
               "misfits are over the range of the record, which its extremes stretch.")
        yield ""
        yield from broadband_table(broadband)
    yield ""
    yield after.rstrip("\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--aerom", default=str(ROOT / "build" / "release" / "bin" / "aerom"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path, own = own_slope(folder)
        items = [compare(arguments.aerom, row, path) for row in sine_rows()]
        broadband = [compare_broadband(arguments.aerom, row, path) for row in index_rows("broadband_")]
    items.sort(key=lambda i: ((i["pitch"] or i["plunge"])[1], float(i["row"]["mean_deg"])))
    percent = loop_uncertainty()
    for item in items:
        if item["row"]["name"] in DRAWN:
            (DRAWINGS / (item["row"]["name"] + ".svg")).write_text(drawing(item, percent[item["row"]["name"]]), encoding="utf-8")
    PAGE.write_text("\n".join(page(items, broadband, own, *work_uncertainties())) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
