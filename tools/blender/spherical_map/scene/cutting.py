"""Polygons replaced by the triangles of a chart, with everything that the mesh carries."""

import bmesh
import bpy
import numpy as np

from ..core.chart import Cut


def _split_edges(bm, cut: Cut, verts: list, places: np.ndarray) -> None:
    """New vertices that lie on edges of the mesh; Blender interpolates what vertices and corners have."""
    by_edge = {}
    for new, (corners, weights) in enumerate(zip(cut.new_corners, cut.new_weights)):
        ends = sorted((int(v), w) for v, w in zip(corners, weights) if w > 0)
        if len(ends) == 2:
            by_edge.setdefault((ends[0][0], ends[1][0]), []).append((ends[1][1], new))
    first_new = len(places) - len(cut.new_corners)
    for (a, b), on_it in by_edge.items():
        edge = bm.edges.get((verts[a], verts[b]))
        if edge is None:
            continue  # a diagonal of a polygon
        tail, done = verts[a], 0.0
        for share, new in sorted(on_it):
            _, made = bmesh.utils.edge_split(edge, tail, (share - done) / (1 - done))
            made.co = places[first_new + new]
            verts[first_new + new] = made
            edge = bm.edges.get((made, verts[b]))
            tail, done = made, share


class _Pieces:
    """The triangles of polygons as faces of their own: what Blender interpolates in a larger polygon is by other
    weights than those by which our vertices lie in its triangles."""

    def __init__(self, bm, verts: list):
        self._bm, self._verts = bm, list(verts)
        self._made = {}
        self._edges = set()

    def face(self, polygon, corners):
        """The triangle of a polygon, or the polygon itself where it is one."""
        if len(polygon.verts) == 3:
            return polygon
        key = polygon, tuple(sorted(int(v) for v in corners))
        if key not in self._made:
            self._made[key] = self._make(polygon, [self._verts[v] for v in corners])
        return self._made[key]

    def _make(self, polygon, corners):
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if self._bm.edges.get((a, b)) is None:
                self._edges.add(self._bm.edges.new((a, b)))
        made = self._bm.faces.new(corners, polygon)
        loops = {loop.vert: loop for loop in polygon.loops}
        for loop in made.loops:
            loop.copy_from(loops[loop.vert])
        return made

    def remove(self) -> None:
        for face in self._made.values():
            self._bm.faces.remove(face)
        for edge in self._edges:
            if edge.is_valid and not edge.link_faces:
                self._bm.edges.remove(edge)


def _add_inner(bm, cut: Cut, verts: list, places: np.ndarray, faces: list, pieces: _Pieces) -> None:
    """New vertices within polygons."""
    first_new = len(places) - len(cut.new_corners)
    polygon_of = np.zeros(len(places), np.int64)
    polygon_of[cut.vertices] = cut.polygons[:, None]
    for vertex in range(first_new, len(places)):
        if verts[vertex] is None:
            made = bm.verts.new(places[vertex])
            made.copy_from_face_interp(pieces.face(faces[polygon_of[vertex]], cut.new_corners[vertex - first_new]))
            verts[vertex] = made


def _interpolate(loop, face) -> None:
    """What corners carry, within a face. Blender 3 takes the arguments as a tuple, against its manual."""
    try:
        loop.copy_from_face_interp(face, False, False)
    except TypeError:
        loop.copy_from_face_interp((face, False, False))


def cut_mesh(mesh: bpy.types.Mesh, cut: Cut, places: np.ndarray) -> None:
    """Cuts a mesh in place. Vertices keep their numbers and new ones follow; polygons that stay keep
    their order and the new triangles follow. `places`: (V + k, 3)."""
    bm = bmesh.new()
    try:
        bm.from_mesh(mesh)
        faces = list(bm.faces)
        verts = list(bm.verts) + [None] * len(cut.new_corners)
        _split_edges(bm, cut, verts, places)
        pieces = _Pieces(bm, verts)
        _add_inner(bm, cut, verts, places, faces, pieces)
        of_loop = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", of_loop)
        loops = {}
        for polygon, corners, around in zip(cut.polygons, cut.vertices, of_loop[cut.loops]):
            old = faces[polygon]
            if polygon not in loops:
                loops[polygon] = {loop.vert: loop for loop in old.loops}
            made = bm.faces.new([verts[v] for v in corners], old)
            for loop in made.loops:
                known = loops[polygon].get(loop.vert)
                if known is not None:
                    loop.copy_from(known)
                else:
                    _interpolate(loop, pieces.face(old, around))
        pieces.remove()
        for polygon in loops:
            bm.faces.remove(faces[polygon])
        for number in range(len(verts) - len(cut.new_corners), len(verts)):
            verts[number].index = number
        bm.verts.sort()
        bm.to_mesh(mesh)
    finally:
        bm.free()
    mesh.update()
