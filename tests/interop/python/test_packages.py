"""Meshes of the packages that Debian has: theirs to us, ours to them, and through the files of both."""

import importlib.util
import os
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "python"))
import sphparam as sp
from shapes import potato

V, F = potato(4)
single = V.astype(np.float32)


@pytest.fixture(scope="module")
def mapped():
    return sp.map(V, F, values={"sulc": V[:, 0], "label": (V[:, 2] > 0).astype(np.int32)})


def test_all_packages_are_there():
    for name in ("nibabel", "meshio", "vtk", "open3d", "matplotlib", "nbconvert", "ipykernel"):
        assert importlib.util.find_spec(name), f"tests/interop/python/packages names {name}'s package"


# nibabel


def gifti(nibabel, vertices, faces):
    arrays = [
        nibabel.gifti.GiftiDataArray(vertices.astype(np.float32), intent="NIFTI_INTENT_POINTSET"),
        nibabel.gifti.GiftiDataArray(faces.astype(np.int32), intent="NIFTI_INTENT_TRIANGLE"),
    ]
    return nibabel.gifti.GiftiImage(darrays=arrays)


def test_nibabel_images_are_mapped(mapped):
    nibabel = pytest.importorskip("nibabel")
    made = sp.map(gifti(nibabel, V, F))
    assert (made.vertices == single).all() and (made.faces == F).all()


def test_other_arrays_of_nibabel_are_told():
    nibabel = pytest.importorskip("nibabel")
    image = gifti(nibabel, V, F)
    image.add_gifti_data_array(nibabel.gifti.GiftiDataArray(single[:, 0], intent="NIFTI_INTENT_SHAPE"))
    with pytest.warns(sp.LossWarning, match="arrays that are neither pointset nor triangle: 1"):
        sp.map(image)


def test_nibabel_and_we_read_the_same_gifti(tmp_path):
    nibabel = pytest.importorskip("nibabel")
    nibabel.save(gifti(nibabel, V, F), str(tmp_path / "lh.surf.gii"))
    ours, theirs = sp.read(tmp_path / "lh.surf.gii"), nibabel.load(str(tmp_path / "lh.surf.gii"))
    assert (ours.vertices == theirs.agg_data("pointset")).all()
    assert (ours.faces == theirs.agg_data("triangle")).all()


def test_nibabel_reads_our_spheres_and_meshes(mapped, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    mapped.save_sphere(tmp_path / "lh.sphere.gii")
    sp.write(tmp_path / "lh.white.gii", V, F)
    sphere = nibabel.load(str(tmp_path / "lh.sphere.gii"))
    assert np.allclose(sphere.agg_data("pointset") / 100, mapped.points, atol=1e-6)
    made = sp.with_sphere(nibabel.load(str(tmp_path / "lh.white.gii")), sphere.agg_data("pointset"))
    assert made.certificate.one_to_one


def test_freesurfers_geometry_is_mapped_big_endian_as_it_is(mapped, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    nibabel.freesurfer.write_geometry(str(tmp_path / "lh.white"), V, F)
    geometry = nibabel.freesurfer.read_geometry(str(tmp_path / "lh.white"))
    assert geometry[1].dtype.byteorder == ">"
    made = sp.map(geometry)
    assert (made.faces == F).all() and np.allclose(made.vertices, V, atol=1e-5)
    assert (made.points == sp.map(*geometry).points).all()


def test_morphometry_is_resampled(mapped, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    nibabel.freesurfer.write_morph_data(str(tmp_path / "lh.sulc"), V[:, 0])
    sulc = nibabel.freesurfer.read_morph_data(str(tmp_path / "lh.sulc"))
    assert sulc.dtype.byteorder == ">" or sulc.dtype.kind == "f"
    grid = mapped.remesh("ico:3")
    assert np.allclose(mapped.resample(sulc, grid.points), grid.values["sulc"], atol=1e-6)
    assert sp.map(V, F, values={"sulc": sulc}).values["sulc"].shape == (len(V),)


# meshio


@pytest.mark.parametrize("name", ["a.vtk", "a.ply", "a.obj", "a.off", "a.stl", "a.vtu"])
def test_what_meshio_reads_is_mapped(name, mapped, tmp_path):
    meshio = pytest.importorskip("meshio")
    meshio.write(tmp_path / name, meshio.Mesh(V, [("triangle", F)]))
    read = meshio.read(tmp_path / name)
    if name == "a.stl":  # three vertices a triangle
        sp.write(tmp_path / "b.ply", sp.read(tmp_path / name))
        read = meshio.read(tmp_path / "b.ply")
    made = sp.map(read)
    assert len(made.faces) == len(F) and made.certificate.one_to_one


def test_meshios_point_data_come_along(mapped):
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(V, [("triangle", F)], point_data={"sulc": V[:, 0], "normals": V, "label": F[: len(V), 0]})
    made = sp.map(mesh)
    assert (made.points == mapped.points).all() and set(made.values) == {"sulc", "normal", "label"}
    assert (made.values["sulc"] == V[:, 0]).all()


@pytest.mark.parametrize("name", ["a.ply", "a.obj", "a.off"])
def test_meshio_reads_what_we_write(name, mapped, tmp_path):
    meshio = pytest.importorskip("meshio")
    mapped.save(tmp_path / name)
    read = meshio.read(tmp_path / name)
    assert np.allclose(read.points, V) and (read.cells_dict["triangle"] == F).all()
    if name == "a.ply":
        assert np.allclose(np.stack([read.point_data[k] for k in ("sx", "sy", "sz")], 1), mapped.points)
        assert np.allclose(read.point_data["sulc"], V[:, 0])


def test_results_go_back_to_meshio(mapped, tmp_path):
    meshio = pytest.importorskip("meshio")
    low = mapped.remesh("ico:3")
    meshio.Mesh(low.vertices, [("triangle", low.faces)], point_data=low.values).write(tmp_path / "low.vtk")
    assert (sp.map(meshio.read(tmp_path / "low.vtk")).faces == low.faces).all()


def test_what_meshio_has_besides_comes_along_or_is_told():
    meshio = pytest.importorskip("meshio")
    mesh = meshio.Mesh(
        V, [("triangle", F), ("line", F[:4, :2])], field_data={"lobe": np.array([1, 2])},
        cell_data={"part": [np.arange(len(F)), np.arange(4)]},
    )  # fmt: skip
    with pytest.warns(sp.LossWarning) as caught:
        made = sp.map(mesh)
    assert (made.face_values["part"] == np.arange(len(F))).all()
    told = "\n".join(str(w.message) for w in caught)
    assert "line cells: 4" in told and "field_data: lobe" in told and len(caught) == 2
    assert {w.filename for w in caught} == {__file__}


def test_quads_of_meshio_are_refused():
    meshio = pytest.importorskip("meshio")
    with pytest.raises(ValueError, match="quad"):
        sp.map(meshio.Mesh(V, [("triangle", F), ("quad", F[:1][:, [0, 1, 2, 0]])]))


# VTK


def poly_data(vtk, vertices, faces):
    from vtk.util import numpy_support

    points, cells, mesh = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    points.SetData(numpy_support.numpy_to_vtk(vertices, deep=True))
    rows = np.c_[np.full(len(faces), 3), faces].astype(np.int64).ravel()
    cells.SetCells(len(faces), numpy_support.numpy_to_vtkIdTypeArray(rows, deep=True))
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    sulc = numpy_support.numpy_to_vtk(np.ascontiguousarray(vertices[:, 0]), deep=True)
    sulc.SetName("sulc")
    mesh.GetPointData().AddArray(sulc)
    return mesh


@pytest.mark.parametrize("kind", [np.float64, np.float32])
def test_vtk_poly_data_is_mapped(kind, mapped):
    vtk = pytest.importorskip("vtk")
    made = sp.map(poly_data(vtk, V.astype(kind), F))
    assert (made.vertices == V.astype(kind)).all() and (made.faces == F).all()
    assert (made.values["sulc"] == V[:, 0].astype(kind)).all()


def test_cell_data_of_vtk_come_along_and_lines_are_told():
    vtk = pytest.importorskip("vtk")
    from vtk.util import numpy_support

    mesh = poly_data(vtk, V, F)
    part = numpy_support.numpy_to_vtk(np.arange(len(F)), deep=True)
    part.SetName("part")
    mesh.GetCellData().AddArray(part)
    assert (sp.map(mesh).face_values["part"] == np.arange(len(F))).all()
    lines = vtk.vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    mesh.SetLines(lines)
    with pytest.warns(sp.LossWarning) as caught:
        made = sp.map(mesh)
    told = [str(w.message) for w in caught]
    assert told == ["not carried: lines: 1", "not carried: cell data: part"] and made.face_values == {}


def test_sources_of_vtk_are_mapped():
    vtk = pytest.importorskip("vtk")
    source = vtk.vtkSphereSource()
    source.SetThetaResolution(40)
    source.SetPhiResolution(20)
    source.Update()
    made = sp.map(source.GetOutput())
    assert made.certificate.one_to_one and "normal" in made.values


def test_polygons_and_strips_of_vtk_are_refused():
    vtk = pytest.importorskip("vtk")
    cube = vtk.vtkCubeSource()
    cube.Update()
    with pytest.raises(ValueError, match="vtkTriangleFilter"):
        sp.map(cube.GetOutput())
    stripper = vtk.vtkStripper()
    stripper.SetInputData(poly_data(vtk, V, F))
    stripper.Update()
    with pytest.raises(ValueError, match="strips"):
        sp.map(stripper.GetOutput())


def test_vtk_reads_our_files(mapped, tmp_path):
    vtk = pytest.importorskip("vtk")
    mapped.save(tmp_path / "a.sph.ply")
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(tmp_path / "a.sph.ply"))
    reader.Update()
    assert reader.GetOutput().GetNumberOfPoints() == len(V)
    assert (sp.map(reader.GetOutput()).faces == F).all()


# Open3D


def test_open3d_meshes_are_mapped(mapped):
    open3d = pytest.importorskip("open3d")
    mesh = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(V), open3d.utility.Vector3iVector(F.astype(np.int32))
    )
    mesh.paint_uniform_color([0.2, 0.4, 0.6])
    made = sp.map(mesh)
    assert (made.points == mapped.points).all() and made.values["color"].shape == (len(V), 3)
    assert np.allclose(made.values["color"], (0.2, 0.4, 0.6), atol=1e-6)


def test_normals_of_open3d_come_along():
    open3d = pytest.importorskip("open3d")
    mesh = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(V), open3d.utility.Vector3iVector(F.astype(np.int32))
    )
    mesh.compute_vertex_normals()
    assert np.allclose(sp.map(mesh).values["normal"], np.asarray(mesh.vertex_normals))


def test_results_go_back_to_open3d(mapped, tmp_path):
    open3d = pytest.importorskip("open3d")
    low = mapped.remesh("ico:3")
    mesh = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(low.vertices.copy()), open3d.utility.Vector3iVector(low.faces.copy())
    )
    assert mesh.is_watertight() and mesh.is_orientable()
    open3d.io.write_triangle_mesh(str(tmp_path / "low.ply"), mesh)
    assert (sp.read(tmp_path / "low.ply").vertices == low.vertices).all()
    mapped.save(tmp_path / "a.sph.ply")
    assert len(open3d.io.read_triangle_mesh(str(tmp_path / "a.sph.ply")).triangles) == len(F)


# Notebooks


def test_a_notebook_shows_a_map_and_nothing_of_the_bar(tmp_path):
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    execute = pytest.importorskip("nbconvert.preprocessors").ExecutePreprocessor
    cells = [
        f"import sys; sys.path.insert(0, {str(pathlib.Path(__file__).parents[2] / 'python')!r})\n"
        "import shapes, sphparam as sp\nfrom sphparam import _progress\n_progress.Bar.patience = 0",
        "m = sp.map(*shapes.potato(7))",
        "m",
    ]
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    execute(timeout=120, kernel_name="python3").preprocess(book, {"metadata": {"path": str(tmp_path)}})
    _, mapping, shown = book.cells
    [bar] = mapping.outputs  # its cell, empty in the end; nothing on the streams
    assert bar.output_type == "display_data" and bar.data["text/html"] == ""
    [table] = shown.outputs
    assert "one-to-one" in table.data["text/html"] and len(table.data["text/html"]) <= 200_000


# matplotlib


def test_images_and_surfaces_are_drawn(mapped, tmp_path):
    pytest.importorskip("matplotlib")
    import matplotlib.pyplot as plt

    image = mapped.bake("normal-object", size=64)
    figure = plt.figure()
    figure.add_subplot(131).imshow(image.picture())
    figure.add_subplot(132).imshow(mapped.bake("curvature:mean", size=64)[:, :, 0], cmap="viridis")
    axis = figure.add_subplot(133, projection="3d")
    axis.plot_trisurf(*mapped.vertices.T, triangles=mapped.faces)
    figure.savefig(tmp_path / "a.png")
    plt.close(figure)
    assert os.path.getsize(tmp_path / "a.png") > 10_000
    painted = mapped.paint(plt.imread(tmp_path / "a.png")[:200, :400])
    assert painted.shape[0] == len(V) and painted.dtype == np.uint8
