"""Maps on grids of the sphere: resampled, fitted, expanded."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

from . import _arrays, _core
from ._errors import as_typed_here
from ._figures import InSpace
from ._losses import tell
from ._map_facts import MapFacts, mapped_of
from ._mesh import any_mesh, centre_of
from ._numpy import np
from ._progress import Progress, told

if TYPE_CHECKING:
    from ._harmonics import Harmonics
    from ._map_facts import Floats
    from ._sphere_map import SphereMap
    from ._subdivision import SubdivisionFit


_most_levels = 64  # with a quarter each there are none behind these


def _remeshed(made: _core.Mapped, figures: Dict[str, Any], messages: List[str]) -> SphereMap:
    """What the library tells of a new mesh is told of it."""
    from ._sphere_map import SphereMap

    remeshed = SphereMap._of(made)
    remeshed._found["in_space"] = InSpace(**figures)
    if messages:
        remeshed._found["warnings"] = [as_typed_here(message) for message in messages]
        tell(messages)
    return remeshed


def _areas(pair: Any) -> List[Any]:
    """Of vertices, as arrays."""
    both = _arrays.listed(pair, "areas", "two arrays or surfaces")
    if len(both) != 2:
        raise ValueError(f"areas: two are needed, of the mesh and of the grid, not {len(both)}")
    return [_areas_of(areas) for areas in both]


def _areas_of(areas: Any) -> Any:
    if isinstance(areas, list) or getattr(areas, "ndim", 0) == 1:
        return _arrays.numbers(areas, "areas")
    mesh = any_mesh(areas, None)
    mesh._require_sound()
    return _core.vertex_areas(mesh._source)


def _within(length: float, grid: Any, is_settled: bool) -> float:
    if grid != "ico":
        raise ValueError(f"within finds the level of grid='ico', and is not for {grid!r}")
    if is_settled:
        raise ValueError("within is not for areas, adaptive and uv='grid': find the level first")
    most = _arrays.real(length, "within")
    if not most >= 0:
        raise ValueError(f"within: a length, at least 0, not {length!r}")
    return most


class MapGrids(MapFacts):
    """To other meshes on the same sphere."""

    __slots__ = ()

    def remesh(
        self,
        grid: Union[str, SphereMap],
        *,
        sample: str = "point",
        transfer: Union[str, Iterable[str]] = "all",
        areas: Optional[Tuple[Any, Any]] = None,
        adaptive: bool = False,
        within: Optional[float] = None,
        uv: str = "mesh",
        threads: int = 0,
        progress: Progress = None,
    ) -> SphereMap:
        """The surface on a grid of the sphere, whose directions are the map of the result.

        Holes that were kept are closed in the result as well: its ``fillers`` mark these faces. Faces that cross
        others in space or lie inverted, although the map is one-to-one, are counted (:attr:`in_space`) and warned of.

        Parameters
        ----------
        grid
            ``"ico:6"``, ``"ico:f=40"``, ``"octa:257"``, ``"cube:32"``, ``"uv:512x256"``,
            ``"healpix:64"``; or another map, whose connectivity the result gets; ``"ico"`` with ``within``.
        sample
            ``"point"``: the surface at the direction; ``"cell"``: its mean over the
            triangles of the grid about a vertex, a tent, by area. What vertices
            have as Workbench resamples it: ``"barycentric"``, ``"adap-bary-area"``.
        transfer
            What to carry: ``"all"``, or names of values; ``[]``: positions alone.
        areas
            With ``sample="adap-bary-area"``: of this mesh's vertices and of the grid's, each an array or a surface,
            whose areas are meant; else those of this mesh, and of what becomes of it.
        adaptive
            More vertices where the surface bends.
        within
            A length: of ``"ico:0"`` to ``"ico:9"`` the coarsest whose faces are nowhere farther than this from the
            surface, nor it from them; a warning where none is.
        uv
            Texture coordinates of the result: ``"mesh"``, what the surface has; ``"grid"``, the grid's own
            layout, six squares for a cube and so on.
        """
        options = {
            "transfer": self._transferred(transfer),
            "sample": _arrays.text(sample, "sample"),
            "uv": _arrays.text(uv, "uv"),
            "adaptive": _arrays.flag(adaptive, "adaptive"),
            "threads": _arrays.threads(threads),
        }
        if areas is not None:
            if sample != "adap-bary-area":
                raise ValueError('areas: for sample="adap-bary-area" alone')
            options["source_areas"], options["grid_areas"] = _areas(areas)
        if within is not None:
            options["within"] = _within(within, grid, areas is not None or adaptive or uv != "mesh")
        onto = "" if within is not None else grid_of(grid)
        with told(progress) as report:
            return _remeshed(*_core.remesh(self._mapped, onto, options, report))

    def levels(self, count: int, *, threads: int = 0, progress: Progress = None) -> List[SphereMap]:
        """Levels of detail on icosahedra, the first with a quarter of the vertices, and so on; fewer at 12.

        Their faces in space are counted and warned of as those of :meth:`remesh`: :attr:`in_space`.
        """
        wanted = min(_arrays.whole(count, "count", 0), _most_levels)
        with told(progress) as report:
            made = _core.levels(self._mapped, wanted, _arrays.threads(threads), report)
        return [_remeshed(*level) for level in made]

    def fit(
        self,
        grid: Union[str, SphereMap],
        *,
        scheme: str = "loop",
        transfer: Union[str, Iterable[str]] = "all",
        threads: int = 0,
        progress: Progress = None,
    ) -> SubdivisionFit:
        """A subdivision surface on a grid, nearest to the mesh in the sense of least squares.

        ``scheme``: ``"loop"`` for triangles, ``"catmark"`` for quads and triangles. ``grid`` and
        ``transfer`` are those of :meth:`remesh`.
        """
        from ._subdivision import SubdivisionFit

        names, surface = self._transferred(transfer), _arrays.text(scheme, "scheme")
        with told(progress) as report:
            made = _core.fit(self._mapped, grid_of(grid), surface, names, _arrays.threads(threads), report)
        return SubdivisionFit._of(made)

    def spharm(
        self,
        degree: int = 20,
        *,
        values: Sequence[str] = (),
        least_squares: bool = True,
        align: Union[bool, str] = False,
        flip_template: Optional[Harmonics] = None,
        radius: bool = False,
        centre: Union[str, Tuple[float, float, float], None] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Harmonics:
        """The surface as a sum of spherical harmonics up to a degree, 0 to 1000.

        ``values``: names of what vertices carry, expanded too. ``least_squares``: at the vertices; else by quadrature, which
        what vertices leave open stays near: a warning tells up to which degree they decide. ``align``: sphere and surface turned
        onto the axes of the first-order ellipsoid, so that coefficients do not depend on how mesh and map lay; ``"sphere"``: the sphere alone, as SPHARM-PDM has both.
        ``flip_template``: of the half turns that leave the ellipsoid, that which brings coefficients nearest to these, which are
        aligned (None: by the surface's skewness). ``radius``: the distance from
        ``centre`` too (``"centroid"``: that of what the mesh encloses; None: that of a radial map, else the origin), as planetary science has shapes; of a map of
        ``method="radial"`` by the body's own longitudes and latitudes, and a warning tells how far others are off.
        """
        from ._harmonics import Harmonics

        turned = _alignment(align)
        flips = _flips(flip_template, turned)
        if isinstance(values, (Mapping, np.ndarray)):
            raise TypeError("values: names of what the mesh has are needed, not arrays: sphparam.map(mesh, values={…}) gives it some")
        names = [column for name in _names(values, "values") for column in self.values.columns(name)]
        faces = [name for name in names if name not in self.values and name in self.face_values]
        if faces:
            raise ValueError(f"values: {faces[0]!r} is of faces; harmonics are of what vertices have")
        degree = _arrays.whole(degree, "degree", 1 if turned else 0, 1000)
        about = None if centre is None else centre_of(centre, self.mesh)
        if about is not None and not radius:
            raise ValueError("centre: it is that of the radius: radius=True")
        if self.fillers.any():
            tell([f"{self.name}: harmonics are of the whole sphere, with what closes the holes"])
        with told(progress) as report:
            found = _core.expand(
                self._mapped, degree, names, _arrays.flag(least_squares, "least_squares"), turned, flips,
                _arrays.flag(radius, "radius"), about, _arrays.threads(threads), report,  # fmt: skip
            )
        tell(found["doubts"])
        return Harmonics(found)

    def _transferred(self, transfer: Union[str, Iterable[str]]) -> List[str]:
        """Words of the library's, and columns for arrays of them."""
        columns: List[str] = []
        for name in _names(transfer, "transfer"):
            values = self.values if name in self.values else self.face_values
            columns += [name] if name in ("color", "normal", "uv") else values.columns(name)
        return columns


def _names(names: Union[str, Iterable[str]], what: str) -> List[str]:
    return [_arrays.text(name, what) for name in ([names] if isinstance(names, str) else _arrays.listed(names, what, "names"))]


def _alignment(align: Union[bool, str]) -> str:
    if isinstance(align, str):
        if align != "sphere":
            raise ValueError(f"align: True, or 'sphere', not {align!r}")
        return align
    return "surface" if _arrays.flag(align, "align") else ""


def _flips(template: Optional[Harmonics], turned: str) -> Optional[Floats]:
    from ._harmonics import Harmonics

    if template is None:
        return None
    if not isinstance(template, Harmonics):
        raise TypeError(f"flip_template: Harmonics are needed, as sphparam.read_harmonics makes them, not {type(template).__name__}")
    if not turned:
        raise ValueError("flip_template: it is for align=True or align='sphere'")
    return template._table()[:, :3].copy()


def grid_of(grid: Any) -> Union[str, _core.Mapped]:
    """A grid's name, or a map whose directions are one."""
    if isinstance(grid, int) or (isinstance(grid, str) and grid.isdigit()):
        raise TypeError(f"grid: 'ico:{grid}', another one of {_patterns()}, or a map, not {grid!r}")
    if isinstance(grid, str) and not grid.startswith(("ico:", "octa:", "cube:", "uv:", "healpix:")):
        raise ValueError(f"grid: {_patterns()}, or a map (remesh(other), where the program has like:), not {grid!r}")
    return _arrays.text(grid, "grid") if isinstance(grid, str) else mapped_of(grid, "grid")


def _patterns() -> str:
    return "'ico:L', 'ico:f=N', 'octa:N', 'cube:N', 'uv:WxH', 'healpix:NSIDE'"
