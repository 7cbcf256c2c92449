"""tests/mutation, of a small file: what is changed in it, and that one number chooses one change."""

import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys

import pytest

pytest.importorskip("clang.cindex")  # python3-clang-14
HERE = pathlib.Path(__file__).resolve().parents[1] / "mutation"
sys.path.insert(0, str(HERE))
import mutants  # noqa: E402  pylint: disable=wrong-import-position


def _program():
    loader = importlib.machinery.SourceFileLoader("mutation_run", str(HERE / "run"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutation_run", loader))
    loader.exec_module(module)
    return module


SOURCE = """#include <cstdio>
#include <cstdlib>

static_assert(2 + 2 == 4);
constexpr double limit = 8;

constexpr int twice(int x) { return 2 * x; }

double value(int x) {
  double y[2] = {0, 3};
  if (x < 5 && x != 2) y[0] += limit;
  while (x > 100) --x;
  return -y[0] + 0.5 *
         y[1];
}

int main(int, char** words) {
  std::printf("%g", value(std::atoi(words[1])));
  return 0;
}
"""


@pytest.fixture(name="file")
def _file(tmp_path):
    path = tmp_path / "value.cpp"
    path.write_text(SOURCE)
    return path


def found_in(path):
    return mutants.mutants_of(path.parent, path, ["-std=c++20"])


def test_what_can_be_changed(file):
    changes = {(one.line, one.change) for one in found_in(file)}
    assert {(11, "x < 5  becomes  x <= 5"), (11, "x < 5 && x != 2  becomes  x < 5 || x != 2"),
            (11, "x < 5 && x != 2  becomes  true"), (11, "y[0] += limit  becomes  nothing"),
            (11, "limit  becomes  2 * limit"), (10, "3  becomes  3 + 1"), (13, "-y[0]  becomes  y[0]"),
            (13, "0.5  becomes  2 * 0.5"), (12, "x > 100  becomes  x >= 100")} <= changes
    assert not [change for line, change in changes if line in (4, 5, 7)]  # constants of the compiler
    assert (10, "2  becomes  2 + 1") not in changes  # so is the size of an array


def test_a_sample_is_the_seeds_and_does_not_overlap(file):
    found = found_in(file)
    chosen = mutants.sample(found, 6, 1)
    assert chosen == mutants.sample(list(reversed(found)), 6, 1)
    assert chosen != mutants.sample(found, 6, 2)
    spans = sorted((one.begin, one.end) for one in chosen)
    assert all(first[1] <= second[0] for first, second in zip(spans, spans[1:]))


def test_one_number_chooses_one_change(file):
    for one in found_in(file):
        text = mutants.rewritten(SOURCE.encode(), [(7, one)])
        assert text.count(b"\n") == SOURCE.count("\n") + 2  # lines stay where they were
        changed = file.with_name("changed.cpp")
        changed.write_bytes(text)
        if one.change not in ("limit  becomes  2 * limit", "y[0] += limit  becomes  nothing"):
            continue
        program = file.with_name("program")
        subprocess.run(["c++", "-std=c++20", f"-I{HERE}", changed, "-o", program], check=True)
        said = {number: subprocess.run([program, "1"], env=dict(os.environ, SPHPARAM_MUTANT=number), check=True,
                                       capture_output=True, text=True).stdout for number in ("0", "6", "7")}
        assert said["0"] == said["6"] == "-6.5" and said["7"] in ("-14.5", "1.5")


def test_the_copy_holds_what_there_is_now(tmp_path, monkeypatch):
    program, tree = _program(), tmp_path / "build/tree"
    monkeypatch.setattr(program, "ROOT", tmp_path)
    monkeypatch.setattr(program, "TREE", tree)
    subprocess.run(["git", "init", "--quiet", tmp_path], check=True)
    (tmp_path / ".gitignore").write_text("/build/\n")
    for name in ("room/value.cpp", "room/other.cpp"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(SOURCE)
    program.copy_tree({"made.txt": b"made"})
    (tree / "build").mkdir()
    (tree / "build/kept.o").write_bytes(b"")
    (tmp_path / "room/inner").mkdir()
    (tmp_path / "room/value.cpp").rename(tmp_path / "room/inner/value.cpp")
    program.copy_tree({"room/other.cpp": b"changed"})
    there = {str(path.relative_to(tree)) for path in tree.rglob("*") if path.is_file()}
    assert there == {".gitignore", "build/kept.o", "room/inner/value.cpp", "room/other.cpp"}
    assert (tree / "room/other.cpp").read_bytes() == b"changed"


def test_a_file_that_has_moved_has_mutants_where_it_is(file, tmp_path, monkeypatch):
    program = _program()
    monkeypatch.setattr(program, "TREE", tmp_path)
    monkeypatch.setattr(program, "WORK", tmp_path / "work")
    before = program.found_in(file, ["-std=c++20"])
    moved = file.rename(tmp_path / "moved.cpp")
    after = program.found_in(moved, ["-std=c++20"])
    assert [one.change for one in before] == [one.change for one in after]
    assert {one.file for one in before} == {"value.cpp"} and {one.file for one in after} == {"moved.cpp"}
