"""Calls everything many times, refusals too, and says what memory is left behind. Ends with 1 for a leak.

    leaks.py [CALLS]                          by what malloc has given out
    LD_PRELOAD=$(gcc -print-file-name=libasan.so) PYTHONMALLOC=malloc leaks.py 10000
                                              by AddressSanitizer's count; at the end LeakSanitizer lists
                                              what nobody points to, with `_core` in what is ours
"""

import ctypes
import gc
import itertools
import sys
import warnings

import numpy as np

import sphparam as sp
from shapes import octahedron, potato, torus

process = ctypes.CDLL(None)
sanitized = hasattr(process, "__sanitizer_get_current_allocated_bytes")
least_calls = 300
# Bytes a call: NumPy's names in Python's cache of attributes, which has 4096 places, and what Embree 3.13 keeps of
# each thread that made a scene and ended, some 220 for a call that measures.
tolerated = 16


class Mallinfo2(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in
                ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]  # fmt: skip


def allocated():
    gc.collect()
    if sanitized:
        count = process.__sanitizer_get_current_allocated_bytes
        count.restype = ctypes.c_size_t
        return count()
    process.mallinfo2.restype = Mallinfo2
    found = process.mallinfo2()
    return found.uordblks + found.hblkhd


V, F = potato(2)
small = octahedron()
directions = np.random.default_rng(1).normal(size=(50, 3))
mapped = sp.map(V, F, values={"height": V[:, 2], "label": F[: len(V), 0]})


def refused(use):
    try:
        use()
    except (sp.MeshError, sp.NotCertified, ValueError, TypeError, OSError):
        return
    raise AssertionError("this should have been refused")


calls = [
    lambda: sp.map(*small),
    lambda: sp.map(V, F, quality="draft", values={"height": V[:, 2]}),
    lambda: sp.map(V.astype(">f4"), np.asfortranarray(F.astype(np.uint32)), quality="draft"),
    lambda: sp.map(V, F[1:], repair=True, quality="draft"),
    lambda: sp.Mesh(V, F, values={"a": V}).values,
    lambda: sp.inspect(V, F[1:]),
    lambda: sp.repair(V, F[1:]).repairs,
    lambda: sp.map(V, F[1:], repair=dict(keep_holes=True), quality="draft").surface.faces,
    lambda: [part.area_share for part in sp.components(np.r_[V, V + 9], np.r_[F, F + len(V)])],
    lambda: sp.verify(V, F, mapped.points),
    lambda: sp.verify(*small, small[0] * [-1, 1, 1]),
    lambda: sp.with_sphere((V, F), mapped.points).points,
    lambda: mapped.locate(directions),
    lambda: mapped.resample("height", directions),
    lambda: mapped.resample("label", directions),
    lambda: mapped.chart().uv,
    lambda: mapped.remesh("ico:1").values,
    lambda: mapped.bake("normal-object", size=16),
    lambda: mapped.spharm(3)(directions),
    lambda: mapped.spharm(2, radius=True, centre=(0, 0, 0.1)).reference_radius,
    lambda: sp.measure(mapped, small, samples=50, signed=True).forth.deviation.at_vertices,
    lambda: refused(lambda: sp.measure(small, (V, F[1:]), samples=50, signed=True)),
    lambda: refused(lambda: sp.read(__file__, limits={"file": 10})),
    lambda: (mapped.theta, mapped.distortion, mapped.stages, mapped.mesh.vertices, mapped.certificate),
    lambda: refused(lambda: sp.map(V, F[1:])),
    lambda: refused(lambda: sp.map(V * np.nan, F)),
    lambda: refused(lambda: sp.map(V, F + 2**40)),
    lambda: refused(lambda: sp.map(V, F + 1, repair=True)),
    lambda: refused(lambda: sp.map(V, F.astype(float))),
    lambda: refused(lambda: sp.map(*torus(6))),
    lambda: refused(lambda: sp.map(V, F, method="tutte")),
    lambda: refused(lambda: sp.with_sphere(small, small[0] * [-1, 1, 1])),
    lambda: refused(lambda: mapped.bake("nothing", size=16)),
    lambda: refused(lambda: sp.read(__file__)),
]


def run(count):
    for call in itertools.islice(itertools.cycle(calls), count):
        call()


def main(count):
    warnings.simplefilter("ignore")
    run(max(least_calls, 3 * len(calls)))  # what is made once is made now
    before = allocated()
    run(count)
    left = allocated() - before
    print(f"{count} calls of {len(calls)} kinds left {left} bytes, {left / count:.2f} a call"
          f"{', by AddressSanitizer' if sanitized else ''}")
    return left > tolerated * count


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000))
