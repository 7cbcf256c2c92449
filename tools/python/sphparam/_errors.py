"""What can go wrong, as exceptions that carry what was found."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Sequence, Tuple


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

    @classmethod
    def _of(cls, rows: Sequence[Tuple[Any, ...]], trial: Optional[Tuple[Any, ...]]) -> MeshError:
        defects = [Defect(*row) for row in rows]
        lines = ["the mesh is not a closed genus-0 manifold"]
        for defect in defects:
            if defect.fatal or defect.kind == "unused-vertex":
                lines.append(f"  {defect.message}" + (f" ({defect.hint})" if defect.hint else ""))
        lines += _advice(trial)
        if any(defect.kind == "several-components" for defect in defects):
            lines.append("sphparam.components(mesh) makes a mesh of each component")
        return cls("\n".join(lines), defects)


def _advice(trial: Optional[Tuple[Any, ...]]) -> list[str]:
    """What repair would do, and what to type for it."""
    if trial is None:
        return []
    options, actions, remaining = trial
    if remaining:
        left = "; ".join(Defect(*row).message for row in remaining)
        return [f"repair cannot mend it, this would remain: {left}"]
    wanted = "dict(" + ", ".join(f"{k}={v!r}" for k, v in options.items()) + ")" if options else "True"
    lines = [f"map(mesh, repair={wanted}) mends it:"]
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
