"""Whom the add-on asks: the Python package, or the program where that is not there.

Both take and write the same files, so that it makes no difference to whoever asks. A route has

    map(mesh, out, balance, quality)       a mesh → its map, a .sph.ply; a Verdict
    chart(mapped, out, keep_topology)      its refined mesh on the sphere with (u, v)
    bake(mapped, images, settings)         fields → image files
    remesh(mapped, grid, out)              → a mesh on a grid, with its map
    fit(mapped, grid, out, image, size)    → control mesh and displacement; a Fit

and raises MeshRefused for a file whose mesh cannot be mapped, Refusal with what was said otherwise, Stopped
once `progress`, a function of stage and fraction, has returned False.
"""

from dataclasses import dataclass
from typing import NamedTuple, Optional

from .refusal import Refusal


class Verdict(NamedTuple):
    """What is known of a map."""

    verdict: str
    angle: float
    """Mean |ln angle ratio|."""
    area: float
    """Mean |ln area ratio|."""


class Fit(NamedTuple):
    """How near a subdivision surface is to its mesh: RMS of distances both ways, in its units."""

    base_rms: float
    least: float
    """Displacement, as the image has it."""
    greatest: float


@dataclass
class BakeSettings:
    """How images are baked."""

    size: int = 2048
    samples: int = 1
    texture: Optional[str] = None
    """An image for the mesh's own texture coordinates."""
    filter: str = "bilinear"
    target: Optional[str] = None
    """A map that the images are for, on the same sphere."""
    rays: int = 64
    threads: int = 0


def choose(kind: str, package_folder: str, program: str, threads: int = 0):
    """The route that preferences ask for: `AUTO`, `PACKAGE` or `PROGRAM`. Raises Refusal."""
    from . import package_route, program_route

    reasons = []
    if kind in ("AUTO", "PACKAGE"):
        found = package_route.find(package_folder)
        if not isinstance(found, str):
            return package_route.PackageRoute(found, threads)
        reasons.append(found)
    if kind in ("AUTO", "PROGRAM"):
        path = program_route.find(program)
        if path:
            return program_route.ProgramRoute(path, threads)
        reasons.append(f"there is no program {program or 'sphparam'}")
    raise Refusal(f"sphparam is not found: {'; '.join(reasons)}. Say in the add-on's preferences where it is.")
