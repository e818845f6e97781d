#!/usr/bin/env python3
"""Builds docs/PAPER.md and docs/paper: the study of the paper, fibre angle and speed, with our models.

    build_paper.py [--aeromd build/release/bin/aeromd] [--workers 2] [--model network]

Starts a daemon of its own and asks it for studies, as a user would. A few minutes. Python 3 standard library."""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))

import cells  # noqa: E402
import results  # noqa: E402
import svg  # noqa: E402

PAGE = ROOT / "docs" / "PAPER.md"
DRAWINGS = ROOT / "docs" / "paper"
TEXT = Path(__file__).resolve().parent / "text.md"
COLOURS = (svg.BLUE, svg.BLACK, svg.RED, svg.ORANGE, svg.GREEN, svg.GREY)
SWING = "swings by 1 deg"
# Figs. 11, 12a and 13.
MAPS = (("verdict", "verdict"), ("twist", "tip_twist_deg"), ("plunge", "tip_plunge_m"),
        ("torsion", "damping.tip_twist"), ("swing", "tip_twist_rms_deg"),
        ("lift", "cl"), ("moment", "cm"), ("efficiency", "efficiency"))


def write(name, text):
    DRAWINGS.mkdir(exist_ok=True)
    (DRAWINGS / (name + ".svg")).write_bytes(text if isinstance(text, bytes) else text.encode())


def draw_means(found):
    """Figs. 9 and 10: tip plunge and twist over E* as long as they are small."""
    ticks = [(e, "%.1f" % (e / 1e6)) for e in (0.2e6, 0.4e6, 0.6e6, 0.8e6, 1.0e6, 1.2e6)]
    panels = []
    for k, (value, label, low, high) in enumerate((("tip_plunge_m", "tip plunge over length", 0.0, 1.0),
                                                   ("tip_twist_deg", "tip twist [deg]", 0.0, 4.0))):
        panel = svg.Panel(70 + 450 * k, 30, 360, 300, svg.Axis(0.0, 1.2e6, ticks, label="E* / 1e6"),
                          svg.Axis(low, high, label=label))
        for angle, colour in zip(results.MARKED, COLOURS):
            row = results.ANGLES.index(angle)
            points = [(cells.e_star_of(speed), y / 0.37 if value == "tip_plunge_m" else y)
                      for speed, y, verdict in zip(results.SPEEDS, found[value][row], found["verdict"][row])
                      if y is not None and verdict != "large_deflection" and cells.e_star_of(speed) < 1.2e6]
            if points:
                panel.curve(*zip(*points), colour, 2)
        panels.append(panel)
    write("means", svg.document(950, 430, "Mean tip plunge and twist over E*", panels + svg.legend(
        [(colour, "%d deg" % angle) for angle, colour in zip(results.MARKED, COLOURS)], 70, 405, 140)))


def samples(series):
    """(time, tip twist) of a series, thinned or not."""
    channel = series["channels"]["tip_twist_deg"]
    if "time_s" in channel:
        return list(zip(channel["time_s"], channel["value"]))
    return [(series["t0_s"] + k * series["step_s"], y) for k, y in enumerate(channel["value"])]


def draw_signals(moments):
    """Fig. 12b: tip twist over t V/c, {speed: marked points}."""
    panels = []
    for k, (speed, points) in enumerate(moments.items()):
        panel = svg.Panel(70 + 450 * k, 30, 360, 320, svg.Axis(0.0, 200.0, label="t V/c"),
                          svg.Axis(-4.0, 12.0, label="tip twist [deg]"), title="%.2f m/s" % speed)
        for angle, colour in zip(results.MARKED, COLOURS):
            shown = [(t * speed / 0.1, y) for t, y in samples(points[angle]["series"]) if t * speed < 20.0]
            panel.curve(*zip(*shown), colour, 1)
        panels.append(panel)
    write("signals", svg.document(950, 450, "Tip twist over time", panels + svg.legend(
        [(colour, "%d deg" % angle) for angle, colour in zip(results.MARKED, COLOURS)], 70, 425, 140)))


def draw_loads(points):
    """Fig. 7: lift and moment along the span of the marked points."""
    panels = []
    for k, (value, label, high) in enumerate((("cl", "c_l", 1.0), ("cm", "c_m about mid-chord", 0.12))):
        panel = svg.Panel(70 + 450 * k, 30, 360, 300, svg.Axis(0.0, 1.0, label="z / L"), svg.Axis(0.0, high, label=label))
        for angle, colour in zip(results.MARKED, COLOURS):
            loads = points[angle]["loads"]
            panel.curve([z / 0.37 for z in loads["z_m"]], loads[value], colour, 2)
        panels.append(panel)
    write("loads", svg.document(950, 430, "Mean loads along the span at E* = 0.4e6", panels + svg.legend(
        [(colour, "%d deg" % angle) for angle, colour in zip(results.MARKED, COLOURS)], 70, 405, 140)))


def draw_boundaries(curves):
    """The boundary of Figs. 11 and 12 for each dynamic part: [(name, rows)]."""
    low, high = results.FIELD["from"], results.FIELD["to"]
    panel = svg.Panel(70, 30, 840, 340,
                      svg.Axis(-90.0, 90.0, [(a, "%d" % a) for a in range(-90, 91, 15)],
                               label="fibre angle [deg], negative towards the leading edge"),
                      svg.Axis(low, high, [(v, "%d" % v) for v in range(low, high + 1, 2)], label="speed [m/s]"))
    for (_, rows), colour in zip(curves, COLOURS):
        points = [(angle, row["boundary"]) for angle, row in zip(results.BOUNDARY_ANGLES, rows)
                  if row["boundary"] is not None]
        if points:
            panel.curve(*zip(*points), colour, 2)
    write("boundaries", svg.document(950, 470, "Speed up to which the beam is stable", [panel] + svg.legend(
        [(colour, name) for (name, _), colour in zip(curves, COLOURS)], 40, 446, 150)))


def speed_text(row):
    if row["boundary"] is not None:
        return "%.2f%s" % (row["boundary"], " (more)" if row["more"] else "")
    if row["outcome"] == "not_bracketed":
        return "none" if row["holds_below"] else "always"
    return row["outcome"] or "failed"


def boundary_table(curves):
    yield "| fibres [deg] | %s |" % " | ".join(name for name, _ in curves)
    yield "|---" * (1 + len(curves)) + "|"
    for k, angle in enumerate(results.BOUNDARY_ANGLES):
        yield "| %d | %s |" % (angle, " | ".join(speed_text(rows[k]) for _, rows in curves))


def sensitivity_table(rows):
    yield "| changed | %s |" % " | ".join("%d deg" % angle for angle in results.DESIGNS)
    yield "|---" * (1 + len(results.DESIGNS)) + "|"
    for name, found in rows:
        yield "| %s | %s |" % (name, " | ".join(speed_text(row) for row in found))


def number(value, form="%.4g"):
    return "-" if value is None else form % value


def convergence_table(rows):
    heads = ["%d deg, %g m/s" % point for point in results.CONVERGENCE_POINTS]
    yield "| | | %s |" % " | ".join(heads)
    yield "|---" * (2 + len(heads)) + "|"
    for name, _, values in results.CONVERGENCE:
        for value in values:
            at = [row for row in rows if row["name"] == name and row["value"] == value]
            yield "| %s | %g | %s |" % (name, value, " | ".join("%s deg, %s m, %s %%" % (
                number(row["twist"]), number(row["plunge"]),
                number(None if row["damping"] is None else 100.0 * row["damping"], "%.2f")) for row in at))


def draw_convergence(rows):
    """Change of the mean tip twist and of the damping of torsion against the finest choice."""
    panels = []
    for k, (name, _, values) in enumerate(results.CONVERGENCE):
        values = sorted(values)
        panel = svg.Panel(80 + 310 * k, 30, 230, 260, svg.Axis.of(values, log=True, label=name),
                          svg.Axis(-10.0, 10.0, label="against the finest [%]" if k == 0 else ""))
        finest = values[0] if "step" in name else values[-1]
        for point, colour in zip(results.CONVERGENCE_POINTS, COLOURS):
            at = {row["value"]: row for row in rows if row["name"] == name and (row["angle"], row["speed"]) == point}
            for result, dash in (("twist", ""), ("plunge", "5 3")):
                panel.curve(values, [100.0 * (at[v][result] / at[finest][result] - 1.0) for v in values], colour, 2,
                            dash=dash)
        panels.append(panel)
    write("convergence", svg.document(1000, 390, "Convergence of mean tip twist and plunge", panels + svg.legend(
        [(colour, "%d deg, %g m/s" % point) for point, colour in zip(results.CONVERGENCE_POINTS, COLOURS)], 80, 365, 190)))


def modal_table(moments):
    yield "| speed [m/s] | fibres [deg] | position, modes 1 to 4 [%] | velocity, modes 1 to 4 [%] | verdict |"
    yield "|---|---|---|---|---|"
    for speed, points in moments.items():
        for angle in results.MARKED:
            summary = points[angle]["summary"]
            shares = [", ".join("%.1f" % (100.0 * s) for s in summary["modal_contribution"][key])
                      for key in ("position", "velocity")]
            yield "| %.2f | %d | %s | %s | %s |" % (speed, angle, *shares, summary["verdict"])


def structural_table(rows):
    yield "| damping ratio | %s |" % " | ".join("%d deg" % angle for angle in results.DESIGNS)
    yield "|---" * (1 + len(results.DESIGNS)) + "|"
    for ratio, found in rows:
        yield "| %g | %s |" % (ratio, " | ".join(speed_text(row) for row in found))


def rise_table(found, curves):
    """Mean tip twist and the rise of c_l over a rigid beam where the twist swings by 1 deg."""
    rows = dict(curves)[SWING]
    yield "| fibres [deg] | speed [m/s] | E* / 1e6 | tip twist there [deg] | rise of c_l over that at 2 m/s |"
    yield "|---|---|---|---|---|"
    for angle in range(-90, 91, 30):
        k, row = results.ANGLES.index(angle), rows[results.BOUNDARY_ANGLES.index(angle)]
        if row["boundary"] is None:
            yield "| %d | %s | | | |" % (angle, speed_text(row))
            continue
        last = max(j for j, speed in enumerate(results.SPEEDS) if speed <= row["boundary"])
        twist, lift, rigid = found["tip_twist_deg"][k][last], found["cl"][k][last], found["cl"][k][0]
        yield "| %d | %.2f | %.3f | %s | %s %% |" % (
            angle, row["boundary"], cells.e_star_of(row["boundary"]) / 1e6, number(twist, "%.2f"),
            number(lift and 100.0 * (lift / rigid - 1.0), "%.0f"))


def hull_share(found, fastest):
    """Largest share of evaluations outside the hull of the network in a cell of 16 stations, up to a speed."""
    return max(outside / (16.0 * steps)
               for row, counts in zip(found["counters.outside_hull"], found["timing.steps"])
               for speed, outside, steps in zip(results.SPEEDS, row, counts)
               if speed <= fastest and outside is not None and steps)


def middle_speed(rows):
    """Between the lowest and the highest boundary: some angles are beyond theirs there, some are not."""
    found = [row["boundary"] for row in rows if row["boundary"] is not None]
    return round(0.5 * (min(found) + max(found)), 2)


def compute(service, model, aerom):
    dynamic = dict(results.MODELS)[model]
    grid = results.the_map(service, dynamic)
    studies = {name: results.boundary_study(service, [(cells.DYNAMIC, d)], results.BOUNDARY_ANGLES, results.STABLE)
               for name, d in results.MODELS}
    studies[SWING] = results.boundary_study(service, [(cells.DYNAMIC, dynamic)], results.BOUNDARY_ANGLES, results.SWING)
    limit = studies[SWING].rsplit("/", 1)[1]
    for name, value in MAPS:
        write("map-" + name, service.get("%s/map?value=%s&format=svg&boundary=%s" % (grid, value, limit)))
    found = {value: service.get("%s/map?value=%s" % (grid, value))["values"] for value in results.VALUES}
    studies["tip bent by L/2"] = results.boundary_study(
        service, [(cells.DYNAMIC, dynamic)], results.BOUNDARY_ANGLES, results.HALF_A_LENGTH)
    curves = [(name, service.get(study + "/boundary")["rows"]) for name, study in studies.items()]
    for row in curves[-1][1]:
        row["more"] = False  # past flutter the mean plunge falls below it again: no news
    rows = [(name, results.boundaries(service, [(cells.DYNAMIC, dynamic), *changes], results.DESIGNS, results.SWING))
            for name, changes in results.SENSITIVITY]
    damped = [(ratio, results.boundaries(service, [(cells.DYNAMIC, dynamic), ("/solver/modal_damping_ratio", ratio)],
                                         results.DESIGNS, results.STABLE)) for ratio in results.STRUCTURAL]
    trained = [rows[0]] + [
        (name, results.boundaries(service, [(cells.DYNAMIC, dict(results.MODELS)["network"]), ("/networks", [network])],
                                  results.DESIGNS, results.SWING)) for name, network in results.trained_again(aerom)]
    speeds = (cells.speed_of(results.MARKED_E_STAR), middle_speed(dict(curves)[SWING]))
    moments = {speed: results.marked(service, dynamic, speed) for speed in speeds}
    return found, curves, moments, rows, damped, trained, results.convergence(service, dynamic)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--aeromd", default=str(ROOT / "build" / "release" / "bin" / "aeromd"))
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--model", default="network", choices=[name for name, _ in results.MODELS])
    arguments = parser.parse_args()
    with cells.Service(arguments.aeromd, arguments.workers) as service:
        found, curves, moments, rows, damped, trained, converged = compute(service, arguments.model,
                                                                   Path(arguments.aeromd).with_name("aerom"))
    draw_means(found)
    draw_signals(moments)
    draw_loads(next(iter(moments.values())))
    draw_boundaries(curves)
    draw_convergence(converged)
    tables = {"boundaries": boundary_table(curves), "sensitivity": sensitivity_table(rows), "trainings": sensitivity_table(trained),
              "convergence": convergence_table(converged), "modal": modal_table(moments),
              "rise": rise_table(found, curves),
              "structural": structural_table(damped)}
    page = TEXT.read_text(encoding="utf-8").replace("{model}", arguments.model)
    for name, fastest in (("{hull_9}", 9.0), ("{hull_10}", 10.0), ("{hull}", 16.0)):
        page = page.replace(name, "%.2g %%" % (100.0 * hull_share(found, fastest)))
    for name, lines in tables.items():
        page = page.replace("{%s}" % name, "\n".join(lines))
    PAGE.write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
