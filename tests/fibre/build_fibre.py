#!/usr/bin/env python3
"""Builds docs/fibre-angle.svg: speeds of flutter and divergence of the paper's beam over the fibre angle.

    build_fibre.py [--aerom build/release/bin/aerom]

Prints the table of the guide. Python 3 standard library."""

import argparse
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "data" / "cases" / "paper-beam-stability.json"
DRAWING = ROOT / "docs" / "fibre-angle.svg"
ANGLES = range(-90, 91, 5)
CURVES = (("divergence", "#1f6fb4"), ("flutter", "#c5221f"))
LEFT, TOP, WIDTH, HEIGHT = 70, 30, 840, 340
SLOW, FAST = 10.0, 22.0


def answer(aerom, angle):
    case = json.loads(CASE.read_text(encoding="utf-8"))
    case["beam"]["section"]["layup"][0]["angle_deg"] = angle
    result = subprocess.run([aerom, "run", "-"], input=json.dumps(case), text=True, capture_output=True, check=True)
    return json.loads(result.stdout)


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
    def x(angle):
        return LEFT + (angle + 90.0) / 180.0 * WIDTH

    def y(speed):
        return TOP + (FAST - speed) / (FAST - SLOW) * HEIGHT

    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 470" width="960" height="470" '
           'font-family="sans-serif" font-size="13">',
           '<title>Speeds of flutter and divergence of the paper\'s beam over the fibre angle</title>',
           '<rect width="960" height="470" fill="#ffffff"/>',
           '<rect x="%d" y="%d" width="%d" height="%d" fill="none" stroke="#555"/>' % (LEFT, TOP, WIDTH, HEIGHT)]
    for angle in range(-90, 91, 15):
        out.append('<path d="M%.1f %d v%d" stroke="#eee"/><text x="%.1f" y="%d" text-anchor="middle">%d</text>'
                   % (x(angle), TOP, HEIGHT, x(angle), TOP + HEIGHT + 18, angle))
    for speed in range(int(SLOW), int(FAST) + 1, 2):
        out.append('<path d="M%d %.1f h%d" stroke="#ddd"/><text x="%d" y="%.1f" text-anchor="end">%d</text>'
                   % (LEFT, y(speed), WIDTH, LEFT - 8, y(speed) + 4, speed))
    out.append('<text x="%d" y="%d" text-anchor="middle">fibre angle [deg], negative towards the leading edge</text>'
               % (LEFT + WIDTH // 2, TOP + HEIGHT + 40))
    out.append('<text x="20" y="%d" transform="rotate(-90 20 %d)" text-anchor="middle">speed [m/s]</text>'
               % (TOP + HEIGHT // 2, TOP + HEIGHT // 2))
    for i, (kind, colour) in enumerate(CURVES):
        points = " ".join("%.1f,%.1f" % (x(a), y(v)) for a, v in found[kind])
        out.append('<polyline points="%s" fill="none" stroke="%s" stroke-width="2.5"/>' % (points, colour))
        out.append('<path d="M%d 446 h30" stroke="%s" stroke-width="2.5"/><text x="%d" y="450">%s</text>'
                   % (LEFT + 290 * i, colour, LEFT + 36 + 290 * i, kind))
    return "\n".join(out + ["</svg>"]) + "\n"


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
