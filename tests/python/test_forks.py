"""Processes that are forked from one that has used the library: they end, and have threads of their own."""

import os
import subprocess
import sys

import pytest

before = """
import multiprocessing, os, signal, sys
import sphparam as sp
from shapes import potato

mesh = potato(4)

def threads():
    return len(os.listdir("/proc/self/task"))

def works(points=None):
    signal.alarm(60)  # whoever hangs is killed
    made = sp.map(mesh, threads=3)
    assert threads() >= 3, threads()
    return made.points.tobytes()
"""


def printed(program, timeout=200):
    """What a program prints that has made a map and goes on so."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([os.path.dirname(__file__), *sys.path])}
    ended = subprocess.run(
        [sys.executable, "-W", "ignore::DeprecationWarning", "-c", before + program], capture_output=True, text=True, env=environment, timeout=timeout
    )
    assert ended.returncode == 0 and ended.stderr == "", ended.stderr
    return ended.stdout.split()


fork = """
points = works()
child = os.fork()
if child == 0:
    {}
    sys.exit()
print(os.waitpid(child, 0)[1], works() == points)
"""


@pytest.mark.parametrize("work", ["signal.alarm(60)", "assert works() == points"])
def test_a_fork_of_a_process_that_has_made_maps_ends(work):
    assert printed(fork.format(work)) == ["0", "True"]


def test_a_fork_after_an_interrupted_call_ends():
    stop = """
try:
    sp.map(potato(7), threads=3, progress=lambda *_: os.kill(os.getpid(), signal.SIGINT))
except KeyboardInterrupt:
    pass
"""
    assert printed(stop + fork.format("assert works() == points")) == ["0", "True"]


def test_forks_of_multiprocessing_have_threads_of_their_own():
    program = """
points = works()
with multiprocessing.get_context("fork").Pool(2) as pool:
    print(set(pool.map(works, range(4))) == {points})
"""
    assert printed(program) == ["True"]
