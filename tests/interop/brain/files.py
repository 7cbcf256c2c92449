#!/usr/bin/python3
"""GIFTI and FreeSurfer files that sphparam writes, read by nibabel, and the other way round.

    tests/interop/run brain     (files.py PROGRAM MESH…)
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import nibabel
import numpy
from nibabel.freesurfer import read_geometry, write_geometry

PROGRAM = sys.argv[1]
problems = []


def check(good, what):
    if not good:
        problems.append(what)


def run(*words):
    subprocess.run([PROGRAM, *map(str, words), "-q"], check=True)


def gifti(path):
    return nibabel.load(path).agg_data(("pointset", "triangle"))


def surfaces_of(mesh, folder):
    """The mesh in both formats, bit for bit the same, and its sphere, round and of radius 100."""
    for name in ("a.white", "a.surf.gii"):
        run("remesh", mesh, "--grid", "ico:4", "-o", folder / name)
    points, faces = read_geometry(folder / "a.white")
    others, other_faces = gifti(folder / "a.surf.gii")
    check((points.astype("f4") == others).all() and others.dtype == "float32", "one mesh in both formats")
    check((faces == other_faces).all(), "faces in both formats")
    for name, reader in (("lh.sphere", read_geometry), ("a.sphere.gii", gifti)):
        run("map", folder / "a.white", "-o", folder / "map.sph.ply", "--write-sphere", folder / name)
        sphere, sphere_faces = reader(folder / name)
        lengths = numpy.linalg.norm(sphere.astype("f8"), axis=1)
        check(numpy.abs(lengths - 100).max() < 1e-4, name + ": radius 100")
        check((sphere_faces == faces).all(), name + ": faces")
        run("verify", folder / "a.white", folder / name)


def footers(folder):
    """What nibabel says of a volume comes back as it was, after a way through other formats."""
    volume = {"head": [2, 0, 20], "valid": "1  # volume info valid", "filename": "../mri/filled.mgz",
              "volume": [256, 256, 256], "voxelsize": [1.0, 1.0, 1.0], "xras": [-1.0, 0.0, 0.0],
              "yras": [0.0, 0.0, -1.0], "zras": [0.0, 1.0, 0.0], "cras": [5.399, 18.0, 0.25]}
    points, faces = read_geometry(folder / "a.white")
    write_geometry(folder / "lh.made", points, faces, create_stamp="created by nobody", volume_info=volume)
    for between in ("a.ply", "a.vtp", "a.vtk.gz", "a.pial"):
        run("repair", folder / "lh.made", "-o", folder / between)
        run("repair", folder / between, "-o", folder / "lh.orig")
        back, back_faces, info, stamp = read_geometry(folder / "lh.orig", read_metadata=True, read_stamp=True)
        check((back == points).all() and (back_faces == faces).all(), between + ": mesh")
        check(stamp == "created by nobody", between + ": stamp " + stamp)
        for key, value in volume.items():
            check(numpy.all(numpy.asarray(info[key]) == numpy.asarray(value)), between + ": " + key)


for mesh in sys.argv[2:]:
    with tempfile.TemporaryDirectory() as folder:
        surfaces_of(Path(mesh), Path(folder))
        footers(Path(folder))
print("\n".join(problems) or "nibabel agrees on " + " ".join(sys.argv[2:]))
sys.exit(bool(problems))
