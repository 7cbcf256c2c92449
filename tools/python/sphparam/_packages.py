"""Meshes of other packages, told by their attributes; none of them is imported."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional

from ._arrays import numbers, points, triangles
from ._losses import tell
from ._numpy import np
from ._values import Columns

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._values import Rows

    Array = npt.NDArray[Any]
    Values = Mapping[str, Any]


class Parts:
    """What was found in an object: two arrays, and values of its vertices and faces.

    What it has besides, and what of its values a mesh has no room for, is told.
    """

    def __init__(
        self,
        vertices: Any,
        faces: Any,
        values: Optional[Values] = None,
        face_values: Optional[Values] = None,
        losses: Iterable[str] = (),
    ) -> None:
        self.vertices, self.faces = points(vertices), triangles(faces)
        self._losses = list(losses)
        self.values = self._kept(values, len(self.vertices), "vertex")
        self.face_values = self._kept(face_values, len(self.faces), "face")
        tell(f"not carried: {loss}" for loss in self._losses)

    def _kept(self, values: Optional[Values], count: int, what: str) -> Rows:
        kept = Columns(count, what)
        for name, thing in (values or {}).items():
            try:
                kept.add(re.sub(r"\s+", "_", str(name)), thing)
            except (TypeError, ValueError) as error:
                self._losses.append(str(error))
        return kept.rows


def _named(what: str, names: Iterable[Any]) -> List[str]:
    """A line about things by their names, if there are any."""
    listed = ", ".join(sorted(str(name) for name in names))
    return [f"{what}: {listed}"] if listed else []


def _counted(what: str, count: int) -> List[str]:
    return [f"{what}: {count}"] if count else []


def _meshio(mesh: Any) -> Parts:
    cells = mesh.cells_dict
    others = sorted(set(cells) - {"triangle", "vertex", "line"})
    if others:
        raise ValueError(f"cells that are no triangles: {', '.join(others)}; cut them into triangles")
    if "triangle" not in cells:
        raise ValueError("the mesh has no triangles")
    data = getattr(mesh, "cell_data_dict", {})
    losses = [line for kind in ("line", "vertex") for line in _counted(f"{kind} cells", len(cells.get(kind, ())))]
    for name in ("field_data", "point_sets", "cell_sets"):
        losses += _named(name, getattr(mesh, name, {}))
    face_values = {name: kinds["triangle"] for name, kinds in data.items() if "triangle" in kinds}
    losses += _named("cell_data", set(data) - set(face_values))
    return Parts(mesh.points, cells["triangle"], mesh.point_data, face_values, losses)


def _fan_faces(flat: Any) -> Array:
    """Rows of [3, a, b, c, 3, …], as VTK had them and PyVista has them."""
    array = numbers(flat, "faces")
    if array.ndim == 1 and array.size % 4 == 0 and (array[::4] == 3).all():
        return array.reshape(-1, 4)[:, 1:]
    raise ValueError("faces that are no triangles: mesh.triangulate() first")


def _pyvista(mesh: Any) -> Parts:
    if getattr(mesh, "n_strips", 0):
        raise ValueError("triangle strips: mesh.triangulate() makes triangles of them")
    faces = np.asarray(mesh.faces)
    losses = _counted("lines", getattr(mesh, "n_lines", 0)) + _counted("single points", getattr(mesh, "n_verts", 0))
    losses += _named("field_data", getattr(mesh, "field_data", {}))
    faces = faces if faces.ndim == 2 else _fan_faces(faces)
    return Parts(mesh.points, faces, getattr(mesh, "point_data", {}), getattr(mesh, "cell_data", {}), losses)


def _vtk_arrays(data: Any) -> Dict[str, Any]:
    names = [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]
    return {n: np.asarray(data.GetArray(n)) for n in names if n and data.GetArray(n) is not None}


def _vtk(mesh: Any) -> Parts:
    polys = mesh.GetPolys()
    if mesh.GetNumberOfStrips():
        raise ValueError("triangle strips: vtkTriangleFilter makes triangles of them")
    offsets = np.asarray(polys.GetOffsetsArray())
    if len(offsets) > 1 and (np.diff(offsets) != 3).any():
        raise ValueError("faces that are no triangles: vtkTriangleFilter cuts them")
    lines, verts = mesh.GetNumberOfLines(), mesh.GetNumberOfVerts()
    losses = _counted("lines", lines) + _counted("single points", verts)
    fields = mesh.GetFieldData()
    losses += _named("field data", (fields.GetArrayName(k) for k in range(fields.GetNumberOfArrays())))
    faces = np.asarray(polys.GetConnectivityArray()).reshape(-1, 3)
    cells = _vtk_arrays(mesh.GetCellData())
    if lines or verts:  # whose rows stand among those of the faces
        losses += _named("cell data", cells)
        cells = {}
    return Parts(np.asarray(mesh.GetPoints().GetData()), faces, _vtk_arrays(mesh.GetPointData()), cells, losses)


def _gifti(image: Any) -> Parts:
    vertices, faces = image.agg_data("pointset"), image.agg_data("triangle")
    if isinstance(vertices, tuple) or isinstance(faces, tuple):
        raise ValueError("a GIFTI image with one pointset and one triangle array is needed")
    others = len(getattr(image, "darrays", ())) - 2
    return Parts(vertices, faces, losses=_counted("arrays that are neither pointset nor triangle", max(others, 0)))


def _trimesh(mesh: Any) -> Parts:
    values = dict(getattr(mesh, "vertex_attributes", {}))
    face_values = dict(getattr(mesh, "face_attributes", {}))
    visual, losses = getattr(mesh, "visual", None), []
    kind = getattr(visual, "kind", None)
    if visual is not None and kind == "vertex":
        values["color"] = visual.vertex_colors
    elif visual is not None and kind == "face":
        face_values["color"] = visual.face_colors
    elif visual is not None and kind == "texture":
        if getattr(visual, "uv", None) is not None:
            values["uv"] = visual.uv
        losses.append("the material and its texture; bake(texture=…) takes an image file")
    return Parts(mesh.vertices, mesh.faces, values, face_values, losses)


def _open3d(mesh: Any) -> Parts:
    values = {}
    if getattr(mesh, "has_vertex_colors", bool)():
        values["color"] = np.asarray(mesh.vertex_colors).astype(np.float32)
    if getattr(mesh, "has_vertex_normals", bool)():
        values["normal"] = np.asarray(mesh.vertex_normals)
    losses = ["texture coordinates of corners"] if getattr(mesh, "has_triangle_uvs", bool)() else []
    losses += ["textures"] if getattr(mesh, "has_textures", bool)() else []
    return Parts(np.asarray(mesh.vertices), np.asarray(mesh.triangles), values, losses=losses)


_kinds = (
    (("agg_data",), _gifti),
    (("points", "cells_dict"), _meshio),
    (("points", "faces"), _pyvista),
    (("GetPoints", "GetPolys"), _vtk),
    (("vertices", "faces"), _trimesh),
    (("vertices", "triangles"), _open3d),
)


def parts_of(mesh: Any) -> Parts:
    """The arrays of any mesh that is known by its attributes, or of a pair of arrays."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return Parts(*mesh)
    for attributes, read in _kinds:
        if all(hasattr(mesh, name) for name in attributes):
            return read(mesh)
    if isinstance(mesh, (str, os.PathLike)):
        raise TypeError(f"no mesh, but the name of a file: sphparam.read({os.fspath(mesh)!r}) reads it")
    raise TypeError(
        f"no mesh: {type(mesh).__name__}; vertices and faces are needed, a pair of them, or a mesh of "
        "sphparam, trimesh, PyVista, VTK, meshio, nibabel or Open3D"
    )
