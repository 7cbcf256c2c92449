#!/usr/bin/python3
"""GIFTI and FreeSurfer files that sphparam writes, read by nibabel, and the other way round.

Surfaces, and numbers a vertex: curv, annot, label, MGH, MGZ, .shape.gii, .func.gii, .label.gii.

    tests/interop/run brain     (files.py PROGRAM MESH…)
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import nibabel
import numpy
from nibabel.freesurfer import (read_annot, read_geometry, read_label, read_morph_data, write_annot,
                                write_geometry, write_morph_data)

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
    for between in ("a.ply", "a.vtp", "a.vtk.gz", "a.pial", "a.surf.gii"):
        run("repair", folder / "lh.made", "-o", folder / between)
        run("repair", folder / between, "-o", folder / "lh.orig")
        back, back_faces, info, stamp = read_geometry(folder / "lh.orig", read_metadata=True, read_stamp=True)
        check((back == points).all() and (back_faces == faces).all(), between + ": mesh")
        check(stamp == "created by nobody" or between.endswith(".gii"), between + ": stamp " + stamp)
        for key, value in volume.items():
            check(numpy.all(numpy.asarray(info[key]) == numpy.asarray(value)), between + ": " + key)
    told = nibabel.load(folder / "a.surf.gii").get_arrays_from_intent("pointset")[0].metadata
    check([float(told["VolGeomC_" + axis]) for axis in "RAS"] == volume["cras"], "GIFTI: c_ras")
    check([int(told["VolGeom" + side]) for side in ("Width", "Height", "Depth")] == volume["volume"], "GIFTI: volume")
    run("map", folder / "lh.made", "--write-sphere", folder / "rh.sphere")
    info = read_geometry(folder / "rh.sphere", read_metadata=True)[2]
    check(list(info["cras"]) == volume["cras"], "the footer of a sphere")


def arrays(path):
    return [(array.data, array.intent, array.metadata.get("Name")) for array in nibabel.load(path).darrays]


def table(path):
    return [(label.key, label.label, label.rgba) for label in nibabel.load(path).labeltable.labels]


def same_arrays(one, other):
    return len(one) == len(other) and all(
        numpy.array_equal(a, b, equal_nan=True) and i == j and n == m for (a, i, n), (b, j, m) in zip(one, other))


def gifti_values(folder, count, random):
    """What nibabel writes comes back from a remesh onto the same sphere, bit for bit, with all that is said of it."""
    label_table = nibabel.gifti.GiftiLabelTable()
    for key, (name, rgba) in enumerate([("???", (0, 0, 0, 0)), ("one", (1, 0, 0, 1)), ("two", (0.25, 0.5, 0.75, 1))]):
        label = nibabel.gifti.GiftiLabel(key, *rgba)
        label.label = name
        label_table.labels.append(label)

    def array(values, intent, name):
        kind = "NIFTI_TYPE_INT32" if values.dtype.kind == "i" else "NIFTI_TYPE_FLOAT32"
        return nibabel.gifti.GiftiDataArray(values, intent=intent, datatype=kind, meta={"Name": name, "Unit": "mm"})

    keys = random.integers(0, 3, count).astype("i4")
    missing = random.standard_normal(count).astype("f4")
    missing[5] = numpy.nan
    files = {
        "a.label.gii": ([array(keys, "NIFTI_INTENT_LABEL", "k"), array(keys[::-1].copy(), "NIFTI_INTENT_LABEL", "l")], label_table),
        "a.shape.gii": ([array(missing, "NIFTI_INTENT_SHAPE", "m"), array(missing, "NIFTI_INTENT_NONE", "n")], None),
        "a.func.gii": ([array(missing + t, "NIFTI_INTENT_TIME_SERIES", "t%d" % t) for t in range(5)], None)}
    for name, (values, labels) in files.items():
        image = nibabel.gifti.GiftiImage(darrays=values, labeltable=labels,
                                         meta=nibabel.gifti.GiftiMetaData({"AnatomicalStructurePrimary": "CortexLeft"}))
        nibabel.save(image, folder / name)
    run("remesh", folder / "a.white", "--sphere", folder / "lh.sphere", "--grid", "like:" + str(folder / "lh.sphere"),
        "--data", ",".join(str(folder / name) for name in files), "-o", folder / "same" / "x.surf.gii")
    for name in files:
        back = folder / "same" / ("x." + name)
        check(same_arrays(arrays(folder / name), arrays(back)), name + ": arrays")
        check(table(folder / name) == table(back), name + ": label table")
        metadata = nibabel.load(back).meta
        check(metadata.get("AnatomicalStructurePrimary") == "CortexLeft", name + ": structure")
        check(nibabel.load(back).darrays[0].meta.get("Unit") == "mm", name + ": metadata of arrays")


def freesurfer_values(folder, count, random):
    """The same for FreeSurfer's formats, which nibabel writes and reads."""
    values = random.standard_normal(count).astype("f4")
    write_morph_data(folder / "lh.thickness", values, fnum=123)
    frames = random.standard_normal((count, 1, 1, 3)).astype("f4")
    nibabel.save(nibabel.MGHImage(frames, numpy.eye(4)), folder / "lh.frames.mgz")
    keys = random.integers(-1, 4, count)
    colours = numpy.array([[25, 5, 25, 0], [220, 20, 20, 0], [20, 220, 20, 0], [20, 20, 220, 30]])
    write_annot(folder / "lh.parcels.annot", keys, colours, ["unknown", "a", "b", "c d"], True)
    inside = sorted(random.choice(count, 40, replace=False))
    lines = "".join("%d  0 0 0 0\n" % v for v in inside)
    (folder / "lh.piece.label").write_text("#!ascii label  , from nobody\n%d\n%s" % (len(inside), lines))
    outputs = [folder / "same" / name for name in ("lh.thickness", "lh.frames.mgz", "lh.parcels.annot", "lh.piece.label", "lh.frames.mgh")]
    inputs = [folder / name.name for name in outputs[:4]] + [folder / "lh.frames.mgz"]
    run("remesh", folder / "a.white", "--sphere", folder / "lh.sphere", "--grid", "like:" + str(folder / "lh.sphere"),
        "--data", ",".join(map(str, inputs)), "--write-data", ",".join(map(str, outputs)))
    check((read_morph_data(outputs[0]) == values).all(), "curv")
    for path in (outputs[1], outputs[4]):
        check(numpy.array_equal(nibabel.load(path).get_fdata(dtype="f4"), frames), path.name)
    labels, colour_table, names = read_annot(outputs[2])
    before, colours_before, names_before = read_annot(folder / "lh.parcels.annot")
    check((labels == before).all() and (colour_table == colours_before).all() and names == names_before, "annot")
    check(sorted(read_label(outputs[3])) == inside, "label")
    places = read_geometry(folder / "a.white")[0]
    written = numpy.loadtxt(outputs[3], skiprows=2)
    check(numpy.allclose(written[:, 1:4], places[written[:, 0].astype(int)], atol=1e-6), "label: coordinates")


def values(folder):
    (folder / "same").mkdir()
    count = len(read_geometry(folder / "a.white")[0])
    random = numpy.random.default_rng(3)
    gifti_values(folder, count, random)
    freesurfer_values(folder, count, random)


for mesh in sys.argv[2:]:
    with tempfile.TemporaryDirectory() as folder:
        surfaces_of(Path(mesh), Path(folder))
        footers(Path(folder))
        values(Path(folder))
print("\n".join(problems) or "nibabel agrees on " + " ".join(sys.argv[2:]))
sys.exit(bool(problems))
