"""Base colour: our image through our UV map against Cycles' own bake into it, baked and rendered; normal maps.

Pictures are rendered by Cycles on the processor, without denoising.
"""

import os
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import mathutils
import numpy as np
from support import install, load, load_pixels, make_active, pixels, positions, psnr, said, start_anew, use, work

width = 1024


def use_cycles(samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", samples, False
    scene.cycles.use_adaptive_sampling, scene.cycles.max_bounces = False, 0  # light comes from the sun alone
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0
    scene.view_settings.view_transform = "Standard"
    scene.render.bake.margin = 0


def emission(obj, image, uv_map):
    """A material that shows an image as it is."""
    material = bpy.data.materials.new("shown")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    place, texture, light, out = (tree.nodes.new(kind) for kind in (
        "ShaderNodeUVMap", "ShaderNodeTexImage", "ShaderNodeEmission", "ShaderNodeOutputMaterial"))  # fmt: skip
    place.uv_map, texture.image = uv_map, image
    for one, other in ((place.outputs[0], texture.inputs[0]), (texture.outputs[0], light.inputs[0]),
                       (light.outputs[0], out.inputs[0])):  # fmt: skip
        tree.links.new(one, other)
    obj.data.materials.clear()
    obj.data.materials.append(material)
    return tree


def cycles_bake(obj, source, uv_map):
    """Cycles' own image of the same colours, into our UV map."""
    tree = emission(obj, source, uv_map)
    image = bpy.data.images.new("cycles", width, width // 2, alpha=True)
    image.generated_color = (0, 0, 0, 0)
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.nodes.active = node
    obj.data.uv_layers.active = obj.data.uv_layers["Spherical"]
    make_active(obj)
    use_cycles(16)
    bpy.ops.object.bake(type="EMIT", margin=0, use_clear=False)
    return image


def look_at(obj, size=512):
    """A camera that sees all of a mesh."""
    scene = bpy.context.scene
    points = positions(obj.data)
    middle = mathutils.Vector((points.min(axis=0) + points.max(axis=0)) / 2)
    camera = bpy.data.objects.get("camera") or bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    if camera.name not in scene.collection.objects:
        scene.collection.objects.link(camera)
    reach = float(np.linalg.norm(np.ptp(points, axis=0)))
    camera.location = middle + reach * mathutils.Vector((0.8, -1.2, 0.6))
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", reach, 10 * reach
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.film_transparent = True


def render(name, samples=16):
    use_cycles(samples)
    path = work / f"{name}.png"
    bpy.context.scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    keep(path)
    return load_pixels(path, True)


def keep(path):
    """A copy to look at, where that is asked for."""
    folder = os.environ.get("SPHERICAL_MAP_PICTURES")
    if folder:
        shutil.copy(path, folder)


def base_colour(obj, source, uv_map, name):
    """Decibels: the images; the pictures; the pictures against that of the source's own texture."""
    bpy.ops.object.spherical_map_bake(field="basecolor", size=width, samples=4)
    ours = bpy.data.images[f"{obj.name} basecolor"]
    theirs = cycles_bake(obj, source, uv_map)
    covered = pixels(theirs)[:, :, 3] > 0
    assert 0.9 < covered.mean() < 1, "the UV map covers the image but for half of the caps at the poles"
    images = psnr(pixels(ours)[covered][:, :3], pixels(theirs)[covered][:, :3])
    look_at(obj)
    shown = []
    for what, image, layer in (("own", source, uv_map), ("ours", ours, "Spherical"), ("cycles", theirs, "Spherical")):
        emission(obj, image, layer)
        shown.append(render(f"{name}_{what}"))
    seen = shown[0][:, :, 3] > 0.99
    assert seen.mean() > 0.1
    pairs = ((1, 2), (1, 0), (2, 0))
    return images, *(psnr(shown[a][seen][:, :3], shown[b][seen][:, :3]) for a, b in pairs)


def with_texture(path, image):
    """A mesh whose material has an image as base colour, by its own UV map."""
    bpy.ops.import_scene.obj(filepath=str(path), axis_forward="Y", axis_up="Z")
    obj = make_active(bpy.context.selected_objects[0])
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    material = bpy.data.materials.new("skin")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(node.outputs[0], shader.inputs["Base Color"])
    obj.data.materials.clear()
    obj.data.materials.append(material)
    return obj


def textured_ball():
    """Quads with an atlas of six squares and a picture of waves on it."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    obj.modifiers.new("s", "SUBSURF").levels = 4
    bpy.ops.object.modifier_apply(modifier="s")
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    x, y = np.meshgrid(np.arange(512) / 512, np.arange(512) / 512)
    table = np.ones((512, 512, 4), np.float32)
    for k in range(3):
        table[:, :, k] = 0.5 + 0.4 * np.sin(2 * np.pi * ((3 + k) * x + (2 - k) * y))
    image = bpy.data.images.new("waves", 512, 512)
    image.pixels.foreach_set(table.ravel())
    image.update()
    material = bpy.data.materials.new("skin")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(node.outputs[0], shader.inputs["Base Color"])
    obj.data.materials.append(material)
    return obj, image


def check_normal_map():
    """How far light on few triangles is from that on the source: without our normal map, and with it."""
    start_anew()
    source = load(work / "body.ply")
    bpy.ops.object.spherical_map()
    bpy.ops.object.spherical_map_remesh(grid="ICO", level=3)
    low = bpy.context.object
    make_active(low, source)
    bpy.ops.object.spherical_map_bake(field="normal-tangent", size=2048, samples=2, show=True)
    for obj in (source, low):
        if obj.active_material is None:
            obj.data.materials.append(bpy.data.materials.new("grey"))
            obj.active_material.use_nodes = True
        for node in obj.active_material.node_tree.nodes:
            if node.type == "BSDF_PRINCIPLED":
                node.inputs["Base Color"].default_value = (0.5, 0.5, 0.5, 1)
                node.inputs["Roughness"].default_value = 1
                node.inputs["Specular"].default_value = 0
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    bpy.context.scene.collection.objects.link(sun)
    sun.rotation_euler, sun.data.energy = (0.7, 0.3, 0.5), 3
    sun.data.use_shadow = False
    look_at(source)
    pictures = {}
    for name, shown, mapped in (("source", source, False), ("flat", low, False), ("mapped", low, True)):
        source.hide_render, low.hide_render = shown != source, shown != low
        node = next(n for n in low.active_material.node_tree.nodes if n.type == "NORMAL_MAP")
        node.inputs["Strength"].default_value = 1 if mapped else 0
        pictures[name] = render("normal_" + name, 64)
    seen = (pictures["source"][:, :, 3] > 0.99) & (pictures["flat"][:, :, 3] > 0.99)
    apart = [np.abs(pictures[name] - pictures["source"])[seen] for name in ("flat", "mapped")]
    return [255 * float(np.mean(np.minimum(rows[:, 0], 0.2))) for rows in apart]  # outlines differ in both


if __name__ == "__main__":
    install()
    use("PROGRAM")
    start_anew()
    obj, image = textured_ball()
    bpy.ops.object.spherical_map()
    images, *shown = base_colour(obj, image, "UVMap", "ball")
    assert images > 30 and shown[0] > 32, (images, shown)
    said(f"base colour: image {images:.1f} dB to Cycles' bake; rendered {shown[0]:.1f} dB, to the source's own "
         f"{shown[1]:.1f} dB (Cycles' bake: {shown[2]:.1f} dB)")  # fmt: skip
    flat, mapped = check_normal_map()
    assert mapped < 0.6 * flat, (flat, mapped)
    said(f"normal map: light on 1,280 triangles is off by {mapped:.1f} of 255 in the mean, without it {flat:.1f}")
