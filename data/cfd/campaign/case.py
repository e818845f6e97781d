"""Writes the dictionaries of one OpenFOAM 1912 case: flow past a flat plate in a channel.

Everything is dimensionless: chord, speed and density are 1, the viscosity is 1 / Re. Two cases belong
to a run: a short steady one with first-order convection, whose field the transient one starts from
(an impulsive start diverges on the sharp edges), and the transient one itself.
"""

import motion
from mesh import SPAN, block_mesh

TURBULENCE_INTENSITY = 0.005
VISCOSITY_RATIO = 1.0  # nu_t / nu at the inlet
STEADY_ITERATIONS = 150
FORCE_INTERVAL = 0.02  # [c/V] between two lines of coefficients

HEADER = "FoamFile { version 2.0; format ascii; class %s; object %s; }\n"

FIELD = """dimensions %s;
internalField uniform %s;
boundaryField
{
    section { %s }
    inlet { %s }
    outlet { %s }
    channel { %s }
    planes { type empty; }
}
"""

CONTROL = """application pimpleFoam;
startFrom startTime; startTime 0; stopAt endTime; endTime %(end)g; deltaT %(step)g;
writeControl runTime; writeInterval %(end)g; purgeWrite 1; writeFormat ascii; writePrecision 10;
timeFormat general; timePrecision 8; runTimeModifiable no; adjustTimeStep no;
functions
{
    coefficients
    {
        type forceCoeffs; libs ("libforces.so"); log no;
        writeControl timeStep; writeInterval %(every)d;
        patches (section); rho rhoInf; rhoInf 1; magUInf 1; lRef 1; Aref %(area)g;
        liftDir (0 1 0); dragDir (1 0 0); CofR (0 %(plunge)g 0); pitchAxis (0 0 -1);
    }
}
"""

SCHEMES = """ddtSchemes { default %(time)s; }
gradSchemes { default Gauss linear; grad(U) cellLimited Gauss linear 1; }
divSchemes
{
    default none;
    div(phi,U) %(momentum)s;
    div(phi,k) %(bounded)sGauss upwind;
    div(phi,omega) %(bounded)sGauss upwind;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes
{
    default Gauss linear limited corrected 0.5;
    laplacian(diffusivity,cellDisplacement) Gauss linear uncorrected;
}
interpolationSchemes { default linear; }
snGradSchemes { default limited corrected 0.5; }
wallDist { method meshWave; updateInterval 100000; }
"""

SOLUTION = """solvers
{
    p
    {
        solver GAMG; smoother DICGaussSeidel; nCellsInCoarsestLevel 20; cacheAgglomeration on;
        tolerance 1e-5; relTol 0.05;
    }
    pFinal { $p; relTol 0.02; }
    cellDisplacement
    {
        solver GAMG; smoother GaussSeidel; nCellsInCoarsestLevel 20; tolerance 1e-7; relTol 0.01;
    }
    cellDisplacementFinal { $cellDisplacement; }
    "(U|k|omega)" { solver PBiCGStab; preconditioner DILU; tolerance 1e-7; relTol 0.05; }
    "(U|k|omega)Final" { $U; relTol 0.01; }
}
PIMPLE
{
    nOuterCorrectors 1; nCorrectors 2; nNonOrthogonalCorrectors 1; momentumPredictor yes;
    correctPhi no; checkMeshCourantNo no; moveMeshOuterCorrectors no; turbOnFinalIterOnly yes;
}
SIMPLE { consistent no; nNonOrthogonalCorrectors 0; }
relaxationFactors { %s }
"""

MOVING_SECTION = """dimensions [0 1 0 0 0 0 0];
internalField uniform (0 0 0);
boundaryField
{
    section
    {
        type solidBodyMotionDisplacement;
        solidBodyMotionFunction tabulated6DoFMotion;
        tabulated6DoFMotionCoeffs { timeDataFileName "<constant>/motion.dat"; CofG (0 %g 0); }
    }
    "(inlet|outlet|channel)" { type fixedValue; value uniform (0 0 0); }
    planes { type empty; }
}
"""

MOVING_MESH = """dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs (fvMotionSolvers);
motionSolver displacementLaplacian;
displacementLaplacianCoeffs { diffusivity quadratic inverseDistance (section); }
"""


def put(folder, name, body, kind="dictionary"):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER % (kind, path.name) + body, encoding="ascii")


def fields(folder, re):
    """Initial and boundary values: uniform stream, slip walls, low-Re treatment at the section."""
    k = 1.5 * TURBULENCE_INTENSITY ** 2
    omega = k * re / VISCOSITY_RATIO
    slip, still = "type slip;", "type calculated; value uniform 0;"

    def leaving(value):
        return "type inletOutlet; inletValue uniform %s; value uniform %s;" % (value, value)

    def fixed(value):
        return "type fixedValue; value uniform %s;" % value

    put(folder, "0/U", FIELD % (
        "[0 1 -1 0 0 0 0]", "(1 0 0)", "type movingWallVelocity; value uniform (0 0 0);",
        fixed("(1 0 0)"), leaving("(0 0 0)"), slip), "volVectorField")
    put(folder, "0/p", FIELD % (
        "[0 2 -2 0 0 0 0]", "0", "type zeroGradient;", "type zeroGradient;", fixed("0"), slip),
        "volScalarField")
    put(folder, "0/k", FIELD % (
        "[0 2 -2 0 0 0 0]", "%g" % k, fixed("1e-12"), fixed("%g" % k), leaving("%g" % k), slip),
        "volScalarField")
    put(folder, "0/omega", FIELD % (
        "[0 0 -1 0 0 0 0]", "%g" % omega, "type omegaWallFunction; value uniform %g;" % omega,
        fixed("%g" % omega), leaving("%g" % omega), slip), "volScalarField")
    put(folder, "0/nut", FIELD % (
        "[0 2 -1 0 0 0 0]", "0", "type nutLowReWallFunction; value uniform 0;", still, still, still),
        "volScalarField")


def common(folder, row, end, step):
    """What the steady start and the transient run share. The mesh stands at the mean position, so
    that a moving mesh is deformed by the deviation only."""
    fields(folder, float(row["re"]))
    put(folder, "system/blockMeshDict", block_mesh(
        row["mesh"], float(row["thickness"]), row["edge"], float(row["mean_deg"]),
        float(row["plunge_c"])))
    put(folder, "constant/transportProperties",
        "transportModel Newtonian;\nnu %.9g;\n" % (1.0 / float(row["re"])))
    put(folder, "constant/turbulenceProperties",
        "simulationType RAS;\nRAS { RASModel kOmegaSST; turbulence on; printCoeffs off; }\n")
    put(folder, "system/controlDict", CONTROL % {
        "end": end, "step": step, "area": SPAN, "plunge": float(row["plunge_c"]),
        "every": max(1, round(FORCE_INTERVAL / step))})


def write_steady(folder, row):
    """The start: STEADY_ITERATIONS of the steady solver, all convection upwind."""
    common(folder, row, STEADY_ITERATIONS, 1)
    put(folder, "system/fvSchemes", SCHEMES % {
        "time": "steadyState", "momentum": "bounded Gauss upwind", "bounded": "bounded "})
    put(folder, "system/fvSolution",
        SOLUTION % 'fields { p 0.3; } equations { U 0.7; "(k|omega)" 0.7; }')


def write_transient(folder, row, step):
    """The run itself: second order in time and for momentum, fixed step."""
    end = float(row["end"])
    common(folder, row, end, step)
    put(folder, "system/fvSchemes", SCHEMES % {
        "time": "backward", "momentum": "Gauss linearUpwind grad(U)", "bounded": ""})
    put(folder, "system/fvSolution", SOLUTION % 'fields { p 1; } equations { ".*" 1; }')
    pitch, plunge = motion.parse(row["pitch"]), motion.parse(row["plunge"])
    if not pitch and not plunge:
        put(folder, "constant/dynamicMeshDict", "dynamicFvMesh staticFvMesh;\n")
        return
    put(folder, "constant/dynamicMeshDict", MOVING_MESH)
    put(folder, "0/pointDisplacement", MOVING_SECTION % float(row["plunge_c"]), "pointVectorField")
    (folder / "constant/motion.dat").write_text(motion.table(pitch, plunge, end), encoding="ascii")
