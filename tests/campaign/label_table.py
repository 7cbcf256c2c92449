#!/usr/bin/env python3
"""What becomes of structures in label volumes: marching cubes of each, mapped as it is and with --repair.

    label_table.py SPHPARAM FOLDER [--records FILE] [--least-voxels 300] > table.md

FOLDER has label volumes as NIfTI; every label of each is a structure, four ways:

    raw       marching cubes of its mask (VTK's flying edges, at one half)
    discrete  VTK's discrete marching cubes of the label
    filled    marching cubes of its largest part (26 neighbours), cavities filled
    smoothed  the same after a Gaussian of one voxel

Each is mapped as it is, else with `--repair` at its default limits, else (for `--repair` drops no more than
specks unasked) all its parts with `--all-components` too; every map is verified again. With --records lines of JSON are kept there, and what
is in them is not done again. Needs python3-vtk9, python3-nibabel and python3-scipy.
"""

import argparse
import collections
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

import nibabel
import numpy
import scipy.ndimage
import vtk
from vtk.util import numpy_support

WAYS = ["raw", "discrete", "filled", "smoothed"]


def structures(path, least_voxels):
    """Label, its box with a margin, and the spacing."""
    image = nibabel.load(path)
    volume = numpy.squeeze(numpy.asanyarray(image.dataobj))
    if volume.ndim != 3:
        return
    volume = numpy.rint(volume).astype(numpy.int32)
    labels, counts = numpy.unique(volume, return_counts=True)
    for label, count in zip(labels, counts):
        if label <= 0 or count < least_voxels:
            continue
        box = scipy.ndimage.find_objects((volume == label).astype(numpy.int8))[0]
        yield int(label), numpy.pad(volume[box], 4), image.header.get_zooms()[:3]


def largest_filled(mask):
    parts, count = scipy.ndimage.label(mask, numpy.ones((3, 3, 3)))
    sizes = scipy.ndimage.sum_labels(mask, parts, range(1, count + 1))
    return scipy.ndimage.binary_fill_holes(parts == 1 + int(numpy.argmax(sizes)))


def surface(volume, label, way, spacing):
    mask = volume == label
    if way in ("filled", "smoothed"):
        mask = largest_filled(mask)
    values = mask.astype(numpy.float32)
    if way == "smoothed":
        values = scipy.ndimage.gaussian_filter(values, 1)
    image = vtk.vtkImageData()
    image.SetDimensions(*values.shape)
    image.SetSpacing(*map(float, spacing))
    flat = numpy.ascontiguousarray(values.ravel(order="F"))
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(flat, deep=True))
    marcher = vtk.vtkDiscreteMarchingCubes() if way == "discrete" else vtk.vtkFlyingEdges3D()
    marcher.SetInputData(image)
    marcher.SetValue(0, 1 if way == "discrete" else 0.5)
    marcher.Update()
    return marcher.GetOutput()


def write(mesh, path):
    writer = vtk.vtkPLYWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(str(path))
    writer.Write()


def run(program, *words):
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True)


def mapped(program, mesh, folder, words):
    out, report = folder / "map.sph.ply", folder / "map.json"
    ended = run(program, "map", mesh, "-o", out, "--json", report, "-q", *words)
    if ended.returncode != 0:
        return ended, None
    for path in folder.glob("map*.sph.ply"):
        if run(program, "verify", path, "-q").returncode != 0:
            sys.exit(f"{mesh}: written, but not one-to-one")
        path.unlink()
    return ended, json.loads(report.read_text())


def why(message):
    """What stands in the way, in the program's words without figures of this mesh."""
    if "--max-handle" in message:
        return "a longer handle"
    if "--min-kept" in message:
        return "several parts"
    return next((line.strip() for line in message.splitlines() if line.strip()), "?")


def tried(program, mesh):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        write(mesh, folder / "mesh.ply")
        record = {"triangles": mesh.GetNumberOfCells()}
        ended, report = mapped(program, folder / "mesh.ply", folder, [])
        if report is not None:
            return record | {"end": "as it is"}
        ended, report = mapped(program, folder / "mesh.ply", folder, ["--repair"])
        end = "repaired"
        if report is None:
            refusal = {"why": why(ended.stderr), "message": ended.stderr}
            ended, report = mapped(program, folder / "mesh.ply", folder, ["--repair", "--all-components"])
            if report is None:
                return record | {"end": "refused"} | refusal
            end = "in parts"
        loops = [loop for part in report.get("parts", [report]) for loop in part["handles"]]
        return record | {"end": end, "loops": len(loops),
                         "crossing": sum(loop["crossings"] > 0 for loop in loops),
                         "longest": max((loop["diagonals"] for loop in loops), default=0)}


def known(path):
    if not path or not path.exists():
        return {}
    records = [json.loads(line) for line in path.read_text().splitlines()]
    return {(one["file"], one["label"], one["way"]): one for one in records}


def all_records(options):
    records = known(options.records)
    for path in sorted(options.folder.glob("*.nii*")):
        for label, volume, spacing in structures(path, options.least_voxels):
            for way in WAYS:
                key = (path.name, label, way)
                if key not in records:
                    end = tried(options.program, surface(volume, label, way, spacing))
                    records[key] = {"file": path.name, "label": label, "way": way} | end
                    if options.records:
                        with options.records.open("a") as file:
                            file.write(json.dumps(records[key]) + "\n")
                yield records[key]


def percent(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else ""


def table_of_ways(records):
    print("| surfaces | structures | as they are | with `--repair` | **certified so** | of those of one part "
          "| several parts: with `--all-components` | a longer handle | else | loops cut, median and most "
          "| longest loop | with caps through the surface |")
    print("|---" * 12 + "|")
    for way in WAYS + ["all"]:
        of_way = [one for one in records if way in (one["way"], "all")]
        ends = collections.Counter(one["end"] for one in of_way)
        reasons = collections.Counter(one["why"] for one in of_way if one["end"] == "refused")
        handles = reasons.pop("a longer handle", 0)
        cut = [one for one in of_way if one.get("loops")]
        loops = [one["loops"] for one in cut]
        certified = ends["as it is"] + ends["repaired"]
        print("|", " | ".join(map(str, [
            way, len(of_way), percent(ends["as it is"], len(of_way)), percent(ends["repaired"], len(of_way)),
            percent(certified, len(of_way)), percent(certified, len(of_way) - ends["in parts"]),
            percent(ends["in parts"], len(of_way)), handles or "", sum(reasons.values()) or "",
            f"{statistics.median(loops):g}, {max(loops)}" if loops else "",
            percent(max((one["longest"] for one in cut), default=0), 1) if cut else "",
            sum(one["crossing"] > 0 for one in cut) or ""])), "|")


def list_refused(records):
    for one in records:
        if one["end"] == "refused":
            print(f"\n{one['file']}, label {one['label']}, {one['way']}: {one['why']}")


def table_of_files(records):
    print("\n| volume | structures | " + " | ".join(f"{way}, certified" for way in WAYS) + " |")
    print("|---" * (2 + len(WAYS)) + "|")
    for name in dict.fromkeys(one["file"] for one in records):
        row = [one for one in records if one["file"] == name]
        certified = collections.Counter(one["way"] for one in row if one["end"] != "refused")
        print(f"| {name} | {len(row) // len(WAYS)} | " +
              " | ".join(str(certified[way]) for way in WAYS) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--records", type=pathlib.Path)
    parser.add_argument("--least-voxels", type=int, default=300)
    records = list(all_records(parser.parse_args()))
    table_of_ways(records)
    table_of_files(records)
    list_refused(records)


if __name__ == "__main__":
    main()
