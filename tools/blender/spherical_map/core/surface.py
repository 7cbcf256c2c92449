"""A mesh of Blender as arrays, and as a file for sphparam."""

from dataclasses import dataclass, field
from typing import Dict, Optional

import numpy as np

from . import ply


@dataclass
class Surface:
    """Vertices, polygons, and the triangles that Blender draws for them, by Blender's numbers."""

    name: str
    positions: np.ndarray
    """(V, 3) float32."""
    loop_vertices: np.ndarray
    """(L,): a loop is a corner of a polygon."""
    polygon_starts: np.ndarray
    """(P,) first loops."""
    triangle_loops: np.ndarray
    """(T, 3)."""
    triangle_polygons: np.ndarray
    """(T,)."""
    directions: Optional[np.ndarray] = None
    """(V, 3) float64: where vertices go on the sphere."""
    uv: Optional[np.ndarray] = None
    """(L, 2): texture coordinates of its own, for base colour."""
    normals: Optional[np.ndarray] = None
    """(L, 3): normals as Blender shades with them."""
    colours: Optional[np.ndarray] = None
    """(V, 4) uint8, sRGB."""
    scalars: Dict[str, np.ndarray] = field(default_factory=dict)
    """Name to (V,): float32 or int32. Names are the user's, also `x` or `red`; see `column_of`."""
    used: np.ndarray = field(init=False)
    """Vertices of triangles, in order: numbers in the file count these."""
    triangles: np.ndarray = field(init=False)
    """(T, 3) vertices."""

    def __post_init__(self) -> None:
        self.triangles = self.loop_vertices[self.triangle_loops]
        self.used = np.unique(self.triangles)

    @property
    def polygon_count(self) -> int:
        """How many polygons there are."""
        return len(self.polygon_starts)

    def column_of(self, scalar: str) -> str:
        """What a scalar is called in the file: by number, for its own name may be that of a coordinate, a
        colour or part of the map there, or be no name of PLY."""
        return f"attribute_{list(self.scalars).index(scalar)}"

    def write(self, path) -> None:
        """Writes used vertices and all triangles, each with its number as `triangle`."""
        columns = dict(zip("xyz", self.positions[self.used].astype("<f4").T))
        if self.directions is not None:
            columns.update(zip(("sx", "sy", "sz"), self.directions[self.used].astype("<f8").T))
        if self.colours is not None:
            columns.update(zip(("red", "green", "blue", "alpha"), self.colours[self.used].T))
        columns.update({self.column_of(name): values[self.used] for name, values in self.scalars.items()})
        numbers = np.arange(len(self.triangles), dtype="<i4")
        ply.write_triangles(
            path,
            columns,
            np.searchsorted(self.used, self.triangles),
            {"triangle": numbers},
            None if self.uv is None else self.uv[self.triangle_loops],
            None if self.normals is None else self.normals[self.triangle_loops],
        )


def surface_of(found: ply.Ply, name: str) -> Surface:
    """A mesh with its map that sphparam has written; polygons are cut into fans."""
    starts = np.cumsum(found.counts) - found.counts
    fans = np.repeat(np.arange(len(starts)), found.counts - 2)
    which = np.arange(len(fans)) - np.repeat(np.cumsum(found.counts - 2) - (found.counts - 2), found.counts - 2)
    first = starts[fans]
    return Surface(
        name, found.table("x", "y", "z").astype(np.float32), found.corners, starts,
        np.stack([first, first + which + 1, first + which + 2], axis=1), fans,
        found.table("sx", "sy", "sz").astype(np.float64),
    )  # fmt: skip
