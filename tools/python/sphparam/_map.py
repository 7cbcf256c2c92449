"""Maps of meshes onto the sphere, and what they are good for."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, TypeVar, Union

from . import _arrays, _core
from ._errors import LossWarning
from ._figures import Action, BakedFile, Certificate, Distortion, FaceDistortion, HandleLoop, Stage
from ._mesh import Mesh, Path, _any_mesh, _numbers, existing, path_of, repair_options
from ._numpy import np
from ._progress import Progress, told

if TYPE_CHECKING:
    import numpy
    import numpy.typing as npt

    from ._chart import Chart
    from ._harmonics import Harmonics
    from ._images import BakedImage, Image
    from ._subdivision import SubdivisionFit

    Array = npt.NDArray[Any]
    Floats = npt.NDArray[numpy.float64]
    Ints = npt.NDArray[numpy.int32]
    Bytes = npt.NDArray[numpy.uint8]

_T = TypeVar("_T")

remeshing_lambda = 5.0
"""The weight of area that spreads a grid's vertices best: ``map(mesh, weight=…)`` before ``remesh``."""


class SphereMap:
    """A mesh with a map onto the unit sphere that is proved one-to-one. It never changes.

    :func:`map` makes it, :func:`load` reads it, :func:`with_sphere` takes the map of another program.
    A triangle maps to the geodesic triangle of its three points.
    """

    __slots__ = ("_mapped", "_found")

    _mapped: _core.Mapped
    _found: Dict[str, Any]

    def __init__(self) -> None:
        raise TypeError("sphparam.map(vertices, faces) makes maps, sphparam.load(path) reads them")

    @classmethod
    def _of(cls, mapped: _core.Mapped) -> SphereMap:
        made = cls.__new__(cls)
        made._mapped, made._found = mapped, {}
        return made

    def _once(self, name: str, make: Callable[[], _T]) -> _T:
        if name not in self._found:
            self._found[name] = make()
        found: _T = self._found[name]
        return found

    # What it is.

    @property
    def vertices(self) -> Floats:
        """(V, 3) positions on the surface, read-only."""
        return self._mapped.vertices

    @property
    def faces(self) -> Ints:
        """(F, 3) indices of vertices, read-only."""
        return self._mapped.faces

    @property
    def points(self) -> Floats:
        """(V, 3) unit vectors, where the vertices go on the sphere; read-only."""
        return self._mapped.points

    @property
    def theta(self) -> Floats:
        """(V,) longitude in radians, 0 to 2π."""
        return self._once("angles", lambda: _core.angles(self._mapped))[0]

    @property
    def phi(self) -> Floats:
        """(V,) polar angle in radians, 0 at +z to π at −z."""
        return self._once("angles", lambda: _core.angles(self._mapped))[1]

    @property
    def values(self) -> Dict[str, Array]:
        """What vertices carry: name to (V,) or (V, k), in its own type."""
        return self._once("values", lambda: _arrays.grouped(self._mapped.vertex_values()))

    @property
    def face_values(self) -> Dict[str, Array]:
        """What faces carry: name to (F,) or (F, k)."""
        return self._once("face_values", lambda: _arrays.grouped(self._mapped.face_values()))

    @property
    def polygons(self) -> Optional[List[Ints]]:
        """Faces as a grid has them, quads too, where ``faces`` are these cut; else None."""
        found = self._mapped.polygons
        return None if found is None else np.split(found[0], found[1][1:-1])

    @property
    def mesh(self) -> Mesh:
        """The mesh alone, a copy."""
        return Mesh._of(_core.source_of_mapped(self._mapped))

    @property
    def name(self) -> str:
        """The file or grid it comes from."""
        return self._mapped.name

    # What is known of the map.

    @property
    def certificate(self) -> Certificate:
        """What was proved of ``points``, with exact signs."""
        return self._once("certificate", lambda: Certificate(**self._mapped.certificate))

    @property
    def distortion(self) -> Distortion:
        """How the map distorts, in figures."""
        return self._measured()[0]

    @property
    def face_distortion(self) -> FaceDistortion:
        """How the map distorts, face by face."""
        return self._measured()[1]

    def _measured(self) -> Tuple[Distortion, FaceDistortion]:
        def measure() -> Tuple[Distortion, FaceDistortion]:
            found = _core.distortion(self._mapped, 0)
            return Distortion(**found.pop("summary")), FaceDistortion(**found)

        return self._once("distortion", measure)

    def _account(self) -> Dict[str, Any]:
        return self._once("account", lambda: self._mapped.account or {})

    @property
    def stages(self) -> Tuple[Stage, ...]:
        """What each stage of the map did, in their order; empty for maps that were read."""
        rows = self._account().get("stages", ())
        return tuple(Stage(n, s, f, Distortion(**d) if d else None) for n, s, f, d in rows)

    @property
    def seconds(self) -> float:
        """Wall time of the map in the library, its certificate included; 0 for maps that were read."""
        seconds: float = self._account().get("seconds", 0.0)
        return seconds

    @property
    def processor_seconds(self) -> float:
        """The same summed over all processors, and over all that this process did meanwhile."""
        seconds: float = self._account().get("processor_seconds", 0.0)
        return seconds

    @property
    def poles(self) -> Optional[Tuple[int, int]]:
        """The vertices at +z and −z by their numbers in the mesh that was given, or None."""
        return self._account().get("poles")

    @property
    def meridian(self) -> Optional[int]:
        """A vertex with θ = 0 that was asked for or chosen, or None."""
        return self._account().get("meridian")

    @property
    def pin_residuals(self) -> List[float]:
        """Radians of each pin from where it was wanted; 0: exactly there."""
        return self._account().get("pin_residuals", [])

    @property
    def energy_gap(self) -> Optional[float]:
        """An estimate of the share of its energy that more steps would take; None: not made."""
        return self._account().get("energy_gap")

    @property
    def warnings(self) -> List[str]:
        """What the library has to say of how the map came out."""
        return self._account().get("warnings", [])

    @property
    def provenance(self) -> Dict[str, str]:
        """How the map came about: version, method, stage, options, poles, verdict."""
        return dict(self._mapped.provenance)

    @property
    def notes(self) -> List[str]:
        """What was odd about the file, or done to the mesh."""
        return self._mapped.notes

    @property
    def repairs(self) -> Tuple[Action, ...]:
        """What ``repair`` did to the mesh before it was mapped."""
        return tuple(Action(*row) for row in self._mapped.repairs)

    @property
    def handles(self) -> Tuple[HandleLoop, ...]:
        """The loops that the mesh was cut along, to be rid of handles."""
        return tuple(HandleLoop(*row) for row in self._mapped.handles)

    @property
    def vertex_origin(self) -> Ints:
        """(V,) numbers of the vertices in the mesh or file that was given; −1: created."""
        found = dict(self._mapped.vertex_values()).get("source_vertex")
        return _numbers(len(self.vertices)) if found is None else found

    # Directions.

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
        labels: the one with the largest weight among the corners. NaN spreads to where it has weight.

        Parameters
        ----------
        values
            (V,) or (V, k), or the name of one of ``values``; ``"vertices"``: positions.
        directions
            (n, 3), finite, of any length but 0.
        """
        if isinstance(values, str):
            values = self.vertices if values == "vertices" else self._named(values)
        table = np.asarray(values)
        if table.dtype.kind not in "fiubc":
            raise TypeError(f"values: numbers are needed, not {table.dtype}")
        if table.ndim == 0 or len(table) != len(self.vertices):
            shape = "×".join(str(n) for n in table.shape) or "a single number"
            raise ValueError(f"values: {len(self.vertices)} rows are needed, one a vertex, not {shape}")
        face, weights = self.locate(directions, threads=threads)
        corners = self.faces[face]
        weights = weights.reshape(weights.shape + (1,) * (table.ndim - 1))
        if table.dtype.kind in "iub":
            return _heaviest(table[corners], weights)
        parts = np.where(weights == 0, 0, table[corners] * weights)
        mixed: Array = parts.sum(axis=1).astype(table.dtype, copy=False)
        return mixed

    def _named(self, name: str) -> Array:
        if name not in self.values:
            known = ", ".join(["vertices", *self.values])
            raise ValueError(f"values: the mesh has no {name!r}; it has {known}")
        return self.values[name]

    # Uses.

    def chart(self, *, keep_topology: bool = False, threads: int = 0, progress: Progress = None) -> Chart:
        """The mesh split for texture coordinates (u, v): every point of the rectangle has one owner.

        ``keep_topology``: no vertex is added; triangles fold at the poles then.
        """
        from ._chart import Chart

        with told(progress) as report:
            found = _core.chart(self._mapped, bool(keep_topology), _arrays.threads(threads), report)
        return Chart(self.vertices, self.faces, found)

    def bake(
        self,
        field: str,
        *,
        size: int = 2048,
        samples: int = 1,
        convention: str = "sphparam",
        interpolation: str = "uv",
        texture: Optional[Path] = None,
        filter: str = "bilinear",
        heat: bool = False,
        normal_y_down: bool = False,
        height_radial: bool = False,
        rays: int = 64,
        max_ray_distance: float = 0.1,
        target: Optional[SphereMap] = None,
        refine_poles: int = 1,
        threads: int = 0,
        progress: Progress = None,
    ) -> BakedImage:
        """A field of the surface as an equirectangular array: longitude right, north above.

        Parameters
        ----------
        field
            ``"normal-object"``, ``"position"``, ``"ao"``, ``"curvature:mean"``, ``"scalar:NAME"``, …:
            see :func:`fields`.
        size
            Texels a row, even, 2 to 65536; half as many rows.
        samples
            N: N × N a texel, 1 to 32.
        convention
            Where longitude goes: ``"sphparam"``, ``"three"``, ``"gis"``, ``"envmap"``, ``"blender"``.
        interpolation
            ``"uv"`` as a GPU does on the mesh's chart; ``"sphere"`` by direction.
        texture
            An image for the mesh's own texture coordinates, for ``"basecolor"``.
        filter
            How it is magnified: ``"nearest"``, ``"bilinear"``, ``"bicubic"``.
        heat
            Distortion and curvature as colours instead of numbers.
        normal_y_down
            ``"normal-tangent"`` for DirectX; else for OpenGL and glTF.
        height_radial
            Heights as distances from the origin; else along the target's normal.
        rays
            Of ``"ao"``, ``"bent"``, ``"thickness"``, a sample: 1 to 65536.
        max_ray_distance
            Of ``"ao"`` and ``"bent"``, in diagonals of the bounding box.
        target
            The mesh that the image is for, on the same sphere: a map that :meth:`remesh` made.
        refine_poles
            Triangles at a pole are cut into so many, as in :meth:`export`.

        Returns
        -------
        BakedImage
            (size / 2, size, channels) float32: unit vectors, linear light, numbers of labels, or units
            of the mesh; ``about`` says which.
        """
        from ._images import BakedImage

        options = _baking(locals())
        with told(progress) as report:
            [(name, about, table)] = _core.bake_to_arrays(self._mapped, [_text(field, "field")], options, report)
        return BakedImage._of(table, name, about)

    def bake_files(
        self,
        images: Mapping[str, Path],
        *,
        size: int = 2048,
        samples: int = 1,
        convention: str = "sphparam",
        interpolation: str = "uv",
        depth: Optional[str] = None,
        mip: bool = False,
        texture: Optional[Path] = None,
        filter: str = "bilinear",
        heat: bool = False,
        normal_y_down: bool = False,
        height_radial: bool = False,
        rays: int = 64,
        max_ray_distance: float = 0.1,
        target: Optional[SphereMap] = None,
        refine_poles: int = 1,
        threads: int = 0,
        progress: Progress = None,
    ) -> Tuple[BakedFile, ...]:
        """Bakes fields into image files, all of them or none.

        ``images`` is field to path, a ``.png``, ``.jpg``, ``.tif`` or ``.exr``. ``depth``: ``"uint8"``,
        ``"uint16"``, ``"half"``, ``"float"``, as the format has them. ``mip``: tiles and all levels, EXR
        only. The others are those of :meth:`bake`.
        """
        options = _baking(locals())
        pairs = [(_text(name, "images"), path_of(path)) for name, path in dict(images).items()]
        with told(progress) as report:
            *rows, warned = _core.bake_to_files(self._mapped, pairs, options, report)
        _warn(warned)
        return tuple(BakedFile(*row) for row in rows)

    def paint(
        self, image: Image, *, convention: str = "sphparam", threads: int = 0, progress: Progress = None
    ) -> Bytes:
        """An equirectangular image as colours of the vertices, (V, 3) or (V, 4), 0 to 255.

        ``image`` is a file, or an array as :meth:`export` takes it; ``convention`` as in :meth:`bake`.
        """
        from ._images import as_file

        with as_file(image, "image") as path, told(progress) as report:
            return _core.paint(self._mapped, path, convention, _arrays.threads(threads), report)

    def paint_texture(
        self,
        image: Image,
        *,
        size: int = 2048,
        padding: int = 16,
        convention: str = "sphparam",
        threads: int = 0,
        progress: Progress = None,
    ) -> Bytes:
        """An equirectangular image as a texture for the mesh's own coordinates, (size, size, 4).

        Colours run on over the borders of charts by ``padding`` texels, 0 to 254. ``convention`` and
        ``image`` are those of :meth:`paint`, ``size`` is of each side.
        """
        from ._images import as_bytes, as_file

        with as_file(image, "image") as path, told(progress) as report:
            table, warned = _core.paint_texture(
                self._mapped, path, convention, size, padding, _arrays.threads(threads), report
            )
        _warn([warned] if warned else [])
        return as_bytes(table)

    def remesh(
        self,
        grid: Union[str, SphereMap],
        *,
        sample: str = "point",
        transfer: Union[str, Iterable[str]] = "all",
        adaptive: bool = False,
        threads: int = 0,
        progress: Progress = None,
    ) -> SphereMap:
        """The surface on a grid of the sphere, whose directions are the map of the result.

        Parameters
        ----------
        grid
            ``"ico:6"``, ``"ico:f=40"``, ``"octa:257"``, ``"cube:32"``, ``"uv:512x256"``,
            ``"healpix:64"``; or another map, whose connectivity the result gets.
        sample
            ``"point"``: the surface at the direction; ``"cell"``: its mean over the cell.
        transfer
            What to carry: ``"all"``, or names of values; ``[]``: positions alone.
        adaptive
            More vertices where the surface bends.
        """
        names = [transfer] if isinstance(transfer, str) else [_text(n, "transfer") for n in transfer]
        with told(progress) as report:
            made = _core.remesh(
                self._mapped, _grid(grid), sample, names, bool(adaptive), _arrays.threads(threads), report
            )
        return SphereMap._of(made)

    def levels(self, count: int, *, threads: int = 0, progress: Progress = None) -> List[SphereMap]:
        """Levels of detail on icosahedra, the first with a quarter of the vertices, and so on."""
        with told(progress) as report:
            made = _core.levels(self._mapped, count, _arrays.threads(threads), report)
        return [SphereMap._of(level) for level in made]

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

        names = [transfer] if isinstance(transfer, str) else [_text(n, "transfer") for n in transfer]
        with told(progress) as report:
            made = _core.fit(self._mapped, _grid(grid), scheme, names, _arrays.threads(threads), report)
        return SubdivisionFit._of(made)

    def spharm(
        self,
        degree: int = 20,
        *,
        values: Sequence[str] = (),
        least_squares: bool = True,
        threads: int = 0,
        progress: Progress = None,
    ) -> Harmonics:
        """The surface as a sum of spherical harmonics up to a degree, 0 to 1000.

        ``values``: names of what vertices carry, expanded too. ``least_squares``: at the vertices;
        else by quadrature.
        """
        from ._harmonics import Harmonics

        names = [_text(n, "values") for n in ([values] if isinstance(values, str) else values)]
        with told(progress) as report:
            found = _core.expand(
                self._mapped, degree, names, bool(least_squares), _arrays.threads(threads), report
            )
        return Harmonics(found)

    # Files.

    def save(self, path: Path, *, threads: int = 0) -> None:
        """Writes mesh and map as ``.sph.ply``, proved as read back; other formats take the mesh alone.

        All of it or nothing. Raises :class:`WriteError`.
        """
        _core.save(self._mapped, path_of(path), _arrays.threads(threads))

    def save_sphere(self, path: Path, *, threads: int = 0) -> None:
        """Writes the bare sphere: ``.ply``, ``.obj``, ``.off``, or ``.gii`` of radius 100 in floats."""
        _core.save_sphere(self._mapped, path_of(path), _arrays.threads(threads))

    def export(
        self,
        path: Path,
        *,
        texture: Optional[Image] = None,
        normal_map: Optional[Image] = None,
        occlusion_map: Optional[Image] = None,
        images: Optional[Path] = None,
        variants: Sequence[str] = (),
        image_size: int = 2048,
        unlit: bool = False,
        tangents: bool = False,
        name: str = "",
        convention: str = "sphparam",
        refine_poles: int = 1,
        keep_topology: bool = False,
        shape: str = "mesh",
        morph: str = "none",
        up: Optional[str] = None,
        theta_phi: bool = False,
        source_uv: bool = False,
        quantise: bool = False,
        compress: bool = False,
        embedded: bool = False,
        levels: Sequence[SphereMap] = (),
        threads: int = 0,
        progress: Progress = None,
    ) -> List[str]:
        """Writes the mesh with spherical texture coordinates: ``.glb``, ``.gltf``, ``.obj``, ``.ply``.

        Parameters
        ----------
        texture, normal_map, occlusion_map
            Equirectangular images: files, or arrays (H, W, 3 or 4), uint8 or floats from 0 to 1, in
            sRGB; or what :meth:`bake` made, which is turned into colours.
        images
            A folder of the program's ``bake``: its base colour, normal map and occlusion.
        variants
            More materials to switch to: ``"axes"``, ``"checker"``, ``"graticule"``, ``"area"``,
            ``"angle"``.
        image_size
            Of images that are made here; 16 to 16384, a multiple of 4.
        unlit, tangents
            The colours without light; tangents also without a normal map.
        name
            Of the asset; empty: that of the mesh.
        convention
            Where longitude goes in the images.
        refine_poles, keep_topology
            Each triangle at a pole is cut into so many; no vertex is added at all.
        shape
            ``"mesh"``, its ``"sphere"``, or the ``"flat"`` rectangle.
        morph
            What an animation turns the mesh into: ``"none"``, ``"sphere"``, ``"flat"``.
        up
            ``"z"`` or ``"y"``; None: as its file says, else z.
        theta_phi, source_uv
            The angles as an attribute; the mesh's own texture coordinates as a second set.
        quantise, compress, embedded
            16-bit numbers; meshopt compression; a ``.gltf`` in one file.
        levels
            Levels of detail on the same sphere, in the same file.

        Returns
        -------
        list of str
            The files that were written, all or none.
        """
        from ._images import as_file

        if up not in (None, "y", "z"):
            raise ValueError(f"up: 'y', 'z' or None, not {up!r}")
        given = dict(locals())
        options = {name: given[name] for name in _export_options}
        options.update(
            up=up or "",
            images=path_of(images) if images is not None else "",
            variants=[_text(v, "variants") for v in ([variants] if isinstance(variants, str) else variants)],
            levels=[_mapped(level, "levels") for level in levels],
            threads=_arrays.threads(threads),
        )
        # .obj and .ply keep a copy of the image, .gltf and .glb hold it: the file made here may go.
        with as_file(texture, "texture") as options["texture"]:
            with as_file(normal_map, "normal_map") as options["normal_map"]:
                with as_file(occlusion_map, "occlusion_map") as options["occlusion_map"]:
                    with told(progress) as report:
                        files, warned = _core.export(self._mapped, path_of(path), options, report)
        _warn(warned)
        return [file for file, _ in files]

    # Looking at it.

    def picture(
        self,
        *,
        view: str = "both",
        colours: str = "own",
        size: int = 800,
        eye: Optional[Tuple[float, float, float]] = None,
        up: Optional[str] = None,
        wireframe: bool = False,
        graticule: bool = False,
        occlusion: bool = False,
        legend: bool = True,
        threads: int = 0,
    ) -> bytes:
        """A picture of the mesh and its sphere, as the bytes of a PNG.

        ``view``: ``"mesh"``, ``"sphere"``, ``"both"``. ``colours``: ``"own"``, ``"plain"``,
        ``"normals"``, ``"checker"``, ``"area"``, ``"angle"``. ``size``: pixels, 16 to 16384. ``eye``:
        the direction to look from; ``up``: ``"z"`` or ``"y"``, else as the file says. ``wireframe``,
        ``graticule``: lines; ``occlusion``: darker where little light comes; ``legend``: below colours
        that are numbers.
        """
        if up not in (None, "y", "z"):
            raise ValueError(f"up: 'y', 'z' or None, not {up!r}")
        options: Dict[str, Any] = dict(
            view=view, colours=colours, size=size, up=up or "", wireframe=wireframe, graticule=graticule,
            occlusion=occlusion, legend=legend, threads=_arrays.threads(threads),
        )  # fmt: skip
        if eye is not None:
            options["eye"] = tuple(float(x) for x in eye)
        return _core.draw(self._mapped, options)

    def report(
        self,
        path: Path,
        *,
        size: int = 1024,
        up: Optional[str] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> None:
        """Writes one page of HTML that shows the map: models or pictures, heat maps, charts, tables.

        ``size``: pixels of textures and pictures, 64 to 8192; ``up``: ``"z"`` or ``"y"``, else as the
        file says.
        """
        with told(progress) as report:
            _core.report(self._mapped, path_of(path), size, up or "", _arrays.threads(threads), report)

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


_baking_options = (
    "size", "samples", "convention", "interpolation", "depth", "mip", "filter", "heat", "normal_y_down",
    "height_radial", "rays", "max_ray_distance", "refine_poles", "threads",
)  # fmt: skip
_export_options = (
    "variants", "image_size", "unlit", "tangents", "name", "convention", "refine_poles", "keep_topology",
    "shape", "morph", "theta_phi", "source_uv", "quantise", "compress", "embedded",
)  # fmt: skip


def _baking(given: Dict[str, Any]) -> Dict[str, Any]:
    """The settings of a bake, as `_core` takes them."""
    options = {name: given[name] for name in _baking_options if given.get(name) is not None}
    options["threads"] = _arrays.threads(given["threads"])
    if given["texture"] is not None:
        options["texture"] = existing(given["texture"])
    if given["target"] is not None:
        options["target"] = _mapped(given["target"], "target")
    return options


def _heaviest(labels: Array, weights: Array) -> Array:
    """Of three labels a row, (n, 3, …), the one whose weights add up to most; of equals the first."""
    votes = [(weights * (labels == labels[:, k : k + 1])).sum(axis=1) for k in range(3)]
    best = np.argmax(np.stack(votes, axis=1), axis=1)
    chosen: Array = np.take_along_axis(labels, best[:, None], axis=1)[:, 0]
    return chosen


def _text(thing: Any, name: str) -> str:
    if not isinstance(thing, str):
        raise TypeError(f"{name}: a text is needed, not {type(thing).__name__}")
    return thing


def _mapped(thing: Any, name: str) -> _core.Mapped:
    if not isinstance(thing, SphereMap):
        raise TypeError(f"{name}: a sphparam.SphereMap is needed, not {type(thing).__name__}")
    return thing._mapped


def _grid(grid: Any) -> Union[str, _core.Mapped]:
    return grid if isinstance(grid, str) else _mapped(grid, "grid")


def _warn(messages: Iterable[str]) -> None:
    for message in messages:
        warnings.warn(message, LossWarning, stacklevel=3)


def _pins(pins: Any) -> List[Tuple[float, float, float]]:
    """Vertex to (theta, phi), as rows."""
    rows = []
    for vertex, place in dict(pins).items():
        if not hasattr(vertex, "__index__") or isinstance(vertex, bool):
            raise TypeError(f"pins: a vertex is a whole number, not {vertex!r}")
        theta, phi = (float(x) for x in place)
        if not (np.isfinite(theta) and 0 <= phi <= np.pi):
            raise ValueError(f"pins[{vertex}]: theta is finite and phi from 0 to π, not {theta}, {phi}")
        rows.append((float(vertex), theta, phi))
    return rows


def _vertex_number(thing: Any, name: str) -> int:
    if not hasattr(thing, "__index__") or isinstance(thing, bool):
        raise TypeError(f"{name}: a vertex is a whole number, not {thing!r}")
    if not 0 <= int(thing) < 2**31:
        raise ValueError(f"{name}: no mesh has a vertex {int(thing)}")
    return int(thing)


def _requested(
    method: str,
    balance: Union[str, float],
    quality: str,
    energy: str,
    weight: Optional[float],
    poles: Any,
    meridian: Optional[int],
    pins: Any,
    repair_map: bool,
    measure_stages: bool,
    threads: int,
) -> Dict[str, Any]:
    """The options of a map, as `_core` takes them."""
    options: Dict[str, Any] = dict(
        method=_text(method, "method"), quality=_text(quality, "quality"), energy=_text(energy, "energy"),
        repair_map=repair_map, measure_stages=measure_stages, threads=_arrays.threads(threads),
    )  # fmt: skip
    if isinstance(balance, str):
        options["balance"] = balance
    else:
        options["lambda"] = float(balance)
    if weight is not None:
        options["lambda"] = float(weight)
    if isinstance(poles, str):
        if poles not in ("auto", "none"):
            raise ValueError(f"poles: 'auto', 'none' or two vertices, not {poles!r}")
        options["automatic_poles"] = poles == "auto"
    else:
        north, south = poles
        options["poles"] = (_vertex_number(north, "poles"), _vertex_number(south, "poles"))
    if meridian is not None:
        options["meridian"] = _vertex_number(meridian, "meridian")
    if pins:
        options["pins"] = _pins(pins)
    return options


def map(
    mesh: Any,
    faces: Any = None,
    *,
    values: Optional[Mapping[str, Any]] = None,
    repair: Union[bool, Mapping[str, Any]] = False,
    method: str = "progressive",
    balance: Union[str, float] = "balanced",
    weight: Optional[float] = None,
    quality: str = "normal",
    energy: str = "angle-and-area",
    poles: Union[str, Tuple[int, int]] = "auto",
    meridian: Optional[int] = None,
    pins: Optional[Mapping[int, Tuple[float, float]]] = None,
    repair_map: bool = False,
    measure_stages: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> SphereMap:
    """Maps a closed genus-0 mesh one-to-one onto the unit sphere, and proves it.

    Parameters
    ----------
    mesh, faces, values
        As :class:`Mesh` takes them: two arrays, or a mesh of trimesh, PyVista, VTK, meshio, nibabel or
        Open3D. Nothing is changed or welded: ``points[i]`` is where ``vertices[i]`` goes.
    repair
        True, or a dict of arguments of :func:`repair`: the mesh is mended first. Then vertices have
        other numbers, see ``vertex_origin``.
    method
        ``"progressive"``; ``"curvilinear"``, the paper made sound; ``"paper"``, as printed, which folds;
        ``"radial"``, directions from the origin: planetocentric where the body is star-shaped.
    balance
        ``"balanced"``, ``"conformal"``, ``"equal-area"``, or a number: the weight of area against angle.
    weight
        That weight, 1e-10 to 1e6.
    quality
        ``"draft"``, ``"normal"``, ``"best"``: time against distortion.
    energy
        ``"angle-and-area"`` or ``"symmetric-dirichlet"``.
    poles
        ``"auto"``, ``"none"``, or the vertices that go to +z and −z.
    meridian
        The vertex that gets θ = 0.
    pins
        Vertex to (θ, φ) in radians: to be exactly there.
    repair_map
        Untangle what ``method="paper"`` folds.
    measure_stages
        Folds and distortion after every stage, in ``stages``.
    threads
        0 for all cores; the result does not depend on it.
    progress
        Called with stage and fraction in your thread, some times a second; return False to stop.
        None: a bar on terminals and in notebooks.

    Raises
    ------
    MeshError
        for what is no closed genus-0 manifold, with all defects and what repair would do.
    NotCertified
        where the map is not one-to-one, or poles, pins or meridian are not where they were wanted.
    Cancelled, KeyboardInterrupt
        within a tenth of a second.
    """
    options = _requested(
        method, balance, quality, energy, weight, poles, meridian, pins, repair_map, measure_stages, threads
    )
    mending = repair_options(repair)
    found = _any_mesh(mesh, faces, values)
    with told(progress) as report:
        if mending is not None:
            found = Mesh._of(_core.repair(found._source, mending, report))
        found._require_sound()
        mine = found is not mesh
        made = SphereMap._of(_core.map(found._source, mine, options, report))
    _warn(made.warnings)
    return made


def load(
    path: Path,
    sphere: Optional[Path] = None,
    *,
    balance: Union[str, float] = "balanced",
    quality: str = "normal",
    threads: int = 0,
    progress: Progress = None,
) -> SphereMap:
    """Reads a mesh and the map that it carries, and proves it; one is made where there is none.

    ``sphere``: the file with the sphere of the mesh, of the same connectivity (FreeSurfer, HCP).
    Raises :class:`ReadError`, :class:`MeshError`, :class:`NotCertified`.
    """
    options = _requested(
        "progressive", balance, quality, "angle-and-area", None, "auto", None, None, False, False, threads
    )
    other = existing(sphere) if sphere is not None else ""
    with told(progress) as report:
        return SphereMap._of(_core.load(existing(path), other, options, report))


def with_sphere(mesh: Any, points: Any, *, faces: Any = None, threads: int = 0) -> SphereMap:
    """A mesh with the map of another program, (V, 3) rays of any length but 0, once it is proved.

    Raises :class:`NotCertified` with the certificate where it is not one-to-one.
    """
    found = _any_mesh(mesh, faces)
    found._require_sound()
    rays = _arrays.finite_points(points, "points", len(found.vertices))
    return SphereMap._of(_core.with_points(found._source, rays, _arrays.threads(threads)))


def verify(mesh: Any, faces: Any = None, points: Any = None, *, threads: int = 0) -> Certificate:
    """Proves a map again, ours or anybody's; what is not one-to-one is a value, not an exception.

    ``verify(vertices, faces, points)``, ``verify(mesh, points=points)``, a :class:`SphereMap`, or a
    file: a written map, a bare sphere, or with ``points=FILE`` a mesh and its sphere.
    """
    count = _arrays.threads(threads)
    if isinstance(mesh, (str, os.PathLike)):
        sphere = existing(points) if points is not None else ""
        found = _core.verify_file(existing(mesh), sphere, count)
        found.pop("is_round")
        return Certificate(**found)
    if points is None and isinstance(mesh, SphereMap):
        points = mesh.points
    if points is None:
        raise TypeError("points: (V, 3) rays are needed, where the vertices go")
    source = _any_mesh(mesh, faces)
    source._require_sound()
    rays = _arrays.points(points, "points")
    if len(rays) != len(source.vertices):
        raise ValueError(f"points: {len(source.vertices)} rows are needed, one a vertex, not {len(rays)}")
    return Certificate(**_core.certify_points(source._source, rays, count))


def fields() -> Dict[str, str]:
    """What can be baked: name to one line about it; ``"scalar:NAME"`` wants a name."""
    return dict(_core.fields())
