#!/usr/bin/python3
"""Surfaces, spheres, metrics and labels of sphparam in wb_command, and its resampling beside Workbench's.

    tests/interop/run brain     (workbench.py PROGRAM SURFACE…)

Each wb_command must end with 0 and warn of nothing. Prints what was found, a line a figure.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import nibabel
import numpy
from nibabel.freesurfer import write_annot, write_morph_data

PROGRAM = sys.argv[1]
MOST_METRIC, LEAST_LABELS, MOST_POSITION = 1e-4, 0.999, 1e-4
TURNS = (0.37, 0.7, 1.1, 1.9, 2.6)  # of the new sphere: ADAP_BARY_AREA hangs on the last bit of coordinates
problems = []


def check(good, what):
    if not good:
        problems.append(what)


def run(*words):
    subprocess.run([PROGRAM, *map(str, words), "-q"], check=True)


def workbench(*words):
    done = subprocess.run(["wb_command", *map(str, words)], capture_output=True, text=True)
    said = done.stdout + done.stderr
    check(done.returncode == 0 and "warning" not in said.lower(), "%s: %d %s" % (words[0], done.returncode, said))


def columns(path):
    return numpy.column_stack([array.data for array in nibabel.load(path).darrays])


def icosphere(halvings, turn):
    """Vertices and triangles of an icosahedron, halved, turned so that no vertex is anywhere by chance."""
    g = (1 + 5**0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
              (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    points = [numpy.array(p, float) / numpy.linalg.norm(p) for p in points]
    for _ in range(halvings):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append((points[a] + points[b]) / numpy.linalg.norm(points[a] + points[b]))
            return middles[key]

        for a, b, c in faces:
            d, e, f = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, d, f), (d, b, e), (f, e, c), (d, e, f)]
        faces = finer
    c, s = numpy.cos(turn), numpy.sin(turn)
    rotation = numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ numpy.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return numpy.array(points) @ rotation.T, numpy.array(faces)


def save_sphere(path, points, faces):
    """As somebody else would: no metadata at all."""
    nibabel.save(nibabel.gifti.GiftiImage(darrays=[
        nibabel.gifti.GiftiDataArray((100 * points).astype("f4"), intent="NIFTI_INTENT_POINTSET"),
        nibabel.gifti.GiftiDataArray(faces.astype("i4"), intent="NIFTI_INTENT_TRIANGLE")]), path)


def make_data(folder, places):
    """A measure, noise, a series, and a parcellation, as FreeSurfer and nibabel write them."""
    random = numpy.random.default_rng(7)
    unit = places / numpy.abs(places).max()
    smooth = numpy.sin(5 * unit[:, 0]) + unit[:, 1] * unit[:, 2]
    write_morph_data(folder / "lh.thickness", smooth.astype("f4"))
    write_morph_data(folder / "lh.noise", random.standard_normal(len(places)).astype("f4"))
    keys = (numpy.floor(3 * unit).astype(int) @ [1, 7, 31]) % 20
    table = numpy.column_stack([40 + 10 * numpy.arange(20), 255 - 7 * numpy.arange(20), 3 * numpy.arange(20),
                                numpy.zeros(20)]).astype(int)
    write_annot(folder / "lh.parcels.annot", keys, table, ["???"] + ["parcel %d" % i for i in range(1, 20)], True)
    series = [nibabel.gifti.GiftiDataArray((smooth * t).astype("f4"), intent="NIFTI_INTENT_TIME_SERIES",
                                           datatype="NIFTI_TYPE_FLOAT32") for t in (1, 2, 3)]
    nibabel.save(nibabel.gifti.GiftiImage(darrays=series), folder / "lh.series.func.gii")


DATA = {"thickness": "shape", "noise": "shape", "series": "func", "parcels": "label"}


def compare(folder, method, areas):
    """Each file of data, resampled by both."""
    for name, kind in DATA.items():
        here = columns(folder / "new" / ("lh.%s.%s.gii" % (name, kind)))
        command = "-label-resample" if kind == "label" else "-metric-resample"
        there = folder / ("workbench.%s.%s.gii" % (name, kind))
        workbench(command, folder / ("lh.%s.%s.gii" % (name, kind)), folder / "lh.sphere.surf.gii",
                  folder / "new.sphere.surf.gii", method, there, *areas)
        there = columns(there)
        if kind == "label":
            share = (here == there).mean()
            print("  %s %s: labels agree at %.4f %% of %d vertices" % (method, name, 100 * share, len(here)))
            check(share >= LEAST_LABELS, "labels of %s" % name)
        else:
            apart = numpy.abs(here - there).max(axis=1) / (there.max() - there.min())
            near = (apart <= MOST_METRIC).mean()
            print("  %s %s: at most %.2g of the range apart, %.4f %% of vertices within %g" %
                  (method, name, apart.max(), 100 * near, MOST_METRIC))
            check(near == 1, "%s by %s: %.4f %% near" % (name, method, 100 * near))


def one_surface(surface, halvings, turn):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "new").mkdir()
        run("repair", surface, "-o", folder / "lh.white")
        places = nibabel.freesurfer.read_geometry(folder / "lh.white")[0]
        make_data(folder, places)
        data = ",".join(str(folder / file) for file in ("lh.thickness", "lh.noise", "lh.series.func.gii", "lh.parcels.annot"))
        run("map", folder / "lh.white", "--write-sphere", folder / "lh.sphere.surf.gii")
        run("repair", folder / "lh.white", "--data", ",".join(
            str(folder / file) for file in ("lh.thickness", "lh.noise", "lh.parcels.annot")), "-o", folder / "lh.white.surf.gii")
        save_sphere(folder / "new.sphere.surf.gii", *icosphere(halvings, turn))
        for sample, method in (("barycentric", "BARYCENTRIC"), ("adap-bary-area", "ADAP_BARY_AREA")):
            shutil.rmtree(folder / "new")  # data beside a surface replaces nothing
            (folder / "new").mkdir()
            run("remesh", folder / "lh.white", "--sphere", folder / "lh.sphere.surf.gii", "--grid",
                "like:" + str(folder / "new.sphere.surf.gii"), "--data", data, "--sample", sample,
                "-o", folder / "new/lh.white.surf.gii")
            areas = ["-area-surfs", folder / "lh.white.surf.gii", folder / "new/lh.white.surf.gii"]
            compare(folder, method, areas if method == "ADAP_BARY_AREA" else [])
        workbench("-surface-resample", folder / "lh.white.surf.gii", folder / "lh.sphere.surf.gii",
                  folder / "new.sphere.surf.gii", "BARYCENTRIC", folder / "workbench.surf.gii")
        apart = numpy.abs(nibabel.load(folder / "new/lh.white.surf.gii").agg_data("pointset") -
                          nibabel.load(folder / "workbench.surf.gii").agg_data("pointset")).max()
        apart /= numpy.ptp(places, axis=0).max()
        print("  surface: vertices at most %.2g of its size apart" % apart)
        check(apart < MOST_POSITION, "surface: %g apart" % apart)
        workbench("-surface-distortion", folder / "lh.white.surf.gii", folder / "lh.sphere.surf.gii",
                  folder / "distortion.shape.gii")
        workbench("-cifti-create-dense-scalar", folder / "x.dscalar.nii", "-left-metric", folder / "lh.thickness.shape.gii")
        workbench("-cifti-create-label", folder / "x.dlabel.nii", "-left-label", folder / "lh.parcels.label.gii")


for surface, halvings in (word.rsplit(":", 1) for word in sys.argv[2:]):
    for turn in TURNS:
        print("%s, turned by %g:" % (Path(surface).name, turn))
        one_surface(surface, int(halvings), turn)
print("\n".join(problems) or "Workbench agrees")
sys.exit(bool(problems))
