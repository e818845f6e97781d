"""The program aerom, run as a user runs it. Needs AEROM, the program. Python 3 standard library."""

import json
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "data" / "cases"
AEROM = os.environ["AEROM"]
POUND, INCH = 4.4482216152605, 0.0254


def aerom(*arguments, text=None, url=None):
    environment = dict(os.environ)
    environment.pop("AEROM_URL", None)
    if url:
        environment["AEROM_URL"] = url
    return subprocess.run([AEROM, *map(str, arguments)], input=text, capture_output=True, text=True,
                          env=environment, timeout=250, check=False)


def short_case(**solver):
    """The paper's case, cut to 0.2 s so that it is quick under a sanitizer."""
    case = json.loads((CASES / "paper-beam.json").read_text(encoding="utf-8"))
    case["solver"].update({"duration_s": 0.2}, **solver)
    return case
