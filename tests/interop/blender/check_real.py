"""Meshes of the world, end to end: map, bake, remesh, control mesh, undo; where SPHPARAM_MESHES has them."""

import os
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import numpy as np
from check_displacement import check
from check_pictures import base_colour, with_texture
from support import (directions, expect_refusal, install, load, make_active, said, start_anew, use, uv)  # fmt: skip

beside = pathlib.Path(__file__).resolve().parents[4] / "shared" / "meshes"
meshes = pathlib.Path(os.environ.get("SPHPARAM_MESHES", beside)) / "genus0"
plain = ("spot_triangulated.obj", "homer.obj", "fox.ply", "hand_closed.obj", "nefertiti-lowres.obj")


def undone(call, **options):
    """Runs an operator; undo brings back what was there, redo what it made."""
    names = set(bpy.data.objects.keys()), set(bpy.data.images.keys())
    counts = {obj.name: len(obj.data.vertices) for obj in bpy.data.objects}
    assert call("EXEC_DEFAULT", True, **options) == {"FINISHED"}
    bpy.ops.ed.undo()
    assert (set(bpy.data.objects.keys()), set(bpy.data.images.keys())) == names
    assert {obj.name: len(obj.data.vertices) for obj in bpy.data.objects} == counts
    bpy.ops.ed.redo()


def check_mesh(name):
    start_anew()
    obj = load(meshes / name)
    source, begin = obj.name, time.monotonic()
    vertices = len(obj.data.vertices)
    bpy.ops.ed.undo_push(message="loaded")
    undone(bpy.ops.object.spherical_map)
    seconds = time.monotonic() - begin
    mesh = bpy.data.objects[source].data
    assert mesh["spherical_map"].startswith("one-to-one") and uv(mesh).min() >= 0 and uv(mesh).max() <= 1
    assert np.abs(np.linalg.norm(directions(mesh), axis=1) - 1).max() < 1e-12
    verdict, cut = mesh["spherical_map"], len(mesh.vertices) - vertices
    undone(bpy.ops.object.spherical_map_bake, field="normal-object", size=512)
    undone(bpy.ops.object.spherical_map_remesh, grid="ICO", level=5)
    assert len(bpy.context.object.data.polygons) >= 20 * 4**5
    start_anew()
    without, with_it, own, _ = check(load(meshes / name), levels=3)
    said(f"{name}: {vertices} vertices, {verdict}, {cut} more along seam and poles, {seconds:.1f} s with undo and "
         f"redo; displaced {with_it / own:.2f} of our rebuilt RMS, {with_it / without:.2f} of the smooth surface's")  # fmt: skip


def check_texture(name, obj, image):
    """Base colour of a mesh with a texture of its own."""
    layer = obj.data.uv_layers[0].name
    bpy.ops.object.spherical_map()
    images, *shown = base_colour(obj, image, layer, pathlib.Path(name).stem)
    assert images > 25 and shown[0] > 30, (images, shown)
    said(f"{name}: base colour {images:.1f} dB to Cycles' bake, rendered {shown[0]:.1f} dB; to the source's own "
         f"{shown[1]:.1f} dB (Cycles' bake: {shown[2]:.1f} dB)")  # fmt: skip


def import_gltf(path):
    """As Blender reads it; vertices that glTF has several times merged, as the add-on's refusal advises."""
    np.bool = bool  # Debian's Blender is older than its NumPy
    bpy.ops.import_scene.gltf(filepath=str(path))
    obj = next(o for o in bpy.context.selected_objects if o.type == "MESH")
    for other in list(bpy.context.selected_objects):
        if other != obj:
            bpy.data.objects.remove(other)
    obj.parent = None
    make_active(obj)
    expect_refusal(bpy.ops.object.spherical_map, "Merge by Distance")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.remove_doubles()
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


if not meshes.is_dir():
    said("no real meshes: SPHPARAM_MESHES says where they are")
else:
    install()
    use("PROGRAM")
    for name in plain:
        check_mesh(name)
    start_anew()
    skin = bpy.data.images.load(str(meshes / "spot_texture.png"))
    check_texture(plain[0], with_texture(meshes / plain[0], skin), skin)
    start_anew()
    duck = import_gltf(meshes / "Duck.glb")
    node = next(n for n in duck.active_material.node_tree.nodes if n.type == "TEX_IMAGE")
    check_texture("Duck.glb", duck, node.image)
