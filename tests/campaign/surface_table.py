#!/usr/bin/env python3
"""What becomes of the meshes in a folder: as they are, with --repair, with --keep-holes, in parts.

    surface_table.py SPHPARAM FOLDER > table.md

A row a mesh that does not map as it is, in Markdown: what `--repair` makes of it, `--keep-holes` with it, and
`--all-components` with both; then, of the first of these that ends with a map and fills no hole, if one does,
what was cut and what fillers take, how far the vertices of the mesh that are in the map were moved (OBJ and OFF are read here once more)
and how far any point of the mesh is from the map. Every map that is written is verified again. Then the
totals. Needs python3-numpy.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy

WAYS = [("`--repair`", ["--repair"]), ("`--keep-holes` too", ["--repair", "--keep-holes"]),
        ("`--all-components` too", ["--repair", "--keep-holes", "--all-components"])]
TYPES = {"double": "<f8", "float": "<f4", "int": "<i4", "uint": "<u4", "uchar": "u1", "char": "i1",
         "short": "<i2", "ushort": "<u2"}


def run(program, *words):
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True)


def attempt(program, mesh, folder, words):
    """What it said, its report or nothing, and the maps."""
    out, report = folder / "map.sph.ply", folder / "map.json"
    ended = run(program, "map", mesh, "-o", out, "--json", report, "-q", *words)
    if ended.returncode != 0:
        return ended.stderr, None, []
    maps = sorted(folder.glob("map*.sph.ply"))
    for path in maps:
        if run(program, "verify", path, "-q").returncode != 0:
            sys.exit(f"{path}: written, but not one-to-one")
    return "", json.loads(report.read_text()), maps


def reason(text):
    """In few words; texts of the program have the rest."""
    handle = re.search(r"--max-handle ([\d.]+%)", text)
    parts = re.search(r"keeps one of (\d+) components", text)
    hole = re.search(r"--max-hole (\d+)", text)
    if handle:
        return f"needs `--max-handle {handle[1]}`"
    if parts:
        return f"{parts[1]} parts"
    if hole:
        return f"a hole of {hole[1]} edges"
    if "this is not a closed" not in text and "still no closed" not in text:
        return "not read: " + text.split(": ", 3)[-1].splitlines()[0][:70].replace("|", "\\|")
    if re.search("one-sided|orient", text):
        return "one-sided"
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    rest = [line for line in lines[1:] if not line.startswith("hint") and not line.endswith(":")]
    return (rest or lines or ["?"])[0][:90].replace("|", "\\|")


def parts_of(report):
    return report.get("parts", [report])


def share(report):
    shares = [part["filler_share"] for part in parts_of(report) if part["filler_share"] is not None]
    return f"{100 * max(shares):.2g} %" if shares else ""


def source_vertices(mesh):
    """Of OBJ and OFF, in the order of the file; else nothing, nor where they are no plain numbers."""
    try:
        return read_vertices(mesh)
    except ValueError:
        return None


def read_vertices(mesh):
    lines = mesh.read_text(errors="replace").splitlines() if mesh.suffix in (".obj", ".off") else []
    if mesh.suffix == ".obj":
        return numpy.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
    rows = [row for row in (line.split("#")[0].split() for line in lines) if row]
    if not rows or rows[0] != ["OFF"]:
        return None
    return numpy.array([row[:3] for row in rows[2:2 + int(rows[1][0])]], float)


def vertices_of_map(path):
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    vertex = header.decode(errors="replace").split("element vertex ")[1].split("element")[0].splitlines()
    fields = [(line.split()[2], TYPES[line.split()[1]]) for line in vertex[1:] if line.startswith("property")]
    return numpy.frombuffer(body, fields, int(vertex[0]))


def moved(mesh, maps):
    """The farthest that a vertex of the mesh is from its place, over all maps."""
    source = source_vertices(mesh)
    if source is None:
        return ""
    farthest = 0
    for path in maps:
        vertices = vertices_of_map(path)
        names = vertices["source_vertex"] if "source_vertex" in vertices.dtype.names else numpy.arange(len(vertices))
        kept = names >= 0
        places = numpy.stack([vertices[axis][kept].astype(float) for axis in "xyz"], 1)
        # Files of single precision hold the nearest such numbers.
        wanted = source[names[kept]].astype(vertices["x"].dtype).astype(float)
        farthest = max(farthest, float(numpy.abs(places - wanted).max(initial=0)))
    return f"{farthest:.2g}"


def left_out(program, mesh, maps):
    """How far points of the mesh are from what was mapped: 0 where all of its surface is there."""
    if len(maps) != 1:
        return ""
    ended = run(program, "measure", mesh, maps[0], "--json", "-", "-q", "--samples", 100000)
    if ended.returncode != 0:
        return ""
    return f"{json.loads(ended.stdout)['first_to_second']['max']:.2g}"


def row_of(program, mesh, counts):
    with tempfile.TemporaryDirectory() as scratch:
        message, report, _ = attempt(program, mesh, pathlib.Path(scratch), [])
    if report is not None:
        counts["as it is"] += 1
        return None
    cells, enough, figures = [], None, None
    for name, words in WAYS:
        with tempfile.TemporaryDirectory() as scratch:
            message, report, maps = attempt(program, mesh, pathlib.Path(scratch), words)
            if report is None:
                cells.append(reason(message))
                continue
            cells.append("certified" if len(maps) == 1 else f"{len(maps)} maps")
            enough = enough or name
            if figures is None or figures["filled"]:
                figures = figures_of(program, mesh, report, maps)
    counts[enough or "refused"] += 1
    shown = figures["cells"] if figures else [""] * 5
    return [mesh.stem, *cells, *shown]


def figures_of(program, mesh, report, maps):
    kinds = {one["kind"] for part in parts_of(report) for one in part["repairs"]}
    cut = [loop for part in parts_of(report) for loop in part["handles"]]
    return {"filled": "hole-filled" in kinds,
            "cells": [len(cut) or "", sum(loop["crossings"] > 0 for loop in cut) or "", share(report),
                      moved(mesh, maps), left_out(program, mesh, maps)]}


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    counts = dict.fromkeys(["as it is"] + [name for name, _ in WAYS] + ["refused"], 0)
    rows = [row_of(program, mesh, counts) for mesh in sorted(folder.iterdir())]
    print("| mesh | " + " | ".join(name for name, _ in WAYS) + " | handles cut | with caps through the surface "
          "| fillers, of the sphere | vertices moved by | farthest point left out |")
    print("|---" * 9 + "|")
    for row in filter(None, rows):
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print(f"\nOf {len(rows)}, by what is enough: " +
          ", ".join(f"{name} {count}" for name, count in counts.items()) + ".")


if __name__ == "__main__":
    main()
