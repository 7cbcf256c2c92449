"""A closed surface about any triangles, and what they show on it."""

import numpy as np
import pytest
from shapes import potato

import sphparam as sp


@pytest.fixture(scope="module")
def soup():
    """Two potatoes apart, one of them open."""
    vertices, faces = potato(3)
    moved = vertices + [4, 0, 0]
    return np.vstack([vertices, moved]), np.vstack([faces[: len(faces) // 2], faces + len(vertices)])


def test_open_parts_become_one_surface_that_maps(soup):
    found = sp.wrap(*soup, resolution=64)
    assert found.parts == 2 and found.outside == 0 and found.kept_share == 1 and found.added_share > 0
    assert found.mesh.format == "arrays" and sp.map(found.mesh).certificate.one_to_one
    assert found.distance == 2 * found.voxel
    assert abs(found.apart.forth.mean - found.distance) < found.voxel
    assert found.lattice[0] == max(found.lattice) > 64
    assert not found.skin and found.volume == pytest.approx(sp.inspect(found.mesh).volume)


def test_the_largest_part_alone_and_fewer_triangles(soup):
    found = sp.wrap(*soup, resolution=64, largest=True, triangles=500)
    assert found.kept_share < 1 and found.outside > 0
    assert len(found.mesh.faces) == pytest.approx(500, abs=20)
    assert found.mesh.vertices[:, 0].min() > 1  # the closed one


def test_triangles_of_a_wrap_that_cross_are_counted_and_told():
    vertices, faces = potato(3)
    sheet = vertices * [1, 1, 0.02], faces[::2]  # two sides, nearly in one place
    with pytest.warns(sp.LossWarning, match=r"of the wrap cross others .*\(triangles=0\) and no gap none do"):
        found = sp.wrap(*sheet, resolution=48, gap=1e-3)
    assert found.crossings == sp.self_crossings(found.mesh).pairs > 0
    assert sp.wrap(*sheet, resolution=48).crossings == 0


def test_drawn_in_a_solid_has_its_size():
    found = sp.wrap(*potato(4), resolution=64, gap=1e-3)
    assert found.gap == 1e-3 and found.insides == 1 and found.cavities == 0
    assert found.apart.forth.mean < 2e-3 and found.apart.back.max < found.voxel
    whole = sp.wrap(*potato(4), resolution=64)
    assert whole.gap == whole.distance and (whole.mesh.faces == found.mesh.faces).all()


def test_the_same_for_any_number_of_threads(soup):
    found = sp.wrap(*soup, resolution=32, threads=1)
    again = sp.wrap(*soup, resolution=32, threads=2)
    assert (found.mesh.vertices == again.mesh.vertices).all() and (found.mesh.faces == again.mesh.faces).all()


def test_what_the_soup_shows_is_baked_on_it(soup):
    vertices, faces = soup
    colour = np.where(vertices[:, :1] > 2, [[255, 0, 0]], [[0, 0, 255]]).astype(np.uint8)
    shown = sp.Mesh(vertices, faces, values={"color": colour})
    mapped = sp.map(sp.wrap(shown, resolution=48).mesh)
    image = mapped.bake("vcolor", size=128, surface=shown)
    place = mapped.bake("position", size=128)[..., 0]
    assert (image[place > 3][:, 0] > 0.9).all() and (image[place < 1][:, 2] > 0.9).all()


def test_what_makes_no_sense_is_refused(soup):
    with pytest.raises(ValueError, match="voxel and resolution"):
        sp.wrap(*soup, voxel=0.1, resolution=32)
    with pytest.raises(ValueError, match="voxel"):
        sp.wrap(*soup, voxel=1e-9)
    with pytest.raises(ValueError, match="distance"):
        sp.wrap(*soup, voxel=0.1, distance=-1)
    with pytest.raises(sp.MeshError):
        sp.wrap(np.zeros((0, 3)), np.zeros((0, 3), int))
    with pytest.raises(sp.Cancelled):
        sp.wrap(*soup, resolution=64, progress=lambda stage, fraction: False)
