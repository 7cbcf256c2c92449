"""The mesh split for texture coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict

from . import _arrays
from ._attributes import document
from ._numpy import np

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt

    Array = npt.NDArray[Any]
    Floats = npt.NDArray[numpy.float64]
    Ints = npt.NDArray[numpy.int32]


class Chart:
    """A refined mesh and its (u, v): u = θ/2π from 0 to 1, v = φ/π from 0 at the north pole to 1.

    A wedge is a copy of a refined vertex with a (u, v) of its own, as vertex buffers have one entry
    each: along the meridian vertices have two, at the poles one a triangle. Refined vertices 0 … V − 1
    are those of the mesh.
    """

    def __init__(self, vertices: Floats, faces: Ints, found: Dict[str, Any]) -> None:
        self._faces_of_mesh, self._count = faces, len(vertices)
        self.one_to_one: bool = found["one_to_one"]
        """Whether every point of the rectangle has exactly one owner; proved with exact signs."""
        self.faces: Ints = found["faces"]
        """(F′, 3) refined vertices."""
        self.points: Floats = found["points"]
        """(V′, 3) refined vertices on the sphere."""
        self.wedges: Ints = found["wedges"]
        """(F′, 3) wedges, face by face as ``faces``."""
        self.uv: Floats = found["uv"]
        """(W, 2) texture coordinates of the wedges, v downwards."""
        self.wedge_vertices: Ints = found["wedge_vertices"]
        """(W,) the refined vertex of each wedge."""
        self.source_faces: Ints = found["source_faces"]
        """(F′,) the face of the mesh that each triangle is part of."""
        self.surface_faces: Ints = found["surface_faces"]
        """(V′,) a face of the mesh that each refined vertex lies in …"""
        self.surface_weights: Floats = found["surface_weights"]
        """(V′, 3) … and its barycentric weights there."""
        self.counts: Dict[str, int] = found["counts"]
        """How many splits were needed, and where."""
        self.vertices: Floats = self.carry(vertices)
        """(V′, 3) refined vertices on the surface."""

    def carry(self, values: Any) -> Array:
        """Floating values of the mesh's vertices, (V,) or (V, k), at the refined vertices."""
        table = _arrays.unmasked(values, "values")
        if table.dtype.kind != "f":
            raise TypeError(f"values: floating numbers are needed, not {table.dtype}")
        _arrays.require_rows(table, "values", self._count)
        corners = self._faces_of_mesh[self.surface_faces]
        weights = self.surface_weights.reshape(self.surface_weights.shape + (1,) * (table.ndim - 1))
        carried: Array = (np.where(weights == 0, 0, table[corners]) * weights).sum(axis=1)
        return carried

    def __repr__(self) -> str:
        proved = "one-to-one" if self.one_to_one else "not one-to-one"
        return f"<sphparam.Chart: {len(self.faces)} triangles, {len(self.uv)} wedges, {proved}>"


document(globals())
