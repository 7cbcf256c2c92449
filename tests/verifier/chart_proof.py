"""Has every point of the (u, v) rectangle one owner? By the theorem that opens chart/chart_certificate.cpp.

Coordinates as files have them, v upwards: faces run counter-clockwise, the north is at v = 1. A
corner on a rim is the pole's: its face owns what is between its other two corners and the rim.
"""

from exact import turn, whole
from surface import Refused, require_sphere


class Chart:
    def __init__(self, triangles, corner_uv, count):
        """`corner_uv`: three points a face."""
        self.triangles, self.face_of = triangles, require_sphere(triangles, count)
        points = whole([point for corners in corner_uv for point in corners] + [(1, 1)])
        self.one = points.pop()[0]
        self.uv = [points[3 * face:3 * face + 3] for face in range(len(triangles))]

    def on_rim(self, point):
        return point[1] in (0, self.one)

    def at(self, face, vertex):
        return self.uv[face][self.triangles[face].index(vertex)]

    def require_inside(self):
        for face, corners in enumerate(self.uv):
            for u, v in corners:
                if not (0 <= u <= self.one and 0 <= v <= self.one):
                    raise Refused(f"face {face} leaves the rectangle")

    def is_positive(self, face):
        corners = self.uv[face]
        poles = [k for k in range(3) if self.on_rim(corners[k])]
        if not poles:
            return turn(*corners) > 0
        if len(poles) > 1:
            return False
        k = poles[0]
        begin, end = corners[(k + 1) % 3][0], corners[(k + 2) % 3][0]
        return begin < end if corners[k][1] == self.one else end < begin

    def fits(self, edge):
        """Do the two faces of an edge see it alike, or one at u = 0 and the other at u = 1?"""
        mine, others = self.face_of[edge], self.face_of[edge[::-1]]
        pairs = [(self.at(mine, vertex), self.at(others, vertex)) for vertex in edge]
        rims = [(p, q) for p, q in pairs if self.on_rim(p) or self.on_rim(q)]
        inner = [pair for pair in pairs if pair not in rims]
        if any(p[1] != q[1] for p, q in rims) or not inner:
            return False
        sides = {(p[0], q[0]) for p, q in inner}
        at_seam = sides in ({(0, self.one)}, {(self.one, 0)})
        return all(p == q for p, q in inner) or (at_seam and all(p[1] == q[1] for p, q in inner))

    def turns_of_north(self):
        """Pieces along v = 1 that begin at u = 0."""
        count = 0
        for corners in self.uv:
            count += sum(corners[k][1] == self.one and corners[(k + 1) % 3][0] == 0 for k in range(3))
        return count


def prove_chart(triangles, corner_uv, count):
    """Throws Refused unless every point of the rectangle that is on no edge has one owner."""
    chart = Chart(triangles, corner_uv, count)
    chart.require_inside()
    folded = [face for face in range(len(triangles)) if not chart.is_positive(face)]
    if folded:
        raise Refused(f"{len(folded)} pieces of the chart are not positive, the first is {folded[0]}")
    for edge in chart.face_of:
        if not chart.fits(edge):
            raise Refused(f"the chart is torn at the edge {edge}")
    if chart.turns_of_north() != 1:
        raise Refused(f"the rim is run around {chart.turns_of_north()} times")
