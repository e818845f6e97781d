"""The table of reference cases. A case says what the beam is (in the words of a case document), how
its two meshes are made, which loads it bears and which closed forms it must agree with."""

import math

import closed_form as cf
import sections
from span_mesh import no_taper, shell_strip, sweep

CFRP, FOAM, MINGUET, ALUMINIUM = "AS4/3501-6", "foam", "AS4/3501-6 Minguet", "aluminium"
INCH, POUND = 0.0254, 4.4482216152605
DEGREE = 180 / math.pi


class Case:
    """models: {name: function(materials) -> Mesh}, coarse before fine. checks: function(case,
    materials, model) -> [(what, value, expected, relative tolerance)]."""

    def __init__(self, name, note, length, section, models, chord_at=None, taper=None, checks=None):
        self.name, self.note, self.length, self.section = name, note, length, section
        self.models, self.chord_at, self.taper = models, chord_at, taper
        self.checks = checks or (lambda case, materials, model: [])

    def definition(self):
        beam = {"length_m": self.length, "section": self.section}
        if self.taper:
            beam["taper"] = self.taper
        return {"beam": beam}


# Strips ------------------------------------------------------------------------------------------

def strip_case(name, note, chord, length, plies, n_x, n_z, cells, tip_chord=None, tolerances=None):
    """cells: bricks through each ply in the coarse mesh; the fine one has twice the elements along
    span and chord."""
    ratio = (tip_chord or chord) / chord
    taper = (lambda z: 1 + (ratio - 1) * z / length) if tip_chord else no_taper

    def shell(k):
        return lambda m: shell_strip(chord, plies, length, k * n_z, k * n_x, m, taper)

    def solid(k, element="C3D20R"):
        return lambda m: sweep(sections.strip_blocks(chord, plies, k * n_x, cells), length, k * n_z,
                               m, element, taper)

    models = {"shell_coarse": shell(1), "shell_fine": shell(2), "coarse": solid(1),
              "fine": solid(2)}
    words = {"tip_chord_m": tip_chord, "law": "linear in z, about mid-chord"} if tip_chord else None
    case = Case(name, note, length, sections.strip(chord, plies), models,
                lambda z: chord * taper(z), words)
    case.chord, case.plies, case.tolerances = chord, plies, dict(
        {"plunge": 0.04, "twist": 0.08, "torque": 0.05, "frequency": 0.025}, **(tolerances or {}))
    case.checks = strip_checks
    return case


def is_sandwich(plies):
    return len(plies) == 3 and plies[1][0] == FOAM


def shear_compliance(plies, materials):
    """chord / (k G A) of a sandwich: its core bears the shear, over the distance of the faces'
    middles. Zero for other strips, whose shear deflection does not count."""
    if not is_sandwich(plies):
        return 0.0
    core = plies[1][2]
    return core / (materials[FOAM]["g_lt_pa"] * (core + plies[0][2])**2)


def expected_torque(case, compliance, materials):
    """Tip twist of a uniform strip under 1 N m [rad]."""
    if not is_sandwich(case.plies):
        return cf.strip_torque(compliance, case.chord, case.length)
    (face, angle, t), (core, _, h) = case.plies[:2]
    return cf.sandwich_torque((materials[face], t), (materials[core], h), angle, case.chord,
                              case.length)


def strip_checks(case, materials, model):
    compliance = cf.strip_compliance(case.plies, materials)
    shear = shear_compliance(case.plies, materials)
    plunge, twist = cf.strip_line_load(compliance, case.chord_at, case.length, shear)
    line = model["static"]["line_force_y"]["tip"]
    tolerance = case.tolerances
    checks = [("plunge under line load, lamination theory", line["plunge_m"], plunge,
               tolerance["plunge"])]
    if abs(twist) * case.chord > 1e-3 * abs(plunge):
        checks.append(("twist under line load, lamination theory", line["twist_deg"],
                       twist * DEGREE, tolerance["twist"]))
    if case.taper is None:
        checks.append(("twist under tip torque, lamination theory",
                       tip(model, "tip_torque", "twist_deg"),
                       DEGREE * expected_torque(case, compliance, materials), tolerance["torque"]))
    mass = sum(materials[m]["density_kg_m3"] * t for m, _, t in case.plies)
    mass *= cf.integrate(case.chord_at, case.length)
    checks.append(("mass", model["mass_kg"], mass, 1e-6))
    if case.taper is None and shear == 0.0 and abs(compliance[1]) < 0.02 * compliance[0]:
        hz = cf.bending_hz(case.chord / compliance[0], mass / case.length, case.length, 0)
        checks.append(("first bending, Euler-Bernoulli", first(model, "bending"), hz,
                       tolerance["frequency"]))
    return checks


def first(model, label):
    return next(m["frequency_hz"] for m in model["modes"] if m["label"] == label)


def paper_beam(angle):
    return strip_case("paper-beam-%s" % ("%d" % angle).replace("-", "m"),
                      "The paper's beam: one skin below the foam, free face of the foam above.",
                      0.1, 0.37, [(CFRP, angle, 0.00013), (FOAM, 0, 0.00387)], 6, 22, [1, 2],
                      tolerances={"torque": 0.06})


def sandwich(angle):
    return strip_case("sandwich-%d" % angle, "Two skins; the foam bears the transverse shear.", 0.1,
                      0.37, [(CFRP, angle, 0.00013), (FOAM, 0, 0.00374), (CFRP, angle, 0.00013)],
                      6, 22, [1, 2, 1], tolerances={"twist": 0.25, "torque": 0.08})


# Contours ----------------------------------------------------------------------------------------

def contour_case(name, note, length, section, n_width, n_height, n_z, checks):
    def solid(k):
        return lambda m: sweep(section.blocks(k * n_width, k * n_height), length, k * n_z, m,
                               "C3D20R")
    case = Case(name, note, length, section.definition(), {"coarse": solid(1), "fine": solid(2)},
                checks=checks)
    case.shape = section
    return case


def aluminium(t):
    return [(ALUMINIUM, 0, t)]


def tip(model, load, key):
    return model["static"][load]["tip"][key]


def box_checks(case, materials, model):
    """Isotropic box with or without web."""
    s, m, length = case.shape, materials[ALUMINIUM], case.length
    web = None if s.x_web is None else s.width / 2 - s.x_web
    p = cf.box(s.width, s.height, s.t, web)
    e, g, rho = m["e_l_pa"], m["g_lt_pa"], m["density_kg_m3"]
    inertia = rho * (p["i_flap"] + p["i_lag"])
    shear = length / (g * (2 + (web is not None)) * s.height * s.t)
    plunge = tip(model, "tip_force_y", "plunge_m") - (
        tip(model, "tip_force_y", "twist_deg") / DEGREE
        * (tip(model, "tip_force_y", "twist_deg") / tip(model, "tip_torque", "twist_deg")))
    return [("twist under torque, Bredt", tip(model, "tip_torque", "twist_deg"),
             DEGREE * length / (g * p["j"]), 0.03),
            ("first torsion, Bredt", first(model, "torsion"),
             cf.torsion_hz(g * p["j"], inertia, length), 0.03),
            ("plunge under tip force at the shear centre", plunge,
             length**3 / (3 * e * p["i_flap"]) + shear, 0.02),
            ("first bending", first(model, "bending"),
             cf.bending_hz(e * p["i_flap"], rho * p["area"], length, 0), 0.02),
            ("mass", model["mass_kg"], rho * p["area"] * length, 0.02)]


def open_checks(properties):
    """Channel and I-section: Vlasov."""
    def checks(case, materials, model):
        s, m, length = case.shape, materials[ALUMINIUM], case.length
        p = properties(s.width, s.height, sections.thickness(s.plies))
        gj, eiw = m["g_lt_pa"] * p["j"], m["e_l_pa"] * p["iw"]
        torque = tip(model, "tip_torque", "twist_deg")
        result = [("twist under torque, Vlasov", torque,
                   DEGREE * cf.restrained_twist(gj, eiw, length), 0.03),
                  ("mass", model["mass_kg"], m["density_kg_m3"] * p["area"] * length, 0.02)]
        if p["e"]:
            # The force acts on the web's middle, e in front of the shear centre: nose up.
            result.append(("shear centre behind the web",
                           tip(model, "tip_force_y", "twist_deg") / torque, p["e"], 0.03))
        return result
    return checks


def box_beam_checks(expected):
    """expected: [(load, key of the tip, value for the unit load, tolerance)] from the stiffness
    matrices of NABSA (Popescu and Hodges 2000)."""
    def checks(case, materials, model):
        del case, materials
        return [("%s of %s, NABSA stiffness" % (key, load), abs(tip(model, load, key)), value, tol)
                for load, key, value, tol in expected]
    return checks


def box_mode_checks(expected_hz):
    """First and second bending in the vertical plane, from the same stiffness."""
    def checks(case, materials, model):
        del case, materials
        found = [m["frequency_hz"] for m in model["modes"] if m["label"] == "bending"]
        return [("bending %d, NABSA stiffness" % (i + 1), value, hz, 0.03)
                for i, (value, hz) in enumerate(zip(found, expected_hz))]
    return checks


# Published for loads of 1 lb and 1 lb in.
CAS_STATIC = [("tip_force_y", "slope_plunge_rad", 1.070e-2 / POUND, 0.05),
              ("tip_force_y", "twist_deg", 1.113e-2 * DEGREE / POUND, 0.05),
              ("tip_torque", "twist_deg", 2.506e-3 * DEGREE / (POUND * INCH), 0.05),
              ("tip_torque", "slope_plunge_rad", 7.42e-4 / (POUND * INCH), 0.05)]
CUS_STATIC = [("tip_torque", "twist_deg", 3.431e-3 * DEGREE / (POUND * INCH), 0.05),
              ("tip_axial", "twist_deg", 2.565e-4 * DEGREE / POUND, 0.05),
              ("tip_force_y", "slope_plunge_rad", 1.243e-2 / POUND, 0.05)]


def chandra_box(layup):
    """Outer 24.21 x 13.46 mm, six plies of 0.127 mm; layup: "cus", "cas" or "aluminium"."""
    t = 0.000762
    size = (0.02421 - t, 0.01346 - t)
    plus, minus = [(CFRP, 15, t)], [(CFRP, -15, t)]
    side = [(CFRP, a, t / 6) for a in (15, -15) * 3]
    walls = {"cus": (plus, plus, plus, plus), "cas": (plus, side, minus, side),
             "aluminium": (aluminium(t),) * 4}[layup]
    return sections.Box(*size, *walls)


def box_cases():
    short, long = 0.762, 0.84455
    note = "Closed box of Chandra and Chopra, %s"
    cus, cas = note % "all walls +15 in s.", note % (
        "top +15 and bottom -15 in s (parallel in plan), side walls [15/-15]3.")
    yield contour_case("box-aluminium", note % "isotropic: check against Bredt.", short,
                       chandra_box("aluminium"), 6, 4, 60, box_checks)
    for tag, text, mesh, static, modes in (("cus", cus, (6, 4, 60), CUS_STATIC, (28.34, 177.6)),
                                           ("cas", cas, (2, 2, 24), CAS_STATIC, (30.00, 187.6))):
        yield contour_case("box-%s-15-static" % tag, text, short, chandra_box(tag), *mesh,
                           box_beam_checks(static))
        yield contour_case("box-%s-15-modes" % tag, text, long, chandra_box(tag), *mesh,
                           box_mode_checks(modes))


def two_cell(walls, web):
    return sections.Box(0.06, 0.02, *walls, web=web, x_web=0.01)


def all_cases():
    yield from (paper_beam(a) for a in (0, 45, -45, 30, 90))
    yield from (sandwich(a) for a in (0, 30))
    yield strip_case("strip-aluminium", "Isotropic: check against closed forms.", 0.06, 0.5,
                     aluminium(0.002), 4, 25, [2])
    yield strip_case("strip-30-4", "Solid angle-ply.", 0.03, 0.55, [(CFRP, 30, 0.000134)] * 4, 4,
                     40, [1] * 4)
    minguet = [(MINGUET, a, 0.000134) for a in (45, 0, 0, 45)]
    yield strip_case("strip-45-0-s", "[45/0]s, the strip of Minguet's frequencies.", 0.03, 0.55,
                     minguet, 4, 40, [1] * 4)
    yield strip_case("tapered-aluminium", "Linear taper, isotropic.", 0.06, 0.5, aluminium(0.002),
                     4, 25, [2], tip_chord=0.03)
    yield strip_case("tapered-45-0-s", "Linear taper, [45/0]s.", 0.06, 0.5, minguet, 4, 25, [1] * 4,
                     tip_chord=0.03)
    yield from box_cases()
    yield contour_case("two-cell-aluminium", "Web a third of the width behind the front wall.", 1.2,
                       two_cell((aluminium(0.0015),) * 4, aluminium(0.0015)), 9, 3, 40, box_checks)
    plies = {a: [(CFRP, a, 0.0015)] for a in (20, -20, 0, 45)}
    yield contour_case("two-cell-laminated", "Top +20 and bottom -20 in s, side walls 0, web 45.",
                       1.2,
                       two_cell((plies[20], plies[0], plies[-20], plies[0]), plies[45]), 9, 3, 40,
                       None)
    yield contour_case("channel-aluminium", "Web on the reference axis, flanges forward.", 0.6,
                       sections.Channel(0.025, 0.04, aluminium(0.0015)), 8, 8, 30,
                       open_checks(cf.channel))
    yield contour_case("i-section-aluminium", "Doubly symmetric.", 0.6,
                       sections.ISection(0.03, 0.04, aluminium(0.0015)), 12, 6, 30,
                       open_checks(cf.i_section))
