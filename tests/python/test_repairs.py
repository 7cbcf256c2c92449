"""What `map` and `repair` of the program can do to a mesh, from Python."""

import os
import subprocess
import warnings

import numpy as np
import pytest

import sphparam as sp
from shapes import potato, sphere, torus

V, F = potato(4)


def opened():
    """Without the faces about vertex 4, and about some others."""
    return V, F[~np.isin(F, [4, 100, 500]).any(axis=1)]


def test_vertices_without_a_place_go_with_their_faces():
    vertices = V.copy()
    vertices[17, 1] = np.nan
    made = sp.map(vertices, F, repair=True)
    assert [a.kind for a in made.repairs][:2] == ["non-finite-face-removed", "non-finite-vertex-dropped"]
    assert 17 not in made.vertex_origin and np.isfinite(made.vertices).all()
    with pytest.raises(sp.MeshError, match="finite"):
        sp.map(vertices, F, repair=dict(non_finite=False))


def test_files_with_such_vertices_are_read_when_wanted(tmp_path):
    lines = ["OFF", f"{len(V)} {len(F)} 0", *(" ".join(map(repr, map(float, row))) for row in V)]
    lines[2] = "nan 0 0"
    lines += [f"3 {a} {b} {c}" for a, b, c in F]
    (tmp_path / "a.off").write_text("\n".join(lines) + "\n")
    with pytest.raises(sp.ReadError):
        sp.read(tmp_path / "a.off")
    read = sp.read(tmp_path / "a.off", non_finite=True)
    with pytest.raises(sp.MeshError, match="finite"):
        sp.map(read)
    assert sp.map(read, repair=True).certificate.one_to_one


def test_cracks_are_closed_and_near_vertices_welded():
    split = np.r_[V, V[F[0, :2]].mean(axis=0, keepdims=True)]  # on one side of an edge alone
    faces = np.r_[F[1:], [[F[0, 0], len(V), F[0, 2]], [len(V), F[0, 1], F[0, 2]]]]
    made = sp.map(split, faces, repair=True)
    assert "edge-split-at-vertex" in {a.kind for a in made.repairs}
    apart = np.r_[V, V[:1] + 1e-5]  # some faces name a copy that lies beside it
    named = np.where((F == 0) & (np.arange(len(F)) % 2 == 0)[:, None], len(V), F)
    for weld in (dict(weld_share=1e-3), dict(weld_length=1e-3)):
        made = sp.repair(apart, named, **weld)
        assert "vertex-welded" in {a.kind for a in made.repairs} and len(made.vertices) == len(V)
    assert "vertex-welded" not in {a.kind for a in sp.repair(apart, named).repairs}


def test_what_cannot_be_mended_comes_back_when_wanted():
    with pytest.raises(sp.MeshError):
        sp.repair(*opened(), holes=False)
    made = sp.repair(*opened(), holes=False, require_sphere=False)
    found = sp.inspect(made)
    assert not found.is_sphere and found.boundary_loops == 3
    with pytest.raises(sp.MeshError, match="not closed"):
        sp.map(made)


@pytest.fixture(scope="module")
def holed():
    return sp.map(*opened(), repair=dict(keep_holes=True), values={"height": V[:, 2]})


def test_holes_that_are_kept_are_marked(holed):
    vertices, faces = opened()
    assert holed.certificate.one_to_one and holed.fillers.dtype == bool
    assert len(holed.fillers) == len(holed.faces) > (~holed.fillers).sum() == len(faces)
    assert 0 < holed.filler_share <= 0.02
    assert "hole-kept" in {a.kind for a in holed.repairs}
    surface = holed.surface
    assert len(surface.faces) == len(faces) and sp.inspect(surface).boundary_loops == 3
    assert not surface.fillers.any() and "filler" not in surface.face_values
    assert surface.surface is surface
    plain = sp.map(V, F)
    assert not plain.fillers.any() and len(plain.fillers) == len(F) and plain.filler_share is None


def test_figures_are_of_the_surface_alone(holed):
    ratios = holed.face_distortion.area_ratio
    assert (np.isnan(ratios) == holed.fillers).all()
    assert np.abs(np.log(ratios[~holed.fillers])).mean() == pytest.approx(holed.distortion.mean_abs_ln_area)
    assert sp.measure(holed, holed.surface, samples=1000).max == 0
    assert sp.measure(holed.mesh, opened(), samples=1000).max == 0


def test_the_mesh_of_a_map_knows_all_that_was_done_to_it(holed):
    split = sp.map(V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3)[10:], repair=True)
    kinds = [action.kind for action in split.repairs]
    assert kinds[0] == "vertex-welded" and "hole-filled" in kinds
    for made in (split, holed):
        for mesh in (made.mesh, made.surface, made.mesh.surface):
            assert mesh.repairs == made.repairs and len(mesh.handles) == len(made.handles)
            assert mesh.area_share == made.mesh.area_share
    mended = sp.repair(V, F[10:])
    assert sp.map(mended).mesh.added_share == mended.added_share > 0


def test_images_are_transparent_where_holes_are(holed, tmp_path):
    for field, channels in (("height", 2), ("normal-object", 4)):
        image = holed.bake(field, size=256, interpolation="sphere")
        covered = np.asarray(image)[:, :, -1]
        assert image.shape[2] == channels and 0.9 < covered.mean() < 1 and covered.min() == 0
        picture = image.picture()
        assert picture.shape[2] == 4 and (picture[covered == 0, 3] == 0).all() and (picture[covered == 1, 3] == 255).all()
    assert holed.export(tmp_path / "a.glb", texture=holed.bake("normal-object", size=64))


def test_a_mesh_on_a_grid_knows_its_holes(holed, tmp_path):
    low = holed.remesh("ico:4")
    assert 0 < low.fillers.sum() < 0.05 * len(low.faces) and sp.inspect(low.surface).boundary_loops >= 1
    with pytest.warns(sp.LossWarning, match="filler"):
        low.save(tmp_path / "a.obj")
    assert len(sp.read(tmp_path / "a.obj").faces) == len(low.surface.faces)
    with pytest.warns(sp.LossWarning, match="filler of faces"):
        low.save(tmp_path / "b.obj", holes="keep")
    assert len(sp.read(tmp_path / "b.obj").faces) == len(low.faces)
    low.save(tmp_path / "c.sph.ply")
    assert (sp.load(tmp_path / "c.sph.ply").fillers == low.fillers).all()
    with pytest.warns(sp.LossWarning, match="closes the holes"):
        low.spharm(3)


def test_more_of_the_sphere_may_be_left_to_holes():
    vertices, faces = V, F[V[F, 2].mean(axis=1) < 0.6]  # one large hole
    small, large = (
        sp.map(vertices, faces, repair=dict(keep_holes=True), filler_share=share) for share in (0.01, 0.3)
    )
    assert small.filler_share <= 0.01 < large.filler_share <= 0.3
    with pytest.raises(ValueError, match="filler_share"):
        sp.map(V, F, filler_share=0)


def test_notes_say_what_is_typed_here():
    ends = V[F[::40, 0]]
    torn, faces = np.r_[V, ends + 1e-7], F.copy()
    faces[::40, 0] = len(V) + np.arange(len(ends))
    for made in (sp.repair(torn, faces), sp.map(torn, faces, repair=True)):
        [note] = [note for note in made.notes if "of the area" in note]
        assert note.startswith("repair=dict(weld_share=") and "--" not in note
        options = eval(note[len("repair=") : note.index(")") + 1])
        assert len(sp.map(torn, faces, repair=options).vertices) == len(V)


def test_a_centre_outside_says_what_is_typed_here(tmp_path):
    away = sp.map(V + [0, 0, 9.0], F, quality="draft")
    with pytest.warns(sp.LossWarning, match='outside of the surface: centre="centroid" is '):
        away.bake_files({"radius": tmp_path / "r.png"}, size=16)
    with pytest.warns(sp.LossWarning, match=r': bake\("radius", centre="centroid"\) is the distance'):
        away.bake_files({"height": tmp_path / "h.png"}, size=16)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        away.bake_files({"radius": tmp_path / "r.png"}, size=16, centre="centroid")


@pytest.mark.filterwarnings("ignore::sphparam.LossWarning")
def test_a_match_with_a_surface_inside_out_says_what_turns_it():
    there, turned = sp.map(V, F, quality="draft"), sp.map(V, F[:, ::-1], quality="draft")
    with pytest.warns(sp.LossWarning, match="is inside out .* repair=True where it is mapped turns it over"):
        sp.match(there, turned)
    mended = sp.map(V, F[:, ::-1], repair=True, quality="draft")
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message=".*inside out")
        sp.match(there, mended)


def several():
    """A large part, a small one, and a speck."""
    other = np.r_[V, 0.3 * V + 9, 1e-3 * V - 9]
    return other, np.r_[F, F + len(V), F + 2 * len(V)]


@pytest.mark.parametrize("broken", [several, torus])
def test_a_file_is_refused_with_the_advice_that_arrays_get(broken, tmp_path):
    sp.write(tmp_path / "a.ply", *broken())
    texts = []
    for mesh in (sp.read(tmp_path / "a.ply"), sp.Mesh(*broken())):
        with pytest.raises(sp.MeshError) as caught:
            sp.map(mesh)
        texts.append(str(caught.value))
    assert texts[0] == texts[1] and "map(mesh, repair=" in texts[0]


def test_parts_are_mapped_one_by_one():
    vertices, faces = several()
    parts = sp.components(vertices, faces)
    assert [len(part.faces) for part in parts] == [len(F)] * 3
    assert sum(part.area_share for part in parts) == pytest.approx(1)
    assert parts[0].area_share > parts[1].area_share > parts[2].area_share
    with pytest.raises(sp.MeshError, match=r"sphparam.components\(mesh\)"):
        sp.map(vertices, faces)
    whole = sp.map(V, F)
    for number, part in enumerate(parts):
        made = sp.map(part)
        assert made.certificate.one_to_one
        assert (made.vertex_origin == np.arange(len(V)) + number * len(V)).all()
        assert (vertices[made.vertex_origin] == made.vertices).all()
    assert (sp.map(parts[0]).points == whole.points).all()
    [alone] = sp.components(V, F)
    assert alone.area_share == 1 and (alone.faces == F).all()


def test_parts_are_those_of_the_program(tmp_path):
    sp.write(tmp_path / "a.ply", *several())
    command = [os.environ["SPHPARAM_PROGRAM"], "map", "a.ply", "--all-components", "-o", "b.sph.ply"]
    subprocess.run(command, check=True, cwd=tmp_path, capture_output=True)
    for number, part in enumerate(sp.components(sp.read(tmp_path / "a.ply")), 1):
        sp.map(part).save(tmp_path / "ours.sph.ply")
        theirs = (tmp_path / f"b_{number:04}.sph.ply").read_bytes()
        lines = theirs.splitlines(keepends=True)
        marks = [line for line in lines if line.startswith(b"comment sphparam component ")]
        assert len(marks) == 1  # of which run it is: theirs alone
        assert (tmp_path / "ours.sph.ply").read_bytes() == theirs.replace(marks[0], b"")


def test_parts_are_mended_before_where_that_parts_them():
    vertices, faces = several()
    vertices = vertices.copy()
    vertices[3] = np.nan
    faces = np.r_[faces, [[0, 1, 10**7]]]
    with pytest.raises(sp.MeshError):
        sp.components(vertices, faces)
    parts = sp.components(vertices, faces, repair=True)
    assert len(parts) == 3 and parts[0].repairs
    assert all(sp.map(part, repair=True).certificate.one_to_one for part in parts)
    with pytest.raises(sp.MeshError, match="does not exist"):
        sp.components(vertices, faces, repair=dict(duplicates=False))


def test_the_program_maps_with_kept_holes_to_the_same_bytes(tmp_path):
    sp.write(tmp_path / "a.ply", *opened())
    command = [os.environ["SPHPARAM_PROGRAM"], "map", "a.ply", "--repair", "--keep-holes", "-o", "b.sph.ply"]
    subprocess.run(command, check=True, cwd=tmp_path, capture_output=True)
    sp.map(sp.read(tmp_path / "a.ply"), repair=dict(keep_holes=True)).save(tmp_path / "ours.sph.ply")
    assert (tmp_path / "ours.sph.ply").read_bytes() == (tmp_path / "b.sph.ply").read_bytes()


# Bodies.


def body():
    vertices, faces = sphere(4)
    x, y, z = vertices.T
    return vertices * (1 + 0.05 * np.sin(3 * x) * np.cos(2 * y))[:, None] * [3, 2, 2], faces


def test_a_body_lies_as_it_does():
    vertices, faces = body()
    made = sp.map(vertices, faces, method="radial")
    assert made.radial.folds == 0 and made.radial.centre == (0, 0, 0)
    unit = vertices / np.linalg.norm(vertices, axis=1, keepdims=True)
    assert np.allclose(made.points, unit, atol=1e-15)
    upright = sp.map(vertices, faces, method="radial", up="y")  # y is north, z the front
    x, y, z = made.points.T
    assert np.allclose(upright.points, np.stack([x, -z, y], 1), atol=1e-15)
    moved = sp.map(vertices + [5, 0, 0], faces, method="radial", centre=(5, 0, 0))
    assert np.allclose(moved.points, unit, atol=1e-12) and moved.radial.centre == (5, 0, 0)
    turned = sp.map(vertices, faces, align="body")
    assert 0 < turned.alignment < 0.5 and turned.radial is None
    for other in (made, made.points):
        again = sp.map(vertices, faces, align=other)
        assert np.allclose(again.points, turned.points, atol=1e-9)
    with pytest.raises(ValueError, match="poles|align"):
        sp.map(vertices, faces, align="body", poles=(0, 1))
    with pytest.raises(ValueError, match="centre"):
        sp.map(vertices, faces, method="radial", centre=vertices[3])


@pytest.mark.parametrize(
    "options, words",
    [
        (dict(method="radial", centre=(0.1, 0, 0)), ["--method", "radial", "--centre", "0.1,0,0"]),
        (dict(align="body"), ["--align", "body"]),
    ],
    ids=["radial", "aligned"],
)
def test_maps_and_images_of_a_body_are_the_programs(options, words, tmp_path):
    sp.write(tmp_path / "a.ply", *body())
    for arguments in (
        ["map", "a.ply", "-o", "theirs.sph.ply", *words],
        ["bake", "theirs.sph.ply", "--body", "3,2,2", "--unit", "km", "--size", "64", "--map", "elevation,lon", "-o", "t_{map}.tif"],
    ):
        subprocess.run([os.environ["SPHPARAM_PROGRAM"], *arguments], check=True, cwd=tmp_path, capture_output=True)
    sp.map(sp.read(tmp_path / "a.ply"), **options).save(tmp_path / "ours.sph.ply")
    assert (tmp_path / "ours.sph.ply").read_bytes() == (tmp_path / "theirs.sph.ply").read_bytes()
    images = {field: tmp_path / f"o_{field}.tif" for field in ("elevation", "lon")}
    sp.load(tmp_path / "theirs.sph.ply").bake_files(images, size=64, body="3,2,2", unit="km")
    for field in images:
        for ending in ("tif", "tif.aux.xml"):
            ours, theirs = (tmp_path / f"{who}_{field}.{ending}" for who in "ot")
            assert ours.read_bytes().replace(b"ours.sph", b"theirs.sph") == theirs.read_bytes()


def test_images_of_a_body_say_where_they_lie(tmp_path):
    made = sp.map(*body(), method="radial")
    latitude, longitude = (made.bake(field, size=64, body="2")[:, :, 0] for field in ("lat", "lon"))
    assert latitude[0].mean() > 80 > -80 > latitude[-1].mean()
    assert longitude[16, 0] < -170 and longitude[16, -1] > 170  # plate carrée, as GIS has it
    west = made.bake("lon", size=64, body="2", positive_west=True)[:, :, 0]
    assert np.allclose(np.cos(np.radians(west + longitude)), 1, atol=1e-4)
    [file] = made.bake_files({"radius": tmp_path / "r.tif"}, size=64, body="3,2,2", unit="km")
    assert file.sidecar == str(tmp_path / "r.tif.aux.xml") and os.path.exists(file.sidecar)
    [plain] = made.bake_files({"radius": tmp_path / "p.tif"}, size=64)
    assert plain.sidecar == ""
    with pytest.raises(ValueError, match="body|vesto"):
        made.bake("radius", size=64, body="vesto")


def test_the_papers_own_settings_are_heard():
    vertices, faces = potato(3)
    few, many = (
        sp.map(vertices, faces, method="paper", repair_map=True, paper=dict(iterations=n, weights="cotangent")).points
        for n in (0, 3)
    )
    assert (few != many).any()
    with pytest.raises(ValueError, match="epsilon"):
        sp.map(vertices, faces, method="paper", paper=dict(epsilon=2.0))


def test_edges_that_are_longer_are_halved():
    box = sp.Mesh([[0, 0, 0], [4, 0, 0], [4, 1, 0], [0, 1, 0], [0, 0, 1], [4, 0, 1], [4, 1, 1], [0, 1, 1]],
                  [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4],
                   [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]],
                  values={"along": [0.0, 4, 4, 0, 0, 4, 4, 0]})  # fmt: skip
    cut = sp.repair(box, edge_length=0.5)
    ends = cut.vertices[cut.faces]
    assert np.linalg.norm(ends - np.roll(ends, 1, axis=1), axis=2).max() <= 0.5
    assert np.array_equal(cut.values["along"], cut.vertices[:, 0])
    mapped = sp.map(box, repair=dict(edge_share=0.5 / np.sqrt(18)))
    assert mapped.certificate.one_to_one and len(mapped.points) == len(cut.vertices)
    with pytest.raises(ValueError, match="edge_length: from 0 is needed"):
        sp.repair(box, edge_length=-1)
    with pytest.raises(ValueError, match="faces of the mesh, and only 715827882 have numbers"):
        sp.repair(box, edge_length=1e-5)
