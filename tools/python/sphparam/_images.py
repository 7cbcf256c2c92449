"""Images that `export` and `paint` take: files, and arrays that become such."""

from __future__ import annotations

import os
import struct
import tempfile
import zlib
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Iterator, Optional, Tuple, Union

import numpy as np

from ._arrays import numbers
from ._baked import BakedImage, as_bytes, require_fit
from ._mesh import Path, existing

if TYPE_CHECKING:
    import numpy.typing as npt

    Bytes = npt.NDArray[np.uint8]
    Floats = npt.NDArray[np.float64]
    Image = Union[Path, npt.NDArray[Any]]


_rounding = 1e-5
"""What computed colours may be beyond 0 and 1."""


def _colours(image: Any, name: str) -> Bytes:
    """The bytes of an array of colours, (H, W, 3) or (H, W, 4)."""
    if isinstance(image, BakedImage) and image.field:
        return image.picture()
    table = numbers(image, name)
    if table.ndim == 2:
        table = table[:, :, None]
    if table.ndim == 3 and table.shape[2] == 1:
        table = np.repeat(table, 3, axis=2)
    if table.ndim != 3 or table.shape[2] not in (3, 4) or 0 in table.shape:
        shape = "×".join(str(n) for n in table.shape) or "a single number"
        raise ValueError(f"{name}: height×width, ×3 or ×4 are needed, not {shape}")
    if table.dtype == np.uint8:
        return table
    if table.dtype.kind != "f":
        raise TypeError(f"{name}: uint8, or floats from 0 to 1, are needed, not {table.dtype}")
    if not (np.isfinite(table).all() and table.min() >= -_rounding and table.max() <= 1 + _rounding):
        raise ValueError(f"{name}: floats from 0 to 1 are needed, not {table.min():.7g} to {table.max():.7g}")
    return as_bytes(table)


def png_of(colours: Bytes, field: str = "") -> bytes:
    """The bytes of a PNG of an array (H, W, 3) or (H, W, 4) of bytes, and in it what it shows."""
    height, width, channels = colours.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), colours.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))

    head = struct.pack(">IIBBBBB", width, height, 8, 6 if channels == 4 else 2, 0, 0, 0)
    body = zlib.compress(rows.tobytes(), 6)
    told = chunk(b"tEXt", b"sphparam:map\0" + field.encode()) if field else b""
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + told + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def as_numbers(image: Any, name: str) -> Tuple[Floats, str]:
    """A table of an equirectangular image, and the convention that it was baked with; empty: it was not."""
    table = numbers(image, name)
    if table.ndim not in (2, 3) or 0 in table.shape or table.shape[1] != 2 * table.shape[0]:
        shape = "×".join(str(n) for n in table.shape) or "a single number"
        raise ValueError(f"{name}: height×width, or ×C, twice as wide as high, are needed, not {shape}")
    baked_for = ""
    if isinstance(image, BakedImage) and image.field:
        baked_for = image.convention
        if not baked_for:
            raise ValueError(f"{name}: a part of a baked image, or turned; the whole is needed, or numpy.asarray(…)")
    return np.asarray(table, dtype=np.float64), baked_for


def at_directions(table: Floats, points: Floats, turns: Tuple[int, float], nearest: bool) -> Floats:
    """What a table has in directions of any length. Beyond a pole a row goes on half a turn away."""
    height, width = table.shape[:2]
    theta, phi = np.arctan2(points[:, 1], points[:, 0]), np.arctan2(np.hypot(points[:, 0], points[:, 1]), points[:, 2])
    u, v = turns[0] * theta / (2 * np.pi) + turns[1], phi / np.pi
    if nearest:
        sampled: Floats = table[np.clip((v * height).astype(int), 0, height - 1), np.floor(u * width).astype(int) % width]
        return sampled

    def on_row(row: Any) -> Any:
        x = (u + 0.5 * ((row < 0) | (row >= height))) * width - 0.5
        column = np.floor(x).astype(int)
        share = (x - column).reshape((-1,) + (1,) * (table.ndim - 2))
        inside = np.clip(row, 0, height - 1)
        return (1 - share) * table[inside, column % width] + share * table[inside, (column + 1) % width]

    y = v * height - 0.5
    above = np.floor(y).astype(int)
    down = (y - above).reshape((-1,) + (1,) * (table.ndim - 2))
    found: Floats = (1 - down) * on_row(above) + down * on_row(above + 1)
    return found


@contextmanager
def as_file(image: Optional[Any], name: str, convention: str, refine_poles: Optional[int] = None) -> Iterator[str]:
    """The path of an image: of the file it is, or of one that is there for as long as it is needed."""
    if image is None:
        yield ""
    elif isinstance(image, (str, os.PathLike)):
        yield existing(image)
    else:
        require_fit(image, name, convention, refine_poles)
        colours = _colours(image, name)
        height, width = colours.shape[:2]
        if width != 2 * height:
            raise ValueError(f"{name}: an equirectangular image is twice as wide as high, not {width}×{height}")
        with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
            path = os.path.join(folder, f"{name}.png")
            with open(path, "wb") as file:
                is_scaled = not isinstance(image, BakedImage) or image._is_of_numbers  # no field any more
                file.write(png_of(colours, "" if is_scaled else image.field))
            yield path
