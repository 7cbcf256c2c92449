"""Arrays that are none: each raises the exception that says what is wrong, and nothing crashes."""

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato, torus

V, F = octahedron()
N = len(V)
BIG = 2**40


def vertices_with(place, value, kind=float):
    array = V.astype(kind)
    array[place] = value
    return array


def faces_with(place, value, kind=np.int64):
    array = F.astype(kind)
    array[place] = value
    return array


def structured():
    table = np.zeros(N, [("x", float), ("y", float), ("z", float)])
    table["x"], table["y"], table["z"] = V.T
    return table


def masked():
    return np.ma.masked_array(V, mask=[[True, False, False]] + [[False] * 3] * (N - 1))


class Raising:
    def __array__(self, *_args):
        raise RuntimeError("no array here")


class Empty:
    pass


class Odd:
    vertices, faces = "vertices", "faces"


class Quads:
    points, cells_dict, point_data = V, {"quad": np.array([[0, 1, 2, 3]])}, {}


class Mixed:
    points, cells_dict, point_data = V, {"triangle": F, "tetra": np.array([[0, 1, 2, 3]])}, {}


class Polygons:
    points, faces, point_data = V, np.array([4, 0, 1, 2, 3, 3, 0, 1, 2]), {}


bad_meshes = {
    # Vertices that are no #×3 numbers.
    "vertices: none": ((None, F), TypeError, "vertices"),
    "vertices: a number": ((1.0, F), ValueError, "single number"),
    "vertices: a text": (("statue.obj", F), TypeError, "vertices"),
    "vertices: bytes": ((b"123", F), TypeError, "vertices"),
    "vertices: a dict": (({}, F), TypeError, "vertices"),
    "vertices: a set": (({1, 2}, F), TypeError, "vertices"),
    "vertices: one axis": ((V.ravel(), F), ValueError, "18"),
    "vertices: three axes": ((V[None], F), ValueError, "1×6×3"),
    "vertices: no axis": ((np.array(5.0), F), ValueError, "single number"),
    "vertices: transposed": ((np.ascontiguousarray(potato(1)[0].T), F), ValueError, "vertices.T"),
    "vertices: transposed view": ((V.T, F), ValueError, "vertices.T"),
    "vertices: two columns": ((V[:, :2], F), ValueError, "6×2"),
    "vertices: four columns": ((np.c_[V, V[:, 0]], F), ValueError, "6×4"),
    "vertices: no columns": ((np.zeros((N, 0)), F), ValueError, "6×0"),
    "vertices: truth values": ((V > 0, F), TypeError, "bool"),
    "vertices: complex": ((V + 0j, F), TypeError, "complex"),
    "vertices: objects": ((V.astype(object), F), TypeError, "object"),
    "vertices: texts": ((V.astype(str), F), TypeError, "<U"),
    "vertices: byte texts": ((V.astype("S"), F), TypeError, "S"),
    "vertices: dates": ((np.zeros((N, 3), "M8[s]"), F), TypeError, "datetime"),
    "vertices: time spans": ((np.zeros((N, 3), "m8[s]"), F), TypeError, "timedelta"),
    "vertices: records": ((structured(), F), TypeError, "numbers"),
    "vertices: ragged": (([[0, 0, 0], [1, 2]], F), ValueError, "vertices"),
    "vertices: ragged deeper": (([[[1], 2, 3]], F), ValueError, "vertices"),
    "vertices: masked": ((masked(), F), ValueError, "masked"),
    "vertices: a function": ((len, F), TypeError, "vertices"),
    "vertices: an object that raises": ((Raising(), F), RuntimeError, "no array"),
    # Coordinates that are no numbers.
    "vertices: NaN": ((vertices_with((2, 1), np.nan), F), sp.MeshError, "finite number: vertices 2"),
    "vertices: infinite": ((vertices_with((3, 0), np.inf), F), sp.MeshError, "vertices 3"),
    "vertices: minus infinite": ((vertices_with((5, 2), -np.inf), F), sp.MeshError, "vertices 5"),
    "vertices: all NaN": ((np.full((N, 3), np.nan), F), sp.MeshError, "6 vertices"),
    "vertices: NaN in float32": ((vertices_with((1, 1), np.nan, np.float32), F), sp.MeshError, "finite"),
    "vertices: NaN, big-endian": ((vertices_with((1, 1), np.nan, ">f8"), F), sp.MeshError, "finite"),
    "vertices: NaN in Fortran order": (
        (np.asfortranarray(vertices_with((0, 2), np.nan)), F), sp.MeshError, "finite"),
    "vertices: beyond doubles": (
        (vertices_with((0, 0), np.longdouble("1e4000"), np.longdouble), F), TypeError, "64 bits"),
    "vertices: infinite halves": ((vertices_with((0, 0), np.inf, np.float16), F), sp.MeshError, "finite"),
    # Faces that are no #×3 whole numbers.
    "faces: none": ((V, None), TypeError, "no mesh"),
    "faces: a number": ((V, 3), ValueError, "faces"),
    "faces: a text": ((V, "faces"), TypeError, "faces"),
    "faces: floats": ((V, F.astype(float)), TypeError, "whole numbers"),
    "faces: float32": ((V, F.astype(np.float32)), TypeError, "float32"),
    "faces: halves": ((V, F + 0.7), TypeError, "whole numbers"),
    "faces: NaN": ((V, faces_with((0, 0), np.nan, float)), TypeError, "whole numbers"),
    "faces: truth values": ((V, F > 0), TypeError, "bool"),
    "faces: complex": ((V, F + 0j), TypeError, "complex"),
    "faces: objects": ((V, F.astype(object)), TypeError, "object"),
    "faces: huge Python numbers": ((V, [[0, 1, 2**70]]), TypeError, "object"),
    "faces: texts": ((V, F.astype(str)), TypeError, "<U"),
    "faces: one axis": ((V, F.ravel()), ValueError, "24"),
    "faces: transposed": ((V, np.ascontiguousarray(potato(1)[1].T)), ValueError, "faces.T"),
    "faces: quads": ((V, np.c_[F, F[:, 0]]), ValueError, "quads"),
    "faces: edges": ((V, F[:, :2]), ValueError, "8×2"),
    "faces: three axes": ((V, F[None]), ValueError, "1×8×3"),
    "faces: ragged": ((V, [[0, 1, 2], [0, 1]]), ValueError, "faces"),
    # Indices of nothing.
    "faces: −1": ((V, faces_with((3, 1), -1)), sp.MeshError, "faces 3"),
    "faces: one too many": ((V, faces_with((7, 2), N)), sp.MeshError, "does not exist: faces 7"),
    "faces: 2⁴⁰": ((V, faces_with((2, 0), BIG)), sp.MeshError, "faces 2"),
    "faces: 2⁴⁰ as uint64": ((V, faces_with((2, 0), BIG, np.uint64)), sp.MeshError, "faces 2"),
    "faces: 2³² + 1": ((V, faces_with((0, 0), 2**32 + 1)), sp.MeshError, "faces 0"),
    "faces: −2⁶³": ((V, faces_with((0, 0), -(2**63))), sp.MeshError, "faces 0"),
    "faces: 2⁶⁴ − 1": ((V, faces_with((0, 0), 2**64 - 1, np.uint64)), sp.MeshError, "faces 0"),
    "faces: 2³² − 1 as uint32": ((V, faces_with((1, 1), 2**32 - 1, np.uint32)), sp.MeshError, "faces 1"),
    "faces: −1 as int8": ((V, faces_with((1, 1), -1, np.int8)), sp.MeshError, "faces 1"),
    "faces: 255 as uint8": ((V, faces_with((1, 1), 255, np.uint8)), sp.MeshError, "faces 1"),
    "faces: big-endian, one too many": ((V, faces_with((1, 1), N, ">i4")), sp.MeshError, "faces 1"),
    "faces: from 1": ((V, F + 1), sp.MeshError, "do not exist"),
    "faces: of no vertices": ((np.zeros((0, 3)), F), sp.MeshError, "8 faces"),
    # Meshes that are no spheres.
    "no faces": ((V, np.zeros((0, 3), int)), sp.MeshError, "no faces"),
    "nothing at all": ((np.zeros((0, 3)), np.zeros((0, 3), int)), sp.MeshError, "no faces"),
    "open": ((V, F[1:]), sp.MeshError, "not closed"),
    "one triangle": ((V, F[:1]), sp.MeshError, "not closed"),
    "a vertex named twice": ((V, faces_with((0, 0), 2)), sp.MeshError, "twice"),
    "a face twice": ((V, np.r_[F, F[:1]]), sp.MeshError, "three or more faces|same three"),
    "turned over": ((V, np.r_[F[:1, ::-1], F[1:]]), sp.MeshError, "same way"),
    "two components": ((np.r_[V, V + 5], np.r_[F, F + N]), sp.MeshError, "2 separate components"),
    "a torus": (torus(), sp.MeshError, "genus 1"),
    "an unused vertex": ((np.r_[V, [[9, 9, 9]]], F), sp.MeshError, "used by no face"),
    # What is no mesh.
    "no mesh: none": ((None,), TypeError, "no mesh"),
    "no mesh: an object": ((Empty(),), TypeError, "Empty"),
    "no mesh: an array": ((V,), TypeError, "no mesh"),
    "no mesh: a text": (("statue.obj",), TypeError, "no mesh"),
    "no mesh: three arrays": (((V, F, F),), TypeError, "no mesh"),
    "no mesh: texts for arrays": ((Odd(),), TypeError, "vertices"),
    "no mesh: quads alone": ((Quads(),), ValueError, "quad"),
    "no mesh: tetrahedra too": ((Mixed(),), ValueError, "tetra"),
    "no mesh: polygons": ((Polygons(),), ValueError, "triangulate"),
}


@pytest.mark.parametrize("case", bad_meshes)
def test_a_mesh_that_is_none_is_refused(case):
    arguments, error, words = bad_meshes[case]
    with pytest.raises(error, match=words):
        sp.map(*arguments)
    with pytest.raises(error, match=words):  # and so again: nothing is left behind
        sp.map(*arguments)


def test_there_are_as_many_cases_as_promised():
    assert len(bad_meshes) + len(bad_options) + len(bad_uses) >= 80
    assert len(bad_meshes) >= 80


bad_options = {
    "method": (dict(method="tutte"), ValueError, "progressive"),
    "method: a number": (dict(method=3), TypeError, "method"),
    "quality": (dict(quality="better"), ValueError, "'normal'"),
    "balance": (dict(balance="equal"), ValueError, "equal-area"),
    "balance: NaN": (dict(balance=float("nan")), ValueError, "lambda"),
    "balance: none": (dict(balance=None), TypeError, "balance: a number"),
    "weight: a text": (dict(weight="1"), TypeError, "weight: a number"),
    "weight: negative": (dict(weight=-1), ValueError, r"weight \(lambda\) is -1: it must be from 1e-10 to 1e\+06"),
    "weight: infinite": (dict(weight=float("inf")), ValueError, "lambda"),
    "energy": (dict(energy="arap"), ValueError, "symmetric-dirichlet"),
    "threads: negative": (dict(threads=-1), ValueError, "threads"),
    "threads: a float": (dict(threads=1.5), TypeError, "threads"),
    "threads: a truth value": (dict(threads=True), TypeError, "threads"),
    "threads: millions": (dict(threads=10**7), ValueError, "4096"),
    "poles: a word": (dict(poles="north"), ValueError, "auto"),
    "poles: up and pins": (dict(poles="up", pins={0: (0, 1)}), ValueError, "pins"),
    "up: a word": (dict(up="north"), ValueError, "'-y'"),
    "front: as up": (dict(up="z", front=(0, 0, 2)), ValueError, "front"),
    "front: along z": (dict(front="z"), ValueError, "front"),
    "poles: one": (dict(poles=(1,)), ValueError, "two vertices"),
    "poles: a number": (dict(poles=3), ValueError, "two vertices"),
    "poles: alike": (dict(poles=(1, 1)), ValueError, "pole"),
    "poles: not there": (dict(poles=(0, N)), ValueError, "no vertex 6"),
    "poles: 2⁴⁰": (dict(poles=(0, BIG)), ValueError, str(BIG)),
    "poles: floats": (dict(poles=(0.5, 1)), TypeError, "whole"),
    "meridian: not there": (dict(meridian=77), ValueError, "77"),
    "meridian: negative": (dict(meridian=-1), ValueError, "-1"),
    "meridian: a text": (dict(meridian="a"), TypeError, "whole"),
    "pins: not there": (dict(pins={99: (0, 1)}), ValueError, "99"),
    "pins: phi": (dict(pins={1: (0, 4)}), ValueError, "phi"),
    "pins: NaN": (dict(pins={1: (float("nan"), 1)}), ValueError, "finite"),
    "pins: a float": (dict(pins={1.5: (0, 1)}), TypeError, "whole"),
    "pins: a text": (dict(pins={"nose": (0, 1)}), TypeError, "whole"),
    "pins: vertices alone": (dict(pins=[1, 2]), TypeError, "pins: a dict .* not list"),
    "pins: an array": (dict(pins=np.zeros((2, 3))), TypeError, "pins: a dict .* not ndarray"),
    "pins: one angle": (dict(pins={1: (0.5,)}), ValueError, r"pins\[1\]: two angles"),
    "pins: three angles": (dict(pins={1: (0, 1, 2)}), ValueError, r"pins\[1\]: two angles"),
    "pins: a number": (dict(pins={1: 2}), ValueError, r"pins\[1\]: two angles .* not 2"),
    "pins: names of angles": (dict(pins={1: {"theta": 0, "phi": 1}}), ValueError, "two angles"),
    "pins: texts": (dict(pins={1: "12"}), ValueError, "two angles"),
    "pins: 2⁷⁰": (dict(pins={2**70: (0, 1)}), ValueError, f"pins: no mesh has a vertex {2**70}"),
    "pins: 2⁵³ + 1": (dict(pins={2**53 + 1: (0, 1)}), ValueError, f"vertex {2**53 + 1}"),
    "threads: two of them": (dict(threads=np.array([1, 2])), TypeError, "threads: a whole number"),
    "threads: true": (dict(threads=np.True_), TypeError, "threads: a whole number"),
    "balance: less than nothing": (dict(balance=-1), ValueError, r"weight \(lambda\) is -1"),
    "balance: beyond doubles": (dict(balance=2**2000), TypeError, "balance: a number"),
    "align: too few": (dict(align=V[:3]), ValueError, "^align: "),
    "centre: two numbers": (dict(method="radial", centre=(0, 1)), ValueError, "centre: three numbers are needed, not 2"),
    "progress": (dict(progress="yes"), TypeError, "progress"),
    "repair": (dict(repair="holes"), TypeError, "dict"),
    "repair: no such option": (dict(repair=dict(hole=3)), TypeError, "largest_hole"),
    "repair: out of its domain": (dict(repair=dict(largest_hole=1)), ValueError, "largest_hole"),
    "repair: of no such component": (dict(repair=dict(component=7)), ValueError, "component"),
    "repair: beyond": (dict(repair=dict(largest_hole=BIG)), ValueError, f"largest_hole: .*{BIG}"),
    "repair: of a wrong type": (dict(repair=dict(largest_hole="many")), TypeError, "largest_hole"),
    "values: too few": (dict(values={"a": np.zeros(5)}), ValueError, "6 rows"),
    "values: NaN": (dict(values={"a": np.full(6, np.nan)}), ValueError, "finite"),
    "values: texts": (dict(values={"a": np.array(["x"] * 6)}), TypeError, "numbers"),
    "values: 2⁵³ + 1": (dict(values={"a": np.full(6, 2**53 + 1)}), ValueError, "beyond 2⁵³"),
    "values: three axes": (dict(values={"a": np.zeros((6, 2, 2))}), ValueError, "6×2×2"),
    "values: a blank in the name": (dict(values={"a b": np.zeros(6)}), ValueError, "blanks"),
    "values: a zero byte in the name": (dict(values={"a\0b": np.zeros(6)}), ValueError, r"values\['a\\x00b'\]: a name"),
    "values: half a letter in the name": (dict(values={"a\ud800": np.zeros(6)}), ValueError, "half a letter"),
    "values: a name of the map's": (dict(values={"sx": np.zeros(6)}), ValueError, "own"),
    "values: a number for a name": (dict(values={3: np.zeros(6)}), ValueError, "name"),
    "values: no number a row": (dict(values={"a": np.zeros((6, 0))}), ValueError, r"values\['a'\]: rows without"),
    "values: masked": (dict(values={"a": np.ma.masked_less(np.arange(6.0), 2)}), ValueError, "masked"),
    "values: a column of another": (dict(values={"k": np.zeros((6, 2)), "k_0": np.zeros(6)}), ValueError, "'k_0'.* 'k' .*'k_0'"),
    "values: another's next column": (dict(values={"k_2": np.zeros(6), "k": np.zeros((6, 2))}), ValueError, "'k'.*'k_2'"),
    "values: the next column, of labels": (dict(values={"k": np.zeros((6, 2)), "k_2": np.zeros(6, int)}), ValueError, "'k'.*'k_2'"),
    "values: colours twice": (dict(values={"color": np.zeros((6, 3)), "colors": np.zeros((6, 3))}), ValueError, "'colors'.*'color'"),
    "values: colours and their alpha": (dict(values={"color": np.zeros((6, 3)), "alpha": np.zeros(6)}), ValueError, "'color'.*'alpha'"),
    "repair: near twice": (dict(repair=dict(weld_share=0.1, weld_length=0.1)), ValueError, "weld_share and weld_length contradict"),
    "repair: less than near": (dict(repair=dict(weld_share=-0.5)), ValueError, "weld_share"),
    "balance and weight": (dict(balance="conformal", weight=2.0), ValueError, "contradict"),
    "balance: of no such method": (dict(method="radial", balance="equal-area"), ValueError, "for method='progressive'"),
    "quality: of no such method": (dict(method="curvilinear", quality="best"), ValueError, "for method='progressive'"),
    "weight: of no such method": (dict(method="radial", weight=2.0), ValueError, "minimises nothing"),
    "balance: an array, and weight": (dict(balance=np.zeros(2), weight=2.0), ValueError, "contradict"),
    "paper: of no such method": (dict(paper=dict(sweeps=9)), ValueError, "for method='paper'"),
    "repair_map: of no such method": (dict(repair_map=True), ValueError, "for method='paper'"),
    "centre: of no such method": (dict(centre=(1, 2, 3)), ValueError, "for method='radial'"),
    "values: no dict": (dict(values=[1, 2]), TypeError, "values"),
}


@pytest.mark.parametrize("case", bad_options)
def test_an_option_out_of_its_domain_is_named(case):
    options, error, words = bad_options[case]
    with pytest.raises(error, match=words):
        sp.map(V, F, **options)


@pytest.fixture(scope="module")
def mapped():
    return sp.map(*potato(2))


def coloured():
    return sp.map(V, F, values={"color": np.full((6, 3), 0.5)})


bad_uses = {
    "locate: NaN": (lambda m: m.locate([[np.nan, 0, 0]]), ValueError, "finite"),
    "locate: zero": (lambda m: m.locate([[1, 0, 0], [0, 0, 0]]), ValueError, "row 1"),
    "locate: one direction": (lambda m: m.locate([1, 0, 0]), ValueError, "#×3"),
    "locate: texts": (lambda m: m.locate([["a", "b", "c"]]), TypeError, "numbers"),
    "resample: too few": (lambda m: m.resample(np.zeros(3), [[1, 0, 0]]), ValueError, "rows"),
    "resample: masked": (lambda m: m.resample(np.ma.masked_less(np.arange(66.0), 2), [[1, 0, 0]]), ValueError, "masked"),
    "resample: no such name": (lambda m: m.resample("sulc", [[1, 0, 0]]), ValueError, "sulc"),
    "resample: objects": (lambda m: m.resample(np.array([None] * 66), [[1, 0, 0]]), TypeError, "object"),
    "chart: too few": (lambda m: m.chart().carry(np.zeros(3)), ValueError, "66 rows .* not 3"),
    "chart: too many": (lambda m: m.chart().carry(np.zeros((67, 2))), ValueError, "66 rows .* not 67×2"),
    "bake: columns": (lambda m: coloured().bake("scalar:color", size=16), ValueError, "3 columns.*scalar:red, scalar:green"),
    "bake_files: columns": (lambda m: coloured().bake_files({"scalar:color": "a.png"}), ValueError, "scalar:blue"),
    "bake_files: a range of nothing": (lambda m: m.bake_files({"ao": "a.png"}, range=(0, 1)), ValueError, "range: .*scalar:NAME"),
    "bake_files: a range turned round": (lambda m: m.bake_files({"scalar:a": "a.png"}, range=(1, 0)), ValueError, "range"),
    "measure: a seed beyond": (lambda m: sp.measure(m, m, seed=2**64), ValueError, "seed"),
    "measure: a text for a truth": (lambda m: sp.measure(m, m, extremes="no"), TypeError, "extremes: True or False"),
    "measure: a number for a side": (lambda m: sp.measure(m, m, signed=1), TypeError, "signed: True or False"),
    "spharm: two numbers for a centre": (lambda m: m.spharm(2, radius=True, centre=(0, 1)), ValueError, "centre: three numbers"),
    "spharm: a text for the radius": (lambda m: m.spharm(2, radius="yes"), TypeError, "radius: True or False"),
    "spharm: no text for a centre": (lambda m: m.spharm(2, radius=True, centre="origin"), TypeError, "centre"),
    "read: a limit beyond": (lambda m: sp.read(__file__, limits={"file": 2**64}), ValueError, r"limits\['file'\]: 1 to"),
    "read: a text for a truth": (lambda m: sp.read(__file__, repeated_corners="yes"), TypeError, "repeated_corners"),
    "match: a number for a truth": (lambda m: sp.match(m, m, (), mirror=1), TypeError, "mirror"),
    "match: a text for a truth": (lambda m: sp.match(m, m, alike="yes"), TypeError, "alike"),
    "match: no weight of no features": (lambda m: sp.match(m, m, (), feature_weight=np.nan), ValueError, "feature_weight"),
    "export: a number": (lambda m: m.export("a.glb", texture=3), ValueError, "not a single number"),
    "bake: above no body": (lambda m: m.bake("elevation", size=16), ValueError, r"\(body=\)$"),
    "bake: rays beyond": (lambda m: m.bake("ao", size=16, rays=BIG), ValueError, f"rays: beyond what it may be: {BIG}"),
    "bake: a number for a word": (lambda m: m.bake("ao", size=16, convention=3), TypeError, "convention: this cannot be a int"),
    "bake: no such field": (lambda m: m.bake("normal"), ValueError, "normal"),
    "bake: odd size": (lambda m: m.bake("position", size=5), ValueError, "even"),
    "bake: a size beyond": (lambda m: m.bake("position", size=10**6), ValueError, "65536"),
    "bake: a size that is none": (lambda m: m.bake("position", size=64.5), TypeError, "size"),
    "bake: no such value": (lambda m: m.bake("scalar:sulc", size=16), ValueError, "sulc"),
    "bake: a number": (lambda m: m.bake(3), TypeError, "field"),
    "bake: no such texture": (lambda m: m.bake("basecolor", texture="no.png"), FileNotFoundError, "no.png"),
    "bake: a surface and a target": (
        lambda m: m.bake("position", target=m, surface=m.mesh), ValueError, "surface"),
    "bake: a target that is none": (lambda m: m.bake("position", target=m.mesh), TypeError, "target"),
    "bake: no such convention": (lambda m: m.bake("position", convention="x"), ValueError, "gis"),
    "remesh: no such grid": (lambda m: m.remesh("cow:3"), ValueError, "cow"),
    "remesh: a grid beyond": (lambda m: m.remesh("ico:30"), ValueError, "ico"),
    "remesh: a mesh": (lambda m: m.remesh(m.mesh), TypeError, "SphereMap"),
    "remesh: no such value": (lambda m: m.remesh("ico:1", transfer="sulc"), ValueError, "sulc"),
    "remesh: no such mode": (lambda m: m.remesh("ico:1", sample="mean"), ValueError, "cell"),
    "fit: no such scheme": (lambda m: m.fit("ico:1", scheme="doo"), ValueError, "catmark"),
    "fit: quads for Loop": (lambda m: m.fit("cube:2"), ValueError, "triangle"),
    "spharm: a negative degree": (lambda m: m.spharm(-1), ValueError, "degree"),
    "spharm: a degree beyond": (lambda m: m.spharm(1001), ValueError, "degree"),
    "export: no such format": (lambda m: m.export("a.stl"), ValueError, "stl"),
    "export: no such folder": (lambda m: m.export("no/such/a.glb"), sp.WriteError, "no/such"),
    "export: floats beyond 1": (lambda m: m.export("a.glb", texture=np.full((4, 8, 3), 2.0)), ValueError, "0 to 1"),
    "export: two channels": (lambda m: m.export("a.glb", texture=np.zeros((4, 8, 2))), ValueError, "4×8×2"),
    "export: whole numbers": (lambda m: m.export("a.glb", texture=np.zeros((4, 8, 3), int)), TypeError, "uint8"),
    "export: no such variant": (lambda m: m.export("a.glb", variants=["x"]), ValueError, "x"),
    "export: up": (lambda m: m.export("a.glb", up="w"), ValueError, "'y'"),
    "export: no way up": (lambda m: m.export("a.glb", up=(0, 0, 0)), ValueError, "'y'"),
    "export: front is up": (lambda m: m.export("a.glb", up="x", front="-x"), ValueError, "front"),
    "picture: front is up": (lambda m: m.picture(front="z"), ValueError, "front"),
    "save: no name": (lambda m: m.save(""), ValueError, "path"),
    "save: a zero byte": (lambda m: m.save("a\0.ply"), ValueError, "path"),
    "save: half a letter": (lambda m: m.save("a\ud800.ply"), ValueError, r"path: no file has the name .*ud800"),
    "save: bytes": (lambda m: m.save(b"a.ply"), TypeError, "bytes"),
    "save: no such format": (lambda m: m.save("a.fbx"), sp.WriteError, "fbx"),
    "picture: no such colours": (lambda m: m.picture(colours="red"), ValueError, "checker"),
    "read: no such file": (lambda m: sp.read("no.ply"), FileNotFoundError, "no.ply"),
    "load: no such sphere": (lambda m: sp.load(__file__, "no.gii"), FileNotFoundError, "no.gii"),
    "read: no mesh": (lambda m: sp.read(__file__), sp.ReadError, "test_hostile"),
    "verify: no points": (lambda m: sp.verify(V, F), TypeError, "points"),
    "verify: too few points": (lambda m: sp.verify(V, F, V[:3]), ValueError, "6 rows"),
    "with_sphere: folded": (lambda m: sp.with_sphere((V, F), V[[1, 0, 2, 3, 4, 5]]), sp.NotCertified, "one-to-one"),
    "with_sphere: NaN": (lambda m: sp.with_sphere((V, F), V * np.nan), ValueError, "finite"),
    "measure: nothing": (lambda m: sp.measure((V, F[:0]), m), ValueError, "triangle|face"),
    "measure: no samples": (lambda m: sp.measure(m, m, samples=0), ValueError, "sample"),
    # What is no word, no list, no place: named, not left to the module below.
    "remesh: no word": (lambda m: m.remesh("ico:1", sample=3), TypeError, "sample: a text"),
    "remesh: no word of layout": (lambda m: m.remesh("ico:1", uv=None), TypeError, "uv: a text"),
    "remesh: half a letter": (lambda m: m.remesh("ico:\ud800"), ValueError, r"grid: half a letter .*ud800"),
    "remesh: no names": (lambda m: m.remesh("ico:1", transfer=None), TypeError, "transfer: a list of names"),
    "remesh: half a name": (lambda m: m.remesh("ico:1", transfer=["\ud800"]), ValueError, "transfer: half a letter"),
    "fit: no word": (lambda m: m.fit("ico:1", scheme=3), TypeError, "scheme: a text"),
    "spharm: no names": (lambda m: m.spharm(2, values=3), TypeError, "values: a list of names"),
    "paint: no word": (lambda m: m.paint(np.zeros((4, 8, 3)), convention=3), TypeError, "convention: a text"),
    "paint_texture: no word": (lambda m: m.paint_texture(np.zeros((4, 8)), convention=None), TypeError, "convention: a text"),
    "match: a vertex beyond": (lambda m: sp.match(m, m, np.array([[2**63, 0]], np.uint64)), ValueError, f"landmarks: .*vertex {2**63}"),
    "morph: no word": (lambda m: sp.match(m, m, ()).morph("a.glb", place=3), TypeError, "place: a text"),
    "morph: no size": (lambda m: sp.match(m, m, ()).morph("a.glb", image_size="x"), TypeError, "image_size: a whole number"),
    "group: no list": (lambda m: sp.group(m), TypeError, "shapes: a list of maps .* not SphereMap"),
    "export: no list": (lambda m: m.export("a.glb", levels=m), TypeError, "levels: a list of maps .* not SphereMap"),
    "export: no size": (lambda m: m.export("a.glb", image_size=1), ValueError, "^image_size is 1"),
    "picture: from nowhere": (lambda m: m.picture(eye=(0, 0, 0)), ValueError, "eye: 0, 0, 0 is no direction"),
    "picture: from two numbers": (lambda m: m.picture(eye=(1, 2)), ValueError, "eye: three numbers are needed, not 2"),
    "picture: from no number": (lambda m: m.picture(eye=(np.nan, 0, 0)), ValueError, "eye: three finite numbers"),
    "bake: two numbers": (lambda m: m.bake("radius", size=16, centre=(0, 0)), ValueError, "centre: three numbers are needed, not 2"),
    "bake: no unit": (lambda m: m.bake("elevation", size=16, body="vesta", unit=[]), TypeError, "unit: a text"),
    "bake_files: no dict": (lambda m: m.bake_files("ao"), TypeError, "images: a dict is needed, .* not str"),
    "wrap: no number": (lambda m: sp.wrap(m, voxel="fine"), TypeError, "voxel: a number"),
    "wrap: no distance": (lambda m: sp.wrap(m, distance="far"), TypeError, "distance: a number"),
    "asset: no number": (lambda m: sp.asset(__file__, least_kept="all"), TypeError, "least_kept: a number"),
    "a map without a mesh": (lambda m: sp.SphereMap(), TypeError, "sphparam.map"),
}


@pytest.mark.parametrize("case", bad_uses)
def test_a_use_that_makes_no_sense_is_refused(case, mapped, tmp_path, monkeypatch):
    use, error, words = bad_uses[case]
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error, match=words):
        use(mapped)
    assert list(tmp_path.iterdir()) == []  # nothing half written


def test_a_fit_is_told_what_it_cannot_make(mapped, tmp_path):
    fit = mapped.fit("ico:1")
    for use, error, words in (
        (lambda: fit.displace(tmp_path / "d.exr", layout=3), TypeError, "layout: a text"),
        (lambda: fit.displace(tmp_path / "d.exr", depth=None), TypeError, "depth: a text"),
        (lambda: fit.displace(tmp_path / "d.exr", size=64), TypeError, "size: a list of two numbers, .* not int"),
        (lambda: fit.displace(tmp_path / "d.exr", size=(64, 32, 1)), ValueError, "size: .* not 3 numbers"),
        (lambda: fit.textured_control(size=(BIG, 1)), ValueError, f"size: .* not {BIG}"),
        (lambda: fit.fine_mesh(2**70), ValueError, f"triangles: .* not {2**70}"),
    ):
        with pytest.raises(error, match=words):
            use()
    assert list(tmp_path.iterdir()) == []


def test_coefficients_of_the_users_own_are_evaluated_or_refused(mapped):
    shape = mapped.spharm(2)
    there = shape(V)
    shape.coefficients = shape.coefficients.astype(">f8")
    assert (shape(V) == there).all()
    for wrong, error in ((np.zeros(9), ValueError), (np.zeros((9, 3), complex), TypeError), (np.zeros((8, 3)), ValueError)):
        shape.coefficients = wrong
        with pytest.raises(error, match="coefficients"):
            shape(V)


def test_values_of_a_kind_that_is_not_taken_are_refused_with_what_to_write():
    mesh = sp.Mesh(V, F, values={"p": np.arange(float(len(V)))}, face_values={"vn": np.arange(float(len(F)))})
    mapped = sp.map(mesh)
    for use, error, words in (
        (lambda: mapped.resample("vn", V), ValueError, r"'vn' is of faces: m\.face_values\['vn'\]\[m\.locate\(directions\)\[0\]\]"),
        (lambda: mapped.spharm(1, values=["vn"]), ValueError, "'vn' is of faces; harmonics are of what vertices have"),
        (lambda: mapped.spharm(1, values={"q": np.zeros(len(V))}), TypeError, "names of what the mesh has are needed, not arrays"),
        (lambda: mapped.spharm(1, values=np.zeros(len(V))), TypeError, "names of what the mesh has are needed, not arrays"),
        (lambda: sp.map(V, F, values={"p": np.zeros(len(V), complex)}), TypeError, r"values\['p'\]: .* z\.real and z\.imag"),
    ):
        with pytest.raises(error, match=words):
            use()
    assert mapped.face_values["vn"][mapped.locate(V)[0]].shape == (len(V),)


def test_levels_end_where_there_are_no_more(mapped):
    assert len(mapped.levels(2**40)) == len(mapped.levels(3))


def test_a_mesh_of_nothing_may_carry_nothing():
    found = sp.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int), values={"a": np.zeros(0), "b": np.zeros((0, 2))})
    assert found.values["a"].shape == (0,) and found.values["b"].shape == (0, 2)


def test_a_file_is_verified_with_the_sphere_that_is_meant(mapped, tmp_path):
    mapped.save(tmp_path / "a.sph.ply")
    sp.write(tmp_path / "inside.off", mapped.points * [1, 1, -1], mapped.faces)
    with pytest.raises(TypeError, match="faces: the file has its own; points=FILE is its sphere"):
        sp.verify(tmp_path / "a.sph.ply", tmp_path / "inside.off")
    assert sp.verify(tmp_path / "a.sph.ply", points=tmp_path / "inside.off").reversed
    with pytest.raises(TypeError, match=r"points: .* not ndarray; verify\(read\(path\), points="):
        sp.verify(tmp_path / "a.sph.ply", points=mapped.points)


@pytest.mark.parametrize("pairs", [dict, list, iter, lambda images: zip(images, images.values())])
def test_images_are_baked_of_whatever_makes_a_dict(pairs, mapped, tmp_path):
    images = {"position": tmp_path / "p.exr", "mask": tmp_path / "m.png"}
    given = images if pairs is dict else pairs(images.items() if pairs in (list, iter) else images)
    assert [file.field for file in mapped.bake_files(given, size=16)] == ["position", "mask"]
    assert {path.name for path in tmp_path.iterdir()} == {"p.exr", "m.png"}


def test_a_refusal_lists_what_is_wrong_and_what_would_help():
    with pytest.raises(sp.MeshError, match="repair=True") as caught:
        sp.map(V, F[1:])
    [defect] = [d for d in caught.value.defects if d.fatal]
    assert isinstance(caught.value, ValueError)
    assert defect.kind == "boundary-edge" and defect.places == 3 and defect.hint
    assert set(defect.ids) == {0, 2, 4}


def test_a_torus_says_which_argument_opens_it():
    with pytest.raises(sp.MeshError, match=r"repair=dict\(longest_handle=") as caught:
        sp.map(*torus())
    wanted = str(caught.value).split("repair=")[1].split(") mends")[0]
    mapped = sp.map(*torus(), repair=eval(wanted))
    assert mapped.certificate.one_to_one and len(mapped.handles) == 1
    assert mapped.repairs and (mapped.vertex_origin < len(torus()[0])).all()


def test_what_repair_cannot_mend_is_told():
    with pytest.raises(sp.MeshError, match="remain"):
        sp.map(np.zeros((3, 3)), np.zeros((0, 3), int), repair=True)


def test_inspect_tells_of_what_map_refuses():
    found = sp.inspect(vertices_with((2, 1), np.nan), faces_with((3, 1), BIG))
    assert {d.kind for d in found.defects} >= {"index-out-of-range", "non-finite-position"}
    assert not found.is_sphere
