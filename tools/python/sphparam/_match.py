"""One surface onto another, through the sphere."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Tuple, Union

from . import _arrays, _core
from ._attributes import document
from ._figures import Distortion
from ._losses import tell
from ._map_facts import mapped_of
from ._mesh import Path, path_of
from ._numpy import np
from ._progress import Progress, told
from ._sphere_map import SphereMap
from ._up import Direction, as_direction

if TYPE_CHECKING:
    from ._map_facts import Array, Floats, Ints


class SurfaceMap:
    """A map from one surface onto another that is proved one-to-one: both are, onto the same sphere.

    :func:`match` makes it.
    """

    __slots__ = ("source", "target", "energy", "made_by", "residuals", "confidence", "agreement")

    source: SphereMap
    """The first surface, with its points moved; ``save`` keeps it."""
    target: SphereMap
    """The second surface and its map, as they were."""
    energy: float
    """Of the map between the surfaces, a unit of area, as it was minimised; of symmetric Dirichlet isometry has
    2."""
    made_by: str
    """Where the least energy came from: ``"coarse to fine"``, ``"own map"`` or ``"features"``."""
    residuals: Floats
    """Radians of the landmarks from their partners; 0 is exactly there."""
    confidence: float
    """In landmarks that were searched for, or the turn that features begin with: 0 where others fit as well, up
    to 1; 1 of landmarks that were given."""
    agreement: float
    """Correlation of the features by the map, the mean over columns; 0 without features."""

    def __init__(
        self,
        source: SphereMap,
        target: SphereMap,
        energy: float,
        made_by: str,
        residuals: Floats,
        confidence: float = 1.0,
        agreement: float = 0.0,
    ) -> None:
        self.source, self.target, self.energy = source, target, energy
        self.made_by, self.residuals, self.confidence = made_by, residuals, confidence
        self.agreement = agreement

    def forth(self, *, threads: int = 0) -> Tuple[Ints, Floats]:
        """For every vertex of the source its point on the target: (V,) faces, (V, 3) barycentric weights."""
        return self.target.locate(self.source.points, threads=threads)

    def back(self, *, threads: int = 0) -> Tuple[Ints, Floats]:
        """For every vertex of the target its point on the source, as :meth:`forth`."""
        return self.source.locate(self.target.points, threads=threads)

    def carry(self, values: Any, *, threads: int = 0) -> Array:
        """Values of the target's vertices at those of the source, as :meth:`SphereMap.resample` takes them.

        ``values``: (V,) or (V, k), or a name; ``"vertices"`` gives the source's triangles the target's shape.
        """
        return self.target.resample(values, self.source.points, threads=threads)

    def carry_back(self, values: Any, *, threads: int = 0) -> Array:
        """Values of the source's vertices at those of the target, as :meth:`carry`: ``values`` of the source."""
        return self.source.resample(values, self.target.points, threads=threads)

    def distortion(self, *, threads: int = 0) -> Distortion:
        """How the map distorts the source's triangles; their images are the flat triangles of their corners."""
        found = _core.matched_distortion(self.source._mapped, self.target._mapped, _arrays.threads(threads))
        return Distortion(**found)

    def morph(
        self,
        path: Path,
        *,
        place: str = "scaled",
        up: Optional[Direction] = None,
        front: Optional[Direction] = None,
        image_size: int = 2048,
        threads: int = 0,
        progress: Progress = None,
    ) -> None:
        """Writes a ``.glb`` of the source with an animation that turns it into the target and back.

        Parameters
        ----------
        place
            How the target comes to where the source is: ``"scaled"``: turned, moved and scaled to its area;
            ``"moved"``: without scaling; ``"as-is"``.
        up, front
            What points up and what looks at us in the source, as of :meth:`SphereMap.export`.
        image_size
            Of images that are made here, as the checker of surfaces without colours.
        """
        name, size = path_of(path), _arrays.whole(image_size, "image_size", 16, 16384)
        if not name.lower().endswith(".glb"):
            raise ValueError(f"path: a morph ends in .glb, not {name!r}")
        options = {
            "place": _arrays.text(place, "place"),
            "up": as_direction(up, "up"),
            "front": as_direction(front, "front"),
            "image_size": size,
            "threads": _arrays.threads(threads),
        }
        with told(progress) as report:
            warned = _core.write_morph(self.source._mapped, self.target._mapped, name, options, report)
        tell(self.source._not_exported(name, False))
        tell(warned)

    def __repr__(self) -> str:
        return f"<sphparam.SurfaceMap: {self.source.name} → {self.target.name}, {len(self.residuals)} landmarks>"


_far = 0.02  # of the diagonal: a point may be of another mesh


def nearest_vertices(points: Any, of: SphereMap, name: str) -> List[int]:
    """Of each point (k, 3) the nearest vertex; a warning where one is far."""
    found, farthest = [], 0.0
    for point in _arrays.finite_points(points, name):
        squares = ((of.vertices - point) ** 2).sum(axis=1)
        found.append(int(np.argmin(squares)))
        farthest = max(farthest, float(np.sqrt(squares[found[-1]])))
    diagonal = float(np.linalg.norm(np.ptp(of.vertices, axis=0)))
    if farthest >= _far * diagonal:
        tell([f"{name}: a point is {farthest:.4g} away from the nearest vertex of {of.name}: is it in its coordinates?"])
    return found


def _pairs(landmarks: Any, source: SphereMap, target: SphereMap) -> List[Tuple[int, int]]:
    try:
        rows = np.asarray(landmarks)
    except ValueError:
        raise ValueError("landmarks: two vertices a row are needed, source and target, #×2") from None
    if rows.size == 0:
        return []
    if rows.ndim == 3 and rows.shape[1:] == (2, 3):
        firsts, seconds = (nearest_vertices(rows[:, i], of, "landmarks") for i, of in enumerate((source, target)))
        return list(zip(firsts, seconds))
    if rows.dtype.kind not in "iu":
        raise TypeError(f"landmarks: pairs of vertices are needed, whole numbers, not {rows.dtype}")
    if rows.ndim != 2 or rows.shape[1] != 2:
        shape = "×".join(str(n) for n in rows.shape)
        raise ValueError(f"landmarks: two vertices a row are needed, source and target, #×2, not {shape}")
    if rows.max() >= 2**31:
        raise ValueError(f"landmarks: no mesh has a vertex {rows.max()}")
    return [(int(a), int(b)) for a, b in rows.tolist()]


def _feature(values: Any, of: SphereMap, name: str) -> Floats:
    """Rows of numbers, one a vertex, from an array or the name of values."""
    rows = _arrays.numbers(of._named(values) if isinstance(values, str) else values, name).astype(float)
    if rows.ndim == 1:
        rows = rows[:, None]
    if rows.ndim != 2 or len(rows) != len(of.vertices):
        shape = "×".join(str(n) for n in rows.shape) or "a single number"
        raise ValueError(f"{name}: {len(of.vertices)} rows are needed, one a vertex, not {shape}")
    return rows


def _features(features: Any, source: SphereMap, target: SphereMap) -> Tuple[Floats, Floats]:
    """Of both, as many columns."""
    if not isinstance(features, (tuple, list)) or len(features) != 2:
        found = f"{len(features)} things" if isinstance(features, (tuple, list)) else type(features).__name__
        raise ValueError(f"features: a pair is needed, of the source and of the target, not {found}")
    one, other = _feature(features[0], source, "features[0]"), _feature(features[1], target, "features[1]")
    if one.shape[1] != other.shape[1]:
        raise ValueError(f"features: as many columns are needed of both, not {one.shape[1]} and {other.shape[1]}")
    return one, other


def match(
    source: SphereMap,
    target: SphereMap,
    landmarks: Union[Sequence[Tuple[int, int]], Any] = None,
    *,
    features: Optional[Tuple[Any, Any]] = None,
    feature_weight: float = 2.0,
    alike: bool = False,
    mirror: bool = False,
    energy: str = "symmetric-dirichlet",
    weight: float = 1.0,
    threads: int = 0,
    progress: Progress = None,
) -> SurfaceMap:
    """Maps one surface onto another, one-to-one, with the least distortion of the map between them.

    Parameters
    ----------
    source, target
        Maps: the points of the source on the sphere move, those of the target stay.
    landmarks
        (k, 2) vertices of the source and those of the target that they go to, exactly; none twice. Or (k, 2, 3)
        points of both, for the vertices nearest to them; one that is far from any is told. ``None``:
        the ends of what sticks out of both are paired, and a start is made from there; ``()``: from the map
        that the source has.
    features
        Numbers a vertex that are to agree, such as sulcal depth: of the source and of the target, each an array,
        (V,) or (V, k), or the name of values; NaN counts as the median. Without landmarks the source's map is turned so
        that they agree, to begin with.
    feature_weight
        Of their mean square difference, in spreads, against the energy, of which isometry has 2.
    alike
        Source and target lie alike in space: ends that are paired, and turns, are also judged by where
        places are, the first turn by features by that alone. For ``landmarks=None``.
    mirror
        Match the mirror image of the source, which is ``SurfaceMap.source`` then.
    energy
        ``"symmetric-dirichlet"``: stretch both ways; ``"angle-and-area"``: as of maps.
    weight
        Of area against angle, for ``"angle-and-area"``.

    Raises
    ------
    NotCertified
        where no map has the landmarks, or where they fit the mirror image far better.
    ValueError
        for landmarks that are no vertices, or one twice.

    Warnings tell where they fit the mirror image about as well or better, where other ends would, and what
    shrinks to nothing: look at the result.
    """
    first, second = mapped_of(source, "source"), mapped_of(target, "target")
    options = {"energy": _arrays.text(energy, "energy"), "lambda": _arrays.real(weight, "weight"), "threads": _arrays.threads(threads)}
    options["search"] = landmarks is None and features is None
    options["alike"] = _arrays.flag(alike, "alike")
    if alike and landmarks is not None:
        raise ValueError("alike: landmarks say already what lies where on both; leave one of the two out")
    pairs = [] if landmarks is None else _pairs(landmarks, source, target)
    agreeing, weighs = None, _arrays.real(feature_weight, "feature_weight")
    if not 0 < weighs < float("inf"):
        raise ValueError(f"feature_weight: more than 0 is needed, not {weighs}")
    if features is not None:
        agreeing = (*_features(features, source, target), weighs)
    with told(progress) as report:
        found = _core.match(first, second, pairs, agreeing, _arrays.flag(mirror, "mirror"), options, report)
    moved, least, made_by, residuals, confidence, agreement, warnings = found
    tell(warnings)
    return SurfaceMap(SphereMap._of(moved), target, least, made_by, residuals, confidence, agreement)


document(globals())
