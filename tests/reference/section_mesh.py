"""Finite-element mesh of a cross-section: eight-node quadrilaterals out of four-cornered blocks.

Coordinates are those of the beam frame (x towards the leading edge, y up) in metres. A block is a
piece of wall: s along the wall, n = (dy/ds, -dx/ds) through it from the inner to the outer face,
plies listed in that order. A strip is one block whose s runs to -x, so that n is up."""

import math

MERGE_M = 1e-9  # nodes closer than this are one node
GAUSS_3 = ((-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9))
QUAD_CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


class Block:
    """inner, outer: the two faces as ((x, y) at the start of s, (x, y) at its end). plies:
    [(material, angle_deg, thickness_m)] from inner to outer face; cells: per ply, through it."""

    def __init__(self, inner, outer, plies, n_s, cells=None):
        self.inner, self.outer, self.plies, self.n_s = inner, outer, plies, n_s
        self.cells = cells or [1] * len(plies)

    def direction(self):
        """Unit vector along s: that of the two faces' mean."""
        dx = sum(f[1][0] - f[0][0] for f in (self.inner, self.outer))
        dy = sum(f[1][1] - f[0][1] for f in (self.inner, self.outer))
        length = math.hypot(dx, dy)
        return dx / length, dy / length

    def levels(self):
        """(fraction of the thickness at the inner side, at the outer side, ply) of every layer."""
        total = sum(p[2] for p in self.plies)
        done, result = 0.0, []
        for ply, count in zip(self.plies, self.cells):
            for i in range(count):
                result.append(((done + ply[2] * i / count) / total,
                               (done + ply[2] * (i + 1) / count) / total, ply))
            done += ply[2]
        return result

    def point(self, s, n):
        """Bilinear map of the unit square onto the block."""
        inner = [a + (b - a) * s for a, b in zip(*self.inner)]
        outer = [a + (b - a) * s for a, b in zip(*self.outer)]
        return tuple(a + (b - a) * n for a, b in zip(inner, outer))


class Cell:
    """nodes: four corners anticlockwise, then the four mid-sides; lower: the inner edge (three
    nodes, ordered by s)."""

    def __init__(self, nodes, lower, material, angle_deg, direction, first_layer):
        self.nodes, self.lower, self.material, self.angle_deg = nodes, lower, material, angle_deg
        self.direction, self.first_layer = direction, first_layer


class SectionMesh:
    def __init__(self, blocks):
        self.points, self.cells, self._index = [], [], {}
        for block in blocks:
            self._add(block)
        self.corner = {n for c in self.cells for n in c.nodes[:4]}

    def _node(self, point):
        """Index of the node at a point; neighbours of the rounding cell are the same node."""
        kx, ky = (round(v / MERGE_M) for v in point)
        for key in ((kx + i, ky + j) for i in (0, 1, -1) for j in (0, 1, -1)):
            if key in self._index:
                return self._index[key]
        self._index[(kx, ky)] = len(self.points)
        self.points.append(point)
        return len(self.points) - 1

    def _add(self, block):
        for layer, (n0, n1, ply) in enumerate(block.levels()):
            for i in range(block.n_s):
                s0, s1 = i / block.n_s, (i + 1) / block.n_s
                sm, nm = (s0 + s1) / 2, (n0 + n1) / 2
                # n is clockwise from s, so inner start, outer start, outer end, inner end is
                # anticlockwise seen from outboard (+z).
                path = ((s0, n0), (s1, n0), (s1, n1), (s0, n1), (sm, n0), (s1, nm), (sm, n1),
                        (s0, nm))
                raw = [self._node(block.point(s, n)) for s, n in path]
                nodes = [raw[k] for k in (0, 3, 2, 1, 7, 6, 5, 4)]
                self.cells.append(Cell(nodes, (raw[0], raw[4], raw[1]), ply[0], ply[1],
                                       block.direction(), layer == 0))
                assert self.area(self.cells[-1]) > 0, "a block of the section is turned inside out"

    def area(self, cell):
        p = [self.points[n] for n in cell.nodes[:4]]
        return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(p, p[1:] + p[:1])) / 2

    def nodal_areas(self):
        """Integral of every node's shape function: what a uniform traction gives to the node."""
        result = [0.0] * len(self.points)
        for cell in self.cells:
            points = [self.points[n] + (0.0,) for n in cell.nodes]
            for node, part in zip(cell.nodes, face_integrals(points)):
                result[node] += part
        return result

    def masses(self, materials):
        """Mass a length spread evenly over the nodes of each cell [kg/m]: weights for means."""
        result = [0.0] * len(self.points)
        for cell in self.cells:
            for node in cell.nodes:
                result[node] += materials[cell.material]["density_kg_m3"] * self.area(cell) / 8
        return result


def quad8(xi, eta):
    """Shape functions of the eight-node quadrilateral and their derivatives by xi and eta."""
    n, d_xi, d_eta = [], [], []
    for a, b in QUAD_CORNERS:
        n.append((1 + a * xi) * (1 + b * eta) * (a * xi + b * eta - 1) / 4)
        d_xi.append(a * (1 + b * eta) * (2 * a * xi + b * eta) / 4)
        d_eta.append(b * (1 + a * xi) * (a * xi + 2 * b * eta) / 4)
    for a, b in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        if a == 0:
            n.append((1 - xi * xi) * (1 + b * eta) / 2)
            d_xi.append(-xi * (1 + b * eta))
            d_eta.append(b * (1 - xi * xi) / 2)
        else:
            n.append((1 - eta * eta) * (1 + a * xi) / 2)
            d_xi.append(a * (1 - eta * eta) / 2)
            d_eta.append(-eta * (1 + a * xi))
    return n, d_xi, d_eta


def face_integrals(points, density=lambda p: 1.0):
    """Integrals of shape function times density(x, y, z) over a face of eight nodes in space."""
    result = [0.0] * 8
    for xi, wx in GAUSS_3:
        for eta, we in GAUSS_3:
            n, d_xi, d_eta = quad8(xi, eta)
            place, a, b = ([sum(f * p[k] for f, p in zip(g, points)) for k in range(3)]
                           for g in (n, d_xi, d_eta))
            cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                     a[0] * b[1] - a[1] * b[0])
            weight = wx * we * math.sqrt(sum(c * c for c in cross)) * density(place)
            for i in range(8):
                result[i] += weight * n[i]
    return result
