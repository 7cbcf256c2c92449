"""What is done with surfaces: each step writes files for a route, asks it, and reads what it wrote."""

import os
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Dict, Iterator, Optional

import numpy as np

from . import chart as charts
from . import ply
from .defects import places_of
from .refusal import Defect, Elements, MeshRefused, Refusal
from .routes import BakeSettings, Fit, Verdict
from .surface import Surface, surface_of


@dataclass
class Mapped:
    """A surface with the chart of its map."""

    surface: Surface
    chart: charts.Chart
    verdict: Optional[Verdict]


@dataclass
class ImageFile:
    """An image as a file has it."""

    data: bytes
    ending: str
    """`.png`, `.exr`, …"""


@dataclass
class Baking:
    """What is baked, of which surface, for which other one on the same sphere."""

    surface: Surface
    field: str
    """In the words of `bake --map`; `scalar:NAME` for a scalar of the surface."""
    ending: str
    settings: BakeSettings
    texture: Optional[ImageFile] = None
    target: Optional[Surface] = None


@dataclass
class Remeshed:
    """A mesh on a grid, with what it carries, and its chart."""

    mesh: ply.Ply
    mapped: Mapped
    scalars: Dict[str, np.ndarray]
    """Those of the surface, by their names there."""


@dataclass
class Control:
    """A control mesh, and the displacement that it lacks as an equirectangular image."""

    mesh: ply.Ply
    image: ImageFile
    figures: Fit
    mapped: Mapped
    """With the chart of a mesh that is not cut."""


def _require_sound(surface: Surface) -> None:
    if not len(surface.triangles):
        raise Refusal(f"{surface.name}: the mesh has no faces")
    bad = np.flatnonzero(~np.isfinite(surface.positions).all(axis=1))
    if len(bad):
        message = f"{surface.name}: {len(bad)} vertices have no finite coordinates"
        raise Refusal(message, surface.name, Elements(vertices=bad))
    for name, values in surface.scalars.items():
        bad = surface.used[~np.isfinite(values[surface.used])]
        if len(bad):
            message = f"{surface.name}: the attribute {name} of {len(bad)} vertices is no finite number"
            raise Refusal(message, surface.name, Elements(vertices=bad))


def _explained(surface: Surface, refused: MeshRefused) -> Refusal:
    """What is wrong, in a line a defect, with all places of the first kind."""
    lines = [f"{surface.name} is not a closed genus-0 mesh:"]
    for defect in refused.defects:
        if defect.fatal:
            what = defect.message.split(": first")[0].split(": between")[0]
            lines.append(what + (f" ({defect.hint})" if defect.hint else ""))
    return Refusal("\n".join(lines), surface.name, places_of(surface, refused.defects))


def _of_surfaces(message: str, surfaces: Dict[str, Surface]) -> str:
    """What is said of files, said of the surfaces in them, and without what to type about files."""
    lines = [line for line in message.splitlines() if "sphparam " not in line]
    told = "\n".join(lines) or message
    for path, surface in surfaces.items():
        told = told.replace(path, surface.name).replace(os.path.basename(path), surface.name)
    again = "not one-to-one" in told
    return told + ("\nmap it again: Object › Spherical Map › Map" if again else "")


@contextmanager
def _explaining(surfaces: Dict[str, Surface]) -> Iterator[None]:
    """What a route refuses of files is told of the surfaces in them."""
    try:
        yield
    except MeshRefused as refused:
        raise _explained(surfaces[refused.mesh], refused) from None
    except Refusal as refusal:
        raise Refusal(_of_surfaces(str(refusal), surfaces), refusal.surface, refusal.elements) from None


def _require_unwelded(surface: Surface, mapped: ply.Ply) -> None:
    """Border vertices at the same place are one for sphparam, but not for Blender."""
    if len(mapped.vertices["x"]) == len(surface.used):
        return
    raise Refusal(
        f"{surface.name} has copies of vertices along its borders: Mesh › Clean Up › Merge by Distance",
        surface.name,
        places_of(surface, [Defect("boundary-edge", True, (), "", "")]),
    )


def map_surface(route, folder: str, surface: Surface, balance: str, quality: str, keep_topology: bool) -> Mapped:
    """Maps a surface and makes its chart. Raises Refusal with the elements at fault; Stopped."""
    _require_sound(surface)
    mesh, mapped = os.path.join(folder, "mesh.ply"), os.path.join(folder, "map.sph.ply")
    replace(surface, directions=None).write(mesh)
    with _explaining({mesh: surface}):
        verdict = route.map(mesh, mapped, balance, quality)
    _require_unwelded(surface, ply.read(mapped))
    return Mapped(surface, _chart(route, folder, mapped, keep_topology), verdict)


def _chart(route, folder: str, mapped: str, keep_topology: bool) -> charts.Chart:
    path = os.path.join(folder, "chart.ply")
    route.chart(mapped, path, keep_topology)
    return charts.read(path)


def write_mapped(folder: str, surface: Surface, name: str = "map") -> str:
    """A file of a mesh with its map. Raises Refusal where it was not mapped."""
    _require_sound(surface)
    if surface.directions is None:
        raise Refusal(f"{surface.name} has no map yet: Object › Spherical Map › Map")
    lengths = np.linalg.norm(surface.directions[surface.used], axis=1)
    if (lengths < 0.5).any():
        lost = surface.used[lengths < 0.5]
        raise Refusal(
            f"{surface.name}: {len(lost)} vertices came after it was mapped; map it again",
            surface.name,
            Elements(vertices=lost),
        )
    path = os.path.join(folder, name + ".sph.ply")
    surface.write(path)
    return path


def bake(route, folder: str, baking: Baking) -> ImageFile:
    """Bakes an image. Raises Refusal with the elements at fault; Stopped. So do those below."""
    settings = replace(baking.settings)
    source = write_mapped(folder, baking.surface)
    surfaces = {source: baking.surface}
    if baking.target is not None:
        settings.target = write_mapped(folder, baking.target, "target")
        surfaces[settings.target] = baking.target
    if baking.texture is not None:
        settings.texture = os.path.join(folder, "texture" + baking.texture.ending)
        with open(settings.texture, "wb") as file:
            file.write(baking.texture.data)
    path = os.path.join(folder, "baked" + baking.ending)
    with _explaining(surfaces):
        route.bake(source, {_field_in_file(baking): path}, settings)
    return _image_file(path)


def _field_in_file(baking: Baking) -> str:
    kind, _, name = baking.field.partition(":")
    return f"scalar:{baking.surface.column_of(name)}" if kind == "scalar" else baking.field


def _image_file(path: str) -> ImageFile:
    with open(path, "rb") as file:
        return ImageFile(file.read(), os.path.splitext(path)[1])


def remesh(route, folder: str, surface: Surface, grid: str) -> Remeshed:
    """A mesh on a grid of the sphere, and its chart."""
    out, again = os.path.join(folder, "remeshed.ply"), os.path.join(folder, "again")
    mapped = write_mapped(folder, surface)
    with _explaining({mapped: surface}):
        route.remesh(mapped, grid, out)
    os.mkdir(again)
    found = ply.read(out)
    made = surface_of(found, f"{surface.name} {grid}")
    scalars = {name: found.vertices[surface.column_of(name)] for name in surface.scalars}
    return Remeshed(found, Mapped(made, _chart(route, again, write_mapped(again, made), False), None), scalars)


def fit_control(route, folder: str, surface: Surface, edges: int, width: int) -> Control:
    """A Catmull-Clark control mesh of 6·edges² quads, and what its surface lacks."""
    out, image = os.path.join(folder, "control.ply"), os.path.join(folder, "displacement.exr")
    again = os.path.join(folder, "again")
    mapped = write_mapped(folder, surface)
    with _explaining({mapped: surface}):
        figures = route.fit(mapped, f"cube:{edges}", out, image, (width, width // 2))
    os.mkdir(again)
    found = ply.read(out)
    made = surface_of(found, f"{surface.name} control")
    mapped = Mapped(made, _chart(route, again, write_mapped(again, made), True), None)
    return Control(found, _image_file(image), figures, mapped)


def colours_of(found: ply.Ply) -> Optional[np.ndarray]:
    """(V, 4) from 0 to 1, sRGB, of what a mesh carries; None: no colours."""
    if "red" not in found.vertices:
        return None
    rows = [found.vertices[name] for name in ("red", "green", "blue")]
    rows.append(found.vertices.get("alpha", np.full(len(rows[0]), 255 if rows[0].dtype == np.uint8 else 1)))
    table = np.stack(rows, axis=1)
    return table.astype(np.float64) / (255 if rows[0].dtype == np.uint8 else 1)
