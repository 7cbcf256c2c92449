"""What a list of triangles is, by counting: closed, oriented, a manifold, one piece, of genus 0."""


class Refused(Exception):
    """What is not as it must be, and where."""


def opposite_faces(triangles):
    """The directed edges and the face of each; every one has its opposite, once."""
    face_of = {}
    for face, (a, b, c) in enumerate(triangles):
        for edge in ((a, b), (b, c), (c, a)):
            if edge[0] == edge[1]:
                raise Refused(f"face {face} has vertex {edge[0]} twice")
            if edge in face_of:
                raise Refused(f"the edge {edge} runs the same way in faces {face_of[edge]} and {face}")
            face_of[edge] = face
    for a, b in face_of:
        if (b, a) not in face_of:
            raise Refused(f"the edge {(a, b)} has one face")
    return face_of


def require_one_ring_each(triangles, count):
    """At each vertex the faces are one cycle; every vertex has some."""
    after = [{} for _ in range(count)]
    for a, b, c in triangles:
        after[a][b], after[b][c], after[c][a] = c, a, b
    for vertex, next_of in enumerate(after):
        if not next_of:
            raise Refused(f"vertex {vertex} has no face")
        first = at = next(iter(next_of))
        steps = 0
        while steps == 0 or at != first:
            at, steps = next_of[at], steps + 1
        if steps != len(next_of):
            raise Refused(f"vertex {vertex} has {len(next_of)} faces, of which {steps} are one ring")


def require_one_piece(face_of, triangles):
    seen, todo = {0}, [0]
    while todo:
        a, b, c = triangles[todo.pop()]
        for edge in ((b, a), (c, b), (a, c)):
            other = face_of[edge]
            if other not in seen:
                seen.add(other)
                todo.append(other)
    if len(seen) != len(triangles):
        raise Refused(f"{len(triangles)} faces, of which {len(seen)} hang together")


def require_sphere(triangles, count):
    """Returns the faces of directed edges. Throws Refused for what is no triangulated sphere."""
    if not triangles:
        raise Refused("no faces")
    face_of = opposite_faces(triangles)
    require_one_ring_each(triangles, count)
    require_one_piece(face_of, triangles)
    euler = count - len(face_of) // 2 + len(triangles)
    if euler != 2:
        raise Refused(f"Euler characteristic {euler}, that of a sphere is 2")
    return face_of
