"""Meshes mended, and parted."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, Mapping, Optional, Union

from . import _arrays, _core
from ._losses import tell
from ._mesh import Mesh, any_mesh
from ._progress import Progress, told
from ._welding import kept_apart, lost_by_nearness, lost_by_welding, welded


def repair(
    mesh: Any,
    faces: Any = None,
    *,
    non_finite: bool = True,
    duplicates: bool = True,
    cracks: bool = True,
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
    weld_share: Optional[float] = None,
    weld_length: Optional[float] = None,
    handle_choice: str = "shortest",
    longest_handle: float = 0.35,
    longest_handle_length: float = 0.0,
    edge_share: float = 0.0,
    edge_length: float = 0.0,
    require_sphere: bool = True,
    values: Optional[Mapping[str, Any]] = None,
    progress: Progress = None,
) -> Mesh:
    """Mends a mesh so that it can be mapped, with little change to what the surface is.

    Parameters
    ----------
    mesh, faces, values
        As :class:`Mesh` takes them.
    non_finite
        Drop vertices whose coordinates are no finite numbers, with their faces.
    duplicates
        Remove faces that name a vertex twice or one that does not exist, and copies of faces. Indices
        that count from 1 are refused all the same.
    cracks
        Weld exact copies of vertices of arrays that are not closed, as :func:`read` does (texture coordinates
        then go to ``corner_uv``), and split edges of holes at the vertices that lie on them.
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
        Close holes of any length by fillers, which are no surface: ``fillers`` marks them, and what uses
        maps leaves them out. :func:`map` gives them ``filler_share`` of the sphere at most.
    weld_share, weld_length
        Vertices on the edges of holes that are at most so far apart become one, and edges are split at
        vertices that lie so near: in diagonals of the bounding box, or in units of the mesh.
    handle_choice
        ``"shortest"``; ``"cut"`` handles through, or ``"fill"`` what goes through them; ``"area"``:
        whichever adds less area.
    longest_handle
        The longest loop that a handle may be cut along, in diagonals of the bounding box of the part
        that it is in; in units of the mesh instead where ``longest_handle_length`` is more than 0.
    edge_share, edge_length
        More than 0: at last, edges that are longer are halved until none is, in diagonals of the bounding box, or
        in units of the mesh. A map bends within large flat faces then, not at their sides.
    require_sphere
        False: what cannot be mended comes back as far as it was; :func:`inspect` says what it is.

    Returns
    -------
    Mesh
        Closed, of genus 0; ``repairs`` says what was done, ``vertex_origin`` where vertices come from.

    Raises
    ------
    MeshError
        for what cannot be mended, with what remains.
    """
    options = _known({name: value for name, value in locals().items() if name in repair_option_names})
    with told(progress) as report:
        return mended(any_mesh(mesh, faces, values), options, report, require_sphere)


repair_option_names = frozenset(repair.__kwdefaults__ or {}) - {"values", "progress", "require_sphere"}
"""What a dict for ``repair=`` may have."""


def mended(
    mesh: Mesh, options: Dict[str, Any], report: Optional[Callable[[str, float], Any]], whole: bool = True
) -> Mesh:
    """Another mesh, by options that were looked at; exact copies of vertices are welded before."""
    whole_mesh = _welded_first(mesh, options)
    source = _core.repair(whole_mesh._source, _welding_too(mesh, options), whole, report)
    made = Mesh._of(source, source.is_sound)
    made._welds = whole_mesh._welds
    tell(lost_by_nearness(whole_mesh, made))
    made._share = mesh.area_share * source.kept_share
    return made


def _welding_too(mesh: Mesh, options: Dict[str, Any]) -> Dict[str, Any]:
    """Copies in arrays that must be mended before they can be welded as those of files."""
    wanted = mesh.format == "arrays" and not mesh._sound and options.get("cracks", True)
    named = options.keys() & {"weld_share", "weld_length"}
    return {**options, "weld_share": 0.0} if wanted and not named else options


def _welded_first(mesh: Mesh, options: Dict[str, Any]) -> Mesh:
    found = welded(mesh) if options.get("cracks", True) else None
    if found is None:
        return mesh
    tell(lost_by_welding(mesh, found))
    return found


def components(
    mesh: Any,
    faces: Any = None,
    *,
    repair: Union[bool, Mapping[str, Any]] = False,
    values: Optional[Mapping[str, Any]] = None,
    progress: Progress = None,
) -> List[Mesh]:
    """The connected parts of a mesh, the one with the largest area first.

    ``[sphparam.map(part, repair=True) for part in sphparam.components(mesh, repair=True)]`` maps each.
    ``mesh``, ``faces`` and ``values`` are as :class:`Mesh` takes them. ``repair``: those repairs of
    :func:`repair` are done before that come before parts, True or a dict of its arguments. Each part has
    its ``area_share``, and ``vertex_origin`` has the numbers of the whole.
    """
    options = repair_options(repair)
    found = any_mesh(mesh, faces, values)
    if options is None:
        found._require_sound()
    else:
        found = _welded_first(found, options)
    with told(progress) as report:
        parts = _core.components(found._source, options, report)
    if options is None and len(parts) > 1:
        tell(kept_apart(found))
    return [Mesh._of(source, share=share) for source, share in parts]


def _known(options: Dict[str, Any]) -> Dict[str, Any]:
    """Those that say something."""
    known = {name: value for name, value in options.items() if value is not None}
    for name in ("weld_share", "weld_length"):
        if name in known and not 0 <= _arrays.real(known[name], name) < float("inf"):
            raise ValueError(f"{name}: from 0 is needed, not {known[name]!r}")
    for name in ("edge_share", "edge_length"):
        if name in known and not 0 <= _arrays.real(known[name], name) < float("inf"):
            raise ValueError(f"{name}: from 0 is needed, not {known[name]!r}")
    if {"weld_share", "weld_length"} <= known.keys():
        raise ValueError("weld_share and weld_length contradict each other: both say how near is near")
    return known


def repair_options(wanted: Any) -> Optional[Dict[str, Any]]:
    """What ``repair`` of :func:`map` says: keyword arguments of the function above, or None."""
    if wanted is False or wanted is None:
        return None
    if wanted is True:
        return {}
    if not isinstance(wanted, Mapping):
        raise TypeError("repair: True, False, or a dict of arguments of sphparam.repair")
    for name in wanted:
        if name not in repair_option_names:
            raise TypeError(f"repair: no option is called {name!r}; there are {', '.join(sorted(repair_option_names))}")
    return _known(dict(wanted))
