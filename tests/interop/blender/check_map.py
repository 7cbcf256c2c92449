"""Mapping in Blender: both routes alike, the UV map is the program's, custom normals stay, undo undoes."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import mathutils
import numpy as np
from support import (Glb, column, directions, drawn_triangles, expect_refusal, install, load, loop_vertices, make_active,
                     positions, ran, routes, said, start_anew, use, uv, work, write_mesh)  # fmt: skip


def state(mesh):
    return [positions(mesh), loop_vertices(mesh), uv(mesh), directions(mesh), column(mesh.edges, "use_seam", bool)]


def matched(first, second):
    """(F, 3) corners of the second mesh that are those of the first; triangles (F, 3, 2) by (u, v)."""
    tree = mathutils.kdtree.KDTree(len(second))
    for number, middle in enumerate(second.mean(axis=1)):
        tree.insert((*middle, 0), number)
    tree.balance()
    faces = np.array([tree.find((*middle, 0))[1] for middle in first.mean(axis=1)])
    assert len(np.unique(faces)) == len(first) == len(second), "one triangle each"
    turns = np.array([[0, 1, 2], [1, 2, 0], [2, 0, 1]])
    apart = np.stack([np.abs(second[faces][:, turn] - first).max(axis=(1, 2)) for turn in turns])
    return 3 * faces[:, None] + turns[apart.argmin(axis=0)]


def check_routes(path):
    states = []
    for route in routes:
        start_anew()
        obj = load(path)
        use(route)
        assert bpy.ops.object.spherical_map() == {"FINISHED"}
        states.append(state(obj.data))
    assert all((a == b).all() for a, b in zip(*states)), "both routes give the same, to the last bit"


def check_against_program(obj, plain):
    """Corner by corner the UV map that `export` writes. Degrees between Blender's tangents (MikkTSpace) and
    ours: median and 99 %."""
    mesh = obj.data
    mapped, glb = work / "own.sph.ply", work / "own.glb"
    ran("map", plain, "-o", mapped)
    ran("export", mapped, "-o", glb, "--tangents", "--image-size", 16)
    ours = Glb(glb)
    rows = ours.triangles.ravel()
    places, coordinates = positions(mesh)[loop_vertices(mesh)], uv(mesh)
    theirs = matched(coordinates.reshape(-1, 3, 2), ours.uv[rows].reshape(-1, 3, 2)).ravel()
    assert np.abs(ours.uv[rows][theirs] - coordinates).max() < 1e-6, "the UV map"
    assert np.abs(ours.positions[rows][theirs] - places).max() < 1e-6, "where its corners are"
    mesh.calc_tangents(uvmap="Spherical")
    first, second = column(mesh.loops, "tangent", width=3), ours.tangents[rows][theirs]
    angles = np.degrees(np.arccos(np.clip((first * second).sum(axis=1), -1, 1)))
    return np.median(angles), np.percentile(angles, 99)


def check_chart(mesh):
    """Every point of the image has one owner, and the pieces are those: nothing folds, areas add up to 1."""
    corner = uv(mesh).reshape(-1, 3, 2).astype(np.float64)
    assert corner.min() >= 0 and corner.max() <= 1
    a, b = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    apex = (corner[:, :, 1] % 1 == 0).any(axis=1)  # a triangle at a pole owns a trapezoid: twice the area
    assert (area[~apex] > -1e-7).all()
    width = np.ptp(corner[apex, :, 0], axis=1)
    assert abs(width.sum() - 2) < 1e-4, "both caps are closed"
    assert abs(area.sum() + area[apex].sum() - 1) < 0.01
    lengths = np.linalg.norm(directions(mesh), axis=1)
    assert np.abs(lengths - 1).max() < 1e-12


def check_again(obj):
    """A mesh that is cut has a chart already: no cut is left, and its map is one-to-one."""
    path = work / "again.sph.ply"
    points, sphere, faces = positions(obj.data), directions(obj.data), drawn_triangles(obj.data)
    with open(path, "wb") as out:
        names = "".join(f"property double {n}\n" for n in ("x", "y", "z", "sx", "sy", "sz"))
        out.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{names}"
                  f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        out.write(np.c_[points, sphere].astype("<f8").tobytes())
        rows = np.empty(len(faces), [("n", "u1"), ("v", "<i4", 3)])
        rows["n"], rows["v"] = 3, faces
        out.write(rows.tobytes())
    said_of = ran("verify", path, "--chart", "--json", "-")
    assert '"total": 0' in said_of and '"certified": true' in said_of, said_of


def check_wrapped(path, plain):
    """Without cuts: no vertex comes, u goes on beyond 1, and is ours modulo 1."""
    start_anew()
    obj = load(path)
    before = positions(obj.data), loop_vertices(obj.data)
    bpy.ops.object.spherical_map(cut=False)
    assert (positions(obj.data) == before[0]).all() and (loop_vertices(obj.data) == before[1]).all()
    found = uv(obj.data).reshape(-1, 3, 2)
    assert found[:, :, 0].max() <= 1.5 and np.ptp(found[:, :, 0], axis=1).max() < 0.999
    sphere = directions(obj.data)[loop_vertices(obj.data)]
    theta = np.arctan2(sphere[:, 1], sphere[:, 0]) / (2 * np.pi)
    away = np.abs(sphere[:, 2]) < 0.999999
    gap = np.abs(np.mod(found.reshape(-1, 2)[:, 0] - theta + 0.5, 1) - 0.5)[away]
    assert gap.max() < 1e-6, gap.max()
    height = 1 - np.arccos(np.clip(sphere[:, 2], -1, 1)) / np.pi
    assert np.abs(found.reshape(-1, 2)[:, 1] - height).max() < 1e-5


def check_undo(path):
    start_anew()
    obj = load(path)
    before = positions(obj.data).copy(), loop_vertices(obj.data).copy()
    name = obj.name
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.spherical_map("EXEC_DEFAULT", True)
    assert "Spherical" in bpy.data.objects[name].data.uv_layers
    bpy.ops.ed.undo()
    mesh = bpy.data.objects[name].data
    assert (positions(mesh) == before[0]).all() and (loop_vertices(mesh) == before[1]).all()
    assert "Spherical" not in mesh.uv_layers and "spherical_map" not in mesh.attributes
    bpy.ops.ed.redo()
    assert "Spherical" in bpy.data.objects[name].data.uv_layers


def check_several():
    """All selected meshes, each once."""
    start_anew()
    first, second = load(work / "creature.ply"), load(work / "body.ply")
    shared = bpy.data.objects.new("shared", second.data)
    bpy.context.scene.collection.objects.link(shared)
    make_active(first, second, shared)
    bpy.ops.object.spherical_map()
    assert all("Spherical" in obj.data.uv_layers for obj in (first, second))


def check_selected_alone():
    """The active mesh is mapped where it is selected, and nothing is where nothing is selected."""
    start_anew()
    active, other = load(work / "creature.ply"), load(work / "body.ply")
    make_active(active)
    active.select_set(False)
    expect_refusal(bpy.ops.object.spherical_map, "No mesh is selected")
    other.select_set(True)
    bpy.ops.object.spherical_map()
    assert "Spherical" in other.data.uv_layers and "Spherical" not in active.data.uv_layers


install()
creature = work / "creature.ply"
check_routes(creature)
start_anew()
obj = load(creature)
plain = write_mesh(work / "own.obj", obj.data)
use("PROGRAM")
bpy.ops.object.spherical_map()
assert obj.data["spherical_map"].startswith("one-to-one")
median, most = check_against_program(obj, plain)
assert median < 0.5, median
check_chart(obj.data)
check_again(obj)
check_wrapped(creature, plain)
check_undo(creature)
check_several()
check_selected_alone()
said(f"map: both routes alike, the UV map is the program's, tangents {median:.2f}° apart (99 %: {most:.2f}°)")
