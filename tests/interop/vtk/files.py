#!/usr/bin/python3
"""What sphparam writes for VTK, read by VTK; what VTK writes, in all its ways, read by sphparam.

    tests/interop/run vtk     (files.py PROGRAM MESH…)
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

PROGRAM = sys.argv[1]
problems = []


def check(good, what):
    if not good:
        problems.append(what)


def run(*words):
    subprocess.run([PROGRAM, *map(str, words), "-q"], check=True)


def read(path):
    reader = vtk.vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtk.vtkPolyDataReader()
    if path.suffix == ".vtk":
        reader.ReadAllScalarsOn()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def triangles(data):
    return vtk_to_numpy(data.GetPolys().GetData()).reshape(-1, 4)[:, 1:]


def column(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def plain_ply(path):
    """Positions and triangles of a PLY that sphparam wrote, and its columns by name."""
    with open(path, "rb") as file:
        names, counts = [], {}
        element = None
        for line in iter(file.readline, b"end_header\n"):
            word = line.decode("latin-1").split()
            if word[0] == "element":
                element = word[1]
                counts[element] = int(word[2])
            elif word[0] == "property" and element == "vertex":
                names.append((word[2], {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4"}[word[1]]))
        return numpy.fromfile(file, numpy.dtype(names), counts["vertex"])


def written_by_us(mesh, folder):
    """A map goes into .vtk and .vtp as into .ply, bit for bit, with a name for each of its numbers."""
    run("map", mesh, "-o", folder / "map.sph.ply")
    wanted = plain_ply(folder / "map.sph.ply")
    for name in ("map.vtk", "map.vtp", "map.vtp.gz"):
        run("map", mesh, "-o", folder / name)
        run("verify", folder / name)
        if name.endswith(".gz"):
            continue
        data = read(folder / name)
        check(data.GetNumberOfPoints() == len(wanted), name + ": points")
        for axis, key in enumerate("xyz"):
            check((points(data)[:, axis] == wanted[key]).all(), name + ": " + key)
        for key in ("sx", "sy", "sz", "theta", "phi"):
            check((column(data, key) == wanted[key]).all(), name + ": " + key)
        comments = data.GetFieldData().GetAbstractArray("comments")
        check(comments and any("verdict" in comments.GetValue(i) for i in range(comments.GetNumberOfValues())),
              name + ": comments")


def rich(data):
    """The same mesh with arrays of many kinds."""
    count, cells = data.GetNumberOfPoints(), data.GetNumberOfCells()
    for name, values in (("signed char", numpy.arange(count) % 100 - 50), ("big", numpy.arange(count) * 2**33)):
        kind = vtk.VTK_CHAR if name != "big" else vtk.VTK_LONG_LONG
        array = numpy_to_vtk(values.astype("i1" if name != "big" else "i8"), True, kind if name == "big" else vtk.VTK_SIGNED_CHAR)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    vectors = numpy_to_vtk(numpy.random.default_rng(1).random((count, 3)), True)
    vectors.SetName("v")
    for k, axis in enumerate("xyz"):
        vectors.SetComponentName(k, axis)
    data.GetPointData().AddArray(vectors)
    labels = numpy_to_vtk(numpy.arange(cells, dtype="i4"), True)
    labels.SetName("label")
    data.GetCellData().AddArray(labels)
    return data


def ways_of_vtk(data, folder):
    for binary in (True, False):
        for version in (42, 51):
            writer = vtk.vtkPolyDataWriter()
            writer.SetFileVersion(version)
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            yield writer, folder / ("legacy_%d_%d.vtk" % (binary, version))
    for mode in ("Ascii", "Binary", "Appended"):
        for compressed in (True, False):
            for encoded in (True, False) if mode == "Appended" else (True,):
                for header in (32, 64):
                    for order in ("Little", "Big"):
                        writer = vtk.vtkXMLPolyDataWriter()
                        getattr(writer, "SetDataModeTo" + mode)()
                        writer.SetCompressor(vtk.vtkZLibDataCompressor() if compressed else None)
                        writer.SetEncodeAppendedData(encoded)
                        getattr(writer, "SetHeaderTypeToUInt%d" % header)()
                        getattr(writer, "SetByteOrderTo%sEndian" % order)()
                        name = "_".join(map(str, (mode, compressed, encoded, header, order)))
                        yield writer, folder / (name + ".vtp")


def written_by_vtk(mesh, folder):
    run("map", mesh, "-o", folder / "plain.vtp")
    data = rich(read(folder / "plain.vtp"))
    wanted = points(data)
    for writer, path in ways_of_vtk(data, folder):
        writer.SetInputData(data)
        writer.SetFileName(str(path))
        writer.Write()
        back = folder / (path.stem + "_back.vtp")
        run("verify", path)
        run("repair", path, "-o", back)
        again = read(back)
        ascii_digits = 1e-5 if "legacy_0" in path.name or "Ascii" in path.name else 0
        check(numpy.abs(points(again) - wanted).max() <= ascii_digits * numpy.abs(wanted).max(), path.name + ": points")
        check((triangles(again) == triangles(data)).all(), path.name + ": triangles")
        check((column(again, "big") == numpy.arange(len(wanted)) * 2**33).all(), path.name + ": 64-bit numbers")
        check(again.GetPointData().HasArray("signed_char"), path.name + ": a name with a blank")
        check(again.GetPointData().HasArray("v_x") or again.GetPointData().HasArray("v_0"), path.name + ": vectors")
        check((vtk_to_numpy(again.GetCellData().GetArray("label")) == numpy.arange(data.GetNumberOfCells())).all(),
              path.name + ": cells")


for mesh in sys.argv[2:]:
    with tempfile.TemporaryDirectory() as folder:
        written_by_us(Path(mesh), Path(folder))
        written_by_vtk(Path(mesh), Path(folder))
print("\n".join(problems) or "VTK agrees on " + " ".join(sys.argv[2:]))
sys.exit(bool(problems))
