"""What a map is, and what is known of it."""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING, Any, Callable, Dict, List, NoReturn, Optional, Sequence, Tuple, Type, TypeVar

from . import _core, _values
from ._errors import as_typed_here
from ._figures import Action, Certificate, Distortion, FaceDistortion, HandleLoop, InSpace, Radial, Stage
from ._mesh import Mesh, numbered
from ._numpy import np

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt

    Array = npt.NDArray[Any]
    Flags = npt.NDArray[numpy.bool_]
    Floats = npt.NDArray[numpy.float64]
    Ints = npt.NDArray[numpy.int32]

_T = TypeVar("_T")
_M = TypeVar("_M", bound="MapFacts")


class MapFacts:
    """A mesh with a proved map. It never changes, and what is asked of it is found out once."""

    __slots__ = ("_mapped", "_found")

    _mapped: _core.Mapped
    _found: Dict[str, Any]

    def __init__(self) -> None:
        raise TypeError("sphparam.map(vertices, faces) makes maps, sphparam.load(path) reads them")

    @classmethod
    def _of(cls: Type[_M], mapped: _core.Mapped) -> _M:
        made = cls.__new__(cls)
        made._mapped, made._found = mapped, {}
        return made

    def _once(self, name: str, make: Callable[[], _T]) -> _T:
        if name not in self._found:
            self._found[name] = make()
        found: _T = self._found[name]
        return found

    def _fingerprint(self) -> int:
        """The same for the same mesh with the same map."""

        def count() -> int:
            found = 0
            arrays: Tuple[Any, ...] = (self.vertices, self.faces, self.points)
            for array in arrays:
                found = zlib.crc32(array, found)
            return found

        return self._once("fingerprint", count)

    def __copy__(self: _M) -> _M:
        return self

    def __deepcopy__(self: _M, memo: Any) -> _M:
        return self

    def __reduce__(self) -> NoReturn:
        raise TypeError("a map cannot be pickled: m.save('a.sph.ply') writes it, sphparam.load reads it again")

    @property
    def vertices(self) -> Floats:
        """(V, 3) positions on the surface, read-only."""
        return self._mapped.vertices

    @property
    def faces(self) -> Ints:
        """(F, 3) indices of vertices, read-only."""
        return self._mapped.faces

    @property
    def points(self) -> Floats:
        """(V, 3) unit vectors, where the vertices go on the sphere; read-only."""
        return self._mapped.points

    @property
    def theta(self) -> Floats:
        """(V,) longitude in radians, 0 to 2π."""
        return self._angles()[0]

    @property
    def phi(self) -> Floats:
        """(V,) polar angle in radians, 0 at +z to π at −z."""
        return self._angles()[1]

    def _angles(self) -> Tuple[Floats, Floats]:
        def find() -> Tuple[Floats, Floats]:
            theta, phi = _core.angles(self._mapped)
            return _values.read_only(theta), _values.read_only(phi)

        return self._once("angles", find)

    @property
    def values(self) -> _values.Values:
        """What vertices carry: name to (V,) or (V, k), in its own type, read-only."""
        return self._once("values", lambda: _values.Values(self._mapped.vertex_values()))

    @property
    def face_values(self) -> _values.Values:
        """What faces carry: name to (F,) or (F, k), read-only."""
        return self._once("face_values", lambda: _values.Values(self._mapped.face_values()))

    @property
    def polygons(self) -> Optional[List[Ints]]:
        """Faces as a grid has them, quads too, where ``faces`` are these cut; else None."""
        found = self._mapped.polygons
        return None if found is None else np.split(found[0], found[1][1:-1])

    @property
    def mesh(self) -> Mesh:
        """The mesh alone, a copy."""
        return self._as_mesh(True)

    def _as_mesh(self, whole: bool) -> Mesh:
        made = Mesh._of(_core.source_of_mapped(self._mapped, whole), share=self._found.get("share", 1.0))
        made._welds = self._found.get("welds", ())
        return made

    @property
    def fillers(self) -> Flags:
        """(F,) True where a face only closes a hole that was kept: it is mapped, but no surface."""
        marks: Flags = self._once("fillers", lambda: _values.read_only(self._mapped.fillers.view(bool)))
        return marks

    @property
    def surface(self) -> Mesh:
        """The mesh without its fillers, a copy: with its holes where these were kept."""
        return self._as_mesh(False)

    @property
    def name(self) -> str:
        """The file or grid it comes from."""
        return self._mapped.name

    @property
    def certificate(self) -> Certificate:
        """What was proved of ``points``, with exact signs."""
        return self._once("certificate", lambda: Certificate(**_all_read_only(self._mapped.certificate)))

    @property
    def distortion(self) -> Distortion:
        """How the map distorts the surface, in figures."""
        return self._measured()[0]

    @property
    def face_distortion(self) -> FaceDistortion:
        """How the map distorts, face by face; NaN for fillers."""
        return self._measured()[1]

    def _measured(self) -> Tuple[Distortion, FaceDistortion]:
        def measure() -> Tuple[Distortion, FaceDistortion]:
            found = _core.distortion(self._mapped, 0)
            return Distortion(**found.pop("summary")), FaceDistortion(**_all_read_only(found))

        return self._once("distortion", measure)

    def _account(self) -> Dict[str, Any]:
        return self._once("account", lambda: self._mapped.account or {})

    @property
    def stages(self) -> Tuple[Stage, ...]:
        """What each stage of the map did, in their order; empty for maps that were read."""
        rows = self._account().get("stages", ())
        return tuple(Stage(n, s, f, Distortion(**d) if d else None) for n, s, f, d in rows)

    @property
    def seconds(self) -> float:
        """Wall time of the map in the library, its certificate included; 0 for maps that were read."""
        seconds: float = self._account().get("seconds", 0.0)
        return seconds

    @property
    def processor_seconds(self) -> float:
        """The same summed over all processors, and over all that this process did meanwhile."""
        seconds: float = self._account().get("processor_seconds", 0.0)
        return seconds

    @property
    def poles(self) -> Optional[Tuple[int, int]]:
        """The vertices at +z and −z by their numbers in the mesh that was given, or None."""
        if self._account():
            made: Optional[Tuple[int, int]] = self._account()["poles"]
            return made
        noted = self._once("poles", lambda: self._noted("poles", ((0.0, 0.0, 1.0), (0.0, 0.0, -1.0))))
        return (noted[0], noted[1]) if noted else None

    @property
    def meridian(self) -> Optional[int]:
        """A vertex with θ = 0 that was asked for or chosen, or None."""
        if self._account():
            made: Optional[int] = self._account()["meridian"]
            return made
        noted = self._once("meridian", lambda: self._noted("meridian", ((None, 0.0, None),)))
        return noted[0] if noted else None

    def _noted(self, key: str, places: Sequence[Tuple[Optional[float], ...]]) -> List[int]:
        """Vertices that the file of a map names, where they are where it says."""
        words = self.provenance.get(key, "").split()
        if len(words) != len(places) or not all(word.isdecimal() for word in words):
            return []
        numbers, origin = [int(word) for word in words], self.vertex_origin
        for number, place in zip(numbers, places):
            rows = self.points[origin == number]
            if len(rows) != 1 or any(wanted not in (None, got) for wanted, got in zip(place, rows[0])):
                return []
        return numbers

    @property
    def pin_residuals(self) -> List[float]:
        """Radians of each pin from where it was wanted; 0: exactly there."""
        return list(self._account().get("pin_residuals", []))

    @property
    def filler_share(self) -> Optional[float]:
        """The share of the sphere that fillers have got, of maps made here; None: there are none."""
        return self._account().get("filler_share")

    @property
    def alignment(self) -> Optional[float]:
        """With ``align``: the angle that is left, in radians, RMS over the surface; else None."""
        return self._account().get("alignment")

    @property
    def radial(self) -> Optional[Radial]:
        """Of ``method="radial"``, of maps made here: how the map differs from the directions from the centre;
        else None. A file keeps the centre and the largest movement, in ``provenance``.
        """
        found = self._account().get("radial")
        return None if found is None else Radial(*found)

    @property
    def in_space(self) -> Optional[InSpace]:
        """How the flat faces of a remesh made here lie in space; else None. The proof is of the map, not of them."""
        found: Optional[InSpace] = self._found.get("in_space")
        return found

    @property
    def energy_gap(self) -> Optional[float]:
        """An estimate of the share of its energy that more steps would take; None: not made."""
        return self._account().get("energy_gap")

    @property
    def warnings(self) -> List[str]:
        """What there is to say of how the map came out, of a surface that is inside out, and of faces of a remesh that
        cross in space."""
        said: List[str] = self._account().get("warnings", []) + self._found.get("warnings", [])
        if not self._account().get("inside_out", False):
            return list(said)
        turned = "the faces are clockwise from outside, the volume is negative: faces[:, ::-1] or repair=True turns them"
        return [*said, turned]

    @property
    def provenance(self) -> Dict[str, str]:
        """How the map came about: version, method, stage, options, poles, verdict."""
        return dict(self._mapped.provenance)

    @property
    def notes(self) -> List[str]:
        """What was odd about the file, or done to the mesh."""
        return [as_typed_here(note) for note in self._mapped.notes]

    @property
    def repairs(self) -> Tuple[Action, ...]:
        """What ``repair`` did to the mesh before it was mapped."""
        welds: Tuple[Action, ...] = self._found.get("welds", ())
        return welds + tuple(Action(*row) for row in self._mapped.repairs)

    @property
    def handles(self) -> Tuple[HandleLoop, ...]:
        """The loops that the mesh was cut along, to be rid of handles."""
        return tuple(HandleLoop(*row) for row in self._mapped.handles)

    @property
    def vertex_origin(self) -> Ints:
        """(V,) numbers of the vertices in the mesh or file that was given; −1: created."""
        found = dict(self._mapped.vertex_values()).get("source_vertex")
        return numbered(len(self.vertices)) if found is None else found


def _all_read_only(figures: Dict[str, Any]) -> Dict[str, Any]:
    """The same, whose arrays nobody may write to."""
    for figure in figures.values():
        if hasattr(figure, "flags"):
            _values.read_only(figure)
    return figures


def mapped_of(thing: Any, name: str) -> _core.Mapped:
    """What a map is to the library."""
    if not isinstance(thing, MapFacts):
        raise TypeError(f"{name}: a sphparam.SphereMap is needed, not {type(thing).__name__}")
    return thing._mapped
