"""Meshes: of arrays, of files, of other packages; what is wrong with them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, NoReturn, Optional, Sequence, Tuple, Union

from . import _arrays, _core, _values
from ._errors import Defect, MeshError, ReadError, WriteError, as_typed_here
from ._figures import Action, Body, HandleLoop, Inspection, SelfCrossings
from ._losses import tell
from ._numpy import np
from ._packages import parts_of
from ._progress import Progress, told

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt

    Array = npt.NDArray[Any]

Path = Union[str, "os.PathLike[str]"]
"""The name of a file."""


def path_of(path: Path) -> str:
    """A file's name as text."""
    name = os.fspath(path)
    if not isinstance(name, str):
        raise TypeError("path: a text is needed, not bytes")
    try:
        encoded = os.fsencode(name)
    except UnicodeEncodeError:  # halves of letters, which no system has in names
        encoded = b""
    if b"\0" in encoded or not encoded:
        raise ValueError(f"path: no file has the name {name!a}")
    return name


def require_mesh_format(name: str, other: str) -> str:
    """Tells what writes the formats that meshes alone are not written in."""
    if name.lower().endswith((".glb", ".gltf")):
        raise WriteError(f"{name}: {other} writes .glb and .gltf; save() writes {_core.written_extensions()}")
    return name


def existing(path: Path) -> str:
    """The same of a file that is there."""
    name = path_of(path)
    if not os.path.exists(name):
        raise FileNotFoundError(f"{name}: there is no such file")
    return name


class Mesh:
    """A triangle mesh with what its vertices and faces carry. It never changes.

    Parameters
    ----------
    vertices
        (V, 3) numbers; or a mesh of trimesh, PyVista, VTK, meshio, nibabel or Open3D, or a pair of
        arrays, and no ``faces``.
    faces
        (F, 3) whole numbers, counter-clockwise from outside.
    values
        What vertices carry besides: name to (V,) or (V, k). ``"color"`` (uint8, or floats from 0 to 1),
        ``"normal"`` and ``"uv"`` (v upwards, as in OBJ) are known by their names; whole
        numbers are labels, never interpolated.
    face_values
        What faces carry: name to (F,) or (F, k).

    Raises
    ------
    TypeError, ValueError
        for arrays that are none; :class:`MeshError` for indices out of range and for coordinates that
        are no finite numbers, with their places.
    """

    __slots__ = ("_source", "_sound", "_share", "_welds", "_outside")

    _source: _core.Source
    _sound: bool
    _share: float
    _welds: Tuple[Action, ...]
    _outside: str

    def __init__(
        self,
        vertices: Any,
        faces: Any = None,
        *,
        values: Optional[Mapping[str, Any]] = None,
        face_values: Optional[Mapping[str, Any]] = None,
    ) -> None:
        made = any_mesh(vertices, faces, values, face_values)
        made._require_sound()
        self._source, self._sound, self._share = made._source, True, made._share
        self._welds, self._outside = made._welds, ""

    @classmethod
    def _of(cls, source: _core.Source, sound: bool = True, share: float = 1.0) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._source, mesh._sound, mesh._share = source, sound, share
        mesh._welds, mesh._outside = (), ""
        return mesh

    def _with(self, source: _core.Source) -> Mesh:
        """Another one that came about as this did."""
        mesh = Mesh._of(source, self._sound, self._share)
        mesh._welds, mesh._outside = self._welds, self._outside
        return mesh

    def _require_sound(self) -> None:
        if not self._sound:
            try:
                _core.refuse(self._source)
            except MeshError as error:
                raise error._with_indices(self._outside) if self._outside else error from None

    @property
    def vertices(self) -> npt.NDArray[numpy.float64]:
        """(V, 3) positions, read-only."""
        return self._source.vertices

    @property
    def faces(self) -> npt.NDArray[numpy.int32]:
        """(F, 3) indices of vertices, read-only."""
        return self._source.faces

    @property
    def values(self) -> _values.Values:
        """What vertices carry: name to (V,) or (V, k), in its own type, read-only."""
        return _values.Values(self._source.vertex_values())

    @property
    def face_values(self) -> _values.Values:
        """What faces carry: name to (F,) or (F, k), read-only."""
        return _values.Values(self._source.face_values())

    @property
    def corner_uv(self) -> Optional[npt.NDArray[numpy.float64]]:
        """(F, 3, 2) texture coordinates of corners, where the mesh has such; else None."""
        rows = self._source.corner_texcoords
        return None if rows is None else rows.reshape(-1, 3, 2)

    @property
    def corner_normals(self) -> Optional[npt.NDArray[numpy.float64]]:
        """(F, 3, 3) normals of corners, where the mesh has such: they differ along hard edges. Else None."""
        rows = self._source.corner_normals
        return None if rows is None else rows.reshape(-1, 3, 3)

    def creased(self, degrees: float) -> Mesh:
        """The same with hard edges: those whose faces turn by more than so many degrees, from 0 to 180.

        For meshes without normals (STL, CAD), which all that is drawn, baked and exported of them shows as smooth
        else: ``sp.map(sp.read("part.stl").creased(30))``. Where the mesh has normals, these say what is hard: it
        comes back as it is, with a warning. Where vertices have copies, :func:`repair` goes first.
        """
        self._require_sound()
        made = _core.creased(self._source, _arrays.degrees(degrees, "degrees"))
        if made is None:
            tell([has_own_normals(path_told(self.path))])
            return self
        return self._with(made)

    @property
    def fillers(self) -> npt.NDArray[numpy.bool_]:
        """(F,) True where a face only closes a hole that was kept, by the face value ``"filler"``."""
        marks: npt.NDArray[numpy.bool_] = _values.read_only(self._source.fillers.view(bool))
        return marks

    @property
    def surface(self) -> Mesh:
        """The mesh without its fillers, which has holes then; itself where it has none."""
        return self._with(_core.surface(self._source)) if self.fillers.any() else self

    @property
    def area_share(self) -> float:
        """Of a part that :func:`components` made, and where :func:`repair` dropped some, the share of the area
        of all; else 1.
        """
        return self._share

    @property
    def materials(self) -> List[str]:
        """Names of materials; the face value ``"material"`` counts them from 0."""
        return self._source.materials

    @property
    def path(self) -> str:
        """The file it was read from; ``"mesh"`` for arrays."""
        return self._source.path

    @property
    def format(self) -> str:
        """``"PLY binary little-endian"``, ``"OBJ"``, ``"arrays"`` and so on."""
        return "arrays" if self._welds else self._source.format

    @property
    def notes(self) -> List[str]:
        """What was odd about the file, or done to the mesh on reading."""
        return [as_typed_here(note) for note in self._source.notes]

    @property
    def has_map(self) -> bool:
        """Whether the file carries a map onto the sphere: :func:`load` reads it."""
        return self._source.has_map

    @property
    def repairs(self) -> Tuple[Action, ...]:
        """What :func:`repair` did to make it."""
        return self._welds + tuple(Action(*row) for row in self._source.repairs)

    @property
    def handles(self) -> Tuple[HandleLoop, ...]:
        """The loops that it was cut along, to be rid of handles."""
        return tuple(HandleLoop(*row) for row in self._source.handles)

    @property
    def added_share(self) -> float:
        """Of the area, what :func:`repair` put in to close holes and handles."""
        return float(self._source.added_share)

    @property
    def vertex_origin(self) -> npt.NDArray[numpy.int32]:
        """(V,) numbers of the vertices in the mesh or file this was made of; −1: created."""
        found = dict(self._source.vertex_values()).get("source_vertex")
        return numbered(len(self.vertices)) if found is None else found

    def save(self, path: Path) -> None:
        """Writes it in the format of the name, as :func:`write` does."""
        self._require_sound()
        name = require_mesh_format(path_of(path), "export() of sphparam.map(mesh)")
        tell(f"{name}: {loss}" for loss in _core.write(self._source, name))

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: Any) -> Mesh:
        return self

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Mesh cannot be pickled: mesh.save(path) writes it, sphparam.read(path) reads it")

    def __repr__(self) -> str:
        return f"<sphparam.Mesh: {len(self.vertices)} vertices, {len(self.faces)} faces, {path_told(self.path)}>"


def has_own_normals(name: str) -> str:
    """A line about a mesh that cannot be given hard edges."""
    return f"{name}: has normals of its own, which say what is hard"


def path_told(path: str) -> str:
    """A file's name for people, who need not have its bytes."""
    return os.fsencode(path).decode(errors="replace")


def numbered(count: int) -> npt.NDArray[numpy.int32]:
    """0 to count − 1."""
    numbers: npt.NDArray[numpy.int32] = np.arange(count, dtype=np.int32)
    return numbers


def any_mesh(
    mesh: Any,
    faces: Any,
    values: Optional[Mapping[str, Any]] = None,
    face_values: Optional[Mapping[str, Any]] = None,
) -> Mesh:
    """Of whatever users have. It may name vertices that are not there: see `_require_sound`."""
    from ._map_facts import MapFacts

    if isinstance(mesh, (Mesh, MapFacts)):
        if faces is not None:
            raise TypeError("faces: the mesh has its own")
        found = mesh if isinstance(mesh, Mesh) else mesh.mesh
        given = values or face_values
        return found if not given else _with_values(found._with(_core.copied(found._source)), values, face_values)
    parts = parts_of(mesh) if faces is None else None
    vertices, faces = (parts.vertices, parts.faces) if parts else (_arrays.points(mesh), _arrays.triangles(faces))
    source, finite, inside = _core.source_of(vertices, faces)
    if parts:
        for row in parts.values:
            source.set_vertex_values(*row)
        for row in parts.face_values:
            source.set_face_values(*row)
    made = Mesh._of(source, finite and inside)
    made._outside = "" if inside else _outside(faces, len(vertices))
    return _with_values(made, values, face_values)


def _outside(faces: Array, count: int) -> str:
    """What indices out of range are, in words."""
    wrong = np.unique(faces[(faces < 0) | (faces >= count)])
    first = ", ".join(str(number) for number in wrong[:5]) + (", …" if len(wrong) > 5 else "")
    return f"there are {count} vertices, 0 to {count - 1}, and faces name {first}"


def _with_values(mesh: Mesh, values: Optional[Mapping[str, Any]], face_values: Optional[Mapping[str, Any]]) -> Mesh:
    source = mesh._source
    added = _added(values, len(mesh.vertices), "vertex", source.vertex_values())
    for column in added.dropped:
        source.drop_vertex_values(column)
    for row in added.rows:
        source.set_vertex_values(*row)
    added = _added(face_values, len(mesh.faces), "face", source.face_values())
    for column in added.dropped:
        source.drop_face_values(column)
    for row in added.rows:
        source.set_face_values(*row)
    return mesh


def _added(given: Optional[Mapping[str, Any]], count: int, what: str, there: Sequence[Tuple[str, Array]]) -> _values.Columns:
    """As columns, beside those that are there."""
    if given is not None and not isinstance(given, Mapping):
        name = "values" if what == "vertex" else "face_values"
        raise TypeError(f"{name}: names with arrays are needed, not {type(given).__name__}")
    added = _values.Columns(count, what, there if given else ())
    for name, thing in (given or {}).items():
        added.add(name, thing)
    return added


_limits = (
    "file", "vertices", "faces", "degree", "line", "ply_elements", "ply_properties", "json", "json_depth", "json_values", "json_objects",
)  # fmt: skip


def read_limits(limits: Optional[Mapping[str, int]]) -> Dict[str, int]:
    """Of what is read, looked at."""
    if limits is None:
        return {}
    if not isinstance(limits, Mapping):
        raise TypeError(f"limits: a dict is needed, not {type(limits).__name__}")
    for name in limits:
        if name not in _limits:
            raise ValueError(f"limits: no {name!r} among {', '.join(_limits)}")
    return {name: _arrays.whole(limit, f"limits[{name!r}]", 1, 2**63 - 1) for name, limit in limits.items()}


def read(
    path: Path, *, repeated_corners: bool = False, non_finite: bool = False, limits: Optional[Mapping[str, int]] = None
) -> Mesh:
    """Reads a mesh: OBJ, PLY, OFF, STL, 3MF, glTF, FBX, COLLADA, 3DS, X3D, VTK, GIFTI, FreeSurfer, MZ3, ICQ or plate table, in gzip or not, by content.

    Copies of vertices are welded where the faces have open edges otherwise, vertices that no face uses
    are dropped; ``notes`` says so and ``vertex_origin`` has the numbers of the file. Faces that name a
    vertex twice are refused unless ``repeated_corners``, coordinates that are no finite numbers unless
    ``non_finite``: then :func:`repair` can remove them.

    ``limits``: of files of strangers, beyond which one is refused before memory is spent on it, as in
    ``limits=dict(vertices=500_000)``: bytes of the ``file``, also unpacked (default: 2 GiB), ``vertices`` and ``faces``
    (2²⁸), the ``degree`` of a face (65536), bytes of a ``line`` of text (1 MiB), ``ply_elements`` (64), ``ply_properties`` of
    one (256); of glTF the bytes of its ``json`` (64 MiB), ``json_depth`` (64), ``json_values`` (2²⁰), ``json_objects`` (2¹⁷).

    Raises FileNotFoundError, :class:`ReadError` with the place. Warns, as :class:`LossWarning`, of what
    the file carries and a mesh has no room for.
    """
    repeats, others = _arrays.flag(repeated_corners, "repeated_corners"), _arrays.flag(non_finite, "non_finite")
    bounds = read_limits(limits)
    try:
        source = _core.read(existing(path), repeats, others, bounds)
    except ReadError as error:
        raise ReadError(_as_typed_here(str(error))) from None
    tell(f"{path_of(path)}: {loss}" for loss in source.losses)
    return Mesh._of(source, source.is_sound)


def _as_typed_here(refusal: str) -> str:
    """What a file is refused for, with what to type in Python where the program names its own options."""
    for command, option, does in (
        ("; `sphparam map --repair`", "non_finite", "drops such vertices with their faces"),
        ("; `sphparam map --repair=duplicates`", "repeated_corners", "removes such faces"),
    ):
        what, found, _ = refusal.partition(command)
        if found:
            return f"{what}; read(path, {option}=True) takes the file, and map(…, repair=True) {does}"
    return refusal


def write(path: Path, mesh: Any, faces: Any = None, *, values: Optional[Mapping[str, Any]] = None) -> None:
    """Writes a mesh in the format of the name, all of it or nothing; packed where that ends in ``.gz``.

    PLY, OBJ, OFF, STL, VTK, GIFTI, FreeSurfer and MZ3 are written. ``mesh``, ``faces`` and ``values`` are as
    :class:`Mesh` takes them. Raises :class:`WriteError`; warns, as :class:`LossWarning`, of what the
    format has no room for.
    """
    Mesh(mesh, faces, values=values).save(path)


def inspect(mesh: Any, faces: Any = None) -> Inspection:
    """Lists everything that is wrong with a mesh; never refuses one for being broken.

    ``mesh`` and ``faces`` are as :class:`Mesh` takes them, but indices may be out of range and
    coordinates not finite: these are defects.
    """
    found = _core.inspect(any_mesh(mesh, faces)._source)
    found["defects"] = tuple(Defect(*row) for row in found["defects"])
    if found["body"] is not None:
        found["body"] = Body(*found["body"])
    return Inspection(**found)


def centre_of(given: Any, mesh: Mesh, name: str = "centre") -> Tuple[float, float, float]:
    """Three numbers, or "centroid": that of what the mesh encloses; the mean of its vertices where that is next to nothing."""
    if not isinstance(given, str) or given != "centroid":
        return _arrays.three(given, name)
    body = _core.inspect(mesh._source)["body"]
    return _arrays.three(mesh.vertices.mean(axis=0) if body is None else body[0], name)


def self_crossings(mesh: Any, faces: Any = None, *, threads: int = 0, progress: Progress = None) -> SelfCrossings:
    """The pairs of faces of a mesh that cross in space, by exact signs: that pass through one another, or
    lie over one another in a plane, also beside a corner or a side that they share. What only touches does
    not count, nor do faces without area.

    ``mesh`` and ``faces`` are as :func:`inspect` takes them. A map is one-to-one whether or not its mesh
    crosses itself, and the flat faces of a remesh may cross where the map is one-to-one. A fold that is open by
    the rounding of a coordinate is none.

    Parameters
    ----------
    threads
        0: all cores; changes no bit.
    progress
        ``progress(stage, share)``; False ends the work. True: a line.
    """
    with told(progress) as report:
        pairs, marks, first, place = _core.self_crossings(any_mesh(mesh, faces)._source, threads, report)
    found = _values.read_only(marks.view(bool))
    return SelfCrossings(pairs, found, first if pairs else None, place if pairs else None)
