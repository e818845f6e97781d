#!/usr/bin/env python3
"""Builds docs/span-loads.svg: lift and drag along the paper's beam for each choice of walls.

    build_span.py [--aerom build/release/bin/aerom]

Prints the table of the guide. Python 3 standard library."""

import argparse
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import ask  # noqa: E402
import svg  # noqa: E402

CASE = ROOT / "data" / "cases" / "paper-beam.json"
DRAWING = ROOT / "docs" / "span-loads.svg"
VARIANTS = (  # name, lifting line, colour
    ("strip theory", None, svg.GREY),
    ("root and far wall", {"walls": "root_and_far", "width_m": 0.4}, svg.BLUE),
    ("root wall", {"walls": "root"}, svg.RED),
    ("no wall", {"walls": "none"}, svg.GREEN),
)
PANELS = (  # left, key, title, top of the scale
    (60, "lift_n_m", "lift per length [N/m]", 0.6),
    (530, "drag_n_m", "drag per length [N/m]", 0.1),
)


def variants(aerom):
    """(name, colour, means, loads) of the beam at rest in the stream, below stall."""
    case = json.loads(CASE.read_text(encoding="utf-8"))
    case["flow"].update({"speed_m_s": 4.0, "incidence_deg": 3.0})
    case["solver"].update({"duration_s": 0.1, "start": {"type": "equilibrium"}})
    found = []
    for name, lifting_line, colour in VARIANTS:
        case["aerodynamics"]["lifting_line"] = lifting_line
        found.append((name, colour, ask.document(aerom, case)["means"],
                      ask.document(aerom, case, "--document", "loads")))
    return found


def drawing(found):
    along = svg.Axis(0.0, 0.4, [(0.1 * k, "%g" % (0.1 * k)) for k in range(5)], label="along the span z [m]")
    parts = []
    for left, key, title, highest in PANELS:
        ticks = [(highest * k / 5.0, "%.2g" % (highest * k / 5.0)) for k in range(6)]
        panel = svg.Panel(left, 46, 400, 300, along, svg.Axis(0.0, highest, ticks), title)
        for _, colour, _, loads in found:
            panel.curve(loads["z_m"], loads[key], colour, 2)
        parts.append(panel)
    return svg.document(960, 430, "Lift and drag along the span of the paper's beam at 4 m/s and 3 deg",
                        parts + svg.legend([(colour, name) for name, colour, _, _ in found], 60, 412, 190))


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
