"""Arrays and numbers, looked at before anything is converted."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any, List, Optional, Tuple

from ._numpy import np

if TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[Any]

_most_rows = 2**31 - 1


def _require_unmasked(thing: Any, name: str) -> None:
    """What a mask hides is nobody's number."""
    if isinstance(thing, np.ma.MaskedArray) and np.ma.is_masked(thing):
        raise ValueError(f"{name}: some of it is masked; fill or drop these rows first")


def unmasked(thing: Any, name: str) -> Array:
    """An array of anything."""
    _require_unmasked(thing, name)
    found: Array = np.asarray(thing)
    return found


def numbers(thing: Any, name: str, rounded_by: str = "float") -> Array:
    """An array of numbers; nothing is guessed from texts and objects."""
    if isinstance(thing, (str, bytes, dict, set)) or thing is None:
        raise TypeError(f"{name}: an array is needed, not {type(thing).__name__}")
    _require_unmasked(thing, name)
    try:
        array = np.asarray(thing)  # what it warns of is the user's to hear: filters are those of all threads
    except ValueError as error:
        raise ValueError(f"{name}: no array can be made of it: {error}") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: numbers are needed, not {array.dtype}")
    if array.dtype.itemsize > 8:
        raise TypeError(f"{name}: numbers of at most 64 bits are needed, not {array.dtype}; {name}.astype({rounded_by}) rounds")
    # Of either order of bytes; the library has no halves.
    found: Array = array.astype(np.float32) if array.dtype.kind == "f" and array.dtype.itemsize == 2 else array
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
    if array.shape == (3,) and what == "coordinates":
        message += "; a single row is [[x, y, z]]"
    raise ValueError(message)


def points(thing: Any, name: str = "vertices") -> Array:
    """Three coordinates a row, as the module `_core` reads them; finiteness is told later."""
    return _three_columns(numbers(thing, name), name, "coordinates")


def finite_points(thing: Any, name: str, count: Optional[int] = None) -> Array:
    """The same, with finite numbers and so many rows."""
    array = points(thing, name)
    if count is not None and len(array) != count:
        raise ValueError(f"{name}: {count} rows are needed, one a vertex, not {len(array)}")
    bad = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(bad):
        raise ValueError(f"{name}: {len(bad)} rows are no finite numbers, the first is {bad[0]}")
    return array


def require_rows(array: Array, name: str, count: int) -> None:
    """One row a vertex."""
    if array.ndim == 0 or len(array) != count:
        shape = "×".join(str(n) for n in array.shape) or "a single number"
        raise ValueError(f"{name}: {count} rows are needed, one a vertex, not {shape}")


def directions(thing: Any, name: str = "directions") -> Array:
    """Finite rows, none of which is zero."""
    array = finite_points(thing, name)
    bad = np.flatnonzero(~array.any(axis=1))
    if len(bad):
        raise ValueError(f"{name}: row {bad[0]} is 0, which is no direction")
    return array


def triangles(thing: Any, name: str = "faces") -> Array:
    """Three indices a row; whether vertices of these numbers are there is told later."""
    array = numbers(thing, name, "np.int64")
    if array.dtype.kind == "f":
        raise TypeError(
            f"{name}: whole numbers are needed, not {array.dtype}; "
            f"if they are whole: {name}.astype(np.int64)"
        )
    return _three_columns(array, name, "triangles")


def whole(number: Any, name: str, least: int, most: Optional[int] = None) -> int:
    """A whole number from ``least`` to ``most``."""
    found = _index(number, name, "a whole number is needed")
    if found < least or (most is not None and found > most):
        raise ValueError(f"{name}: {least} to {most} is needed, not {found}" if most else f"{name}: from {least}, not {found}")
    return found


def vertex(number: Any, name: str) -> int:
    """A number of a vertex; whether it is there is told later."""
    found = _index(number, name, "a vertex is a whole number")
    if not 0 <= found < 2**31:
        raise ValueError(f"{name}: no mesh has a vertex {found}")
    return found


def _index(number: Any, name: str, wanted: str) -> int:
    """Of Python's whole numbers and NumPy's, of which an array may be one."""
    try:
        if not isinstance(number, (bool, np.bool_)):
            return operator.index(number)
    except TypeError:
        pass
    raise TypeError(f"{name}: {wanted}, not {number!r}")


def degrees(thing: Any, name: str) -> float:
    """An angle between faces."""
    angle = real(thing, name)
    if not 0 <= angle <= 180:
        raise ValueError(f"{name}: 0 to 180 degrees are needed, not {angle}")
    return angle


def flag(thing: Any, name: str) -> bool:
    """True or False, of Python or NumPy, and nothing that could be taken for one."""
    if not isinstance(thing, bool) and not isinstance(thing, np.bool_):
        raise TypeError(f"{name}: True or False is needed, not {thing!r}")
    return bool(thing)


def real(thing: Any, name: str) -> float:
    """A number; its domain is told later."""
    try:
        if not isinstance(thing, (str, bytes)):
            return float(thing)
    except (TypeError, ValueError, OverflowError):
        pass
    raise TypeError(f"{name}: a number is needed, not {thing!r}")


def threads(number: int) -> int:
    """0 for all cores, or how many."""
    return whole(number, "threads", 0, 4096)


def text(thing: Any, name: str) -> str:
    """A text, and nothing that could be made one."""
    if not isinstance(thing, str):
        raise TypeError(f"{name}: a text is needed, not {type(thing).__name__}")
    if not thing.isascii() and thing.encode(errors="ignore").decode() != thing:
        raise ValueError(f"{name}: half a letter is no text: {thing!a}")
    return thing


def listed(things: Any, name: str, what: str) -> List[Any]:
    """Several things; a single one is none of these."""
    try:
        return list(things)
    except TypeError:
        raise TypeError(f"{name}: a list of {what} is needed, not {type(things).__name__}") from None


def three(thing: Any, name: str) -> Tuple[float, float, float]:
    """Three finite numbers."""
    array = numbers(thing, name)
    if array.shape != (3,):
        shape = "×".join(str(n) for n in array.shape) or "a single one"
        raise ValueError(f"{name}: three numbers are needed, not {shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: three finite numbers are needed, not {', '.join(map(str, array))}")
    x, y, z = array.tolist()
    return float(x), float(y), float(z)


def least_and_greatest(thing: Any, name: str) -> Tuple[float, float]:
    """Two finite numbers, the smaller one first."""
    ends = [real(end, name) for end in listed(thing, name, "two numbers")]
    if len(ends) != 2 or not np.isfinite(ends).all() or not ends[0] < ends[1]:
        raise ValueError(f"{name}: two finite numbers are needed, the smaller one first, not {thing!r}")
    return ends[0], ends[1]


def width_and_height(size: Any) -> Tuple[int, int]:
    """Texels both ways; how many there may be is told later."""
    sides = listed(size, "size", "two numbers, width and height,")
    if len(sides) != 2:
        raise ValueError(f"size: width and height are needed, not {len(sides)} numbers")
    width, height = (whole(side, "size", 1, 2**31 - 1) for side in sides)
    return width, height
