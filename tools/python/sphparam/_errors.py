"""What can go wrong, as exceptions that carry what was found."""

from __future__ import annotations

import re
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple


class Defect(NamedTuple):
    """One kind of defect of a mesh, with its first places."""

    kind: str
    """``"boundary-edge"``, ``"wrong-genus"``, ``"non-finite-position"`` and so on."""
    fatal: bool
    """True where no map to the sphere exists while this stands."""
    places: int
    """How many places have it."""
    ids: Tuple[int, ...]
    """The first places, from 0: vertices or faces; of edges their vertices, two by two."""
    message: str
    """What it is, for people."""
    hint: str
    """What can be done about it; may be empty."""


class MeshError(ValueError):
    """A mesh that cannot be mapped: it is no closed genus-0 manifold, or its arrays are none.

    ``defects`` lists all that is wrong with it, as :class:`Defect`.
    """

    defects: Tuple[Defect, ...]

    def __init__(self, message: str, defects: Sequence[Defect] = ()) -> None:
        super().__init__(message)
        self.defects = tuple(defects)

    @property
    def _text(self) -> List[str]:
        return str(self).split("\n")[1:]

    @classmethod
    def _of(cls, rows: Sequence[Tuple[Any, ...]], trial: Optional[Tuple[Any, ...]]) -> MeshError:
        defects = [Defect(*row) for row in rows]
        return cls._instead(defects, _advice(defects, trial))

    @classmethod
    def _instead(cls, defects: Sequence[Defect], advice: Sequence[str]) -> MeshError:
        for defect in defects:
            if "count from 1" in defect.hint:  # all else follows from that
                what = defect.message.split(":")[0]
                return cls(f"faces: {defect.hint} is what to pass; as they are, {what}", defects)
        return cls("\n".join(["the mesh is not a closed genus-0 manifold", *_told(defects), *advice]), defects)

    def _with_indices(self, outside: str) -> MeshError:
        """Says which indices were out of range; what follows from them is no matter yet."""
        if "count from 1" in str(self):
            return self
        wrong = [defect.message for defect in self.defects if defect.kind == "index-out-of-range"]
        return MeshError(f"{wrong[0]}: {outside}", self.defects) if wrong else self


def _told(defects: Sequence[Defect]) -> List[str]:
    """A line about each that is in the way."""
    return [
        f"  {defect.message}" + (f" ({defect.hint})" if defect.hint else "")
        for defect in defects
        if defect.fatal or defect.kind == "unused-vertex"
    ]


def _advice(defects: Sequence[Defect], trial: Optional[Tuple[Any, ...]]) -> List[str]:
    """What to type: the parts of a mesh by themselves before one of them alone, holes kept after holes filled."""
    kinds = {defect.kind: defect for defect in defects}
    if "index-out-of-range" in kinds:
        return []
    parts = kinds.get("several-components")
    if parts is None:
        kept = ["map(mesh, repair=dict(keep_holes=True)) keeps the holes, closed by what is no surface"]
        return _repair_advice(trial, "mends it") + (kept if "boundary-edge" in kinds and trial else [])
    alone = all(defect is parts or not defect.fatal for defect in defects)
    each = "map(part) for part in sphparam.components(mesh)"
    if not alone:
        each = "map(part, repair=True) for part in sphparam.components(mesh, repair=True)"
    share = re.search(r"([\d.]+) % of the area", parts.message)
    keeps = f"keeps {share[1]} % of the area" if share else "keeps one"
    return [
        f"[{each}] maps each component;",
        *_repair_advice(trial, keeps),
    ]


def _repair_advice(trial: Optional[Tuple[Any, ...]], does: str) -> List[str]:
    """What repair would do."""
    if trial is None:
        return []
    options, actions, remaining = trial
    if remaining:
        left = "; ".join(Defect(*row).message for row in remaining)
        return [f"repair cannot mend it, this would remain: {left}"]
    wanted = "dict(" + ", ".join(f"{k}={v!r}" for k, v in options.items()) + ")" if options else "True"
    lines = [f"map(mesh, repair={wanted}) {does}:"]
    return lines + [f"  {message}" for _, _, _, message in actions]


class NotCertified(RuntimeError):
    """A map that is not one-to-one, or does not have what was asked for where it was asked for.

    ``certificate`` says what is proved of it, where a map was made; else it is None.
    """

    certificate: Optional[Any]

    def __init__(self, message: str, certificate: Optional[Any] = None) -> None:
        super().__init__(message)
        self.certificate = certificate

    @classmethod
    def _of(cls, message: str, figures: dict[str, Any]) -> NotCertified:
        from ._figures import Certificate

        return cls(message, Certificate(**figures))


class Cancelled(RuntimeError):
    """The progress callback has returned False."""


class SolveError(ArithmeticError):
    """A system of equations that could not be solved; the message names it."""


class ReadError(OSError):
    """A file that cannot be read, with the place."""


class WriteError(OSError):
    """A file that cannot be written, with the reason; nothing was written."""


class ImageError(OSError):
    """An image that cannot be read or written."""


class LossWarning(UserWarning):
    """What a file or an object carries and was left out, or what a result is not."""
