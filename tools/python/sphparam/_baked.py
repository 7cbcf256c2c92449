"""Baked fields as arrays that know what they show, and where they fit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional, Tuple

import numpy as np

from ._attributes import document

if TYPE_CHECKING:
    import numpy.typing as npt

    Bytes = npt.NDArray[np.uint8]
    _Floats = npt.NDArray[np.float32]
else:
    _Floats = np.ndarray


class Baked(NamedTuple):
    """What an image as a whole was baked for."""

    convention: str
    refine_poles: Optional[int]
    """None: by direction, for any chart."""
    normal_y_down: bool
    frame: Optional[int]
    """Of tangent normals the fingerprint of the map whose frame they are in."""


class BakedImage(_Floats):
    """A baked field, (H, W, C) float32: an array like others that knows what it shows.

    Colours are sRGB from 0 to 1, as ``imshow`` shows and ``texture=`` takes them. What is computed of it is
    an array of NumPy's and knows no more; views and copies show what it shows.
    """

    field: str
    """``"normal-object"``, ``"curvature:mean"`` and so on; empty for what was computed of it."""
    about: str
    """Unit, space, convention."""
    _baked: Optional[Baked]

    @classmethod
    def _of(cls, table: Any, field: str, about: str, baked: Baked) -> BakedImage:
        if is_colour(field, about):
            about += ", sRGB"
        image: BakedImage = _encoded(table, field, about).view(cls)
        return image._showing((field, about, baked))

    def _showing(self, shown: Tuple[str, str, Optional[Baked]]) -> BakedImage:
        self.field, self.about, self._baked = shown
        return self

    @property
    def _shown(self) -> Tuple[str, str, Optional[Baked]]:
        return self.field, self.about, self._baked

    @property
    def convention(self) -> str:
        """Where longitude goes in it, as it was baked; empty for parts and for what was computed of it."""
        return self._baked.convention if self._baked else ""

    def __array_finalize__(self, other: Any) -> None:
        """Views of it show what it does; only the whole is what was baked."""
        if not isinstance(other, BakedImage) or self.base is None:
            self._showing(("", "", None))
            return
        field, about, baked = other._shown
        same = all(getattr(self, name) == getattr(other, name) for name in ("shape", "strides"))
        self._showing((field, about, baked if same and self.ctypes.data == other.ctypes.data else None))

    def __array_wrap__(self, array: Any, *context: Any) -> Any:
        if array is self:  # written to in place
            return self._showing(("", "", None))
        return np.asarray(array)[()]

    def copy(self, *order: Any, **orders: Any) -> Any:
        """Another array that shows the same."""
        return super().copy(*order, **orders)._showing(self._shown)

    def astype(self, *to: Any, **how: Any) -> Any:
        """The same in numbers of another type."""
        made = super().astype(*to, **how)
        return made._showing(self._shown) if isinstance(made, BakedImage) else made

    def __deepcopy__(self, memo: Any) -> Any:
        return self.copy()

    def __reduce__(self) -> Any:
        rebuild, arguments, state = super().__reduce__()  # type: ignore[misc]
        return rebuild, arguments, (state, self._shown)

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])
        self._showing(state[1])

    @property
    def _is_of_numbers(self) -> bool:
        """Whether its picture is scaled from dark to bright: it shows neither colours nor shares nor directions."""
        directions = self.field.startswith(("normal", "bent"))
        return not directions and self.field not in _shares and not is_colour(self.field, self.about)

    def picture(self) -> Bytes:
        """Colours to look at or to export, (H, W, 3) or (H, W, 4), 0 to 255.

        Colours and shares 0 … 1 become 0 … 255, directions −1 … 1 too; of other numbers the least is black
        and the greatest white. Where holes were kept they are transparent.
        """
        table: Any = np.asarray(self, dtype=np.float64)
        if table.ndim == 2:
            table = table[:, :, None]
        covered = np.ones(table.shape[:2] + (1,))
        if table.shape[2] in (2, 4):
            table, covered = table[:, :, :-1], table[:, :, -1:]
        if self.field.startswith(("normal", "bent")):
            table = (table + 1) / 2
        elif self._is_of_numbers:
            shown = table[covered[:, :, 0] > 0]
            least, greatest = (shown.min(), shown.max()) if shown.size else (0, 0)
            table = (table - least) / ((greatest - least) or 1)
        colours = np.repeat(table, 3, axis=2) if table.shape[2] == 1 else table
        return as_bytes(np.concatenate([colours, covered], axis=2) if self.shape[-1] in (2, 4) else colours)


    def _repr_png_(self) -> Optional[bytes]:
        """What a notebook shows: every so many texels of large images."""
        from ._images import png_of

        if self.ndim != 3 or not self.field or not self.size or self.shape[2] > 4:
            return None
        step = max(1, self.shape[1] // 1024)
        every: Any = self[::step, ::step]
        return png_of(every.picture())


_shares = ("ao", "mask", "occlusion", "roughness", "metallic", "orm")


def is_colour(field: str, about: str) -> bool:
    """Whether a field shows colours: of the surface or its light, or of numbers with ``heat``."""
    return field in ("basecolor", "vcolor", "emissive") or about.startswith("colours of ")


def _encoded(table: Any, field: str, about: str) -> Any:
    """Colours, which the library has in linear light, as sRGB, in place; shares of rounded weights at most 1."""
    coverage = table.shape[2] in (2, 4)
    if coverage or field in _shares:
        shares = table[:, :, -1:] if field not in _shares else table
        np.clip(shares, 0, 1, out=shares)
    if is_colour(field, about):
        for row in table[:, :, : 3 if coverage else None]:  # one by one: no second image in memory
            row[...] = _srgb(row.astype(np.float64))
    return table


def _srgb(linear: Any) -> Any:
    """The curve, which goes on beyond 1 for images that are brighter; what is rounded beyond 1 is 1."""
    light = np.where((linear > 1) & (linear < 1 + 1e-5), 1, linear)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0) ** (1 / 2.4) - 0.055)


def as_bytes(table: Any) -> Bytes:
    """Numbers from 0 to 1 as 0 to 255, rounded to nearest."""
    rounded: Bytes = (np.clip(table, 0, 1) * 255 + 0.5).astype(np.uint8)
    return rounded


def require_fit(image: Any, name: str, convention: str, refine_poles: Optional[int]) -> None:
    """Refuses a baked image where it would lie elsewhere than it was baked for."""
    if not isinstance(image, BakedImage) or not image.field:
        return
    if image._baked is None:
        raise ValueError(f"{name}: a part of a baked image; the whole is needed, or picture() for what you know to fit")
    if image._baked.convention != convention:
        raise ValueError(
            f"{name}: baked with convention={image._baked.convention!r}, taken with convention={convention!r}"
        )
    if None not in (refine_poles, image._baked.refine_poles) and image._baked.refine_poles != refine_poles:
        raise ValueError(
            f"{name}: baked with refine_poles={image._baked.refine_poles}, exported with refine_poles={refine_poles}"
        )


def require_kind(image: Any, name: str, *fields: str, fingerprint: Optional[Callable[[], int]] = None) -> None:
    """Refuses a baked image of other fields, and tangent normals of another mesh's frame."""
    if not isinstance(image, BakedImage) or not image.field:
        return
    if image.field not in fields:
        others = "".join(f", or of {other!r}" for other in fields[1:])
        raise ValueError(f"{name}: an image of {fields[0]!r} is needed{others}, not of {image.field!r}")
    if fingerprint is None or image._baked is None:
        return
    if image._baked.normal_y_down:
        raise ValueError(f"{name}: baked with normal_y_down=True; glTF and OBJ want normals with y up")
    if image._baked.frame != fingerprint():
        raise ValueError(f"{name}: baked for another mesh; bake({image.field!r}, target=…) makes it for the one exported")


document(globals())
