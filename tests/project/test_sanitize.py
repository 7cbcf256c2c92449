"""tests/sanitize, with a shell script in place of a test program: what counts as found, and what runs again."""

import importlib.machinery
import importlib.util
import pathlib
import sys

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "sanitize"

# Fails where its case is called bad; where it is called secret only the sanitizer's log tells of it.
PROGRAM = r"""#!/bin/sh
[ "$1" != --list-test-names-only ] || { printf '%s\n' "a: good" "a: [1, 2] good" "a: bad" "a: secret"; exit 4; }
echo "$1" >>"$0.ran"
case $1 in
  *bad) echo "said why"; exit 3 ;;
  *secret) echo report >"${ASAN_OPTIONS##*log_path=}.7" ;;
esac
"""


@pytest.fixture
def sanitize(tmp_path, monkeypatch):
    loader = importlib.machinery.SourceFileLoader("sanitize", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("sanitize", loader))
    monkeypatch.setitem(sys.modules, "sanitize", module)
    loader.exec_module(module)
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "cmake", lambda *words: None)
    return module


@pytest.fixture
def room(sanitize):
    room = sanitize.Room("toy", sanitize.KINDS["address"])
    room.program.parent.mkdir(parents=True)
    write(room, PROGRAM)
    return room


def write(room, text):
    room.program.write_text(text)
    room.program.chmod(0o755)


def ran(room):
    """The cases that ran since it was last asked."""
    note = room.program.with_suffix(".ran")
    cases = sorted(note.read_text().splitlines()) if note.exists() else []
    note.unlink(missing_ok=True)
    return cases


def test_what_fails_and_what_only_a_log_tells_of_is_found(sanitize, room, capsys):
    assert not sanitize.run_room(room, 2)
    told = capsys.readouterr().out
    assert "toy: 2 of 4 cases passed" in told and "2.log: a: bad" in told and "3.log: a: secret" in told
    assert "said why" in (room.folder / "2.log").read_text()
    assert "report" in (room.folder / "3.log").read_text()
    assert r"a: \[1\, 2\] good" in ran(room)


def test_what_passed_runs_again_only_for_another_program(sanitize, room, capsys):
    sanitize.run_room(room, 1)
    assert len(ran(room)) == 4
    assert not sanitize.run_room(room, 1)
    assert ran(room) == ["a: bad", "a: secret"]
    write(room, PROGRAM.replace("exit 3", "exit 0").replace("echo report", "#"))
    assert sanitize.run_room(room, 1)
    assert len(ran(room)) == 4
    assert sanitize.run_room(room, 1)
    assert ran(room) == []
    assert "toy: 4 of 4 cases passed, 0 run now" in capsys.readouterr().out


def test_a_room_without_cases_is_no_success(sanitize, room):
    write(room, "#!/bin/sh\n")
    assert not sanitize.run_room(room, 1)


def test_options_may_stand_before_the_rooms(sanitize, monkeypatch):
    ran_with = []
    monkeypatch.setattr(sanitize, "run_room", lambda room, jobs: ran_with.append((room.name, jobs)) or True)
    monkeypatch.setattr(sys, "argv", ["sanitize", "address", "--jobs", "1", "sphere", "mesh"])
    assert sanitize.main() == 0
    assert ran_with == [("sphere", 1), ("mesh", 1)]
