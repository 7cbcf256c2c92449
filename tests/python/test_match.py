"""One surface onto another."""

import json

import numpy as np
import pytest
from shapes import potato

import sphparam as sp


@pytest.fixture(scope="module")
def maps():
    vertices, faces = potato(3)
    longer = vertices * [1.0, 1.3, 0.8] + 0.1 * np.sin(2 * vertices[:, [1, 2, 0]])
    return sp.map(vertices, faces, values={"height": vertices[:, 2]}), sp.map(longer, faces)


def landmarks(maps):
    """Of both, the vertices farthest along the axes: the meshes have the same ones."""
    rows = maps[0].vertices
    return [(int(v), int(v)) for axis in range(3) for v in (rows[:, axis].argmax(), rows[:, axis].argmin())]


def test_a_surface_matched_with_itself_stays_where_it_is(maps):
    s = sp.match(maps[0], maps[0], landmarks(maps))
    assert np.abs(s.carry("vertices") - maps[0].vertices).max() < 1e-6
    assert s.distortion().symmetric_dirichlet == pytest.approx(4)


def test_landmarks_are_met_exactly_and_both_maps_are_proved(maps):
    s = sp.match(*maps, landmarks(maps))
    assert not s.residuals.any() and s.source.certificate.one_to_one
    for a, b in landmarks(maps):
        assert np.allclose(s.carry("vertices")[a], maps[1].vertices[b], atol=1e-9)
    assert (s.target.points == maps[1].points).all() and (s.target.vertices == maps[1].vertices).all()


def test_landmarks_may_be_points_near_the_vertices(maps):
    pairs = landmarks(maps)
    points = np.array([(1.001 * maps[0].vertices[a], 0.999 * maps[1].vertices[b]) for a, b in pairs])
    by_points, by_numbers = sp.match(*maps, points), sp.match(*maps, pairs)
    assert (by_points.source.points == by_numbers.source.points).all()
    points[2, 1] *= 1.5
    with pytest.warns(sp.LossWarning, match="landmarks: a point is .* away from the nearest vertex of"):
        sp.match(*maps, points)
    with pytest.raises(ValueError, match="landmarks: two vertices a row"):
        sp.match(*maps, np.zeros((3, 3, 2), int))


def test_forth_and_back_are_what_carry_and_carry_back_read(maps):
    s = sp.match(*maps, landmarks(maps))
    face, weights = s.back()
    mixed = (s.source.values["height"][s.source.faces[face]] * weights).sum(axis=1)
    assert np.allclose(s.carry_back("height"), mixed)
    face, weights = s.forth()
    places = np.einsum("ik,ikd->id", weights, s.target.vertices[s.target.faces[face]])
    assert np.allclose(s.carry("vertices"), places)


def test_a_morph_has_both_shapes_and_other_names_and_places_are_refused(maps, tmp_path):
    s = sp.match(*maps, landmarks(maps))
    path = tmp_path / "morph.glb"
    with pytest.warns(sp.LossWarning, match="height"):
        s.morph(path, place="as-is", up="y", image_size=64)
    data = path.read_bytes()
    gltf = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    primitive = gltf["meshes"][0]["primitives"][0]
    base = gltf["accessors"][primitive["attributes"]["POSITION"]]
    change = gltf["accessors"][primitive["targets"][0]["POSITION"]]
    assert base["count"] == change["count"] >= len(maps[0].vertices)
    moved = s.carry("vertices") - maps[0].vertices
    assert np.allclose(change["max"], moved.max(axis=0), atol=1e-5)
    with pytest.raises(ValueError, match="glb"):
        s.morph(tmp_path / "morph.obj")
    with pytest.raises(ValueError, match="place"):
        s.morph(path, place="here")


def test_the_same_for_any_number_of_threads(maps):
    one, two = (sp.match(*maps, landmarks(maps), threads=n) for n in (1, 2))
    assert (one.source.points == two.source.points).all() and one.energy == two.energy


def test_a_mirror_image_is_told_and_matched_on_request(maps):
    mirrored = sp.map(maps[0].vertices * [-1, 1, 1], maps[0].faces[:, ::-1])
    with pytest.raises(sp.NotCertified, match="mirror"):
        sp.match(mirrored, maps[0], landmarks(maps))
    s = sp.match(mirrored, maps[0], landmarks(maps), mirror=True)
    assert s.distortion().symmetric_dirichlet == pytest.approx(4, abs=1e-4)  # an isometry was to be found
    assert np.abs(s.carry("vertices") - maps[0].vertices).max() < 0.005


@pytest.mark.parametrize("wrong, what, error", [
    ([(0, 10**9)], "no vertex 1000000000", ValueError),
    ([(-1, 0)], "no vertex -1", ValueError),
    ([(0, 1), (0, 2)], "", ValueError),
    ([(0.5, 1)], "whole numbers", TypeError),
    ([0, 1, 2], "#×2", ValueError),
    ([(0, 1), (2,)], "#×2|whole numbers", (ValueError, TypeError)),
    ([("a", "b")], "whole numbers", TypeError),
])
def test_wrong_landmarks_are_refused(maps, wrong, what, error):
    with pytest.raises(error, match=what):
        sp.match(*maps, wrong)


def test_arrays_are_no_maps(maps):
    with pytest.raises(TypeError, match="target: a sphparam.SphereMap is needed, not ndarray"):
        sp.match(maps[0], maps[1].vertices)
    with pytest.raises(ValueError, match="energy"):
        sp.match(*maps, landmarks(maps), energy="least")


def test_features_come_to_lie_on_each_other(maps):
    heights = maps[1].vertices[:, 2]
    s = sp.match(*maps, features=("height", heights))
    assert s.made_by == "features" and s.source.certificate.one_to_one
    assert np.corrcoef(s.carry(heights), maps[0].values["height"])[0, 1] > 0.95
    assert s.agreement > 0.95 and 0 <= s.confidence <= 1
    assert sp.match(*maps, features=("height", heights), alike=True).agreement > 0.95
    with pytest.raises(ValueError, match="alike: landmarks say already"):
        sp.match(*maps, landmarks(maps), alike=True)
    both = sp.match(*maps, landmarks(maps), features=("height", heights), feature_weight=1)
    assert not both.residuals.any()
    with pytest.raises(ValueError, match=r"features\[1\]"):
        sp.match(*maps, features=("height", heights[:5]))
    for wrong, words in [
        (heights, "a pair is needed, .* not ndarray"),
        (("height",), "a pair is needed, .* not 1 things"),
        ({"height": heights}, "a pair is needed, .* not dict"),
        (("height", np.c_[heights, heights]), "as many columns .* not 1 and 2"),
        (("height", np.zeros((len(heights), 1, 1))), r"features\[1\]: .* rows"),
        (("no such", heights), "no such"),
    ]:
        with pytest.raises(ValueError, match=words):
            sp.match(*maps, features=wrong)
    with pytest.raises(TypeError, match=r"features\[0\]: an array is needed, not NoneType"):
        sp.match(*maps, features=(None, heights))
    with pytest.raises(TypeError, match="feature_weight: a number is needed"):
        sp.match(*maps, features=("height", heights), feature_weight="much")
    with pytest.raises(ValueError, match="same everywhere"):
        sp.match(*maps, features=("height", np.ones(len(heights))))
    with pytest.raises(ValueError, match="weight"):
        sp.match(*maps, features=("height", heights), feature_weight=0)


def test_a_coarse_mesh_is_mapped_like_a_fine_one_that_lies_where_it_does(maps):
    vertices, faces = potato(4)
    fine = sp.map(vertices, faces, align=None)
    low = maps[0].like(fine)
    assert low.certificate.one_to_one and (low.faces == maps[0].faces).all()
    face, weights = fine.locate(low.points)
    there = np.einsum("ik,ikd->id", weights, fine.vertices[fine.faces[face]])
    assert np.abs(there - low.vertices).max() < 0.02
    away, _ = potato(3)
    with pytest.raises(ValueError, match="moved or scaled"):
        sp.map(away + 10.0, faces if len(away) == len(vertices) else potato(3)[1]).like(fine)
