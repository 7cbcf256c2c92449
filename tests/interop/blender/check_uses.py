"""Baking and remeshing in Blender: the images and meshes are the program's, both routes alike, and stay."""

import ctypes
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import bpy
import numpy as np
from support import (column, directions, drawn_triangles, expect_refusal, install, load, load_pixels, loop_vertices,
                     make_active, pixels, positions, ran, routes, said, start_anew, use, uv, work, write_mesh)  # fmt: skip

width = 512


def mapped(name):
    start_anew()
    obj = load(work / name)
    bpy.ops.object.spherical_map()
    return obj


def same_texels(first, second, limit):
    """The share of texels that differ by more than a limit in any channel."""
    return (np.abs(first - second)[:, :, :3].max(axis=2) > limit).mean()


def check_images(plain):
    """What the program bakes of the same mesh. The mesh in Blender was cut, in floats: where triangles meet,
    single texels may be the neighbour's."""
    own = work / "own.sph.ply"
    ran("map", plain, "-o", own)
    shares = {}
    for field in ("position", "ao", "curvature", "area", "graticule"):
        path = work / ("own.png" if field == "graticule" else "own.exr")
        depth = [] if field == "graticule" else ["--depth", "float"]
        ran("bake", own, "--map", field, "--size", width, "-o", path, *depth)
        theirs = load_pixels(path, field != "graticule")
        images = []
        for route in routes:
            use(route)
            obj = mapped("creature.ply")
            assert bpy.ops.object.spherical_map_bake(field=field, size=width) == {"FINISHED"}
            image = bpy.data.images[f"{obj.name} {field}"]
            assert image.packed_file is not None and tuple(image.size) == (width, width // 2)
            assert image.colorspace_settings.name == ("sRGB" if field == "graticule" else "Non-Color")
            images.append(pixels(image).copy())
        assert (images[0] == images[1]).all(), f"{field}: both routes alike"
        spread = np.ptp(theirs[:, :, :3])
        shares[field] = same_texels(images[0], theirs, 0.05 * spread)
    assert max(shares.values()) < 0.01, shares
    return max(shares.values())


def check_vertex_colours():
    """Colours of vertices as Blender has them."""
    obj = mapped("creature.ply")
    bpy.ops.object.spherical_map_bake(field="basecolor", size=width)
    image = pixels(bpy.data.images[f"{obj.name} basecolor"])
    attribute = obj.data.color_attributes[0]
    assert attribute.domain in ("POINT", "CORNER")
    number = 700
    loop = int(np.flatnonzero(loop_vertices(obj.data) == number)[0])
    u, v = uv(obj.data)[loop]
    texel = image[min(int((1 - v) * width / 2), width // 2 - 1), min(int(u * width), width - 1), :3]
    colour = attribute.data[number if attribute.domain == "POINT" else loop].color_srgb[:3]
    assert np.abs(texel - colour).max() < 0.1, (texel, colour)


def check_remesh():
    """Grids, with the UV map, colours and map; each is a mapped mesh itself."""
    for grid, vertices, faces in (("ICO", 10 * 4**4 + 2, 20 * 4**4), ("CUBE", 6 * 16**2 + 2, 6 * 16**2), ("OCTA", 4 * 16**2 + 2, 8 * 16**2)):
        made = []
        for route in routes:
            use(route)
            source = mapped("creature.ply")
            bpy.ops.object.spherical_map_remesh(grid=grid, level=4, edges=16, samples=33)
            obj = bpy.context.object
            assert obj != source and obj.users_collection == source.users_collection
            made.append([positions(obj.data), uv(obj.data), directions(obj.data)])
        assert all((a == b).all() for a, b in zip(*made)), "both routes alike"
        assert len(obj.data.vertices) >= vertices and len(obj.data.polygons) >= faces
        assert "Color" in obj.data.color_attributes
        ran("measure", write_mesh(work / "a.obj", source.data), write_mesh(work / "b.obj", obj.data), "--max-rms", "2%")
        bpy.ops.object.spherical_map_bake(field="normal-object", size=64)


def check_selected_to_active():
    """Detail of one mesh for another one on the same sphere, in the other's tangent frame."""
    source = mapped("creature.ply")
    bpy.ops.object.spherical_map_remesh(grid="ICO", level=4)
    low = bpy.context.object
    make_active(low, source)
    bpy.ops.object.spherical_map_bake(field="normal-tangent", size=width, show=True)
    image = bpy.data.images[f"{low.name} normal-tangent"]
    blue = pixels(image)[:, :, 2]
    assert blue.mean() > 0.9 and blue.min() < 0.8, "normals about the low mesh's own, and not all of them"
    tree = low.active_material.node_tree
    assert any(n.type == "NORMAL_MAP" and n.inputs["Color"].is_linked for n in tree.nodes)
    make_active(low)
    other = load(work / "body.ply")
    bpy.ops.object.spherical_map()
    make_active(low, source, other)
    try:
        bpy.ops.object.spherical_map_bake(field="ao", size=64)
        raise AssertionError("two sources are no source")
    except RuntimeError as error:
        assert "select one" in str(error)


def check_attribute():
    obj = mapped("creature.ply")
    heat = obj.data.attributes.new("heat", "FLOAT", "POINT")
    heat.data.foreach_set("value", positions(obj.data)[:, 2].astype(np.float32))
    bpy.ops.object.spherical_map_bake(field="scalar", attribute="heat", size=64)
    bpy.ops.object.spherical_map_bake(field="position", size=64)
    found, place = (pixels(bpy.data.images[f"{obj.name} {n}"]) for n in ("heat", "position"))
    assert np.abs(found[:, :, 0] - place[:, :, 2]).max() < 1e-5


taken = ("x", "sx", "red", "s", "source_vertex", "theta", "nx", "attribute_0", "my heat", "Color")


def check_names():
    """Attributes may be called as anything in sphparam's files is, and keep their names and numbers."""
    made = []
    for route in routes:
        use(route)
        obj = mapped("creature.ply")
        bpy.ops.object.spherical_map_remesh(grid="ICO", level=4)
        plain = bpy.context.object.data
        for number, name in enumerate(taken):
            kind = "INT" if name == "source_vertex" else "FLOAT"
            values = np.full(len(obj.data.vertices), number) if kind == "INT" else number + positions(obj.data)[:, 2]
            obj.data.attributes.new(name, kind, "POINT").data.foreach_set("value", values)
        make_active(obj)
        bpy.ops.object.spherical_map_remesh(grid="ICO", level=4)
        mesh = bpy.context.object.data
        assert (positions(mesh) == positions(plain)).all() and (directions(mesh) == directions(plain)).all()
        assert len(mesh.color_attributes) == len(plain.color_attributes) == 1
        assert (column(mesh.color_attributes[0].data, "color", width=4) ==
                column(plain.color_attributes[0].data, "color", width=4)).all()  # fmt: skip
        for number, name in enumerate(taken):
            kind = np.int32 if name == "source_vertex" else np.float32
            found = column(mesh.attributes[name].data, "value", kind)
            wanted = np.full(len(found), number) if kind == np.int32 else number + positions(mesh)[:, 2]
            assert np.abs(found - wanted).max() < 1e-4, name
        make_active(obj)
        bpy.ops.object.spherical_map_bake(field="position", size=64)
        place = pixels(bpy.data.images[f"{obj.name} position"])
        for number, name in enumerate(taken):
            bpy.ops.object.spherical_map_bake(field="scalar", attribute=name, size=64)
            image = pixels(bpy.data.images[f"{obj.name} {name}"])
            wanted = number + (0 if name == "source_vertex" else place[:, :, 2])
            assert np.abs(image[:, :, 0] - wanted).max() < 1e-4, name
        made.append(image.copy())
    assert (made[0] == made[1]).all(), "both routes alike"


def check_file():
    """What a saved file has when it is opened again."""
    obj = mapped("creature.ply")
    name = obj.name
    bpy.ops.object.spherical_map_bake(field="position", size=64)
    before = pixels(bpy.data.images[f"{name} position"]).copy(), directions(obj.data), uv(obj.data)
    path = str(work / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = make_active(bpy.data.objects[name])
    after = pixels(bpy.data.images[f"{name} position"]), directions(obj.data), uv(obj.data)
    assert all((a == b).all() for a, b in zip(before, after))
    bpy.ops.object.spherical_map_bake(field="position", size=64)
    assert (pixels(bpy.data.images[f"{name} position"]) == before[0]).all()


def check_undo():
    obj = mapped("creature.ply")
    name = obj.name
    bpy.ops.ed.undo_push(message="mapped")
    for call in (bpy.ops.object.spherical_map_bake, bpy.ops.object.spherical_map_remesh):
        before = set(bpy.data.images.keys()), set(bpy.data.objects.keys())
        call("EXEC_DEFAULT", True)
        assert (set(bpy.data.images.keys()), set(bpy.data.objects.keys())) != before
        bpy.ops.ed.undo()
        assert (set(bpy.data.images.keys()), set(bpy.data.objects.keys())) == before
        make_active(bpy.data.objects[name])


def textured_ball(change=lambda nodes, image: None):
    """A ball that shows an image by its own UV map, with a node that is changed."""
    start_anew()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16)
    obj = bpy.context.object
    image = bpy.data.images.new("own", 8, 8)
    material = bpy.data.materials.new("own")
    material.use_nodes = True
    obj.data.materials.append(material)
    nodes = material.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    material.node_tree.links.new(texture.outputs[0], nodes["Principled BSDF"].inputs["Base Color"])
    change(material.node_tree, texture)
    bpy.ops.object.spherical_map()
    return obj


def inverted(tree, texture):
    node = tree.nodes.new("ShaderNodeInvert")
    tree.links.new(texture.outputs[0], node.inputs["Color"])
    tree.links.new(node.outputs[0], tree.nodes["Principled BSDF"].inputs["Base Color"])


def mapping(tree, texture):
    tree.links.new(tree.nodes.new("ShaderNodeMapping").outputs[0], texture.inputs[0])


def check_plain_images():
    """Base colours that are more than an image by a UV map are refused; they were baked as if they were not."""
    changes = {"other nodes change": inverted, "other coordinates": mapping,
               "colour space": lambda tree, texture: setattr(texture.image.colorspace_settings, "name", "Non-Color"),
               "CLIP": lambda tree, texture: setattr(texture, "extension", "CLIP")}  # fmt: skip
    for words, change in changes.items():
        textured_ball(change)
        expect_refusal(lambda: bpy.ops.object.spherical_map_bake(field="basecolor", size=32), words, "Cycles")
    textured_ball()
    assert bpy.ops.object.spherical_map_bake(field="basecolor", size=32) == {"FINISHED"}


def check_own_images():
    """An image of the user's is none of ours, whatever its name; ours stay without users, and apart when unpacked."""
    obj = mapped("creature.ply")
    theirs = bpy.data.images.new(f"{obj.name} position", 8, 8)
    bpy.ops.object.spherical_map_bake(field="position", size=32)
    bpy.ops.object.spherical_map_bake(field="height", size=32)
    assert tuple(theirs.size) == (8, 8)
    made = [image for image in bpy.data.images if image.packed_file]
    assert len(made) == 2 and all(image.use_fake_user for image in made)
    assert len({bpy.path.basename(image.packed_files[0].filepath) for image in made}) == 2


def check_control():
    """A control mesh has the UV map that equirectangular images are shown by, beside that of its displacement."""
    obj = mapped("creature.ply")
    bpy.ops.object.spherical_map_control(edges=8, levels=2)
    made = bpy.context.object
    assert made.modifiers["Displacement"].uv_layer == "Spherical Grid"
    at_loops = directions(made.data)[loop_vertices(made.data)]
    theta = np.arctan2(at_loops[:, 1], at_loops[:, 0]) / (2 * np.pi)
    found = uv(made.data)
    away = np.abs(at_loops[:, 2]) < 0.9
    apart = (found[:, 0] - theta + 0.5) % 1 - 0.5
    assert np.abs(apart[away]).max() < 1e-5
    assert np.abs(found[:, 1] - (1 - np.arccos(at_loops[:, 2]) / np.pi)).max() < 1e-5


def told_by(operator, **options):
    """What it reports; without a window Blender prints that."""
    sys.stdout.flush()
    kept, told = os.dup(1), work / "told"
    with open(told, "wb") as out:
        os.dup2(out.fileno(), 1)
        try:
            operator(**options)
            ctypes.CDLL(None).fflush(None)
        finally:
            os.dup2(kept, 1)
            os.close(kept)
    return told.read_text()


def check_left_materials():
    """A new mesh has no materials of the source's, which is told."""
    source = mapped("creature.ply")
    for count, words in enumerate(("", "; the material stays with ", "; the 2 materials stay with ")):
        if count > 0:
            source.data.materials.append(bpy.data.materials.new(f"m{count}"))
        for operator, options in ((bpy.ops.object.spherical_map_remesh, {"grid": "ICO", "level": 2}),
                                  (bpy.ops.object.spherical_map_control, {"edges": 4, "levels": 1})):  # fmt: skip
            make_active(source)
            told = told_by(operator, **options)
            assert (words + source.name in told) if words else ("stay" not in told and "Info: " in told), told
            assert not bpy.context.object.data.materials


install()
obj = load(work / "creature.ply")
off = check_images(write_mesh(work / "own.obj", obj.data))
check_vertex_colours()
check_remesh()
check_names()
use("PROGRAM")
check_selected_to_active()
check_attribute()
check_plain_images()
check_own_images()
check_control()
check_left_materials()
check_undo()
check_file()
said(f"uses: images are the program's but for {100 * off:.2f} % of the texels at most; remesh, any names, save, undo")
