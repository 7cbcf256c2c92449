"""All that is public has its types and says what it is; the page of the documents names it."""

import ast
import compileall
import inspect
import os
import pathlib
import pydoc
import re
import shutil
import subprocess
import sys
import typing

import numpy as np
import pytest

import sphparam as sp
from shapes import sphere

package = pathlib.Path(os.path.realpath(sp.__file__)).parent
page = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "python.md").read_text()
modules = [ast.parse(file.read_text()) for file in package.glob("*.py")]


def classes():
    return {node.name: node for tree in modules for node in tree.body if isinstance(node, ast.ClassDef)}


def functions():
    return {node.name: node for tree in modules for node in tree.body if isinstance(node, ast.FunctionDef)}


def parts_of(thing):
    """The bodies of a class and of those of the package that it is made of."""
    nodes = [classes()[base.__name__] for base in thing.__mro__ if base.__name__ in classes()]
    return [part for node in nodes for part in node.body]


def is_public(name):
    return not name.startswith("_") or name in ("__init__", "__call__")


def assert_typed(function, where):
    taken = function.args.posonlyargs + function.args.args + function.args.kwonlyargs
    for argument in taken:
        assert argument.annotation is not None or argument.arg in ("self", "cls"), f"{where}: {argument.arg}"
    assert function.returns is not None, where


def said_after(body):
    """Names that are declared in a body, with whether a text follows them."""
    for node, following in zip(body, [*body[1:], None]):
        if not isinstance(node, ast.AnnAssign):
            continue
        target = node.target.attr if isinstance(node.target, ast.Attribute) else node.target.id
        text = isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant)
        yield target, text and isinstance(following.value.value, str)


def test_everything_that_is_named_is_there():
    assert len(sp.__all__) == len(set(sp.__all__)) >= 39
    assert [getattr(sp, name) for name in sp.__all__]
    with pytest.raises(AttributeError, match="no attribute 'tutte'"):
        sp.tutte


@pytest.mark.parametrize("name", sp.__all__)
def test_a_public_name_is_typed_and_documented(name):
    if name == "remeshing_lambda":
        return
    thing = getattr(sp, name)
    assert inspect.getdoc(thing) and thing.__doc__
    if name in functions():
        assert_typed(functions()[name], name)
        return
    node = classes()[name]
    for part in parts_of(thing):
        if isinstance(part, ast.FunctionDef) and is_public(part.name):
            assert_typed(part, f"{name}.{part.name}")
            assert ast.get_docstring(part) or part.name == "__init__", f"{name}.{part.name} says nothing"
    if issubclass(thing, tuple) or thing.__module__ in ("sphparam._chart", "sphparam._harmonics"):
        holder = node if issubclass(thing, tuple) else next(p for p in node.body if getattr(p, "name", "") == "__init__")
        declared = dict(said_after(holder.body))
        assert len(declared) >= 4 and all(declared.values()), declared


@pytest.mark.parametrize("name", ["Chart", "Group", "Harmonics", "SurfaceMap", *(n for n in sp.__all__ if hasattr(getattr(sp, n), "_fields"))])
def test_help_says_what_fields_and_attributes_are(name):
    thing, text = getattr(sp, name), pydoc.plaintext.document(getattr(sp, name))
    assert "Alias for field" not in text
    bodies = [classes()[name].body, *(p.body for p in classes()[name].body if getattr(p, "name", "") == "__init__")]
    declared = [target for body in bodies for target, said in said_after(body) if said]
    assert len(declared) >= 4
    for target in declared:
        assert getattr(thing, "_fields", None) and getattr(thing, target).__doc__ or f"\n    {target}\n        " in thing.__doc__, target


@pytest.mark.parametrize("name", ["SphereMap", "Mesh"])
def test_every_parameter_is_explained(name):
    methods = {part.name: part for part in parts_of(getattr(sp, name)) if isinstance(part, ast.FunctionDef)}
    assert len(methods) >= {"SphereMap": 50, "Mesh": 18}[name]
    for method, node in methods.items():
        if not is_public(method) or method == "__init__":
            continue
        text = ast.get_docstring(node) or ""
        for argument in node.args.kwonlyargs:
            known = argument.arg in ("threads", "progress")  # explained once, by `map`
            others = method == "bake_files"  # "the others are those of bake"
            assert known or others or argument.arg in text, f"{name}.{method}: {argument.arg}"


@pytest.mark.parametrize("name", ["map", "match", "repair", "components", "measure"])
def test_every_parameter_of_a_function_is_explained(name):
    text = ast.get_docstring(functions()[name])
    for argument in functions()[name].args.args + functions()[name].args.kwonlyargs:
        known = argument.arg in ("threads", "progress", "seed")
        assert known or argument.arg in text, argument.arg


@pytest.mark.parametrize("name", sp.__all__)
def test_the_page_names_it(name):
    assert f"`{name}" in page or f"sp.{name}" in page


@pytest.mark.parametrize("name", [n for n, _ in inspect.getmembers(sp.SphereMap) if not n.startswith("_")])
def test_the_page_names_what_maps_can_do(name):
    assert f"`{name}" in page or f"m.{name}" in page


@pytest.mark.parametrize("name", [n for n, _ in inspect.getmembers(sp.Mesh) if not n.startswith("_")])
def test_the_page_names_what_meshes_have(name):
    assert f"`{name}`" in page


def test_annotations_can_be_read():
    import numpy  # noqa: F401  what the types of arrays are of

    for name in ("Defect", "Stage", "Distance"):
        assert typing.get_type_hints(getattr(sp, name), vars(typing) | vars(sp))


def test_it_is_there_without_its_sources(tmp_path):
    copy = tmp_path / "sphparam"
    shutil.copytree(pathlib.Path(sp.__file__).parent, copy)
    assert compileall.compile_dir(copy, legacy=True, quiet=1)
    for source in copy.glob("*.py"):
        source.unlink()
    use = "import sphparam as sp; print(len([getattr(sp, name) for name in sp.__all__]), sp.__file__)"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    said = subprocess.run([sys.executable, "-c", use], env=environment, check=True, capture_output=True, text=True)
    assert said.stdout.split() == [str(len(sp.__all__)), str(copy / "__init__.pyc")]


def test_texts_that_begin_as_a_class_does_are_no_classes(tmp_path):
    from sphparam._attributes import document

    source = tmp_path / "told.py"
    source.write_text('class A:\n    """Text.\n\nclass of its own, and\nclass A2 too\n"""\n\n    a: int\n    """What a is."""\n')
    names = {"__file__": str(source), "A2": 2}
    exec(source.read_text(), names)
    document(names)


def wheel_backend():
    import importlib.util

    spec = importlib.util.spec_from_file_location("wheel_backend", package.parent / "wheel_backend.py")
    backend = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(backend)
    return backend


@pytest.mark.parametrize("version, needed", [("2.10.3", "numpy<2"), ("2.12.0", "numpy"), ("3.0.1", "numpy")])
def test_a_wheel_asks_for_the_numpy_that_its_module_can_read(version, needed, tmp_path):
    (tmp_path / "CMakeCache.txt").write_text(f"OTHER:PATH=/\npybind11_DIR:PATH={tmp_path}\n")
    (tmp_path / "pybind11ConfigVersion.cmake").write_text(f'set(PACKAGE_VERSION "{version}")\n')
    assert wheel_backend()._numpy(tmp_path) == needed


def test_wheels_are_made_by_every_python_that_they_are_for(monkeypatch):
    """Before 3.11 there is no `tomllib`; the package `tomli` is the same."""
    import tomllib

    monkeypatch.setitem(sys.modules, "tomllib", None)
    monkeypatch.setitem(sys.modules, "tomli", tomllib)
    backend = wheel_backend()
    assert backend._project()["version"] == sp.__version__ and backend._project()["requires-python"] == ">=3.10"


def test_the_page_engraves_a_mesh_by_an_image():
    names = {"np": np, "sp": sp}
    exec(re.search(r"```python\n(def engraved.*?)```", page, re.DOTALL)[1], names)
    ball = sp.map(*sphere(4), method="radial")
    cap = np.zeros((64, 128))
    cap[:16] = 1  # down to 45 degrees from the north
    deep = np.linalg.norm(names["engraved"](ball, cap, 0.1).vertices, axis=1)
    polar = np.degrees(np.arccos(ball.vertices[:, 2] / np.linalg.norm(ball.vertices, axis=1)))
    assert deep[polar < 42] == pytest.approx(0.9, abs=1e-3)
    assert deep[polar > 48] == pytest.approx(1, abs=1e-12)
