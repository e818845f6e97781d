"""Three-dimensional meshes of a beam: the cross-section swept along the span as twenty-node bricks,
or a strip as eight-node layered shells. Both give the same Mesh, so that loads, clamp and
evaluation know nothing of the element."""

import math

from section_mesh import SectionMesh, face_integrals

STATIONS = 20  # motion is evaluated at so many equal steps of the span and at the root


class Station:
    """One plane of nodes across the span. nodes: [(id, x, y, mass weight)]."""

    def __init__(self, z, nodes):
        self.z, self.nodes = z, nodes


class Mesh:
    """nodes: {id: (x, y, z)}. groups: {key: [connectivity]}; the key of bricks is (material, fibre,
    across), shells have one group, None, and their layers in `layers`: [(thickness, material,
    fibre, across)]. faces: lists of eight ids where the line load acts (strips). root: ids.
    tip_area: {id: integral of the shape function over the tip section}, empty for shells.
    stations: root to tip."""

    def __init__(self, element):
        self.element = element
        self.nodes, self.groups, self.layers, self.faces = {}, {}, None, []
        self.root, self.tip_area, self.stations = [], {}, []
        self.description = {}

    def add_node(self, point):
        self.nodes[len(self.nodes) + 1] = point
        return len(self.nodes)

    def element_count(self):
        return sum(len(g) for g in self.groups.values())

    def line_load(self, chord_at):
        """{id: force} of 1 N/m along the span, spread evenly over the local chord."""
        forces = {}
        for face in self.faces:
            parts = face_integrals([self.nodes[n] for n in face], lambda p: 1.0 / chord_at(p[2]))
            for node, part in zip(face, parts):
                forces[node] = forces.get(node, 0.0) + part
        return forces


def fibre_axes(direction, angle_deg):
    """Unit vectors along the fibre and across it in the wall; the angle goes from z towards s."""
    c, s = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    tx, ty = direction
    return (s * tx, s * ty, c), (c * tx, c * ty, -s)


def no_taper(_z):
    return 1.0


def sweep(blocks, length, n_z, materials, element, taper=no_taper):
    """Bricks. taper(z): x of the section is scaled by it."""
    section = SectionMesh(blocks)
    mesh = Mesh(element)
    planes = []
    for k in range(2 * n_z + 1):
        z = length * k / (2 * n_z)
        wanted = range(len(section.points)) if k % 2 == 0 else sorted(section.corner)
        planes.append({i: mesh.add_node((section.points[i][0] * taper(z), section.points[i][1], z))
                       for i in wanted})
    for e in range(n_z):
        low, mid, high = planes[2 * e:2 * e + 3]
        for cell in section.cells:
            corner, side = cell.nodes[:4], cell.nodes[4:]
            ids = ([low[i] for i in corner] + [high[i] for i in corner] + [low[i] for i in side]
                   + [high[i] for i in side] + [mid[i] for i in corner])
            axes = fibre_axes(cell.direction, cell.angle_deg)
            mesh.groups.setdefault((cell.material,) + axes, []).append(ids)
            if cell.first_layer:
                a, m, b = cell.lower
                mesh.faces.append([low[a], low[b], high[b], high[a],
                                   low[m], mid[b], high[m], mid[a]])
    mesh.root = sorted(planes[0].values())
    mesh.tip_area = {planes[-1][i]: area for i, area in enumerate(section.nodal_areas())}
    masses = section.masses(materials)
    for j in range(STATIONS + 1):
        plane = planes[2 * round(n_z * j / STATIONS)]
        z = length * round(n_z * j / STATIONS) / n_z
        mesh.stations.append(Station(z, [(n, *mesh.nodes[n][:2], masses[i] * taper(z))
                                         for i, n in plane.items()]))
    mesh.description = {"span_elements": n_z, "section_elements": len(section.cells)}
    return mesh


def shell_strip(chord, plies, length, n_z, n_x, materials, taper=no_taper):
    """Layered S8R of a strip; the normal is up, so that layers go from lower to upper face."""
    mesh = Mesh("S8R")
    grid = {}
    for k in range(2 * n_z + 1):
        z = length * k / (2 * n_z)
        for i in range(2 * n_x + 1):
            if k % 2 == 0 or i % 2 == 0:
                grid[k, i] = mesh.add_node((chord * (i / (2 * n_x) - 0.5) * taper(z), 0.0, z))
    group = mesh.groups.setdefault(None, [])
    for k in range(0, 2 * n_z, 2):
        for i in range(0, 2 * n_x, 2):
            path = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
            group.append([grid[k + a, i + b] for a, b in path])
    mesh.faces = group
    mesh.layers = [(t, m, *fibre_axes((-1.0, 0.0), angle)) for m, angle, t in plies]
    mesh.root = [n for (k, _), n in sorted(grid.items()) if k == 0]
    mass = sum(materials[m]["density_kg_m3"] * t for m, _, t in plies) * chord / (2 * n_x)
    for j in range(STATIONS + 1):
        k = 2 * round(n_z * j / STATIONS)
        z = length * k / (2 * n_z)
        row = [(n, *mesh.nodes[n][:2], mass * taper(z) / (2 if i in (0, 2 * n_x) else 1))
               for (kk, i), n in grid.items() if kk == k]
        mesh.stations.append(Station(z, row))
    mesh.description = {"span_elements": n_z, "section_elements": n_x}
    return mesh
