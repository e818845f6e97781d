#!/usr/bin/env python3
"""Builds docs/span-loads.svg: lift and drag along the paper's beam for each choice of walls.

    build_span.py [--aerom build/release/bin/aerom]

Prints the table of the guide. Python 3 standard library."""

import argparse
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "data" / "cases" / "paper-beam.json"
DRAWING = ROOT / "docs" / "span-loads.svg"
WIDTH, HEIGHT, TOP = 400, 300, 46
VARIANTS = (  # name, lifting line, colour
    ("strip theory", None, "#9aa0a6"),
    ("root and far wall", {"walls": "root_and_far", "width_m": 0.4}, "#1f6fb4"),
    ("root wall", {"walls": "root"}, "#c5221f"),
    ("no wall", {"walls": "none"}, "#188038"),
)
PANELS = (  # left, key, title, top of the scale
    (60, "lift_n_m", "lift per length [N/m]", 0.6),
    (530, "drag_n_m", "drag per length [N/m]", 0.1),
)


def document(aerom, case, name):
    result = subprocess.run([aerom, "run", "-", "--document", name], input=json.dumps(case), text=True,
                            capture_output=True, check=True)
    return json.loads(result.stdout)


def variants(aerom):
    """(name, colour, means, loads) of the beam at rest in the stream, below stall."""
    case = json.loads(CASE.read_text(encoding="utf-8"))
    case["flow"].update({"speed_m_s": 4.0, "incidence_deg": 3.0})
    case["solver"].update({"duration_s": 0.1, "start": {"type": "equilibrium"}})
    found = []
    for name, lifting_line, colour in VARIANTS:
        case["aerodynamics"]["lifting_line"] = lifting_line
        found.append((name, colour, document(aerom, case, "summary")["means"],
                      document(aerom, case, "loads")))
    return found


def scale(low, high, from_, to):
    return lambda v: from_ + (v - low) / (high - low) * (to - from_)


def panel(left, key, title, highest, found):
    x = scale(0.0, 0.4, left, left + WIDTH)
    y = scale(0.0, highest, TOP + HEIGHT, TOP)
    yield '<rect x="%d" y="%d" width="%d" height="%d" fill="none" stroke="#555"/>' % (left, TOP, WIDTH, HEIGHT)
    yield '<text x="%d" y="%d" font-weight="bold">%s</text>' % (left, TOP - 8, title)
    for k in range(5):
        z = 0.1 * k
        yield '<text x="%.1f" y="%d" text-anchor="middle">%g</text>' % (x(z), TOP + HEIGHT + 16, z)
        value = highest * k / 5.0
        yield '<path d="M%d %.1f h%d" stroke="#ddd"/>' % (left, y(value), WIDTH)
        yield '<text x="%d" y="%.1f" text-anchor="end">%.2g</text>' % (left - 6, y(value) + 4, value)
    for _, colour, _, loads in found:
        points = " ".join("%.1f,%.1f" % (x(z), y(v)) for z, v in zip(loads["z_m"], loads[key]))
        yield '<polyline points="%s" fill="none" stroke="%s" stroke-width="2"/>' % (points, colour)
    yield '<text x="%d" y="%d" text-anchor="middle">along the span z [m]</text>' % (left + WIDTH // 2, 384)


def drawing(found):
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 430" width="960" height="430" '
           'font-family="sans-serif" font-size="13">',
           '<title>Lift and drag along the span of the paper\'s beam at 4 m/s and 3 deg</title>',
           '<rect width="960" height="430" fill="#ffffff"/>']
    for left, key, title, highest in PANELS:
        out += panel(left, key, title, highest, found)
    for i, (name, colour, _, _) in enumerate(found):
        out.append('<path d="M%d 412 h30" stroke="%s" stroke-width="2.5"/><text x="%d" y="416">%s</text>'
                   % (60 + 190 * i, colour, 96 + 190 * i, name))
    return "\n".join(out + ["</svg>"]) + "\n"


def table(found):
    yield "| walls | c_l | c_d | efficiency |"
    yield "|---|---|---|---|"
    for name, _, means, _ in found:
        yield "| %s | %.4f | %.5f | %.2f |" % (name, means["cl"], means["cd"], means["efficiency"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--aerom", default=str(ROOT / "build" / "release" / "bin" / "aerom"))
    found = variants(parser.parse_args().aerom)
    DRAWING.write_text(drawing(found), encoding="utf-8")
    print("\n".join(table(found)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
