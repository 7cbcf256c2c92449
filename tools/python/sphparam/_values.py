"""Values of vertices and faces. The library keeps columns of numbers, each with a type of PLY."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Tuple

from . import _arrays
from ._numpy import np

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[Any]
    Rows = List[Tuple[str, str, Array]]

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


def _require_colours(array: Array, label: str) -> None:
    """Floats beyond 1 would all become white."""
    if array.dtype.kind == "f" and array.size and not (array.min() >= -1e-5 and array.max() <= 1 + 1e-5):
        raise ValueError(
            f"{label}: colours are floats from 0 to 1, or uint8, not {array.min():.7g} to {array.max():.7g}; "
            "if they go to 255: .astype(np.uint8)"
        )


def columns(name: Any, thing: Any, count: int, what: str = "vertex") -> Rows:
    """An array of values, one row a vertex or face, as columns: name, PLY type, doubles."""
    label = f"values[{name!r}]"
    if not isinstance(name, str) or not re.fullmatch(r"\S+", name):
        raise ValueError(f"{label}: a name without blanks is needed")
    if name in _of_the_map:
        raise ValueError(f"{label}: the map's own names are {', '.join(sorted(_of_the_map))}")
    bare = _arrays.unmasked(thing, label)
    array = bare if bare.dtype.kind == "b" else _arrays.numbers(thing, label)
    if array.ndim not in (1, 2) or len(array) != count:
        shape = "×".join(str(n) for n in array.shape) or "a single number"
        raise ValueError(f"{label}: {count} rows are needed, one a {what}, not {shape}")
    if array.ndim == 2 and array.shape[1] == 0:
        raise ValueError(f"{label}: rows without a number")
    kind = _column_type(array, label)
    doubles = array.astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(doubles.reshape(count, -1)).all(axis=1))
    if len(bad):
        raise ValueError(
            f"{label}: {len(bad)} rows are no finite numbers, the first is {bad[0]}; a mesh keeps none, "
            "but a map's resample takes NaN"
        )
    names = _column_names(name, array)
    if names[0] in _columns["color"]:
        _require_colours(array, label)
    table = doubles.reshape(count, len(names))
    return [(n, kind, np.ascontiguousarray(table[:, k])) for k, n in enumerate(names)]


def grouped(rows: Iterable[Tuple[str, Array]]) -> Dict[str, Array]:
    """Columns as they were given: colours, normals and numbered columns side by side. Read-only arrays: a mesh has its own."""
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
    for array in found.values():
        array.flags.writeable = False
    return found
