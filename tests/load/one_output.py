#!/usr/bin/env python3
"""Many processes that write one output at once.

    one_output.py PROGRAM --processes 40 --work FOLDER

All map one mesh, a quarter of them by another method, to the same file, as do as many bakes of its
map to the same image. Each ends with 0; what is there afterwards is to the byte what one of them
writes alone; no other file is left. Fails with 1 otherwise.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys

WAYS = [[], ["--quality", "draft"], ["--balance", "conformal"], ["--lambda", "10"]]
SIZES = ["64", "128"]


def octasphere(levels):
    """An OBJ: an octahedron, split and blown up to an egg."""
    points = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
    faces = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
    for _ in range(levels):
        middle = {}

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                sums = [x + y for x, y in zip(points[a], points[b])]
                length = sum(x * x for x in sums) ** 0.5
                points.append(tuple(x / length for x in sums))
                middle[key] = len(points) - 1
            return middle[key]

        split = []
        for a, b, c in faces:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = split
    egg = [(x, y, z * (2 + 0.5 * z)) for x, y, z in points]
    lines = ["v %r %r %r" % p for p in egg] + ["f %d %d %d" % (a + 1, b + 1, c + 1) for a, b, c in faces]
    return "\n".join(lines) + "\n"


def run_alone(program, words, folder, output):
    folder.mkdir()
    subprocess.run([program, *words, "-o", output], cwd=folder, check=True, capture_output=True)
    return (folder / output).read_bytes()


def run_together(program, commands, folder, output, count):
    """What is wrong, in lines."""
    folder.mkdir()
    running = [
        subprocess.Popen([program, *commands[k % len(commands)], "-o", output], cwd=folder,
                         stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for k in range(count)
    ]
    wrong = []
    for process in running:
        messages = process.communicate()[1]
        if process.returncode != 0:
            wrong.append("exit code %d: %s" % (process.returncode, messages.strip()))
    left = sorted(path.name for path in folder.iterdir())
    if left != [output]:
        wrong.append("left in the folder: " + ", ".join(left))
    return wrong


def trial(program, commands, work, output, count):
    alone = [run_alone(program, words, work / ("alone%d" % k), output) for k, words in enumerate(commands)]
    wrong = run_together(program, commands, work / "together", output, count)
    if (work / "together" / output).read_bytes() not in alone:
        wrong.append("the file is none of those that one process writes")
    return wrong, len(set(alone))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--processes", type=int, default=40)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    args = parser.parse_args()
    program = str(pathlib.Path(args.program).resolve())
    shutil.rmtree(args.work, ignore_errors=True)
    args.work.mkdir(parents=True)
    work = args.work.resolve()
    mesh = work / "egg.obj"
    mesh.write_text(octasphere(4))
    sphere = work / "egg.sph.ply"
    subprocess.run([program, "map", mesh, "-o", sphere], check=True, capture_output=True)

    failed = False
    for name, commands, output in [
        ("maps", [["map", str(mesh), *way] for way in WAYS], "out.sph.ply"),
        ("bakes", [["bake", str(sphere), "--map", "position", "--size", size] for size in SIZES], "out.exr"),
    ]:
        (work / name).mkdir()
        wrong, kinds = trial(program, commands, work / name, output, args.processes)
        print("%d %s of %d kinds at once: %s" % (args.processes, name, kinds, "; ".join(wrong) or "well"))
        failed = failed or bool(wrong)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
