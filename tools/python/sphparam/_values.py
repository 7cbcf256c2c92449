"""Values of vertices and faces. The library keeps columns of numbers, each with a type of PLY.

An array of k numbers a row is k columns: of colours, normals and texture coordinates with the names that files
have for them, else NAME_0 … NAME_k-1; one of a single number is the column NAME. The other way, columns of these
names are one array where they are of one type, and where that array would have given just these columns.
"""

from __future__ import annotations

import re
from itertools import count as counted
from itertools import takewhile
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Mapping, Tuple

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
    """The type that holds an array, by its name in PLY; whole numbers are kept up to 2⁵³."""
    kind = array.dtype.kind + str(array.dtype.itemsize)
    if kind in ("i8", "u8"):
        least, most = (int(array.min()), int(array.max())) if array.size else (0, 0)
        if -(2**31) <= least and most < 2**31:
            return "int"
        if 0 <= least and most < 2**32:
            return "uint"
        if -(2**53) <= least and most <= 2**53:
            return "int64"
        raise ValueError(f"{name}: whole numbers beyond 2⁵³, which meshes cannot keep: {least} to {most}")
    if kind not in _ply_types:
        raise TypeError(f"{name}: numbers of at most 64 bits are needed, not {array.dtype}")
    return _ply_types[kind]


def _known_name(name: str) -> str:
    return _same_names.get(name.lower(), name.lower())


def _column_names(name: str, width: int) -> Tuple[str, ...]:
    if width == 1:
        return (name,)
    known = _columns.get(_known_name(name))
    if known and width in ((3, 4) if len(known) == 4 else (len(known),)):
        return known[:width]
    return tuple(f"{name}_{k}" for k in range(width))


def _arrays_of(types: Mapping[str, Any]) -> Dict[str, Tuple[str, ...]]:
    """The columns of each array, by columns and their types."""

    def alike(names: Iterable[str], first: str) -> Tuple[str, ...]:
        return tuple(takewhile(lambda name: name in types and types[name] == types[first], names))

    found = {}
    for name, names in _columns.items():
        have = alike(names, names[0])
        if len(have) >= min(3, len(names)):
            found[name] = have
    for first in types:
        base = first[:-2]
        if not first.endswith("_0") or not base or base in types or base in found or base in _of_the_map:
            continue
        have = alike((f"{base}_{k}" for k in counted()), first)
        if f"{base}_{len(have)}" not in types and _column_names(base, len(have)) == have:
            found[base] = have
    together = {name for names in found.values() for name in names}
    found.update((name, (name,)) for name in types if name not in together)
    return found


def _require_colours(array: Array, label: str) -> None:
    """Floats beyond 1 would all become white."""
    if array.dtype.kind == "f" and array.size and not (array.min() >= -1e-5 and array.max() <= 1 + 1e-5):
        raise ValueError(
            f"{label}: colours are floats from 0 to 1, or uint8, not {array.min():.7g} to {array.max():.7g}; "
            "if they go to 255: .astype(np.uint8)"
        )


def columns(name: Any, thing: Any, count: int, what: str = "vertex") -> Rows:
    """An array of values, one row a vertex or face, as columns: name, PLY type, doubles."""
    label = f"{'values' if what == 'vertex' else 'face_values'}[{name!r}]"
    if not isinstance(name, str) or not re.fullmatch(r"[^\s\x00-\x1f\x7f]+", name):
        raise ValueError(f"{label}: a name without blanks is needed")
    _arrays.text(name, label)
    if name in _of_the_map:
        raise ValueError(f"{label}: the map's own names are {', '.join(sorted(_of_the_map))}")
    bare = _arrays.unmasked(thing, label)
    if bare.dtype.kind == "c":
        raise TypeError(f"{label}: a mesh keeps real numbers: two arrays, z.real and z.imag, have complex ones")
    array = bare if bare.dtype.kind == "b" else _arrays.numbers(thing, label)
    if array.ndim not in (1, 2) or len(array) != count:
        shape = "×".join(str(n) for n in array.shape) or "a single number"
        raise ValueError(f"{label}: {count} rows are needed, one a {what}, not {shape}")
    if array.ndim == 2 and array.shape[1] == 0:
        raise ValueError(f"{label}: rows without a number")
    kind = _column_type(array, label)
    table = array.astype(np.float64).reshape(count, 1 if array.ndim == 1 else array.shape[1])
    bad = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(bad):
        raise ValueError(
            f"{label}: {len(bad)} rows are no finite numbers, the first is {bad[0]}; a mesh keeps none, "
            "but a map's resample takes NaN"
        )
    names = _column_names(name, table.shape[1])
    if names[0] in _columns["color"]:
        _require_colours(array, label)
    return [(n, kind, np.ascontiguousarray(table[:, k])) for k, n in enumerate(names)]


class Columns:
    """Columns of arrays that come back as they were given.

    ``there``: columns of a mesh and their arrays; what gets the name of one of its arrays takes its place.
    """

    def __init__(self, count: int, what: str = "vertex", there: Iterable[Tuple[str, Array]] = ()) -> None:
        self.rows: Rows = []
        self.dropped: List[str] = []
        self._count, self._what = count, what
        self._types = {name: _column_type(array, name) for name, array in there}
        self._theirs = _arrays_of(self._types)
        self._whole: Dict[str, Tuple[str, ...]] = {}

    def add(self, name: Any, thing: Any) -> None:
        """One more; ``ValueError`` where it could not be told from another one."""
        rows = columns(name, thing, self._count, self._what)
        names = tuple(row[0] for row in rows)
        array = name if len(names) == 1 or names[0] == f"{name}_0" else _known_name(name)
        replaced = self._theirs.pop(array, ())
        types = {column: kind for column, kind in self._types.items() if column not in replaced}
        whole = {**self._whole, array: names} if len(names) > 1 else self._whole
        for column in names:
            if column in types:
                raise ValueError(f"values[{name!r}]: {self._owner(column)} has a column {column!r} too; give one another name")
        types.update((column, kind) for column, kind, _ in rows)
        found = _arrays_of(types)
        for mine, its in whole.items():
            if found.get(mine) != its:
                other = name if mine != array else self._beside(mine, types, its)
                raise ValueError(f"values[{mine!r}]: its columns are {its[0]} … {its[-1]}, which with {other!r} would be other arrays; give one another name")
        self.dropped += replaced
        self.rows += rows
        self._types, self._whole = types, whole

    def _owner(self, column: str) -> str:
        for name, names in {**_arrays_of(self._types), **self._whole}.items():
            if column in names:
                return repr(name)
        return "another one"

    @staticmethod
    def _beside(name: str, types: Mapping[str, Any], its: Tuple[str, ...]) -> str:
        names = (name, f"{name}_{len(its)}", *_columns.get(name, ()))
        return next((other for other in names if other in types and other not in its), name)


class Values(Mapping[str, "Array"]):
    """What vertices or faces carry, by names: read-only arrays. Columns have their own names as well."""

    __slots__ = ("_found", "_columns")

    def __init__(self, rows: Iterable[Tuple[str, Array]]) -> None:
        left = {name: array for name, array in rows if name not in ("sx", "sy", "sz", "theta", "phi")}
        self._columns = _arrays_of({name: array.dtype for name, array in left.items()})
        self._found: Dict[str, Array] = {}
        for name, names in self._columns.items():
            array = left[name] if names == (name,) else np.column_stack([left[column] for column in names])
            self._found[name] = read_only(array)

    def __getitem__(self, name: str) -> Array:
        if name in self._found:
            return self._found[name]
        for array, names in self._columns.items():
            if name in names:
                column: Array = self._found[array][:, names.index(name)]
                return column
        raise KeyError(name)

    def __setitem__(self, name: str, array: Array) -> None:
        """Only packages that put back what they have found may (meshio does): nothing changes."""
        if array is not self._found.get(name):
            raise TypeError("values cannot be changed; dict(…) of them can")

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def __repr__(self) -> str:
        return repr(self._found)

    def columns(self, name: str) -> Tuple[str, ...]:
        """Those that an array is kept in; of others the name itself."""
        return self._columns.get(name, (name,))


def read_only(array: Array) -> Array:
    """The same, which nobody may write to: a mesh and a map have their own."""
    array.flags.writeable = False
    return array
