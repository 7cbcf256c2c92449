"""Maps in files: their own, those of other programs, pages."""

from __future__ import annotations

import os
from contextlib import ExitStack
from typing import TYPE_CHECKING, List, Optional, Sequence

from . import _arrays, _core
from ._losses import tell
from ._map_facts import MapFacts, mapped_of
from ._mesh import Path, path_of, require_mesh_format
from ._numpy import np
from ._progress import Progress, told
from ._up import Direction, as_direction

if TYPE_CHECKING:
    from ._images import Image
    from ._sphere_map import SphereMap

_export_options = (
    "variants", "image_size", "unlit", "tangents", "textures", "name", "convention", "refine_poles", "keep_topology",
    "shape", "morph", "theta_phi", "source_uv", "quantise", "compress", "embedded",
)  # fmt: skip
_export_endings = (".glb", ".gltf", ".usda", ".usdz", ".obj", ".ply")


def _require_ending(path: str) -> str:
    """Before any work is done for a file that cannot be written."""
    ending = os.path.splitext(path)[1]
    if ending.lower() not in _export_endings:
        known = ", ".join(_export_endings)
        raise ValueError(f"path: {path!r}: exports end in {known}; save() writes the mesh in other formats")
    return path


class MapFiles(MapFacts):
    """To files."""

    __slots__ = ()

    def save(self, path: Path, *, holes: str = "marked", threads: int = 0) -> None:
        """Writes mesh and map as ``.sph.ply``, proved as read back; ``.vtk`` and ``.vtp`` hold both too.

        Other formats take the mesh alone. ``holes``: what closes those that were kept is ``"marked"`` where
        the format can, else left out; ``"keep"``, ``"drop"``: in all formats, in none. All of it or nothing.
        Raises :class:`WriteError`; warns, as :class:`LossWarning`, of what the format has no room for.
        """
        name = require_mesh_format(path_of(path), "export()")
        losses = _core.save(self._mapped, name, _arrays.text(holes, "holes"), _arrays.threads(threads))
        tell(f"{name}: {loss}" for loss in losses)

    def save_sphere(self, path: Path, *, threads: int = 0) -> None:
        """Writes the bare sphere: ``.ply``, ``.obj``, ``.off``, ``.vtk`` in doubles; ``.gii``, ``.sphere``,
        ``.mz3`` of radius 100 in floats.
        """
        _core.save_sphere(self._mapped, path_of(path), _arrays.threads(threads))

    def export(
        self,
        path: Path,
        *,
        texture: Optional[Image] = None,
        normal_map: Optional[Image] = None,
        occlusion_map: Optional[Image] = None,
        orm_map: Optional[Image] = None,
        emissive_map: Optional[Image] = None,
        images: Optional[Path] = None,
        variants: Sequence[str] = (),
        image_size: int = 2048,
        unlit: bool = False,
        tangents: bool = False,
        textures: str = "given",
        webp_quality: int = 90,
        name: str = "",
        convention: str = "sphparam",
        refine_poles: int = 1,
        keep_topology: bool = False,
        shape: str = "mesh",
        morph: str = "none",
        up: Optional[Direction] = None,
        front: Optional[Direction] = None,
        theta_phi: bool = False,
        source_uv: bool = False,
        quantise: bool = False,
        compress: bool = False,
        embedded: bool = False,
        levels: Sequence[SphereMap] = (),
        threads: int = 0,
        progress: Progress = None,
    ) -> List[str]:
        """Writes the mesh with spherical texture coordinates: ``.glb``, ``.gltf``, ``.usda``, ``.usdz``, ``.obj``, ``.ply``.

        Parameters
        ----------
        texture, normal_map, occlusion_map, orm_map, emissive_map
            Colours; normals; occlusion; occlusion, roughness and metallic in red, green and blue; light that is given.
            Equirectangular images, twice as wide as high: files, or arrays (H, W) of greys or (H, W, 3 or 4),
            uint8 or floats from 0 to 1, in sRGB; or what :meth:`bake` made, which is turned into colours.
            That must be of the same ``convention`` and ``refine_poles``, a normal map ``"normal-tangent"``
            and for this mesh, the others ``"ao"`` or ``"occlusion"``, ``"orm"``, ``"emissive"``; of files their metadata says so. Alpha of strangers' textures that is not 1
            everywhere is a mask where it is 0 or 1, else blended.
        images
            A folder of the program's ``bake``: what is there of these.
        variants
            More materials to switch to: ``"axes"``, ``"checker"``, ``"graticule"``, ``"area"``,
            ``"angle"``.
        image_size
            Of images that are made here; 16 to 16384, a multiple of 4.
        unlit, tangents
            The colours without light; tangents also without a normal map.
        textures
            What all images are made: ``"given"``, PNG and JPEG as they are; ``"png"``; ``"jpeg"``, colours
            without alpha; ``"webp"``, which loses of colours what ``webp_quality`` (1 to 100) says and nothing of
            other images; ``"webp-lossless"``. What would be no smaller stays as it is.
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
            What points up in the mesh: ``"x"``, ``"-x"`` … ``"-z"`` or three numbers; None: as its file
            says, else z.
        front
            What looks at who sees it, as ``up``; None: as its file says, else -y, z with y up.
        theta_phi, source_uv
            The angles as an attribute; the mesh's own texture coordinates as a second set.
        quantise, compress, embedded
            16-bit numbers; these in meshopt compression, normals in 8 bits, triangles and
            vertices in another order; a ``.gltf`` in one file.
        levels
            Levels of detail on the same sphere, in the same file.

        Returns
        -------
        list of str
            The files that were written, all or none.
        """
        from ._baked import require_kind
        from ._images import as_file

        name_of_file = _require_ending(path_of(path))
        given = dict(locals())
        options = {name: given[name] for name in _export_options}
        options.update(
            up=as_direction(up, "up"),
            front=as_direction(front, "front"),
            images=path_of(images) if images is not None else "",
            variants=[_arrays.text(v, "variants") for v in ([variants] if isinstance(variants, str) else _arrays.listed(variants, "variants", "texts"))],
            levels=[mapped_of(level, "levels") for level in _arrays.listed(levels, "levels", "maps")],
            webp_quality=_arrays.whole(webp_quality, "webp_quality", 1, 100),
            threads=_arrays.threads(threads),
        )
        require_kind(normal_map, "normal_map", "normal-tangent", fingerprint=self._fingerprint)
        require_kind(occlusion_map, "occlusion_map", "ao", "occlusion")
        require_kind(orm_map, "orm_map", "orm")
        require_kind(emissive_map, "emissive_map", "emissive")
        given_images = {
            "texture": texture, "normal_map": normal_map, "occlusion_map": occlusion_map, "orm_map": orm_map,
            "emissive_map": emissive_map,
        }  # fmt: skip
        # .obj, .ply and USD keep a copy of the image, .gltf and .glb hold it: the file made here may go.
        with ExitStack() as held:
            for what, image in given_images.items():
                options[what] = held.enter_context(as_file(image, what, convention, refine_poles))
            report = held.enter_context(told(progress))
            files, warned = _core.export(self._mapped, name_of_file, options, report)
        tell(self._not_exported(name_of_file, source_uv))
        # The core's line about columns says the same: values have other names here.
        tell([line for line in warned if not line.endswith(": .ply has room for that")])
        return [file for file, _ in files]

    def _not_exported(self, path: str, source_uv: bool) -> List[str]:
        """A line about the values that the format of an export has no room for, if there are any."""
        ending = os.path.splitext(path)[1].lower()
        if ending == ".ply":
            return []
        kept = {"color", "normal", "source_vertex", "source_face", "filler"} | ({"uv"} if source_uv else set())
        lost = sorted(name for name in self.values if name not in kept)
        of_faces = {name: of for name, of in self.face_values.items() if name not in kept}
        lost += sorted(f"{name} (of faces)" for name, of in of_faces.items() if np.any(of != of[0]))
        more = "; source_uv=True keeps uv" if "uv" in lost and ending != ".obj" else ""
        return [f"{path}: not carried: {', '.join(lost)}; an export as .ply has room for them{more}"] if lost else []

    def report(
        self,
        path: Path,
        *,
        size: int = 1024,
        up: Optional[Direction] = None,
        front: Optional[Direction] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> None:
        """Writes one page of HTML that shows the map: models or pictures, heat maps, charts, tables.

        ``size``: pixels of textures and pictures, 64 to 8192; ``up``, ``front``: as of :meth:`export`.
        """
        with told(progress) as report:
            _core.report(self._mapped, path_of(path), _arrays.whole(size, "size", 64, 8192), as_direction(up, "up"), as_direction(front, "front"), _arrays.threads(threads), report)
