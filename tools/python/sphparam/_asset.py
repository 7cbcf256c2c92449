"""An asset's whole way: one closed surface with one chart, and all that the asset shows."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional

from . import _arrays, _core
from ._attributes import document
from ._errors import as_typed_here
from ._losses import tell
from ._mesh import existing, path_of
from ._progress import Progress, told
from ._sphere_map import SphereMap
from ._up import as_direction

if TYPE_CHECKING:
    from ._mesh import Path
    from ._up import Direction


class Projection(NamedTuple):
    """How a surface found the asset along its normals: shares of its area."""

    back: float
    """Shows the back of the asset, normals turned round."""
    nearest: float
    """Shows no more than the nearest point."""
    median: float
    """Half of it is as near as this, in diagonals of the box."""
    farthest: float
    """All of it is."""


class Asset(NamedTuple):
    """What became of an asset. :func:`asset` makes it."""

    map: SphereMap
    """The one closed surface with its map."""
    surface: str
    """How it came about: ``"itself"``, ``"repair"`` or ``"wrap"``."""
    area_kept: float
    """Of the asset's area, what a repair kept; a wrap has all of it inside."""
    found: List[str]
    """What stood in the way, a line each."""
    done: List[str]
    """What repair did, or how it was wrapped."""
    details: List[str]
    """Both again with all figures, and where."""
    images: Dict[str, str]
    """The file of each image by what it shows: ``"basecolor"``, ``"normal-tangent"``, ``"orm"`` …"""
    projection: Optional[Projection]
    """How the channels came onto it; None where it is the asset itself."""
    wall_share: float
    """Of its area, what closes ways through a wrap."""
    files: List[str]
    """All that were written."""
    warnings: List[str]
    """What differs from what the asset shows."""
    losses: List[str]
    """What of the asset's file is not carried."""
    seconds: Dict[str, float]
    """Of each stage."""


class _Folder:
    """One that was made here goes again unless it is used."""

    def __init__(self, name: str) -> None:
        self.name = name.rstrip("/") or name
        self.is_made = not os.path.isdir(self.name)

    def __enter__(self) -> str:
        if self.is_made:
            os.mkdir(self.name)
        return self.name

    def __exit__(self, *error: Any) -> None:
        if self.is_made and not os.listdir(self.name):
            os.rmdir(self.name)


def asset(
    path: Path,
    folder: Optional[Path] = None,
    *,
    size: int = 2048,
    samples: int = 1,
    occlusion: bool = False,
    clear_walls: bool = False,
    triangles: int = 50_000,
    resolution: int = 192,
    least_kept: float = 0.98,
    compress: bool = False,
    crease: Optional[float] = None,
    textures: str = "given",
    webp_quality: int = 90,
    up: Optional[Direction] = None,
    front: Optional[Direction] = None,
    page: bool = True,
    threads: int = 0,
    progress: Progress = None,
) -> Asset:
    """Makes of an asset one closed surface with one chart, with all that the asset shows.

    As ``sphparam FILE`` does: what is a closed surface of genus 0 stays as it is; what repair mends, keeping
    enough of the area, is mended; all else is wrapped. All channels of its materials are baked. Into the folder
    go NAME.glb with all of them, NAME.sph.ply with the map, the images, and NAME.html to look at it: all or none.
    What is not carried is told as :class:`LossWarning`.

    Parameters
    ----------
    path
        glTF, OBJ, FBX, COLLADA or any other mesh that is read.
    folder
        Where files go; it is made if need be. None: NAME_sphere, in the working folder.
    size, samples
        Texels a row of images, half as many rows; samples² samples a texel.
    occlusion
        Ambient occlusion too, by rays.
    clear_walls
        Walls that close ways through a wrap are cut out of what is seen, by alpha; the surface stays closed.
    triangles, resolution
        Of a wrap: about so many, 0: all; voxels along the longest side of the box.
    least_kept
        Of the area, that a repair must keep; else the asset is wrapped.
    compress
        A smaller .glb, by EXT_meshopt_compression.
    crease
        Of an asset without normals, edges are hard whose faces turn by more degrees, 0 to 180; None: none is.
    textures, webp_quality
        What the images in the .glb are, as of :meth:`SphereMap.export`; those beside it are PNG.
    up, front
        As of :func:`map`; the map stands so too then.
    page
        With the page.

    Raises
    ------
    ReadError
        for a file that cannot be read.
    MeshError
        for one without triangles.
    WriteError, OSError
        for a folder that cannot be written to.
    ValueError
        for one where a file of the asset would be replaced.
    """
    name = existing(path)
    options = {
        "size": _arrays.whole(size, "size", 2, 65_536),
        "samples": _arrays.whole(samples, "samples", 1, 32),
        "occlusion": _arrays.flag(occlusion, "occlusion"),
        "clear_walls": _arrays.flag(clear_walls, "clear_walls"),
        "triangles": _arrays.whole(triangles, "triangles", 0, 100_000_000),
        "resolution": _arrays.whole(resolution, "resolution", 8, 2000),
        "least_kept": _arrays.real(least_kept, "least_kept"),
        "compress": _arrays.flag(compress, "compress"),
        "crease": None if crease is None else _arrays.degrees(crease, "crease"),
        "textures": _arrays.text(textures, "textures"),
        "webp_quality": _arrays.whole(webp_quality, "webp_quality", 1, 100),
        "up": as_direction(up, "up"),
        "front": as_direction(front, "front"),
        "page": _arrays.flag(page, "page"),
        "threads": _arrays.threads(threads),
    }
    with _Folder(_core.asset_folder(name) if folder is None else path_of(folder)) as place, told(progress) as report:
        made = _core.asset(name, place, options, report)
    made["warnings"] = [as_typed_here(warning) for warning in made["warnings"]]
    tell([*made["losses"], *made["warnings"]])
    shares = made.pop("projection")
    found = SphereMap._of(made.pop("map"))
    return Asset(map=found, projection=None if shares is None else Projection(**shares), **made)


document(globals())
