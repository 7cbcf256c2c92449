"""What cannot be mapped is refused in words, with what is at fault selected, and nothing changed."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bmesh
import bpy
import numpy as np
from support import add, column, expect_refusal, install, make_active, positions, routes, said, start_anew, use, work


def ball(subdivisions=3, centre=(0, 0, 0)):
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=subdivisions, radius=1)
    bmesh.ops.translate(bm, verts=bm.verts, vec=centre)
    return bm


def obj_of(bm, name="bad"):
    mesh = bpy.data.meshes.new(name)
    bm.to_mesh(mesh)
    bm.free()
    return add(mesh, name)


def selected(obj):
    return tuple(int(column(items, "select", bool).sum()) for items in
                 (obj.data.vertices, obj.data.edges, obj.data.polygons))  # fmt: skip


def refused(obj, *words):
    before = positions(obj.data).copy()
    text = expect_refusal(bpy.ops.object.spherical_map, *words)
    assert (positions(obj.data) == before).all() or not np.isfinite(before).all()
    assert "Spherical" not in obj.data.uv_layers and "spherical_map" not in obj.data.attributes
    return text


def with_hole():
    bm = ball()
    bm.faces.ensure_lookup_table()
    bmesh.ops.delete(bm, geom=[f for f in bm.faces if f.calc_center_median().z > 0.6], context="FACES_ONLY")
    return obj_of(bm)


def check_holes():
    obj = with_hole()
    rim = rim_of(obj)
    refused(obj, "not a closed genus-0 mesh", "boundary edges", f"{rim} edges selected")
    assert rim > 10 and selected(obj)[1] == rim, "all of them, not only those that are listed"
    assert tuple(bpy.context.tool_settings.mesh_select_mode) == (False, True, False)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert selected(obj)[1] == rim, "as Edit Mode shows them"


def rim_of(obj):
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    return sum(len(edge.link_faces) == 1 for edge in bm.edges)


def check_others():
    bm = ball()
    bmesh.ops.create_icosphere(bm, subdivisions=1, radius=0.2)
    obj = obj_of(bm)
    refused(obj, "components", "faces selected")
    assert selected(obj)[2] == 20, "the smaller part"
    bm = ball()
    bm.faces.ensure_lookup_table()
    bmesh.ops.reverse_faces(bm, faces=bm.faces[:5])
    refused(obj_of(bm), "edges selected")
    bm = ball()
    bm.verts.ensure_lookup_table()
    bm.verts[3].co.x = float("nan")
    obj = obj_of(bm)
    refused(obj, "1 vertices have no finite coordinates")
    assert selected(obj)[0] == 1
    bpy.ops.mesh.primitive_torus_add()
    refused(bpy.context.object, "genus")
    refused(add(bpy.data.meshes.new("empty"), "empty"), "no faces")


def check_copies():
    """Borders that only lie at the same place: Blender must merge them."""
    bm = ball()
    bmesh.ops.split_edges(bm, edges=[e for e in bm.edges if all(abs(v.co.z) < 1e-6 for v in e.verts)])
    obj = obj_of(bm)
    refused(obj, "Merge by Distance", "edges selected")


def check_uses():
    """Uses ask for a map; edits that leave none are found."""
    obj = obj_of(ball())
    for call in (lambda: bpy.ops.object.spherical_map_bake(field="ao"), bpy.ops.object.spherical_map_remesh,
                 bpy.ops.object.spherical_map_control):  # fmt: skip
        expect_refusal(call, "has no map yet")
    bpy.ops.object.spherical_map()
    expect_refusal(lambda: bpy.ops.object.spherical_map_bake(field="basecolor"), "no image as base colour")
    expect_refusal(lambda: bpy.ops.object.spherical_map_bake(field="scalar", attribute="x"), "no numbers")
    expect_refusal(lambda: bpy.ops.object.spherical_map_bake(field="ao", size=7), "an even number")
    assert not bpy.data.images.get("bad ao")
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    face = bm.faces[:][0]
    top = bm.verts.new(1.5 * face.calc_center_median())
    for loop in list(face.loops):
        bm.faces.new((loop.vert, loop.link_loop_next.vert, top))
    bm.faces.remove(face)
    bm.to_mesh(obj.data)
    bm.free()
    expect_refusal(bpy.ops.object.spherical_map_remesh, "came after it was mapped", "1 vertices selected")


def check_nowhere():
    """Without package and program the preferences are named."""
    wanted = bpy.context.preferences.addons["spherical_map"].preferences
    obj = obj_of(ball())
    wanted.route, wanted.program = "PROGRAM", str(work / "nothing")
    refused(obj, "sphparam is not found", "preferences")
    wanted.route, wanted.package_folder = "PACKAGE", str(work)
    if "sphparam" not in sys.modules:
        refused(obj, "sphparam is not found")
    use("PROGRAM")
    bpy.ops.object.mode_set(mode="EDIT")
    assert not bpy.ops.object.spherical_map.poll()
    bpy.ops.object.mode_set(mode="OBJECT")


install()
said_by = []
check_nowhere()
for route in routes:
    start_anew()
    use(route)
    check_holes()
    check_others()
    check_copies()
    check_uses()
    said_by.append(refused(with_hole(), "boundary"))
assert said_by[0].replace("bad.001", "bad") .split("\n")[1:] == said_by[1].split("\n")[1:], "both routes say the same"
said("errors: all told, all places selected, nothing changed")
