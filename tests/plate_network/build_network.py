#!/usr/bin/env python3
"""Builds docs/PLATE_NETWORK.md: the shipped network beside the other dynamic models, on records it has not seen, and
in marches of the paper's beam.

    build_network.py [--aerom build/release/bin/aerom] [--saved FOLDER]

Trains anew for the cross-validation of the shipped settings and of the paper's: minutes of processor time. With
--saved it reads what such trainings have printed from FOLDER/lags.csv and, where they are there, FOLDER/paper.csv and FOLDER/lstm.csv. The shipped file is
left as it is. Python 3 standard library."""

import argparse
import csv
import json
import math
import statistics
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "loops"))
import build_loops  # noqa: E402
import ask  # noqa: E402
import motion  # noqa: E402
import plunging  # noqa: E402

CFD = ROOT / "data" / "cfd"
PAGE = ROOT / "docs" / "PLATE_NETWORK.md"
DRAWING = ROOT / "docs" / "plate_network" / "plunging.svg"
NETWORK = ROOT / "data" / "networks" / "plate-4pct.json"
POLAR = ROOT / "data" / "polars" / "plate-4pct-channel.json"
FOLDS = "6"
CELLS = "7"  # of the LSTM: as many weights as the network of the paper
KNEE_DEG = 12.0  # beyond, the mesh of the records loses the vortices at rest
SETTLED = 12.0  # broadband records count from here on, in c/V; as aerom train
MODELS = (("none", "quasi-steady"), ("attached", "attached"), ("dynamic_stall", "dynamic stall"))
NETS = (("paper", "network of the paper"), ("lstm", "LSTM"), ("lags", "network with memory"))
SPEEDS = (3.0, 4.0, 5.0, 6.0, 7.0)
ANGLES = (-60, -45, 0, 30, 45)
STEPS = (2e-4, 1e-4)
DURATION = 2.0


def index():
    return {row["name"]: row for row in ask.rows(CFD / "index.csv")}


def fold_rows(text):
    """The lines of the cross-validation in what `aerom train --folds` prints."""
    table = text[text.index("record,part"):]
    return {row["record"]: row for row in csv.DictReader(table.splitlines()) if row["part"] == "fold"}


def cross_validated(aerom):
    with tempfile.TemporaryDirectory() as folder:
        options = ("--folds", FOLDS, "--output", Path(folder) / "net.json")
        lags = ask.run(ROOT / "data" / "networks" / "train_plate_4pct.sh", aerom, *options)
        paper = ask.run(aerom, "train", CFD, "--hidden", "50", "--samples", "60", *options)
    lstm = ask.run(Path(aerom).with_name("lstm_folds"), CFD, FOLDS, CELLS)
    return {"lags": fold_rows(lags), "paper": fold_rows(paper), "lstm": fold_rows(lstm)}


def saved(folder):
    files = {key: Path(folder) / (key + ".csv") for key, _ in NETS}
    return {key: fold_rows(path.read_text(encoding="ascii")) for key, path in files.items()
            if path.exists()}


def frequency_of(row):
    """Of a sine; None for a broadband record."""
    found = {term[1:3] for column in ("pitch", "plunge") for term in motion.parse(row[column])}
    first, last = found.pop() if len(found) == 1 else (None, None)
    return first if last is None else None


def window(row, record):
    """First sample that counts, and the first of the whole periods the work is taken over."""
    frequency = frequency_of(row)
    start = SETTLED if frequency is None else 2.0 + float(row["cycles_skipped"]) / frequency
    first = next(i for i, line in enumerate(record) if line["t"] >= start)
    if frequency is None:
        return first, first, 1.0
    samples = 1.0 / frequency / (record[1]["t"] - record[0]["t"])
    periods = math.floor((len(record) - first - 1) / samples + 1e-6)
    return first, len(record) - 1 - round(periods * samples), periods


def work(record, answer, begin, periods):
    total = 0.0
    for i in range(begin, len(record)):
        weight = 0.5 if i in (begin, len(record) - 1) else 1.0
        total += weight * (answer[i]["cm"] * record[i]["alpha_dot"]
                           + answer[i]["cl"] * record[i]["w_dot"])
    return total * (record[1]["t"] - record[0]["t"]) / periods


def model_errors(aerom, row):
    """Misfits in per cent of the range, and works per period, of the models without training."""
    path = CFD / "records" / (row["name"] + ".csv")
    record = ask.record(path)
    first, begin, periods = window(row, record)
    item = {"name": row["name"], "row": row, "frequency": frequency_of(row),
            "peak": max(abs(line["alpha_deg"] - math.degrees(line["w_dot"])) for line in record[first:]),
            "work": work(record, record, begin, periods)}
    for key, _ in MODELS:
        answer = ask.loop(aerom, "--dynamic", key, "--motion", path)
        item[key] = {"work": work(record, answer, begin, periods)}
        for c in ("cl", "cm"):
            model, reference = ({c: [line[c] for line in lines[first:]]} for lines in (answer, record))
            item[key][c] = build_loops.misfit(model, reference, c)
    return item


def collect(aerom, folds):
    rows, items = index(), []
    uncertain, _ = build_loops.work_uncertainties()
    kinds = {row["name"]: build_loops.uncertainty.kind(row) for row in ask.rows(CFD / "harmonics.csv")}
    for name in folds["lags"]:
        item = model_errors(aerom, rows[name])
        item["uncertain"], item["kind"] = uncertain.get(name), kinds.get(name)
        for key in folds:
            row = folds[key][name]
            item[key] = {c: 100.0 * float(row[c + "_rms"]) / float(row[c + "_range"])
                         for c in ("cl", "cm")}
            item[key]["work"] = float(row["network_work"])
        items.append(item)
    return items


def groups(items):
    sines = [i for i in items if i["frequency"] is not None]
    slow = [i for i in sines if i["frequency"] <= 0.2]
    yield "sines to 8 deg", [i for i in sines if i["peak"] <= 8.0]
    attaching = "those that reach below %g deg" % build_loops.uncertainty.OPEN_DEG
    for title, is_open in ((attaching, False), ("those over the open bubble", True)):
        yield title, [i for i in sines if i["peak"] <= 8.0 and (i["kind"] == build_loops.uncertainty.OPEN) == is_open]
    yield "slow sines to 8 deg", [i for i in slow if i["peak"] <= 8.0]
    yield "slow sines beyond", [i for i in slow if i["peak"] > 8.0]
    yield "fast sines to 8 deg", [i for i in sines if i not in slow and i["peak"] <= 8.0]
    yield "fast sines beyond", [i for i in sines if i not in slow and i["peak"] > 8.0]
    yield "broadband", [i for i in items if i["frequency"] is None]


def shown(items):
    """Keys and names of the models there are numbers of."""
    return [(key, name) for key, name in MODELS + NETS if key in items[0]]


def misfit_table(items):
    models = shown(items)
    yield "| records | number | " + " | ".join(name for _, name in models) + " |"
    yield "|---|---|" + "---|" * len(models)
    for title, group in groups(items):
        if group:
            cells = [title, "%d" % len(group)]
            cells += ["%.1f %%, %.1f %%" % tuple(statistics.median(i[key][c] for i in group)
                                                 for c in ("cl", "cm")) for key, _ in models]
            yield "| " + " | ".join(cells) + " |"


def energy_error(item, key):
    return abs(item[key]["work"] - item["work"]) / abs(item["work"])


def work_table(items):
    every = [i for i in items if i["frequency"] is not None]
    sines = [i for i in every if abs(i["work"]) > i["uncertain"]]
    past = [i for i in sines if i["peak"] > 8.0]
    models = shown(items)
    yield "| | " + " | ".join(name for _, name in models) + " |"
    yield "|---|" + "---|" * len(models)
    for title, group in (("sign right, peak angle to 8 deg", [i for i in sines if i not in past]),
                         ("sign right, beyond", past),
                         ("of these with pitch alone", [i for i in past if not i["row"]["plunge"]])):
        yield "| %s | " % title + " | ".join(
            "%d of %d" % (sum(i[key]["work"] * i["work"] > 0.0 for i in group), len(group))
            for key, _ in models) + " |"
    for title, group in (("work within its uncertainty, to 8 deg", [i for i in every if i["peak"] <= 8.0]),
                         ("work within its uncertainty, beyond", [i for i in every if i["peak"] > 8.0])):
        yield "| %s | " % title + " | ".join(
            "%d of %d" % (sum(abs(i[key]["work"] - i["work"]) <= i["uncertain"] for i in group), len(group))
            for key, _ in models) + " |"
    for title, group in (("median of the energy error, to 8 deg", [i for i in sines if i not in past]),
                         ("median of the energy error, beyond", past)):
        yield "| %s | " % title + " | ".join(
            "%.0f %%" % (100.0 * statistics.median(energy_error(i, key) for i in group))
            for key, _ in models) + " |"


def record_table(items):
    yield "| record | peak | work | dynamic stall: c_l, c_m, work | network with memory: c_l, c_m, work |"
    yield "|---|---|---|---|---|"
    for i in sorted(items, key=lambda i: (i["frequency"] is None, i["peak"])):
        cells = ["`%s`" % i["name"], "%.1f deg" % i["peak"], "%+.5f" % i["work"] + (" ± %.5f" % i["uncertain"] if i["uncertain"] else "")]
        cells += ["%.1f %%, %.1f %%, %+.5f" % (i[key]["cl"], i[key]["cm"], i[key]["work"])
                  for key in ("dynamic_stall", "lags")]
        yield "| " + " | ".join(cells) + " |"


SHIPPED_OPTIONS = ("--dynamic", "network", "--network", "plate-4pct")


def loop_harmonics(aerom, dynamic, frequency, amplitude, mean=0.0):
    """Complex c_l and c_m of small pitch, per radian of the angle."""
    rows = ask.loop(aerom, *dynamic, "--mean-deg", mean, "--amplitude-deg", amplitude, "--frequency", frequency,
                    "--cycles", 12, "--steps", 200)[-200:]
    result = {}
    for c in ("cl", "cm"):
        inphase = out = 0.0
        for k, row in enumerate(rows):
            psi = 2.0 * math.pi * (k + 1) / 200
            inphase += row[c] * math.sin(psi) / 100
            out += row[c] * math.cos(psi) / 100
        result[c] = complex(inphase, out) / math.radians(float(amplitude))
    return result


def harmonics_text(found):
    return ", ".join("%.2f %+.2fi" % (found[c].real, found[c].imag) for c in ("cl", "cm"))


def small_table(aerom):
    yield "| f c/V | Theodorsen (`attached`, linear polar): c_l, c_m | dynamic stall | network |"
    yield "|---|---|---|---|"
    for frequency in (0.03, 0.06, 0.125, 0.25, 0.5):
        found = [loop_harmonics(aerom, dynamic, frequency, 1.0)
                 for dynamic in (("--dynamic", "attached", "--polar", "flat-plate-linear"), ("--dynamic", "dynamic_stall"),
                                 SHIPPED_OPTIONS)]
        yield "| %g | %s |" % (frequency, " | ".join(map(harmonics_text, found)))


def small_records(aerom):
    """The same of the records of small pitch in attached flow, each in its own motion."""
    yield "| record | record: c_l, c_m | dynamic stall | network |"
    yield "|---|---|---|---|"
    rows = [row for row in ask.rows(CFD / "harmonics.csv")
            if row["cl_in"] and float(row["plunge_c"]) == 0.0 and row["mesh"] == "production" and row["re"] == "20000"
            and abs(float(row["mean_deg"])) + float(row["pitch_deg"]) <= 2.5]
    for row in sorted(rows, key=lambda row: float(row["frequency"])):
        motion_of_row = (row["frequency"], row["pitch_deg"], row["mean_deg"])
        found = [{c: complex(float(row[c + "_in"]), float(row[c + "_out"])) for c in ("cl", "cm")}]
        found += [loop_harmonics(aerom, dynamic, *motion_of_row)
                  for dynamic in (("--dynamic", "dynamic_stall"), SHIPPED_OPTIONS)]
        yield "| `%s` | %s |" % (row["name"], " | ".join(map(harmonics_text, found)))


def rest_error(aerom):
    """Largest increment in steady flow from 0 to 16 deg, in c_l and c_m."""
    worst = {"cl": 0.0, "cm": 0.0}
    for angle in [0.5 * k for k in range(33)]:
        steady, network = (ask.loop(aerom, *dynamic, "--mean-deg", angle, "--frequency", 0.1, "--cycles", 1,
                                    "--steps", 16)[0]
                           for dynamic in (("--dynamic", "none"), SHIPPED_OPTIONS))
        worst = {c: max(worst[c], abs(steady[c] - network[c])) for c in worst}
    return worst


def mesh_difference(largest_deg):
    """Largest difference of the steady means at mid-channel between the mesh of the records and that of the polar, up to
    an angle; from what the polar says of its origin."""
    origin = json.loads(POLAR.read_text(encoding="utf-8"))["provenance"]
    means = {p["alpha_deg"]: p for p in origin["production_mesh"] if p["plunge_c"] == 0.0}
    pairs = [(means[p["alpha_deg"]], p) for p in origin["statics"]
             if p["alpha_deg"] in means and p["alpha_deg"] <= largest_deg]
    return {c: max(abs(a[c] - b[c]) for a, b in pairs) for c in ("cl", "cm")}


def march(aerom, angle, speed, step, dynamic):
    case = json.loads((ROOT / "data" / "cases" / "paper-beam.json").read_text(encoding="utf-8"))
    case["beam"]["section"]["layup"][0]["angle_deg"] = angle
    case["flow"]["speed_m_s"] = speed
    case["solver"].update(time_step_s=step, duration_s=DURATION)
    case["aerodynamics"]["dynamic"] = dynamic
    return ask.document(aerom, case)


SHIPPED = {"type": "network", "name": "plate-4pct"}


def torsion(summary):
    root = summary["damping"]["tip_twist"]["torsion"]
    return "-" if root is None else "%.1f Hz, %+.3f" % (root["frequency_hz"], root["ratio"])


def beam_table(aerom):
    """Lines of the table, and the largest shares."""
    elements = 16
    lines, worst_hull, worst_turns, differ = [], 0.0, 0.0, 0
    for angle in ANGLES:
        for speed in SPEEDS:
            runs = [march(aerom, angle, speed, step, SHIPPED) for step in STEPS]
            base = march(aerom, angle, speed, STEPS[0], {"type": "dynamic_stall"})
            hull = [100.0 * r["counters"]["outside_hull"] / ((r["timing"]["steps"] + 1) * elements)
                    for r in runs]
            turns = [100.0 * r["counters"]["load_alternations"] / r["timing"]["steps"] for r in runs]
            verdicts = [r["verdict"] for r in runs]
            worst_hull, worst_turns = max(worst_hull, *hull), max(worst_turns, *turns)
            differ += verdicts[0] != verdicts[1]
            lines.append("| %d | %g | %s | %s | %s | %.2f, %.2f %% | %.2f, %.2f %% | %s: %s |" % (
                angle, speed, ", ".join(verdicts), torsion(runs[0]), torsion(runs[1]), *hull, *turns,
                base["verdict"], torsion(base)))
    return lines, worst_hull, worst_turns, differ


def cost_lines(aerom):
    """Processor time of a march for each station and step, the lifting line and the modes with it."""
    for name, dynamic in (("quasi-steady", {"type": "none"}), ("attached", {"type": "attached"}),
                          ("dynamic stall", {"type": "dynamic_stall"}), ("network", SHIPPED)):
        best = min(march(aerom, -45, 5.0, 2e-4, dynamic)["timing"]["us_per_step"]
                   for _ in range(3))
        yield "| %s | %.0f |" % (name, 1000.0 * best / 16)


def page(aerom, folds):
    before, small, plunge, beam, cost, after = Path(__file__).with_name("text.md").read_text(
        encoding="utf-8").split("<!-- numbers -->\n")
    items = collect(aerom, folds)
    yield before.rstrip("\n")
    yield ""
    yield "%d records. Medians of the misfits in c_l and c_m:" % len(items)
    yield ""
    yield from misfit_table(items)
    yield ""
    yield "Work of the sines; a sign counts where the work is larger than its uncertainty:"
    yield ""
    yield from work_table(items)
    yield ""
    yield small.strip("\n")
    yield ""
    yield from small_table(aerom)
    yield ""
    yield from small_records(aerom)
    yield ""
    worst = rest_error(aerom)
    meshes = mesh_difference(KNEE_DEG)
    yield ("In steady flow from 0 to 16 deg the network adds at most %.3f to c_l and %.4f to c_m. The mesh of the records and that of the "
           "polar differ by up to %.3f and %.4f up to %g deg, c_l with the same sign as the network at 4 to 12 deg: part of what it adds "
           "are the levels of its records." % (worst["cl"], worst["cm"], meshes["cl"], meshes["cm"], KNEE_DEG))
    yield ""
    yield plunge.strip("\n")
    yield ""
    rows = list(plunging.found(aerom, items))
    DRAWING.parent.mkdir(exist_ok=True)
    DRAWING.write_text(plunging.drawing(aerom, rows), encoding="utf-8")
    yield "![damping of small plunging over the frequency](plate_network/plunging.svg)"
    yield ""
    yield from plunging.table(rows)
    yield ""
    yield beam.strip("\n")
    yield ""
    lines, hull, turns, differ = beam_table(aerom)
    yield ("Largest share outside the hull %.2f %%, of steps at which the load turns back %.2f %%; verdicts that "
           "differ between the time steps: %d of %d." % (hull, turns, differ, len(lines)))
    yield ""
    yield ("| fibre angle | m/s | verdict at 2e-4, 1e-4 s | torsion at 2e-4 s | at 1e-4 s | outside the hull | "
           "turns back | dynamic stall |")
    yield "|---|---|---|---|---|---|---|---|"
    yield from lines
    yield ""
    yield cost.strip("\n")
    yield ""
    yield "| model | ns |"
    yield "|---|---|"
    yield from cost_lines(aerom)
    yield ""
    yield after.strip("\n")
    yield ""
    yield from record_table(items)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--aerom", default=str(ROOT / "build" / "release" / "bin" / "aerom"))
    parser.add_argument("--saved", metavar="FOLDER")
    arguments = parser.parse_args()
    folds = saved(arguments.saved) if arguments.saved else cross_validated(arguments.aerom)
    PAGE.write_text("\n".join(page(arguments.aerom, folds)) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
