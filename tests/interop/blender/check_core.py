"""The core without Blender: PLY files, places of defects, the layout of displacements."""

import pathlib
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "tools/blender"))
from spherical_map.core import connected, layout, ply
from spherical_map.core.defects import places_of
from spherical_map.core.refusal import Defect, Refusal
from spherical_map.core.surface import Surface, surface_of

assert "bpy" not in sys.modules


def surface(triangles, polygons=None):
    triangles = np.asarray(triangles)
    loops = np.arange(triangles.size).reshape(-1, 3)
    points = np.random.default_rng(1).normal(size=(triangles.max() + 1, 3)).astype(np.float32)
    numbers = np.arange(len(triangles)) if polygons is None else np.asarray(polygons)
    return Surface("a", points, triangles.ravel(), np.arange(0, triangles.size, 3), loops, numbers)


def places(kind, *triangles):
    return places_of(surface(triangles), [Defect(kind, True, (0,), "", "")])


tetrahedron = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def check_defects():
    open_edges = places("boundary-edge", *tetrahedron[:3])
    assert {tuple(e) for e in open_edges.edges} == {(0, 2), (0, 3), (2, 3)}
    assert not places("boundary-edge", *tetrahedron)
    crowded = places("non-manifold-edge", *tetrahedron, (0, 1, 4))
    assert {tuple(e) for e in crowded.edges} == {(0, 1)}
    turned = places("inconsistent-orientation", *tetrahedron[:3], tetrahedron[3][::-1])
    assert {tuple(e) for e in turned.edges} == {(0, 3), (2, 3), (0, 2)}
    other = [tuple(v + 3 if v else 0 for v in t) for t in tetrahedron]
    assert places("non-manifold-vertex", *tetrahedron, *other).vertices.tolist() == [0]
    assert not places("non-manifold-vertex", *tetrahedron)
    far = [tuple(v + 4 for v in t) for t in tetrahedron[:3]]
    assert places("several-components", *tetrahedron, *far).polygons.tolist() == [4, 5, 6]
    assert places("duplicate-face", *tetrahedron, (1, 0, 2)).polygons.tolist() == [0, 4]
    assert places("repeated-vertex", *tetrahedron).polygons.tolist() == [0]
    harmless = [Defect("duplicate-face", False, (), "", ""), Defect("wrong-genus", True, (), "", "")]
    assert not places_of(surface([*tetrahedron, (0, 2, 1)]), harmless)


def check_connected():
    generator = np.random.default_rng(2)
    for _ in range(50):
        pairs = generator.integers(0, 60, (generator.integers(0, 60), 2))
        expected = list(range(60))
        for _ in range(60):
            for a, b in pairs:
                expected[a] = expected[b] = min(expected[a], expected[b])
        assert connected.labels(60, pairs).tolist() == expected
    chain = np.stack([np.arange(99999), np.arange(1, 100000)], axis=1)
    assert not connected.labels(100000, chain[::-1]).any()


def check_ply(folder):
    path = folder / "a.ply"
    generator = np.random.default_rng(3)
    points = generator.normal(size=(4, 3))
    numbers = np.arange(4, dtype="<i4")
    uv = generator.random((4, 3, 2)).astype("<f4")
    ply.write_triangles(path, dict(zip("xyz", points.T)), np.array(tetrahedron), {"triangle": numbers}, uv, uv[:, :, :1] + [0, 1, 2])
    found = ply.read(path)
    assert (found.table("x", "y", "z") == points).all() and (found.triangles() == tetrahedron).all()
    assert (found.faces["triangle"] == numbers).all() and (found.texcoords.reshape(4, 3, 2) == uv).all()
    mixed = b"".join([
        b"ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\n",
        b"property float z\nproperty double sx\nproperty double sy\nproperty double sz\n",
        b"element face 2\nproperty list uchar int vertex_indices\nproperty uchar label\nend_header\n",
        np.zeros((5, 9), "<f4").tobytes(),
        b"\x04", np.array([0, 1, 2, 3], "<i4").tobytes(), b"\x07",
        b"\x03", np.array([2, 1, 4], "<i4").tobytes(), b"\x09",
    ])  # fmt: skip
    path.write_bytes(mixed)
    found = ply.read(path)
    assert found.counts.tolist() == [4, 3] and found.corners.tolist() == [0, 1, 2, 3, 2, 1, 4]
    assert found.faces["label"].tolist() == [7, 9]
    made = surface_of(found, "a")
    assert made.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [2, 1, 4]]
    assert made.triangle_polygons.tolist() == [0, 0, 1]


def cube_grid(edges):
    """Corners of cube:edges, quad by quad, as directions of their own."""
    steps = np.tan(np.pi / 4 * np.linspace(-1, 1, edges + 1))
    corners = []
    for normal, right, up in zip(layout._normals, layout._rights, layout._ups):
        assert (np.cross(right, up) == normal).all(), "seen from outside"
        for i in range(edges):
            for j in range(edges):
                corners += [normal + right * steps[i + di] + up * steps[j + dj]
                            for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]  # fmt: skip
    return np.array(corners)


def check_layout():
    edges, steps = 5, 4
    corners = cube_grid(edges)
    found = layout.CubeLayout(np.arange(len(corners)).reshape(-1, 4), corners, edges, steps)
    width, height = found.size
    assert (width, height) == (edges * steps + 1, 6 * (edges * steps + 1))
    uv = found.uv()
    sides = np.abs(np.roll(uv, -1, axis=1) - uv) * [width, height]
    assert np.allclose(sides.sum(axis=2), steps), "quads are squares of so many texels"
    area = np.cross(uv[:, 1] - uv[:, 0], uv[:, 3] - uv[:, 0])
    assert (area > 0).all(), "seen from outside"
    shares = np.linspace(0, 1, steps + 1)
    s, t = (x.ravel()[None, :, None] for x in np.meshgrid(shares, shares))
    inner = (1 - s) * (1 - t) * uv[:, :1] + s * (1 - t) * uv[:, 1:2] + s * t * uv[:, 2:3] + (1 - s) * t * uv[:, 3:]
    table = found.image(inner.reshape(-1, 2), np.arange(inner[:, :, 0].size))
    assert np.isfinite(table).all(), "every texel has a value"


def check_lookup():
    width, height = 64, 32
    theta = 2 * np.pi * (np.arange(width) + 0.5) / width
    phi = np.pi * (np.arange(height) + 0.5) / height
    sphere = np.stack([np.outer(np.sin(phi), np.cos(theta)), np.outer(np.sin(phi), np.sin(theta)),
                       np.outer(np.cos(phi), np.ones(width))], axis=2)  # fmt: skip
    image = sphere @ [0.3, -0.5, 0.8]
    there = layout.equirectangular(image, 7 * sphere.reshape(-1, 3)).reshape(height, width)
    assert np.abs(there - image).max() < 1e-12, "texels are where they are"
    for direction in ([0, 0, 1], [0, 0, -1], [1, 1e-9, 0], [1, -1e-9, 0]):
        value = layout.equirectangular(image, np.array([direction], float))[0]
        assert abs(value - np.dot(direction, [0.3, -0.5, 0.8])) < 0.01, direction


def check_limit():
    """What the operator's properties allow is made up to so many texels, and refused above it with what to choose."""
    for edges in range(2, 257):
        for levels in range(1, 8):
            fits = 6 * (edges * 2**levels + 1) ** 2 <= 2**24
            try:
                layout.require_size(edges, levels)
                assert fits, (edges, levels)
            except Refusal as refusal:
                assert not fits, (edges, levels)
                most = int(str(refusal).split("Levels ")[1].split()[0])
                assert 1 <= most < levels
                layout.require_size(edges, most)


def check_source():
    """Twice the edges of the subdivided mesh about the equator, as long as nothing is told."""
    for edges in range(2, 257):
        for levels in range(1, 8):
            width, lost = layout.source_width(edges, levels)
            around = 4 * edges * 2**levels
            assert width == min(2 * around, 8192) and bool(lost) == (2 * around > 8192)
            assert not lost or ("8192 × 4096 texels" in lost and f"{2 * around} × {around}" in lost)


def check_columns(folder):
    """No name of an attribute takes the place of a column with a role."""
    ball = surface(tetrahedron)
    ball.directions = ball.positions.astype(float)
    ball.colours = np.full((4, 4), 9, np.uint8)
    names = ("x", "sx", "red", "alpha", "attribute_0", "two words", "two\nlines")
    ball.scalars = {name: np.full(4, 100 + number, np.float32) for number, name in enumerate(names)}
    ball.write(folder / "names.ply")
    found = ply.read(folder / "names.ply")
    assert (found.table("x", "y", "z").astype(np.float32) == ball.positions).all()
    assert (found.table("sx", "sy", "sz") == ball.directions).all() and (found.table("red", "alpha") == 9).all()
    for number, name in enumerate(names):
        assert (found.vertices[ball.column_of(name)] == 100 + number).all()


check_defects()
check_connected()
with tempfile.TemporaryDirectory() as name:
    check_ply(pathlib.Path(name))
    check_columns(pathlib.Path(name))
check_layout()
check_limit()
check_source()
check_lookup()
print("blender: the core works without Blender")
