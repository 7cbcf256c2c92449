"""Figures of meshes and maps, as named tuples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, NamedTuple, Optional, Tuple

from ._attributes import document
from ._errors import Defect

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Ints = npt.NDArray[np.int32]
    Floats = npt.NDArray[np.float64]


class Certificate(NamedTuple):
    """What was proved of a map with exact signs, and where the proof fails."""

    one_to_one: bool
    """The one question: does every point of the sphere have exactly one point of the surface?"""
    verdict: str
    """``"one-to-one"``, ``"folded 3"``, ``"degree 2"``, ``"unusable points 1"``; of a file also ``"theta and phi
    off 2"``: of two vertices they are not those of sx sy sz."""
    degree: int
    """Triangles that a generic ray meets; counted when nothing is folded."""
    covering: float
    """Sum of the solid angles over 4π, in floating point."""
    reversed: bool
    """Every triangle is negative: the sphere is seen from inside."""
    folded: Ints
    """(k,) faces that are turned over."""
    degenerate: Ints
    """(k,) faces that are flat."""
    unusable_points: Ints
    """(k,) vertices whose ray is zero or not finite."""
    branch_vertices: Ints
    """(k,) vertices whose triangles wind more than once about them."""
    max_length_error: float
    """Largest | |ray| − 1 |."""


class Distortion(NamedTuple):
    """How a map distorts. Ratios of areas and angles are sphere over surface, ``stretch_*`` surface
    over sphere, the surface first scaled to the area of the whole sphere; 1 is perfect. Faces without
    area, and fillers of kept holes, are left out."""

    mean_abs_ln_area: float
    """Mean of |ln area ratio| over the triangles (the paper's measure)."""
    mean_abs_ln_angle: float
    """Mean of |ln angle ratio| over the corners (the paper's measure)."""
    area_within_two: float
    """Share of triangles whose area ratio is from 1/2 to 2."""
    area_ratio_p01: float
    """The first percentile of the area ratios."""
    area_ratio_p50: float
    """Their median."""
    area_ratio_p99: float
    """Their 99th percentile."""
    area_ratio_min: float
    """The least area ratio."""
    area_ratio_max: float
    """The greatest area ratio."""
    angle_ratio_max: float
    """The greatest of max(ratio, 1/ratio) of the angles."""
    weighted_abs_log2_area: float
    """Mean of |log2 area ratio|, weighted by the area of the surface."""
    symmetric_dirichlet: float
    """Symmetric Dirichlet energy, weighted by area; 4 is isometry."""
    quasi_conformal_mean: float
    """Mean of the larger over the smaller singular value, weighted by area; 1 is conformal."""
    quasi_conformal_max: float
    """Its maximum."""
    stretch_l2: float
    """L2 stretch of Sander et al. (2001)."""
    stretch_linf: float
    """L-infinity stretch: the largest 1/σ_min."""
    flat_images: int
    """Triangles too thin on the sphere for an angle, which the mean of angles leaves out."""
    flat_faces: int
    """Triangles of the surface without area, which all figures leave out."""


class FaceDistortion(NamedTuple):
    """Distortion face by face: see :class:`Distortion`. NaN of fillers, and ratios of faces without
    area."""

    area_ratio: Floats
    """(F,) share of the sphere over share of the surface; 1 is perfect."""
    angle_ratio: Floats
    """(F, 3) corner by corner, the angle on the sphere over that of the surface: less than 1 or more."""
    sigma_max: Floats
    """(F,) larger singular value of the map, the surface scaled to the area of the sphere."""
    sigma_min: Floats
    """(F,) smaller singular value."""
    source_area: Floats
    """(F,) share of the total area of the surface, which sum to 1; 0: the face has none."""


class Stage(NamedTuple):
    """What one stage of a map did."""

    name: str
    """``"relaxation"``, ``"certificate"`` and so on."""
    seconds: float
    """Wall time."""
    folds: int
    """Triangles that are not positive after it; −1: not counted."""
    distortion: Optional[Distortion]
    """After it, with ``measure_stages``; else None."""


class Radial(NamedTuple):
    """How a map of ``method="radial"`` differs from the directions from its centre."""

    centre: Tuple[float, float, float]
    """In the mesh's coordinates."""
    folds: int
    """Triangles of the surface that are not positive in these directions; 0: θ and φ are planetocentric, exactly."""
    folded_area: float
    """Their share of the area."""
    moved: float
    """Share of the vertices that the map has elsewhere."""
    largest_movement: float
    """Of a vertex, in radians."""


class Body(NamedTuple):
    """What a closed surface encloses, as a body of density 1 in units of the mesh."""

    centroid: Tuple[float, float, float]
    """Its centre of mass."""
    inertia: Tuple[Tuple[float, float, float], ...]
    """The tensor about the centroid, along the mesh's axes: ∫ (|r|² − r rᵀ) dV, three rows."""
    principal_moments: Tuple[float, float, float]
    """Its eigenvalues, ascending."""
    principal_axes: Tuple[Tuple[float, float, float], ...]
    """A row a principal axis, right-handed; the long one of the body first."""
    extents: Tuple[float, float, float]
    """How far the surface reaches along each of them: length, width and thickness."""


class Inspection(NamedTuple):
    """What a mesh is, and everything that is wrong with it."""

    vertices: int
    """Number of vertices."""
    used_vertices: int
    """Number of vertices that faces use."""
    edges: int
    """Number of edges."""
    faces: int
    """Number of faces."""
    components: int
    """Number of connected components."""
    boundary_loops: int
    """Number of loops of boundary edges."""
    euler_characteristic: int
    """V − E + F of what is used."""
    genus: int
    """Of the one component; −1 where it has no meaning."""
    area: float
    """In squared units of the mesh."""
    volume: float
    """In cubed units; positive when faces are counter-clockwise from outside."""
    lower: Tuple[float, float, float]
    """Least coordinates."""
    upper: Tuple[float, float, float]
    """Greatest coordinates."""
    is_sphere: bool
    """True for a closed genus-0 manifold: a map to the sphere exists."""
    defects: Tuple[Defect, ...]
    """All defects, fatal ones first."""
    body: Optional[Body]
    """Centroid, inertia and axes; None of what is open, or encloses next to nothing."""


class Action(NamedTuple):
    """One kind of thing that repair did."""

    kind: str
    """``"hole-filled"``, ``"handle-cut"`` and so on."""
    times: int
    """How many times."""
    ids: Tuple[int, ...]
    """The first places by their numbers in the mesh that was given; −1: not of it."""
    message: str
    """For people."""


class HandleLoop(NamedTuple):
    """A loop that the surface was cut along, to be rid of a handle."""

    filled: bool
    """Closed through air (what goes through the handle); else the handle is cut through."""
    length: float
    """In units of the mesh."""
    share: float
    """The same in diagonals of the bounding box of its part."""
    area_added: float
    """Of both caps."""
    points: Floats
    """(k, 3) in order."""


class Deviation(NamedTuple):
    """How far the points of a surface are from a closed one, less than 0 inside of it, in units of the mesh."""

    min: float
    """The least: farthest inside, of all points that were looked at."""
    max: float
    """The greatest: farthest outside."""
    mean: float
    """Of the samples."""
    sd: float
    """Their standard deviation."""
    median: float
    """Theirs."""
    at_vertices: Optional[Floats]
    """(V,) of every vertex; None without ``extremes``."""


class OneSided(NamedTuple):
    """How far the points of one surface are from another one, in units of the mesh."""

    rms: float
    """Root mean square."""
    mean: float
    """Mean."""
    max: float
    """Of any point that was looked at."""
    max_bound: float
    """No point is farther; infinite without ``extremes`` and with ``leave_out_border``."""
    min: float
    """Of all points that were looked at."""
    samples: int
    """How many points mean and rms are of."""
    farthest: Tuple[float, float, float]
    """The point at ``max``."""
    sd: float
    """Standard deviation of the samples."""
    median: float
    """Of the samples."""
    p95: float
    """No more than so far are 95 of 100 samples."""
    p99: float
    """No more than so far are 99 of 100."""
    within: Optional[float]
    """The share of the samples that is no farther than ``within``; None where that was not asked for."""
    at_vertices: Optional[Floats] = None
    """(V,) the distance of every vertex, also of those that no face uses; None without ``extremes``."""
    deviation: Optional[Deviation] = None
    """The same distances with their side, with ``signed`` and from the first to the second; else None."""
    left_out: Optional[float] = None
    """The share of the samples that ``leave_out_border`` left out; None without it."""
    left_out_vertices: Optional[npt.NDArray[np.bool_]] = None
    """(V,) True of vertices that it left out; ``at_vertices`` has the distance of these too. None without it or without ``extremes``."""


class Alignment(NamedTuple):
    """How the second surface was put onto the first."""

    matrix: Floats
    """(4, 4): takes (x, y, z, 1), a column, of the second, after ``upright``, there; ``vertices @ matrix[:3, :3].T + matrix[:3, 3]``."""
    scale: float
    """1 where none was sought."""
    start: str
    """From where it came there: ``"as they are"``, ``"centroids"`` or ``"principal axes"``."""
    rms: float
    """Of the distances of the samples that are kept."""
    kept: float
    """The share of the samples of both that are no farther than ``reach``; others are what one surface lacks."""
    reach: float
    """In units of the first."""
    iterations: int
    """How many steps it took from there."""


class Distance(NamedTuple):
    """How far two surfaces are apart, both ways, in units of the mesh."""

    rms: float
    """Root mean square, the larger of both ways."""
    mean: float
    """Mean, the larger of both ways."""
    max: float
    """Largest distance found; the Hausdorff distance is from it to ``max_bound``."""
    max_bound: float
    """No point is farther."""
    p95: float
    """The larger of both ways: HD95."""
    diagonal: float
    """Of the first surface's bounding box: what to hold distances against."""
    forth: OneSided
    """From the first to the second."""
    back: OneSided
    """From the second to the first."""
    alignment: Optional[Alignment] = None
    """How the second was put onto the first before, with ``align``; else None."""


def one_sided(found: Dict[str, Any]) -> OneSided:
    """What the library tells of one way."""
    deviation = found.pop("deviation")
    return OneSided(**found, deviation=None if deviation is None else Deviation(*deviation))


class Landmarks(NamedTuple):
    """Where k places of a template are on the n shapes of a group."""

    points: Floats
    """(n, k, 3) places on the surfaces, in the coordinates of each shape."""
    faces: Ints
    """(n, k) the faces that they lie in."""
    weights: Floats
    """(n, k, 3) barycentric weights of the corners of these."""
    nearest: Ints
    """(n, k) of all vertices of each shape that which is nearest in space; it need not be a corner of the face."""


class GroupScalar(NamedTuple):
    """What the vertices of shapes have under one name, on the grid of a group."""

    name: str
    """What it is called."""
    shapes: Ints
    """(k,) the shapes that have it, by their places in the group; two at least."""
    mean: Floats
    """(V,) of these."""
    deviation: Floats
    """(V,) standard deviation of these."""


class BakedFile(NamedTuple):
    """An image file that was baked."""

    field: str
    """What it shows."""
    about: str
    """Unit, space, convention."""
    path: str
    """Where it is."""
    sample_type: str
    """``"uint8"``, ``"uint16"``, ``"half"`` or ``"float"``."""
    channels: int
    """1, 3 or 4."""
    range: Optional[Tuple[float, float]]
    """What 0 and 1 of integers stand for, where that is not fixed; None of files of floats."""
    sidecar: str
    """The file beside it that tells GIS programs where it lies; empty: none."""
    beyond: Optional[float] = 0
    """The share of the texels whose values lie beyond ``range``, and end there; None where ``heat`` shows them."""


class Displacement(NamedTuple):
    """What a fitted surface lacks, as it was written."""

    least: float
    """The least displacement, in units of the mesh."""
    greatest: float
    """The greatest."""
    missed: int
    """Texels whose normal meets no surface near by."""
    size: Tuple[int, int]
    """Width and height of the image."""
    scale: float
    """Height is (value in the file - midlevel) * scale; of integers the value is from 0 to 1 …"""
    midlevel: float
    """… and this is the value where it is 0."""
    levels: Optional[int]
    """In the layout of a grid: of how many levels of subdivision each vertex has its own texel."""
    base_rms: Optional[float]
    """RMS distance of the fitted surface alone from the mesh, where a mesh was rebuilt."""
    rebuilt_rms: Optional[float]
    """RMS distance of surface and image together."""


class SelfCrossings(NamedTuple):
    """Where a surface crosses itself in space."""

    pairs: int
    """Number of pairs of faces that cross; 0 is a proof that none do."""
    marks: npt.NDArray[np.bool_]
    """(F,) True where a face crosses another."""
    first: Optional[Tuple[int, int]]
    """The first face that does, and the first that it crosses; None without any."""
    place: Optional[Tuple[float, float, float]]
    """Where these two are."""


class InSpace(NamedTuple):
    """How the flat faces of a remesh lie in space, of which the proof of its map says nothing."""

    triangles: int
    """Faces that cross others or are turned over."""
    area_share: float
    """Of the area, what these have."""
    turned_over: int
    """Faces that look the other way than the surface and what lies about them."""
    concave_quads: int
    """Of ``cube:N`` and other quads: those with a negative Jacobian at a corner."""
    crossings: int
    """Pairs of faces that cross; :func:`self_crossings` says which."""
    all_looked_at: bool
    """False where too many faces are near one another: there may be more pairs."""
    crossings_of_mesh: int
    """Pairs of faces of the mesh itself that cross, counted where those of the remesh do."""


document(globals())
