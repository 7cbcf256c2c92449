#!/usr/bin/env python3
"""Does every certified map lead on? `map`, then `bake`, `export` and `remesh` of what it wrote, on meshes and shapes.

    build/release/tests/campaign/same_shapes shapes.txt --count 120 --seed 19 --most-triangles 6000
    chart_table.py build/release/bin/sphparam --log charts.tsv --shapes shapes.txt shared/meshes/genus0 shared/meshes/hurt

A line a shape in the log: how each command ended, what became of its chart, how many vertices that has for one of
the mesh, by how much of a turn it moved vertices, and what was said. Known ones are left out. Then the totals, in
Markdown. A mesh that does not map ends there.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import tempfile
import time

COLUMNS = ["shape", "triangles", "map", "bake", "export", "remesh", "chart", "vertices", "moved", "seconds", "said"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("meshes", nargs="*", type=pathlib.Path, help="files, or folders of them")
    parser.add_argument("--shapes", nargs="*", default=[], type=pathlib.Path, help="lists that same_shapes writes")
    parser.add_argument("--log", required=True, type=pathlib.Path)
    parser.add_argument("--size", type=int, default=128, help="width of what is baked")
    parser.add_argument("--seconds", type=float, default=120, help="a command that takes longer is stopped")
    return parser.parse_intermixed_args()


def listed(path):
    """Name and text of each shape of a list: a name and two numbers, then positions, then triangles, a number a line."""
    with path.open() as lines:
        for head in lines:
            name, vertices, faces = head.split()
            numbers = [next(lines).strip() for _ in range(3 * (int(vertices) + int(faces)))]
            rows = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
            count = int(vertices)
            text = [f"OFF\n{vertices} {faces} 0"] + [" ".join(row) for row in rows[:count]]
            yield f"{path.name}:{name}", "\n".join(text + ["3 " + " ".join(row) for row in rows[count:]]) + "\n"


def meshes_of(options, scratch):
    """Name and path of every mesh."""
    for place in options.meshes:
        for path in sorted(place.iterdir()) if place.is_dir() else [place]:
            if path.suffix in (".obj", ".off", ".ply", ".stl", ".glb", ".gii"):
                yield path.name, path
    for path in options.shapes:
        for name, text in listed(path):
            mesh = scratch / "shape.off"
            mesh.write_text(text)
            yield name, mesh


def run(options, *words):
    """How it ended, and what it said."""
    try:
        ended = subprocess.run([options.program, *map(str, words)], capture_output=True, text=True, check=False,
                               timeout=options.seconds)
    except subprocess.TimeoutExpired:
        return "stopped", ""
    return str(ended.returncode), ended.stderr


def chart_of(report):
    """What became of it, its vertices for one of the mesh, and how far they moved."""
    chart = report["chart"]
    if not chart or "not_made" in chart:
        return "none", "", ""
    moved = chart.get("max_shift", 0) if chart["nudged_vertices"] else 0
    return ("certified" if chart["certified"] else "not one-to-one",
            f"{chart['vertices'] / report['inspection']['vertices']:.2f}", f"{moved:.1g}" if moved else "")


def row_of(options, mesh, scratch):
    begun = time.monotonic()
    row = dict.fromkeys(COLUMNS, "")
    out, report, export = scratch / "map.sph.ply", scratch / "map.json", scratch / "export.json"
    row["map"], said = run(options, "map", mesh, "-o", out, "--json", report, "-q")
    if row["map"] == "0":
        made = json.loads(report.read_text())
        row["triangles"] = str(made["inspection"]["triangles"])
        row["chart"], row["vertices"], row["moved"] = chart_of(made)
        steps = {"bake": ["--map", "normal-object", "--size", options.size, "-o", scratch / "n.png"],
                 "export": ["--image-size", options.size, "-o", scratch / "mesh.glb", "--json", export],
                 "remesh": ["--grid", "ico:3", "-o", scratch / "low.glb"]}
        for step, words in steps.items():
            row[step], told = run(options, step, out, "-q", *words)
            said += told
        if row["export"] == "0" and not json.loads(export.read_text())["levels"][0]["certified_as_stored"]:
            row["export"] = "folded as stored"
    row["seconds"] = f"{time.monotonic() - begun:.1f}"
    row["said"] = " ".join(said.replace(str(scratch) + "/", "").split())[:300]
    return row


def known(log):
    return {line.split("\t")[0] for line in log.read_text().splitlines()} if log.exists() else set()


def tell(log):
    rows = [dict(zip(COLUMNS, line.split("\t"))) for line in log.read_text().splitlines()]
    mapped = [row for row in rows if row["map"] == "0"]
    print("| | |\n|---|---|")
    print(f"| shapes, of which mapped | {len(rows)}, {len(mapped)} |")
    for step in ("bake", "export", "remesh"):
        ends = collections.Counter(row[step] for row in mapped)
        print(f"| `{step}` ended with | " + ", ".join(f"{end}: {count}" for end, count in sorted(ends.items())) + " |")
    charts = collections.Counter(row["chart"] for row in mapped)
    print("| charts | " + ", ".join(f"{chart}: {count}" for chart, count in sorted(charts.items())) + " |")
    ratios = sorted(float(row["vertices"]) for row in mapped if row["vertices"])
    if ratios:
        print(f"| vertices of the chart for one of the mesh | median {ratios[len(ratios) // 2]}, at most {ratios[-1]}; "
              f"{sum(ratio > 2 for ratio in ratios)} above 2 |")
    moved = [float(row["moved"]) for row in mapped if row["moved"]]
    print(f"| charts that moved vertices | {len(moved)}, by up to {max(moved, default=0)} of a turn |")


def main():
    options = arguments()
    done = known(options.log)
    with options.log.open("a") as log, tempfile.TemporaryDirectory() as scratch:
        for name, mesh in meshes_of(options, pathlib.Path(scratch)):
            if name in done:
                continue
            row = row_of(options, mesh, pathlib.Path(scratch)) | {"shape": name}
            print("\t".join(row[column] for column in COLUMNS), file=log, flush=True)
    tell(options.log)


if __name__ == "__main__":
    main()
