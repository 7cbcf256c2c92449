"""How maps are made, read and proved."""

from __future__ import annotations

import os
from functools import wraps
from typing import Any, Callable, Mapping, Optional, Tuple, TypeVar, Union, cast

from . import _arrays, _core
from ._figures import Certificate
from ._losses import tell
from ._map_options import requested
from ._mesh import Path, any_mesh, centre_of, existing, path_of, read_limits
from ._progress import Progress, told
from ._repair import mended, repair_option_names, repair_options
from ._sphere_map import SphereMap
from ._up import Direction
from ._welding import require_welded

_F = TypeVar("_F", bound=Callable[..., Any])


def _hinting(function: _F) -> _F:
    """Tells where an argument of :func:`repair` goes that was given to :func:`map`."""

    @wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:
        for name in named.keys() & repair_option_names - set(function.__kwdefaults__):
            raise TypeError(f"map: {name} is an argument of repair: map(mesh, repair=dict({name}={named[name]!r}))")
        return function(*arguments, **named)

    return cast(_F, call)


remeshing_lambda = 5.0
"""The weight of area that spreads a grid's vertices best: ``map(mesh, weight=…)`` before ``remesh``."""


@_hinting
def map(
    mesh: Any,
    faces: Any = None,
    *,
    values: Optional[Mapping[str, Any]] = None,
    face_values: Optional[Mapping[str, Any]] = None,
    repair: Union[bool, Mapping[str, Any]] = False,
    method: str = "progressive",
    balance: Union[str, float] = "balanced",
    weight: Optional[float] = None,
    quality: str = "normal",
    energy: str = "angle-and-area",
    poles: Union[str, Tuple[int, int]] = "auto",
    meridian: Optional[int] = None,
    up: Optional[Direction] = None,
    front: Optional[Direction] = None,
    pins: Optional[Mapping[int, Tuple[float, float]]] = None,
    centre: Union[str, Tuple[float, float, float], None] = None,
    align: Any = None,
    filler_share: float = 0.02,
    paper: Optional[Mapping[str, Any]] = None,
    repair_map: bool = False,
    measure_stages: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> SphereMap:
    """Maps a closed genus-0 mesh one-to-one onto the unit sphere, and proves it.

    Parameters
    ----------
    mesh, faces, values, face_values
        As :class:`Mesh` takes them: two arrays, or a mesh of trimesh, PyVista, VTK, meshio, nibabel or
        Open3D. Nothing is changed or welded: ``points[i]`` is where ``vertices[i]`` goes.
    repair
        True, or a dict of arguments of :func:`repair`: the mesh is mended first. Then vertices have
        other numbers, see ``vertex_origin``.
    method
        ``"progressive"``; ``"curvilinear"``, the paper made sound; ``"paper"``, as printed, which folds;
        ``"radial"``, directions from a centre: planetocentric where the body is star-shaped.
        North is what points up, by the mesh's file or ``up``.
    balance
        ``"balanced"``; ``"conformal"``, areas weigh next to nothing; ``"equal-area"``: the mean |log2 area
        ratio|, weighted by area, is at most 0.1; or a number: the weight of area against angle.
    weight
        That weight, 1e-10 to 1e6.
    quality
        ``"draft"``, ``"normal"``, ``"best"``: time against distortion.
    energy
        ``"angle-and-area"`` or ``"symmetric-dirichlet"``.
    poles
        ``"auto"``, ``"none"``, ``"up"``: the top and the bottom of the mesh, or the vertices that go to +z and −z.
    meridian
        The vertex that gets θ = 0.
    up, front
        What points up in the mesh and what looks at who sees it: ``"x"``, ``"-x"`` … ``"-z"`` or three
        numbers. Top and bottom go to the poles then, unless ``poles`` says otherwise, and the front to θ = 0;
        what is made of the map, or draws it, stands so. None: as its file says; else z, and -y, z with y up.
    pins
        Vertex to (θ, φ) in radians: to be exactly there.
    centre
        Of ``method="radial"`` and ``align="body"``, in the mesh's coordinates; ``"centroid"``: that of what the
        mesh encloses; None: the origin.
    align
        Turns the finished map to ``"body"``, the directions from the centre; to another map of the mesh; or to
        (V, 3) rays. Not with poles, meridian or pins.
    filler_share
        The share of the sphere that is left to what closes holes that were kept (``repair=dict(keep_holes=
        True)``), above 0 to 1; a warning tells where they have more.
    paper
        For ``method="paper"``: a dict of ``weights`` (``"mean-value"``, ``"cotangent"``), ``epsilon`` in
        radians, ``iterations``, ``rings``, ``sweeps``.
    repair_map
        Untangle what ``method="paper"`` folds.
    measure_stages
        Folds and distortion after every stage, in ``stages``.
    threads
        0 for all cores; the result does not depend on it.
    progress
        Called with stage and fraction in your thread, some times a second; return False to stop.
        None: a bar on terminals and in notebooks.

    Raises
    ------
    MeshError
        for what is no closed genus-0 manifold, with all defects and what repair would do.
    NotCertified
        where the map is not one-to-one, or poles, pins or meridian are not where they were wanted.
    Cancelled, KeyboardInterrupt
        within a tenth of a second.
    """
    options = requested(
        method=method, balance=balance, weight=weight, quality=quality, energy=energy, poles=poles, meridian=meridian,
        up=up, front=front,
        pins=pins, centre=centre, align=align, filler_share=filler_share, paper=paper, repair_map=repair_map,
        measure_stages=measure_stages, threads=threads,
    )  # fmt: skip
    mending = repair_options(repair)
    found = any_mesh(mesh, faces, values, face_values)
    with told(progress) as report:
        if mending is not None:
            found = mended(found, mending, report)
        found._require_sound()
        if mending is None:
            require_welded(found)
        if "centre" in options:
            options["centre"] = centre_of(options["centre"], found)
        mine = found is not mesh
        made = SphereMap._of(_core.map(found._source, mine, options, report))
    made._found.update(welds=found._welds, share=found.area_share)
    tell(made.warnings)
    return made


def load(
    path: Path,
    sphere: Optional[Path] = None,
    *,
    balance: Union[str, float] = "balanced",
    quality: str = "normal",
    limits: Optional[Mapping[str, int]] = None,
    threads: int = 0,
    progress: Progress = None,
) -> SphereMap:
    """Reads a mesh and the map that it carries, and proves it; one is made where there is none, with a warning.

    ``sphere``: the file with the sphere of the mesh, of the same connectivity (FreeSurfer, HCP). ``limits``: as of
    :func:`read`.
    Raises :class:`ReadError`, :class:`MeshError`, :class:`NotCertified`.
    """
    options = requested(balance=balance, quality=quality, threads=threads)
    other = existing(sphere) if sphere is not None else ""
    bounds = read_limits(limits)
    with told(progress) as report:
        made = SphereMap._of(_core.load(existing(path), other, bounds, options, report))
    if made._mapped.mapped_here:
        tell([f"{path_of(path)}: carries no map, so another one was made; .sph.ply brings a map back"])
    return made


def with_sphere(mesh: Any, points: Any, *, faces: Any = None, threads: int = 0) -> SphereMap:
    """A mesh with the map of another program, (V, 3) rays of any length but 0, once it is proved.

    Raises :class:`NotCertified` with the certificate where it is not one-to-one.
    """
    found = any_mesh(mesh, faces)
    found._require_sound()
    rays = _arrays.finite_points(points, "points", len(found.vertices))
    return SphereMap._of(_core.with_points(found._source, rays, _arrays.threads(threads)))


def verify(
    mesh: Any, faces: Any = None, points: Any = None, *, limits: Optional[Mapping[str, int]] = None, threads: int = 0
) -> Certificate:
    """Proves a map again, ours or anybody's; what is not one-to-one is a value, not an exception.

    ``verify(vertices, faces, points)``, ``verify(mesh, points=points)``, a :class:`SphereMap`, or a
    file: a written map, a bare sphere, or with ``points=FILE`` a mesh and its sphere. A sphere seen from
    inside is one-to-one too, and ``reversed``; :func:`load` and :func:`with_sphere` want it from outside.

    Of a file, ``theta`` and ``phi`` that are not those of ``sx sy sz`` make another map of it: it is not
    ``one_to_one`` then. Poles, meridian and verdict of its header that are not so, and points on no
    sphere about the origin, are told as :class:`LossWarning`. ``limits``: of files, as of :func:`read`.
    """
    count, bounds = _arrays.threads(threads), read_limits(limits)
    if isinstance(mesh, (str, os.PathLike)):
        if faces is not None:
            raise TypeError("faces: the file has its own; points=FILE is its sphere")
        if points is not None and not isinstance(points, (str, os.PathLike)):
            raise TypeError(f"points: of a file its sphere is one too, not {type(points).__name__}; verify(read(path), points=…) takes arrays")
        sphere = existing(points) if points is not None else ""
        found = _core.verify_file(existing(mesh), sphere, bounds, count)
        tell(found.pop("warnings"))
        return Certificate(**found)
    if points is None and isinstance(mesh, SphereMap):
        points = mesh.points
    if points is None:
        raise TypeError("points: (V, 3) rays are needed, where the vertices go")
    source = any_mesh(mesh, faces)
    source._require_sound()
    rays = _arrays.points(points, "points")
    if len(rays) != len(source.vertices):
        raise ValueError(f"points: {len(source.vertices)} rows are needed, one a vertex, not {len(rays)}")
    return Certificate(**_core.certify_points(source._source, rays, count))
