"""An asset's whole way, in one call."""

import json
import os
import struct
import subprocess
import warnings

import numpy as np
import pytest
from shapes import potato

import sphparam as sp


def write_obj(path, vertices, faces):
    path.write_text(
        "mtllib a.mtl\nusemtl red\n"
        + "".join("v %r %r %r\n" % tuple(map(float, v)) for v in vertices)
        + "".join("f %d %d %d\n" % tuple(f + 1) for f in faces)
    )
    (path.parent / "a.mtl").write_text("newmtl red\nKd 1 0 0\nPr 0.5\nPc 1\n")
    return path


def json_of(glb):
    data = open(glb, "rb").read()
    return json.loads(data[20 : 20 + struct.unpack("<I", data[12:16])[0]])


def test_a_closed_surface_stays_itself_with_all_channels(tmp_path):
    path = write_obj(tmp_path / "ball.obj", *potato(3))
    made = sp.asset(path, tmp_path / "out", size=64)
    assert made.surface == "itself" and made.projection is None and made.area_kept == 1
    assert made.map.certificate.one_to_one and len(made.map.faces) == len(potato(3)[1])
    assert set(made.images) == {"basecolor", "orm"} and all(os.path.exists(f) for f in made.images.values())
    assert sorted(os.path.basename(f) for f in made.files) == sorted(os.listdir(tmp_path / "out"))
    assert {"ball.glb", "ball.sph.ply", "ball.html"} <= set(os.listdir(tmp_path / "out"))
    assert sp.load(tmp_path / "out" / "ball.sph.ply").certificate.one_to_one
    material = json_of(tmp_path / "out" / "ball.glb")["materials"][0]
    assert material["extensions"]["KHR_materials_clearcoat"] == {"clearcoatFactor": 1}
    assert made.seconds["images"] > 0 and made.losses == [] and made.warnings == []


def test_an_open_one_is_wrapped_and_stands_up(tmp_path):
    vertices, faces = potato(3)
    path = write_obj(tmp_path / "open.obj", vertices, faces[: len(faces) // 2])
    made = sp.asset(path, tmp_path / "out", size=64, resolution=24, triangles=500, up="y", front="-x", page=False)
    assert made.surface == "wrap" and made.found and made.done
    assert made.projection.farthest > 0 and len(made.map.faces) == pytest.approx(500, abs=60)
    assert made.map.provenance["upright"] == "y, front -x"
    assert not any(name.endswith(".html") for name in made.files)


def test_the_same_as_the_program(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_obj(tmp_path / "ball.obj", *potato(2))
    made = sp.asset("ball.obj", size=64, page=False, compress=True, textures="webp", webp_quality=80)
    assert os.path.dirname(made.files[0]) == "ball_sphere"
    subprocess.run(
        [os.environ["SPHPARAM_PROGRAM"], "ball.obj", "-o", "by_program", "--size", "64", "--no-page", "--compress"]
        + ["--textures", "webp", "--webp-quality", "80"],
        check=True,
        capture_output=True,
    )
    for name in os.listdir("by_program"):
        assert open(f"by_program/{name}", "rb").read() == open(f"ball_sphere/{name}", "rb").read(), name
    assert "EXT_texture_webp" in json_of("by_program/ball.glb")["extensionsRequired"]


def test_what_cannot_be_done_leaves_nothing(tmp_path):
    out = tmp_path / "out"
    with pytest.raises(FileNotFoundError):
        sp.asset(tmp_path / "none.obj", out)
    (tmp_path / "bad.obj").write_text("v 0 0 x\n")
    with pytest.raises(sp.ReadError):
        sp.asset(tmp_path / "bad.obj", out)
    (tmp_path / "empty.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    with pytest.raises(sp.MeshError):
        sp.asset(tmp_path / "empty.obj", out)
    path = write_obj(tmp_path / "ball.obj", *potato(2))
    with pytest.raises(ValueError, match="size"):
        sp.asset(path, out, size=1)
    with pytest.raises(ValueError, match="size|width|even"):
        sp.asset(path, out, size=63)
    with pytest.raises(ValueError):
        sp.asset(path, out, up="nowhere")
    large = write_obj(tmp_path / "large.obj", *potato(5))
    with pytest.raises(sp.Cancelled):
        sp.asset(large, out, size=2048, samples=4, progress=lambda stage, fraction: False)
    assert not out.exists()
    with pytest.raises(FileNotFoundError):
        sp.asset(path, tmp_path / "no" / "such" / "folder", size=64)


def test_losses_are_told(tmp_path):
    path = write_obj(tmp_path / "ball.obj", *potato(2))
    (tmp_path / "a.mtl").write_text("newmtl red\nKd 1 0 0\ndisp d.png\n")
    with pytest.warns(sp.LossWarning, match="displacement"):
        made = sp.asset(path, tmp_path / "out", size=64, page=False)
    assert len(made.losses) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.isfinite(made.map.points).all()


def test_no_file_of_the_asset_is_replaced(tmp_path):
    sp.map(*potato(2)).export(tmp_path / "ball.glb", image_size=16)
    before = (tmp_path / "ball.glb").read_bytes()
    os.symlink(tmp_path, tmp_path / "here")
    for folder in (tmp_path, tmp_path / "here"):
        with pytest.raises(ValueError, match="folder: .*ball.glb is of the asset, and would be replaced"):
            sp.asset(tmp_path / "ball.glb", folder, size=16, page=False)
    assert (tmp_path / "ball.glb").read_bytes() == before and sorted(os.listdir(tmp_path)) == ["ball.glb", "here"]
    os.remove(tmp_path / "here")
    path = write_obj(tmp_path / "skin.obj", *potato(2))
    (tmp_path / "a.mtl").write_text("newmtl red\nmap_Kd skin_basecolor.png\n")
    sp.map(*potato(2)).bake_files({"normal-object": tmp_path / "skin_basecolor.png"}, size=16)
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}
    with pytest.raises(ValueError, match="folder: .*skin_basecolor.png is of the asset"):
        sp.asset(path, tmp_path, size=16, page=False)
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before


def test_an_asset_without_normals_has_hard_edges_where_they_are_asked_for(tmp_path):
    vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    path = write_obj(tmp_path / "box.obj", vertices, np.array([[q[0], *q[k : k + 2]] for q in quads for k in (1, 2)]))
    for crease, hard in ((None, False), (30, True)):
        made = sp.asset(path, tmp_path / "out", size=16, page=False, crease=crease)
        assert (made.map.mesh.corner_normals is not None) == hard and made.warnings == []
    with pytest.raises(ValueError, match="crease: 0 to 180 degrees are needed"):
        sp.asset(path, tmp_path / "none", size=16, crease=-1)
    turned = write_obj(tmp_path / "turned.obj", vertices, sp.read(path).faces[:, ::-1])
    with pytest.warns(sp.LossWarning, match="inside out"):
        told = sp.asset(turned, tmp_path / "turned", size=16, page=False).warnings
    assert any("inside out" in line for line in told) and not any("--" in line for line in told)
    sp.write(tmp_path / "own.ply", vertices, sp.read(path).faces, values={"normal": vertices - 0.5})
    with pytest.warns(sp.LossWarning, match="normals of its own"):
        assert "normals of its own" in sp.asset(tmp_path / "own.ply", tmp_path / "own", size=16, page=False, crease=30).warnings[-1]
