"""Block mesh of a flat-plate section in a channel, as the text of OpenFOAM's blockMeshDict.

Lengths in chords, x downstream, y up, the middle of the channel at y = 0, mid-chord of the section
at (0, plunge). Twelve blocks: four around the section inside a box that turns and moves with it, eight
between the box and the channel. Two-dimensional: one cell of SPAN in z.
"""

import math

SPAN = 0.1
INLET, OUTLET, WALL = -5.5, 15.5, 2.0  # five chords ahead of and fifteen behind the section
BOX_X, BOX_Y = 1.05, 0.62              # half sizes of the box: its diagonals leave the corners at 45 deg
WALL_GAP = 0.3                         # the box flattens rather than come nearer to a wall

# Cells along the chord, across an edge face, normal to the section, ahead, behind, from the box to a
# wall; first cell at the section, chordwise cell at a corner, first cells ahead of and behind the box.
LEVELS = {
    "production": dict(chord=40, face=8, normal=26, ahead=10, behind=30, side=8,
                       first=2.0e-3, corner=1.2e-2, box_ahead=0.10, box_behind=0.08),
    "coarse": dict(chord=56, face=12, normal=36, ahead=12, behind=36, side=10,
                   first=1.0e-3, corner=8.0e-3, box_ahead=0.10, box_behind=0.08),
    "medium": dict(chord=80, face=16, normal=48, ahead=16, behind=50, side=14,
                   first=6.0e-4, corner=4.0e-3, box_ahead=0.10, box_behind=0.08),
}
EDGES = ("square", "round")  # shape of the leading edge; the trailing edge is always square


def expansion(length, cells, first):
    """Last cell over first of a geometric row of `cells` cells that fills `length`."""
    if first * cells >= length:
        return 1.0
    low, high = 1.0, 4.0
    for _ in range(100):
        growth = 0.5 * (low + high)
        total = first * sum(growth ** i for i in range(cells))
        low, high = (growth, high) if total < length else (low, growth)
    return low ** (cells - 1)


def both_ends(length, cells, first):
    """Grading of a row that is fine at both ends."""
    ratio = expansion(0.5 * length, cells // 2, first)
    return "((0.5 0.5 %.6g) (0.5 0.5 %.6g))" % (ratio, 1.0 / ratio)


def box_half_height(angle_deg, plunge):
    angle = math.radians(angle_deg)
    room = WALL - abs(plunge) - BOX_X * abs(math.sin(angle)) - WALL_GAP
    return min(BOX_Y, room / math.cos(angle))


def corner_points(thickness, edge, angle_deg, plunge):
    """Named points of section (s), box (b) and channel, each as (x, y)."""
    angle = -math.radians(angle_deg)  # nose-up is clockwise

    def turned(x, y):
        return (x * math.cos(angle) - y * math.sin(angle),
                plunge + x * math.sin(angle) + y * math.cos(angle))

    half = 0.5 * thickness
    nose = -0.5 + (half if edge == "round" else 0.0)
    box_y = box_half_height(angle_deg, plunge)
    points = {}
    for name, x, y in (("sw", nose, -half), ("se", 0.5, -half), ("ne", 0.5, half),
                       ("nw", nose, half)):
        points["s" + name] = turned(x, y)
        points["b" + name] = turned(math.copysign(BOX_X, x), math.copysign(box_y, y))
    for side in "sn":
        wall = -WALL if side == "s" else WALL
        west, east = points["b%sw" % side], points["b%se" % side]
        points["inlet_" + side], points["outlet_" + side] = (INLET, west[1]), (OUTLET, east[1])
        points["wall_%sw" % side], points["wall_%se" % side] = (west[0], wall), (east[0], wall)
        points["inlet_wall_" + side], points["outlet_wall_" + side] = (INLET, wall), (OUTLET, wall)
    points["nose"] = turned(-0.5, 0.0)  # middle of the arc of a round leading edge; no corner of a block
    return points


def block_mesh(level="production", thickness=0.04, edge="square", angle_deg=0.0, plunge=0.0):
    """Text of the blockMeshDict, without the file header."""
    size = LEVELS[level]
    points = corner_points(thickness, edge, angle_deg, plunge)
    nose = points.pop("nose")
    number = {name: i for i, name in enumerate(points)}
    layer = len(points)

    def both_layers(names):
        low = [number[name] for name in names]
        return " ".join(str(i) for i in low + [i + layer for i in low])

    def block(names, cells_1, cells_2, grading_1, grading_2):
        return "hex (%s) (%d %d 1) simpleGrading (%s %s 1)" % (
            both_layers(names.split()), cells_1, cells_2, grading_1, grading_2)

    chord = both_ends(1.0, size["chord"], size["corner"])
    face = both_ends(thickness, size["face"], 0.5 * thickness / size["face"])
    # The first cell is that of the long faces; the grading is the same all round, so that the first
    # cells of the edge faces are a tenth smaller.
    height = box_half_height(angle_deg, plunge) - 0.5 * thickness
    normal = "%.6g" % expansion(height, size["normal"], size["first"])
    ahead = "%.6g" % (1.0 / expansion(-INLET - BOX_X, size["ahead"], size["box_ahead"]))
    behind = "%.6g" % expansion(OUTLET - BOX_X, size["behind"], size["box_behind"])
    nx, nf, nn = size["chord"], size["face"], size["normal"]
    na, nb, ns = size["ahead"], size["behind"], size["side"]
    blocks = [
        block("sse ssw bsw bse", nx, nn, chord, normal),
        block("sne sse bse bne", nf, nn, face, normal),
        block("snw sne bne bnw", nx, nn, chord, normal),
        block("ssw snw bnw bsw", nf, nn, face, normal),
        block("inlet_s bsw bnw inlet_n", na, nf, ahead, face),
        block("bse outlet_s outlet_n bne", nb, nf, behind, face),
        block("wall_sw wall_se bse bsw", nx, ns, chord, "1"),
        block("bnw bne wall_ne wall_nw", nx, ns, chord, "1"),
        block("inlet_wall_s wall_sw bsw inlet_s", na, ns, ahead, "1"),
        block("inlet_n bnw wall_nw inlet_wall_n", na, ns, ahead, "1"),
        block("wall_se outlet_wall_s outlet_s bse", nb, ns, behind, "1"),
        block("bne outlet_n outlet_wall_n wall_ne", nb, ns, behind, "1"),
    ]

    def patch(name, kind, *sides):
        faces = " ".join("(%d %d %d %d)" % (number[a], number[b], number[b] + layer, number[a] + layer)
                         for a, b in (side.split() for side in sides))
        return "%s { type %s; faces (%s); }" % (name, kind, faces)

    patches = [
        patch("section", "wall", "ssw sse", "sse sne", "sne snw", "snw ssw"),
        patch("inlet", "patch", "inlet_wall_s inlet_s", "inlet_s inlet_n", "inlet_n inlet_wall_n"),
        patch("outlet", "patch", "outlet_wall_s outlet_s", "outlet_s outlet_n",
              "outlet_n outlet_wall_n"),
        patch("channel", "patch", "inlet_wall_s wall_sw", "wall_sw wall_se", "wall_se outlet_wall_s",
              "inlet_wall_n wall_nw", "wall_nw wall_ne", "wall_ne outlet_wall_n"),
    ]
    arcs = ["arc %d %d (%.10g %.10g %g)" % (number["ssw"] + shift, number["snw"] + shift, *nose, z)
            for shift, z in ((0, 0.0), (layer, SPAN))] if edge == "round" else []
    vertices = ["(%.10g %.10g %g)" % (x, y, z) for z in (0.0, SPAN) for x, y in points.values()]
    return "\n".join(
        ["scale 1;", "vertices ("] + vertices + [");", "blocks ("] + blocks
        + [");", "edges ("] + arcs + [");", "boundary ("] + patches
        + [");", "defaultPatch { name planes; type empty; }", ""])
