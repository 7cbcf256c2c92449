"""The proofs themselves: each condition of the theorems is needed, and found where it fails."""

import math

import pytest
from chart_proof import prove_chart
from sphere_proof import prove_map
from surface import Refused, require_sphere

OCTAHEDRON = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
FACES = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]


def refusal(prove, *arguments):
    with pytest.raises(Refused) as error:
        prove(*arguments)
    return str(error.value)


def bipyramid(sides, turns):
    """Two poles and a ring that runs around so many times."""
    rays = [(0, 0, 1), (0, 0, -1)]
    rays += [(math.cos(2 * math.pi * turns * k / sides), math.sin(2 * math.pi * turns * k / sides), 0)
             for k in range(sides)]
    faces = []
    for k in range(sides):
        a, b = 2 + k, 2 + (k + 1) % sides
        faces += [(a, b, 0), (b, a, 1)]
    return rays, faces


def test_an_octahedron_is_proved_whatever_the_lengths_of_its_rays():
    prove_map(OCTAHEDRON, FACES)
    prove_map([(x * 2.0**(9 * i), y * 2.0**(9 * i), z * 2.0**(9 * i)) for i, (x, y, z) in enumerate(OCTAHEDRON)], FACES)


def test_a_triangle_is_folded_from_where_its_determinant_is_nothing():
    smallest = 5e-324
    flat = OCTAHEDRON[:2] + [(1, 1, 0)] + OCTAHEDRON[3:]
    assert refusal(prove_map, flat, FACES) == "4 triangles are not positive, the first is 0"
    prove_map(OCTAHEDRON[:2] + [(1, 1, smallest)] + OCTAHEDRON[3:], FACES)
    assert "not positive" in refusal(prove_map, OCTAHEDRON[:2] + [(1, 1, -smallest)] + OCTAHEDRON[3:], FACES)


def test_a_mirrored_map_is_refused():
    assert "8 triangles" in refusal(prove_map, [(-x, y, z) for x, y, z in OCTAHEDRON], FACES)


def test_a_double_cover_has_positive_triangles_and_is_refused():
    prove_map(*bipyramid(10, 1))
    assert refusal(prove_map, *bipyramid(10, 2)) == "the sphere is covered 2 times"


@pytest.mark.parametrize("faces, count, what", [
    (FACES[1:], 6, "has one face"),
    (FACES + [FACES[0]], 6, "the same way"),
    ([(1, 0, 2)] + FACES[1:], 6, "the same way"),
    ([(0, 0, 2)] + FACES[1:], 6, "twice"),
    (FACES + [tuple(v + 6 for v in face) for face in FACES], 12, "hang together"),
    (FACES + [tuple(v + 5 if v else 0 for v in face) for face in FACES], 11, "one ring"),
    (FACES, 7, "has no face"),
    ([], 0, "no faces"),
])
def test_what_is_no_sphere_is_refused(faces, count, what):
    assert what in refusal(require_sphere, faces, count)


def test_a_torus_is_refused():
    def at(i, j):
        return 4 * (i % 4) + j % 4
    faces = [face for i in range(4) for j in range(4)
             for face in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]
    assert refusal(require_sphere, faces, 16) == "Euler characteristic 0, that of a sphere is 2"


def octahedron_chart():
    """(u, v), v upwards, of its corners; the seam at vertex 0, poles in the middle of their faces."""
    u = {0: 0, 1: 0.25, 3: 0.5, 4: 0.75}
    corners = []
    for face in FACES:
        ring = [v for v in face if v not in (2, 5)]
        at = [u[v] for v in ring]
        at = [1 if v == 0 and 4 in ring else x for v, x in zip(ring, at)]
        middle = sum(at) / 2
        place = dict(zip(ring, at))
        corners.append([(middle, 1) if v == 2 else (middle, 0) if v == 5 else (place[v], 0.5) for v in face])
    return corners


def test_the_chart_of_an_octahedron_is_proved():
    prove_chart(FACES, octahedron_chart(), 6)


@pytest.mark.parametrize("face, corner, point, what", [
    (0, 0, (1, 0.5), "not positive"),          # the seam on the wrong side: a face runs backwards
    (0, 1, (0.26, 0.5), "torn at the edge"),   # neighbours see a vertex at two places
    (0, 2, (0.1, 0.9), "torn at the edge"),    # a pole that is off its rim
    (3, 1, (1, 0.4), "torn at the edge"),      # the two sides of the seam at two heights
    (1, 1, (0.5, 1.25), "leaves the rectangle"),
    (1, 1, (0.5, 1), "not positive"),          # two corners on a rim
])
def test_a_broken_chart_is_refused(face, corner, point, what):
    corners = octahedron_chart()
    corners[face][corner] = point
    assert what in refusal(prove_chart, FACES, corners, 6)


def test_a_chart_whose_rim_is_run_around_twice_is_refused():
    """A ring of eight around the poles that passes u = 0 two times: everything else is in order."""
    _, faces = bipyramid(8, 2)
    corners = []
    for a, b, pole in faces:
        first = min((a, b), key=lambda v: (v - 2 - min(a, b) + 2) % 8) if abs(a - b) == 1 else max(a, b)
        begin = ((first - 2) % 4) / 4
        at = {first: begin, (a if first == b else b): begin + 0.25}
        corners.append([(begin + 0.125, 1 - pole) if v == pole else (at[v], 0.5) for v in (a, b, pole)])
    assert refusal(prove_chart, faces, corners, 10) == "the rim is run around 2 times"
