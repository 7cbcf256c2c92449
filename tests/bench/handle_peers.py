#!/usr/bin/env python3
"""Handles removed by sphparam beside MinCycles (Wood, Hoppe, Desbrun, Schroeder 2004).

    handle_peers.py SPHPARAM MINCYCLES MESH.obj... > table.md

MINCYCLES is the program of that name of hhoppe/Mesh-processing-library, built by its makefiles; it is asked
for the shortest loop each time (-fraccyclelength 1). Both run alone, one after the other: what is compared
is the sum of the loops' lengths and the time of the processor, less what each takes to read and write the
mesh with nothing to do. Meshes are triangles.
"""

import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

UNBOUND = "100000%"


def cost(words, **more):
    """Seconds of the processor, and the text it wrote."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run(list(map(str, words)), capture_output=True, text=True, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, ended.stdout + ended.stderr


def to_m(mesh, path):
    """Hoppe's format: numbered lines."""
    vertices = faces = 0
    with mesh.open() as lines, path.open("w") as out:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices += 1
                out.write(f"Vertex {vertices}  {' '.join(words[1:4])}\n")
            elif words[:1] == ["f"]:
                faces += 1
                out.write(f"Face {faces}  {' '.join(word.split('/')[0] for word in words[1:])}\n")
    return faces


def ours(program, mesh, folder):
    out, report = folder / "out.obj", folder / "report.json"
    idle, _ = cost([program, "repair", mesh, "-o", out, "-q", "--repair=unused"])
    seconds, _ = cost([program, "repair", mesh, "-o", out, "-q", "--json", report, "--repair=handles",
                       "--max-handle", UNBOUND])
    loops = [loop["length"] for loop in json.loads(report.read_text())["handles"]]
    return len(loops), sum(loops), seconds - idle


def theirs(program, mesh):
    idle, _ = cost([program, mesh, "-nooutput"])
    seconds, text = cost([program, mesh, "-fraccyclelength", "1", "-closecycles", "-nooutput"])
    loops = [float(length) for length in re.findall(r"Closing cycle: edges=\d+\s+length=(\S+)", text)]
    return len(loops), sum(loops), seconds - idle


def main():
    program, other, meshes = sys.argv[1], sys.argv[2], sys.argv[3:]
    print("| mesh | triangles | loops | length of all | of MinCycles | s | of MinCycles | times |")
    print("|---|---|---|---|---|---|---|---|")
    for mesh in map(pathlib.Path, meshes):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            triangles = to_m(mesh, folder / "mesh.m")
            count, length, seconds = ours(program, mesh, folder)
            their_count, their_length, their_seconds = theirs(other, folder / "mesh.m")
        loops = count if count == their_count else f"{count} ({their_count})"
        print(f"| {mesh.stem} | {triangles} | {loops} | {length:.6g} | {their_length:.6g} | {seconds:.2f} "
              f"| {their_seconds:.1f} | {their_seconds / seconds:.0f} |", flush=True)


if __name__ == "__main__":
    main()
