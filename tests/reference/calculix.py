#!/usr/bin/env python3
"""Three-dimensional reference numbers for beams, computed with CalculiX. Python 3 standard library.

    calculix.py              run every case and write calculix.json (see README.md for the time)
    calculix.py CASE ...     run these cases and replace their records
    calculix.py --check CASE run the coarse bricks of one case, compare with the committed numbers
    calculix.py --list       names of the cases"""

import argparse
import json
import math
import sys
import time
from pathlib import Path

import ccx
from cases import all_cases
from motion import mode_record, tip_record

FOLDER = Path(__file__).resolve().parent
OUTPUT = FOLDER / "calculix.json"
MATERIALS = FOLDER.parents[1] / "data" / "materials"
MODES = 8
DIGITS = 7  # what the solver prints
CHECK_TOLERANCE = 1e-4  # relative, of --check
NOISE = 1e-5  # of the largest motion: what is below is rounding, stored as zero
UNIT_LOADS = {  # name -> (words of the load, direction of the tied tip)
    "tip_force_y": ({"tip_force_y_n": 1.0}, ("shift", 2)),
    "tip_force_x": ({"tip_force_x_n": 1.0}, ("shift", 1)),
    "tip_torque": ({"tip_moment_z_n_m": 1.0}, ("turn", 1)),
}


def load_materials():
    found = {}
    for path in sorted(MATERIALS.glob("*.json")):
        for material in json.loads(path.read_text(encoding="utf-8"))["materials"]:
            found[material["name"]] = material
    return found


def free_run(case, mesh, materials):
    """Modes, gravity and, for strips, the line load, with a free tip."""
    loads = {"gravity": ({"gravity_m_s2": ccx.GRAVITY_M_S2, "direction": "-y"}, {"gravity": True})}
    if case.chord_at:
        forces = mesh.line_load(case.chord_at)
        loads["line_force_y"] = ({"line_force_y_n_m": 1.0},
                                 {"nodal": {(n, 2): f for n, f in forces.items()}})
    moved, modes, mass = ccx.run(mesh, materials, [l[1] for l in loads.values()], MODES)
    static = {name: {"load": load[0], "tip": tip_record(mesh, table)}
              for (name, load), table in zip(loads.items(), moved)}
    return static, [mode_record(mesh, *m) for m in modes], mass


def tied_run(case, mesh, materials):
    """Unit loads on a tip section that moves rigidly in its plane and warps freely."""
    cards, shift, turn = ccx.rigid_tip_cards(mesh)
    ids = {"shift": shift, "turn": turn}
    loads = {name: (words, {"nodal": {(ids[node], direction): 1.0}})
             for name, (words, (node, direction)) in UNIT_LOADS.items()}
    if not case.chord_at:
        area = sum(mesh.tip_area.values())
        loads["tip_axial"] = ({"tip_force_z_n": 1.0}, {
            "nodal": {(n, 3): a / area for n, a in mesh.tip_area.items()}})
    moved, _, _ = ccx.run(mesh, materials, [l[1] for l in loads.values()], 0, cards)
    return {name: {"load": load[0], "tip": tip_record(mesh, table)}
            for (name, load), table in zip(loads.items(), moved)}


def run_model(case, name, materials):
    mesh = case.models[name](materials)
    static, modes, mass = free_run(case, mesh, materials)
    if mesh.tip_area:
        static.update(tied_run(case, mesh, materials))
    return {"element": mesh.element, "mesh": dict(mesh.description, elements=mesh.element_count(),
                                                  nodes=len(mesh.nodes)),
            "mass_kg": mass, "modes": modes, "static": clean(static)}


def noise(tip):
    """What is rounding in each entry of a tip record: lengths are measured by the largest and by the
    largest angle over a centimetre, angles by the largest and by the largest length over a metre."""
    unit = {k: math.radians(1) if k.endswith("_deg") else 1.0 for k in tip}
    length = max(abs(v) for k, v in tip.items() if k.endswith("_m"))
    angle = max(abs(v) * unit[k] for k, v in tip.items() if not k.endswith("_m"))
    size = {True: max(length, 0.01 * angle), False: max(angle, length)}
    return {k: NOISE * size[k.endswith("_m")] / unit[k] for k in tip}


def clean(static):
    """Zeroes what is rounding beside the largest motion of the same load, in metres and radians."""
    for entry in static.values():
        floor = noise(entry["tip"])
        entry["tip"] = {k: v if abs(v) > floor[k] else 0.0 for k, v in entry["tip"].items()}
    return static


def rounded(value):
    if isinstance(value, float):
        return float("%.*g" % (DIGITS, value))
    if isinstance(value, dict):
        return {k: rounded(v) for k, v in value.items()}
    return [rounded(v) for v in value] if isinstance(value, list) else value


def mesh_errors(coarse, fine):
    """What is left in the fine model if the error falls with the square of the element size: a third
    of the change from the coarse one, in the unit of the value. Written into the fine model."""
    for a, b in zip(coarse["modes"], fine["modes"], strict=True):
        b["mesh_error_hz"] = abs(b["frequency_hz"] - a["frequency_hz"]) / 3
    for name, entry in fine["static"].items():
        other = coarse["static"][name]["tip"]
        entry["mesh_error"] = {k: abs(v - other[k]) / 3 for k, v in entry["tip"].items()}


def run_case(case, materials):
    """The whole record of a case and its failed checks."""
    models = {}
    for name in case.models:
        started = time.monotonic()
        models[name] = run_model(case, name, materials)
        print("  %-12s %6d nodes %6.1f s" % (name, models[name]["mesh"]["nodes"],
                                             time.monotonic() - started), flush=True)
    for coarse in ("shell_coarse", "coarse"):
        if coarse in models:
            mesh_errors(models[coarse], models[coarse.replace("coarse", "fine")])
    checks = [{"what": what, "value": value, "expected": expected,
               "relative_error": value / expected - 1, "tolerance": tolerance}
              for what, value, expected, tolerance in case.checks(case, materials, models["fine"])]
    failed = [c for c in checks if not abs(c["relative_error"]) <= c["tolerance"]]
    for c in checks:
        print("  %s %-55s %12.5g, expected %12.5g (%+.2f %%)" % (
            "BAD" if c in failed else "ok ", c["what"], c["value"], c["expected"],
            100 * c["relative_error"]))
    for coarse in ("shell_coarse", "coarse"):  # shapes and loads of the fine models are enough
        for mode in models.get(coarse, {"modes": []})["modes"]:
            del mode["shape"]
    record = {"name": case.name, "note": case.note, "definition": case.definition(),
              "ccx_version": ccx.version(), "reference": "fine", "models": models, "checks": checks}
    return rounded(record), failed


def used_materials(cases, materials):
    text = json.dumps([c.definition() for c in cases])
    return {name: {k: v for k, v in m.items() if k != "name"} for name, m in materials.items()
            if json.dumps(name) in text}


def compact(value, indent=0):
    """JSON with one line for what is short."""
    line = json.dumps(value)
    if len(line) + indent <= 110 or not isinstance(value, (dict, list)):
        return line
    pad, end = "\n" + " " * (indent + 1), "\n" + " " * indent
    if isinstance(value, dict):
        body = ("," + pad).join("%s: %s" % (json.dumps(k), compact(v, indent + 1))
                                for k, v in value.items())
        return "{" + pad + body + end + "}"
    if all(isinstance(v, (int, float)) for v in value):
        return line
    return "[" + pad + ("," + pad).join(compact(v, indent + 1) for v in value) + end + "]"


def write(records, cases, materials):
    document = {"generator": "tests/reference/calculix.py",
                "provenance": "Computed with CalculiX (calculix-ccx of Debian 12); see README.md.",
                "materials": used_materials(cases, materials),
                "cases": [records[c.name] for c in cases if c.name in records]}
    OUTPUT.write_text(compact(document) + "\n", encoding="utf-8")


def committed():
    if not OUTPUT.is_file():
        return {}
    return {r["name"]: r for r in json.loads(OUTPUT.read_text(encoding="utf-8"))["cases"]}


def check(case, materials):
    """Differences between a new run of the coarse bricks and the committed record."""
    old, new = committed()[case.name]["models"]["coarse"], run_model(case, "coarse", materials)
    rows = [("mass", new["mass_kg"], old["mass_kg"], 0.0)]
    rows += [("mode %d" % (i + 1), a["frequency_hz"], b["frequency_hz"], 0.0)
             for i, (a, b) in enumerate(zip(new["modes"], old["modes"], strict=True))]
    for name, entry in old["static"].items():
        floor = noise(entry["tip"])
        rows += [("%s %s" % (name, k), new["static"][name]["tip"][k], v, floor[k])
                 for k, v in entry["tip"].items()]
    bad = [r[:3] for r in rows if not abs(r[1] - r[2]) <= CHECK_TOLERANCE * abs(r[2]) + r[3]]
    for what, value, expected in bad:
        print("%s: %s is %.7g, committed %.7g" % (case.name, what, value, expected))
    print("%s: %d numbers, %d differ by more than %g" % (case.name, len(rows), len(bad),
                                                         CHECK_TOLERANCE))
    return not bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--check", action="store_true", help="compare with the committed numbers")
    parser.add_argument("--list", action="store_true", help="names of the cases")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    arguments = parser.parse_args()
    cases, materials = list(all_cases()), load_materials()
    known = {c.name: c for c in cases}
    if arguments.list:
        print("\n".join(known))
        return 0
    unknown = [n for n in arguments.cases if n not in known]
    if unknown or (arguments.check and not arguments.cases):
        parser.error("no case %s; --list names them" % (", ".join(unknown) or "given"))
    chosen = [known[n] for n in arguments.cases] or cases
    if arguments.check:
        return 0 if all([check(c, materials) for c in chosen]) else 1
    records, failures = committed(), 0
    for case in chosen:
        print(case.name, flush=True)
        records[case.name], failed = run_case(case, materials)
        failures += len(failed)
        write(records, cases, materials)
    print("%d cases, %d failed checks" % (len(chosen), failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
