"""Subdivision surfaces fitted to meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Tuple

from . import _arrays, _core
from ._figures import Displacement
from ._mesh import Path, path_of
from ._progress import Progress, told

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt

    from ._sphere_map import SphereMap

    Floats = npt.NDArray[numpy.float64]
    Ints = npt.NDArray[numpy.int32]


class SubdivisionFit:
    """A smooth surface on a grid of the sphere, as near to a mesh as its control points allow.

    :meth:`SphereMap.fit` makes it.
    """

    __slots__ = ("_fitted", "_control")

    _fitted: _core.Fitted
    _control: SphereMap

    @classmethod
    def _of(cls, fitted: _core.Fitted) -> SubdivisionFit:
        from ._sphere_map import SphereMap

        made = cls.__new__(cls)
        made._fitted, made._control = fitted, SphereMap._of(fitted.control)
        return made

    @property
    def control(self) -> SphereMap:
        """The control mesh; ``control.polygons`` are the faces to subdivide, quads too."""
        return self._control

    @property
    def rms(self) -> float:
        """RMS distance from the surface to the mesh, in units of the mesh."""
        return self._fitted.rms

    @property
    def max(self) -> float:
        """The largest such distance among the samples."""
        return self._fitted.max

    @property
    def two_sided_rms(self) -> float:
        """RMS distance, both ways."""
        return self._fitted.two_sided_rms

    @property
    def flat_rms(self) -> float:
        """The same of flat faces on the grid: smaller where the grid is too coarse for a surface."""
        return self._fitted.flat_rms

    def limit_vertices(self, *, threads: int = 0) -> Floats:
        """(V, 3) the control points moved to the surface."""
        return _core.limit_vertices(self._fitted, _arrays.threads(threads))

    def fine_mesh(self, triangles: int = 100_000, *, threads: int = 0) -> Tuple[Floats, Ints]:
        """Vertices and faces of the smooth surface, in about so many triangles or more."""
        least = _arrays.whole(triangles, "triangles", 1, 2**62)
        return _core.fine_mesh(self._fitted, least, _arrays.threads(threads))

    def textured_control(self, *, size: Tuple[int, int] = (4096, 2048), threads: int = 0) -> SphereMap:
        """The control mesh with texture coordinates in the layout of its grid, in which
        ``displace(layout="grid")`` of the same ``size`` puts its image: saved as an ``.obj``, what other
        programs subdivide and displace."""
        from ._sphere_map import SphereMap

        width, height = _arrays.width_and_height(size)
        return SphereMap._of(_core.textured_control(self._fitted, width, height, _arrays.threads(threads)))

    def displace(
        self,
        path: Path,
        *,
        size: Tuple[int, int] = (4096, 2048),
        layout: str = "equirectangular",
        depth: str = "",
        rebuilt: Path = "",
        threads: int = 0,
        progress: Progress = None,
    ) -> Displacement:
        """Writes what the surface lacks, along its normals, as an image.

        Parameters
        ----------
        path
            An ``.exr`` (half or float) or ``.png`` (16 bits).
        size
            Width and height in texels; in the layout of a grid no more texels than that.
        layout
            ``"equirectangular"``, or ``"grid"``: for the coordinates of :meth:`textured_control`.
        depth
            ``"half"``, ``"float"``, ``"uint16"``; empty: as the format has it.
        rebuilt
            Also a mesh of surface and image together, read back: a ``.ply`` or ``.obj``, and its
            distance from the mesh.
        """
        width, height = _arrays.width_and_height(size)
        options = {
            "width": width,
            "height": height,
            "rebuilt": path_of(rebuilt) if rebuilt else "",
            "layout": _arrays.text(layout, "layout"),
            "threads": _arrays.threads(threads),
        }
        if _arrays.text(depth, "depth"):
            options["depth"] = depth
        with told(progress) as report:
            found = _core.displace(self._fitted, path_of(path), options, report)
        return Displacement(**found)

    def __repr__(self) -> str:
        return f"<sphparam.SubdivisionFit: {len(self._control.vertices)} control points, rms {self.rms:.3g}>"
