"""What a mesh carries stays with it when it is cut: quads, normals, UV maps, colours, groups, keys, marks."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import numpy as np
from support import add, column, install, loop_vertices, make_active, positions, said, start_anew, uv


def quad_ball(turn=(0.3, 0.2, 0.1)):
    """A ball of quads, bumpy, with everything that can be carried."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    obj.modifiers.new("s", "SUBSURF").levels = 4
    bpy.ops.object.modifier_apply(modifier="s")
    mesh = obj.data
    points = positions(mesh)
    points *= 1 + 0.2 * np.sin(4 * points[:, [1]] + turn[0]) * np.cos(3 * points[:, [0]] + turn[1])
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    return obj


def linear(points):
    """Something that is linear in space, and so in every face."""
    return points @ [0.3, -0.2, 0.5] + 0.1


def fill(obj):
    """Layers of all kinds, linear in space, so that whoever interpolates gets what is expected."""
    mesh = obj.data
    points = positions(mesh)
    at_loops = points[loop_vertices(mesh)]
    own = mesh.uv_layers.new(name="Own")
    own.data.foreach_set("uv", np.c_[linear(at_loops), at_loops[:, 0]].astype(np.float32).ravel())
    colours = mesh.color_attributes.new("Paint", "FLOAT_COLOR", "CORNER")
    colours.data.foreach_set("color", np.repeat(linear(at_loops)[:, None], 4, 1).astype(np.float32).ravel())
    heat = mesh.attributes.new("heat", "FLOAT", "POINT")
    heat.data.foreach_set("value", linear(points).astype(np.float32))
    group = obj.vertex_groups.new(name="group")
    for number, weight in enumerate(np.clip(linear(points) + 0.4, 0, 1)):
        group.add([number], float(weight), "REPLACE")
    obj.shape_key_add(name="Basis")
    moved = obj.shape_key_add(name="Moved")
    moved.data.foreach_set("co", (2 * points + [1, 0, 0]).astype(np.float32).ravel())
    materials = [bpy.data.materials.new(name) for name in "ab"]
    for material in materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", (centres(mesh)[:, 0] > 0).astype(np.int32))
    creased = column(mesh.edges, "vertices", np.int32, 2)
    mesh.edges.foreach_set("use_edge_sharp", points[creased][:, :, 1].mean(axis=1) > 0)


def centres(mesh):
    return column(mesh.polygons, "center", width=3)


def check_layers(obj):
    mesh = obj.data
    points = positions(mesh)
    at_loops = points[loop_vertices(mesh)]
    exact = 1e-4  # quads are not plane: what is linear in space is by the triangles that they are drawn as
    assert np.abs(uv(mesh, "Own") - np.c_[linear(at_loops), at_loops[:, 0]]).max() < exact
    colours = column(mesh.color_attributes["Paint"].data, "color", width=4)
    assert np.abs(colours[:, 0] - linear(at_loops)).max() < exact
    heat = column(mesh.attributes["heat"].data, "value")
    assert np.abs(heat - linear(points)).max() < exact
    weights = np.array([sum(g.weight for g in v.groups) for v in mesh.vertices])
    assert np.abs(weights - np.clip(linear(points) + 0.4, 0, 1)).max() < 0.02
    keys = column(mesh.shape_keys.key_blocks["Moved"].data, "co", width=3)
    assert np.abs(keys - (2 * points + [1, 0, 0])).max() < exact
    expected = (centres(mesh)[:, 0] > 0).astype(np.int32)
    wrong = column(mesh.polygons, "material_index", np.int32) != expected
    assert np.abs(centres(mesh)[wrong, 0]).max(initial=0) < 0.1
    assert column(mesh.polygons, "use_smooth", bool).all()


def set_custom_normals(mesh):
    """Normals that no rule would make; (L, 3)."""
    mesh.use_auto_smooth = True
    at_loops = positions(mesh)[loop_vertices(mesh)]
    wanted = at_loops / np.linalg.norm(at_loops, axis=1, keepdims=True)
    wanted = wanted + 0.3 * np.sin(3 * at_loops[:, [1, 2, 0]])
    wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
    mesh.normals_split_custom_set(wanted)
    return at_loops


def check_normals(mesh):
    """Within what Blender stores, 16 bits an angle, and what linear interpolation in a face is off."""
    assert mesh.has_custom_normals
    mesh.calc_normals_split()
    found = column(mesh.loops, "normal", width=3)
    at_loops = positions(mesh)[loop_vertices(mesh)]
    wanted = at_loops / np.linalg.norm(at_loops, axis=1, keepdims=True)
    wanted = wanted + 0.3 * np.sin(3 * at_loops[:, [1, 2, 0]])
    wanted /= np.linalg.norm(wanted, axis=1, keepdims=True)
    apart = np.degrees(np.arccos(np.clip((found * wanted).sum(axis=1), -1, 1)))
    assert apart.max() < 2 and np.median(apart) < 0.1, (apart.max(), np.median(apart))
    return apart.max()


def check_loose(obj):
    """Vertices and edges without faces stay."""
    mesh = obj.data
    mesh.vertices.add(2)
    mesh.vertices[-1].co = (9, 9, 9)
    mesh.vertices[-2].co = (8, 9, 9)
    mesh.edges.add(1)
    mesh.edges[-1].vertices = (len(mesh.vertices) - 1, len(mesh.vertices) - 2)
    mesh.update()
    bpy.ops.object.spherical_map()
    loose = np.flatnonzero((positions(mesh) == 9).all(axis=1))
    assert len(loose) == 1 and any(loose[0] in tuple(e.vertices) for e in mesh.edges)
    assert bpy.ops.object.spherical_map_remesh(grid="ICO", level=3) == {"FINISHED"}


install()
start_anew()
obj = quad_ball()
fill(obj)
quads = len(obj.data.polygons)
assert bpy.ops.object.spherical_map() == {"FINISHED"}
sizes = column(obj.data.polygons, "loop_total", np.int32)
kept = (sizes == 4).sum()
assert 0.8 * quads < kept < quads, "quads stay where nothing cuts them"
assert obj.data.edges and any(edge.use_seam for edge in obj.data.edges)
check_layers(obj)

start_anew()
obj = quad_ball()
set_custom_normals(obj.data)
bpy.ops.object.spherical_map()
off = check_normals(obj.data)

start_anew()
check_loose(quad_ball())

start_anew()
obj = quad_ball()
before = len(obj.data.polygons)
bpy.ops.object.spherical_map(cut=False)
assert len(obj.data.polygons) == before and (column(obj.data.polygons, "loop_total", np.int32) == 4).all()
said(f"carried: {kept} of {quads} quads stay; UV maps, colours, groups, keys, materials; normals to {off:.2f}°")
