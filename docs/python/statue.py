"""From a statue to a control mesh and displacement: quads to subdivide, and an image of what they lack.

Run it where `make_samples . creature` has written creature.ply.
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
    axis.set_box_aspect(high - low, zoom=1.2)
    axis.set_axis_off()


m = sp.map(sp.read("creature.ply"), balance=sp.remeshing_lambda)

# A Catmull-Clark surface on 1,536 quads, nearest to the statue in the sense of least squares.
fit = m.fit("cube:16", scheme="catmark")
diagonal = sp.measure(m, m, samples=1000).diagonal
print(f"{fit}: {100 * fit.two_sided_rms / diagonal:.2f} % of the diagonal, flat {100 * fit.flat_rms / diagonal:.2f} %")
# The quads, for any modelling program; a warning tells that .obj has no room for the curvatures they carry.
fit.textured_control(size=(1024, 512)).save("control.obj")

# What the surface lacks, along its normals, and a proof: surface and image together, measured.
written = fit.displace("lack.exr", size=(1024, 512), layout="grid", rebuilt="rebuilt.ply")
print(f"displacement {written.least:.3f} to {written.greatest:.3f}, RMS {written.base_rms:.4f} → {written.rebuilt_rms:.4f}")
assert written.rebuilt_rms < written.base_rms

# Levels of detail in one file.
levels = m.levels(3)
m.export("statue.glb", levels=levels, variants=["checker"])
print("levels of", [len(level.faces) for level in levels], "triangles")

vertices, faces = fit.fine_mesh(20_000)
stone = np.array([[0.82, 0.75, 0.62]])
figure = plt.figure(figsize=(8, 3.4), layout="constrained")
left = figure.add_subplot(1, 2, 1, projection="3d", title="1,536 quads of the control mesh")
show(left, fit.control.vertices, fit.control.polygons, stone)
right = figure.add_subplot(1, 2, 2, projection="3d", title="the surface they stand for")
show(right, vertices, faces, stone)
for axis in (left, right):
    axis.view_init(15, -70)
figure.savefig("python_statue.png", dpi=64)
