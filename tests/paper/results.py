"""The computations behind docs/PAPER.md: a plain tree of numbers. Python 3 standard library."""

import json
import subprocess
import tempfile
from pathlib import Path

import cells
from cells import ANGLE, DYNAMIC, SPEED

MODELS = (
    ("quasi-steady", {"type": "none"}),
    ("attached", {"type": "attached"}),
    ("dynamic stall", {"type": "dynamic_stall"}),
    ("network", {"type": "network", "name": "plate-4pct"}),
)
# The foam of Table 1 is not isotropic as it is printed; this is what it would be with its E and nu.
FOAM_586 = {"name": "isotropic foam", "e_l_pa": 15e6, "e_t_pa": 15e6, "g_lt_pa": 5.86e6, "g_tt_pa": 5.86e6,
            "nu_lt": 0.28, "nu_tt": 0.28, "density_kg_m3": 35}
ANGLES = [-90 + 5 * k for k in range(37)]
BOUNDARY_ANGLES = list(range(-90, 91, 10))
SPEEDS = [2.0 + 0.5 * k for k in range(29)]
VALUES = ("verdict", "tip_plunge_m", "tip_twist_deg", "cl", "counters.outside_hull", "timing.steps")
FIELD = {"pointer": SPEED, "from": 2, "to": 20, "tolerance": 0.05, "scan": 10}
STABLE = {"verdict": "stable"}
SWING = {"value": "means.tip_twist_rms_deg", "level": 1.0}
HALF_A_LENGTH = {"value": "means.tip_plunge_m", "level": 0.185}
MARKED_E_STAR = 0.4e6
MARKED = (-45, 0, 45, 90)
CHANNELS = {"channels": ["tip_twist_deg"]}
DESIGNS = (-68, -56, -44, 0, 45, 90)

# Name, what is changed against the paper's case.
SENSITIVITY = (
    ("as it stands", ()),
    ("lifting line with both side walls", (("/aerodynamics/lifting_line", {"walls": "root_and_far", "width_m": 0.4}),)),
    ("without side walls", (("/aerodynamics/lifting_line", {"walls": "none"}),)),
    ("no lifting line", (("/aerodynamics/lifting_line", None),)),
    ("linear polar of a thin plate, attached flow", (("/aerodynamics/polar", "flat-plate-linear"),
                                                     ("/aerodynamics/dynamic", {"type": "attached"}))),
    ("incidence 3 deg", (("/flow/incidence_deg", 3),)),
    ("incidence 7 deg", (("/flow/incidence_deg", 7),)),
    ("incidence 9 deg", (("/flow/incidence_deg", 9),)),
    ("walls that shear", (("/beam/section/wall_shear", "flexible"),)),
    ("rigid chord", (("/beam/section/chordwise_curvature", "rigid"),)),
    ("foam of 5.86 MPa", (("/materials", [FOAM_586]), ("/beam/section/layup/1/material", FOAM_586["name"]))),
    ("8 modes", (("/solver/modes", 8),)),
    ("modal damping of 1 %", (("/solver/modal_damping_ratio", 0.01),)),
)
# Damping ratios of all modes: what of the verdict a structure takes back.
STRUCTURAL = (0.0, 0.0025, 0.005, 0.01, 0.02)

# The shipped network made again, otherwise: name, options of its script.
TRAININGS = (
    ("other random numbers", ("--seed", "101")),
    ("and others", ("--seed", "201")),
    ("odd by construction (`--symmetric`)", ("--symmetric",)),
    ("squares of the errors (`--tolerance 0 --balance 0`)", ("--tolerance", "0", "--balance", "0")),
)

# Name, pointer, values; the first is the paper's.
CONVERGENCE = (
    ("elements", "/beam/elements", (16, 8, 32, 64)),
    ("modes", "/solver/modes", (4, 3, 6, 8, 10)),
    ("time step [s]", "/solver/time_step_s", (2e-4, 8e-4, 4e-4, 1e-4, 5e-5)),
)
CONVERGENCE_POINTS = ((-45, 6.0), (0, 6.0), (45, 8.0))


def the_map(service, dynamic):
    """Path of the finished study over all angles and speeds."""
    return service.study("grid", [(DYNAMIC, dynamic)], vary=[cells.axis(ANGLE, ANGLES), cells.axis(SPEED, SPEEDS)])


def boundary_study(service, changes, angles, criterion):
    """Path of the finished search for the lowest speed at which the criterion changes, over the angles."""
    return service.study("boundary", changes, field=FIELD, criterion=criterion, over=[cells.axis(ANGLE, angles)])


def boundaries(service, changes, angles, criterion):
    """[{boundary, outcome, ...}] over the angles: where the criterion changes."""
    return service.get(boundary_study(service, changes, angles, criterion) + "/boundary")["rows"]


def trained_again(aerom):
    """(name, network) of the trainings, each a minute."""
    script = cells.ROOT / "data" / "networks" / "train_plate_4pct.sh"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "network.json"
        for name, options in TRAININGS:
            subprocess.run([script, aerom, *options, "--output", path], check=True, stdout=subprocess.DEVNULL)
            yield name, json.loads(path.read_text(encoding="utf-8"))


def marked(service, dynamic, speed):
    """{angle: series, summary and loads along the span} of the marked angles at a speed."""
    found = {}
    for angle in MARKED:
        job = service.submit("/v1/jobs", cells.case_of([(DYNAMIC, dynamic), (ANGLE, angle), (SPEED, speed),
                                                        ("/output", CHANNELS)]))
        found[angle] = {"series": service.get(job + "/series?points=4000"), "summary": service.get(job + "/summary"),
                        "loads": service.get(job + "/loads")}
    return found


def convergence(service, dynamic):
    """[{name, value, angle, speed, twist, damping}]"""
    rows = []
    for name, pointer, values in CONVERGENCE:
        for angle, speed in CONVERGENCE_POINTS:
            found = service.grid([(DYNAMIC, dynamic), (ANGLE, angle), (SPEED, speed)], [(pointer, values)],
                                 ("tip_twist_deg", "tip_plunge_m", "damping.tip_twist"))
            rows += [{"name": name, "value": value, "angle": angle, "speed": speed, "twist": found["tip_twist_deg"][k],
                      "plunge": found["tip_plunge_m"][k], "damping": found["damping.tip_twist"][k]}
                     for k, value in enumerate(values)]
    return rows
