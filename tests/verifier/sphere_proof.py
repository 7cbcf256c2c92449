"""Is a map onto the sphere one-to-one? By the theorem that opens sphere/certificate.cpp, in whole numbers."""

import random

from exact import determinant, reduced, whole
from surface import Refused, require_sphere


def cones_with(ray, rays, triangles):
    """How many open cones hold the ray; None where it meets the side of one."""
    count = 0
    for a, b, c in triangles:
        signs = [determinant(ray, rays[i], rays[j]) for i, j in ((b, c), (c, a), (a, b))]
        if min(signs) > 0:
            count += 1
        elif min(signs) == 0 and max(signs) >= 0:
            return None
    return count


def degree(rays, triangles):
    """How often the sphere is covered: some generic ray tells, as all triangles are positive."""
    numbers = random.Random(2006)
    while True:
        ray = tuple(numbers.randint(-10**6, 10**6) for _ in range(3))
        count = cones_with(ray, rays, triangles)
        if count is not None:
            return count


def prove_map(rays, triangles):
    """Throws Refused unless the rays of the vertices are a one-to-one map onto the sphere."""
    require_sphere(triangles, len(rays))
    rays = [reduced(ray) for ray in whole(rays)]
    folded = [face for face, (a, b, c) in enumerate(triangles)
              if determinant(rays[a], rays[b], rays[c]) <= 0]
    if folded:
        raise Refused(f"{len(folded)} triangles are not positive, the first is {folded[0]}")
    covered = degree(rays, triangles)
    if covered != 1:
        raise Refused(f"the sphere is covered {covered} times")
