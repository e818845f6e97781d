#!/usr/bin/env python3
"""Builds docs/fibre-angle.svg: speeds of flutter and divergence of the paper's beam over the fibre angle.

    build_fibre.py [--aerom build/release/bin/aerom]

Prints the table of the guide. Python 3 standard library."""

import argparse
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import ask  # noqa: E402
import svg  # noqa: E402

CASE = ROOT / "data" / "cases" / "paper-beam-stability.json"
DRAWING = ROOT / "docs" / "fibre-angle.svg"
ANGLES = range(-90, 91, 5)
CURVES = (("divergence", svg.BLUE), ("flutter", svg.RED))
SLOW, FAST = 10.0, 22.0


def answer(aerom, angle):
    case = json.loads(CASE.read_text(encoding="utf-8"))
    case["beam"]["section"]["layup"][0]["angle_deg"] = angle
    return ask.document(aerom, case)


def speeds(aerom):
    """{instability: [(angle, speed)]}, without the angles whose range has none."""
    found = {kind: [] for kind, _ in CURVES}
    for angle in ANGLES:
        summary = answer(aerom, angle)
        for kind in found:
            if summary[kind] != "none_in_range":
                found[kind].append((angle, summary[kind]["speed_m_s"]))
    return found


def drawing(found):
    panel = svg.Panel(
        70, 30, 840, 340,
        svg.Axis(-90.0, 90.0, [(a, "%d" % a) for a in range(-90, 91, 15)],
                 label="fibre angle [deg], negative towards the leading edge"),
        svg.Axis(SLOW, FAST, [(v, "%d" % v) for v in range(int(SLOW), int(FAST) + 1, 2)], label="speed [m/s]"))
    for kind, colour in CURVES:
        panel.curve(*zip(*found[kind]), colour, 2.5)
    return svg.document(960, 470, "Speeds of flutter and divergence of the paper's beam over the fibre angle",
                        [panel] + svg.legend([(colour, kind) for kind, colour in CURVES], 70, 446, 290))


def table(found):
    yield "| fibres [deg] | divergence [m/s] | flutter [m/s] |"
    yield "|---|---|---|"
    for angle in range(-90, 91, 30):
        yield "| %d | %s |" % (angle, " | ".join("%.2f" % dict(found[kind])[angle] for kind, _ in CURVES))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--aerom", default=str(ROOT / "build" / "release" / "bin" / "aerom"))
    found = speeds(parser.parse_args().aerom)
    DRAWING.write_text(drawing(found), encoding="utf-8")
    print("\n".join(table(found)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
