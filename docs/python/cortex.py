"""A cortex and its labels: proved maps, resampling that never mixes labels, other people's spheres.

Run it where `make_samples . cortex` has written cortex.ply.
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import sphparam as sp
from mpl_toolkits.mplot3d.art3d import Poly3DCollection


def shaded(vertices, polygons, colours):
    """Polygons for matplotlib, in colours (k, 3) that are darker where they face away from the light."""
    corners = [vertices[polygon] for polygon in polygons]
    across = np.array([np.cross(c[1] - c[0], c[-1] - c[0]) for c in corners])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    light = 0.62 + 0.38 * across @ [0.3, -0.6, 0.74]
    lit = np.clip(colours * light[:, None], 0, 1)
    return Poly3DCollection(corners, facecolors=lit, edgecolors=lit, linewidths=0.4)


def show(axis, vertices, polygons, colours):
    """Draws them in a box of the shape of the mesh."""
    axis.add_collection3d(shaded(vertices, polygons, colours))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axis.set_box_aspect(high - low, zoom=1.5)
    axis.set_axis_off()


cortex = sp.read("cortex.ply")
m = sp.map(cortex)
print(m, "carries", ", ".join(m.values))

# The sphere as FreeSurfer and Workbench read it, and a proof of what was written.
m.save_sphere("cortex.sphere.gii")
print("sphere:", sp.verify("cortex.ply", points="cortex.sphere.gii").verdict)
again = sp.load("cortex.ply", sphere="cortex.sphere.gii")

# All subjects on one grid: positions and colours are interpolated, whole numbers are labels.
grid = again.remesh("ico:5")
lobes = grid.values["lobe"]
print(len(grid.vertices), "vertices; labels", np.unique(lobes))
assert set(lobes) == set(cortex.values["lobe"])

# A measure of one's own, carried the same way.
depth = np.linalg.norm(m.vertices - m.vertices.mean(axis=0), axis=1)
on_grid = again.resample(depth, grid.points)
print("mean depth by lobe", [float(on_grid[lobes == k].mean().round(2)) for k in np.unique(lobes)])

# One colour a face: that of the label of its first corner.
colours = plt.get_cmap("Set2")(lobes[grid.faces[:, 0]] - 1)[:, :3]
figure = plt.figure(figsize=(6.4, 2.9), layout="constrained")
for place, points, title in ((1, grid.vertices, "surface"), (2, grid.points, "sphere")):
    axis = figure.add_subplot(1, 2, place, projection="3d", title=title)
    show(axis, points, grid.faces, colours)
    axis.view_init(25, -60)
figure.savefig("python_cortex.png", dpi=56)
