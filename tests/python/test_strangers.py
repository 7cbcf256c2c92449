"""What people who had the documents alone stumbled over: each is told, at their line, with what to type."""

import copy
import inspect
import json
import os
import pickle
import shutil
import subprocess
import sys
import types
import warnings

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato

V, F = potato(3)


@pytest.fixture(scope="module")
def mapped():
    return sp.map(V, F)


@pytest.fixture(scope="module")
def low(mapped):
    return mapped.remesh("ico:2")


# Indices from 1, and those of no vertex.


@pytest.mark.parametrize("repair", [False, True, dict(holes=True)])
def test_indices_from_one_are_refused_also_with_repair(repair):
    with pytest.raises(sp.MeshError, match="count from 1: faces - 1") as caught:
        sp.map(V, F + 1, repair=repair)
    assert "mends it" not in str(caught.value)
    [defect] = [d for d in caught.value.defects if d.kind == "index-out-of-range"]
    assert defect.hint == "the indices count from 1: faces - 1" and defect.fatal
    for use in (sp.repair, sp.components, sp.Mesh):
        with pytest.raises(sp.MeshError, match="count from 1"):
            use(V, F + 1)
    with pytest.raises(sp.MeshError, match="count from 1"):
        sp.components(V, F + 1, repair=True)
    assert sp.inspect(V, F + 1).defects[0].hint


def test_a_face_of_no_vertex_is_told_as_such():
    faces = F.copy()
    faces[7, 1] = 10**6
    [removed, *_] = sp.map(V, faces, repair=True).repairs
    assert removed.message == "1 face removed that named a vertex that does not exist: faces 7"
    faces[9, 0] = -1
    faces[11, 0] = faces[11, 1]
    [removed, *_] = sp.repair(V, faces).repairs
    assert removed.message == (
        "2 faces removed that named vertices that do not exist, 1 that named a vertex twice: faces 7, 9, 11"
    )
    with pytest.raises(sp.MeshError, match="2 faces name vertices that do not exist: faces 7, 9"):
        sp.map(V, faces)


# Losses, at the line of whoever called.


class Meshio:
    points, cells_dict, point_data = V, {"triangle": F, "line": F[:5, :2]}, {}
    cell_data_dict = {
        "share": {"triangle": np.arange(len(F)), "line": np.arange(5)},
        "of lines": {"line": np.arange(5)},
    }
    field_data, point_sets = {"sulcus": np.array([1, 2])}, {"rim": np.arange(3)}


def losses(use):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made = use()
    assert all(w.category is sp.LossWarning for w in caught)
    assert {w.filename for w in caught} <= {__file__}, "a warning points into the package"
    return made, [str(w.message) for w in caught]


def test_what_meshio_has_besides_is_carried_or_told():
    made, told = losses(lambda: sp.map(Meshio()))
    assert (made.face_values["share"] == np.arange(len(F))).all()
    text = "\n".join(told)
    for part in ("line cells: 5", "field_data: sulcus", "point_sets: rim", "cell_data: of lines"):
        assert f"not carried: {part}" in text
    assert len(told) == 4


def test_a_loss_is_told_at_the_line_of_the_caller():
    with pytest.warns(sp.LossWarning) as caught:
        line = inspect.currentframe().f_lineno + 1
        sp.inspect(Meshio())
    assert {(w.filename, w.lineno) for w in caught} == {(__file__, line)}


class PyVista:
    points, faces = V, np.c_[np.full(len(F), 3), F].ravel()
    point_data, cell_data, field_data = {}, {"part": np.arange(len(F)) % 3}, {"unit": np.array([1.0])}
    n_lines, n_verts, n_strips = 2, 0, 0


class Strips(PyVista):
    n_strips = 1


class Trimesh:
    vertices, faces = V, F
    face_attributes = {"part": np.arange(len(F)) % 3}

    class visual:
        kind, uv = "texture", (V[:, :2] - V.min()) / np.ptp(V)


class Coloured:
    vertices, faces = V, F

    class visual:
        kind, face_colors = "face", np.full((len(F), 4), 9, np.uint8)


class Open3D:
    vertices, triangles, vertex_normals = V, F.astype(np.int32), V / np.linalg.norm(V, axis=1, keepdims=True)

    def has_vertex_normals(self):
        return True

    def has_triangle_uvs(self):
        return True


def test_what_other_packages_have_besides_is_carried_or_told():
    made, told = losses(lambda: sp.map(PyVista()))
    assert set(made.face_values) == {"part"} and len(told) == 2
    with pytest.raises(ValueError, match="strips"):
        sp.map(Strips())
    made, told = losses(lambda: sp.map(Trimesh()))
    assert set(made.values) == {"uv"} and set(made.face_values) == {"part"} and "material" in told[0]
    made, told = losses(lambda: sp.map(Coloured()))
    assert made.face_values["color"].shape == (len(F), 4) and told == []
    made, told = losses(lambda: sp.map(Open3D()))
    assert set(made.values) == {"normal"} and "texture coordinates" in told[0]


def test_what_a_format_has_no_room_for_is_told(tmp_path):
    carrying = sp.map(V, F, values={"sulc": V[:, 0]})
    for use in (lambda: carrying.save(tmp_path / "a.obj"), lambda: sp.write(tmp_path / "b.obj", carrying)):
        assert any("sulc" in message for message in losses(use)[1])
    assert losses(lambda: carrying.save(tmp_path / "a.sph.ply"))[1] == []


# Images that are no longer what was baked.


def test_what_is_computed_of_an_image_is_numbers_alone(mapped, tmp_path):
    image = mapped.bake("normal-object", size=32)
    assert image.field == "normal-object" and image.convention == "sphparam" and image[1:].convention == ""
    assert mapped.bake("lat", size=32, convention="gis").convention == "gis"
    for kept in (image, image[:], image.copy(), image[2:8], image[:, :, 0], image.astype(float), copy.deepcopy(image)):
        assert kept.field == "normal-object" and kept.about == image.about
    doubled = image.copy()
    doubled *= 2
    for made in (image * 0.5 + 0.5, -image, image.mean(axis=2), np.roll(image, 3, 1), np.zeros_like(image), doubled):
        assert getattr(made, "field", "") == ""
    made = image * 0.5 + 0.5
    mapped.export(tmp_path / "a.glb", texture=made)  # colours from 0 to 1, as they are
    with pytest.raises(ValueError, match="from 0 to 1"):
        mapped.export(tmp_path / "b.glb", texture=image * 2)
    again = pickle.loads(pickle.dumps(image))
    assert again.field == image.field and (again == image).all()
    mapped.export(tmp_path / "c.glb", texture=again)


def test_an_image_that_does_not_fit_is_refused(mapped, low, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    normals = mapped.bake("normal-tangent", size=32, target=low)
    plain = mapped.bake("normal-object", size=32)
    refusals = {
        "for another mesh": lambda: mapped.export("a.glb", normal_map=normals),
        "'normal-tangent' is needed, not of 'normal-object'": lambda: low.export("a.glb", normal_map=plain),
        "'ao' is needed": lambda: low.export("a.glb", occlusion_map=plain),
        "y up": lambda: low.export(
            "a.glb", normal_map=mapped.bake("normal-tangent", size=32, target=low, normal_y_down=True)),
        "convention='gis'": lambda: mapped.export("a.glb", texture=mapped.bake("ao", size=32, convention="gis")),
        "baked with convention": lambda: mapped.paint(mapped.bake("ao", size=32, convention="gis")),
        "refine_poles=2": lambda: mapped.export("a.glb", texture=mapped.bake("position", size=32, refine_poles=2)),
        "a part of a baked image": lambda: mapped.export("a.glb", texture=plain[:, ::-1]),
        "twice as wide as high, not 16×16": lambda: mapped.export("a.glb", texture=np.zeros((16, 16, 3))),
        "twice as wide": lambda: mapped.paint(np.zeros((7, 16, 3))),
    }
    for words, use in refusals.items():
        with pytest.raises(ValueError, match=words):
            use()
    assert list(tmp_path.iterdir()) == []
    mapped.bake_files({"position": "gis.png"}, size=32, convention="gis")
    with pytest.raises(ValueError, match="baked in the convention gis, and would be shown in sphparam"):
        mapped.export("a.glb", texture="gis.png")
    mapped.export("gis.glb", texture="gis.png", convention="gis")
    with pytest.raises(ValueError, match="baked in the convention gis, and would be read in sphparam"):
        mapped.paint("gis.png")
    mapped.paint("gis.png", convention="gis")
    mapped.bake_files({"normal-object": "o.png"}, size=32)
    with pytest.raises(ValueError, match="o.png shows normal-object, and a normal map is of normal-tangent"):
        mapped.export("a.glb", normal_map="o.png")
    mapped.bake_files({"normal-tangent": "down.png"}, size=32, normal_y_down=True)
    with pytest.raises(ValueError, match=r"\+Y down"):
        mapped.export("a.glb", normal_map="down.png")
    low.export("a.glb", normal_map=normals, texture=plain)
    sp.map(V, F).export("b.glb", normal_map=mapped.bake("normal-tangent", size=32))  # the same mesh and map


def test_alpha_of_strangers_is_seen_through_and_what_was_baked_says_it_itself(mapped, tmp_path):
    def alpha_mode(texture):
        mapped.export(tmp_path / "a.gltf", texture=texture)
        return json.loads((tmp_path / "a.gltf").read_text())["materials"][0].get("alphaMode", "OPAQUE")

    colours = np.full((16, 32, 4), 0.5)
    assert alpha_mode(colours) == "BLEND"
    colours[..., 3] = np.arange(32) > 4
    assert alpha_mode(colours) == "MASK"
    colours[..., 3] = 1
    assert alpha_mode(colours) == "OPAQUE"
    holed = sp.map(V, F[6:], repair=dict(keep_holes=True), values={"color": np.full((len(V), 3), 0.5)})
    baked = holed.bake("vcolor", size=32)
    assert baked.shape[2] == 4 and baked[..., 3].min() < 1
    assert alpha_mode(baked) == "OPAQUE"


# Errors that say what to type.


def test_long_doubles_are_not_rounded_unasked():
    for use in (
        lambda: sp.map(V.astype(np.longdouble), F),
        lambda: sp.with_sphere((V, F), V.astype(np.longdouble)),
        lambda: sp.map(V, F, values={"a": V[:, 0].astype(np.longdouble)}),
    ):
        with pytest.raises(TypeError, match="64 bits"):
            use()


def test_without_the_image_module_the_package_is_named(tmp_path):
    """A copy of the package alone, as Debian's is without sphparam-image."""
    package = tmp_path / "sphparam"
    package.mkdir()
    for file in os.scandir(os.path.dirname(sp.__file__)):
        if file.name.endswith((".py", ".so")) and "oiio" not in file.name:
            shutil.copy(file.path, package / file.name)
    code = (
        "import numpy as np, sphparam as sp\n"
        "m = sp.map([[1,0,0],[-1,-1,0],[0,1,0],[0,0,1]], [[0,2,3],[2,1,3],[1,0,3],[2,0,1]], repair=True)\n"
        "try:\n    m.bake_files({'position': 'a.exr'}, size=16)\n"
        "except sp.ImageError as error:\n    print(error)\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert "sphparam-image" in done.stdout and "SPHPARAM_MODULES" in done.stdout, done.stdout + done.stderr
    assert not (tmp_path / "a.exr").exists()


@pytest.mark.parametrize(
    "use, error, words",
    [
        (lambda m: m.spharm(10.5), TypeError, "degree: a whole number is needed, not 10.5"),
        (lambda m: m.levels(2.5), TypeError, "count: a whole number"),
        (lambda m: sp.measure(m, m, samples=0.5), TypeError, "samples: a whole number"),
        (lambda m: m.fit("ico:1").fine_mesh(1e3), TypeError, "triangles: a whole number"),
        (lambda m: m.paint_texture(np.zeros((8, 16, 3)), size=2.0), TypeError, "size: a whole number"),
        (lambda m: m.report("a.html", size="large"), TypeError, "size: a whole number"),
        (lambda m: m.bake("ambient"), ValueError, "no field ambient; there are .*normal-object.*, ao"),
        (lambda m: m.locate([0, 0, 1]), ValueError, r"a single row is \[\[x, y, z\]\]"),
        (lambda m: sp.map("cow.off"), TypeError, r"sphparam.read\('cow.off'\)"),
        (lambda m: m.export("cow.stl"), ValueError, "'cow.stl': exports end in .glb, .gltf, .usda, .usdz, .obj, .ply"),
        (lambda m: sp.map(V, F, values={"a": np.full(len(V), np.nan)}), ValueError, "resample takes NaN"),
        (lambda m: sp.map(V, F, values={"theta": V[:, 0]}), ValueError, "own names are .*phi.*theta"),
        (lambda m: pickle.dumps(m), TypeError, "m.save.*sphparam.load"),
        (lambda m: pickle.dumps(m.mesh), TypeError, "mesh.save.*sphparam.read"),
        (lambda m: m.bake("elevation", unit="mile"), ValueError, "'m' or 'km'"),
        (lambda m: sp.map(V, F, align="north"), ValueError, "'body'"),
        (lambda m: sp.map(V, F, paper=dict(ring=3)), TypeError, "rings"),
        (lambda m: m.save("a.ply", holes="fill"), ValueError, "'drop'"),
    ],
)
def test_a_mistake_is_answered_with_what_to_type(use, error, words, mapped, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=words):
        use(mapped)
    assert list(tmp_path.iterdir()) == []


def test_an_export_of_no_format_fails_before_any_work(mapped):
    stages = []
    with pytest.raises(ValueError, match="exports end in"):
        mapped.export("cow.stl", progress=lambda stage, fraction: stages.append(stage))
    assert stages == []


def test_copies_of_what_never_changes_are_itself(mapped):
    for thing in (mapped, mapped.mesh):
        assert copy.copy(thing) is thing and copy.deepcopy([thing])[0] is thing


def test_a_map_says_once_what_made_it(mapped):
    text = mapped._repr_html_()
    assert "<td>progressive embedding</td>" in text
    assert "progressive progressive" not in text


# Progress in notebooks.


def test_nothing_is_left_of_a_notebooks_bar(monkeypatch):
    shown = []

    class Cell:
        def update(self, page):
            shown.append(page)

    display = types.ModuleType("IPython.display")
    display.HTML = lambda text: text
    display.display = lambda page, display_id: shown.append(page) or Cell()
    monkeypatch.setitem(sys.modules, "IPython", types.ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    monkeypatch.setitem(sys.modules, "ipykernel", types.ModuleType("ipykernel"))
    from sphparam import _progress

    monkeypatch.setattr(_progress.Bar, "patience", 0)
    with _progress.told(None) as bar:
        bar("chart <1>", 0.25)
        bar("bake", 1)
    assert "25%" in shown[0] and "&lt;1&gt;" in shown[0] and "100%" in shown[1] and shown[-1] == ""
    shown.clear()
    with _progress.told(None):
        pass
    assert shown == []
