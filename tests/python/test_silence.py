"""Nothing goes wrong in silence: colours, copies of vertices, values without room, maps that are not there."""

import struct
import warnings
import zlib

import numpy as np
import pytest

import sphparam as sp
from shapes import potato

V, F = potato(3)
colours = (np.abs(V) / np.abs(V).max() * 255).astype(np.uint8)


@pytest.fixture(scope="module")
def painted():
    return sp.map(V, F, values={"color": colours, "height": V[:, 2], "label": np.arange(len(V)) % 3})


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


def test_a_file_without_a_map_is_told_as_such(painted, tmp_path):
    told(lambda: painted.export(tmp_path / "a.glb"))
    painted.save(tmp_path / "a.sph.ply")
    assert told(lambda: sp.load(tmp_path / "a.sph.ply"))[1] == []
    _, lines = told(lambda: sp.load(tmp_path / "a.glb"))
    assert any("a.glb: carries no map, so another one was made; .sph.ply" in line for line in lines)
