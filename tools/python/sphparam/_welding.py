"""Copies of vertices in arrays, as STL and seams of texture coordinates have them, welded as those of files."""

from __future__ import annotations

import os
from typing import Any, Iterator, List, Optional

from . import _core
from ._errors import Defect, MeshError
from ._figures import Action
from ._mesh import Mesh
from ._numpy import np


def _may_have_copies(vertices: Any) -> bool:
    """Whether two positions are alike, by a hash: never False where there are such."""
    bits = np.ascontiguousarray(vertices + 0.0).view(np.uint64)  # −0 is 0
    mixed = bits * np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)
    mixed ^= mixed >> np.uint64(29)
    hashes = mixed[:, 0] + mixed[:, 1] * np.uint64(3) + mixed[:, 2] * np.uint64(7)
    return len(np.unique(hashes)) < len(hashes)


def welded(mesh: Mesh) -> Optional[Mesh]:
    """A mesh of arrays with exact copies welded as :func:`read` welds them; None where nothing is to be welded.

    A closed mesh is left as it is. Texture coordinates and normals that differ go to the corners.
    """
    if mesh.format != "arrays" or not mesh._sound or not len(mesh.faces) or not _may_have_copies(mesh.vertices):
        return None
    import tempfile  # when it is wanted: it takes its time

    with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
        path = os.path.join(folder, "mesh.ply")
        _core.write(mesh._source, path)
        source = _core.read(path, True, False, {"file": 2**62})
    if not any(note.startswith("welded") for note in source.notes):
        return None
    source.path = mesh.path
    made = Mesh._of(source)
    gone = np.setdiff1d(mesh.faces, made.vertex_origin)
    first = tuple(int(v) for v in gone[:10])
    message = f"{len(gone)} exact copies of vertices welded: vertices {', '.join(map(str, first))}"
    made._welds = (Action("vertex-welded", len(gone), first, message + (", …" if len(gone) > 10 else "")),)
    return made


def lost_by_welding(given: Mesh, made: Mesh) -> Iterator[str]:
    """A line about all values of which copies had different ones."""
    theirs, faces = given.values, given.faces
    for name, ours in made.values.items():
        if name in theirs and name not in ("uv", "normal"):
            differ = (theirs[name][faces] != ours[made.faces]).reshape(len(faces), -1).any(axis=1)
            if differ.any():
                share = 100 * differ.mean()
                yield f"{name}: welded vertices have that of the first copy, in {share:.3g} % of the faces another"


def kept_apart(mesh: Mesh) -> Iterator[str]:
    """A line about parts that copies of vertices make."""
    better = welded(mesh)
    if better is not None:
        count = better._welds[0].times
        yield f"{count} exact copies of vertices keep parts asunder; components(mesh, repair=True) welds them first"


def lost_by_nearness(given: Mesh, made: Mesh) -> Iterator[str]:
    """A line about texture coordinates of vertices that moved onto others."""
    near = sum(action.times for action in made.repairs if action.kind == "vertex-welded") - sum(
        action.times for action in made._welds
    )
    if near <= 0 or "uv" not in given.values:
        return
    there = given.faces[((given.faces >= 0) & (given.faces < len(given.vertices))).all(axis=1)]
    share = 100 * (~np.isin(given.vertex_origin, made.vertex_origin)[there]).any(axis=1).mean()
    yield (
        f"uv: {near} vertices were welded onto others nearby, which have other texture coordinates, of {share:.3g} % of "
        "the faces; a file with uv at the corners (.obj, .glb), read by sphparam.read, keeps them"
    )


def _weld_advice(better: Mesh) -> List[str]:
    """What is advised where some copies are not exact; nothing where repair needs no distance."""
    if _core.inspect(better._source)["is_sphere"]:
        return []
    try:
        _core.refuse(better._source)
    except MeshError as left:
        return left._text if any(line.startswith("map(mesh, repair=dict(weld_share=") for line in left._text) else []
    return []


def require_welded(mesh: Mesh) -> None:
    """Refuses arrays that repair would weld first, and says so before what else it would do.

    Costs nothing where the numbers of vertices and faces are those of a closed genus-0 mesh.
    """
    if len(mesh.faces) == 2 * (len(mesh.vertices) - 2):
        return
    better = welded(mesh)
    if better is None:
        return
    defects = [Defect(*row) for row in _core.inspect(mesh._source)["defects"]]
    nearer = _weld_advice(better)
    if nearer:
        raise MeshError._instead(defects, [f"{better._welds[0].times} exact copies of vertices are welded first, and then:", *nearer])
    lines: List[str] = [f"map(mesh, repair=True) welds {better._welds[0].times} exact copies of vertices first,"]
    try:
        done = _core.repair(better._source, {}, True, None)
    except MeshError as left:
        parts = "sphparam.components(mesh"
        more = [line.replace(parts + ")", parts + ", repair=True)") for line in left._text]
        raise MeshError._instead(defects, [lines[0] + " but then:", *more]) from None
    lines[0] += " and mends it" + (":" if done.repairs else "")
    raise MeshError._instead(defects, lines + [f"  {row[3]}" for row in done.repairs])
