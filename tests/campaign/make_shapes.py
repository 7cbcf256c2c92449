#!/usr/bin/env python3
"""Makes shapes by the thousand for batches: bumpy balls, each of its own, and bad files among them.

  make_shapes.py FOLDER --count 1000 --bad 30 --triangles 10000 --seed 1

FOLDER/shape_00000.ply and so on; bad ones are told apart in FOLDER/bad.tsv (name, what is wrong),
and are as many of each kind as the count allows. About one shape in a hundred has a horn. The same bytes for the same arguments.
"""

import argparse
import array
import math
import pathlib
import random
import struct

KINDS = ("hole", "two parts", "flipped", "cut off", "not finite", "handle", "empty", "no mesh")


def bumps(random_numbers):
    """A few smooth bumps and dents: direction, width, height."""
    result = []
    for _ in range(random_numbers.randint(2, 7)):
        z = random_numbers.uniform(-1, 1)
        angle = random_numbers.uniform(0, 2 * math.pi)
        r = math.sqrt(1 - z * z)
        height = random_numbers.choice((0.3, 0.6, 1.2, -0.3))
        result.append((r * math.cos(angle), r * math.sin(angle), z,
                       random_numbers.uniform(4, 20), height))
    return result


def ball(triangles, seed):
    """Positions and triangles of a ball of rings with poles, its radius changed by bumps."""
    numbers = random.Random(seed)
    rings = max(3, round(math.sqrt(triangles / 4)))
    sides = max(3, round(triangles / (2 * rings)))
    all_bumps = bumps(numbers)
    if seed % 97 == 0:  # a horn, which no map likes
        all_bumps.append((0.6, 0.0, 0.8, 60, 5))
    stretch = [numbers.uniform(0.6, 1.6) for _ in range(3)]
    directions = [(0.0, 0.0, 1.0)]
    for i in range(1, rings + 1):
        phi = math.pi * i / (rings + 1)
        z, r = math.cos(phi), math.sin(phi)
        for k in range(sides):
            theta = 2 * math.pi * (k + 0.5 * (i % 2)) / sides
            directions.append((r * math.cos(theta), r * math.sin(theta), z))
    directions.append((0.0, 0.0, -1.0))
    points = []
    exp = math.exp
    for x, y, z in directions:
        radius = 1.0
        for a, b, c, width, height in all_bumps:
            radius += height * exp(width * (a * x + b * y + c * z - 1))
        points.append((stretch[0] * radius * x, stretch[1] * radius * y, stretch[2] * radius * z))
    faces = []
    for k in range(sides):
        faces.append((0, 1 + k, 1 + (k + 1) % sides))
    for i in range(rings - 1):
        upper, lower, shift = 1 + i * sides, 1 + (i + 1) * sides, i % 2 == 0
        for k in range(sides):
            n = (k + 1) % sides
            if shift:
                faces += [(upper + k, lower + k, upper + n), (upper + n, lower + k, lower + n)]
            else:
                faces += [(upper + k, lower + k, lower + n), (upper + k, lower + n, upper + n)]
    last, south = 1 + (rings - 1) * sides, 1 + rings * sides
    for k in range(sides):
        faces.append((south, last + (k + 1) % sides, last + k))
    return points, faces


def torus():
    points, faces, n = [], [], 24
    for i in range(n):
        for k in range(n):
            u, v = 2 * math.pi * i / n, 2 * math.pi * k / n
            r = 1 + 0.4 * math.cos(v)
            points.append((r * math.cos(u), r * math.sin(u), 0.4 * math.sin(v)))
            a, b = i * n + k, ((i + 1) % n) * n + k
            c, d = ((i + 1) % n) * n + (k + 1) % n, i * n + (k + 1) % n
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def ply(points, faces):
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    body = array.array("f", [c for p in points for c in p]).tobytes()
    return header.encode() + body + b"".join(struct.pack("<B3i", 3, *f) for f in faces)


def spoilt(kind, points, faces):
    if kind == "hole":
        faces = faces[7:]
    elif kind == "two parts":
        count = len(points)
        points = points + [(x + 9, y, z) for x, y, z in points]
        faces = faces + [tuple(v + count for v in f) for f in faces]
    elif kind == "flipped":
        faces = [tuple(reversed(faces[0]))] + faces[1:]
    elif kind == "not finite":
        points = [(math.nan, 0, 0)] + points[1:]
    elif kind == "handle":
        points, faces = torus()
    elif kind == "empty":
        return b""
    elif kind == "no mesh":
        return b"this is a letter to whoever opens it\n"
    data = ply(points, faces)
    return data[:len(data) // 2] if kind == "cut off" else data


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--bad", type=int, default=30)
    parser.add_argument("--triangles", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    a = parser.parse_args()
    a.folder.mkdir(parents=True, exist_ok=True)
    bad = sorted(random.Random(a.seed).sample(range(a.count), a.bad))
    lines = []
    for i in range(a.count):
        points, faces = ball(a.triangles, a.seed * 1_000_003 + i)
        name = f"shape_{i:05}.ply"
        kind = KINDS[bad.index(i) % len(KINDS)] if i in bad else None
        if kind:
            lines.append(f"{name}\t{kind}\n")
        (a.folder / name).write_bytes(spoilt(kind, points, faces) if kind else ply(points, faces))
    (a.folder / "bad.tsv").write_text("".join(lines))


if __name__ == "__main__":
    main()
