"""What the add-on cannot do, and why."""

from dataclasses import dataclass, field
from typing import Optional, Tuple

import numpy as np


@dataclass
class Elements:
    """Parts of a mesh, by its own numbers."""

    vertices: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))
    edges: np.ndarray = field(default_factory=lambda: np.empty((0, 2), np.int64))
    """(E, 2) vertices."""
    polygons: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))

    def __bool__(self) -> bool:
        return bool(len(self.vertices) or len(self.edges) or len(self.polygons))


class Refusal(Exception):
    """Something that the user can change; `elements` of the mesh `surface` are where."""

    def __init__(self, message: str, surface: str = "", elements: Optional[Elements] = None):
        super().__init__(message)
        self.surface, self.elements = surface, elements or Elements()


class Stopped(Exception):
    """The user does not want to wait."""


@dataclass
class Defect:
    """As `sphparam info` lists them."""

    kind: str
    fatal: bool
    ids: Tuple[int, ...]
    message: str
    hint: str


class MeshRefused(Exception):
    """What sphparam says of a mesh that cannot be mapped: at least one defect that is fatal. Numbers are those
    of the file `mesh`, the path that the route was given."""

    def __init__(self, defects: Tuple[Defect, ...], mesh: str):
        super().__init__("no closed genus-0 mesh")
        self.defects, self.mesh = defects, mesh
