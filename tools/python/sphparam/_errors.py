"""What can go wrong, as exceptions that carry what was found."""

from __future__ import annotations

import re
from typing import Any, List, Mapping, NamedTuple, Optional, Sequence, Tuple

from ._attributes import document

_typed_here = {
    "energy.lambda is": "weight (lambda) is",
    "image_width is": "image_size is",
    "align_to: ": "align: ",
    "say --alike": "say alike=True",
    "leave out --adaptive": "leave out adaptive=True",
    "(--faces 0) and no --gap": "(triangles=0) and no gap",
    "give --landmarks": "give landmarks",
    "a smaller --feature-weight": "a smaller feature_weight=",
    "(--unit)": "(unit=)",
    "(--body)": "(body=)",
    "another --resolution": "another resolution=",
    "a finer --grid": "a finer grid=",
    "; --keep-holes closes": "; repair=dict(keep_holes=True) closes",
    "--repair=orientation turns it over": "repair=True where it is mapped turns it over",
    "--map radius --centre centroid is": 'bake("radius", centre="centroid") is',
    "--centre centroid is": 'centre="centroid" is',
    "`sphparam map` --method radial has the body's, --align body comes near": 'map(mesh, method="radial") has the body\'s, align="body" comes near',
    "`sphparam map` --align body comes near": 'map(mesh, align="body") comes near',
    "`sphparam repair` turns it over": "repair(read(path)) turns it over, save makes a file of it",
    "`sphparam bake --map normal-tangent` makes it": 'bake("normal-tangent") makes it',
    "; `--limit file=N` raises it": "; read(path, limits=dict(file=N)) raises it",
    "`sphparam bake --normal-y gl` makes it so": "without normal_y_down it is baked so",
}
"""Options of the program in messages of the library, and what is typed here."""


def as_typed_here(message: str) -> str:
    """A message of the library, with arguments where it names options of the program."""
    for option, argument in _typed_here.items():
        message = message.replace(option, argument)
    message = re.sub(r"--max-edge (\S+)", r"repair=dict(edge_length=\1)", message)
    message = re.sub(r"--repair --weld (\S+)%", _as_weld_typed, message)
    message = re.sub(r", with --centre (\S+)$", r", with centre=(\1)", message)
    return re.sub(r": --convention (\w+) shows", r': convention="\1" shows', message)


def _as_weld_typed(option: re.Match[str]) -> str:
    return f"repair=dict(weld_share={float(option[1]) / 100:.6g})"


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
    def _of(cls, rows: Sequence[Tuple[Any, ...]], trial: Optional[Mapping[str, Any]]) -> MeshError:
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


def _advice(defects: Sequence[Defect], trial: Optional[Mapping[str, Any]]) -> List[str]:
    """What to type: what keeps all of a mesh before what keeps one of its parts, holes kept after holes filled."""
    if trial is None or any(defect.kind == "index-out-of-range" for defect in defects):
        return []
    can_wrap = trial["wrap"] and all(defect.kind != "non-finite-position" for defect in defects)
    whole = ["sphparam.wrap(mesh).mesh is one closed surface about all of it"] if can_wrap else []
    if trial["remaining"]:
        left = "; ".join(Defect(*row).message for row in trial["remaining"])
        return [*_parts_advice(trial["parts"]), f"repair cannot mend it, this would remain: {left}", *whole]
    kept, options = trial["kept"], trial["options"]
    does = "mends it" if kept is None else f"keeps {100 * kept:.5g} % of the area"
    lines = [*_parts_advice(trial["parts"]), *whole, f"map(mesh, repair={_as_typed(options)}) {does}:"]
    lines += [f"  {message}" for _, _, _, message in trial["actions"]]
    if trial["fills"] and not options.get("keep_holes"):
        limits = {name: value for name, value in options.items() if name != "largest_hole"}
        keeping = _as_typed({**limits, "keep_holes": True})
        lines.append(f"map(mesh, repair={keeping}) keeps the holes, closed by what is no surface")
    return lines


def _parts_advice(parts: Optional[Tuple[bool, Mapping[str, Any]]]) -> List[str]:
    """What maps each part of a mesh; nothing where that is not so of all."""
    if parts is None:
        return []
    as_they_are, options = parts
    each = "map(part) for part in sphparam.components(mesh)"
    if not as_they_are:
        each = f"map(part, repair={_as_typed(options)}) for part in sphparam.components(mesh, repair=True)"
    return [f"[{each}] maps each component"]


def _as_typed(options: Mapping[str, Any]) -> str:
    """What ``repair=`` is given."""
    return "dict(" + ", ".join(f"{name}={value!r}" for name, value in options.items()) + ")" if options else "True"


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


document(globals())
