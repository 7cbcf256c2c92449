"""Images as arrays: what `bake` makes, and what `export` and `paint` take."""

from __future__ import annotations

import os
import struct
import tempfile
import zlib
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Iterator, Optional, Union

import numpy as np

from ._arrays import _array
from ._mesh import Path, existing

if TYPE_CHECKING:
    import numpy.typing as npt

    Bytes = npt.NDArray[np.uint8]
    Image = Union[Path, npt.NDArray[Any]]
    _Floats = npt.NDArray[np.float32]
else:
    _Floats = np.ndarray


class BakedImage(_Floats):
    """A baked field, (H, W, C) float32: an array like others that knows what it shows."""

    field: str
    """``"normal-object"``, ``"curvature:mean"`` and so on; empty for what was computed of it."""
    about: str
    """Unit, space, convention."""

    @classmethod
    def _of(cls, table: Any, field: str, about: str) -> BakedImage:
        image: BakedImage = table.view(cls)
        image.field, image.about = field, about
        return image

    def __array_finalize__(self, other: Any) -> None:
        """Parts and copies show what the whole does."""
        self.field = getattr(other, "field", "")
        self.about = getattr(other, "about", "")

    def picture(self) -> Bytes:
        """Colours to look at or to export, (H, W, 3) or (H, W, 4), 0 to 255.

        Colours become sRGB; directions −1 … 1 become 0 … 255; of numbers the least is black and the
        greatest white.
        """
        table: Any = np.asarray(self, dtype=np.float64)
        if table.ndim == 2:
            table = table[:, :, None]
        if self.field.startswith(("normal", "bent")):
            table = (table + 1) / 2
        elif self.field == "basecolor" or self.field.startswith("color"):
            table = _srgb(table)
        elif self.field not in ("ao",) and "heat" not in self.about:
            least, greatest = table.min(), table.max()
            table = (table - least) / ((greatest - least) or 1)
        elif "heat" in self.about:
            table = _srgb(table)
        return as_bytes(np.repeat(table, 3, axis=2) if table.shape[2] == 1 else table)


def _srgb(linear: Any) -> Any:
    clipped = np.clip(linear, 0, 1)
    coloured = np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
    if clipped.ndim == 3 and clipped.shape[2] == 4:
        coloured[:, :, 3] = clipped[:, :, 3]
    return coloured


def as_bytes(table: Any) -> Bytes:
    """Numbers from 0 to 1 as 0 to 255, rounded to nearest."""
    rounded: Bytes = (np.clip(table, 0, 1) * 255 + 0.5).astype(np.uint8)
    return rounded


def _colours(image: Any, name: str) -> Bytes:
    """The bytes of an array of colours, (H, W, 3) or (H, W, 4)."""
    if isinstance(image, BakedImage):
        return image.picture()
    table = _array(image, name)
    if table.ndim == 2:
        table = np.repeat(table[:, :, None], 3, axis=2)
    if table.ndim != 3 or table.shape[2] not in (3, 4) or 0 in table.shape:
        shape = "×".join(str(n) for n in table.shape)
        raise ValueError(f"{name}: height×width×3 or ×4 are needed, not {shape}")
    if table.dtype == np.uint8:
        return table
    if table.dtype.kind != "f":
        raise TypeError(f"{name}: uint8, or floats from 0 to 1, are needed, not {table.dtype}")
    if not (np.isfinite(table).all() and table.min() >= 0 and table.max() <= 1):
        raise ValueError(f"{name}: floats from 0 to 1 are needed, not {table.min():g} to {table.max():g}")
    return as_bytes(table)


def png_of(colours: Bytes) -> bytes:
    """The bytes of a PNG of an array (H, W, 3) or (H, W, 4) of bytes."""
    height, width, channels = colours.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), colours.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        checked = kind + data
        return struct.pack(">I", len(data)) + checked + struct.pack(">I", zlib.crc32(checked))

    head = struct.pack(">IIBBBBB", width, height, 8, 6 if channels == 4 else 2, 0, 0, 0)
    body = zlib.compress(rows.tobytes(), 6)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


@contextmanager
def as_file(image: Optional[Any], name: str) -> Iterator[str]:
    """The path of an image: of the file it is, or of one that is there for as long as it is needed."""
    if image is None:
        yield ""
    elif isinstance(image, (str, os.PathLike)):
        yield existing(image)
    else:
        colours = _colours(image, name)
        with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
            path = os.path.join(folder, f"{name}.png")
            with open(path, "wb") as file:
                file.write(png_of(colours))
            yield path
