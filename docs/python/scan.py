"""From a scan with holes to a game asset: repair, map, a light mesh, its textures, a .glb.

Run it where `make_samples . creature` has written creature.ply.
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import sphparam as sp

# A scan: the sample creature, of which a dozen triangles are missing.
creature = sp.read("creature.ply")
scan = sp.Mesh(creature.vertices, creature.faces[12:], values=creature.values)
print(sp.inspect(scan).defects[0].message)

# Mended and mapped; area weighs more than by default, as a light mesh comes next.
m = sp.map(scan, repair=True, balance=sp.remeshing_lambda)
print(m.certificate.verdict, "after:", "; ".join(action.message for action in m.repairs))

low = m.remesh("ico:4")
distance = sp.measure(m, low)
share = distance.rms / distance.diagonal
print(f"{len(low.vertices)} vertices instead of {len(m.vertices)}: RMS {100 * share:.2f} % of the diagonal")
assert share < 0.005

# The detail of the scan as textures of the light mesh.
colour = m.bake("basecolor", size=1024, target=low)
normals = m.bake("normal-tangent", size=1024, target=low)
occlusion = m.bake("ao", size=1024, target=low)
low.export("creature.glb", texture=colour, normal_map=normals, occlusion_map=occlusion)

figure, axes = plt.subplots(1, 3, figsize=(9, 2.1), layout="constrained")
for axis, image in zip(axes, (colour, normals, occlusion)):
    axis.imshow(image.picture(), extent=(0, 360, 180, 0))
    axis.set_title(image.field, fontsize=9)
    axis.set_xticks(range(0, 361, 90)), axis.set_yticks(range(0, 181, 90))
    axis.tick_params(labelsize=7)
figure.savefig("python_scan.png", dpi=56)
