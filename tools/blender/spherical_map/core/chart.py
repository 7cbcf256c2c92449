"""The (u, v) of a mapped mesh, put on the polygons of Blender.

The chart cuts triangles where the seam θ = 0 crosses them and where they would fold. A polygon that
nothing cuts, and whose corners have one (u, v) each, stays as it is; the others are replaced by the
chart's triangles. At a pole each triangle has a u of its own, in the middle of its far edge.
"""

from dataclasses import dataclass

import numpy as np

from . import ply
from .surface import Surface

_nothing = 1e-9  # weights below are rounding: the vertex lies on the edge, or is the corner


@dataclass
class Chart:
    """The refined mesh: vertices 0 … n − 1 are those of the surface's file."""

    points: np.ndarray
    """(n′, 3) on the unit sphere."""
    triangles: np.ndarray
    """(k, 3)."""
    uv: np.ndarray
    """(k, 3, 2), v upwards as Blender has it."""
    source: np.ndarray
    """(k,) the triangle of the surface that each is part of."""


def read(path) -> Chart:
    """Of a file that `route.chart` wrote for a file of `Surface.write`."""
    found = ply.read(path)
    return Chart(
        found.table("x", "y", "z").astype(np.float64),
        found.triangles(),
        found.texcoords.reshape(-1, 3, 2).astype(np.float64),
        np.rint(found.faces["triangle"]).astype(np.int64),
    )


@dataclass
class Cut:
    """What becomes of a mesh. New vertices have the numbers from V on, V being those of the mesh."""

    directions: np.ndarray
    """(V + k, 3) on the sphere; 0 of vertices without faces."""
    new_corners: np.ndarray
    """(k, 3) vertices of the mesh that each new one lies between …"""
    new_weights: np.ndarray
    """(k, 3) … and its weights."""
    kept: np.ndarray
    """(P,) bool: polygons that stay."""
    loop_uv: np.ndarray
    """(L, 2) of the loops of these."""
    polygons: np.ndarray
    """(m,) of each new triangle the polygon that it is part of …"""
    vertices: np.ndarray
    """(m, 3) … its corners …"""
    uv: np.ndarray
    """(m, 3, 2) … their (u, v) …"""
    loops: np.ndarray
    """(m, 3) … the loops of the triangle that it is part of …"""
    weights: np.ndarray
    """(m, 3, 3) … and the weights of these at each corner."""

    @property
    def is_needed(self) -> bool:
        """Whether the mesh changes."""
        return not self.kept.all()


def _weights_in(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    """λ ≥ 0 with sum 1 so that Σ λᵢ xᵢ has the direction of a point; (n, 3, 3) and (n, 3) to (n, 3)."""
    found = np.linalg.solve(corners.transpose(0, 2, 1), points[:, :, None])[:, :, 0]
    found /= found.sum(axis=1, keepdims=True)
    found[found < _nothing] = 0
    found[found > 1 - _nothing] = 1
    return found / found.sum(axis=1, keepdims=True)


def _corner_uv(surface: Surface, chart: Chart, whole: np.ndarray):
    """Of triangles that nothing cuts, (j,), the (u, v) of their corners in the surface's order."""
    row_of = np.zeros(len(surface.triangles), np.int64)
    row_of[chart.source] = np.arange(len(chart.source))
    rows = row_of[whole]
    wanted = np.searchsorted(surface.used, surface.triangles[whole])
    place = (chart.triangles[rows][:, None, :] == wanted[:, :, None]).argmax(axis=2)
    return chart.uv[rows[:, None], place]


def _uv_of_loops(surface: Surface, whole: np.ndarray, uv: np.ndarray):
    """(L, 2) least and greatest (u, v) of a loop among its triangles."""
    loops = surface.triangle_loops[whole].ravel()
    least = np.full((len(surface.loop_vertices), 2), np.inf)
    greatest = -least
    np.minimum.at(least, loops, uv.reshape(-1, 2))
    np.maximum.at(greatest, loops, uv.reshape(-1, 2))
    return least, greatest


def cut(surface: Surface, chart: Chart) -> Cut:
    """Finds what of the chart changes the mesh. Requires: the chart of this surface."""
    count, sent = len(surface.positions), len(surface.used)
    whole = np.flatnonzero(np.bincount(chart.source, minlength=len(surface.triangles)) == 1)
    uv = _corner_uv(surface, chart, whole)
    least, greatest = _uv_of_loops(surface, whole, uv)
    is_whole = np.zeros(len(surface.triangles), bool)
    is_whole[whole] = True
    kept = np.ones(surface.polygon_count, bool)
    kept[surface.triangle_polygons[~is_whole]] = False
    torn = (least != greatest).any(axis=1)[surface.triangle_loops].any(axis=1)
    kept[surface.triangle_polygons[torn]] = False

    rows = np.flatnonzero(~kept[surface.triangle_polygons[chart.source]])
    source = chart.source[rows]
    numbers = np.concatenate([surface.used, count + np.arange(len(chart.points) - sent)])
    corners = chart.points[np.searchsorted(surface.used, surface.triangles[source])]
    weights = np.stack([_weights_in(corners, chart.points[chart.triangles[rows, k]]) for k in range(3)], 1)
    is_new = chart.triangles[rows] >= sent
    face, corner = np.nonzero(is_new)
    new = chart.triangles[rows][is_new] - sent
    new_corners = np.zeros((len(chart.points) - sent, 3), np.int64)
    new_weights = np.zeros((len(chart.points) - sent, 3))
    new_corners[new] = surface.triangles[source[face]]
    new_weights[new] = weights[face, corner]
    directions = np.zeros((count + len(new_corners), 3))
    directions[numbers] = chart.points
    return Cut(
        directions, new_corners, new_weights, kept, least, surface.triangle_polygons[source],
        numbers[chart.triangles[rows]], chart.uv[rows], surface.triangle_loops[source], weights,
    )  # fmt: skip


def wrapped_uv(surface: Surface, chart: Chart) -> np.ndarray:
    """(L, 2) for a mesh that is not to be cut: u goes on beyond 1 across the seam, as images that
    repeat do. Of a polygon at a pole the corner there has the mean u of its triangles."""
    uv = _corner_uv(surface, chart, np.arange(len(surface.triangles)))
    loops = surface.triangle_loops.ravel()
    first = np.zeros(surface.polygon_count)
    first[surface.triangle_polygons[::-1]] = uv[::-1, 0, 0]
    u = uv[:, :, 0] - np.rint(uv[:, :, 0] - first[surface.triangle_polygons][:, None])
    found = np.zeros((len(surface.loop_vertices), 2))
    times = np.bincount(loops, minlength=len(found))
    for axis, values in enumerate((u, uv[:, :, 1])):
        found[:, axis] = np.bincount(loops, values.ravel(), len(found)) / np.maximum(times, 1)
    starts = surface.polygon_starts
    lowest = np.floor(np.minimum.reduceat(found[:, 0], starts))
    polygon_of = np.repeat(np.arange(len(starts)), np.diff(np.append(starts, len(found))))
    found[:, 0] -= lowest[polygon_of]
    return found


def directions_of(surface: Surface, chart: Chart) -> np.ndarray:
    """(V, 3) of a mesh that is not cut."""
    found = np.zeros((len(surface.positions), 3))
    found[surface.used] = chart.points[: len(surface.used)]
    return found
