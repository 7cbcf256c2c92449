"""The table of hostile files, and the small meshes they are made of."""
import struct
from pathlib import Path

HERE = Path(__file__).parent
FILES = HERE / "files"
TABLE = []

OK, UNREADABLE, NO_SPHERE = 0, 3, 4


def case(name, data, code, message=""):
    if isinstance(data, str):
        data = data.encode("latin-1")
    assert len(data) <= 40000, name
    (FILES / name).write_bytes(data)
    assert "\t" not in message and name not in [row[0] for row in TABLE], name
    TABLE.append((name, code, message))


def changed(text, old, new, count=1):
    """The text with one thing different; the thing must be there."""
    assert old in text, old
    return text.replace(old, new, count)


P4 = [(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)]
F4 = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
P6 = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
F6 = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]


def obj(points, faces):
    return "".join("v %s %s %s\n" % p for p in points) + "".join(
        "f " + " ".join(str(v + 1) for v in f) + "\n" for f in faces)


def off(points, faces):
    return "OFF\n%d %d 0\n" % (len(points), len(faces)) + "".join("%s %s %s\n" % p for p in points) + "".join(
        "%d " % len(f) + " ".join(map(str, f)) + "\n" for f in faces)


def ply_header(points, faces, form, coordinate="float", count="uchar", index="int", extra=""):
    return ("ply\nformat %s 1.0\nelement vertex %d\n" % (form, len(points)) +
            "".join("property %s %s\n" % (coordinate, axis) for axis in "xyz") +
            "element face %d\nproperty list %s %s vertex_indices\n%send_header\n" % (len(faces), count, index, extra))


def ply(points, faces):
    return ply_header(points, faces, "ascii") + "".join("%s %s %s\n" % p for p in points) + "".join(
        "%d " % len(f) + " ".join(map(str, f)) + "\n" for f in faces)


# Letters of struct.
CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}


def binary_ply(points, faces, order="<", coordinate="float", count="uchar", index="int", extra="", tail=b""):
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    data = ply_header(points, faces, form, coordinate, count, index, extra).encode()
    for p in points:
        data += struct.pack(order + "3" + CODES[coordinate], *p)
    for f in faces:
        data += struct.pack(order + CODES[count], len(f)) + struct.pack(order + str(len(f)) + CODES[index], *f) + tail
    return data


def open_cube():
    points = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    quads = [(0, 2, 3, 1), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6), (4, 5, 7, 6)]
    return points, quads


def torus(n=6, m=4):
    from math import cos, pi, sin
    points, faces = [], []
    for i in range(n):
        for j in range(m):
            a, b = 2 * pi * i / n, 2 * pi * j / m
            points.append((round((2 + cos(b)) * cos(a), 6), round((2 + cos(b)) * sin(a), 6), round(sin(b), 6)))
    for i in range(n):
        for j in range(m):
            a, b, c, d = i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def shifted(faces, by):
    return [tuple(v + by for v in f) for f in faces]


