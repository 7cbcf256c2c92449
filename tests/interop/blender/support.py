"""What the checks in Blender share."""

import json
import os
import pathlib
import struct
import subprocess
import sys

import bpy
import numpy as np

work = pathlib.Path(os.environ["SPHPARAM_WORK"])
program = os.environ["SPHPARAM_PROGRAM"]
routes = ("PACKAGE", "PROGRAM")


def install(route="PROGRAM"):
    """The add-on, from its zip; without windows that would ask for anything."""
    if "spherical_map" not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_install(filepath=os.environ["SPHERICAL_MAP_ZIP"], overwrite=True)
        bpy.ops.preferences.addon_enable(module="spherical_map")
    use(route)


def use(route):
    wanted = bpy.context.preferences.addons["spherical_map"].preferences
    wanted.route, wanted.program = route, program
    wanted.package_folder = os.environ["SPHPARAM_PACKAGE"]


def ran(*words):
    """What the program says."""
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{words}: {done.stderr}"
    return done.stdout


def start_anew():
    """A scene without objects, meshes, images."""
    for items in (bpy.data.objects, bpy.data.meshes, bpy.data.images, bpy.data.textures, bpy.data.materials):
        for item in list(items):
            items.remove(item)


def make_active(obj, *others):
    bpy.context.view_layer.update()  # what is linked just now cannot be selected before
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj or other in others)
    bpy.context.view_layer.objects.active = obj
    return obj


def add(mesh, name="mesh"):
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    return make_active(obj)


def load(path):
    """A mesh of a file of any format, as floats: by the program to PLY, by Blender from there; smooth."""
    plain = work / (pathlib.Path(path).name + ".plain.ply")
    ran("repair", path, "-o", plain, "-q")
    bpy.ops.import_mesh.ply(filepath=str(plain))
    mesh = bpy.context.object.data
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    return make_active(bpy.context.object)


def column(items, name, kind=np.float32, width=1):
    found = np.empty(len(items) * width, kind)
    items.foreach_get(name, found)
    return found.reshape(-1, width) if width > 1 else found


def positions(mesh):
    return column(mesh.vertices, "co", width=3)


def loop_vertices(mesh):
    return column(mesh.loops, "vertex_index", np.int32)


def uv(mesh, name="Spherical"):
    return column(mesh.uv_layers[name].data, "uv", width=2)


def directions(mesh):
    """The add-on's attributes, as it documents them."""
    parts = [column(mesh.attributes[n].data, "vector", width=3) for n in ("spherical_map", "spherical_map_rest")]
    return parts[0].astype(np.float64) + parts[1]


def write_obj(path, points, triangles):
    """Floats to the last bit."""
    with open(path, "w") as out:
        np.savetxt(out, np.asarray(points, np.float64), "v %.17g %.17g %.17g")
        np.savetxt(out, np.asarray(triangles) + 1, "f %d %d %d")
    return path


def drawn_triangles(mesh):
    mesh.calc_loop_triangles()
    return column(mesh.loop_triangles, "vertices", np.int32, 3)


def write_mesh(path, mesh):
    return write_obj(path, positions(mesh), drawn_triangles(mesh))


def pixels(image):
    """(H, W, 4), the top row first."""
    width, height = image.size
    found = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(found)
    return found.reshape(height, width, 4)[::-1]


def load_pixels(path, is_data=True):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color" if is_data else "sRGB"
    found = pixels(image).copy()
    bpy.data.images.remove(image)
    return found


def psnr(first, second):
    """Decibels, of colours from 0 to 1."""
    return float(-10 * np.log10(max(np.mean((first.astype(np.float64) - second) ** 2), 1e-20)))


class Glb:
    """The first primitive of a .glb, y up turned to z up."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        size = struct.unpack_from("<I", data, 12)[0]
        self._json = json.loads(data[20 : 20 + size])
        self._body = data[20 + size + 8 :]
        primitive = self._json["meshes"][0]["primitives"][0]
        rows = {name: self._rows(number) for name, number in primitive["attributes"].items()}
        self.triangles = self._rows(primitive["indices"]).reshape(-1, 3)
        up = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], np.float32)
        self.positions = rows["POSITION"] @ up
        self.uv = rows["TEXCOORD_0"] * [1, -1] + [0, 1]
        self.tangents = rows["TANGENT"][:, :3] @ up if "TANGENT" in rows else None

    def _rows(self, number):
        accessor = self._json["accessors"][number]
        view = self._json["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4", 5123: "<u2"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        assert view.get("byteStride", 0) in (0, width * np.dtype(kind).itemsize)
        flat = np.frombuffer(self._body, kind, accessor["count"] * width, begin)
        return flat.reshape(-1, width) if width > 1 else flat


def said(line):
    """What a reader of the run wants to know."""
    print("blender: " + line, flush=True)


def expect_refusal(call, *words):
    """What is said of a call that cannot be done."""
    try:
        call()
    except RuntimeError as error:
        text = str(error)
        assert "Traceback" not in text, text
        for word in words:
            assert word in text, f"{word!r} is not in: {text}"
        return text
    raise AssertionError("it was not refused")


sys.path.insert(0, str(pathlib.Path(__file__).parent))
