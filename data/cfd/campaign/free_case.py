"""The case of a plate on springs: free pitch about mid-chord and free plunge in the flow of `case.py`.

Per unit span, by density, speed and chord: mass m, moment of inertia I about mid-chord, where the
mass centre and both springs are, frequencies f c/V of each freedom alone in a vacuum, damping ratios. The
springs are without load at the mean position. Time in c/V.
"""

import math

import case
from mesh import SPAN

INNER, OUTER = 0.62, 1.5  # points nearer move with the section, those beyond stand still

BODY = """dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (sixDoFRigidBodyMotion);
motionSolver sixDoFRigidBodyMotion;
sixDoFRigidBodyMotionCoeffs
{
    patches (section); innerDistance %(inner)g; outerDistance %(outer)g;
    rho rhoInf; rhoInf %(density).9g; report off; accelerationRelaxation 1;
    mass %(mass).9g; momentOfInertia (%(inertia).9g %(inertia).9g %(inertia).9g);
    centreOfMass (0 0 %(middle)g); angularMomentum (0 0 %(momentum).9g);
    solver { type symplectic; }
    constraints
    {
        plunge { sixDoFRigidBodyMotionConstraint line; direction (0 1 0); }
        pitch { sixDoFRigidBodyMotionConstraint axis; axis (0 0 1); }
    }
    restraints
    {
        plunge
        {
            sixDoFRigidBodyMotionRestraint linearSpring; anchor (0 0 %(middle)g);
            refAttachmentPt (0 0 %(middle)g); restLength 0;
            stiffness %(plunge_stiffness).9g; damping %(plunge_damping).9g;
        }
        pitch
        {
            sixDoFRigidBodyMotionRestraint linearAxialAngularSpring; axis (0 0 1);
            stiffness %(pitch_stiffness).9g; damping %(pitch_damping).9g;
        }
    }
}
"""

POINTS = """dimensions [0 1 0 0 0 0 0];
internalField uniform (0 0 0);
boundaryField
{
    section { type calculated; value uniform (0 0 0); }
    "(inlet|outlet|channel)" { type fixedValue; value uniform (0 0 0); }
    planes { type empty; }
}
"""

STATE = """    motion
    {
        type sixDoFRigidBodyState; libs ("libsixDoFRigidBodyState.so"); angleFormat degrees; log no;
        writeControl timeStep; writeInterval %d;
    }
"""


def springs(row):
    """(stiffness, damper) of plunge and pitch per unit span."""
    result = []
    for inertia, freedom in ((row["mass"], "plunge"), (row["inertia"], "pitch")):
        omega = 2.0 * math.pi * float(row["f_" + freedom])
        result.append((float(inertia) * omega ** 2,
                       2.0 * float(row["zeta_" + freedom]) * float(inertia) * omega))
    return result


def write_transient(folder, row, step, density=1.0):
    """The run itself; `density` 0 tries the mechanics alone."""
    flow = dict(row, pitch="", plunge="", plunge_c="0")
    case.write_transient(folder, flow, step)
    control = folder / "system/controlDict"
    text = control.read_text(encoding="ascii")
    every = max(1, round(case.FORCE_INTERVAL / step))
    control.write_text(text.replace("functions\n{\n", "functions\n{\n" + STATE % every), encoding="ascii")
    (k_w, c_w), (k_a, c_a) = springs(row)
    inertia = SPAN * float(row["inertia"])
    case.put(folder, "constant/dynamicMeshDict", BODY % {
        "inner": INNER, "outer": OUTER, "density": density, "middle": 0.5 * SPAN,
        "mass": SPAN * float(row["mass"]), "inertia": inertia,
        "momentum": -inertia * math.radians(float(row["start_deg_per_t"])),  # nose-up is clockwise
        "plunge_stiffness": SPAN * k_w, "plunge_damping": SPAN * c_w,
        "pitch_stiffness": SPAN * k_a, "pitch_damping": SPAN * c_a})
    case.put(folder, "0/pointDisplacement", POINTS, "pointVectorField")
