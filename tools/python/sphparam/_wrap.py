"""One closed surface about any triangles."""

from __future__ import annotations

from typing import Any, NamedTuple, Tuple

from . import _arrays, _core
from ._attributes import document
from ._figures import Distance, one_sided
from ._losses import tell
from ._mesh import Mesh, any_mesh
from ._progress import Progress, told


class Wrap(NamedTuple):
    """A closed surface of genus 0, and what it is about. :func:`wrap` makes it."""

    mesh: Mesh
    """The surface: ``sp.map(found.mesh)`` maps it as it is."""
    voxel: float
    """Between points of the lattice, in units of the mesh."""
    distance: float
    """Of the surface from the triangles; of one with fewer triangles only about."""
    gap: float
    """What is left of the distance, where the surface was drawn in; else ``distance``."""
    lattice: Tuple[int, int, int]
    """Points each way."""
    parts: int
    """Shells that were apart; they are joined by bridges, or the largest is kept."""
    insides: int
    """Of closed parts, as their faces look."""
    cavities: int
    """Beside these, that nothing reaches from outside: solid now."""
    handles: int
    """Holes through it that are closed by walls, a voxel thick."""
    added_share: float
    """Of the volume, what bridges and walls are."""
    kept_share: float
    """Of the volume, that of the part that was kept; 1 where all were joined."""
    skin: bool
    """It encloses no more than a skin about open sheets: what is open between them is wider than twice ``distance``."""
    volume: float
    """What it encloses, in units of the mesh."""
    area: float
    """Of its surface."""
    outside: int
    """Vertices that are not inside: of parts that were dropped, or cut by a surface with fewer triangles."""
    apart: Distance
    """How far wrap and triangles are from one another: ``forth`` is from the wrap."""
    crossings: int
    """Pairs of its faces that cross, which is warned of: with fewer ``triangles`` or a ``gap``; else there are none."""


def wrap(
    mesh: Any,
    faces: Any = None,
    *,
    voxel: float = 0.0,
    resolution: int = 0,
    distance: float = 0.0,
    gap: float = 0.0,
    largest: bool = False,
    triangles: int = 0,
    threads: int = 0,
    progress: Progress = None,
) -> Wrap:
    """Encloses any triangles in one closed surface that can be mapped.

    They may be open, not manifold, in many parts, and pass through one another. The wrap has places alone:
    ``sp.map(found.mesh).bake("basecolor", surface=mesh)`` brings what the triangles show.

    Parameters
    ----------
    mesh, faces
        As :class:`Mesh` takes them. Fillers are left out.
    voxel
        How fine, in units of the mesh; 0: as ``resolution`` says.
    resolution
        Voxels along the longest side of the box, instead of ``voxel``; 0: 128, or so many that two fit into
        ``distance``.
    distance
        Of the surface from the triangles, a voxel at least; 0: two voxels.
    gap
        Draw the surface in at last, until so much of the distance is left; it may cut into what it is about,
        and itself, then, which a warning tells. 0: all of the distance.
    largest
        Keep the largest of the parts that are apart, instead of joining all.
    triangles
        Leave about so many; the surface may cut into what it is about, and itself, then. 0: all.

    Raises
    ------
    MeshError
        for no triangles, or coordinates that are no finite numbers.
    ValueError
        for a voxel that is too small for the box (100 million points at most), or larger than ``distance``.
    """
    finest, away = _arrays.real(voxel, "voxel"), _arrays.real(distance, "distance")
    count = _arrays.whole(resolution, "resolution", 0, 100_000)
    if finest > 0 and count > 0:
        raise ValueError("voxel and resolution contradict each other: both say how large a voxel is")
    soup = any_mesh(mesh, faces)
    soup._require_sound()
    options = {
        "voxel": finest,
        "resolution": count,
        "distance": away,
        "gap": _arrays.real(gap, "gap"),
        "largest": _arrays.flag(largest, "largest"),
        "triangles": _arrays.whole(triangles, "triangles", 0, 100_000_000),
        "threads": _arrays.threads(threads),
    }
    with told(progress) as report:
        source, figures, warning = _core.wrap(soup._source, options, report)
    tell([warning] if warning else [])
    apart = figures.pop("apart")
    apart["forth"], apart["back"] = one_sided(apart["forth"]), one_sided(apart["back"])
    return Wrap(mesh=Mesh._of(source), apart=Distance(**apart), **figures)


document(globals())
