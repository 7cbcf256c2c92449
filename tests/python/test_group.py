"""Shapes beside shapes."""

import numpy as np
import pytest
from shapes import potato

import sphparam as sp

LENGTHS = (0.8, 1.0, 1.3)


@pytest.fixture(scope="module")
def shapes():
    vertices, faces = potato(3)
    turn = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    return [sp.map((vertices * [2 * t, 1, 0.7]) @ (turn if t > 1 else np.eye(3)) + t, faces) for t in LENGTHS]


@pytest.fixture(scope="module")
def group(shapes):
    return sp.group(shapes, start="rotation", grid="ico:4")


def test_the_length_is_the_first_mode_and_shapes_are_the_mean_and_their_modes(group):
    assert group.shares[0] > 0.95
    order = group.scores[:, 0] * np.sign(group.scores[2, 0])
    assert (np.diff(order) > 0.3).all()
    rebuilt = group.mean.vertices + np.einsum("nk,kvd->nvd", group.scores, group.modes)
    assert np.allclose(rebuilt, group.aligned, atol=1e-9)
    assert np.allclose(group.along(0, 1.0), group.mean.vertices + group.modes[0])


def test_every_map_is_proved_and_figures_are_those_of_the_shapes(group, shapes):
    assert all(shape.certificate.one_to_one for shape in [*group.shapes, group.mean, group.template])
    assert all((a.vertices == b.vertices).all() for a, b in zip(group.shapes, shapes))
    away = np.linalg.norm(group.aligned - group.mean.vertices, axis=2)
    assert np.allclose(group.deviation, np.sqrt((away**2).sum(0) / 2))
    assert group.weights.sum() == pytest.approx(1)
    assert (group.distances == group.distances.T).all() and group.starts == ["template", "rotation", "rotation"]


def size_by_area(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    centroid = (area[:, None] * (a + b + c)).sum(0) / 3 / area.sum()
    a, b, c = a - centroid, b - centroid, c - centroid
    squares = sum((x * y).sum(1) for x, y in ((a, a), (b, b), (c, c), (a, b), (b, c), (c, a))) / 6
    return np.sqrt((area * squares).sum() / area.sum())


def test_sizes_are_those_of_each_shape_alone_and_scale_brings_all_to_their_mean(shapes, group):
    faces = group.mean.faces
    assert group.sizes == pytest.approx([size_by_area(shape, faces) for shape in group.aligned])
    scaled = sp.group(shapes, start="rotation", grid="ico:4", scale=True)
    assert scaled.sizes == pytest.approx(group.sizes, rel=1e-2)  # the mean that maps are moved to is another
    one = np.mean(scaled.sizes)
    assert [size_by_area(shape, faces) for shape in scaled.aligned] == pytest.approx([one] * len(shapes))


def test_landmarks_of_the_template_are_found_on_all_shapes(group, shapes):
    places = group.landmarks([3, 40, 3])
    assert places.points.shape == (3, 3, 3) and places.faces.shape == places.nearest.shape == (3, 3)
    assert (places.points[0, :2] == shapes[0].vertices[[3, 40]]).all() and places.nearest[0].tolist() == [3, 40, 3]
    for i, shape in enumerate(group.shapes):
        corners = shape.vertices[shape.faces[places.faces[i]]]
        assert np.allclose((places.weights[i][..., None] * corners).sum(1), places.points[i])
        away = np.linalg.norm(shape.vertices[:, None] - places.points[i], axis=2)
        assert (away.argmin(0) == places.nearest[i]).all()
    assert (places.points[:, 0] == places.points[:, 2]).all()
    near = group.landmarks(1.001 * group.template.vertices[[3, 40, 3]])
    assert all((a == b).all() for a, b in zip(near, places))
    assert group.landmarks([]).points.shape == (3, 0, 3)
    with pytest.raises(ValueError, match="vertices: 0 to"):
        group.landmarks([len(group.template.vertices)])
    with pytest.raises(TypeError, match="vertices: a whole number"):
        group.landmarks([0.5])
    with pytest.raises(TypeError, match="vertices: a list of vertices"):
        group.landmarks(3)


def test_held_shapes_have_no_energy_and_all_have_a_confidence_and_grow(shapes, group):
    held = sp.group(shapes, start="rotation", hold=True, grid="ico:3")
    assert np.isnan(held.energies).all() and held.confidences[0] == 1
    assert (np.array(group.energies[1:]) >= 2).all() and ((0 <= np.array(group.confidences)) & (np.array(group.confidences) <= 1)).all()
    assert group.growth.shape == (3, len(group.mean.vertices))
    for aligned, growth in zip(group.aligned, group.growth):
        assert (growth == sp.growth(group.mean, (aligned, group.mean.faces))[1]).all()
    other = sp.group(shapes, start="rotation", grid="ico:3", energy="angle-and-area")
    assert other.energies[1] != sp.group(shapes, start="rotation", grid="ico:3").energies[1]
    with pytest.raises(ValueError, match="energy: no 'rubber'"):
        sp.group(shapes, energy="rubber")


def test_numbers_of_several_shapes_have_a_mean():
    vertices, faces = potato(2)
    number = np.arange(len(vertices), dtype=float)
    shapes = [sp.map(vertices, faces, values=values) for values in ({"sulc": number}, {"sulc": 3 * number, "b": number}, {})]
    found = sp.group(shapes, start="maps", hold=True, grid="template").scalars
    assert list(found) == ["sulc"] and found["sulc"].name == "sulc" and found["sulc"].shapes.tolist() == [0, 1]
    assert (found["sulc"].mean == 2 * number).all()
    assert np.allclose(found["sulc"].deviation, np.sqrt(2) * number, atol=0)


def test_the_same_for_any_number_of_threads(shapes, group):
    one = sp.group(shapes, start="rotation", grid="ico:4", threads=1)
    assert (one.aligned == group.aligned).all()


def test_what_makes_no_sense_is_refused(shapes):
    with pytest.raises(ValueError, match="shapes"):
        sp.group([])
    with pytest.raises(ValueError, match="start"):
        sp.group(shapes, start="luck")
    with pytest.raises(ValueError, match="ico"):
        sp.group(shapes, grid="ball")
    with pytest.raises(TypeError, match=r"shapes\[0\]"):
        sp.group([(shapes[0].vertices, shapes[0].faces)])
