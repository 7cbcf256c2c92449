"""Where a mesh is broken: all places of each kind of defect that sphparam names, to be selected.

sphparam lists the first ten places of a kind; whoever mends the mesh by hand wants to see all.
"""

from typing import Callable, Dict

import numpy as np

from . import connected
from .refusal import Defect, Elements
from .surface import Surface


class _Edges:
    """The sides of triangles, sorted so that those of one edge are neighbours."""

    def __init__(self, triangles: np.ndarray):
        tails, heads = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
        pairs = np.stack([np.minimum(tails, heads), np.maximum(tails, heads)], axis=1)
        self.pairs, self.edge, self.faces = np.unique(
            pairs, axis=0, return_inverse=True, return_counts=True
        )
        self.edge = self.edge.ravel()
        self.forward = np.bincount(self.edge, weights=tails < heads, minlength=len(self.pairs))


def _boundary(surface: Surface, edges: _Edges) -> Elements:
    return Elements(edges=edges.pairs[edges.faces == 1])


def _non_manifold(surface: Surface, edges: _Edges) -> Elements:
    return Elements(edges=edges.pairs[edges.faces > 2])


def _turned(surface: Surface, edges: _Edges) -> Elements:
    return Elements(edges=edges.pairs[(edges.faces == 2) & (edges.forward != 1)])


def _touching(surface: Surface, edges: _Edges) -> Elements:
    """Vertices whose triangles are two fans or more: corners hang together across edges there."""
    order = np.argsort(edges.edge, kind="stable")
    same = np.flatnonzero(np.diff(edges.edge[order]) == 0)
    sides = np.stack([order[same], order[same + 1]], axis=1)
    triangles = surface.triangles

    def corner_at(side, vertex):
        face = side // 3
        return 3 * face + np.argmax(triangles[face] == vertex[:, None], axis=1)

    pairs = [
        np.stack([corner_at(sides[:, 0], end), corner_at(sides[:, 1], end)], axis=1)
        for end in edges.pairs[edges.edge[sides[:, 0]]].T
    ]
    fans = connected.labels(triangles.size, np.concatenate(pairs))
    corners = np.unique(np.stack([triangles.ravel(), fans], axis=1), axis=0)[:, 0]
    vertices, count = np.unique(corners, return_counts=True)
    return Elements(vertices=vertices[count > 1])


def _lesser_parts(surface: Surface, edges: _Edges) -> Elements:
    """All but the part with the most triangles."""
    part = connected.labels(len(surface.positions), edges.pairs)[surface.triangles[:, 0]]
    largest = np.bincount(part).argmax()
    return Elements(polygons=np.unique(surface.triangle_polygons[part != largest]))


def _copies(surface: Surface, edges: _Edges) -> Elements:
    _, which, count = np.unique(
        np.sort(surface.triangles, axis=1), axis=0, return_inverse=True, return_counts=True
    )
    return Elements(polygons=np.unique(surface.triangle_polygons[count[which.ravel()] > 1]))


_finders: Dict[str, Callable[[Surface, _Edges], Elements]] = {
    "boundary-edge": _boundary,
    "non-manifold-edge": _non_manifold,
    "inconsistent-orientation": _turned,
    "non-manifold-vertex": _touching,
    "several-components": _lesser_parts,
    "duplicate-face": _copies,
}


def places_of(surface: Surface, defects) -> Elements:
    """All places of the first fatal kind of defect that has any."""
    edges = _Edges(surface.triangles)
    for defect in defects:
        if not defect.fatal:
            continue
        found = _finders[defect.kind](surface, edges) if defect.kind in _finders else _listed(surface, defect)
        if found:
            return found
    return Elements()


def _listed(surface: Surface, defect: Defect) -> Elements:
    """The places that sphparam listed: faces, of these kinds."""
    if defect.kind not in ("repeated-vertex", "zero-area-face", "index-out-of-range"):
        return Elements()
    return Elements(polygons=np.unique(surface.triangle_polygons[list(defect.ids)]))
