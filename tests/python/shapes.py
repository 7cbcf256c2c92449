"""Meshes that tests are made of."""

import numpy as np


def octahedron():
    vertices = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    faces = np.array(
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    )
    return vertices, faces


def halved(vertices, faces):
    """Each edge halved, the middles on the sphere."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    pairs, place = np.unique(edges, axis=0, return_inverse=True)
    middles = vertices[pairs].mean(axis=1)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    a, b, c = faces.T
    ab, bc, ca = (place.reshape(-1) + len(vertices)).reshape(3, -1)
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([vertices, middles]), np.concatenate([np.stack(p, 1) for p in parts])


def sphere(times):
    """4^times · 8 triangles on the unit sphere."""
    mesh = octahedron()
    for _ in range(times):
        mesh = halved(*mesh)
    return mesh


def potato(times=4):
    """A closed surface that is no sphere, with bumps and a waist; its vertices and faces."""
    vertices, faces = sphere(times)
    x, y, z = vertices.T
    radius = 1 + 0.25 * np.sin(3 * x + 1) * np.cos(4 * y) + 0.3 * z**2
    return vertices * radius[:, None] * [1.0, 0.8, 1.4], faces


def torus(n=12):
    """Genus 1."""
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a, b = 2 * np.pi * i / n, 2 * np.pi * j / n
    vertices = np.stack([(2 + np.cos(b)) * np.cos(a), (2 + np.cos(b)) * np.sin(a), np.sin(b)], -1).reshape(-1, 3)
    p, q = i * n + j, (i + 1) % n * n + j
    r, s = (i + 1) % n * n + (j + 1) % n, i * n + (j + 1) % n
    faces = np.concatenate([np.stack([p, q, r], -1).reshape(-1, 3), np.stack([p, r, s], -1).reshape(-1, 3)])
    return vertices, faces
