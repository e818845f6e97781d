#!/usr/bin/env python3
"""Builds docs/FREE.md and its drawings: sections on springs in the flow computations of data/cfd/free and in
each dynamic model.

    build_free.py [--aerom build/release/bin/aerom]

Frequency, growth and limit cycle come from the turning points of the angle, of flow computation and model
alike; the onset is where the growth of small swings changes sign. Python 3 standard library."""

import argparse
import math
import statistics
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "loops"))
import build_loops  # noqa: E402
import ask  # noqa: E402
import svg  # noqa: E402

FREE = ROOT / "data" / "cfd" / "free"
PAGE = ROOT / "docs" / "FREE.md"
DRAWINGS = ROOT / "docs" / "free"
NETWORKS = sorted(path.stem for path in (ROOT / "data" / "networks").glob("*.json"))
MODELS = tuple((key, options, name, colour or svg.GREEN) for key, options, name, colour in build_loops.MODELS
               if key in ("none", "attached", "stall", "own"))
MODELS += tuple((name, ("--dynamic", "network", "--network", name), "network %s" % name, colour)
                for name, colour in zip(NETWORKS, (svg.ORANGE, "#8430ce", "#795548")))
EARLY, LATE = 10.0, 60.0  # [c/V]: swings between count for frequency and growth
LONG = 1200.0             # [c/V] until a model's limit cycle
STEADY = 0.001            # [V/c] growth below which a swing counts as a limit cycle
SMALLEST = 0.5            # [deg] and above which size
WIDEST = 20.0             # [deg] end of the polar


def turning_points(times, values):
    """(t, value) of the extremes, by the parabola through three samples."""
    found = []
    for i in range(1, len(values) - 1):
        a, b, c = values[i - 1:i + 2]
        if (b - a) * (c - b) < 0.0 or (b == a and b != c and i > 1 and (values[i - 2] - a) * (c - b) > 0):
            bend = a - 2.0 * b + c
            shift = 0.5 * (a - c) / bend
            found.append((times[i] + shift * (times[i + 1] - times[i]), b - 0.25 * (a - c) * shift))
    return found


def swings(times, values):
    """(middle, length, half the range) of each half cycle."""
    points = turning_points(times, values)
    return [(0.5 * (p[0] + q[0]), q[0] - p[0], 0.5 * abs(q[1] - p[1])) for p, q in zip(points, points[1:])]


def growth(some):
    """Slope of the logarithm of the size over time [V/c]."""
    t = [s[0] for s in some]
    y = [math.log(max(s[2], 1e-9)) for s in some]
    mean_t, mean_y = statistics.fmean(t), statistics.fmean(y)
    return (sum((a - mean_t) * (b - mean_y) for a, b in zip(t, y))
            / sum((a - mean_t) ** 2 for a in t))


def summary(times, values):
    """frequency, growth, size at the end and its growth there; None where nothing swings."""
    every = swings(times, values)
    early = [s for s in every if EARLY <= s[0] <= LATE and s[2] > 1e-3]
    result = dict.fromkeys(("frequency", "growth", "end", "end_growth"))
    if len(early) >= 4:
        result.update(frequency=0.5 / statistics.fmean(s[1] for s in early), growth=growth(early))
    if len(every) >= 8:
        result.update(end=statistics.fmean(s[2] for s in every[-4:]), end_growth=growth(every[-8:]))
    return result


def limit_cycle(found):
    """Words for how a motion ends."""
    if found["end"] is None or found["end"] < SMALLEST:
        return "none"
    if abs(found["end_growth"]) <= STEADY:
        return "%.1f deg" % found["end"]
    return "%.1f deg at the end, growth %+.4f" % (found["end"], found["end_growth"])


def index_rows():
    return [row for row in ask.rows(FREE / "index.csv") if row["status"] != "failed"]


def record_of(row):
    lines = ask.record(FREE / "records" / (row["name"] + ".csv"))
    return {key: [line[key] for line in lines] for key in ("t", "alpha_deg", "w")}


def march(aerom, options, polar, row, **changes):
    """A model of the section of one row: its series, and how it ended."""
    section = {"mass": row["mass"], "inertia": row["inertia"], "plunge_frequency": row["f_plunge"],
               "pitch_frequency": row["f_pitch"], "plunge_damping": row["zeta_plunge"],
               "pitch_damping": row["zeta_pitch"], "rest_deg": row["mean_deg"],
               "pitch_rate_deg": row["start_deg_per_t"], "duration": row["end"], "step": "0.02"}
    section.update(changes)
    lines = ask.run(aerom, "free", *("%s=%s" % item for item in section.items()), *options, "--polar",
                    polar).splitlines()
    rows = ask.numbers(lines[:-1])
    return {key: [row[key] for row in rows] for key in ("t", "alpha_deg", "w")}, lines[-1].split()[2]


def small_growth(aerom, options, polar, row, frequency):
    """Growth of small swings of a model at one frequency of the pitch, that of the plunge in proportion."""
    ratio = float(row["f_plunge"]) / float(row["f_pitch"])
    series, _ = march(aerom, options, polar, row, pitch_frequency="%r" % frequency,
                      plunge_frequency="%r" % (ratio * frequency), pitch_rate_deg="0.05", duration="150",
                      step="0.04")
    some = [s for s in swings(series["t"], series["alpha_deg"]) if s[0] > 40.0 and s[2] > 1e-4]
    return growth(some) if len(some) >= 4 else -1.0


def model_onset(aerom, options, polar, row, slowest=12.0):
    """Reduced velocity at which small swings change from decay to growth; None where they decay up to the
    slowest."""
    ratio = 1.04
    high = 4.0
    while small_growth(aerom, options, polar, row, 1.0 / (high * ratio)) < 0.0:
        high *= ratio
        if high > slowest:
            return None
    low, high = high, high * ratio
    for _ in range(8):
        middle = 0.5 * (low + high)
        if small_growth(aerom, options, polar, row, 1.0 / middle) < 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def cfd_onset(items, more=0.0):
    """The same of the flow computations, by a straight line between the two cases around it, were their
    growth larger by `more`."""
    known = sorted((1.0 / float(i["row"]["f_pitch"]), i["cfd"]["growth"] + more) for i in items)
    for (u, a), (v, b) in zip(known, known[1:]):
        if a < 0.0 <= b:
            return u + (v - u) * a / (a - b)
    return None


def standard(row):
    return row["mesh"] == "production" and row["step"] == "0.02"


def is_push(row):
    """Small at the start, so that the first swings tell the growth."""
    return float(row["start_deg_per_t"]) <= 1.0


def compare(aerom, row, own):
    series = record_of(row)
    item = {"row": row, "series": series, "cfd": summary(series["t"], series["alpha_deg"]),
            "w": summary(series["t"], series["w"])}
    for key, options, _, _ in MODELS:
        polar = own if key == "own" else build_loops.POLAR
        short, _ = march(aerom, options, polar, row)
        long, stop = march(aerom, options, polar, row, duration="%g" % LONG)
        item[key] = summary(short["t"], short["alpha_deg"])
        late = summary(long["t"], long["alpha_deg"])
        item[key].update(end=late["end"], end_growth=late["end_growth"], series=short, stop=stop,
                         widest=max(map(abs, long["alpha_deg"][-len(long["alpha_deg"]) // 4:])))
    return item


def model_limit(found):
    if found["stop"] != "duration":
        return "turns over"
    return limit_cycle(found) + (", beyond the polar" if found["widest"] > WIDEST else "")


def number(value, form):
    return "–" if value is None else form % value


def onset_table(items, onsets, error):
    cfd = cfd_onset(items)
    half = 0.5 * (cfd_onset(items, -error["growth"]) - cfd_onset(items, error["growth"]))
    yield "| | onset V/(f_θ c) | against the flow computation |"
    yield "|---|---|---|"
    yield "| flow computation | %.2f ± %.2f | |" % (cfd, half)
    for key, _, name, _ in MODELS:
        value = onsets[key]
        yield "| %s | %s | %s |" % (name, number(value, "%.2f") if value else "none up to 12",
                                    "%+.0f %%" % (100.0 * (value / cfd - 1.0)) if value and cfd else "")


def case_tables(items):
    names = [name for _, _, name, _ in MODELS]
    head = "| V/(f_θ c) | start, deg c/V | flow computation | " + " | ".join(names) + " |"
    rule = "|---|---|---|" + "---|" * len(names)
    for title, of in (
            ("Frequency f c/V between 10 and 60 c/V", lambda f: number(f["frequency"], "%.4f")),
            ("Growth of the swings between 10 and 60 c/V, per c/V", lambda f: number(f["growth"], "%+.4f")),
            ("Limit cycle, half the range of the angle", None)):
        yield ""
        yield "**%s**" % title
        yield ""
        yield head
        yield rule
        for item in items:
            row = item["row"]
            cells = ["%.2f" % (1.0 / float(row["f_pitch"])), row["start_deg_per_t"]]
            cells.append(of(item["cfd"]) if of else limit_cycle(item["cfd"]))
            cells += [of(item[key]) if of else model_limit(item[key]) for key, _, _, _ in MODELS]
            yield "| " + " | ".join(cells) + " |"


def checked(items, checks):
    """(case, its check, what was found in each over the time that both have)."""
    for row in checks:
        base = next(i for i in items if all(i["row"][k] == row[k] for k in ("f_pitch", "start_deg_per_t")))
        series = record_of(row)
        last = series["t"][-1]
        yield base, row, [summary(*([v for t, v in zip(s["t"], s[k]) if t <= last] for k in ("t", "alpha_deg")))
                          for s in (base["series"], series)]


def uncertainty(items, checks):
    """Largest change in the checks: of the frequency and of the size as shares, of the growth."""
    found = [pair for _, _, pair in checked(items, checks)]
    return {"frequency": max(abs(b["frequency"] / a["frequency"] - 1.0) for a, b in found),
            "growth": max(abs(b["growth"] - a["growth"]) for a, b in found),
            "end": max(abs(b["end"] / a["end"] - 1.0) for a, b in found)}


def check_table(items, checks):
    yield "| case | changed | frequency before, after | growth before, after | half the range at the end, deg |"
    yield "|---|---|---|---|---|"
    for base, row, found in checked(items, checks):
        changed = ", ".join("%s %s" % (key, row[key]) for key in ("mesh", "step")
                            if row[key] != base["row"][key])
        yield "| `%s` | %s | %s |" % (base["row"]["name"], changed, " | ".join(
            ", ".join(number(f[key], form) for f in found)
            for key, form in (("frequency", "%.4f"), ("growth", "%+.4f"), ("end", "%.2f"))))


def sheet(title, height, parts):
    names = [(svg.BLACK, "flow computation")]
    names += [(colour, name.replace("dynamic stall, ", "").replace("plate-4pct", "").strip()) for _, _, name, colour in MODELS]
    return svg.document(980, height, title, parts + svg.legend(names, 24, height - 18, 960 // len(names)))


def histories(items):
    """The angle over time of every case."""
    parts = []
    for k, item in enumerate(items):
        series = item["series"]
        values = series["alpha_deg"] + item["stall"]["series"]["alpha_deg"]
        panel = svg.Panel(60 + 470 * (k % 2), 46 + 290 * (k // 2), 400, 220,
                          svg.Axis(0.0, float(item["row"]["end"])), svg.Axis.of(values),
                          "V/(f c) = %.2f: angle [deg] over t V/c" % (1.0 / float(item["row"]["f_pitch"])))
        for key, _, _, colour in MODELS:
            model = item[key]["series"]
            panel.curve(model["t"][::20], model["alpha_deg"][::20], colour, 1.0)
        panel.curve(series["t"], series["alpha_deg"], svg.BLACK, 1.8)
        parts.append(panel)
    return sheet("Sections on springs: angle over time", 66 + 290 * ((len(items) + 1) // 2), parts)


def scan(aerom, items, own, error):
    """Growth and limit cycle of the models over the reduced velocity, marks with error bars where the flow was
    computed: open ones were still growing."""
    row = items[0]["row"]
    ratio = float(row["f_plunge"]) / float(row["f_pitch"])
    speeds = [5.5 + 0.25 * k for k in range(21)]
    rates = svg.Panel(60, 46, 400, 220, svg.Axis(5.5, 10.5), svg.Axis(-0.06, 0.04),
                      "growth of small swings [V/c] over V/(f c)")
    sizes = svg.Panel(530, 46, 400, 220, svg.Axis(5.5, 10.5), svg.Axis(0.0, 25.0),
                      "limit cycle, half range [deg] over V/(f c)")
    for key, options, _, colour in MODELS:
        polar = own if key == "own" else build_loops.POLAR
        rates.curve(speeds, [small_growth(aerom, options, polar, row, 1.0 / u) for u in speeds], colour)
        limits = []
        for u in speeds:
            series, stop = march(aerom, options, polar, row, pitch_frequency="%r" % (1.0 / u),
                                 plunge_frequency="%r" % (ratio / u), duration="%g" % LONG, step="0.04")
            if stop != "duration" or max(map(abs, series["alpha_deg"])) > WIDEST:
                break
            end = summary(series["t"], series["alpha_deg"])["end"]
            limits.append((u, end if end and end > SMALLEST else 0.0))
        sizes.curve(*zip(*limits), colour)
    for item in items:
        u = 1.0 / float(item["row"]["f_pitch"])
        if is_push(item["row"]):
            rates.mark(u, item["cfd"]["growth"], error["growth"])
        if item["cfd"]["end"] > 2.0:
            sizes.mark(u, item["cfd"]["end"], error["end"] * item["cfd"]["end"],
                 svg.BLACK if abs(item["cfd"]["end_growth"]) <= STEADY else "#ffffff")
    return sheet("Growth of small swings and limit cycles over the reduced velocity", 340, [rates, sizes])


def page(items, checks, onsets, error):
    with open(Path(__file__).with_name("text.md"), encoding="utf-8") as file:
        before, after = file.read().split("<!-- numbers -->\n")
    yield before.rstrip("\n")
    yield ""
    yield from onset_table([i for i in items if is_push(i["row"])], onsets, error)
    yield from case_tables(items)
    yield ""
    yield "![angle over time of the cases](free/histories.svg)"
    yield ""
    yield "![growth and limit cycles over the reduced velocity; open marks were still growing](free/scan.svg)"
    yield ""
    yield ("Computed again on another mesh or with another step. The largest change, %.1f %% of the frequency, %.4f in the growth and "
           "%.1f %% of the size, is the uncertainty of the flow computations here: the bars of the drawing, most of them smaller than "
           "their marks, and that of the onset." % (100.0 * error["frequency"], error["growth"], 100.0 * error["end"]))
    yield ""
    yield from check_table(items, checks)
    yield ""
    yield after.rstrip("\n")


def computed(aerom):
    """Cases in rising reduced velocity, their checks, and the onset of each model."""
    rows = sorted(index_rows(), key=lambda r: -float(r["f_pitch"]))
    with tempfile.TemporaryDirectory() as folder:
        own, _ = build_loops.own_slope(folder)
        items = [compare(aerom, row, own) for row in rows if standard(row)]
        onsets = {key: model_onset(aerom, options, own if key == "own" else build_loops.POLAR, rows[0])
                  for key, options, _, _ in MODELS}
        checks = [row for row in rows if not standard(row)]
        error = uncertainty(items, checks)
        drawing = scan(aerom, items, own, error)
    return items, checks, onsets, error, drawing


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--aerom", default=str(ROOT / "build" / "release" / "bin" / "aerom"))
    items, checks, onsets, error, drawing = computed(parser.parse_args().aerom)
    DRAWINGS.mkdir(exist_ok=True)
    (DRAWINGS / "histories.svg").write_text(histories(items), encoding="utf-8")
    (DRAWINGS / "scan.svg").write_text(drawing, encoding="utf-8")
    PAGE.write_text("\n".join(page(items, checks, onsets, error)) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
