"""CalculiX as a function: a mesh and loads go in, displacements, natural modes and mass come out.

Every call writes one deck into a folder of its own, runs the solver on one thread and reads its
table output (.dat); nothing stays behind."""

import os
import re
import subprocess
import tempfile
from pathlib import Path

PROGRAM = "ccx"
GRAVITY_M_S2 = 9.80665
TIMEOUT_S = 1800


def version():
    """"2.20": the solver's own word."""
    text = subprocess.run([PROGRAM, "-v"], capture_output=True, text=True, check=False).stdout
    return re.search(r"Version (\S+)", text).group(1)


def rows(values, width=8):
    values = list(values)
    return "".join(", ".join(str(v) for v in values[i:i + width])
                   + (",\n" if i + width < len(values) else "\n")
                   for i in range(0, len(values), width))


def number(value):
    """The solver reads 20 characters of a field and drops the rest, be it the exponent."""
    return "%.12g" % value


def numbers(values):
    return ", ".join(map(number, values))


def material_cards(materials, names):
    """1 along the fibre, 2 across it in the wall, 3 through the wall."""
    for name in names:
        m = materials[name]
        yield "*MATERIAL, NAME=M%d\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n" % names.index(name)
        yield numbers((m["e_l_pa"], m["e_t_pa"], m["e_t_pa"], m["nu_lt"], m["nu_lt"], m["nu_tt"],
                       m["g_lt_pa"], m["g_lt_pa"])) + "\n"
        yield numbers((m["g_tt_pa"], 293.0)) + "\n*DENSITY\n%s\n" % number(m["density_kg_m3"])


def orientation_card(name, fibre, across):
    return "*ORIENTATION, NAME=%s, SYSTEM=RECTANGULAR\n%s\n" % (name, numbers((*fibre, *across)))


def mesh_cards(mesh, materials):
    yield "*NODE, NSET=NALL\n"
    for node, point in mesh.nodes.items():
        yield "%d, %s\n" % (node, numbers(point))
    names = sorted({k[0] for k in mesh.groups} if mesh.layers is None
                   else {m for _, m, _, _ in mesh.layers})
    yield from material_cards(materials, names)
    first = 1
    for index, (key, connectivity) in enumerate(mesh.groups.items()):
        yield "*ELEMENT, TYPE=%s, ELSET=E%d\n" % (mesh.element, index)
        for element, ids in enumerate(connectivity, first):
            yield rows((element, *ids), 12)
        first += len(connectivity)
        if mesh.layers is None:
            material, fibre, across = key
            yield orientation_card("O%d" % index, fibre, across)
            yield "*SOLID SECTION, ELSET=E%d, MATERIAL=M%d, ORIENTATION=O%d\n" % (
                index, names.index(material), index)
    if mesh.layers is not None:
        for index, (_, _, fibre, across) in enumerate(mesh.layers):
            yield orientation_card("O%d" % index, fibre, across)
        yield "*SHELL SECTION, ELSET=E0, COMPOSITE\n"
        for index, (thickness, material, _, _) in enumerate(mesh.layers):
            yield "%s, , M%d, O%d\n" % (number(thickness), names.index(material), index)
    yield "*ELSET, ELSET=EALL\n" + rows("E%d" % i for i in range(len(mesh.groups)))
    yield "*NSET, NSET=ROOT\n" + rows(mesh.root)
    printed = sorted({n for s in mesh.stations for n, *_ in s.nodes})
    yield "*NSET, NSET=PRINTED\n" + rows(printed)
    yield "*BOUNDARY\nROOT, 1, %d\n" % (3 if mesh.layers is None else 6)


def rigid_tip_cards(mesh):
    """Ties the in-plane motion of the tip section to (U, V) of one extra node and to the rotation,
    which is the first displacement of a second one; warping stays free. Returns (cards, ids)."""
    shift, turn = len(mesh.nodes) + 1, len(mesh.nodes) + 2
    cards = ["*NODE\n%d, 0, 0, 0\n%d, 0, 0, 0\n" % (shift, turn)]
    for node in mesh.tip_area:
        x, y, _ = mesh.nodes[node]
        for direction, arm in ((1, y), (2, -x)):
            terms = [(node, direction, 1.0), (shift, direction, -1.0)]
            terms += [(turn, 1, arm)] if arm else []
            cards.append("*EQUATION\n%d\n" % len(terms)
                         + rows(("%d, %d, %s" % (n, d, number(f)) for n, d, f in terms), 3))
    return cards, shift, turn


def static_step(load):
    """load: {"nodal": {(node, direction): force}} or {"gravity": True}."""
    text = "*STEP\n*STATIC\n*CLOAD, OP=NEW\n"
    text += "".join("%d, %d, %s\n" % (node, direction, number(force))
                    for (node, direction), force in load.get("nodal", {}).items())
    text += "*DLOAD, OP=NEW\n"
    if load.get("gravity"):
        text += "EALL, GRAV, %s, 0, -1, 0\n" % number(GRAVITY_M_S2)
    text += "*NODE PRINT, NSET=PRINTED\nU\n"
    text += "*EL PRINT, ELSET=EALL, TOTALS=ONLY\nEMAS\n" if load.get("gravity") else ""
    return text + "*END STEP\n"


def run(mesh, materials, loads, n_mode=0, extra=()):
    """Returns (displacements of every load, [(frequency_hz, shape)], mass or None); displacements
    and shapes are {node: (u, v, w)} at the stations, shapes mass-normalised."""
    cards = list(mesh_cards(mesh, materials)) + list(extra)
    cards += [static_step(load) for load in loads]
    if n_mode:
        cards.append("*STEP\n*FREQUENCY\n%d\n*NODE PRINT, NSET=PRINTED\nU\n*END STEP\n" % n_mode)
    with tempfile.TemporaryDirectory(prefix="ccx-") as folder:
        (Path(folder) / "job.inp").write_text("*HEADING\naeromd reference\n" + "".join(cards),
                                              encoding="ascii")
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        result = subprocess.run([PROGRAM, "-i", "job"], cwd=folder, env=environment, text=True,
                                capture_output=True, timeout=TIMEOUT_S, check=False)
        output = Path(folder) / "job.dat"
        if result.returncode or "*ERROR" in result.stdout or not output.is_file():
            raise RuntimeError("ccx failed:\n" + result.stdout[-3000:] + result.stderr)
        return read(output.read_text(encoding="ascii"), len(loads), n_mode)


def read(text, n_load, n_mode):
    """The tables of a .dat file, in the order of the steps."""
    tables, frequencies, mass, kind = [], [], None, None
    for line in text.splitlines():
        words = line.split()
        if line.startswith(" displacements"):
            kind = "displacement"
            tables.append({})
        elif line.startswith(" total mass for set"):
            kind = "mass"
        elif "E I G E N V A L U E   O U T P U T" in line:
            kind = "eigenvalue"
        elif line.startswith(" total") or "P A R T I C I P A T I O N" in line:
            kind = None
        elif kind == "displacement" and len(words) == 4:
            tables[-1][int(words[0])] = tuple(float(w) for w in words[1:])
        elif kind == "eigenvalue" and len(words) == 5 and words[0].isdigit():
            frequencies.append(float(words[3]))
        elif kind == "mass" and words:
            mass, kind = float(words[0]), None
    if len(tables) != n_load + n_mode or len(frequencies) != n_mode:
        raise RuntimeError("ccx wrote %d tables and %d frequencies"
                           % (len(tables), len(frequencies)))
    return tables[:n_load], list(zip(frequencies, tables[n_load:])), mass
