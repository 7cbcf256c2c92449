"""Surfaces as sums of spherical harmonics."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple

from . import _arrays, _core
from ._attributes import document
from ._losses import tell
from ._map_grids import grid_of
from ._mesh import Path, path_of
from ._numpy import np

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt

    from ._sphere_map import SphereMap

    Floats = npt.NDArray[numpy.float64]


class Harmonics:
    """Coefficients of a surface, and of what its vertices carry.

    The basis is real and orthonormal, without the Condon–Shortley phase. :meth:`SphereMap.spharm`
    makes it, :func:`read_harmonics` reads it.
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        self.functions: List[str] = found["functions"]
        """What the columns are: ``"x"``, ``"y"``, ``"z"``, then values by name, ``"radius"`` last."""
        self.coefficients: Floats = found["coefficients"]
        """((L + 1)², k): row l² + l + m has the coefficients of Y_lm."""
        self.power: Floats = found["power"]
        """(L + 1, k) sum of the squared coefficients of each degree."""
        self.reconstructed: Floats = found["values"]
        """(V, k) what the harmonics have at the vertices; (0, k) of a file's, which has no vertices."""
        self.rms: float = found["rms"]
        """RMS distance at the vertices, weighted by solid angle, in units of the mesh; NaN of a file's."""
        self.plain_rms: float = found["plain_rms"]
        """The same with each vertex counted once."""
        self.decided_degree: Optional[int] = found["decided_degree"]
        """Up to which degree the vertices decide all coefficients; None of a file's. What they leave open is near the integral."""
        self.diagonal: float = found["diagonal"]
        """Of the bounding box: what to hold ``rms`` against."""
        self.ellipsoid: Tuple[float, float, float] = found["ellipsoid"]
        """Semi-axes of the first-order ellipsoid, descending."""
        self.centre: Optional[Tuple[float, float, float]] = found["centre"]
        """What ``"radius"`` is the distance from, in the mesh's coordinates; None where it was not expanded."""
        self.aligned: bool = found["aligned"]
        """Whether sphere and surface, or the sphere alone, were turned onto the ellipsoid's axes."""
        self._expansion = found["expansion"]

    @property
    def degree(self) -> int:
        """L."""
        return len(self.power) - 1

    @property
    def reference_radius(self) -> float:
        """C₀₀ of the radius, 4π-normalised: its mean over the sphere, in units of the mesh."""
        return float(self._radius()[0]) / math.sqrt(4 * math.pi)

    def _radius(self) -> Floats:
        if self.functions[-1] != "radius":
            raise ValueError("the radius was not expanded: m.spharm(degree, radius=True)")
        column: Floats = np.ascontiguousarray(self.coefficients[:, -1], np.float64)
        return column

    def save_shadr(self, path: Path) -> None:
        """Writes C and S of the radius as a table of the PDS, 4π-normalised, in units of the mesh.

        Raises ValueError where the radius was not expanded, or the sphere turned by ``align``; :class:`WriteError`.
        """
        if self.aligned:
            raise ValueError("align: such a table is of the body's own longitudes and latitudes, which align turns")
        _core.write_shadr(path_of(path), self._radius())

    def save(self, path: Path, *, normalisation: str = "orthonormal") -> None:
        """Writes the coefficients: ``.json`` and ``.csv`` as the program has them, ``.coef`` (of x, y, z) as SPHARM-PDM.

        ``normalisation``: ``"4pi"`` as in geodesy, of ``.json`` and ``.csv``. :func:`read_harmonics` reads ``.json`` and
        ``.coef`` again. Raises :class:`WriteError`.
        """
        name = path_of(path)
        if not name.lower().endswith((".json", ".csv", ".coef")):
            raise ValueError(f"path: coefficients end in .json, .csv or .coef, not {name!r}")
        if _arrays.text(normalisation, "normalisation") not in ("orthonormal", "4pi"):
            raise ValueError(f"normalisation: 'orthonormal' or '4pi', not {normalisation!r}")
        lost = self.functions[3:] if name.lower().endswith(".coef") else ()
        if lost:
            tell([f"{name}: a .coef has x, y and z alone: {', '.join(lost)} left out, which .json and .csv have"])
        _core.write_harmonics(self._expansion, self._table(), name, normalisation == "4pi")

    def surface(self, grid: Any, *, degree: Optional[int] = None, threads: int = 0) -> SphereMap:
        """The surface on a grid of the sphere, whose directions are its map, with what else was expanded as values.

        ``grid``: as of :meth:`SphereMap.remesh`. ``degree``: up to which (None: all): the surface without its detail.
        """
        from ._sphere_map import SphereMap

        table = self._table()
        if degree is not None:
            table = table[: (_arrays.whole(degree, "degree", 0, self.degree) + 1) ** 2]
        return SphereMap._of(_core.harmonic_surface(self._expansion, table, grid_of(grid), _arrays.threads(threads)))

    def __call__(self, directions: Any, *, threads: int = 0) -> Floats:
        """(n, k) what the harmonics have in directions, (n, 3) of any length but 0."""
        rows = _arrays.directions(directions)
        return _core.evaluate(self._table(), rows, _arrays.threads(threads))

    def _table(self) -> Floats:
        """The coefficients as they are now."""
        table = _arrays.numbers(self.coefficients, "coefficients").astype(np.float64)
        if table.ndim != 2:
            raise ValueError(f"coefficients: ((L + 1)², k) are needed, not {'×'.join(map(str, table.shape))}")
        return table

    def __repr__(self) -> str:
        return f"<sphparam.Harmonics: degree {self.degree}, {', '.join(self.functions)}, rms {self.rms:.3g}>"


def read_harmonics(path: Path) -> Harmonics:
    """Coefficients of a file: what ``sphparam spharm --json`` or :meth:`Harmonics.save` wrote, or a ``.coef`` of SPHARM-PDM.

    What was left at vertices is not known then: ``rms`` is NaN. Raises :class:`ReadError`.
    """
    found = _core.read_harmonics(path_of(path))
    for figure in ("rms", "plain_rms", "diagonal"):
        found[figure] = math.nan
    found["decided_degree"] = None
    return Harmonics(found)


document(globals())
