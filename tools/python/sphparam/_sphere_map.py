"""The one class of maps, put together."""

from __future__ import annotations

from ._map_directions import MapDirections
from ._map_files import MapFiles
from ._map_grids import MapGrids
from ._map_images import MapImages


class SphereMap(MapDirections, MapImages, MapGrids, MapFiles):
    """A mesh with a map onto the unit sphere that is proved one-to-one. It never changes.

    :func:`map` makes it, :func:`load` reads it, :func:`with_sphere` takes the map of another program.
    A triangle maps to the geodesic triangle of its three points.
    """

    __slots__ = ()

    def show(self, *, size: int = 1024) -> str:
        """Opens the page of :meth:`report`, of that ``size``, in a browser; returns where it is."""
        from ._page import show

        return show(self, size)

    def _repr_html_(self) -> str:
        from ._page import html_of

        return self._once("html", lambda: html_of(self))

    def __repr__(self) -> str:
        return (
            f"<sphparam.SphereMap: {len(self.vertices)} vertices, {len(self.faces)} faces, "
            f"{self.certificate.verdict}, {self.name}>"
        )
