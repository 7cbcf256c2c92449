"""Maps closed genus-0 triangle meshes one-to-one onto the unit sphere, proves it, and uses the maps.

>>> import sphparam as sp
>>> m = sp.map(vertices, faces)
>>> m.certificate.one_to_one, m.points, m.distortion
>>> image = m.bake("normal-object", size=2048)
>>> low = m.remesh("ico:6")
>>> m.export("statue.glb", texture=image)

Positions are (V, 3), faces (F, 3) counter-clockwise from outside, angles are radians, distances in
units of the mesh. Results own their memory or show that of an object that never changes; nothing that
is passed in is changed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

try:
    from . import _core
except ImportError as error:
    if "cannot open shared object" not in str(error):
        raise
    raise ImportError(
        f"{error}\nsphparam needs libraries of Debian: apt-get install libosdcpu3.5.0 libmeshoptimizer2d "
        "libtinygltf2d libgiftiio0 libembree3-3 libopenimageio2.4"
    ) from None
from ._asset import Asset, Projection, asset
from ._errors import (
    Cancelled,
    Defect,
    ImageError,
    LossWarning,
    MeshError,
    NotCertified,
    ReadError,
    SolveError,
    WriteError,
)
from ._figures import (
    Action,
    Alignment,
    BakedFile,
    Body,
    Certificate,
    Deviation,
    Displacement,
    Distance,
    Distortion,
    FaceDistortion,
    GroupScalar,
    HandleLoop,
    InSpace,
    Inspection,
    Landmarks,
    OneSided,
    Radial,
    SelfCrossings,
    Stage,
)
from ._group import Group, group
from ._map import load, map, remeshing_lambda, verify, with_sphere
from ._map_images import fields
from ._match import SurfaceMap, match
from ._measure import growth, measure
from ._mesh import Mesh, inspect, read, self_crossings, write
from ._repair import components, repair
from ._sphere_map import SphereMap
from ._wrap import Wrap, wrap

if TYPE_CHECKING:
    from ._baked import BakedImage
    from ._chart import Chart
    from ._harmonics import Harmonics, read_harmonics
    from ._subdivision import SubdivisionFit

__version__: str = _core.version

__all__ = [
    "Action",
    "Alignment",
    "Asset",
    "BakedFile",
    "BakedImage",
    "Body",
    "Cancelled",
    "Certificate",
    "Chart",
    "Defect",
    "Deviation",
    "Displacement",
    "Distance",
    "Distortion",
    "FaceDistortion",
    "Group",
    "GroupScalar",
    "HandleLoop",
    "Harmonics",
    "ImageError",
    "InSpace",
    "Inspection",
    "Landmarks",
    "LossWarning",
    "Mesh",
    "MeshError",
    "NotCertified",
    "OneSided",
    "Projection",
    "Radial",
    "ReadError",
    "SelfCrossings",
    "SolveError",
    "SphereMap",
    "Stage",
    "SubdivisionFit",
    "SurfaceMap",
    "Wrap",
    "WriteError",
    "asset",
    "components",
    "fields",
    "group",
    "growth",
    "inspect",
    "load",
    "map",
    "match",
    "measure",
    "read",
    "read_harmonics",
    "remeshing_lambda",
    "repair",
    "self_crossings",
    "verify",
    "with_sphere",
    "wrap",
    "write",
]

_later = {
    "BakedImage": "_baked",
    "Chart": "_chart",
    "Harmonics": "_harmonics",
    "read_harmonics": "_harmonics",
    "SubdivisionFit": "_subdivision",
}


if not TYPE_CHECKING:  # or every name would be there for type checkers

    def __getattr__(name: str) -> Any:
        """What few programs need is imported when it is asked for."""
        if name in _later:
            from importlib import import_module

            return getattr(import_module("." + _later[name], __name__), name)
        raise AttributeError(f"module 'sphparam' has no attribute {name!r}")
