#!/usr/bin/env python3
"""What becomes of the meshes in a folder: as they are, with --repair, with --keep-holes, in parts.

    surface_table.py SPHPARAM FOLDER > table.md

Each mesh is tried as it is; else with `--repair --keep-holes`; else with `--all-components` too. Every
map that is written is verified again, and how far points of the mesh are from it is measured. A row a mesh that does not map as it is, in Markdown, then the totals; what stays refused says why.
"""

import json
import pathlib
import subprocess
import sys
import tempfile


def run(program, *words):
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True)


def loops(report):
    return [loop for part in report.get("parts", [report]) for loop in part["handles"]]


def share(report):
    shares = [part["filler_share"] for part in report.get("parts", [report])]
    shares = [one for one in shares if one is not None]
    return f"{100 * max(shares):.2g} %" if shares else ""


def farthest(program, mesh, maps):
    """Of the mesh's points from what was written: 0 where all of its surface is there as it was."""
    if len(maps) != 1:
        return ""
    ended = run(program, "measure", mesh, maps[0], "--json", "-", "-q", "--samples", 100000)
    return json.loads(ended.stdout)["first_to_second"]["max"] if ended.returncode == 0 else "?"


def attempt(program, mesh, folder, words):
    out = folder / "map.sph.ply"
    report = folder / "map.json"
    ended = run(program, "map", mesh, "-o", out, "--json", report, "-q", *words)
    if ended.returncode != 0:
        return ended, None, []
    maps = sorted(folder.glob("map*.sph.ply"))
    for path in maps:
        if run(program, "verify", path, "-q").returncode != 0:
            sys.exit(f"{path}: written, but not one-to-one")
    return ended, json.loads(report.read_text()), maps


def reason(text):
    lines = [line.strip() for line in text.splitlines()]
    for line in lines:
        if "would mend it" in line:
            return "with `" + line.split(" would mend it")[0] + "`"
    return lines[1] if len(lines) > 1 else "?"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    ways = [("as it is", []), ("`--repair --keep-holes`", ["--repair", "--keep-holes"]),
            ("`--all-components` too", ["--repair", "--keep-holes", "--all-components"])]
    counts = dict.fromkeys([name for name, _ in ways] + ["refused"], 0)
    rows = []
    for mesh in sorted(folder.iterdir()):
        row = None
        for name, words in ways:
            with tempfile.TemporaryDirectory() as scratch:
                ended, report, maps = attempt(program, mesh, pathlib.Path(scratch), words)
                if report is None:
                    first = reason(ended.stderr) if name == ways[1][0] else None
                    row = row or (first and (mesh.stem, "refused", "", "", "", "", first)) or None
                    continue
                counts[name] += 1
                if name != ways[0][0]:
                    cut = loops(report)
                    crossing = sum(loop["crossings"] > 0 for loop in cut)
                    rows.append((mesh.stem, name, len(cut) or "", crossing or "", share(report),
                                 farthest(program, mesh, maps),
                                 f"{len(maps)} maps" if len(maps) > 1 else ""))
                row = None
                break
        if row:
            counts["refused"] += 1
            rows.append(row)
    print("| mesh | maps | handles cut | of them with caps through the surface | fillers, of the sphere | farthest point of the mesh | |")
    print("|---|---|---|---|---|---|---|")
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print("\n" + ", ".join(f"{name}: {count}" for name, count in counts.items()) + ".")


if __name__ == "__main__":
    main()
