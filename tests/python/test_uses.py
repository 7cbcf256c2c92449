"""What maps are good for: each use against a law or against what the program writes."""

import base64
import json
import os
import re
import subprocess
import warnings

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato, sphere, torus

V, F = potato(4)


@pytest.fixture(scope="module")
def mapped():
    label = (V[:, 2] > 0).astype(np.int32) + 2 * (V[:, 0] > 0)
    colour = (127 + 120 * V / np.abs(V).max()).astype(np.uint8)
    return sp.map(V, F, values={"height": V[:, 2], "label": label, "color": colour})


def program(*arguments, cwd):
    subprocess.run([os.environ["SPHPARAM_PROGRAM"], *arguments], check=True, cwd=cwd, capture_output=True)


# Objects of other packages, by their attributes.


class Trimesh:
    vertices, faces = V, F
    vertex_attributes = {"sulc": V[:, 0].astype(np.float32)}

    class visual:
        kind, vertex_colors = "vertex", np.full((len(V), 4), 200, np.uint8)


class PyVista:
    points = V.astype(np.float32)
    faces = np.c_[np.full(len(F), 3), F].ravel()
    point_data = {"sulc": V[:, 0], "Normals": V, "name": np.array(["x"] * len(V))}


class Meshio:
    points, cells_dict = V, {"triangle": F.astype(np.uint64), "line": F[:, :2]}
    point_data = {"area share": V[:, 1]}


class Gifti:
    def agg_data(self, intent):
        return {"pointset": V.astype(np.float32), "triangle": F.astype(np.int32)}[intent]


class Open3D:
    vertices, triangles, vertex_colors = V.tolist(), F.astype(np.int32).tolist(), np.zeros((len(V), 3))

    def has_vertex_colors(self):
        return True


@pytest.mark.parametrize(
    "mesh, values",
    [
        (Trimesh(), {"sulc", "color"}),
        (PyVista(), {"sulc", "normal"}),
        (Meshio(), {"area_share"}),
        (Gifti(), set()),
        (Open3D(), {"color"}),
        ((V, F.astype(">i4")), set()),
        ([V, F], set()),
    ],
    ids=["trimesh", "pyvista", "meshio", "nibabel", "open3d", "a pair", "a list of two"],
)
def test_meshes_of_other_packages_are_known_by_their_attributes(mesh, values):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", sp.LossWarning)
        made = sp.map(mesh)
    single = made.vertices.dtype == float and (made.vertices == V.astype(np.float32)).all()
    assert (made.vertices == V).all() or single
    assert (made.faces == F).all() and set(made.values) == values


def test_what_is_not_carried_is_told():
    with pytest.warns(sp.LossWarning, match="name.*numbers are needed"):
        sp.map(PyVista())


@pytest.mark.filterwarnings("error")
def test_what_a_surface_has_besides_is_told_once_for_all_images(mapped, tmp_path):
    paths = {"scalar:sulc": tmp_path / "s.tif", "normal-object": tmp_path / "n.tif", "position": tmp_path / "p.tif"}
    with pytest.warns(sp.LossWarning, match="name.*numbers are needed") as told:
        mapped.bake_files(paths, size=64, surface=PyVista())
    assert len(told) == 1
    with pytest.warns(sp.LossWarning, match="name.*numbers are needed") as told:
        mapped.bake("scalar:sulc", size=64, surface=PyVista())
    assert len(told) == 1


# Values.


def test_values_come_back_as_they_were(mapped):
    assert mapped.values["height"].dtype == float and (mapped.values["height"] == V[:, 2]).all()
    assert mapped.values["label"].dtype == np.int32 and mapped.values["color"].dtype == np.uint8
    assert mapped.values["color"].shape == (len(V), 3)


@pytest.mark.parametrize("kind", ["i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8"])
def test_every_type_of_a_value_is_kept(kind, tmp_path):
    vertices, faces = octahedron()
    given = np.arange(12, dtype=kind).reshape(6, 2)
    sp.map(vertices, faces, values={"pair": given}).save(tmp_path / "a.sph.ply")
    found = sp.load(tmp_path / "a.sph.ply").values["pair"]
    assert found.dtype == np.dtype(kind) and (found == given).all()


def test_more_values_than_ten_stay_in_their_order():
    vertices, faces = octahedron()
    many = np.arange(72, dtype=float).reshape(6, 12)
    assert (sp.map(vertices, faces, values={"many": many}).values["many"] == many).all()


# Directions.


def test_vertices_are_located_where_they_are(mapped):
    face, weights = mapped.locate(mapped.points)
    corner = weights.argmax(axis=1)
    assert (weights.max(axis=1) == 1).all() and (weights.sum(axis=1) == 1).all()
    assert (mapped.faces[face, corner] == np.arange(len(V))).all()


def test_located_points_have_the_direction_that_was_asked_for(mapped):
    directions = np.random.default_rng(1).normal(size=(500, 3))
    face, weights = mapped.locate(directions)
    found = (mapped.points[mapped.faces[face]] * weights[..., None]).sum(axis=1)
    unit = [a / np.linalg.norm(a, axis=1, keepdims=True) for a in (found, directions)]
    assert np.allclose(unit[0], unit[1], atol=1e-12)


def test_values_at_the_vertices_are_the_values(mapped):
    for values in (V, V[:, 0], V[:, 0].astype(np.float32), np.arange(len(V)), V[:, 0] > 0):
        found = mapped.resample(values, mapped.points)
        assert found.dtype == values.dtype and (found == values).all()
    assert (mapped.resample("vertices", mapped.points) == V).all()


def test_labels_are_never_mixed(mapped):
    directions = np.random.default_rng(2).normal(size=(2000, 3))
    labels = mapped.values["label"]
    assert set(mapped.resample("label", directions)) <= set(labels)
    face, weights = mapped.locate(directions)
    corners = labels[mapped.faces[face]]
    for row, share, found in zip(corners, weights, mapped.resample("label", directions)):
        votes = {label: share[row == label].sum() for label in row}
        assert votes[found] == max(votes.values())


def test_nan_stays_where_it_has_weight(mapped):
    values = V[:, 0].copy()
    values[7] = np.nan
    found = mapped.resample(values, mapped.points)
    assert np.isnan(found[7]) and np.isfinite(np.delete(found, 7)).all()


# Charts.


def test_a_chart_covers_the_rectangle_once(mapped):
    chart = mapped.chart()
    assert chart.one_to_one
    assert (chart.uv >= 0).all() and (chart.uv <= 1).all() and len(chart.wedge_vertices) == len(chart.uv)
    assert (chart.vertices[: len(V)] == V).all()  # but for those that were moved to a pole
    area = np.linalg.norm(np.cross(*(chart.vertices[chart.faces[:, k]] - chart.vertices[chart.faces[:, 0]] for k in (1, 2))), axis=1)
    source = np.linalg.norm(np.cross(*(V[F[:, k]] - V[F[:, 0]] for k in (1, 2))), axis=1)
    assert area.sum() == pytest.approx(source.sum())
    assert not mapped.chart(keep_topology=True).one_to_one


# Images.


def test_normals_are_unit_and_point_outwards(mapped):
    image = mapped.bake("normal-object", size=128)
    assert image.shape == (64, 128, 3) and image.dtype == np.float32 and image.field == "normal-object"
    assert np.allclose(np.linalg.norm(image, axis=2), 1, atol=1e-3)
    position = mapped.bake("position", size=128)
    assert ((np.asarray(image) * np.asarray(position)).sum(axis=2) > 0).mean() > 0.95


def test_texels_are_the_points_that_locate_finds():
    coarse = sp.map(*potato(2))  # a texel that holds several triangles has their mean
    width, height = 512, 256
    image = coarse.bake("position", size=width, interpolation="sphere")
    t, p = np.meshgrid(2 * np.pi * (np.arange(width) + 0.5) / width, np.pi * (np.arange(height) + 0.5) / height)
    directions = np.stack([np.cos(t) * np.sin(p), np.sin(t) * np.sin(p), np.cos(p)], -1).reshape(-1, 3)
    apart = np.abs(np.asarray(image).reshape(-1, 3) - coarse.resample("vertices", directions)).max(axis=1)
    assert (apart < 1e-5).mean() > 0.8 and apart.max() < 0.05


def test_longitude_goes_where_the_convention_has_it(mapped):
    ours, gis = (mapped.bake("position", size=64, convention=c) for c in ("sphparam", "gis"))
    assert (np.roll(ours, 32, axis=1) == gis).all() or (np.roll(ours, -32, axis=1) == gis).all()


def test_another_surface_is_baked_where_it_is_near(mapped):
    vertices, faces = mapped.vertices, mapped.faces
    other = sp.Mesh(1.02 * vertices, faces[::-1])
    here, there = (mapped.bake("position", size=64, **options) for options in ({}, {"surface": other}))
    assert np.abs(there - 1.02 * here).max() < 0.2 * np.ptp(vertices)
    assert np.abs(there - 1.02 * here).mean() < 0.02 * np.ptp(vertices)
    assert (mapped.bake("found", size=64, surface=other) <= 2).all()
    with pytest.raises(ValueError, match="^area: "):
        mapped.bake("area", size=64, surface=other)


def test_files_are_those_that_the_program_bakes(mapped, tmp_path):
    mapped.save(tmp_path / "a.sph.ply")
    [file] = sp.load(tmp_path / "a.sph.ply").bake_files({"normal-object": tmp_path / "n.png"}, size=64)
    program("bake", "a.sph.ply", "--map", "normal-object", "--size", "64", "-o", "m.png", cwd=tmp_path)
    assert (tmp_path / "n.png").read_bytes() == (tmp_path / "m.png").read_bytes()
    assert file.sample_type == "uint8" and file.channels == 3


def test_images_know_what_they_show(mapped):
    image = mapped.bake("curvature:mean", size=32)
    assert image[:, :, 0].field == "curvature:mean" and "curvature" in repr(image.field)
    picture = image.picture()
    assert picture.shape == (16, 32, 3) and picture.min() == 0 and picture.max() == 255
    assert (mapped.bake("normal-object", size=32).picture() >= 0).all()


def test_a_colour_painted_on_everything_is_that_colour(mapped):
    image = np.full((16, 32, 3), (10, 100, 200), np.uint8)
    assert (mapped.paint(image) == (10, 100, 200)).all()
    assert (mapped.paint(image.astype(float) / 255) == (10, 100, 200)).all()


def test_a_texture_is_painted_for_the_meshs_own_coordinates(tmp_path):
    made = sp.map(V, F, values={"uv": (V[:, :2] - V[:, :2].min()) / np.ptp(V[:, :2])})
    with pytest.warns(sp.LossWarning, match="overlap|inside more than one"):  # front and back lie on each other
        skin = made.paint_texture(np.full((16, 32, 3), (10, 100, 200), np.uint8), size=32, padding=2)
    assert skin.shape == (32, 32, 4) and (skin[16, 16] == (10, 100, 200, 255)).all()


# Hard edges.


def box():
    vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return vertices, np.array([[q[0], *q[k : k + 2]] for q in quads for k in (1, 2)])


def test_a_box_has_hard_edges_where_they_are_asked_for(tmp_path):
    smooth = sp.Mesh(*box(), values={"a": np.arange(8.0)})
    hard = smooth.creased(30)
    assert smooth.corner_normals is None and hard.corner_normals.shape == (12, 3, 3)
    corners = hard.vertices[hard.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (hard.corner_normals == normals[:, None]).all() and (hard.values["a"] == np.arange(8)).all()
    assert smooth.creased(91).corner_normals is None  # no edge turns by more
    image = np.asarray(sp.map(hard).bake("normal-object", size=32))
    assert (np.abs(image).max(axis=2) == 1).all()
    assert np.abs(np.asarray(sp.map(smooth).bake("normal-object", size=32))).max(axis=2).min() < 0.7
    sp.write(tmp_path / "a.obj", *box())
    sp.map(sp.read(tmp_path / "a.obj").creased(30)).export(tmp_path / "ours.ply", image_size=64)
    program("export", "a.obj", "--crease", "30", "--image-size", "64", "-o", "theirs.ply", cwd=tmp_path)
    assert (tmp_path / "ours.ply").read_bytes().replace(b"ours_", b"theirs_") == (tmp_path / "theirs.ply").read_bytes()


def test_a_map_that_is_there_gets_hard_edges(tmp_path):
    smooth = sp.map(*box(), values={"a": np.arange(8.0)})
    smooth.save(tmp_path / "a.sph.ply")
    for made in (smooth, sp.load(tmp_path / "a.sph.ply")):
        hard = made.creased(30)
        assert (hard.points == made.points).all() and hard.certificate.one_to_one and hard.provenance == made.provenance
        assert (hard.mesh.corner_normals == sp.Mesh(*box()).creased(30).corner_normals).all()
        assert (hard.values["a"] == np.arange(8)).all() and hard.poles == made.poles and hard.name == made.name
        with pytest.warns(sp.LossWarning, match="has normals of its own"):
            assert hard.creased(30) is hard
    assert smooth.mesh.corner_normals is None
    with pytest.raises(TypeError, match="degrees: a number"):
        smooth.creased("much")
    with pytest.raises(ValueError, match="degrees: 0 to 180 degrees are needed, not 181"):
        smooth.creased(181)
    quads = smooth.remesh("cube:4")
    assert [list(p) for p in quads.creased(20).polygons] == [list(p) for p in quads.polygons]


def test_normals_of_a_meshs_own_say_what_is_hard():
    hard = sp.Mesh(*box()).creased(30)
    with pytest.warns(sp.LossWarning, match="has normals of its own") as told:
        assert hard.creased(120) is hard
    assert len(told) == 1 and told[0].filename == __file__
    for degrees in (-1, 181, np.nan):
        with pytest.raises(ValueError, match="0 to 180"):
            sp.Mesh(*box()).creased(degrees)
    with pytest.raises(TypeError, match="degrees: a number"):
        sp.Mesh(*box()).creased("much")


# Grids.


@pytest.mark.parametrize("grid", ["ico:3", "octa:33", "cube:8", "uv:32x16", "healpix:8"])
def test_a_mesh_on_a_grid_has_the_grids_directions(mapped, grid):
    low = mapped.remesh(grid)
    assert low.certificate.one_to_one and set(low.values) >= {"height", "label", "color"}
    assert np.allclose(low.vertices, mapped.resample("vertices", low.points), atol=1e-12)
    assert set(low.values["label"]) <= set(mapped.values["label"])
    quads = low.polygons is not None and {len(p) for p in low.polygons} != {3}
    assert quads == (grid[:2] in ("cu", "uv", "he"))


def test_colours_by_their_name_are_no_labels(mapped):
    low = mapped.remesh("ico:2")
    there = mapped.resample("color", low.points)
    assert there.dtype == np.uint8 and there.shape == low.values["color"].shape
    assert np.abs(there.astype(int) - low.values["color"].astype(int)).max() <= 1
    assert (mapped.resample(mapped.values["label"], low.points) == low.values["label"]).all()


def test_the_grid_of_another_map_gives_its_connectivity(mapped):
    other = sp.with_sphere(sphere(3), sphere(3)[0])
    low = mapped.remesh(other)
    assert (low.faces == other.faces).all() and (low.points == other.points).all()
    assert set(mapped.remesh("ico:1", transfer=["label"]).values) == {"label"}


def test_samples_are_those_that_have_names(mapped):
    made = {mode: mapped.remesh("ico:2", sample=mode) for mode in ("point", "cell", "barycentric", "adap-bary-area")}
    heights = [low.values["height"] for low in made.values()]
    assert all(low.certificate.one_to_one for low in made.values())
    assert (made["barycentric"].vertices == made["point"].vertices).all()
    assert np.abs(heights[3] - heights[0]).max() > 1e-6 and np.allclose(heights[2], heights[0], atol=0.05)


def test_more_vertices_go_where_it_bends(mapped):
    assert mapped.remesh("ico:3", adaptive=True).certificate.one_to_one


def test_what_is_enclosed_has_a_centroid_moments_and_axes():
    # An octahedron with corners 1, 2, 3 from its centre: V = 8, ∫ x² = V a²/10.
    corners = np.array([[1, 0, 0], [-1, 0, 0], [0, 2, 0], [0, -2, 0], [0, 0, 3], [0, 0, -3.0]])
    faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    body = sp.inspect(corners + [10, 20, 30], faces).body
    assert body.centroid == pytest.approx((10, 20, 30), abs=1e-13)
    assert np.allclose(body.inertia, np.diag([10.4, 8, 4]), rtol=0, atol=1e-13)
    assert body.principal_moments == pytest.approx((4, 8, 10.4), abs=1e-13)
    assert np.allclose(body.principal_axes, [[0, 0, 1], [0, 1, 0], [-1, 0, 0]], rtol=0, atol=1e-13)
    assert sp.inspect(corners, faces[1:]).body is None
    assert sp.inspect(corners, np.concatenate([faces, [[0, 1, 9]]])).body is None


def test_levels_have_about_a_quarter_each(mapped):
    counts = [len(level.faces) for level in mapped.levels(2)]
    assert len(counts) == 2 and 0.2 * len(F) < counts[0] < 0.3 * len(F) and 0.2 * counts[0] < counts[1] < 0.4 * counts[0]


@pytest.mark.parametrize("scheme, grid", [("loop", "ico:2"), ("catmark", "cube:4")])
def test_a_fitted_surface_is_near_the_mesh(mapped, scheme, grid, tmp_path):
    fit = mapped.fit(grid, scheme=scheme)
    assert fit.rms <= fit.max and fit.two_sided_rms < 0.1
    assert fit.limit_vertices().shape == fit.control.vertices.shape
    vertices, faces = fit.fine_mesh(2000)
    assert len(faces) >= 2000 and sp.inspect(vertices, faces).is_sphere
    lack = fit.displace(tmp_path / "d.png", size=(64, 32), rebuilt=tmp_path / "r.ply")
    assert lack.least < 0 < lack.greatest and lack.rebuilt_rms < lack.base_rms
    assert sp.verify(tmp_path / "r.ply").one_to_one
    assert lack.size == (64, 32) and lack.levels is None and lack.midlevel > 0


def test_a_control_mesh_and_its_image_are_in_the_layout_of_the_grid(mapped, tmp_path):
    fit = mapped.fit("cube:4", scheme="catmark")
    lack = fit.displace(tmp_path / "d.exr", size=(256, 128), layout="grid", rebuilt=tmp_path / "r.ply")
    assert lack.size == (3 * (4 * 16 + 9), 2 * (4 * 16 + 9)) and lack.levels == 4
    assert (lack.scale, lack.midlevel) == (1, 0) and lack.rebuilt_rms < lack.base_rms
    control = fit.textured_control(size=(256, 128))
    assert (control.vertices == fit.control.vertices).all()
    control.save(tmp_path / "control.obj")
    text = (tmp_path / "control.obj").read_text()
    assert "# texture coordinates: the layout of cube:4, 3x2 tiles in 219x146 texels" in text
    assert sum(line.startswith("f ") and line.count("/") == 8 for line in text.splitlines()) == 6 * 16
    with pytest.raises(ValueError, match="layout"):
        mapped.fit("healpix:2", scheme="catmark").displace(tmp_path / "e.exr", layout="grid")
    with pytest.raises(ValueError, match="among"):
        fit.displace(tmp_path / "e.exr", layout="sideways")


def test_a_mesh_on_a_grid_has_the_texture_coordinates_of_the_grid(mapped, tmp_path):
    mapped.remesh("octa:9", uv="grid").save(tmp_path / "a.obj")
    assert "vt " in (tmp_path / "a.obj").read_text()
    with pytest.raises(ValueError, match="uv"):
        mapped.remesh("healpix:2", uv="grid")


# Files.


def test_a_map_is_read_as_it_was_written(mapped, tmp_path):
    mapped.save(tmp_path / "a.sph.ply")
    again = sp.load(tmp_path / "a.sph.ply")
    assert (again.points == mapped.points).all() and again.provenance == mapped.provenance
    assert sp.read(tmp_path / "a.sph.ply").has_map and set(again.values) == set(mapped.values)
    assert again.stages == () and mapped.stages


@pytest.mark.parametrize("ending", ["ply", "obj", "off", "gii", "ply.gz"])
def test_meshes_are_written_and_read(ending, tmp_path):
    path = tmp_path / f"a.{ending.removesuffix('.gz')}"
    sp.write(path, V, F)
    if ending.endswith("gz"):
        subprocess.run(["gzip", path], check=True)
        path = tmp_path / f"a.{ending}"
    read = sp.read(path)
    assert (read.faces == F).all() and np.allclose(read.vertices, V, atol=1e-6)
    assert read.path == str(path) and read.format


def test_spheres_are_written_for_others(mapped, tmp_path):
    sp.write(tmp_path / "a.ply", V, F)
    for name in ("s.gii", "s.ply", "s.obj"):
        mapped.save_sphere(tmp_path / name)
        assert sp.verify(tmp_path / "a.ply", points=tmp_path / name).one_to_one
    again = sp.load(tmp_path / "a.ply", tmp_path / "s.ply")
    assert np.allclose(again.points, mapped.points, atol=1e-14)


@pytest.mark.parametrize("name", ["a.glb", "a.gltf", "a.obj", "a.ply"])
def test_an_asset_carries_the_image(mapped, name, tmp_path):
    image = mapped.bake("normal-object", size=64)
    files = mapped.export(tmp_path / name, texture=image)
    assert sorted(os.listdir(tmp_path)) == sorted(os.path.basename(f) for f in files)
    assert sp.read(tmp_path / name).vertices.shape[1] == 3


def test_the_asset_is_the_programs(mapped, tmp_path):
    mapped.save(tmp_path / "a.sph.ply")
    sp.load(tmp_path / "a.sph.ply").export(tmp_path / "ours.glb", variants=["checker"], morph="sphere", name="a.sph")
    program("export", "a.sph.ply", "-o", "a.glb", "--variants", "checker", "--morph", "sphere", cwd=tmp_path)
    assert (tmp_path / "ours.glb").read_bytes() == (tmp_path / "a.glb").read_bytes()


def test_images_of_an_asset_are_what_was_asked_for(mapped, tmp_path):
    image = mapped.bake("normal-object", size=64)
    files = mapped.export(tmp_path / "a.gltf", texture=image, textures="webp-lossless")
    assert [os.path.basename(f) for f in files] == ["a.gltf", "a.bin", "a_basecolor.webp"]
    with pytest.raises(ValueError, match="webp_quality"):
        mapped.export(tmp_path / "b.glb", textures="webp", webp_quality=0)
    with pytest.raises(ValueError, match="webp-lossless"):
        mapped.export(tmp_path / "b.glb", textures="wepb")


# Figures.


def test_a_surface_is_no_distance_from_itself(mapped):
    assert sp.measure(mapped, (V, F), samples=2000).max == 0
    farther = sp.measure((V, F), (1.1 * V, F), samples=2000)
    assert 0 < farther.rms < farther.max <= farther.max_bound and farther.forth.samples > 0


def test_what_lies_over_holes_is_left_out():
    found = sp.measure((0.9 * V, F), (V, F[: len(F) // 2]), samples=2000, leave_out_border=True)
    marks = found.forth.left_out_vertices
    assert 0 < found.forth.left_out < 1 and found.back.left_out == 0 and not found.back.left_out_vertices.any()
    assert marks.shape == (len(V),) and marks.any() and found.forth.at_vertices[~marks].max() <= found.forth.max
    assert found.forth.max_bound == np.inf and sp.measure((V, F), (V, F), samples=100).forth.left_out is None


def test_meshes_far_apart_or_in_two_units_are_asked_about():
    with pytest.warns(sp.LossWarning, match='farther than either is large.*align="rigid" first puts the second'):
        sp.measure((V, F), (V + 1e6, F), samples=100)
    with pytest.warns(sp.LossWarning, match="first is 1000 times smaller than second, .* mm and m"):
        sp.measure((V, F), (1000 * V, F), samples=100)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sp.measure((V, F), (V + 1e6, F), samples=100, align="rigid")
        sp.measure((V, F), (V + 0.01, F), samples=100)


def test_the_distance_of_every_vertex_and_its_side(mapped):
    larger = 1.1 * V
    inside = sp.measure(mapped, (larger, F), samples=2000, signed=True)
    assert inside.back.deviation is None and inside.back.at_vertices.shape == (len(V),)
    side = inside.forth.deviation
    assert (side.at_vertices == -inside.forth.at_vertices).all() and (side.at_vertices < 0).all()
    assert (side.min, side.max, side.mean) == (-inside.forth.max, -inside.forth.min, -inside.forth.mean)
    assert side.sd == inside.forth.sd and inside.forth.median < inside.forth.p95 < inside.forth.p99 < inside.forth.max
    assert inside.p95 == max(inside.forth.p95, inside.back.p95) and inside.forth.within is None
    assert sp.measure(mapped, (larger, F), samples=2000, within=inside.forth.p95).forth.within == 0.95
    outside = sp.measure((larger, F), mapped, samples=2000, signed=True).forth
    assert (outside.deviation.at_vertices == outside.at_vertices).all()
    assert (inside.back.at_vertices == outside.at_vertices).all()
    assert sp.measure(mapped, (larger, F), samples=2000).forth.deviation is None
    alone = sp.measure(mapped, (larger, F), samples=2000, signed=True, extremes=False).forth
    assert alone.at_vertices is None and alone.deviation.at_vertices is None and alone.deviation.mean == side.mean
    assert sp.measure((V, F[1:]), mapped, samples=100, signed=True).forth.deviation.mean == 0
    with pytest.raises(ValueError, match="second: it is not closed, so nothing is inside: 3 edges are open"):
        sp.measure(mapped, (V, F[1:]), samples=100, signed=True)


def test_fillers_of_holes_that_were_kept_tell_what_is_inside():
    opened = sp.map(1.1 * V, F[1:], repair=dict(keep_holes=True))
    found = sp.measure((V, F), opened, samples=2000, signed=True).forth
    assert found.deviation.max < 0 and found.deviation.mean == -found.mean
    assert found.rms == sp.measure((V, F), (1.1 * V, F[1:]), samples=2000).forth.rms


def test_a_surface_is_put_onto_another_before_it_is_measured():
    axes = V * [1.5, 1.1, 0.8]
    lump = axes * (1 + 0.4 * np.exp(-8 * ((V / np.linalg.norm(V, axis=1)[:, None] - [0.8, 0.5, 0.33]) ** 2).sum(axis=1)))[:, None]
    turn = np.diag([-1.0, -1, 1])  # half a turn about z, after which all but the lump fits
    moved = 1000 * lump @ turn.T + [10, 0, 0]
    found = sp.measure((lump, F), (moved, F), samples=1000, align="similarity")
    assert found.max < 1e-11 and found.alignment.scale == pytest.approx(0.001, rel=1e-12)
    matrix = found.alignment.matrix
    assert np.allclose(moved @ matrix[:3, :3].T + matrix[:3, 3], lump, rtol=0, atol=1e-11) and (matrix[3] == [0, 0, 0, 1]).all()
    assert found.alignment.start == "principal axes" and found.alignment.kept == 1 and found.alignment.rms < 1e-11
    rigid = sp.measure((lump, F), (moved / 1000, F), samples=1000, align="rigid")
    assert rigid.alignment.scale == 1 and rigid.max < 1e-11
    assert sp.measure((lump, F), (moved, F), samples=1000).alignment is None
    with pytest.raises(ValueError, match="align: 'none', 'rigid' or 'similarity', not 'loosely'"):
        sp.measure((lump, F), (moved, F), align="loosely")


def test_surfaces_are_measured_as_they_stand(tmp_path):
    m = sp.map(V * [1, 2, 3], F)
    m.export(tmp_path / "a.glb")  # y is up there, z in front
    assert sp.measure(m, sp.read(tmp_path / "a.glb"), samples=1000).max > 0.5
    assert sp.measure(m, sp.read(tmp_path / "a.glb"), samples=1000, upright=True).max < 1e-6


def test_the_centroid_is_a_centre_as_on_the_command_line(tmp_path):
    mesh = sp.Mesh(V + [0, 0, 5.0], F)
    mesh.save(tmp_path / "a.ply")
    program("map", "a.ply", "--method", "radial", "--centre", "centroid", "-o", "a.sph.ply", cwd=tmp_path)
    body = sp.map(mesh, method="radial", centre="centroid")
    assert np.array_equal(body.points, sp.load(tmp_path / "a.sph.ply").points)
    centroid = sp.inspect(mesh).body.centroid
    assert body.radial.centre == centroid
    assert body.spharm(2, radius=True, centre="centroid").centre == centroid
    images = [body.bake("radius", size=16, centre=centre) for centre in ("centroid", centroid)]
    assert np.array_equal(*images)
    with pytest.raises(TypeError, match="centre"):
        body.bake("radius", size=16, centre="middle")


def test_colours_of_numbers_are_over_the_range_that_is_asked_for(tmp_path):
    made = sp.map(V, F, values={"height": V[:, 2]})
    whole, part = (made.bake("scalar:height", size=32, heat=True, range=(-ends, ends)) for ends in (2, 1))
    assert not np.array_equal(whole, part)
    made.bake_files({"scalar:height": tmp_path / "h.exr"}, size=32, heat=True, range=(-2, 2), depth="float")
    with pytest.raises(ValueError, match="range: of the colours of scalar:NAME"):
        made.bake("scalar:height", size=32, range=(-2, 2))
    with pytest.raises(ValueError, match="range: of the colours of scalar:NAME"):
        made.bake("radius", size=32, heat=True, range=(-2, 2))


def test_the_radius_as_planetary_science_has_it(tmp_path):
    body = sp.map(V + [0, 0, 5.0], F, method="radial", centre=(0, 0, 5))
    (tmp_path / "body").mkdir()
    body.save(tmp_path / "a.sph.ply")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        shape = body.spharm(6, radius=True)
    assert shape.functions == ["x", "y", "z", "radius"] and shape.centre == (0, 0, 5)
    assert shape.reference_radius == shape.coefficients[0, 3] / np.sqrt(4 * np.pi)
    assert np.allclose(shape.reconstructed[:, 3], np.linalg.norm(V, axis=1), atol=0.2)
    shape.save_shadr(tmp_path / "ours.sha")
    program("spharm", "a.sph.ply", "--degree", "6", "--shadr", "theirs.sha", cwd=tmp_path)
    assert (tmp_path / "ours.sha").read_bytes() == (tmp_path / "theirs.sha").read_bytes()
    assert float((tmp_path / "ours.sha").read_text().split(",")[0]) == shape.reference_radius
    shape.save(tmp_path / "ours.json")
    again = sp.read_harmonics(tmp_path / "ours.json")
    assert again.centre == shape.centre is not None and again.decided_degree is None and shape.decided_degree == shape.degree
    with pytest.warns(sp.LossWarning, match="longitudes of these harmonics are the map's, not the body's: the map's longitudes and latitudes are "):
        elsewhere = body.spharm(2, radius=True, centre=(0, 0, 5.5))
    assert elsewhere.centre == (0, 0, 5.5)
    with pytest.raises(ValueError, match="radius was not expanded"):
        body.spharm(2).reference_radius
    with pytest.raises(ValueError, match="centre: it is that of the radius"):
        body.spharm(2, centre=(0, 0, 5))
    with pytest.raises(ValueError, match="which align turns"):
        body.spharm(2, radius=True, align=True).save_shadr(tmp_path / "b.sha")
    with pytest.raises(sp.WriteError):
        shape.save_shadr(tmp_path / "body")


def test_files_of_strangers_are_read_within_limits(mapped, tmp_path):
    path = tmp_path / "a.sph.ply"
    mapped.save(path)
    count = len(V)
    assert len(sp.read(path, limits={"vertices": count}).vertices) == count
    for use in (sp.read, sp.load, sp.verify):
        with pytest.raises(sp.ReadError, match="1026 records of element .vertex. are over the limit of 1025"):
            use(path, limits={"vertices": count - 1})
        with pytest.raises(sp.ReadError, match=r"limits=dict\(file=N\)"):
            use(path, limits={"file": 1000})
        with pytest.raises(ValueError, match="limits: no 'polygons' among file, vertices, faces"):
            use(path, limits={"polygons": 3})
    with pytest.raises(TypeError, match="limits: a dict is needed, not int"):
        sp.read(path, limits=3)
    with pytest.raises(TypeError, match=r"limits\['faces'\]: a whole number"):
        sp.read(path, limits={"faces": 1e3})
    with pytest.raises(ValueError, match=r"limits\['faces'\]: 1 to"):
        sp.read(path, limits={"faces": 0})


def test_harmonics_are_evaluated_where_the_vertices_are(mapped):
    shape = mapped.spharm(12, values=["height"])
    assert shape.functions == ["x", "y", "z", "height"] and shape.coefficients.shape == (169, 4)
    assert np.allclose(shape(mapped.points), shape.reconstructed, atol=1e-10)
    assert shape.rms < 0.05 * shape.diagonal and shape.degree == 12
    assert list(shape.ellipsoid) == sorted(shape.ellipsoid, reverse=True)


def test_harmonics_are_a_surface_on_any_grid_and_files(mapped, tmp_path):
    shape = mapped.spharm(6, values=["height"])
    low = shape.surface("ico:3", degree=2)
    assert low.certificate.one_to_one and low.vertices.shape == (642, 3)
    other = mapped.spharm(6, values=["height"])
    other.coefficients = shape.coefficients[:9]
    assert np.allclose(np.c_[low.vertices, low.values["height"]], other(low.points), atol=1e-14)
    assert (shape.surface(mapped).points == mapped.points).all()
    assert np.allclose(shape.surface(mapped).vertices, shape.reconstructed[:, :3], atol=1e-12)
    mapped.save(tmp_path / "a.sph.ply")
    program("spharm", "a.sph.ply", "--degree", "6", "--scalar", "height", "--json", "theirs.json", cwd=tmp_path)
    for name, normalisation in (("a.json", "orthonormal"), ("b.json", "4pi"), ("theirs.json", "")):
        if normalisation:
            shape.save(tmp_path / name, normalisation=normalisation)
        again = sp.read_harmonics(tmp_path / name)
        assert again.functions == shape.functions and again.degree == 6 and not again.aligned
        assert np.allclose(again.coefficients, shape.coefficients, rtol=1e-15, atol=0)
        assert again.reconstructed.shape == (0, 4) and np.isnan([again.rms, again.plain_rms, again.diagonal]).all()
    shape.save(tmp_path / "a.coef")
    coef = sp.read_harmonics(tmp_path / "a.coef")
    assert coef.functions == ["x", "y", "z"] and np.allclose(coef.coefficients, shape.coefficients[:, :3], rtol=1e-15, atol=0)
    coef.save(tmp_path / "c.json")
    assert "position_rms" in (tmp_path / "a.json").read_text() and "position_rms" not in (tmp_path / "c.json").read_text()
    program("spharm", "a.json", "--degree", "2", "--grid", "ico:3", "--reconstruct", "low.sph.ply", cwd=tmp_path)
    assert (sp.load(tmp_path / "low.sph.ply").vertices == low.vertices).all()
    assert sp.read_harmonics(tmp_path / "a.json").surface("ico:3", degree=2).vertices == pytest.approx(low.vertices)
    with pytest.raises(ValueError, match="path: coefficients end in .json, .csv or .coef"):
        shape.save(tmp_path / "a.txt")
    with pytest.raises(ValueError, match="normalisation: 'orthonormal' or '4pi'"):
        shape.save(tmp_path / "d.json", normalisation="schmidt")
    with pytest.raises(ValueError, match="degree: 0 to 6"):
        shape.surface("ico:2", degree=7)
    with pytest.raises(ValueError, match="grid"):
        shape.surface("ball")
    with pytest.raises(sp.ReadError, match="no coefficients"):
        sp.read_harmonics(tmp_path / "a.sph.ply")
    whole = shape.coefficients
    shape.coefficients = whole[:, :3]
    with pytest.raises(ValueError, match="coefficients: 4 columns are needed"):
        shape.surface("ico:2")
    shape.coefficients = whole[:5]
    for name in ("few.json", "few.csv", "few.coef"):
        with pytest.raises(ValueError, match="5 coefficients are no"):
            shape.save(tmp_path / name)


def test_distances_are_over_what_is_asked_for(mapped, tmp_path):
    low = mapped.remesh("ico:3")
    mapped.save(tmp_path / "a.ply"), low.save(tmp_path / "b.ply")
    program("measure", "a.ply", "b.ply", "--samples", "500", "--over", "vertices,edges", "--json", "d.json", cwd=tmp_path)
    theirs = json.loads((tmp_path / "d.json").read_text())["first_to_second"]
    ours = sp.measure(mapped, low, samples=500, over=["vertices", "edges"]).forth
    assert (ours.rms, ours.mean, ours.samples) == (theirs["RMS"], theirs["mean"], theirs["n_samples"])
    assert sp.measure(mapped, low, samples=500, over="vertices").forth.samples == len(V)
    for wrong in ("corners", (), ["faces", "all"]):
        with pytest.raises(ValueError, match="over: 'faces', 'edges', 'vertices'"):
            sp.measure(mapped, low, over=wrong)
    with pytest.raises(TypeError, match="over"):
        sp.measure(mapped, low, over=3)


def test_growth_is_of_faces_and_of_what_is_about_vertices(mapped):
    faces, vertices = sp.growth(mapped, (2 * mapped.vertices, F))
    assert (faces == 4).all() and faces.shape == (len(F),) and (vertices == 4).all() and vertices.shape == (len(V),)
    with pytest.raises(ValueError, match="same triangles"):
        sp.growth((V, F), (V, F[1:]))


def test_faces_that_cross_are_counted_and_named():
    clean = sp.self_crossings(V, F)
    assert clean.pairs == 0 and clean.first is None and clean.place is None
    assert clean.marks.shape == (len(F),) and not clean.marks.any()
    corner = 4.0 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    sides = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]])
    found = sp.self_crossings(np.vstack([corner, corner + 1]), np.vstack([sides, sides + 4]), threads=1)
    assert found.pairs == 3 and found.first == (3, 4) and found.place == (2.5, 2.5, 1)
    assert found.marks.tolist() == [False, False, False, True, True, True, True, False]


def bracket():
    """An extruded L of 20 large triangles: 80 × 60 × 25, walls 8 thick."""
    outline = np.array([[0, 0], [80, 0], [80, 8], [8, 8], [8, 60], [0, 60]], float)
    vertices = np.vstack([np.column_stack([outline, np.full(6, z)]) for z in (0, 25)])
    walls = [t for i in range(6) for t in ((i, (i + 1) % 6, (i + 1) % 6 + 6), (i, (i + 1) % 6 + 6, i + 6))]
    ends = [t for i in (0, 1, 4, 5) for t in ((3, (i + 1) % 6, i), (9, i + 6, (i + 1) % 6 + 6))]
    return vertices, np.array(walls + ends)


def test_faces_of_a_remesh_that_cross_are_counted_and_told(mapped):
    assert mapped.in_space is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        clean = mapped.remesh("ico:3").in_space
    assert (clean.triangles, clean.area_share, clean.turned_over, clean.crossings) == (0, 0, 0, 0)
    part = sp.map(*bracket(), weight=sp.remeshing_lambda)
    with pytest.warns(sp.LossWarning, match=r"ico:3: \d+ of 1280 triangles, .*map the mesh with repair=dict\(edge_length=") as told:
        made = part.remesh("ico:3")
    assert made.warnings == [str(told[0].message)]
    found = made.in_space
    assert found.crossings == sp.self_crossings(made).pairs > 0 and found.turned_over > 0 and found.all_looked_at
    assert 0 < found.area_share < 0.05 and found.concave_quads == 0 and found.crossings_of_mesh == 0
    with pytest.warns(sp.LossWarning, match="leave out adaptive=True"):
        part.remesh("ico:3", adaptive=True)
    with pytest.warns(sp.LossWarning, match="47 quads are concave"):
        assert part.remesh("cube:32").in_space.concave_quads == 47


def test_a_mesh_is_written_as_stl(mapped, tmp_path):
    with pytest.warns(sp.LossWarning, match="numbers of vertices"):
        mapped.save(tmp_path / "a.stl")
    read = sp.read(tmp_path / "a.stl")
    assert (read.vertices[read.faces] == V.astype(np.float32)[F]).all()
    with pytest.raises(sp.WriteError, match="vertices have no numbers there"):
        mapped.save_sphere(tmp_path / "b.stl")


def test_levels_in_space_are_counted_and_told(mapped):
    assert [level.in_space.triangles for level in mapped.levels(2)] == [0, 0]
    with pytest.warns(sp.LossWarning):
        fine = sp.map(*bracket(), weight=sp.remeshing_lambda).remesh("ico:4")
    with pytest.warns(sp.LossWarning, match=r"\d+ of \d+ triangles, ") as told:
        (level,) = fine.levels(1)
    assert level.warnings == [str(told[0].message)]
    assert level.in_space.crossings == sp.self_crossings(level).pairs > 0


def test_the_coarsest_grid_that_is_near_enough(mapped):
    near = mapped.remesh("ico", within=0.05)
    assert sp.measure(mapped, near).max <= 0.05
    counts = [10 * 4**level + 2 for level in range(10)]
    coarser = mapped.remesh(f"ico:{counts.index(len(near.vertices)) - 1}")
    assert sp.measure(mapped, coarser).max > 0.05
    with pytest.raises(ValueError, match="within finds the level of grid='ico', and is not for 'ico:3'"):
        mapped.remesh("ico:3", within=0.1)
    with pytest.raises(ValueError, match="within is not for areas, adaptive"):
        mapped.remesh("ico", within=0.1, adaptive=True)
    with pytest.raises(ValueError, match="within: a length, at least 0, not -1"):
        mapped.remesh("ico", within=-1)


def test_areas_of_surfaces_weigh_values(tmp_path):
    mapped = sp.map(V, F, values={"height": V[:, 0] ** 2})
    other = 2 * V * [1, 1, 3]
    options = dict(sample="adap-bary-area")
    own = mapped.remesh("ico:1", **options)
    grid = own.mesh
    given = mapped.remesh("ico:1", areas=(sp.Mesh(other, F), grid), **options)
    assert (given.values["height"] != own.values["height"]).any()
    mapped.save(tmp_path / "a.sph.ply")
    sp.write(tmp_path / "b.ply", other, F)
    grid.save(tmp_path / "c.ply")
    program("remesh", "a.sph.ply", "--grid", "ico:1", "--sample", "adap-bary-area", "--areas", "b.ply,c.ply", "-o", "d.sph.ply", cwd=tmp_path)
    assert (sp.load(tmp_path / "d.sph.ply").values["height"] == given.values["height"]).all()
    ones = mapped.remesh("ico:1", areas=([1] * len(V), np.ones(42)), **options)
    assert (ones.values["height"] != own.values["height"]).any()
    with pytest.raises(ValueError, match=r"areas: 42 are needed, one a vertex of the grid, not 41"):
        mapped.remesh("ico:1", areas=(np.ones(len(V)), np.ones(41)), **options)
    with pytest.raises(ValueError, match='areas: for sample="adap-bary-area" alone'):
        mapped.remesh("ico:1", areas=(np.ones(len(V)), np.ones(42)))


def test_faces_carry_arrays():
    number = np.arange(len(F))
    mesh = sp.Mesh(V, F, face_values={"pressure": number / 2, "region": number % 3, "flux": V[F].mean(axis=1)})
    assert (mesh.face_values["pressure"] == number / 2).all() and (mesh.face_values["region"] == number % 3).all()
    assert mesh.face_values["flux"].shape == (len(F), 3)
    again = sp.Mesh(mesh, face_values={"pressure": number})
    assert (again.face_values["pressure"] == number).all() and "region" in again.face_values
    assert (mesh.face_values["pressure"] == number / 2).all()
    made = sp.map(V, F, face_values={"pressure": number / 2})
    assert (made.face_values["pressure"] == number / 2).all()
    with pytest.raises(ValueError, match=rf"face_values\['pressure'\]: {len(F)} rows are needed, one a face"):
        sp.Mesh(V, F, face_values={"pressure": V[:, 0]})
    with pytest.raises(TypeError, match="face_values: names with arrays are needed, not ndarray"):
        sp.map(V, F, face_values=number)


def test_aligned_harmonics_do_not_depend_on_how_the_mesh_lies(mapped):
    quarter = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    turned = sp.with_sphere((7 + mapped.vertices @ quarter, F), mapped.points)
    one, other = mapped.spharm(8, align=True), turned.spharm(8, align=True)
    assert np.allclose(one.coefficients, other.coefficients, atol=1e-9)
    assert not np.allclose(mapped.spharm(8).coefficients, turned.spharm(8).coefficients, atol=0.1)


def test_half_turns_of_a_template_are_taken(mapped, tmp_path):
    mapped.save(tmp_path / "a.sph.ply")
    program("spharm", "a.sph.ply", "--degree", "8", "--align", "--coef", "t.coef", cwd=tmp_path)
    program("spharm", "a.sph.ply", "--degree", "8", "--align=sphere", "--coef", "s.coef", cwd=tmp_path)
    template = sp.read_harmonics(tmp_path / "t.coef")
    one = mapped.spharm(8, align=True)
    assert np.allclose(one.coefficients, template.coefficients, atol=1e-12) and one.aligned
    sphere = mapped.spharm(8, align="sphere")
    assert np.allclose(sphere.coefficients, sp.read_harmonics(tmp_path / "s.coef").coefficients, atol=1e-12) and sphere.aligned
    program("spharm", "a.sph.ply", "--degree", "8", "--align", "--flip-template", "t.coef", "--coef", "f.coef", cwd=tmp_path)
    same = mapped.spharm(8, align=True, flip_template=sp.read_harmonics(tmp_path / "t.coef"))
    assert np.allclose(same.coefficients, sp.read_harmonics(tmp_path / "f.coef").coefficients, atol=1e-12)
    with pytest.raises(ValueError, match="align: True, or 'sphere'"):
        mapped.spharm(3, align="surface")
    with pytest.raises(TypeError, match="flip_template: Harmonics are needed"):
        mapped.spharm(3, align=True, flip_template="t.coef")
    with pytest.raises(ValueError, match="flip_template: it is for align"):
        mapped.spharm(3, flip_template=template)
    with pytest.raises(ValueError):
        mapped.spharm(3, align=True, flip_template=mapped.spharm(3))


def test_distortion_is_told_face_by_face(mapped):
    faces = mapped.face_distortion
    assert faces.area_ratio.shape == (len(F),) and faces.angle_ratio.shape == (len(F), 3)
    assert np.abs(np.log(faces.area_ratio)).mean() == pytest.approx(mapped.distortion.mean_abs_ln_area)


def test_faces_without_area_are_in_no_figure(mapped):
    vertices = V.copy()
    vertices[F[7, 0]] = vertices[F[7, 1]]
    m = sp.with_sphere((vertices, F), mapped.points)
    faces, flat = m.face_distortion, m.face_distortion.source_area == 0
    assert flat.sum() == m.distortion.flat_faces == 2 and faces.source_area.sum() == pytest.approx(1)
    for ratios in (faces.area_ratio, faces.angle_ratio[:, 0], faces.sigma_max, faces.sigma_min):
        assert (np.isnan(ratios) == flat).all()
    assert np.abs(np.log(faces.area_ratio[~flat])).mean() == pytest.approx(m.distortion.mean_abs_ln_area)
    assert m.distortion.symmetric_dirichlet < 100


def test_the_distortion_is_what_the_program_tells(mapped, tmp_path):
    import json

    sp.write(tmp_path / "a.ply", V, F)
    program("map", "a.ply", "-o", "a.sph.ply", "--json", "a.json", cwd=tmp_path)
    told = json.loads((tmp_path / "a.json").read_text())
    assert mapped.distortion.mean_abs_ln_area in set(numbers_in(told))
    assert mapped.distortion.quasi_conformal_mean in set(numbers_in(told))


def numbers_in(thing):
    if isinstance(thing, dict):
        thing = list(thing.values())
    if isinstance(thing, list):
        for part in thing:
            yield from numbers_in(part)
    elif isinstance(thing, float):
        yield thing


# Options of maps.


def test_poles_meridian_and_pins_are_where_they_were_wanted():
    made = sp.map(V, F, poles=(4, 5), meridian=0)
    assert made.poles == (4, 5) and made.meridian == 0
    assert (made.points[4] == (0, 0, 1)).all() and (made.points[5] == (0, 0, -1)).all()
    assert made.theta[0] == 0
    pinned = sp.map(V, F, pins={4: (0.5, 0.4)})
    assert pinned.theta[4] == pytest.approx(0.5) and pinned.phi[4] == pytest.approx(0.4)
    assert pinned.pin_residuals == [0]


def test_balances_keep_what_they_promise():
    angle = sp.map(V, F, balance="conformal").distortion.mean_abs_ln_angle
    area = sp.map(V, F, balance="equal-area").distortion.mean_abs_ln_area
    usual = sp.map(V, F).distortion
    assert angle < usual.mean_abs_ln_angle and area < usual.mean_abs_ln_area


def test_the_paper_folds_and_says_so():
    vertices, faces = potato(5)
    vertices = vertices * [1, 1, 6]
    vertices[:, 0] += 2 * np.sin(vertices[:, 2])
    try:
        sp.map(vertices, faces, method="paper")
    except sp.NotCertified as error:
        assert error.certificate.folded.size or error.certificate.degenerate.size
        assert not error.certificate.one_to_one
    assert sp.map(vertices, faces, method="paper", repair_map=True).certificate.one_to_one


def test_numbers_of_vertices_are_those_that_were_given():
    vertices = np.insert(V, 3, 9, axis=0)  # nobody uses it
    faces = np.where(F >= 3, F + 1, F)
    made = sp.map(vertices, faces, repair=dict(unused=True), poles=(5, 6))
    assert made.poles == (5, 6) and 3 not in made.vertex_origin
    assert (vertices[made.vertex_origin] == made.vertices).all()


def test_a_handle_is_cut_or_filled():
    for choice in ("cut", "fill"):
        mended = sp.repair(*torus(), handle_choice=choice, longest_handle=2)
        assert sp.inspect(mended).is_sphere and mended.handles[0].filled == (choice == "fill")
        assert mended.handles[0].points.shape[1] == 3


def test_what_was_read_may_be_written_anew(tmp_path):
    made = sp.map(*octahedron())
    made.export(tmp_path / "a.gltf", image_size=16)
    sp.read(tmp_path / "a.gltf")
    made.export(tmp_path / "a.gltf", image_size=16)  # and a.bin


def test_a_map_of_somebodys_is_judged():
    vertices, faces = octahedron()
    assert sp.verify(vertices, faces, 7 * vertices).one_to_one
    mirrored = sp.verify(vertices, faces, vertices * [-1, 1, 1])
    assert mirrored.reversed and mirrored.one_to_one and len(mirrored.folded) == 0
    with pytest.raises(sp.NotCertified):  # no map of ours looks at the sphere from inside
        sp.with_sphere((vertices, faces), vertices * [-1, 1, 1])
    assert sp.verify(vertices, faces, np.zeros((6, 3))).unusable_points.size == 6
    assert sp.with_sphere((vertices, faces), 7 * vertices).certificate.one_to_one


@pytest.mark.parametrize("length", [1e20, 1e100, 1e160, 1e300, 1e-160])
def test_directions_have_any_length_but_zero(mapped, length):
    mesh, rays = (mapped.vertices, mapped.faces), mapped.points
    far = rays * length
    assert np.abs(sp.with_sphere(mesh, far).points - rays).max() < 1e-15
    found = sp.verify(*mesh, far)
    assert found.one_to_one and not found.reversed
    assert length < 1 or found.max_length_error == pytest.approx(length)
    inside = sp.verify(*mesh, -far)
    assert inside.one_to_one and inside.reversed
    harmonics = mapped.spharm(3)
    assert np.abs(harmonics(far) - harmonics(rays)).max() < 1e-12
    assert np.abs(mapped.resample("vertices", far) - mapped.vertices).max() < 1e-12


# Notebooks.


def test_a_notebook_shows_mesh_and_sphere(mapped):
    html = mapped._repr_html_()
    assert len(html.encode()) <= 200_000 and "one-to-one" in html and "height" in html
    [picture] = re.findall(r'src="data:image/png;base64,([^"]+)"', html)
    assert base64.b64decode(picture).startswith(b"\x89PNG")
    assert "<script" not in html and "1,026" in html


def test_names_of_strangers_stay_text():
    made = sp.map(*octahedron(), values={"<b>": np.zeros(6)})
    assert "<b>" not in made._repr_html_().replace("<b>mesh</b>", "") and "&lt;b&gt;" in made._repr_html_()


def test_the_page_is_opened_in_a_browser(mapped, monkeypatch):
    import webbrowser

    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    path = mapped.show(size=64)
    assert opened == ["file://" + path] and "<html" in open(path).read(1000)


def test_pictures_show_what_is_measured_and_textures(mapped, tmp_path):
    colours = np.full((64, 128, 3), (200, 30, 30), np.uint8)
    skinned = sp.map(V, F, values={"uv": (V[:, :2] - V[:, :2].min()) / np.ptp(V[:, :2])})
    mapped.export(tmp_path / "red.gltf", texture=colours, image_size=16)
    red = tmp_path / "red_basecolor.png"
    seen = [skinned.picture(size=64, view="mesh", **how) for how in ({}, {"texture": red}, {"colours": "plain"})]
    assert len(set(seen)) == 3
    (tmp_path / "skin.mtl").write_text(f"newmtl skin\nmap_Kd {red.name}\n")
    skinned.mesh.save(tmp_path / "skin.obj")
    text = (tmp_path / "skin.obj").read_text()
    (tmp_path / "skin.obj").write_text("mtllib skin.mtl\nusemtl skin\n" + text)
    own = sp.load(tmp_path / "skin.obj").picture(size=64, view="mesh")
    assert own == seen[1]
    program("render", "skin.obj", "--view", "mesh", "--size", "64", "-o", "skin.png", cwd=tmp_path)
    assert own == (tmp_path / "skin.png").read_bytes()
    mapped.save(tmp_path / "a.sph.ply")
    ours = mapped.picture(size=64, scalar="height", range=(-0.5, 1))
    program("render", "a.sph.ply", "--scalar", "height", "--range=-0.5,1", "--size", "64", "-o", "a.png", cwd=tmp_path)
    assert ours == (tmp_path / "a.png").read_bytes() != mapped.picture(size=64, scalar="height")


@pytest.mark.parametrize(
    "how, words",
    [
        (dict(scalar="sulc"), "no property 'sulc'"),
        (dict(scalar="color"), "scalar: 'color' has 3 columns, a picture each: red, green, blue"),
        (dict(scalar="height", colours="area"), "scalar: has colours of its own"),
        (dict(scalar="height", range=(1, 0)), "range: two finite numbers .* smaller one first"),
        (dict(scalar="height", range=(0, np.inf)), "range: two finite numbers"),
        (dict(scalar="height", range=(0, 1, 2)), "range: two finite numbers"),
        (dict(range=(0, 1)), "range: the scale of scalar"),
    ],
)
def test_a_picture_of_numbers_that_are_not_there_is_refused(how, words, mapped):
    with pytest.raises(ValueError, match=words):
        mapped.picture(size=32, **how)


def test_a_picture_of_a_texture_without_coordinates_is_refused(mapped, tmp_path):
    mapped.bake_files({"position": tmp_path / "a.png"}, size=16)
    with pytest.raises(ValueError, match="^texture: "):
        mapped.picture(size=32, texture=tmp_path / "a.png")
    with pytest.raises(FileNotFoundError):
        mapped.picture(size=32, texture=tmp_path / "b.png")


def test_a_picture_is_a_png(mapped):
    assert mapped.picture(size=64, view="sphere", colours="checker").startswith(b"\x89PNG")
