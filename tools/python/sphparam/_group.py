"""Shapes beside shapes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple, Union

from . import _arrays, _core
from ._attributes import document
from ._figures import GroupScalar, Landmarks
from ._losses import tell
from ._map_facts import mapped_of
from ._match import nearest_vertices
from ._numpy import np
from ._progress import Progress, told
from ._sphere_map import SphereMap

if TYPE_CHECKING:
    from ._map_facts import Floats, Ints


class Group:
    """Shapes in correspondence: vertex v of the mean is the same place on all. :func:`group` makes it."""

    def __init__(self, found: Dict[str, Any]) -> None:
        self.shapes: List[SphereMap] = [SphereMap._of(shape["map"]) for shape in found["shapes"]]
        """Each with its own triangles and its map moved into correspondence; all are proved."""
        self.template: SphereMap = SphereMap._of(found["reference"])
        """What all were brought to first, with its map in correspondence."""
        self.mean: SphereMap = SphereMap._of(found["mean"])
        """On the grid, as the template lies."""
        self.aligned: Floats = found["aligned"]
        """(n, V, 3) the shapes on the grid, moved and turned onto the mean; with ``scale`` all of one size."""
        self.growth: Floats = found["growth"]
        """(n, V) area about each vertex of ``aligned`` over that of the mean: above 1 where a shape is larger."""
        self.scalars: Dict[str, GroupScalar] = {of[0]: GroupScalar(*of) for of in found["scalars"]}
        """Of floating numbers that two shapes or more have under one name, mean and deviation."""
        self.weights: Floats = found["weights"]
        """(V,) mean shares of the area, whose sum is 1."""
        self.deviation: Floats = found["deviation"]
        """(V,) standard deviation of the shapes, a length."""
        self.normal_deviation: Floats = found["normal_deviation"]
        """(V,) the same along the mean's normals."""
        self.distances: Floats = found["distances"]
        """(n, n) RMS distance of each two of ``aligned``, one moved and turned onto the other."""
        self.modes: Floats = found["modes"]
        """(k, V, 3) what one standard deviation of each principal mode adds, most variance first."""
        self.deviations: Floats = found["deviations"]
        """(k,) RMS displacement by one standard deviation."""
        self.shares: Floats = found["shares"]
        """(k,) of the variance, what each mode has."""
        self.scores: Floats = found["scores"]
        """(n, k) of each shape, in standard deviations: shape = mean + scores · modes."""
        self.variance: float = found["variance"]
        """Of all modes, also those that are not kept: Σ |x − mean|² / (n − 1), by ``weights``."""
        self.sizes: List[float] = [shape["size"] for shape in found["shapes"]]
        """Of each shape on the grid, as it was: RMS distance of its surface from its centroid, both by area,
        whoever else is in the group."""
        self.starts: List[str] = [shape["start"] for shape in found["shapes"]]
        """What each way to the template began with: ``"ends"``, ``"turn"`` where there were none to pair, ``"rotation"``,
        ``"ellipsoid"``, ``"places"`` nearest in space (``alike``), ``"its map"``; ``"template"``."""
        self.mirrored: List[bool] = [shape["mirrored"] for shape in found["shapes"]]
        """Whether a shape is its mirror image in the plane x = 0 here, with ``mirror``."""
        self.energies: List[float] = [shape["energy"] or math.nan for shape in found["shapes"]]
        """Of the last minimisation, where isometry has 2; NaN where there was none, as with ``hold``."""
        self.confidences: List[float] = [shape["confidence"] for shape in found["shapes"]]
        """In each start: 0 where another is as good, 1 where there is no other."""
        self.resampling_rms: List[float] = [shape["resampling_rms"] for shape in found["shapes"]]
        """How far each shape's own vertices are from it on the grid."""

    def along(self, mode: int, deviations: float) -> Floats:
        """(V, 3) the mean and so many standard deviations of a mode."""
        shape: Floats = self.mean.vertices + deviations * self.modes[mode]
        return shape

    def landmarks(self, vertices: Union[Sequence[int], Any], *, threads: int = 0) -> Landmarks:
        """Where vertices of the template are on every shape: (k,) numbers of rows of ``template.vertices``.

        Or (k, 3) points of the template, for the vertices nearest to them; one that is far from any is told.
        """
        if isinstance(vertices, (list, tuple, np.ndarray)) and np.ndim(vertices) == 2:
            vertices = nearest_vertices(np.asarray(vertices), self.template, "vertices")
        last = len(self.template.vertices) - 1
        chosen = [_arrays.whole(v, "vertices", 0, last) for v in _arrays.listed(vertices, "vertices", "vertices")]
        directions = self.template.points[chosen]
        rows = [_landmarks(shape, directions, threads) for shape in self.shapes]
        return Landmarks(*(np.stack(column) for column in zip(*rows)))

    def __repr__(self) -> str:
        return f"<sphparam.Group: {len(self.shapes)} shapes, {len(self.mean.vertices)} vertices, {len(self.modes)} modes>"


def _landmarks(shape: SphereMap, directions: Floats, threads: int) -> Tuple[Floats, Ints, Floats, Ints]:
    """A row of :class:`Landmarks`."""
    faces, weights = shape.locate(directions, threads=threads)
    points = (weights[:, :, None] * shape.vertices[shape.faces[faces]]).sum(axis=1)
    nearest = [np.argmin(((shape.vertices - point) ** 2).sum(axis=1)) for point in points]
    return points, faces, weights, np.array(nearest, np.int32)


def group(
    shapes: Sequence[SphereMap],
    template: Optional[SphereMap] = None,
    *,
    start: str = "ends",
    alike: bool = False,
    mirror: bool = False,
    hold: bool = False,
    rounds: int = 1,
    grid: str = "ico:5",
    scale: bool = False,
    modes: int = 3,
    energy: str = "symmetric-dirichlet",
    threads: int = 0,
    progress: Progress = None,
) -> Group:
    """Brings shapes into correspondence: their mean, how they vary, how far they are apart.

    Parameters
    ----------
    shapes
        Maps, which are moved.
    template
        What all are brought to first; ``None``: the first of them.
    start
        Where the way to it begins. ``"ends"``: ends of what sticks out are paired, as :func:`match` does it without
        landmarks; where there are not three of them on both, the maps are turned as it does it then (``"turn"`` in
        :attr:`Group.starts`); with ``hold`` it is ``"rotation"``: maps turned until they look alike.
        ``"ellipsoid"``: first-order ellipsoids turned alike. ``"maps"``: as they lie.
    alike
        The shapes lie alike in space: ends and rotations are also judged by where places are.
    mirror
        Shapes may be mirror images, as right hands among left ones: each is taken as its own mirror image where that
        fits the template clearly better; :attr:`Group.mirrored` tells which.
    hold
        Maps are only turned, or stay; else the distortion of shape → template is minimised.
    rounds
        So often all are then brought to their mean.
    grid
        Of triangles, or ``"template"``: its own.
    scale
        Bring all to one size: the mean of ``sizes``.
    modes
        At most so many are kept.
    energy
        What is minimised: ``"symmetric-dirichlet"`` or ``"angle-and-area"``, as of :func:`match`.

    Warnings tell what is to be looked at, with the number of the shape. :meth:`Group.landmarks` finds vertices of
    the template on all shapes.
    """
    maps = [mapped_of(shape, f"shapes[{i}]") for i, shape in enumerate(_arrays.listed(shapes, "shapes", "maps"))]
    if not maps:
        raise ValueError("shapes: there is none")
    reference = maps[0] if template is None else mapped_of(template, "template")
    options = {
        "start": _arrays.text(start, "start"),
        "alike": _arrays.flag(alike, "alike"),
        "mirror": _arrays.flag(mirror, "mirror"),
        "hold": _arrays.flag(hold, "hold"),
        "rounds": _arrays.whole(rounds, "rounds", 0, 20),
        "grid": _arrays.text(grid, "grid"),
        "scale": _arrays.flag(scale, "scale"),
        "modes": _arrays.whole(modes, "modes", 0, 100),
        "energy": _arrays.text(energy, "energy"),
        "threads": _arrays.threads(threads),
    }
    with told(progress) as report:
        found = _core.group(maps, reference, options, report)
    for i, shape in enumerate(found["shapes"]):
        tell([f"shapes[{i}]: {warning}" for warning in shape["warnings"]])
    return Group(found)


document(globals())
