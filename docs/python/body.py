"""The maps of a small body: heights by longitude and latitude, a HEALPix table, harmonics.

Run it where `make_samples . body` has written body.ply.
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import sphparam as sp

# θ and π/2 − ϕ are planetocentric longitude and latitude, exactly where nothing folds.
m = sp.map(sp.read("body.ply"), method="radial")
print(m, "folds:", m.radial.folds)

# Heights as an array: longitude −180° to 180°, north above.
height = m.bake("height", size=720, convention="gis", height_radial=True)
print(f"{height.about}: {height.min():.3f} to {height.max():.3f}")

# The value at any direction, and where on the surface it is.
directions = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
radius = np.linalg.norm(m.vertices, axis=1)
face, weights = m.locate(directions)
print("faces", face, "radii", m.resample(radius, directions).round(3))

# Equal areas of the sphere: one row a pixel of HEALPix, in RING order.
pixels = m.remesh("healpix:16")
np.savetxt("healpix16.csv", np.c_[pixels.points, pixels.vertices], delimiter=",")

# The shape as a sum of spherical harmonics.
shape = m.spharm(24)
print(f"degree {shape.degree}: RMS {100 * shape.rms / shape.diagonal:.2f} % of the diagonal")
assert shape.rms < 0.01 * shape.diagonal

figure, (left, right) = plt.subplots(1, 2, figsize=(8, 2.9), layout="constrained", width_ratios=(2, 1))
shown = left.imshow(height[:, :, 0], extent=(-180, 180, -90, 90), cmap="terrain")
left.set_xlabel("longitude"), left.set_ylabel("latitude")
figure.colorbar(shown, ax=left, label="distance from the centre")
right.semilogy(np.arange(1, 25), shape.power[1:, :3].sum(axis=1), ".-")
right.set_xlabel("degree"), right.set_title("power", fontsize=10)
figure.savefig("python_body.png", dpi=70)
