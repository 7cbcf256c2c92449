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


def uses():
    return (lambda: bpy.ops.object.spherical_map_bake(field="ao", size=32), bpy.ops.object.spherical_map_remesh,
            bpy.ops.object.spherical_map_control)  # fmt: skip


def mapped(name="bad"):
    obj = obj_of(ball(), name)
    bpy.ops.object.spherical_map()
    return obj


def remove_face(obj):
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    bm.faces.remove(bm.faces[7])
    bm.to_mesh(obj.data)
    bm.free()


def things():
    return [len(items) for items in (bpy.data.objects, bpy.data.meshes, bpy.data.images, bpy.data.textures)]


def check_broken_later():
    """A mesh that was mapped and then lost a face: each use says what Map says of it."""
    start_anew()
    obj = mapped()
    remove_face(obj)
    before, told = things(), []
    for call in (*uses(), bpy.ops.object.spherical_map):
        told.append(expect_refusal(call, "bad is not a closed genus-0 mesh", "3 boundary edges", "3 edges selected"))
        assert selected(obj)[1] == 3
    assert len(set(told)) == 1 and things() == before, told
    return told[0]


def check_broken_target():
    """Of two meshes the broken one is named and selected."""
    start_anew()
    source, target = mapped("source"), mapped("target")
    remove_face(target)
    make_active(target, source)
    told = expect_refusal(uses()[0], "target is not a closed", "3 edges selected")
    assert bpy.context.object == target and selected(target)[1] == 3
    return told


def check_no_area():
    """A mesh that has a map, no defect, and yet no control mesh: what sphparam says of it is told."""
    start_anew()
    obj = mapped()
    obj.data.vertices.foreach_set("co", np.ones(3 * len(obj.data.vertices), np.float32))
    before = things()
    told = expect_refusal(bpy.ops.object.spherical_map_control, "no area")
    assert things() == before
    return told


def check_not_finite():
    start_anew()
    obj = mapped()
    obj.data.attributes.new("my heat", "FLOAT", "POINT").data[3].value = float("nan")
    told = expect_refusal(bpy.ops.object.spherical_map_remesh, "my heat of 1 vertices", "1 vertices selected")
    assert column(obj.data.vertices, "select", bool).nonzero()[0].tolist() == [3]
    return told


def check_too_large():
    """An image that would take the memory of the machine is refused before any work."""
    start_anew()
    mapped()
    before = things()
    told = expect_refusal(lambda: bpy.ops.object.spherical_map_control(edges=256, levels=7),
                          "32769 × 196614 texels", "Levels 2 or fewer Edges")  # fmt: skip
    assert things() == before
    return told


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


def check_moved():
    """A map that is none any more is told of the object, not of a file, with what to do."""
    start_anew()
    obj = mapped()
    column_of = obj.data.attributes["spherical_map"].data
    found = column(column_of, "vector", np.float32, 3)
    found[7] *= -1
    column_of.foreach_set("vector", found.ravel())
    told = expect_refusal(uses()[0], "bad", "not one-to-one", "Spherical Map › Map")
    assert ".ply" not in told and "sphparam" not in told, told


def check_unchanged():
    """What cannot be finished is refused before anything is cut."""
    start_anew()
    obj = obj_of(ball())
    for number in range(8):
        obj.data.uv_layers.new(name=str(number))
    refused(obj, "as many UV maps as Blender allows")
    start_anew()
    obj = obj_of(ball())
    obj.modifiers.new("m", "MULTIRES")
    refused(obj, "Multiresolution", "without Cut Along the Seam")
    assert bpy.ops.object.spherical_map(cut=False) == {"FINISHED"}


def check_other_program():
    start_anew()
    wanted = bpy.context.preferences.addons["spherical_map"].preferences
    wanted.route, wanted.program = "PROGRAM", "/bin/true"
    refused(obj_of(ball()), "/bin/true is not sphparam")
    use("PROGRAM")


install()
said_by, told_by = [], []
check_unchanged()
check_other_program()
check_nowhere()
for route in routes:
    start_anew()
    use(route)
    check_holes()
    check_others()
    check_copies()
    check_uses()
    check_moved()
    told_by.append([check() for check in (check_broken_later, check_broken_target, check_no_area,
                                          check_not_finite, check_too_large)])  # fmt: skip
    start_anew()
    said_by.append(refused(with_hole(), "boundary"))
assert said_by[0].replace("bad.001", "bad") .split("\n")[1:] == said_by[1].split("\n")[1:], "both routes say the same"
assert told_by[0] == told_by[1], told_by
said("errors: all told, all places selected, nothing changed")
