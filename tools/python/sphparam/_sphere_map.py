"""The one class of maps, put together."""

from __future__ import annotations

from . import _arrays, _core
from ._losses import tell
from ._map_directions import MapDirections
from ._map_facts import mapped_of
from ._map_files import MapFiles
from ._map_grids import MapGrids
from ._map_images import MapImages
from ._mesh import has_own_normals
from ._progress import Progress, told


class SphereMap(MapDirections, MapImages, MapGrids, MapFiles):
    """A mesh with a map onto the unit sphere that is proved one-to-one. It never changes.

    :func:`map` makes it, :func:`load` reads it, :func:`with_sphere` takes the map of another program.
    A triangle maps to the geodesic triangle of its three points.
    """

    __slots__ = ()

    def like(self, other: SphereMap, *, threads: int = 0, progress: Progress = None) -> SphereMap:
        """The same mesh, mapped so that in each direction it is where ``other`` is: an artist's low mesh of a sculpture.

        Each vertex goes towards where it is nearest to the other surface; a warning tells what share does not get
        there. Raises ``ValueError`` where the two do not lie about the same place.
        """
        with told(progress) as report:
            mapped, warnings = _core.map_like(
                self._mapped, mapped_of(other, "other"), _arrays.threads(threads), report
            )
        tell(warnings)
        return SphereMap._of(mapped)

    def creased(self, degrees: float, *, threads: int = 0) -> SphereMap:
        """The same map of the mesh with hard edges, as :meth:`Mesh.creased` makes them.

        Of how it came about it knows what ``provenance`` says. Where the mesh has normals it comes back as it is, with
        a warning.
        """
        made = _core.creased_map(self._mapped, _arrays.degrees(degrees, "degrees"), _arrays.threads(threads))
        if made is None:
            tell([has_own_normals(self.name)])
            return self
        return SphereMap._of(made)

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
