"""Binary PLY files, in which the add-on and sphparam hand meshes to one another."""

from dataclasses import dataclass, field
from typing import Dict, List, Optional, Tuple

import numpy as np

_types = {"float": "<f4", "double": "<f8", "uchar": "u1", "char": "i1", "int": "<i4", "uint": "<u4",
          "short": "<i2", "ushort": "<u2"}  # fmt: skip
_names = {np.dtype(code): name for name, code in _types.items()}


@dataclass
class Ply:
    """A mesh of any polygons: `corners` are vertices, face by face, `counts` so many a face."""

    vertices: Dict[str, np.ndarray]
    """Property to (V,)."""
    counts: np.ndarray
    corners: np.ndarray
    texcoords: Optional[np.ndarray] = None
    """(C, 2), v upwards, of corners."""
    faces: Dict[str, np.ndarray] = field(default_factory=dict)
    """Property to (F,)."""

    def table(self, *names: str) -> np.ndarray:
        """Properties of vertices side by side."""
        return np.stack([self.vertices[name] for name in names], axis=1)

    def triangles(self) -> np.ndarray:
        """(F, 3). Requires: triangles only."""
        return self.corners.reshape(-1, 3)


def write_triangles(path, vertices, triangles, faces=None, texcoords=None, normals=None) -> None:
    """Writes triangles: columns of vertices and of faces by name, (F, 3, k) of corners."""
    record: List[Tuple] = [("n", "u1"), ("vertex_indices", "<i4", 3)]
    columns = {"n": 3, "vertex_indices": triangles}
    lines = ["property list uchar int vertex_indices"]
    for name, table, size in (("texcoord", texcoords, 2), ("normal", normals, 3)):
        if table is not None:
            record += [("n_" + name, "u1"), (name, "<f4", 3 * size)]
            columns.update({"n_" + name: 3 * size, name: table.reshape(len(triangles), -1)})
            lines.append(f"property list uchar float {name}")
    for name, column in (faces or {}).items():
        record.append((name, column.dtype))
        columns[name] = column
        lines.append(f"property {_names[column.dtype]} {name}")
    body = np.empty(len(triangles), record)
    for name, column in columns.items():
        body[name] = column
    count = len(next(iter(vertices.values())))
    points = np.empty(count, [(name, column.dtype) for name, column in vertices.items()])
    for name, column in vertices.items():
        points[name] = column
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {count}"]
    head += [f"property {_names[column.dtype]} {name}" for name, column in vertices.items()]
    head += [f"element face {len(triangles)}", *lines, "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(head).encode() + points.tobytes() + body.tobytes())


def _header(data: bytes):
    """Elements with their properties, and where the body begins."""
    end = data.index(b"end_header\n") + len(b"end_header\n")
    elements: Dict[str, Tuple[int, list]] = {}
    for words in (line.split() for line in data[:end].decode("utf-8", "replace").splitlines()):
        if words[:1] == ["element"]:
            last: list = []
            elements[words[1]] = int(words[2]), last
        elif words[:1] == ["property"]:
            last.append((words[-1], [_types[word] for word in words[1:-1] if word != "list"]))
    return elements, end


def _alike(data, begin, count, properties):
    """Faces that all have as many corners as the first; else None."""
    record, at = [], begin
    for name, types in properties:
        if len(types) == 2:
            size = int(np.frombuffer(data, types[0], 1, at)[0])
            record += [("n_" + name, types[0]), (name, types[1], (size,))]
            at += np.dtype(types[0]).itemsize + size * np.dtype(types[1]).itemsize
        else:
            record.append((name, types[0]))
            at += np.dtype(types[0]).itemsize
    kind = np.dtype(record)
    if len(data) - begin != kind.itemsize * count:
        return None
    rows = np.frombuffer(data, kind, count, begin)
    for name, types in properties:
        if len(types) == 2 and (rows["n_" + name] != rows["n_" + name][0]).any():
            return None
    return {name: (rows["n_" + name] if len(types) == 2 else None, rows[name].reshape(-1))
            for name, types in properties}  # fmt: skip


def _one_by_one(data, begin, count, properties):
    """Faces of different sizes."""
    found = {name: ([], []) for name, _ in properties}
    at = begin
    for _ in range(count):
        for name, types in properties:
            size = 1
            if len(types) == 2:
                size = int(np.frombuffer(data, types[0], 1, at)[0])
                at += np.dtype(types[0]).itemsize
            found[name][0].append(size)
            found[name][1].append(np.frombuffer(data, types[-1], size, at))
            at += size * np.dtype(types[-1]).itemsize
    return {name: (np.array(sizes), np.concatenate(parts)) for name, (sizes, parts) in found.items()}


def read(path) -> Ply:
    """Reads what sphparam writes. Requires: binary, little-endian, at least one face."""
    with open(path, "rb") as file:
        data = file.read()
    elements, begin = _header(data)
    count, properties = elements["vertex"]
    kind = np.dtype([(name, types[0]) for name, types in properties])
    rows = np.frombuffer(data, kind, count, begin)
    number, parts = elements["face"]
    body = begin + count * kind.itemsize
    found = _alike(data, body, number, parts) or _one_by_one(data, body, number, parts)
    counts, corners = found.pop("vertex_indices")
    texcoords = found.pop("texcoord", (None, None))[1]
    return Ply(
        {name: rows[name] for name, _ in properties},
        counts.astype(np.int64),
        corners.astype(np.int64),
        None if texcoords is None else texcoords.reshape(-1, 2),
        {name: column for name, (_, column) in found.items()},
    )
