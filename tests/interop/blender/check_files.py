"""Control meshes and displacement images in Blender from their files alone, without the add-on: a file of
quads, Subdivision Surface and Displace by its UV map, set up as the comments in the file say."""

import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import numpy as np
from support import column, ran, said, start_anew, work, write_mesh


def recipe(path):
    """Image, levels, midlevel and scale, as the control mesh tells them."""
    found = re.search(
        r"^# displacement: (\S+): subdivide by Catmull-Clark, (\d+) levels, to the limit surface; "
        r"along normals by \(value - (\S+)\) \* (\S+), in units",
        pathlib.Path(path).read_text(),
        re.MULTILINE,
    )
    assert found, "the control mesh tells no recipe"
    image, levels, midlevel, scale = found.groups()
    return pathlib.Path(path).parent / image, int(levels), float(midlevel), float(scale)


def imported(path):
    bpy.ops.wm.obj_import(filepath=str(path), forward_axis="Y", up_axis="Z")
    obj = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = obj
    return obj


def subdivide(obj, levels, uv_smooth):
    made = obj.modifiers.new("Subdivision", "SUBSURF")
    made.levels = made.render_levels = levels
    made.use_limit_surface = True
    if uv_smooth:
        made.uv_smooth = uv_smooth


def displace(obj, path, midlevel, scale):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    texture = bpy.data.textures.new("Displacement", "IMAGE")
    texture.image, texture.use_clamp, texture.use_mipmap, texture.use_alpha = image, False, False, False
    texture.filter_type, texture.filter_size, texture.extension = "BOX", 1, "EXTEND"
    made = obj.modifiers.new("Displace", "DISPLACE")
    made.texture, made.texture_coords, made.uv_layer = texture, "UV", obj.data.uv_layers[0].name
    made.direction, made.strength, made.mid_level = "NORMAL", scale, midlevel


def evaluated(obj):
    return obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()


def rms(first, second):
    report = json.loads(ran("measure", first, second, "--samples", 200000, "--json", "-"))
    return np.sqrt(sum(report[way]["RMS"] ** 2 for way in ("first_to_second", "second_to_first")) / 2)


def make(grid, image, size):
    """Control mesh and image; RMS of our own rebuilt mesh."""
    ran("remesh", work / "own.sph.ply", "--grid", grid, "--subdiv-fit", "catmark", "-o", work / "control.obj",
        "--displace", work / image, "--displace-size", size, "--rebuild", work / "rebuilt.ply")  # fmt: skip
    return rms(work / "creature.ply", work / "rebuilt.ply")


def made_by_blender(uv_smooth, with_image=True):
    """RMS of what Blender makes of the files."""
    start_anew()
    obj = imported(work / "control.obj")
    assert (column(obj.data.polygons, "loop_total", np.int32) >= 3).all() and len(obj.data.uv_layers) == 1
    image, levels, midlevel, scale = recipe(work / "control.obj")
    subdivide(obj, levels, uv_smooth)
    if with_image:
        displace(obj, image, midlevel, scale)
    return rms(work / "creature.ply", write_mesh(work / "made.obj", evaluated(obj)))


def check(grid, image, size, *uv_smooths):
    own, smooth = make(grid, image, size), made_by_blender("", with_image=False)
    for uv_smooth in uv_smooths:
        with_it = made_by_blender(uv_smooth)
        said(f"files alone, {grid}, {image}, UV Smooth {uv_smooth or 'as it is'}: RMS {smooth:.5f} without, "
             f"{with_it:.5f} with it, {with_it / own:.2f} of our own rebuilt")  # fmt: skip
        assert with_it < smooth and with_it <= 2 * own, (smooth, with_it, own)


if __name__ == "__main__":
    ran("map", work / "creature.ply", "-o", work / "own.sph.ply", "--lambda", 5)
    check("cube:16", "lack.exr", "1024x512", "NONE", "")  # its preset smooths all but boundaries
    check("cube:16", "lack.png", "512x256", "NONE")
    check("uv:32x16", "lack.exr", "512x256", "NONE")
