"""Arrays hurt at random, by seeds, into everything that takes arrays: never a crash, each refusal one of the
package's that names what is wrong, and what is taken is what NumPy reads."""

import warnings
import zlib

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato

V, F = potato(1)
count = 60
directions = np.random.default_rng(5).normal(size=(20, 3))
image = np.random.default_rng(6).random((8, 16, 3))
floats = [np.nan, np.inf, -np.inf, 0.0, -0.0, 1e308, -1e308, 5e-324, 1e200, 1e-200, -1.0]
wholes = [-1, 0, 1, len(V) - 1, len(V), 2**31 - 1, -(2**31), 2**31, 2**32 + 1, 2**40, 2**63 - 1, -(2**63)]
kinds = ["f2", "f4", "f8", ">f4", ">f8", "g", "i1", "i2", "i4", "i8", "u1", "u4", "u8", ">i4", ">u8", "?", "c16", "O", "S8", "U8", "M8[s]"]


def with_a_number(random, array):
    array = array.copy()
    numbers = floats if array.dtype.kind in "fc" else wholes
    array[tuple(random.integers(0, n) for n in array.shape)] = numbers[random.integers(len(numbers))]
    return array


def unaligned(array):
    return np.frombuffer(b"\0" + np.ascontiguousarray(array).tobytes(), array.dtype, array.size, 1).reshape(array.shape)


wounds = [
    lambda r, a: a.astype(kinds[r.integers(len(kinds))]),
    lambda r, a: a.T,
    lambda r, a: a[::-1],
    lambda r, a: a[:, ::-1],
    lambda r, a: np.asfortranarray(a),
    lambda r, a: a[r.integers(0, len(a) + 1) :],
    lambda r, a: a[: r.integers(0, len(a) + 1)],
    lambda r, a: a[None],
    lambda r, a: a.ravel(),
    lambda r, a: np.concatenate([a, a[: r.integers(0, len(a) + 1)]]),
    with_a_number,
    with_a_number,
    with_a_number,
    lambda r, a: a[:, r.permutation(a.shape[1])],
    lambda r, a: a[r.permutation(len(a))],
    lambda r, a: a[:, : r.integers(0, a.shape[1] + 1)],
    lambda r, a: np.broadcast_to(a[:1], a.shape),
    lambda r, a: np.ma.masked_array(a, mask=r.random(a.shape) < 0.05),
    lambda r, a: np.array(a.tolist()),
    lambda r, a: np.repeat(a, 2, axis=-1)[..., ::2],
    lambda r, a: unaligned(a),
    lambda r, a: a * floats[r.integers(3, len(floats))],
    lambda r, a: np.zeros((r.integers(0, 4),) * r.integers(0, 4), a.dtype),
]


def hurt(random, array):
    array = np.array(array)
    for _ in range(random.integers(1, 4)):
        try:
            array = wounds[random.integers(len(wounds))](random, array)
        except (IndexError, OverflowError, TypeError, ValueError):
            pass  # this wound is for other arrays
    return array.tolist() if random.random() < 0.1 else array


def perhaps(random, array, share=0.6):
    return hurt(random, array) if random.random() < share else array


@pytest.fixture(scope="module")
def mapped():
    return sp.map(V, F, values={"a": V[:, 0], "label": np.arange(len(V)), "uv": V[:, :2]})


def used(mesh):
    """Whatever maps is of use."""
    made = sp.map(mesh, quality="draft", repair=True)
    made.remesh("ico:1"), made.spharm(1), made.chart(), made.face_distortion, made.bake("position", size=16)
    return made


uses = {
    "map": lambda r, m: sp.map(perhaps(r, V), perhaps(r, F), quality="draft", values={"q": perhaps(r, V[:, 0])}),
    "radial": lambda r, m: sp.map(perhaps(r, V), F, method="radial", centre=perhaps(r, np.zeros(3))),
    "curvilinear": lambda r, m: sp.map(perhaps(r, V), perhaps(r, F), method="curvilinear"),
    "align": lambda r, m: sp.map(V, F, quality="draft", align=hurt(r, m.points)),
    "poles": lambda r, m: sp.map(V, F, quality="draft", poles=hurt(r, [3, 4])),
    "pins": lambda r, m: sp.map(V, F, quality="draft", pins=dict(zip([3, wholes[r.integers(len(wholes))]], hurt(r, [[0.5, 0.6], [1.0, 2.0]])))),
    "up": lambda r, m: sp.map(V, F, quality="draft", up=hurt(r, [0.0, 1, 0]), front=None if r.random() < 0.5 else hurt(r, [1.0, 0, 0])),
    "all of it": lambda r, m: used((perhaps(r, V), perhaps(r, F))),
    "values": lambda r, m: sp.Mesh(V, F, values={"c": hurt(r, V), "color": hurt(r, np.abs(V) / 5)}).values["c"],
    "inspect": lambda r, m: sp.inspect(perhaps(r, V), perhaps(r, F)),
    "repair": lambda r, m: sp.repair(perhaps(r, V), perhaps(r, F), require_sphere=False, keep_holes=bool(r.random() < 0.5), values={"uv": perhaps(r, V[:, :2], 0.2)}),
    "components": lambda r, m: sp.components(perhaps(r, V), perhaps(r, F), repair=bool(r.random() < 0.5)),
    "wrap": lambda r, m: sp.wrap(perhaps(r, V), perhaps(r, F), resolution=10),
    "creased": lambda r, m: sp.Mesh(perhaps(r, V), perhaps(r, F)).creased(30),
    "measure": lambda r, m: sp.measure((perhaps(r, V), perhaps(r, F)), (perhaps(r, V), F), samples=100),
    "verify": lambda r, m: sp.verify(perhaps(r, V, 0.3), perhaps(r, F, 0.3), perhaps(r, m.points)),
    "with_sphere": lambda r, m: sp.with_sphere((perhaps(r, V, 0.3), perhaps(r, F, 0.2)), perhaps(r, m.points)),
    "locate": lambda r, m: m.locate(hurt(r, directions)),
    "resample": lambda r, m: m.resample(perhaps(r, V), perhaps(r, directions)),
    "carry": lambda r, m: m.chart().carry(hurt(r, V)),
    "harmonics": lambda r, m: m.spharm(1)(hurt(r, directions)),
    "landmarks": lambda r, m: sp.match(m, m, hurt(r, [[0, 0], [5, 5]])),
    "features": lambda r, m: sp.match(m, m, features=(hurt(r, V[:, 0]), perhaps(r, V[:, 0]))),
    "paint": lambda r, m: m.paint(hurt(r, image)),
    "export": lambda r, m: m.export("a." + ["glb", "obj", "ply"][r.integers(3)], texture=hurt(r, image), image_size=16),
    "write": lambda r, m: sp.write("a." + ["ply", "obj", "off", "vtk", "vtp", "gii", "mz3"][r.integers(7)], perhaps(r, V), perhaps(r, F), values={"c": perhaps(r, V)}),
    "centre": lambda r, m: m.bake("radius", size=16, centre=hurt(r, np.zeros(3))),
    "eye": lambda r, m: m.picture(size=16, eye=hurt(r, [0.0, 0, 1])),
    "surface": lambda r, m: m.bake("position", size=16, surface=(perhaps(r, V), perhaps(r, F))),
}  # fmt: skip

refusals = (ValueError, TypeError, sp.MeshError, sp.NotCertified, sp.SolveError, sp.WriteError)
of_the_module_below = ("incompatible function", "Unable to cast", "this cannot be", "reshape", "truth value", "broadcast", "'>' not")


@pytest.mark.parametrize("use", uses)
def test_hurt_arrays_are_taken_or_refused(use, mapped, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    taken = 0
    for seed in range(count):
        random = np.random.default_rng([seed, zlib.crc32(use.encode())])
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                uses[use](random, mapped)
            taken += 1
        except refusals as error:
            assert str(error) and not any(words in str(error) for words in of_the_module_below), (seed, error)
    assert 0 < taken < count  # some of both


def test_what_is_taken_is_what_numpy_reads():
    taken = 0
    for seed in range(300):
        random = np.random.default_rng(seed)
        vertices, faces = (hurt(random, array) for array in octahedron())
        try:
            mesh = sp.Mesh(vertices, faces)
        except refusals:
            continue
        taken += 1
        assert (mesh.vertices == np.asarray(vertices, dtype=float)).all() and (mesh.faces == np.asarray(faces)).all()
    assert taken >= 30
