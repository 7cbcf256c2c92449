"""What the program writes, proved by code that it does not know; and what is broken by hand, refused."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest
from chart_proof import prove_chart
from files import map_of_ply, read_obj, read_ply
from sphere_proof import prove_map
from surface import Refused
from verify import proofs_of

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = os.environ["SPHPARAM_PROGRAM"]
WAYS = {"draft": ["--quality", "draft"], "conformal": ["--balance", "conformal"], "curvilinear": ["--method", "curvilinear"],
        "no poles": ["--poles", "none"], "default": []}


def sphparam(*words):
    subprocess.run([PROGRAM, *map(str, words), "--quiet"], check=True)


@pytest.fixture(scope="module")
def shapes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("shapes")
    subprocess.run([sys.executable, HERE.parent / "campaign" / "make_shapes.py", folder, "--count", "5", "--bad", "0",
                    "--triangles", "2000", "--seed", "97"], check=True)
    return sorted(folder.glob("*.ply"))


@pytest.mark.parametrize("way", WAYS)
def test_maps_and_charts_of_all_kinds_of_files_are_proved(shapes, tmp_path, way):
    mesh = shapes[list(WAYS).index(way)]
    mapped = tmp_path / "m.sph.ply"
    sphparam("map", mesh, "-o", mapped, "--write-sphere", tmp_path / "m.sphere.surf.gii", *WAYS[way])
    sphparam("export", mapped, "-o", tmp_path / "m.export.obj")
    sphparam("export", mapped, "-o", tmp_path / "m.export.ply", "--refine-poles", "3")
    sphparam("remesh", mapped, "--grid", "ico:f=12", "-o", tmp_path / "low.sph.ply")
    for name in ("m.sph.ply", "m.sphere.surf.gii", "m.export.obj", "m.export.ply", "low.sph.ply"):
        proved, failed = proofs_of(tmp_path / name)
        assert proved and not failed, (name, failed)


def test_one_vertex_elsewhere_is_seen(shapes, tmp_path):
    sphparam("map", shapes[0], "-o", tmp_path / "m.sph.ply")
    rays, triangles = map_of_ply(read_ply(tmp_path / "m.sph.ply")[0])
    prove_map(rays, triangles)
    rays[7] = tuple(-x for x in rays[7])
    with pytest.raises(Refused, match="not positive"):
        prove_map(rays, triangles)


def test_one_corner_elsewhere_is_seen(shapes, tmp_path):
    sphparam("map", shapes[0], "-o", tmp_path / "m.sph.ply")
    sphparam("export", tmp_path / "m.sph.ply", "-o", tmp_path / "m.obj")
    triangles, corners, count = read_obj(tmp_path / "m.obj")
    prove_chart(triangles, corners, count)
    face = next(f for f, c in enumerate(corners) if all(0.1 < v < 0.9 for _, v in c))
    corners[face][0] = (corners[face][0][0], corners[face][0][1] + 1e-12)
    with pytest.raises(Refused):
        prove_chart(triangles, corners, count)


def test_the_command_says_what_it_proved_and_ends_with_1_where_one_fails(shapes, tmp_path):
    good = tmp_path / "good.sph.ply"
    sphparam("map", shapes[0], "-o", good)
    command = [sys.executable, HERE / "verify.py"]
    run = subprocess.run([*command, good], capture_output=True, text=True, check=False)
    assert run.returncode == 0 and run.stdout.endswith("1 proved, 0 refused\n")
    assert subprocess.run([*command, shapes[0]], capture_output=True, check=False).returncode == 1  # no map in it
    shutil.copy(good, tmp_path / "two.sph.ply")
    run = subprocess.run([*command, "--below", tmp_path], capture_output=True, text=True, check=False)
    assert run.stdout.endswith("2 proved, 0 refused\n")
