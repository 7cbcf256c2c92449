"""Baking from another surface, `bake --from`, against Cycles' own: colours and normals of the asset on a wrap of it.

What is true is what the asset itself shows: it is rendered from ten directions, and so is the wrap with each one's
image. Cycles gets the best of several distances of its cage. Ours must be as near, within 0.3 dB and 5 % of the
angle. Other assets, which are only told: SPHERICAL_MAP_ASSETS=FILE.glb,FILE.glb
"""

import os
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import mathutils
import numpy as np
from check_pictures import emission, render, use_cycles
from support import add, load_pixels, make_active, psnr, ran, said, start_anew, work

np.bool = bool  # Blender 3.4 reads glTF with a name that NumPy 1.24 has no more
width = 1024
cages = (0.01, 0.03, 0.1)  # of the diagonal
away = [(1, 0, 0.3), (-1, 0, 0.3), (0, 1, 0.3), (0, -1, 0.3), (1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, 1),
        (1, 0.5, -0.7), (-0.5, 1, -0.7)]  # fmt: skip


def body_asset():
    """Of our own samples: 20,480 triangles with a texture."""
    ran("map", work / "body.ply", "-o", work / "body.sph.ply")
    ran("export", work / "body.sph.ply", "--image", work / "body.png", "-o", work / "body.glb")
    return work / "body.glb"


def wrapped(asset, faces=4000):
    """A closed surface about an asset, with its chart, as the asset's coordinates lie."""
    low = work / "low.ply"
    ran("wrap", asset, "--resolution", 128, "--faces", faces, "-o", low)
    ran("map", low, "-o", work / "low.sph.ply")
    ran("export", work / "low.sph.ply", "-o", work / "low.obj")
    return work / "low.sph.ply"


def load_asset(path):
    """All of a .glb as one object, its coordinates as in the file (Blender turns y up to z up)."""
    bpy.ops.import_scene.gltf(filepath=str(path))
    parts = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    make_active(parts[0], *parts[1:])
    if len(parts) > 1:
        bpy.ops.object.join()
    obj = bpy.context.object
    obj.data.transform(mathutils.Matrix.Rotation(-np.pi / 2, 4, "X") @ obj.matrix_world)
    for parent in (obj.parent, obj):
        if parent:
            parent.matrix_world = mathutils.Matrix.Identity(4)
    obj.parent = None
    return obj


def show_colours(obj):
    """Its base colours give light; vertex colours are left out, as they are of what is baked."""
    for material in filter(None, obj.data.materials):
        tree = material.node_tree
        shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
        colour, light = shader.inputs["Base Color"], tree.nodes.new("ShaderNodeEmission")
        if colour.links:
            tree.links.new(colour.links[0].from_socket, light.inputs[0])
        light.inputs[0].default_value = colour.default_value
        out = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
        tree.links.new(light.outputs[0], out.inputs[0])


def show_normals(obj):
    """Its normals, as colours: half and half of each coordinate."""
    material = bpy.data.materials.new("normals")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    place, half, light, out = (tree.nodes.new(kind) for kind in (
        "ShaderNodeNewGeometry", "ShaderNodeVectorMath", "ShaderNodeEmission", "ShaderNodeOutputMaterial"))  # fmt: skip
    half.operation = "MULTIPLY_ADD"
    half.inputs[1].default_value = half.inputs[2].default_value = (0.5, 0.5, 0.5)
    for one, other in ((place.outputs["Normal"], half.inputs[0]), (half.outputs[0], light.inputs[0]),
                       (light.outputs[0], out.inputs[0])):  # fmt: skip
        tree.links.new(one, other)
    for slot in obj.material_slots:
        slot.material = material


def load_low():
    bpy.ops.import_scene.obj(filepath=str(work / "low.obj"), axis_forward="Y", axis_up="Z")
    obj = make_active(bpy.context.selected_objects[0])
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    return obj


def ours(asset, kind):
    """Our image, and seconds."""
    begun = time.monotonic()
    ran("bake", work / "low.sph.ply", "--from", asset, "--map", kind, "--size", width, "--depth", "u16", "-o",
        work / "ours.png")  # fmt: skip
    seconds = time.monotonic() - begun
    image = bpy.data.images.load(str(work / "ours.png"), check_existing=False)
    return image, seconds


def cycles(low, high, kind, extrusion):
    """Cycles' image, and seconds; 16 rays a texel."""
    image = bpy.data.images.new("cycles", width, width // 2, float_buffer=True, is_data=True)
    uv_map = low.data.uv_layers[0].name
    node = emission(low, image, uv_map).nodes
    node.active = next(n for n in node if n.type == "TEX_IMAGE")
    make_active(low, high)
    use_cycles(16)
    bake = bpy.context.scene.render.bake
    bake.use_selected_to_active, bake.cage_extrusion = True, extrusion
    begun = time.monotonic()
    bpy.ops.object.bake(type="EMIT", margin=16)
    return image, time.monotonic() - begun


def pictures(obj, others, name):
    """Of ten directions, (10, H, W, 4), linear."""
    scene = bpy.context.scene
    for other in others:
        other.hide_render = True
    obj.hide_render = False
    found = []
    for k, direction in enumerate(away):
        aim(obj, mathutils.Vector(direction))
        found.append(render(f"{name}_{k}"))
    for other in others:
        other.hide_render = False
    assert scene.camera
    return np.array(found)


def aim(obj, direction):
    scene = bpy.context.scene
    corners = np.array([obj.matrix_world @ mathutils.Vector(corner) for corner in obj.bound_box])
    middle, reach = mathutils.Vector(corners.mean(axis=0)), float(np.linalg.norm(np.ptp(corners, axis=0)))
    camera = bpy.data.objects.get("camera") or bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    if camera.name not in scene.collection.objects:
        scene.collection.objects.link(camera)
    camera.location = middle + 2 * reach * direction.normalized()
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 1.05 * reach, 10 * reach
    camera.data.clip_start = reach / 100
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = 192
    scene.render.film_transparent = True


def far_off(kind, shown, true):
    """Colours: decibels. Normals: degrees in the mean, where both are seen."""
    seen = (shown[..., 3] > 0.99) & (true[..., 3] > 0.99)
    if kind == "basecolor":
        return psnr(shown[seen][:, :3], true[seen][:, :3])
    one, other = (2 * rows[seen][:, :3].astype(np.float64) - 1 for rows in (shown, true))
    lengths = np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)
    cosines = np.einsum("ij,ij->i", one, other) / np.maximum(lengths, 1e-9)
    return float(np.degrees(np.arccos(np.clip(cosines, -1, 1))).mean())


def compare(asset, kind):
    """How far ours and Cycles' are from the truth, with seconds."""
    start_anew()
    high, low = load_asset(asset), load_low()
    bpy.context.scene.view_settings.view_transform = "Standard" if kind == "basecolor" else "Raw"
    (show_colours if kind == "basecolor" else show_normals)(high)
    high.hide_render = low.hide_render = False
    true = pictures(high, [low], f"{kind}_true")
    diagonal = float(np.linalg.norm(np.ptp(np.array(low.bound_box), axis=0)))
    best = []
    for cage in cages:
        image, seconds = cycles(low, high, kind, cage * diagonal)
        emission(low, image, low.data.uv_layers[0].name)
        best.append((far_off(kind, pictures(low, [high], f"{kind}_cycles_{cage}"), true), seconds))
    image, seconds = ours(asset, "normal-object" if kind == "normals" else kind)
    image.colorspace_settings.name = "sRGB" if kind == "basecolor" else "Non-Color"
    emission(low, image, low.data.uv_layers[0].name)
    mine = (far_off(kind, pictures(low, [high], f"{kind}_ours"), true), seconds)
    return mine, (max if kind == "basecolor" else min)(best)


if __name__ == "__main__":
    named = os.environ.get("SPHERICAL_MAP_ASSETS")
    assets = [pathlib.Path(name) for name in named.split(",")] if named else [body_asset()]
    for asset in assets:
        wrapped(asset)
        (a, ta), (b, tb) = compare(asset, "basecolor")
        said(f"{asset.stem}: colours from it on a wrap, {a:.1f} dB to the truth in {ta:.1f} s; Cycles {b:.1f} dB in {tb:.1f} s")
        assert named or round(a, 1) >= round(b, 1), "colours"
        (a, ta), (b, tb) = compare(asset, "normals")
        said(f"{asset.stem}: normals {a:.2f}° from the truth in {ta:.1f} s; Cycles {b:.2f}° in {tb:.1f} s")
        assert named or round(a, 2) <= round(b, 2), "normals"
