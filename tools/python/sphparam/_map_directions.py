"""What directions mean on the surface, and texture coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Tuple

from . import _arrays, _core
from ._map_facts import MapFacts
from ._numpy import np
from ._progress import Progress, told

if TYPE_CHECKING:
    from ._chart import Chart
    from ._map_facts import Array, Floats, Ints


class MapDirections(MapFacts):
    """From the sphere to the surface."""

    __slots__ = ()

    def locate(self, directions: Any, *, threads: int = 0) -> Tuple[Ints, Floats]:
        """The points of the surface that the map takes to some directions.

        Parameters
        ----------
        directions
            (k, 3), finite, of any length but 0.

        Returns
        -------
        face, weights
            (k,) the face, and (k, 3) barycentric weights of its corners; exactly 0 where a direction
            lies on an edge or at a vertex. Directions as they are, to the last bit.
        """
        rows = _arrays.directions(directions)
        return _core.locate(self._mapped, rows, _arrays.threads(threads))

    def resample(self, values: Any, directions: Any, *, threads: int = 0) -> Array:
        """Values of the vertices at directions.

        Floating numbers are interpolated linearly in each triangle; whole numbers and truth values are
        labels: the one whose corners weigh most together. NaN spreads to where it has weight. Whole
        numbers by the name ``"color"`` are no labels: interpolated as stored, and rounded.

        Parameters
        ----------
        values
            (V,) or (V, k), or the name of one of ``values``; ``"vertices"``: positions.
        directions
            (n, 3), finite, of any length but 0.
        """
        is_colour = isinstance(values, str) and values == "color"
        if isinstance(values, str):
            values = self.vertices if values == "vertices" else self._named(values)
        table = _arrays.unmasked(values, "values")
        if table.dtype.kind not in "fiubc":
            raise TypeError(f"values: numbers are needed, not {table.dtype}")
        _arrays.require_rows(table, "values", len(self.vertices))
        face, weights = self.locate(directions, threads=threads)
        corners = self.faces[face]
        weights = weights.reshape(weights.shape + (1,) * (table.ndim - 1))
        if table.dtype.kind in "iub" and not is_colour:
            return heaviest(table[corners], weights)
        parts = np.where(weights == 0, 0, table[corners]) * weights
        mixed: Array = parts.sum(axis=1)
        rounded: Array = np.rint(mixed) if table.dtype.kind in "iu" else mixed
        return rounded.astype(table.dtype, copy=False)

    def _named(self, name: str) -> Array:
        if name not in self.values:
            if name in self.face_values:
                raise ValueError(f"values: {name!r} is of faces: m.face_values[{name!r}][m.locate(directions)[0]] is that of the face at each direction")
            known = ", ".join(["vertices", *self.values])
            raise ValueError(f"values: the mesh has no {name!r}; it has {known}")
        return self.values[name]

    def chart(self, *, keep_topology: bool = False, threads: int = 0, progress: Progress = None) -> Chart:
        """The mesh split for texture coordinates (u, v): every point of the rectangle has one owner.

        ``keep_topology``: no vertex is added; triangles fold at the poles then.
        """
        from ._chart import Chart

        with told(progress) as report:
            found = _core.chart(self._mapped, _arrays.flag(keep_topology, "keep_topology"), _arrays.threads(threads), report)
        return Chart(self.vertices, self.faces, found)


def heaviest(labels: Array, weights: Array) -> Array:
    """Of three labels a row, (n, 3, …), the one whose weights add up to most; of equals the first."""
    votes = [(weights * (labels == labels[:, k : k + 1])).sum(axis=1) for k in range(3)]
    best = np.argmax(np.stack(votes, axis=1), axis=1)
    chosen: Array = np.take_along_axis(labels, best[:, None], axis=1)[:, 0]
    return chosen
