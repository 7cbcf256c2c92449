"""In a window: the operators from the menu, with progress, stopped by Esc; the panel; a picture of it.

Runs under a display of its own. Events are Blender's timers: what a person would press is called as the menu
calls it.
"""

import os
import pathlib
import shutil
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import numpy as np
from support import install, load, make_active, positions, said, start_anew, use, work

state = {"begin": time.monotonic(), "told": set()}


def window_context():
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    region = next(r for r in area.regions if r.type == "WINDOW")
    return dict(window=window, area=area, region=region, screen=window.screen)


def running_jobs():
    import threading

    return [thread for thread in threading.enumerate() if thread.name == "sphparam"]


def wait_for(condition, what, seconds=120):
    begin = time.monotonic()
    while not condition():
        assert time.monotonic() - begin < seconds, what
        yield 0.05


def screenshot(name):
    path = str(work / name)
    with bpy.context.temp_override(**window_context()):
        bpy.ops.screen.screenshot(filepath=path)
    assert os.path.getsize(path) > 20_000
    if os.environ.get("SPHERICAL_MAP_PICTURES"):
        shutil.copy(path, os.environ["SPHERICAL_MAP_PICTURES"])


def call(operator, **options):
    with bpy.context.temp_override(**window_context()):
        return operator("INVOKE_DEFAULT", True, **options)


def undo(operator):
    with bpy.context.temp_override(**window_context()):
        operator()


def script():
    """What happens, one step after the other; yields how long to wait."""
    install()
    start_anew()
    obj = load(work / "creature.ply")
    context = window_context()
    context["area"].spaces.active.show_region_ui = True
    undo(lambda: bpy.ops.ed.undo_push(message="loaded"))
    yield 0.5

    # From the menu: a thread, and the window goes on.
    assert call(bpy.ops.object.spherical_map, quality="best") == {"RUNNING_MODAL"}
    assert running_jobs() and "Spherical" not in obj.data.uv_layers
    yield from wait_for(lambda: "Spherical" in obj.data.uv_layers, "the map is made in a thread")
    assert not running_jobs() and obj.data["spherical_map"].startswith("one-to-one")
    yield 0.2
    name = obj.name
    undo(bpy.ops.ed.undo)
    assert "Spherical" not in bpy.data.objects[name].data.uv_layers, "one step of undo"
    undo(bpy.ops.ed.redo)
    obj = make_active(bpy.data.objects[name])
    assert "Spherical" in obj.data.uv_layers

    # Stopped: nothing has changed.
    before = positions(obj.data).copy(), set(bpy.data.objects.keys())
    assert call(bpy.ops.object.spherical_map, quality="best") == {"RUNNING_MODAL"}
    from spherical_map.operators import running

    [job] = running.jobs()
    job.stop()
    yield from wait_for(lambda: not running.jobs(), "a job that is stopped ends")
    assert (positions(obj.data) == before[0]).all() and set(bpy.data.objects.keys()) == before[1]

    # What it looks like.
    with bpy.context.temp_override(**window_context()):
        bpy.ops.object.spherical_map_bake(field="checker", size=1024, show=True)
    space = window_context()["area"].spaces.active
    space.shading.type, space.shading.color_type = "SOLID", "TEXTURE"
    with bpy.context.temp_override(**window_context()):
        bpy.ops.view3d.view_selected()
    yield 1.0
    screenshot("window_map.png")
    yield from other_pictures(obj)


def other_pictures(obj):
    """A control mesh, and then a mesh with a hole: what is at fault is seen in Edit Mode."""
    with bpy.context.temp_override(**window_context()):
        bpy.ops.object.spherical_map_control(edges=12, levels=3)
    obj.hide_set(True)
    yield 1.0
    screenshot("window_control.png")
    bpy.context.object.hide_set(True)
    obj.hide_set(False)
    make_active(obj)
    import bmesh

    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.faces.ensure_lookup_table()
    high = positions(obj.data)[:, 2].max()
    bmesh.ops.delete(bm, geom=[f for f in bm.faces if f.calc_center_median().z > 0.7 * high], context="FACES")
    bm.to_mesh(obj.data)
    bm.free()
    try:
        with bpy.context.temp_override(**window_context()):
            bpy.ops.object.spherical_map()
        raise AssertionError("a hole is refused")
    except RuntimeError as error:
        assert "boundary edges" in str(error)
    with bpy.context.temp_override(**window_context()):
        bpy.ops.object.mode_set(mode="EDIT")
    yield 1.0
    screenshot("window_hole.png")
    with bpy.context.temp_override(**window_context()):
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.wm.call_panel(name="VIEW3D_PT_spherical_map")
    yield 1.0
    screenshot("window_panel.png")
    said("window: in a thread with progress, stopped, undone; four pictures")


steps = script()


def go_on():
    """Blender's timer: the next step, or the end."""
    try:
        assert time.monotonic() - state["begin"] < 400, "it takes too long"
        return next(steps)
    except StopIteration:
        end(0)
    except BaseException:
        import traceback

        traceback.print_exc()
        end(1)
    return None


def end(code):
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


bpy.app.timers.register(go_on, first_interval=2)
