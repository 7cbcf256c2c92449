"""mypy takes the package and a program that uses it, and finds what is wrong with another one."""

import os
import pathlib
import subprocess
import sys

import sphparam

here = pathlib.Path(__file__).parent
package = pathlib.Path(os.path.realpath(sphparam.__file__)).parent

wrong = '''
import sphparam as sp

m = sp.map("a", 3, method=5)
m.points = None
m.bake(3)
m.export(texture="a.png")
sp.map([], [], qualty="best")
a: str = m.certificate.degree
m.tutte()
sp.nothing
sp.repair([], [], holes="all")
'''


def mypy(*arguments, cwd):
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", str(cwd / "cache")]
    environment = {**os.environ, "MYPYPATH": str(package.parent)}
    return subprocess.run([*command, *arguments], capture_output=True, text=True, cwd=cwd, env=environment)


def test_the_package_keeps_its_own_types(tmp_path):
    done = mypy(package, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_program_that_uses_it_is_taken(tmp_path):
    assert (package / "py.typed").exists()
    done = mypy(here / "consumer.py", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_mistake_of_a_program_is_found(tmp_path):
    (tmp_path / "wrong.py").write_text(wrong)
    done = mypy(tmp_path / "wrong.py", cwd=tmp_path)
    lines = {int(line.split(":")[1]) for line in done.stdout.splitlines() if ": error:" in line}
    assert lines == set(range(4, 13)), done.stdout


def test_the_stub_is_that_of_the_module():
    """What `_core` has and what its stub says are the same names."""
    import ast

    from sphparam import _core

    stub = ast.parse((package / "_core.pyi").read_text())
    functions = {n.name for n in stub.body if isinstance(n, ast.FunctionDef)}
    classes = {n.name: n for n in stub.body if isinstance(n, ast.ClassDef)}
    assert functions | set(classes) | {"version"} == {n for n in dir(_core) if not n.startswith("__")}
    for name, node in classes.items():
        told = {p.name for p in node.body if isinstance(p, ast.FunctionDef)}
        told |= {p.target.id for p in node.body if isinstance(p, ast.AnnAssign)}
        assert told == {n for n in vars(getattr(_core, name)) if not n.startswith("_")}
