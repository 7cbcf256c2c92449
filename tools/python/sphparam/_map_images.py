"""Images of maps: fields baked, images painted back, pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _arrays, _core
from ._figures import BakedFile
from ._losses import tell
from ._map_facts import MapFacts, mapped_of
from ._mesh import Mesh, Path, any_mesh, centre_of, existing, path_of
from ._progress import Progress, told
from ._up import Direction, as_direction

if TYPE_CHECKING:
    from ._baked import BakedImage, Bytes
    from ._images import Image
    from ._map_facts import Floats
    from ._sphere_map import SphereMap

_baking_options = (
    "size", "samples", "depth", "mip", "filter", "wrap", "heat", "normal_y_down", "height_radial", "rays",
    "max_ray_distance", "refine_poles", "body", "positive_west", "threads",
)  # fmt: skip
_units = {"m": 1.0, "km": 1000.0}


def fields() -> Dict[str, str]:
    """What can be baked: name to one line about it; ``"scalar:NAME"`` wants a name."""
    return dict(_core.fields())


def _baking(given: Dict[str, Any]) -> Dict[str, Any]:
    """The settings of a bake, as `_core` takes them."""
    if isinstance(given["size"], (tuple, list)):
        raise TypeError(f"size: one number is needed, texels a row, not {given['size']!r}; there are half as many rows")
    options = {name: given[name] for name in _baking_options if given.get(name) is not None}
    options["threads"] = _arrays.threads(given["threads"])
    options["convention"] = given["convention"] or ("gis" if given["body"] else "sphparam")
    options["interpolation"] = given["interpolation"] or ("sphere" if given["body"] else "uv")
    if _arrays.text(given["unit"], "unit") not in _units:
        raise ValueError(f"unit: 'm' or 'km', not {given['unit']!r}")
    options["unit"] = _units[given["unit"]]
    if given.get("range") is not None:
        options["range"] = _arrays.least_and_greatest(given["range"], "range")
    if given["centre"] is not None:
        options["centre"] = centre_of(given["centre"], given["self"].mesh)
    if given["texture"] is not None:
        options["texture"] = existing(given["texture"])
    if given["target"] is not None:
        options["target"] = mapped_of(given["target"], "target")
    if given["surface"] is not None:
        options["surface"] = given["surface"]._source
    return options


def _taken_once(surface: Optional[Any]) -> Optional[Mesh]:
    """So that what it has besides is told once."""
    return None if surface is None else any_mesh(surface, None)


def _wanted(images: Any) -> List[Tuple[str, str]]:
    """Fields and paths, of a dict or what makes one."""
    try:
        wanted = dict(images)
    except (TypeError, ValueError):
        raise TypeError(f"images: a dict is needed, {{field: path}}, not {type(images).__name__}") from None
    return [(_arrays.text(name, "images"), path_of(path)) for name, path in wanted.items()]


def _require_field(name: str) -> None:
    """Tells of a field that is not there which one may be meant."""
    known = fields()
    if name.split(":")[0] in known:
        return
    from difflib import get_close_matches  # imported when it is wanted

    first = name.split(":")[0]
    near = [other for other in known if other.startswith(first.rstrip("s"))]
    near += get_close_matches(first, known, 1, 0.75)
    if near:
        raise ValueError(f"there is no field {name}; there are {', '.join(known)}; is {near[0]!r} meant?")


class MapImages(MapFacts):
    """From the surface to images, and back."""

    __slots__ = ()

    def bake(
        self,
        field: str,
        *,
        size: int = 2048,
        samples: int = 1,
        convention: Optional[str] = None,
        interpolation: Optional[str] = None,
        texture: Optional[Path] = None,
        filter: str = "bilinear",
        wrap: str = "repeat",
        range: Optional[Tuple[float, float]] = None,
        heat: bool = False,
        normal_y_down: bool = False,
        height_radial: bool = False,
        rays: int = 64,
        max_ray_distance: float = 0.1,
        target: Optional[SphereMap] = None,
        surface: Optional[Mesh] = None,
        refine_poles: int = 1,
        body: str = "",
        unit: str = "m",
        positive_west: bool = False,
        centre: Union[str, Tuple[float, float, float], None] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> BakedImage:
        """A field of the surface as an equirectangular array.

        Row 0 is at the north pole, φ = π (row + ½) / H; columns go with longitude, in the convention
        ``"sphparam"`` θ = 2π (column + ½) / W. Where holes were kept, a last channel is 1 on the surface and
        0 on what closes them.

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
            None: the first of these, with a ``body`` ``"gis"``.
        interpolation
            ``"uv"`` as a GPU does on the mesh's chart; ``"sphere"`` by direction. None: ``"uv"``, with a
            ``body`` ``"sphere"``.
        texture
            An image for the mesh's own texture coordinates, for ``"basecolor"``.
        filter, wrap
            How it is magnified: ``"nearest"``, ``"bilinear"``, ``"bicubic"``; what it is beyond its
            borders: ``"repeat"``, ``"mirror"``, ``"clamp"``.
        range
            With ``heat``, of ``"scalar:NAME"``: the least and the greatest number that have colours of their own,
            so that images can be compared; None: those of the values.
        heat
            Distortion, curvature and ``"scalar:NAME"`` as colours instead of numbers.
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
        surface
            Another surface about where this one is, any triangles: it is baked on this one, along its
            smooth normals, else by the nearest point (``"found"`` says where). Not with ``target``.
        refine_poles
            Triangles at a pole are cut into so many, as in :meth:`export`.
        body, unit
            Whose surface it is, for ``"elevation"`` and GIS: a name of the IAU's (``"vesta"``), a radius or
            three semi-axes (``"285,277,226"``) in ``unit``, the mesh's: ``"m"``, ``"km"``; or WKT.
        positive_west
            Longitudes of ``"lon"`` grow to the west.
        centre
            Of the body, in the mesh's coordinates; ``"centroid"``: that of what the mesh encloses; None: that of a
            radial map, else the origin.

        Returns
        -------
        BakedImage
            (size / 2, size, channels) float32: unit vectors, colours in sRGB from 0 to 1 (files of
            :meth:`bake_files` in floats have linear light), numbers of labels, or units of the mesh;
            ``about`` says which.
        """
        from ._baked import Baked, BakedImage

        _require_field(_arrays.text(field, "field"))
        if range is not None and not (heat and field.startswith("scalar:")):
            raise ValueError("range: of the colours of scalar:NAME, which heat=True has")
        surface = _taken_once(surface)
        options = _baking(locals())
        self._require_scalar(field, surface)
        with told(progress) as report:
            (name, about, table, rounding), warned = _core.bake_to_arrays(self._mapped, [field], options, report)
        tell(warned)
        if rounding:
            tell([rounding.replace("depth u16 (.png, .tif)", 'bake_files(…, depth="u16")')])
        frame = (target or self)._fingerprint() if name == "normal-tangent" else None
        poles = refine_poles if options["interpolation"] == "uv" else None
        return BakedImage._of(table, name, about, Baked(options["convention"], poles, normal_y_down, frame))

    def _require_scalar(self, field: str, surface: Optional[Mesh]) -> None:
        """Tells of several numbers a vertex which one is one image."""
        kind, _, name = field.partition(":") if isinstance(field, str) else ("", "", "")
        if kind != "scalar":
            return
        mine = (self.values, self.face_values)
        for values in mine if surface is None else (surface.values, surface.face_values):
            names = values.columns(name)
            if len(names) > 1:
                listed = ", ".join("scalar:" + column for column in names)
                raise ValueError(f"{field}: {name!r} has {len(names)} columns, an image each: {listed}")

    def bake_files(
        self,
        images: Mapping[str, Path],
        *,
        size: int = 2048,
        samples: int = 1,
        convention: Optional[str] = None,
        interpolation: Optional[str] = None,
        depth: Optional[str] = None,
        mip: bool = False,
        texture: Optional[Path] = None,
        filter: str = "bilinear",
        wrap: str = "repeat",
        range: Optional[Tuple[float, float]] = None,
        heat: bool = False,
        normal_y_down: bool = False,
        height_radial: bool = False,
        rays: int = 64,
        max_ray_distance: float = 0.1,
        target: Optional[SphereMap] = None,
        surface: Optional[Mesh] = None,
        refine_poles: int = 1,
        body: str = "",
        unit: str = "m",
        positive_west: bool = False,
        centre: Union[str, Tuple[float, float, float], None] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Tuple[BakedFile, ...]:
        """Bakes fields into image files, all of them or none.

        ``images`` is field to path, a ``.png``, ``.jpg``, ``.tif`` or ``.exr``. ``depth``: ``"uint8"``,
        ``"uint16"``, ``"half"``, ``"float"``, as the format has them. ``mip``: tiles and all levels, EXR
        only. ``range``: of ``"scalar:NAME"``, what the least and the greatest integer stand for, so that
        images can be compared; None: the least and the greatest number of each. The others are those of
        :meth:`bake`. With a ``body``, files beside ``.png`` and ``.tif`` tell GDAL and QGIS where they lie.
        """
        surface = _taken_once(surface)
        options = _baking(locals())
        pairs = _wanted(images)
        if range is not None and not any(name.startswith("scalar:") for name, _ in pairs):
            raise ValueError("range: what integers of scalar:NAME stand for, which is not baked")
        for name, _ in pairs:
            self._require_scalar(name, surface)
        with told(progress) as report:
            *rows, warned = _core.bake_to_files(self._mapped, pairs, options, report)
        tell(warned)
        return tuple(BakedFile(*row) for row in rows)

    def paint(
        self, image: Image, *, convention: str = "sphparam", threads: int = 0, progress: Progress = None
    ) -> Bytes:
        """An equirectangular image as colours of the vertices, (V, 3) or (V, 4), 0 to 255.

        ``image`` is a file, or an array as :meth:`export` takes it; ``convention`` as in :meth:`bake`.
        """
        from ._images import as_file

        _arrays.text(convention, "convention")
        with as_file(image, "image", convention) as path, told(progress) as report:
            colours, warned = _core.paint(self._mapped, path, convention, _arrays.threads(threads), report)
        tell(warned)
        return colours

    def sample(
        self, image: Any, *, at: str = "vertices", convention: Optional[str] = None, nearest: bool = False
    ) -> Floats:
        """Numbers of an equirectangular array at vertices or faces, (V,) or (V, C) floats: the way back of :meth:`bake`.

        Parameters
        ----------
        image
            (H, W) or (H, W, C) numbers, twice as wide as high, row 0 at the north pole: heights, labels, what
            :meth:`bake` made or an archive has. Colours of vertices are :meth:`paint`'s.
        at
            ``"vertices"``, or ``"faces"``: at the middle of each on the sphere.
        convention
            Where longitude goes, as of :meth:`bake`; None: as the image was baked, else ``"sphparam"``.
        nearest
            The texel that the direction is in, as labels want it; else bilinear between the middles of four.
        """
        from ._images import as_numbers, at_directions

        table, baked_for = as_numbers(image, "image")
        longitude = baked_for or "sphparam" if convention is None else _arrays.text(convention, "convention")
        if baked_for and longitude != baked_for:
            raise ValueError(f"image: baked with convention={baked_for!r}, taken with convention={longitude!r}")
        if at not in ("vertices", "faces"):
            raise ValueError(f"at: 'vertices' or 'faces', not {at!r}")
        points = self.points if at == "vertices" else self.points[self.faces].sum(axis=1)
        return at_directions(table, points, _core.turns_of(longitude), _arrays.flag(nearest, "nearest"))

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
        from ._baked import as_bytes
        from ._images import as_file

        size, padding = _arrays.whole(size, "size", 1, 65536), _arrays.whole(padding, "padding", 0, 254)
        _arrays.text(convention, "convention")
        with as_file(image, "image", convention) as path, told(progress) as report:
            table, warned = _core.paint_texture(
                self._mapped, path, convention, size, padding, _arrays.threads(threads), report
            )
        tell(warned)
        return as_bytes(table)

    def picture(
        self,
        *,
        view: str = "both",
        colours: str = "own",
        texture: Optional[Path] = None,
        scalar: str = "",
        range: Optional[Tuple[float, float]] = None,
        size: int = 800,
        eye: Optional[Tuple[float, float, float]] = None,
        up: Optional[Direction] = None,
        front: Optional[Direction] = None,
        wireframe: bool = False,
        graticule: bool = False,
        occlusion: bool = False,
        legend: bool = True,
        transparent: bool = False,
        threads: int = 0,
    ) -> bytes:
        """A picture of the mesh and its sphere, as the bytes of a PNG.

        ``view``: ``"mesh"``, ``"sphere"``, ``"both"``. ``colours``: ``"own"``, textures, else colours of vertices or
        materials, else directions; ``"plain"``, ``"normals"``, ``"checker"``, ``"area"``, ``"angle"``. ``texture``: an
        image for the mesh's texture coordinates, instead of its own. ``scalar``: a number a vertex or a face, by its name, shown
        as colours; ``range``: their scale, the smaller one first; None: its 2nd to its 98th percentile. ``size``: pixels, 16 to 16384. ``eye``:
        the direction to look from; ``up``, ``front``: as of :meth:`export`. ``wireframe``, ``graticule``:
        lines; ``occlusion``: darker where little light comes; ``legend``: below colours
        that are numbers. ``transparent``: no white background, and no legend.
        """
        options: Dict[str, Any] = dict(
            view=view, colours=colours, scalar=self._shown_scalar(scalar), size=size, up=as_direction(up, "up"), front=as_direction(front, "front"),
            wireframe=wireframe, graticule=graticule,
            occlusion=occlusion, legend=legend, transparent=transparent, threads=_arrays.threads(threads),
        )  # fmt: skip
        if eye is not None:
            options["eye"] = _arrays.three(eye, "eye")
            if not any(options["eye"]):
                raise ValueError("eye: 0, 0, 0 is no direction")
        if texture is not None:
            options["texture"] = existing(texture)
        if range is not None:
            options["range"] = _arrays.least_and_greatest(range, "range")
        if options["scalar"] and (texture is not None or colours != "own"):
            raise ValueError("scalar: has colours of its own; leave out colours and texture")
        if range is not None and not options["scalar"]:
            raise ValueError("range: the scale of scalar, which is not given")
        png, warned = _core.draw(self._mapped, options)
        tell(warned)
        return png

    def _shown_scalar(self, name: str) -> str:
        """Of several numbers a vertex tells which one to name."""
        names = self.values.columns(_arrays.text(name, "scalar"))
        if len(names) > 1:
            raise ValueError(f"scalar: {name!r} has {len(names)} columns, a picture each: {', '.join(names)}")
        return names[0]
