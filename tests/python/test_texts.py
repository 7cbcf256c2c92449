"""Text of files in any encoding, and names of files with any bytes: told as well as can be, never an exception."""

import os
import warnings

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato

V, F = potato(2)


def obj(mesh, head="", material=""):
    vertices, faces = mesh
    lines = [f"v {x} {y} {z}" for x, y, z in vertices.tolist()]
    return "\n".join([head, *lines, material, *(f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()), ""])


def ply(mesh, head, name):
    """With a value of that name, in Latin-1 as `head` is."""
    vertices, faces = mesh
    text = (
        f"ply\nformat ascii 1.0\n{head}element vertex {len(vertices)}\nproperty double x\nproperty double y\n"
        f"property double z\nproperty float {name}\nelement face {len(faces)}\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    text += "".join(f"{x} {y} {z} {k}\n" for k, (x, y, z) in enumerate(vertices.tolist()))
    return text + "".join(f"3 {a} {b} {c}\n" for a, b, c in faces.tolist())


def written(path, text):
    with open(path, "wb") as file:
        file.write(text.encode("latin-1"))
    return path


def without_warnings(use):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return use()


def test_names_of_materials_may_be_in_any_encoding(tmp_path):
    path = written(tmp_path / "road.obj", obj((V, F), "# Straße", "usemtl Straße"))
    mesh = without_warnings(lambda: sp.read(path))
    assert mesh.materials == ["Stra\ufffde"]
    [str(note) for note in mesh.notes]


def test_names_of_values_may_be_in_any_encoding(tmp_path):
    path = written(tmp_path / "large.ply", ply((V, F), "comment Größen\n", "größe"))
    name = "gr\ufffd\ufffde"
    mesh = sp.read(path)
    made = sp.map(mesh)
    for values in (mesh.values, made.values):
        assert (values[name] == np.arange(len(V))).all()
    assert name in made._repr_html_()
    assert (made.resample(name, made.points) == np.arange(len(V))).all()
    without_warnings(lambda: made.export(tmp_path / "large.glb"))
    with pytest.raises(ValueError, match=f"scalar:none|{name}"):
        made.bake("scalar:none", size=16)
    made.save(tmp_path / "large.sph.ply")
    assert b"gr\xf6\xdfe" in (tmp_path / "large.sph.ply").read_bytes()  # as it was
    assert name in sp.load(tmp_path / "large.sph.ply").values


def test_headers_of_maps_may_be_in_any_encoding(tmp_path):
    sp.map(V, F).save(tmp_path / "a.sph.ply")
    text = (tmp_path / "a.sph.ply").read_bytes()
    assert b"comment sphparam method " in text
    (tmp_path / "a.sph.ply").write_bytes(text.replace(b"comment sphparam method ", b"comment sphparam \xe4 \xf6\ncomment sphparam method "))
    assert sp.load(tmp_path / "a.sph.ply").provenance["\ufffd"] == "\ufffd"


@pytest.fixture
def folder(tmp_path):
    """A folder whose name is no UTF-8."""
    made = os.path.join(os.fsencode(tmp_path), b"gr\xfcn")
    try:
        os.mkdir(made)
    except OSError:
        pytest.skip("a file system for UTF-8 alone")
    return os.fsdecode(made)


def test_names_of_files_may_have_any_bytes(folder):
    def at(name):
        return os.path.join(folder, os.fsdecode(b"\xfc") + name)

    made = sp.map(V, F)
    made.save(at("a.sph.ply"))
    made.save_sphere(at("s.ply"))
    made.report(at("a.html"), size=64)
    assert sp.verify(at("a.sph.ply")).one_to_one and sp.verify(at("a.sph.ply"), points=at("s.ply")).one_to_one
    assert (sp.load(at("a.sph.ply"), at("s.ply")).points == made.points).all()
    mesh = sp.read(at("a.sph.ply"))
    assert mesh.path == at("a.sph.ply") and "gr\ufffdn" in repr(mesh) and repr(mesh).encode()
    loaded = sp.load(at("a.sph.ply"))
    assert "gr\ufffdn" in loaded.name or "a.sph.ply" in loaded.name
    assert loaded._repr_html_().encode()
    images = made.bake_files({"normal-object": at("n.png")}, size=16)
    assert [os.path.exists(image.path) for image in images] == [True]
    assert len(made.paint(at("n.png"))) == len(V)
    files = loaded.export(at("a.glb"), texture=at("n.png"))
    assert files == [at("a.glb")]
    assert all(os.path.exists(file) for file in loaded.export(at("b.obj"), texture=at("n.png")))
    low = made.fit("ico:1")
    low.displace(at("d.exr"), size=(64, 32), rebuilt=at("r.ply"))
    without_warnings(lambda: sp.asset(at("a.sph.ply"), at("made"), size=32, resolution=16, page=False))
    assert any(name.endswith(".glb") for name in os.listdir(at("made")))
    for name in ("a.sph.ply", "s.ply", "a.html", "n.png", "a.glb", "b.obj", "d.exr", "r.ply"):
        assert os.path.basename(at(name)) in os.listdir(folder)


def test_refusals_of_such_files_are_what_they_are(folder):
    path = os.path.join(folder, "none.ply")
    with open(path, "w") as file:
        file.write("ply\nformat ascii 1.0\n")
    with pytest.raises(sp.ReadError, match="gr\ufffdn/none.ply"):
        sp.read(path)
    with pytest.raises(FileNotFoundError):
        sp.read(path + "x")
    made = sp.map(*octahedron())
    with pytest.raises(sp.WriteError, match="\ufffd"):
        made.save(os.path.join(folder, "no", "a.ply"))
