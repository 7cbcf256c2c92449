"""The six sides of a cube grid as one image, for displacement.

Texture coordinates run straight over every quad of a control mesh when it is subdivided, directions do
not. So the image has the quads themselves: six squares below one another, +x −x +y −y +z −z, each seen
from outside, as sphparam's geometry images have them. A square has `steps` texels from one control point
to the next, its first and last texel at its border; where the subdivided mesh has a vertex, the image
has the middle of a texel.
"""

from typing import Tuple

import numpy as np

from .refusal import Refusal

_most = 2**24  # texels: each takes half a kilobyte while Blender subdivides, so that these take 8 GB
_texels_a_step = 2  # of sphparam's image, to one edge of the subdivided mesh at the equator
_widest = 8192
_normals = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
_rights = np.array([[0, 1, 0], [0, -1, 0], [-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]])
_ups = np.array([[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1], [-1, 0, 0], [1, 0, 0]])


def size_of(edges: int, steps: int) -> Tuple[int, int]:
    """Width and height of the image."""
    return edges * steps + 1, 6 * (edges * steps + 1)


def _fits(edges: int, level: int) -> bool:
    width, height = size_of(edges, 2**level)
    return width * height <= _most


def require_size(edges: int, levels: int) -> None:
    """Raises Refusal where the image for so many levels of subdivision would be too large to be made."""
    if _fits(edges, levels):
        return
    width, height = size_of(edges, 2**levels)
    most = max((level for level in range(levels) if _fits(edges, level)), default=0)
    raise Refusal(
        f"{edges} edges and {levels} levels need an image of {width} × {height} texels, and {_most:,} texels are the "
        f"most: Levels {most} or fewer Edges"
    )


def source_width(edges: int, levels: int) -> Tuple[int, str]:
    """Of the equirectangular image that this one is resampled from; and, where that is less than the levels
    could show, words that say so, to be put after others."""
    wanted = _texels_a_step * 4 * edges * 2**levels
    if wanted <= _widest:
        return wanted, ""
    return _widest, f"; read from {_widest} × {_widest // 2} texels, these levels could show {wanted} × {wanted // 2}"


class CubeLayout:
    """Of a control mesh on `cube:edges`. Requires: (Q, 4) quads and the directions of their vertices."""

    def __init__(self, quads: np.ndarray, directions: np.ndarray, edges: int, steps: int):
        self.side = size_of(edges, steps)[0]
        """Texels of a side of a square."""
        corners = directions[quads]
        self._square = (corners.sum(axis=1) @ _normals.T).argmax(axis=1)
        depth = np.einsum("qkx,qx->qk", corners, _normals[self._square])
        places = []
        for axes in (_rights, _ups):
            tangent = np.einsum("qkx,qx->qk", corners, axes[self._square]) / depth
            places.append(np.rint((np.arctan(tangent) / (np.pi / 4) + 1) / 2 * edges).astype(np.int64) * steps)
        self.columns, up = places
        """(Q, 4) texel of each corner …"""
        self.rows = self._square[:, None] * self.side + (self.side - 1 - up)
        """… and its row, from the top."""

    @property
    def size(self) -> Tuple[int, int]:
        """Width and height of the image."""
        return self.side, 6 * self.side

    def uv(self) -> np.ndarray:
        """(Q, 4, 2) middles of these texels, v upwards."""
        width, height = self.size
        return np.stack([(self.columns + 0.5) / width, 1 - (self.rows + 0.5) / height], axis=2)

    def image(self, uv: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(height, width), the top row first: values at (n, 2) middles of texels, which are all of them."""
        width, height = self.size
        table = np.full((height, width), np.nan, np.float32)
        columns = np.rint(uv[:, 0] * width - 0.5).astype(np.int64)
        rows = np.rint((1 - uv[:, 1]) * height - 0.5).astype(np.int64)
        table[rows, columns] = values
        return table


def equirectangular(image: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """(n,) what an image (H, W), the north pole above, has in directions (n, 3): bilinear between the
    middles of texels, around, and on beyond a pole half a turn away, as sphparam looks it up."""
    height, width = image.shape
    lengths = np.linalg.norm(directions, axis=1)
    theta = np.arctan2(directions[:, 1], directions[:, 0]) % (2 * np.pi)
    phi = np.arccos(np.clip(directions[:, 2] / lengths, -1, 1))
    x, y = theta / (2 * np.pi) * width - 0.5, phi / np.pi * height - 0.5
    left, top = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)

    def texel(column, row):
        beyond = (row < 0) | (row >= height)
        column = np.where(beyond, column + width // 2, column) % width
        row = np.where(row < 0, -1 - row, np.where(row >= height, 2 * height - 1 - row, row))
        return image[row, column].astype(np.float64)

    def mean(row):
        return (1 - (x - left)) * texel(left, row) + (x - left) * texel(left + 1, row)

    return (1 - (y - top)) * mean(top) + (y - top) * mean(top + 1)
