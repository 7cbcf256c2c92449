"""A program of a user's, for mypy --strict; it is never run."""

from typing import Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt
import sphparam as sp

Floats = npt.NDArray[np.float64]


def told(stage: str, fraction: float) -> Optional[bool]:
    return fraction < 0.5


def mesh_of(m: sp.SphereMap) -> sp.Mesh:
    return m.mesh


def use(vertices: Floats, faces: npt.NDArray[np.int64]) -> None:
    m: sp.SphereMap = sp.map(vertices, faces, balance="equal-area", pins={3: (0.0, 1.0)}, progress=told)
    again: sp.SphereMap = sp.map(m.mesh, repair={"largest_hole": 40}, threads=2)
    points: Floats = m.points
    one: bool = m.certificate.one_to_one
    mean: float = m.distortion.mean_abs_ln_area
    ratios: Floats = m.face_distortion.area_ratio
    stage: str = m.stages[0].name
    poles: Optional[Tuple[int, int]] = m.poles
    carried: Dict[str, npt.NDArray[np.generic]] = dict(m.values)
    face, weights = m.locate(points)
    image: sp.BakedImage = m.bake("normal-object", size=512)
    picture: npt.NDArray[np.uint8] = image.picture()
    low = m.remesh("ico:6", transfer=["sulc"])
    written: List[str] = m.export("statue.glb", texture=image, levels=[low])
    baked: Tuple[sp.BakedFile, ...] = m.bake_files({"ao": "ao.png"}, target=low)
    fit: sp.SubdivisionFit = m.fit("cube:32", scheme="catmark")
    lack: sp.Displacement = fit.displace("d.exr", size=(256, 128))
    shape: sp.Harmonics = m.spharm(20, values=["sulc"])
    values: Floats = shape(points)
    chart: sp.Chart = m.chart()
    uv: Floats = chart.uv
    distance: sp.Distance = sp.measure(m, (vertices, faces))
    rms: float = distance.forth.rms
    side: Optional[sp.Deviation] = sp.measure(m, mesh_of(m), signed=True).forth.deviation
    sides: Optional[Floats] = side.at_vertices if side else distance.forth.at_vertices
    radius: float = m.spharm(20, radius=True, centre=(0, 0, 1)).reference_radius
    places: sp.Landmarks = sp.group([m, low]).landmarks([3, 4])
    mended: sp.Mesh = sp.repair(vertices, faces, handle_choice="cut")
    found: sp.Inspection = sp.inspect(mended)
    proof: sp.Certificate = sp.verify("statue.sph.ply")
    hard: sp.Mesh = mended.creased(30)
    normals: Optional[Floats] = hard.corner_normals
    parts: List[sp.Mesh] = sp.components(vertices, faces, repair=True)
    open_map: sp.SphereMap = sp.map(parts[0], repair={"keep_holes": True}, filler_share=0.1, align="body")
    marks: npt.NDArray[np.bool_] = open_map.fillers
    surface: sp.Mesh = open_map.surface
    radial: Optional[sp.Radial] = sp.map(surface, method="radial", centre=(0, 0, 1)).radial
    where: str = open_map.bake("elevation", body="vesta", unit="km").convention
    open_map.save("open.obj", holes="drop")
    print(marks, radial, where, normals, sides, radius, places.points, sp.read("a.ply", limits={"vertices": 1000}))
    page: str = m.show()
    print(again, one, mean, ratios, stage, poles, carried, face, weights, picture, written, baked, lack)
    print(values, uv, rms, found, proof, page, sp.fields(), sp.__version__)


def refused(vertices: Floats, faces: npt.NDArray[np.int64]) -> List[str]:
    try:
        sp.map(vertices, faces)
    except sp.MeshError as error:
        return [defect.message for defect in error.defects]
    except sp.NotCertified as error:
        return [error.certificate.verdict if error.certificate else str(error)]
    return []
