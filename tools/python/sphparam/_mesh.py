"""Meshes: of arrays, of files, of other packages; what is wrong with them, and repair."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _arrays, _core
from ._figures import Action, HandleLoop, Inspection
from ._errors import Defect, LossWarning
from ._numpy import np
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
    if "\0" in name or not name:
        raise ValueError("path: no file has this name")
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
        What vertices carry besides: name to (V,) or (V, k). ``"color"``, ``"normal"`` and ``"uv"`` are
        known by their names; whole numbers are labels, never interpolated.

    Raises
    ------
    TypeError, ValueError
        for arrays that are none; :class:`MeshError` for indices out of range and for coordinates that
        are no finite numbers, with their places.
    """

    __slots__ = ("_source", "_sound")

    _source: _core.Source
    _sound: bool

    def __init__(
        self,
        vertices: Any,
        faces: Any = None,
        *,
        values: Optional[Mapping[str, Any]] = None,
    ) -> None:
        made = _any_mesh(vertices, faces, values)
        made._require_sound()
        self._source, self._sound = made._source, True

    @classmethod
    def _of(cls, source: _core.Source, sound: bool = True) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._source, mesh._sound = source, sound
        return mesh

    def _require_sound(self) -> None:
        if not self._sound:
            _core.refuse(self._source)

    @property
    def vertices(self) -> npt.NDArray[numpy.float64]:
        """(V, 3) positions, read-only."""
        return self._source.vertices

    @property
    def faces(self) -> npt.NDArray[numpy.int32]:
        """(F, 3) indices of vertices, read-only."""
        return self._source.faces

    @property
    def values(self) -> Dict[str, Array]:
        """What vertices carry: name to (V,) or (V, k), in its own type."""
        return _arrays.grouped(self._source.vertex_values())

    @property
    def face_values(self) -> Dict[str, Array]:
        """What faces carry: name to (F,) or (F, k)."""
        return _arrays.grouped(self._source.face_values())

    @property
    def corner_uv(self) -> Optional[npt.NDArray[numpy.float64]]:
        """(F, 3, 2) texture coordinates of corners, where the mesh has such; else None."""
        rows = self._source.corner_texcoords
        return None if rows is None else rows.reshape(-1, 3, 2)

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
        return self._source.format

    @property
    def notes(self) -> List[str]:
        """What was odd about the file, or done to the mesh on reading."""
        return self._source.notes

    @property
    def has_map(self) -> bool:
        """Whether the file carries a map onto the sphere: :func:`load` reads it."""
        return self._source.has_map

    @property
    def repairs(self) -> Tuple[Action, ...]:
        """What :func:`repair` did to make it."""
        return tuple(Action(*row) for row in self._source.repairs)

    @property
    def handles(self) -> Tuple[HandleLoop, ...]:
        """The loops that it was cut along, to be rid of handles."""
        return tuple(HandleLoop(*row) for row in self._source.handles)

    @property
    def vertex_origin(self) -> npt.NDArray[numpy.int32]:
        """(V,) numbers of the vertices in the mesh or file this was made of; −1: created."""
        found = dict(self._source.vertex_values()).get("source_vertex")
        return _numbers(len(self.vertices)) if found is None else found

    def save(self, path: Path) -> None:
        """Writes it as ``.ply``, ``.obj``, ``.off`` or ``.gii``, all of it or nothing."""
        self._require_sound()
        _core.write(self._source, path_of(path))

    def __repr__(self) -> str:
        return f"<sphparam.Mesh: {len(self.vertices)} vertices, {len(self.faces)} faces, {self.path}>"


def _numbers(count: int) -> npt.NDArray[numpy.int32]:
    """0 to count − 1."""
    numbers: npt.NDArray[numpy.int32] = np.arange(count, dtype=np.int32)
    return numbers


def _any_mesh(mesh: Any, faces: Any, values: Optional[Mapping[str, Any]] = None) -> Mesh:
    """Of whatever users have. It may name vertices that are not there: see `_require_sound`."""
    from ._map import SphereMap

    if isinstance(mesh, (Mesh, SphereMap)):
        if faces is not None:
            raise TypeError("faces: the mesh has its own")
        found = mesh if isinstance(mesh, Mesh) else mesh.mesh
        return found if not values else _with_values(Mesh._of(_core.copied(found._source)), values)
    parts = _arrays.parts_of(mesh) if faces is None else _arrays.Parts(mesh, faces)
    source, finite, inside = _core.source_of(parts.vertices, parts.faces)
    for row in parts.values:
        source.set_vertex_values(*row)
    return _with_values(Mesh._of(source, finite and inside), values)


def _with_values(mesh: Mesh, values: Optional[Mapping[str, Any]]) -> Mesh:
    if values is not None and not isinstance(values, Mapping):
        raise TypeError(f"values: names with arrays are needed, not {type(values).__name__}")
    for name, thing in (values or {}).items():
        for row in _arrays.columns(name, thing, len(mesh.vertices)):
            mesh._source.set_vertex_values(*row)
    return mesh


def read(path: Path, *, repeated_corners: bool = False) -> Mesh:
    """Reads a mesh: OBJ, PLY, OFF, STL, glTF, GLB or GIFTI, in gzip or not, told by content.

    Copies of vertices are welded where the faces have open edges otherwise, vertices that no face uses
    are dropped; ``notes`` says so and ``vertex_origin`` has the numbers of the file. Faces that name a
    vertex twice are refused unless ``repeated_corners``: then :func:`repair` can remove them.

    Raises FileNotFoundError, :class:`ReadError` with the place. Warns, as :class:`LossWarning`, of what
    the file carries and a mesh has no room for.
    """
    source = _core.read(existing(path), repeated_corners)
    for loss in source.losses:
        warnings.warn(f"{path_of(path)}: {loss}", LossWarning, stacklevel=2)
    return Mesh._of(source)


def write(path: Path, mesh: Any, faces: Any = None, *, values: Optional[Mapping[str, Any]] = None) -> None:
    """Writes a mesh as ``.ply``, ``.obj``, ``.off`` or ``.gii``, all of it or nothing.

    ``mesh``, ``faces`` and ``values`` are as :class:`Mesh` takes them. Raises :class:`WriteError`.
    """
    Mesh(mesh, faces, values=values).save(path)


def inspect(mesh: Any, faces: Any = None) -> Inspection:
    """Lists everything that is wrong with a mesh; never refuses one for being broken.

    ``mesh`` and ``faces`` are as :class:`Mesh` takes them, but indices may be out of range and
    coordinates not finite: these are defects.
    """
    found = _core.inspect(_any_mesh(mesh, faces)._source)
    found["defects"] = tuple(Defect(*row) for row in found["defects"])
    return Inspection(**found)


def repair(
    mesh: Any,
    faces: Any = None,
    *,
    duplicates: bool = True,
    orientation: bool = True,
    non_manifold: bool = True,
    components: bool = True,
    holes: bool = True,
    handles: bool = True,
    flat_faces: bool = True,
    unused: bool = True,
    component: int = 0,
    least_kept: float = 0.98,
    largest_hole: int = 500,
    keep_holes: bool = False,
    handle_choice: str = "shortest",
    longest_handle: float = 0.35,
    longest_handle_length: float = 0.0,
    values: Optional[Mapping[str, Any]] = None,
    progress: Progress = None,
) -> Mesh:
    """Mends a mesh so that it can be mapped, with little change to what the surface is.

    Parameters
    ----------
    mesh, faces, values
        As :class:`Mesh` takes them.
    duplicates
        Remove faces that name a vertex twice, and copies of faces.
    orientation
        Orient faces alike, and the closed surface outward.
    non_manifold
        Give each sheet its own copy of the edges and vertices that it shares.
    components
        Keep one component, where that loses no more than specks.
    holes
        Fill holes.
    handles
        Cut the surface along short loops and close both ends.
    flat_faces
        Turn or collapse faces without area.
    unused
        Drop vertices that no face uses.
    component
        Which component to keep whatever its share, 1 the largest by area; 0: the largest, if it has
        ``least_kept`` of the area.
    least_kept
        Share of the area, 0 to 1.
    largest_hole
        Edges of a hole that may be filled, from 3.
    keep_holes
        Close holes of any length by fillers, which are no surface: the face value ``filler`` marks them.
    handle_choice
        ``"shortest"``; ``"cut"`` handles through, or ``"fill"`` what goes through them; ``"area"``:
        whichever adds less area.
    longest_handle
        The longest loop that a handle may be cut along, in diagonals of the bounding box; in units of
        the mesh instead where ``longest_handle_length`` is more than 0.

    Returns
    -------
    Mesh
        Closed, of genus 0; ``repairs`` says what was done, ``vertex_origin`` where vertices come from.

    Raises
    ------
    MeshError
        for what cannot be mended, with what remains.
    """
    options = {name: value for name, value in locals().items() if name in _repair_options}
    with told(progress) as report:
        return Mesh._of(_core.repair(_any_mesh(mesh, faces, values)._source, options, report))


_repair_options = frozenset(repair.__kwdefaults__ or {}) - {"values", "progress"}


def repair_options(wanted: Any) -> Optional[Dict[str, Any]]:
    """What ``repair`` of :func:`map` says: keyword arguments of the function above, or None."""
    if wanted is False or wanted is None:
        return None
    if wanted is True:
        return {}
    if not isinstance(wanted, Mapping):
        raise TypeError("repair: True, False, or a dict of arguments of sphparam.repair")
    for name in wanted:
        if name not in _repair_options:
            raise TypeError(f"repair: no option is called {name!r}; there are {', '.join(sorted(_repair_options))}")
    return dict(wanted)
