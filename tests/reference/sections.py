"""Sections of the reference cases: each gives its definition in the words of a case document and
the blocks of its finite-element mesh, from the same numbers.

A contour's wall runs from point to point along its mid-line; its s follows, its inner-to-outer
direction is n = (dy/ds, -dx/ds), its plies are listed in that order and its ply angle goes from z
towards s. Points are relative to the beam's reference axis."""

from section_mesh import Block


def layup_document(plies):
    return [{"material": m, "angle_deg": a, "thickness_m": t} for m, a, t in plies]


def thickness(plies):
    return sum(p[2] for p in plies)


def strip(chord, plies):
    return {"type": "strip", "chord_m": chord, "layup": layup_document(plies)}


def strip_blocks(chord, plies, n_x, cells):
    front, back, half = chord / 2, -chord / 2, thickness(plies) / 2
    return [Block(((front, -half), (back, -half)), ((front, half), (back, half)), plies, n_x,
                  cells)]


def contour(points, walls):
    """points: [(x, y)]; walls: [(from, to, plies)]."""
    return {"type": "contour", "points": [{"x_m": x, "y_m": y} for x, y in points],
            "walls": [{"from": a, "to": b, "layup": layup_document(p)} for a, b, p in walls]}


def split(n, parts):
    """n cells over pieces in proportion to their lengths, at least one each."""
    return [max(1, round(n * p / sum(parts))) for p in parts]


class Box:
    """Closed rectangle about the origin, mid-lines width x height, all walls of one thickness;
    layups of the walls top, back, bottom, front (s anticlockwise with x to the right) and of a web
    that runs upward at x_web. n_width, n_height: cells along the walls."""

    def __init__(self, width, height, top, back, bottom, front, web=None, x_web=None):
        self.width, self.height, self.x_web = width, height, x_web
        self.layups = {"top": top, "back": back, "bottom": bottom, "front": front, "web": web}
        self.t = thickness(top)

    def definition(self):
        w, h, lay = self.width / 2, self.height / 2, self.layups
        points = [(w, -h), (w, h), (-w, h), (-w, -h)]
        if lay["web"] is None:
            walls = [(0, 1, lay["front"]), (1, 2, lay["top"]), (2, 3, lay["back"]),
                     (3, 0, lay["bottom"])]
            return contour(points, walls)
        points += [(self.x_web, h), (self.x_web, -h)]
        walls = [(0, 1, lay["front"]), (1, 4, lay["top"]), (4, 2, lay["top"]), (2, 3, lay["back"]),
                 (3, 5, lay["bottom"]), (5, 0, lay["bottom"]), (5, 4, lay["web"])]
        return contour(points, walls)

    def through(self, wall):
        """Bricks through each ply of a wall, so that all walls have the same number in all."""
        most = max(len(p) for p in self.layups.values() if p)
        plies = self.layups[wall]
        assert most % len(plies) == 0, "walls cannot share their nodes at the corners"
        return [most // len(plies)] * len(plies)

    def wall(self, name, inner, outer, n_s):
        return Block(inner, outer, self.layups[name], n_s, self.through(name))

    def blocks(self, n_width, n_height):
        """Corners are mitred; where the web meets a wall the wall keeps the common square."""
        t, lay = self.t, self.layups
        wi, wo = (self.width - t) / 2, (self.width + t) / 2
        hi, ho = (self.height - t) / 2, (self.height + t) / 2
        # x of the borders between the pieces of the upper and lower walls: (inner, outer face).
        borders = [(wi, wo), (-wi, -wo)]
        if lay["web"] is not None:
            front, back = self.x_web + t / 2, self.x_web - t / 2
            borders = [borders[0], (front, front), (back, back), borders[1]]
        pieces = list(zip(borders, borders[1:]))
        lengths = [abs(a[1] - b[1]) for a, b in pieces]
        counts = split(n_width, lengths)
        if lay["web"] is not None:
            counts[1] = sum(self.through("web"))
        result = []
        for (a, b), n in zip(pieces, counts):
            result.append(self.wall("top", ((a[0], hi), (b[0], hi)), ((a[1], ho), (b[1], ho)), n))
            result.append(self.wall("bottom", ((b[0], -hi), (a[0], -hi)),
                                    ((b[1], -ho), (a[1], -ho)), n))
        result.append(self.wall("back", ((-wi, hi), (-wi, -hi)), ((-wo, ho), (-wo, -ho)), n_height))
        result.append(self.wall("front", ((wi, -hi), (wi, hi)), ((wo, -ho), (wo, ho)), n_height))
        if lay["web"] is not None:
            result.append(self.wall("web", ((back, -hi), (back, hi)), ((front, -hi), (front, hi)),
                                    n_height))
        return result


class Channel:
    """Web on x = 0, flanges towards the leading edge, mid-lines; one isotropic ply."""

    def __init__(self, width, height, plies):
        self.width, self.height, self.plies = width, height, plies

    def definition(self):
        w, h = self.width, self.height / 2
        points = [(w, h), (0.0, h), (0.0, -h), (w, -h)]
        return contour(points, [(0, 1, self.plies), (1, 2, self.plies), (2, 3, self.plies)])

    def blocks(self, n_width, n_height):
        w, h, e = self.width, self.height / 2, thickness(self.plies) / 2
        lines = (((w, h - e), (e, h - e), (e, e - h), (w, e - h)),
                 ((w, h + e), (-e, h + e), (-e, -e - h), (w, -e - h)))
        return [Block((lines[0][i], lines[0][i + 1]), (lines[1][i], lines[1][i + 1]), self.plies, n)
                for i, n in enumerate((n_width, n_height, n_width))]


class ISection:
    """Doubly symmetric about the origin, mid-lines; one isotropic ply."""

    def __init__(self, width, height, plies):
        self.width, self.height, self.plies = width, height, plies

    def definition(self):
        w, h = self.width / 2, self.height / 2
        points = [(w, h), (0.0, h), (-w, h), (w, -h), (0.0, -h), (-w, -h)]
        ends = ((0, 1), (1, 2), (3, 4), (4, 5), (4, 1))
        return contour(points, [(a, b, self.plies) for a, b in ends])

    def blocks(self, n_width, n_height):
        w, h, e = self.width / 2, self.height / 2, thickness(self.plies) / 2
        n_half = max(1, n_width // 2)
        result = [Block(((-e, e - h), (-e, h - e)), ((e, e - h), (e, h - e)), self.plies, n_height)]
        for y in (h, -h):
            for a, b, n in ((w, e, n_half), (e, -e, 1), (-e, -w, n_half)):
                result.append(Block(((a, y - e), (b, y - e)), ((a, y + e), (b, y + e)),
                                    self.plies, n))
        return result
