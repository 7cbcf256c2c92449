"""Arrays and the meshes of other packages, looked at before anything is converted."""

from __future__ import annotations

import re
import warnings
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Tuple

from ._errors import LossWarning
from ._numpy import np

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[Any]
    Rows = List[Tuple[str, str, Array]]

_most_rows = 2**31 - 1


def _array(thing: Any, name: str) -> Array:
    """An array of numbers; nothing is guessed from texts and objects."""
    if isinstance(thing, (str, bytes, dict, set)) or thing is None:
        raise TypeError(f"{name}: an array is needed, not {type(thing).__name__}")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            array = np.asarray(thing)
    except (ValueError, Warning) as error:
        raise ValueError(f"{name}: no array can be made of it: {error}") from None
    if isinstance(thing, np.ma.MaskedArray) and np.ma.is_masked(thing):
        raise ValueError(f"{name}: some of it is masked; fill or drop these rows first")
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: numbers are needed, not {array.dtype}")
    found: Array = array
    return found


def _three_columns(array: Array, name: str, what: str) -> Array:
    if array.ndim == 2 and array.shape[1] == 3 and len(array) <= _most_rows:
        return array
    shape = "×".join(str(n) for n in array.shape) or "a single number"
    message = f"{name}: {what} are needed, one a row, #×3, not {shape}"
    if array.ndim == 2 and array.shape[0] == 3:
        message += f"; pass {name}.T if it is transposed"
    if array.ndim == 2 and array.shape[1] == 4 and what == "triangles":
        message += "; quads must be cut into triangles first"
    raise ValueError(message)


def points(thing: Any, name: str = "vertices") -> Array:
    """Three coordinates a row, as the module `_core` reads them; finiteness is told later."""
    array = _three_columns(_array(thing, name), name, "coordinates")
    if array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        with np.errstate(over="ignore"):
            array = array.astype(np.float64)
    return array


def finite_points(thing: Any, name: str, count: Optional[int] = None) -> Array:
    """The same, with finite numbers and so many rows."""
    array = points(thing, name)
    if count is not None and len(array) != count:
        raise ValueError(f"{name}: {count} rows are needed, one a vertex, not {len(array)}")
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(bad):
        raise ValueError(f"{name}: {len(bad)} rows are no finite numbers, the first is {bad[0]}")
    return array


def directions(thing: Any, name: str = "directions") -> Array:
    """Finite rows, none of which is zero."""
    array = finite_points(thing, name)
    bad = np.flatnonzero(~array.any(axis=1))
    if len(bad):
        raise ValueError(f"{name}: row {bad[0]} is 0, which is no direction")
    return array


def triangles(thing: Any, name: str = "faces") -> Array:
    """Three indices a row; whether vertices of these numbers are there is told later."""
    array = _array(thing, name)
    if array.dtype.kind == "f":
        raise TypeError(
            f"{name}: whole numbers are needed, not {array.dtype}; "
            f"if they are whole: {name}.astype(np.int64)"
        )
    return _three_columns(array, name, "triangles")


def threads(number: int) -> int:
    """0 for all cores, or how many."""
    if isinstance(number, bool) or not hasattr(number, "__index__"):
        raise TypeError(f"threads: a whole number is needed, not {type(number).__name__}")
    if not 0 <= number <= 4096:
        raise ValueError(f"threads: 0 (all cores) to 4096, not {number}")
    return int(number)


# Values of vertices and faces. The library keeps columns of numbers, each with a type of PLY.

_ply_types = {
    "i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint",
    "f4": "float", "f8": "double", "f2": "float", "b1": "uchar",
}  # fmt: skip
_columns = {
    "color": ("red", "green", "blue", "alpha"),
    "normal": ("nx", "ny", "nz"),
    "uv": ("s", "t"),
}
_same_names = {"colors": "color", "colour": "color", "colours": "color", "normals": "normal"}
_of_the_map = {"sx", "sy", "sz", "theta", "phi", "x", "y", "z", "source_vertex", "source_face"}


def _column_type(array: Array, name: str) -> str:
    """The PLY type that holds an array; whole numbers must fit into 32 bits."""
    kind = array.dtype.kind + str(array.dtype.itemsize)
    if kind in ("i8", "u8"):
        least, most = (int(array.min()), int(array.max())) if array.size else (0, 0)
        if -(2**31) <= least and most < 2**31:
            return "int"
        if 0 <= least and most < 2**32:
            return "uint"
        raise ValueError(f"{name}: numbers beyond 32 bits, which meshes cannot keep: {least} to {most}")
    if kind not in _ply_types:
        raise TypeError(f"{name}: numbers of at most 64 bits are needed, not {array.dtype}")
    return _ply_types[kind]


def _column_names(name: str, array: Array) -> Tuple[str, ...]:
    if array.ndim == 1:
        return (name,)
    known = _columns.get(_same_names.get(name.lower(), name.lower()))
    width = array.shape[1]
    if known and width in ((3, 4) if len(known) == 4 else (len(known),)):
        return known[:width]
    return tuple(f"{name}_{k}" for k in range(width))


def columns(name: Any, thing: Any, count: int, what: str = "vertex") -> Rows:
    """An array of values, one row a vertex or face, as columns: name, PLY type, doubles."""
    label = f"values[{name!r}]"
    if not isinstance(name, str) or not re.fullmatch(r"\S+", name):
        raise ValueError(f"{label}: a name without blanks is needed")
    if name in _of_the_map:
        raise ValueError(f"{label}: this name is the map's own")
    bare = np.asarray(thing)
    array = bare if bare.dtype.kind == "b" else _array(thing, label)
    if array.ndim not in (1, 2) or len(array) != count:
        shape = "×".join(str(n) for n in array.shape) or "a single number"
        raise ValueError(f"{label}: {count} rows are needed, one a {what}, not {shape}")
    kind = _column_type(array, label)
    numbers = array.astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(numbers.reshape(count, -1)).all(axis=1))
    if len(bad):
        raise ValueError(f"{label}: {len(bad)} rows are no finite numbers, the first is {bad[0]}")
    names = _column_names(name, array)
    table = numbers.reshape(count, len(names))
    return [(n, kind, np.ascontiguousarray(table[:, k])) for k, n in enumerate(names)]


def grouped(rows: Iterable[Tuple[str, Array]]) -> Dict[str, Array]:
    """Columns as they were given: colours, normals and numbered columns side by side."""
    left = {name: array for name, array in rows if name not in ("sx", "sy", "sz", "theta", "phi")}
    found: Dict[str, Array] = {}
    for group, names in _columns.items():
        have = [n for n in names if n in left]
        if len(have) >= min(3, len(names)) and tuple(have) == names[: len(have)]:
            found[group] = np.column_stack([left.pop(n) for n in have])
    for name in list(left):
        base = name[:-2]
        if not name.endswith("_0") or f"{base}_1" not in left:
            continue
        parts: List[Array] = []
        while f"{base}_{len(parts)}" in left:
            parts.append(left.pop(f"{base}_{len(parts)}"))
        found[base] = np.column_stack(parts)
    found.update(left)
    return found


# Meshes of other packages, told by their attributes; none of them is imported.


class Parts:
    """What was found in an object: two arrays, and values of its vertices."""

    def __init__(self, vertices: Any, faces: Any, values: Optional[Mapping[str, Any]] = None):
        self.vertices, self.faces = points(vertices), triangles(faces)
        self.values: Rows = []
        for name, thing in (values or {}).items():
            self._keep(re.sub(r"\s+", "_", str(name)), thing)

    def _keep(self, name: str, thing: Any) -> None:
        try:
            self.values += columns(name, thing, len(self.vertices))
        except (TypeError, ValueError) as error:
            warnings.warn(f"not carried: {error}", LossWarning, stacklevel=5)


def _refuse_cells(names: Iterable[str]) -> None:
    others = sorted(set(names) - {"triangle", "vertex", "line"})
    if others:
        raise ValueError(f"cells that are no triangles: {', '.join(others)}; cut them into triangles")


def _meshio(mesh: Any) -> Parts:
    cells = mesh.cells_dict
    _refuse_cells(cells)
    if "triangle" not in cells:
        raise ValueError("the mesh has no triangles")
    return Parts(mesh.points, cells["triangle"], mesh.point_data)


def _fan_faces(flat: Any) -> Array:
    """Rows of [3, a, b, c, 3, …], as VTK had them and PyVista has them."""
    array = _array(flat, "faces")
    if array.ndim == 1 and array.size % 4 == 0 and (array[::4] == 3).all():
        return array.reshape(-1, 4)[:, 1:]
    raise ValueError("faces that are no triangles: mesh.triangulate() first")


def _pyvista(mesh: Any) -> Parts:
    faces = np.asarray(mesh.faces)
    return Parts(mesh.points, faces if faces.ndim == 2 else _fan_faces(faces), getattr(mesh, "point_data", {}))


def _vtk(mesh: Any) -> Parts:
    polys = mesh.GetPolys()
    if mesh.GetNumberOfStrips():
        raise ValueError("triangle strips: vtkTriangleFilter makes triangles of them")
    offsets = np.asarray(polys.GetOffsetsArray())
    if len(offsets) > 1 and (np.diff(offsets) != 3).any():
        raise ValueError("faces that are no triangles: vtkTriangleFilter cuts them")
    data = mesh.GetPointData()
    names = [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]
    values = {n: np.asarray(data.GetArray(n)) for n in names if n and data.GetArray(n) is not None}
    faces = np.asarray(polys.GetConnectivityArray()).reshape(-1, 3)
    return Parts(np.asarray(mesh.GetPoints().GetData()), faces, values)


def _gifti(image: Any) -> Parts:
    vertices, faces = image.agg_data("pointset"), image.agg_data("triangle")
    if isinstance(vertices, tuple) or isinstance(faces, tuple):
        raise ValueError("a GIFTI image with one pointset and one triangle array is needed")
    return Parts(vertices, faces)


def _trimesh(mesh: Any) -> Parts:
    values = dict(getattr(mesh, "vertex_attributes", {}))
    visual = getattr(mesh, "visual", None)
    if getattr(visual, "kind", None) == "vertex" and visual is not None:
        values["color"] = visual.vertex_colors
    return Parts(mesh.vertices, mesh.faces, values)


def _open3d(mesh: Any) -> Parts:
    values = {}
    if getattr(mesh, "has_vertex_colors", bool)():
        values["color"] = np.asarray(mesh.vertex_colors).astype(np.float32)
    return Parts(np.asarray(mesh.vertices), np.asarray(mesh.triangles), values)


_kinds = (
    (("agg_data",), _gifti),
    (("points", "cells_dict"), _meshio),
    (("points", "faces"), _pyvista),
    (("GetPoints", "GetPolys"), _vtk),
    (("vertices", "faces"), _trimesh),
    (("vertices", "triangles"), _open3d),
)


def parts_of(mesh: Any) -> Parts:
    """The arrays of any mesh that is known by its attributes, or of a pair of arrays."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return Parts(*mesh)
    for attributes, read in _kinds:
        if all(hasattr(mesh, name) for name in attributes):
            return read(mesh)
    raise TypeError(
        f"no mesh: {type(mesh).__name__}; vertices and faces are needed, a pair of them, or a mesh of "
        "sphparam, trimesh, PyVista, VTK, meshio, nibabel or Open3D"
    )
