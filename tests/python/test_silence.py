"""Nothing goes wrong in silence: colours, copies of vertices, values without room, maps that are not there."""

import json
import os
import re
import struct
import subprocess
import warnings
import zlib

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato
from sphparam._images import png_of

V, F = potato(3)
colours = (np.abs(V) / np.abs(V).max() * 255).astype(np.uint8)


@pytest.fixture(scope="module")
def painted():
    return sp.map(V, F, values={"color": colours, "height": V[:, 2], "label": np.arange(len(V)) % 3})


@pytest.fixture(scope="module")
def shining(tmp_path_factory):
    """Of one material, which has all but textures."""
    folder = tmp_path_factory.mktemp("shining")
    (folder / "a.mtl").write_text("newmtl red\nKd 0.5 0.2 0.1\nPr 0.3\nPm 0.6\nKe 0.9 0.5 0.1\n")
    lines = [f"v {x} {y} {z}" for x, y, z in V.tolist()] + [f"f {a} {b} {c}" for a, b, c in (F + 1).tolist()]
    (folder / "a.obj").write_text("\n".join(["mtllib a.mtl", "usemtl red", *lines, ""]))
    return sp.map(sp.read(folder / "a.obj"))


def told(use):
    """What a call returns, and its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = use()
    assert {w.category for w in caught} <= {sp.LossWarning}
    return made, [str(w.message) for w in caught]


def pixels_of(path):
    """The bytes of a PNG with filters, (H, W, C)."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        [size], kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        chunk, at = data[at + 8 : at + 8 + size], at + 12 + size
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", chunk[:10])
        packed += chunk if kind == b"IDAT" else b""
    assert depth == 8
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, -1)
    return unfiltered(rows, channels).reshape(height, width, channels)


def unfiltered(rows, channels):
    above, found = [0] * (rows.shape[1] - 1), []
    for kind, *row in rows.tolist():
        for k in range(len(row)):
            left = row[k - channels] if k >= channels else 0
            corner = above[k - channels] if k >= channels else 0
            guess = [0, left, above[k], (left + above[k]) // 2, paeth(left, above[k], corner)][kind]
            row[k] = (row[k] + guess) & 255
        found.append(row)
        above = row
    return np.array(found, np.uint8)


def paeth(left, above, corner):
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))


# Colours are sRGB, whatever is done to them.


@pytest.mark.parametrize("field, heat", [("basecolor", False), ("vcolor", False), ("curvature", True), ("area", True)])
def test_colours_are_those_of_the_programs_png(field, heat, painted, tmp_path):
    image = painted.bake(field, size=32, heat=heat)
    painted.bake_files({field: tmp_path / "a.png"}, size=32, heat=heat)
    png = pixels_of(tmp_path / "a.png")
    assert image.dtype == np.float32 and image.about.endswith("sRGB")
    assert (image.picture() == png).all()
    assert (np.floor(np.asarray(image) * 255 + 0.5) == png).all()


@pytest.mark.parametrize("field", ["basecolor", "emissive", "orm", "roughness", "metallic", "occlusion"])
def test_what_materials_have_is_that_of_the_programs_png(field, shining, tmp_path):
    image = shining.bake(field, size=32)
    shining.bake_files({field: tmp_path / "a.png"}, size=32)
    assert (image.picture() == pixels_of(tmp_path / "a.png")).all()
    assert image.about.endswith("sRGB") == (field in ("basecolor", "emissive"))


def test_maps_of_materials_are_exported_as_the_program_does(shining, tmp_path):
    fields = {"normal-tangent": "normal_map", "orm": "orm_map", "emissive": "emissive_map"}
    baked = {field: shining.bake(field, size=32) for field in fields}
    shining.bake_files({field: tmp_path / f"{name}.png" for field, name in fields.items()}, size=32)
    shining.export(tmp_path / "a.glb", image_size=16, **{name: tmp_path / f"{name}.png" for name in fields.values()})
    made = shining.export(tmp_path / "b.gltf", image_size=16, **{name: baked[field] for field, name in fields.items()})
    [material] = json.loads((tmp_path / "b.gltf").read_text())["materials"]
    assert material["emissiveTexture"] and material["pbrMetallicRoughness"]["metallicRoughnessTexture"] and len(made) >= 5
    again = sp.read(tmp_path / "a.glb")
    assert (sp.map(again).bake("emissive", size=16).picture() == (243, 188, 89)).all()
    shining.save(tmp_path / "c.sph.ply")
    maps = ["--normal-map", "normal_map.png", "--orm-map", "orm_map.png", "--emissive-map", "emissive_map.png"]
    command = [os.environ["SPHPARAM_PROGRAM"], "export", "c.sph.ply", "--image-size", "16", *maps, "-o", "d.glb"]
    subprocess.run(command, check=True, cwd=tmp_path, capture_output=True)
    sp.load(tmp_path / "c.sph.ply").export(
        tmp_path / "e.glb", image_size=16, name="c.sph", **{name: tmp_path / f"{name}.png" for name in fields.values()}
    )
    assert (tmp_path / "d.glb").read_bytes() == (tmp_path / "e.glb").read_bytes()
    for name, wrong, words in (
        ("orm_map", "emissive", "'orm' is needed, not of 'emissive'"),
        ("emissive_map", "orm", "'emissive' is needed, not of 'orm'"),
        ("occlusion_map", "orm", "'ao' is needed, or of 'occlusion', not of 'orm'"),
    ):
        with pytest.raises(ValueError, match=f"{name}: an image of {words}"):
            shining.export(tmp_path / "f.glb", **{name: baked[wrong]})
    shining.export(tmp_path / "f.glb", image_size=16, occlusion_map=shining.bake("occlusion", size=16))


@pytest.mark.parametrize("change", [lambda b: b * 1.0, lambda b: np.clip(b, 0, 1), np.asarray, lambda b: b.picture()])
def test_colours_are_exported_alike_after_any_operation(change, painted, tmp_path):
    image = painted.bake("basecolor", size=32)
    plain = painted.remesh("ico:3", transfer=[])
    plain.export(tmp_path / "a.obj", texture=image)
    plain.export(tmp_path / "b.obj", texture=change(image))
    [a], [b] = tmp_path.glob("a*.png"), tmp_path.glob("b*.png")
    assert (pixels_of(a) == pixels_of(b)).all()


def test_shares_and_alpha_are_at_most_one(painted, tmp_path):
    for field in ("ao", "mask", "basecolor"):
        image = painted.bake(field, size=64)
        assert 0 <= image.min() and image.max() <= 1
        painted.export(tmp_path / "a.ply", texture=np.asarray(image))
    assert painted.bake("mask", size=32).picture().min() == 255
    painted.export(tmp_path / "a.ply", texture=np.full((8, 16, 3), 1.0000001))
    with pytest.raises(ValueError, match="from 0 to 1 are needed, not 0 to 1.001"):
        painted.export(tmp_path / "b.ply", texture=np.linspace(0, 1.001, 384).reshape(8, 16, 3))
    holed = sp.map(V, F[6:], repair=dict(keep_holes=True), values={"color": colours}).bake("basecolor", size=64)
    assert holed.shape[2] == 4 and holed.max() <= 1 and holed[:, :, 3].min() == 0


def test_what_is_reduced_is_a_number(painted):
    image = painted.bake("ao", size=32)
    for number in (image.min(), image.mean(), np.max(image), image.sum(), np.ptp(image)):
        assert isinstance(number, np.floating) and not isinstance(number, np.ndarray)
    for array in (image.mean(axis=2), image + 1, np.sqrt(image)):
        assert type(array) is np.ndarray


@pytest.mark.parametrize(("field", "share"), [("position", "25 %"), ("radius", "25 %"), ("slope", "")])
def test_a_field_far_from_the_origin_is_told_to_be_rounded(field, share):
    V, F = potato(2)
    m = sp.map(2 * V / np.ptp(V, 0).max() + (0, 5e6, 0), F)
    _, lines = told(lambda: m.bake(field, size=32))
    wanted = f"{field}: so far from the origin, numbers of 32 bits are 0.5 apart, {share} of the mesh's length: "
    wanted += 'bake_files(…, depth="u16") keeps more, or move the mesh nearer'
    outside = [line for line in lines if line.startswith("the centre 0,0,0 lies outside of the surface: ")]
    assert len(outside) == (field != "position") and lines == outside + ([wanted] if share else [])


def test_a_notebook_shows_a_picture(painted):
    image = painted.bake("basecolor", size=32)
    assert image._repr_png_()[:8] == b"\x89PNG\r\n\x1a\n" and image[0]._repr_png_() is None
    assert np.zeros_like(image)._repr_png_() is None


@pytest.mark.parametrize("name", ["color", "colors", "red"])
def test_floats_to_255_are_no_colours(name):
    wrong = colours.astype(float) if name != "red" else colours[:, 0].astype(float)
    with pytest.raises(ValueError, match=r"floats from 0 to 1, or uint8, not \S+ to \d+; .*astype\(np.uint8\)"):
        sp.map(V, F, values={name: wrong})
    assert sp.Mesh(V, F, values={name: wrong / 255}).values


# What there is no room for, and maps that are not there.


def test_what_an_export_leaves_out_is_told_once(painted, tmp_path):
    for ending in (".glb", ".gltf", ".obj"):
        _, [line] = told(lambda: painted.export(tmp_path / f"a{ending}"))
        assert "not carried: height, label" in line and "color" not in line
    assert told(lambda: painted.export(tmp_path / "a.ply"))[1] == []
    with_uv = sp.map(V, F, values={"uv": V[:, :2]})
    assert "source_uv=True keeps uv" in told(lambda: with_uv.export(tmp_path / "b.glb"))[1][0]
    assert told(lambda: with_uv.export(tmp_path / "b.glb", source_uv=True))[1] == []
    low = sp.map(V, F).remesh("ico:2")
    assert told(lambda: low.export(tmp_path / "c.glb"))[1] == []
    assert "not carried: the animation" in told(lambda: low.export(tmp_path / "c.usdz", morph="sphere"))[1][0]
    assert told(lambda: low.export(tmp_path / "c.usda", image_size=16)) == ([str(tmp_path / n) for n in ("c.usda", "c_checker.png")], [])


def test_a_picture_that_is_not_twice_as_wide_as_high_is_told(painted, tmp_path):
    square = tmp_path / "square.png"
    square.write_bytes(png_of(np.zeros((8, 8, 3), np.uint8)))
    for use in (lambda: painted.paint(square), lambda: painted.export(tmp_path / "a.glb", texture=square)):
        assert any(line.startswith("square.png: 8 × 8: ") for line in told(use)[1])


def test_a_file_without_a_map_is_told_as_such(painted, tmp_path):
    told(lambda: painted.export(tmp_path / "a.glb"))
    painted.save(tmp_path / "a.sph.ply")
    assert told(lambda: sp.load(tmp_path / "a.sph.ply"))[1] == []
    _, lines = told(lambda: sp.load(tmp_path / "a.glb"))
    assert any("a.glb: carries no map, so another one was made; .sph.ply" in line for line in lines)


# Copies of vertices: triangles by themselves, seams of texture coordinates.


def soup():
    return V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3)


def seamed():
    """The mesh cut in two halves, each vertex of the seam twice, with (u, v) of their own."""
    faces = F + len(V) * (V[F].mean(axis=1)[:, :1] < 0)
    used, faces = np.unique(faces, return_inverse=True)
    vertices = np.concatenate([V, V])[used]
    uv = np.column_stack([(used >= len(V)) + 0.1 * vertices[:, 0], vertices[:, 1]])
    return vertices, faces.reshape(-1, 3), uv


def test_welding_is_said_first_where_it_closes_the_mesh():
    for vertices, faces in (soup(), seamed()[:2]):
        for mesh in ((vertices, faces), (sp.Mesh(vertices, faces),)):
            with pytest.raises(sp.MeshError) as caught:
                sp.map(*mesh)
            text = str(caught.value)
            count = len(vertices) - len(V)
            assert f"map(mesh, repair=True) welds {count} exact copies of vertices first, and mends it" in text
            assert "component=1" not in text and caught.value.defects
    two = np.concatenate([soup()[0], 0.5 * soup()[0] + 9]), np.concatenate([soup()[1], soup()[1] + F.size])
    assert "first, but then:\n  2 separate" in refusal(*two)
    assert "[map(part) for part in sphparam.components(mesh, repair=True)]" in refusal(*two)
    assert len([sp.map(part) for part in sp.components(*two, repair=True)]) == 2
    holed = soup()[0], soup()[1][2:]
    with pytest.raises(sp.MeshError, match="welds .* exact copies of vertices first, and mends it:\n  .*filled"):
        sp.map(*holed)


def test_copies_are_welded_by_repair_as_on_reading(tmp_path):
    vertices, faces = soup()
    made = sp.map(vertices, faces, repair=True)
    assert len(made.vertices) == len(V) and made.mesh.area_share == 1 and made.mesh.format == "arrays"
    [action] = made.repairs
    assert action.kind == "vertex-welded" and action.times == len(vertices) - len(V)
    assert (vertices[made.vertex_origin] == made.vertices).all()
    sp.write(tmp_path / "a.ply", vertices, faces)
    assert (sp.map(sp.read(tmp_path / "a.ply")).points == made.points).all()
    assert len(sp.components(vertices, faces, repair=True)) == 1
    closed = np.concatenate([V, V[:1]]), F.copy()
    assert sp.repair(*closed).repairs[0].kind == "unused-vertex-dropped"


def test_parts_that_only_copies_keep_asunder_are_told():
    parts, [line] = told(lambda: sp.components(*soup()))
    assert len(parts) == len(F) and "exact copies of vertices keep parts asunder; components(mesh, repair=True)" in line
    assert told(lambda: sp.components(np.concatenate([V, V + 5]), np.concatenate([F, F + len(V)])))[1] == []


def test_texture_coordinates_stay_at_the_corners_of_welded_vertices():
    vertices, faces, uv = seamed()
    made, lines = told(lambda: sp.map(vertices, faces, repair=True, values={"uv": uv}))
    assert lines == [] and len(made.vertices) == len(V)
    corners = made.mesh.corner_uv
    assert corners.shape == (len(F), 3, 2) and (corners == uv[faces]).all()
    labels = np.arange(len(vertices))
    _, [line] = told(lambda: sp.repair(vertices, faces, values={"label": labels}))
    assert "label: welded vertices have that of the first copy, in" in line
    moved = vertices + 1e-6 * (uv[:, :1] > 0.5)
    _, [line] = told(lambda: sp.repair(moved, faces, weld_share=1e-4, values={"uv": uv}))
    assert "uv:" in line and "nearby" in line and "% of the faces" in line


def test_copies_are_welded_also_where_other_faces_must_go_first():
    vertices, faces, uv = seamed()
    faces = np.concatenate([faces, [[0, 1, 10**6]]])
    made, [line] = told(lambda: sp.map(vertices, faces, repair=True, values={"uv": uv}))
    assert len(made.vertices) == len(V) and line.startswith("uv:")
    apart, _ = told(lambda: sp.repair(vertices, faces, cracks=False, require_sphere=False))
    assert not any(action.kind == "vertex-welded" for action in apart.repairs)


def test_a_share_is_that_of_what_was_given():
    two = np.concatenate([V, 0.5 * V + 9]), np.concatenate([F, F + len(V)])
    assert sp.repair(*two, component=1).area_share == pytest.approx(0.8)
    assert sp.map(*two, repair=dict(component=2)).mesh.area_share == pytest.approx(0.2)
    assert sp.map(sp.components(*two)[1]).mesh.area_share == pytest.approx(0.2)


def hinged(size=0.5):
    """An octahedron and a smaller one on the other side of one of its edges, which is theirs together."""
    vertices, faces = octahedron()
    along = vertices[2] - vertices[0]
    foot = vertices[0] + np.outer((vertices - vertices[0]) @ along / 2, along)
    other = foot - size * (vertices - foot)
    number = np.array([0, 6, 2, 7, 8, 9])
    return np.concatenate([vertices, other[[1, 3, 4, 5]]]), np.concatenate([faces, number[faces]])


@pytest.mark.parametrize("beside", [False, True], ids=["one piece", "with a part beside"])
def test_shares_are_of_parts_as_repair_finds_them(beside):
    vertices, faces = hinged()
    if beside:
        vertices, faces = np.concatenate([vertices, 0.3 * V + 9]), np.concatenate([faces, F + len(vertices)])
    corners = vertices[faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    for component, [first, last] in ((1, [0, 8]), (2, [8, 16])):
        share = areas[first:last].sum() / areas.sum()
        made = sp.repair(vertices, faces, component=component)
        assert made.area_share == pytest.approx(share, rel=1e-12)
        assert sp.components(vertices, faces, repair=True)[component - 1].area_share == pytest.approx(share)
        if component == 1:
            [told] = [line for line in refusal(vertices, faces).split("\n") if "component=1" in line]
            assert told == f"map(mesh, repair=dict(component=1)) keeps {100 * share:.5g} % of the area:"


def test_faces_without_a_place_have_no_area_to_be_kept():
    vertices = V.copy()
    vertices[4] = np.nan
    assert sp.repair(vertices, F).area_share == 1
    other = np.concatenate([vertices, 0.5 * V + 9]), np.concatenate([F, F + len(V)])
    share = sp.repair(*other, component=2).area_share
    assert 0.2 < share < 0.22
    assert share == pytest.approx(sp.components(*other, repair=True)[1].area_share)


def test_a_mesh_with_more_values_knows_what_was_done_to_it():
    pieces, faces = soup()
    two = np.concatenate([pieces, 0.5 * V + 9]), np.concatenate([faces, F + len(pieces)])
    mended = sp.repair(*two, component=1)
    more = sp.Mesh(mended, values={"height": mended.vertices[:, 2]})
    assert mended.area_share == pytest.approx(0.8) and [r.kind for r in mended.repairs][0] == "vertex-welded"
    mapped = sp.map(mended, values={"height": mended.vertices[:, 2]})
    assert more.repairs == mapped.repairs == mended.repairs and more.format == mapped.mesh.format == "arrays"
    assert more.area_share == mapped.mesh.area_share == mended.area_share


def test_the_surface_of_what_is_no_mesh_is_none_either(tmp_path):
    sp.repair(V, F[1:], keep_holes=True).save(tmp_path / "a.ply")
    data = (tmp_path / "a.ply").read_bytes()
    at = data.index(b"end_header\n") + len(b"end_header\n")
    (tmp_path / "a.ply").write_bytes(data[:at] + struct.pack("<d", np.nan) + data[at + 8 :])
    surface = sp.read(tmp_path / "a.ply", non_finite=True).surface
    assert len(surface.faces) == len(F) - 1 and not surface.fillers.any()
    for use in (surface.creased, lambda _: surface.save(tmp_path / "b.ply"), lambda _: sp.measure(surface, surface)):
        with pytest.raises(sp.MeshError, match="not a finite number: vertices 0"):
            use(30)


# What to type, the best first.


def refusal(vertices, faces, **how):
    with pytest.raises(sp.MeshError) as caught:
        sp.map(vertices, faces, **how)
    return str(caught.value)


def test_a_refusal_says_what_loses_least_first():
    two = np.concatenate([V, 0.5 * V + 9]), np.concatenate([F, F + len(V)])
    text = refusal(*two)
    assert text.index("[map(part) for part in sphparam.components(mesh)]") < text.index("component=1")
    assert "map(mesh, repair=dict(component=1)) keeps 80 % of the area:" in text and "mends it" not in text
    assert "sphparam.components(mesh, repair=True)" in refusal(two[0], two[1][1:])
    assert "repair=dict(keep_holes=True)) keeps the holes" in refusal(V, F[1:])
    assert "sphparam.wrap(mesh).mesh is one closed surface about all of it" in text
    assert "wrap" not in refusal(V, F[1:])
    speck = refusal(np.concatenate([V, 1e-2 * V + 9]), two[1])
    assert "[map(part) for part in sphparam.components(mesh)] maps each component" in speck and "wrap" not in speck
    assert "map(mesh, repair=True) keeps 99.99 % of the area:" in speck
    assert refusal(V, F + 1) == (
        "faces: the indices count from 1: faces - 1 is what to pass; as they are, 6 faces name vertices that do not exist"
    )
    faces = F.copy().astype(np.int64)
    faces[7, 1], faces[9, 0] = 2**40, -4
    assert refusal(V, faces) == (
        "2 faces name vertices that do not exist: faces 7, 9: "
        f"there are {len(V)} vertices, 0 to {len(V) - 1}, and faces name -4, {2**40}"
    )


def test_a_surface_inside_out_is_told():
    with pytest.warns(sp.LossWarning, match="clockwise") as told:
        assert "faces[:, ::-1]" in sp.map(V, F[:, ::-1]).warnings[0]
    assert len(told) == 1 and told[0].filename == __file__
    assert sp.map(V, F).warnings == [] and sp.map(V, F[:, ::-1], repair=True).warnings == []


@pytest.mark.parametrize("size", [1e-150, 1e-110, 1e110, 1e150])
def test_which_side_is_out_is_told_of_any_size(size):
    assert sp.map(size * V, F, quality="draft").warnings == []
    with pytest.warns(sp.LossWarning, match="clockwise"):
        sp.map(size * V, F[:, ::-1], quality="draft")


def test_more_coefficients_than_vertices_are_told():
    mapped = sp.map(V, F)
    with pytest.warns(sp.LossWarning, match="coefficients for .* vertices") as told:
        found = mapped.spharm(int(len(V) ** 0.5))
    assert len(told) == 1
    assert f"; degree={found.decided_degree} leaves it out, least_squares=False is the integral" in str(told[0].message)
    assert mapped.spharm(found.decided_degree).decided_degree == found.decided_degree < found.degree
    mapped.spharm(int(len(V) ** 0.5), least_squares=False)


def test_an_integral_that_has_not_settled_is_told():
    vertices, faces = potato(2)
    middle = vertices[faces[0]].mean(axis=0)  # of a face in which a small one lies, and in that another
    inner = [middle + size * (vertices[faces[0]] - middle) for size in (0.08, 0.04)]
    n = len(vertices)
    loops = [faces[0], np.arange(n, n + 3), np.arange(n + 3, n + 6)]
    made = [loops[2]]
    for out, within in zip(loops, loops[1:]):
        for k, after in ((0, 1), (1, 2), (2, 0)):
            made += [[out[k], out[after], within[after]], [out[k], within[after], within[k]]]
    vertices = np.concatenate([vertices, *inner])
    peak = np.arange(len(vertices)) >= n + 3
    mapped = sp.map(vertices, np.concatenate([faces[1:], made]), method="radial", values={"peak": peak * 1.0})
    with pytest.warns(sp.LossWarning, match="the integral has not settled") as told:
        mapped.spharm(5, values=["peak"], least_squares=False)
    assert len(told) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mapped.spharm(5, least_squares=False)


def test_poles_and_meridian_come_back_from_a_file(tmp_path):
    made = sp.map(np.concatenate([[[9, 9, 9]], V]), F + 1, meridian=7, repair=True)
    assert made.poles is not None and made.meridian == 7
    for name in ("a.sph.ply", "a.vtk", "a.vtp"):
        made.save(tmp_path / name)
        read = sp.load(tmp_path / name)
        assert (read.poles, read.meridian) == (made.poles, made.meridian)
    none = sp.map(V, F, poles="none")
    none.save(tmp_path / "a.sph.ply")
    assert sp.load(tmp_path / "a.sph.ply").poles is None is none.poles
    false = (tmp_path / "a.vtk").read_bytes().replace(b"poles %d %d" % made.poles, b"poles %d %d" % (made.poles[0] - 1, made.poles[1]))
    (tmp_path / "a.vtk").write_bytes(false)
    assert sp.load(tmp_path / "a.vtk").poles is None


@pytest.mark.parametrize(
    "use, error, words",
    [
        (lambda m: sp.map(V, F[1:], keep_holes=True), TypeError, r"map\(mesh, repair=dict\(keep_holes=True\)\)"),
        (lambda m: sp.map(V, F, qualty="best"), TypeError, "qualty"),
        (lambda m: m.remesh(5), TypeError, "'ico:5'"),
        (lambda m: m.remesh("5"), TypeError, "'ico:5'"),
        (lambda m: m.remesh("like:a.ply"), ValueError, "or a map"),
        (lambda m: m.bake("ao", size=(16, 8)), TypeError, r"one number is needed, texels a row, not \(16, 8\)"),
        (lambda m: m.bake_files({"ao": "a.png"}, size=[16, 8]), TypeError, r"one number is needed, texels a row"),
        (lambda m: m.bake("normals"), ValueError, "no field normals; there are .*; is 'normal-object' meant"),
        (lambda m: m.bake("curvatur:mean"), ValueError, "'curvature' meant"),
        (lambda m: m.save("q.glb"), sp.WriteError, r"export\(\) writes .glb"),
        (lambda m: sp.write("q.GLB", V, F), sp.WriteError, r"export\(\) of sphparam.map"),
    ],
)
def test_a_slip_is_answered_with_what_is_meant(use, error, words, painted, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=words):
        use(painted)
    assert list(tmp_path.iterdir()) == []


def typed(vertices, faces):
    """What a refusal says to type, typed: lists of maps, maps and meshes."""
    mesh = sp.Mesh(vertices, faces)
    lines = [line for line in refusal(mesh, None).split("\n")[1:] if not line.startswith(" ")]
    lines = [re.sub(r" (maps each component|is one closed surface|mends it|keeps ).*", "", line) for line in lines]
    wanted = [line for line in lines if "mesh)" in line or "mesh, " in line]
    names = {"map": lambda *m, **how: sp.map(*m, quality="draft", **how), "sphparam": sp, "mesh": mesh}
    return {line: eval(line, names) for line in wanted}


def ring(around=24, across=12):
    """A torus."""
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u, v = 2 * np.pi * i / around, 2 * np.pi * j / across
    radius = 3 + 1.8 * np.cos(v)
    vertices = np.stack([radius * np.cos(u), radius * np.sin(u), 1.8 * np.sin(v)], axis=-1).reshape(-1, 3)
    at = lambda i, j: (i % around) * across + j % across
    a, b, c, d = (x.ravel() for x in (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def both(first, second):
    return np.concatenate([first[0], second[0] + 20]), np.concatenate([first[1], second[1] + len(first[0])])


@pytest.mark.parametrize(
    "mesh, count",
    [
        (both((V, F), (0.5 * V, F)), 3),
        (both((V, F), ring()), 3),  # whose handle is long
        (both((V, F), (V, F[1:])), 3),
        ((V, F[1:]), 2),
        (hinged(), 3),
        (ring(), 1),
    ],
    ids=["two", "a ring", "an open one", "open", "hinged", "ring"],
)
def test_what_a_refusal_says_to_type_works(mesh, count):
    made = typed(*mesh)
    assert len(made) == count
    for line, found in made.items():
        assert ("components" in line) == isinstance(found, list) and found
        if line.startswith("sphparam.wrap"):
            assert sp.inspect(found).is_sphere


def test_what_cannot_be_mended_is_not_said_to_be():
    band = np.array([[2, 0, -1], [2, 0, 1], [-1, 1.7, -0.5], [-1, 1.7, 0.5], [-1, -1.7, 0.5], [-1, -1.7, -0.5]])
    faces = np.array([[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4], [4, 5, 1], [5, 0, 1]])
    text = refusal(band, faces)
    assert "repair cannot mend it" in text and "keep_holes" not in text
    assert list(typed(band, faces)) == ["sphparam.wrap(mesh).mesh"]
    several = refusal(*both((V, F), (0.3 * band, faces)))
    assert "components(" not in several and "component=1" in several
    band[3, 1] = np.nan
    assert "wrap" not in refusal(band, faces)  # it takes places alone


def test_pieces_that_errors_keep_apart_are_sent_to_a_weld():
    pieces, faces = soup()
    shaken = pieces + np.random.default_rng(3).uniform(-1e-5, 1e-5, pieces.shape)
    [line] = [line for line in refusal(shaken, faces).split("\n") if "weld_share" in line and "keep_holes" not in line]
    assert re.fullmatch(r"map\(mesh, repair=dict\(weld_share=[\d.e-]+\)\) mends it:", line)
    [made] = [made for line, made in typed(shaken, faces).items() if "keep_holes" not in line]
    assert len(made.vertices) == len(V)


def test_files_are_refused_with_what_to_type_here(tmp_path):
    sp.write(tmp_path / "a.off", V, F)
    text = (tmp_path / "a.off").read_text().split("\n")
    (tmp_path / "nan.off").write_text("\n".join([*text[:2], "nan 0 0", *text[3:]]))
    (tmp_path / "twice.off").write_text("\n".join([*text[:-2], "3 5 5 6", ""]))
    for name, option in (("nan", "non_finite"), ("twice", "repeated_corners")):
        with pytest.raises(sp.ReadError, match=rf"read\(path, {option}=True\) takes the file") as caught:
            sp.read(tmp_path / f"{name}.off")
        assert "sphparam map" not in str(caught.value)
        assert sp.map(sp.read(tmp_path / f"{name}.off", **{option: True}), repair=True).certificate.one_to_one


def test_a_mesh_without_area_has_no_shape():
    with pytest.raises(ValueError, match="no area"):
        sp.map(V * [1, 0, 0], F)
    with pytest.raises(ValueError, match="no area"):
        sp.map(V * 0, F, repair=True)
    assert sp.map(V * 1e-150, F).certificate.one_to_one


def test_what_a_file_says_falsely_of_its_map_is_told(tmp_path):
    path = tmp_path / "a.sph.ply"
    sp.map(V, F).save(path)
    right = path.read_bytes()
    proof, messages = told(lambda: sp.verify(path))
    assert proof.one_to_one and messages == []
    path.write_bytes(right.replace(b"verdict one-to-one", b"verdict folded \xff"))
    proof, messages = told(lambda: sp.verify(path))
    assert proof.one_to_one and len(messages) == 1 and "it is one-to-one" in messages[0]
    swapped = right.replace(b"double theta", b"double other").replace(b"double phi", b"double theta")
    path.write_bytes(swapped.replace(b"double other", b"double phi"))
    proof, messages = told(lambda: sp.verify(path))
    assert not proof.one_to_one and proof.verdict.startswith("theta and phi off ") and len(proof.folded) == 0
    assert len(messages) == 1 and "are not those of sx sy sz" in messages[0]
    vertices, faces = octahedron()
    sp.write(tmp_path / "beside.off", vertices + (0.2, 0, 0), faces)
    proof, messages = told(lambda: sp.verify(tmp_path / "beside.off"))
    assert proof.one_to_one and len(messages) == 1 and "not on a sphere about the origin" in messages[0]


def bent():
    """Of a potato whose top leans over, as seen from its middle."""
    vertices, faces = potato(3)
    x, y, z = vertices.T
    return np.stack([x + 2.5 * np.maximum(z, 0) ** 2, y, z - 1.2 * np.maximum(z - 0.3, 0)], 1), faces


def test_radial_maps_of_what_is_not_star_shaped_are_told():
    made, told_of_map = told(lambda: sp.map(*bent(), method="radial"))
    assert made.radial.folds > 0 and told_of_map == made.warnings
    [line] = [line for line in told_of_map if line.startswith("not star-shaped about (0, 0, 0): ")]
    assert f"{made.radial.folds} triangles fold" in line
    for bake in (
        lambda: made.bake("radius", size=32, body="1"),
        lambda: made.bake("radius", size=32, convention="gis"),
        lambda: made.paint(np.zeros((16, 32, 3), np.uint8), convention="gis"),
    ):
        [line] = told(bake)[1]
        assert line.startswith("the map's longitudes and latitudes are ") and "of the body (RMS over the surface)" in line
    assert told(lambda: made.bake("radius", size=32))[1] == []
    aligned = sp.map(V, F, align="body")
    [line] = told(lambda: aligned.bake("lat", size=32, body="1"))[1]
    assert 'map(mesh, method="radial") has the body\'s, align="body" comes near' in line
    assert told(lambda: sp.map(V, F, method="radial"))[1] == []
    assert told(lambda: sp.map(V, F, method="radial").bake("lat", size=32, body="1"))[1] == []


def test_a_centre_outside_and_another_unit_are_told(tmp_path):
    _, [line] = told(lambda: sp.map(V, F, align="body", centre=(0, 0, 9)))
    assert line.startswith('the centre 0,0,9 lies outside of the surface: centre="centroid" is ')
    body = sp.map(V, F, method="radial")
    for bake in (
        lambda: body.bake("lat", size=32, body="Moon", unit="km"),
        lambda: body.bake_files({"lat": tmp_path / "a.tif"}, size=32, body="Moon", unit="km"),
    ):
        [line] = told(bake)[1]
        assert line.endswith("the radius of the body is 1.74e+06 m: the mesh is in another unit (unit=)")
    lines = told(lambda: body.bake("radius", size=32, body="1", centre=(0, 0, 9)))[1]
    assert any(line.startswith("the centre 0,0,9 lies outside of the surface") for line in lines)


def test_numbers_of_images_come_back(painted):
    rows, columns = np.indices((64, 128)).astype(float)
    theta, phi = painted.theta, painted.phi
    inside = (phi > np.pi / 64) & (phi < np.pi * 63 / 64)
    found = painted.sample(rows)
    assert found.shape == (len(V),) and np.allclose(found[inside], (phi / np.pi * 64 - 0.5)[inside], atol=1e-11)
    for convention, turns, offset in (("sphparam", 1, 0), ("gis", 1, 0.5), ("three", 1, 0.5), ("envmap", -1, 0.25), ("blender", -1, 0.5)):
        u = (turns * theta / (2 * np.pi) + offset) % 1
        between = (u > 1 / 128) & (u < 127 / 128) & inside
        found = painted.sample(np.stack([columns, rows], -1), convention=convention)
        assert np.allclose(found[between, 0], (u * 128 - 0.5)[between], atol=1e-10)
        found = painted.sample(columns, convention=convention, nearest=True)
        assert (found == np.floor(u * 128) % 128)[between].all()
    middles = painted.points[F].sum(axis=1)
    latitude = painted.sample(np.pi / 2 - np.pi * (rows + 0.5) / 64, at="faces")
    exact = np.arcsin(middles[:, 2] / np.linalg.norm(middles, axis=1))
    assert latitude.shape == (len(F),) and np.abs(latitude - exact).max() < np.pi / 128
    baked = painted.bake("scalar:height", size=512, body="1")
    assert np.abs(painted.sample(baked)[:, 0] - V[:, 2]).max() < 0.03
    with pytest.raises(ValueError, match="baked with convention='gis'"):
        painted.sample(baked, convention="three")
    with pytest.raises(ValueError, match="a part of a baked image"):
        painted.sample(baked[::2, ::2])
    with pytest.raises(ValueError, match="twice as wide as high"):
        painted.sample(rows[:, :64, None])
    with pytest.raises(ValueError, match="at: "):
        painted.sample(rows, at="corners")


def test_pictures_of_what_was_baked_are_colours(painted):
    assert told(lambda: painted.paint(painted.bake("scalar:height", size=64)))[1] == []


def test_coefficients_without_room_are_told(painted, tmp_path):
    _, [line] = told(lambda: painted.spharm(2, values=["height"]).save(tmp_path / "a.coef"))
    assert line.endswith("a.coef: a .coef has x, y and z alone: height left out, which .json and .csv have")
    assert told(lambda: painted.spharm(2).save(tmp_path / "b.coef"))[1] == []


@pytest.mark.parametrize("exact", [False, True])
def test_seams_that_rounding_tears_are_joined(exact):
    latitude, longitude = np.meshgrid(np.linspace(90, -90, 13), np.linspace(0, 360, 25), indexing="ij")
    b, a = np.radians(latitude), np.radians(longitude)
    r = 1 + 0.2 * np.cos(2 * a) * np.cos(b) ** 2
    vertices = np.stack([r * np.cos(b) * np.cos(a), r * np.cos(b) * np.sin(a), r * np.sin(b)], -1).reshape(-1, 3)
    if exact:
        vertices[6 * 25 + 24] = vertices[6 * 25]  # of some copies
    p = (np.arange(12)[:, None] * 25 + np.arange(24)).ravel()
    faces = np.concatenate([np.stack([p, p + 25, p + 26], 1), np.stack([p, p + 26, p + 1], 1)])
    made, lines = told(lambda: sp.map(vertices, faces, method="radial", repair=True))
    assert len(made.vertices) == 24 * 11 + 2 and len(made.faces) == 2 * (24 * 11)
    assert made.radial.folds == 0 and made.radial.moved == 0 and lines == []
