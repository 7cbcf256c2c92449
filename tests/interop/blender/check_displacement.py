"""Control mesh, subdivision and displacement in Blender against the source, and against our own rebuilt."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import json

import bpy
import numpy as np
from support import (install, load, make_active, pixels, positions, ran, routes, said, start_anew, use, work,
                     write_mesh)  # fmt: skip



def evaluated(obj):
    return obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()


def rms(first, second):
    """Both ways, as `remesh --rebuild` tells it."""
    report = json.loads(ran("measure", first, second, "--samples", 200000, "--json", "-"))
    return np.sqrt(sum(report[way]["RMS"] ** 2 for way in ("first_to_second", "second_to_first")) / 2)


def ours(plain, edges, levels):
    """Of the program's own rebuilt mesh."""
    out = work / "ours.json"
    width = 2 * 4 * edges * 2**levels
    ran("map", plain, "-o", work / "own.sph.ply")
    ran("remesh", work / "own.sph.ply", "--grid", f"cube:{edges}", "--subdiv-fit", "catmark", "--uv", "mesh",
        "-o", work / "control.ply", "--displace", work / "lack.exr", "--displace-size", f"{width}x{width // 2}", "--rebuild",
        work / "rebuilt.ply", "--json", out)  # fmt: skip
    return rms(plain, work / "rebuilt.ply")


def check(obj, edges=16, levels=4):
    """RMS distances: without displacement, with it, and our own; and the control mesh."""
    plain = write_mesh(work / "plain.obj", obj.data)
    bpy.ops.object.spherical_map()
    bpy.ops.object.spherical_map_control(edges=edges, levels=levels)
    made = bpy.context.object
    kinds = [modifier.type for modifier in made.modifiers]
    assert kinds == ["SUBSURF", "DISPLACE"], kinds
    assert len(made.data.polygons) == 6 * edges**2 and all(p.loop_total == 4 for p in made.data.polygons)
    with_it = rms(plain, write_mesh(work / "displaced.obj", evaluated(made)))
    made.modifiers["Displacement"].show_viewport = False
    without = rms(plain, write_mesh(work / "smooth.obj", evaluated(made)))
    made.modifiers["Displacement"].show_viewport = True
    own = ours(plain, edges, levels)
    assert with_it <= 2 * own, (with_it, own)
    assert with_it < without, "displacement helps"
    return without, with_it, own, made


def check_routes(path):
    """Control mesh and image to the last bit; what Blender's threads subdivide, up to their rounding."""
    exact, found = [], []
    for route in routes:
        use(route)
        start_anew()
        load(path)
        bpy.ops.object.spherical_map()
        bpy.ops.object.spherical_map_control(edges=8, levels=3)
        made = bpy.context.object
        image = made.modifiers["Displacement"].texture.image
        exact.append((positions(made.data), pixels(image).copy()))
        found.append(positions(evaluated(made)).copy())
    assert all((a == b).all() for a, b in zip(*exact))
    assert np.abs(found[0] - found[1]).max() < 1e-6


def check_saved(made):
    """The image is in the file."""
    name, before = made.name, positions(evaluated(made)).copy()
    bpy.ops.wm.save_as_mainfile(filepath=str(work / "control.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(work / "control.blend"))
    assert np.abs(positions(evaluated(bpy.data.objects[name])) - before).max() < 1e-6


def check_undo():
    objects, textures = set(bpy.data.objects.keys()), len(bpy.data.textures)
    source = next(obj for obj in bpy.data.objects if "spherical_map" in obj.data)
    make_active(source)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.spherical_map_control("EXEC_DEFAULT", True, edges=4, levels=2)
    assert set(bpy.data.objects.keys()) != objects
    bpy.ops.ed.undo()
    assert set(bpy.data.objects.keys()) == objects and len(bpy.data.textures) == textures


if __name__ == "__main__":
    install()
    start_anew()
    without, with_it, own, made = check(load(work / "creature.ply"))
    check_saved(made)
    check_undo()
    check_routes(work / "creature.ply")
    said(f"displacement: RMS {without:.5f} without, {with_it:.5f} with it, {with_it / own:.2f} of our own rebuilt")
