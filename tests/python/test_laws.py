"""What holds for every call: arrays of any layout, the bytes of the program, memory, Ctrl-C."""

import os
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import sphparam as sp
from shapes import octahedron, potato, sphere

V, F = potato(4)


@pytest.fixture(scope="module")
def mapped():
    return sp.map(V, F)


def strided(array):
    """The same numbers, no two of them side by side."""
    wide = np.zeros((2 * len(array), 2 * array.shape[1]), array.dtype)
    wide[::2, ::2] = array
    return wide[::2, ::2]


def unaligned(array):
    memory = bytearray(array.nbytes + 1)
    view = np.frombuffer(memory, array.dtype, array.size, 1).reshape(array.shape)
    view[:] = array
    return view


def read_only(array):
    copy = array.copy()
    copy.flags.writeable = False
    return copy


layouts = {
    "as it is": lambda a: a,
    "Fortran order": np.asfortranarray,
    "read-only": read_only,
    "big-endian": lambda a: a.astype(a.dtype.newbyteorder(">")),
    "big-endian, Fortran order": lambda a: np.asfortranarray(a.astype(a.dtype.newbyteorder(">"))),
    "with gaps": strided,
    "backwards in memory": lambda a: a[::-1].copy()[::-1],
    "columns backwards in memory": lambda a: a[:, ::-1].copy()[:, ::-1],
    "unaligned": unaligned,
    "a list": lambda a: a.tolist(),
    "a subclass": lambda a: a.view(np.matrix),
}


@pytest.mark.parametrize("layout", layouts)
@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32, np.uint64, np.int16])
def test_any_layout_gives_the_same_map(layout, kind, mapped):
    vertices, faces = layouts[layout](V.copy()), layouts[layout](F.astype(kind))
    assert (sp.map(vertices, faces, quality="draft").points == drafts()).all()


def drafts(made={}):
    if not made:
        made["points"] = sp.map(V, F, quality="draft").points
    return made["points"]


def test_single_precision_is_taken_as_it_is():
    single = V.astype(np.float32)
    assert (sp.map(single, F).points == sp.map(single.astype(float), F).points).all()
    assert (sp.map(single, F).vertices == single).all()


def test_halves_and_whole_numbers_are_coordinates_too():
    vertices, faces = octahedron()
    for kind in (np.float16, np.int8, np.uint16, np.int64):
        shifted = (vertices + 1).astype(kind)
        assert (sp.map(shifted, faces).vertices == vertices + 1).all()
    foreign = (vertices + 1).astype(np.dtype("f2").newbyteorder())
    made = sp.map(foreign, faces, values={"a": foreign[:, 0]})
    assert (made.vertices == vertices + 1).all()
    assert (made.values["a"] == vertices[:, 0] + 1).all()


def test_whole_numbers_of_64_bits_are_labels_too(tmp_path):
    labels = np.array([-3_000_000_000, 6_000_000_000])[(V[:, 0] > 0).astype(int)]
    made = sp.map(V, F, values={"id": labels}, quality="draft")
    assert made.values["id"].dtype == np.int64 and (made.values["id"] == labels).all()
    assert set(made.remesh("ico:3").values["id"]) == set(labels)
    made.save(tmp_path / "a.vtp")
    assert (sp.load(tmp_path / "a.vtp").values["id"] == labels).all()
    with pytest.raises(ValueError, match="id.*beyond 2⁵³"):
        sp.map(V, F, values={"id": labels * 10**6 * 10})


def test_nothing_that_is_passed_in_is_changed():
    vertices, faces = V.copy(), F.copy()
    vertices.flags.writeable = faces.flags.writeable = True
    sulc = np.linspace(0, 1, len(V))
    made = sp.map(vertices, faces, values={"sulc": sulc}, repair=True)
    made.resample(sulc, V)
    made.locate(vertices)
    made.remesh("ico:2")
    assert (vertices == V).all() and (faces == F).all() and (sulc == np.linspace(0, 1, len(V))).all()


def test_what_is_passed_in_may_change_afterwards(mapped):
    vertices, faces = V.copy(), F.copy()
    made = sp.map(vertices, faces)
    vertices[:], faces[:] = np.nan, -1
    assert (made.vertices == V).all() and (made.faces == F).all()


def test_results_outlive_what_they_came_from():
    points = sp.map(V, F, quality="draft").points
    face, weights = sp.map(V, F, quality="draft").locate(V)
    uv = sp.map(V, F, quality="draft").chart().uv
    for _ in range(50):
        sp.map(*octahedron())
    assert (points == drafts()).all() and np.isfinite(weights).all() and np.isfinite(uv).all()
    assert np.allclose(np.linalg.norm(points, axis=1), 1)


def test_a_proved_map_cannot_be_written_to(mapped):
    for array in (mapped.points, mapped.vertices, mapped.faces):
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.flags.writeable = True
    face, weights = mapped.locate(V)
    weights[0] = 0  # one's own


def test_values_cannot_be_written_to_either():
    for mesh in (sp.Mesh(*octahedron(), values={"a": np.arange(6.0)}), sp.map(*octahedron(), values={"a": np.arange(6.0)})):
        with pytest.raises(ValueError):
            mesh.values["a"][:] = 7
        with pytest.raises(TypeError):
            mesh.values["b"] = np.zeros(6)
        assert list(mesh.values) == ["a"]


def test_what_a_map_has_found_out_cannot_be_written_to():
    made = sp.map(*potato(2), values={"k": np.zeros((66, 2))})
    found = [made.theta, made.phi, made.fillers, made.certificate.folded, made.values["k"], made.values["k_0"]]
    for array in [*found, *made.face_distortion]:
        with pytest.raises(ValueError):
            array[...] = 0
    made.pin_residuals.append(1.0)  # one's own
    assert made.pin_residuals == []


def given_values():
    x, label = np.linspace(0, 1, 66), np.arange(66, dtype=np.int32)
    columns = np.stack([x, x**2, -x], 1)
    return {
        "an array": ({"k": columns}, {"k": columns}),
        "one of one column": ({"k": columns[:, :1]}, {"k": x}),
        "columns as files have them": ({"k_0": x, "k_1": -x}, {"k": np.stack([x, -x], 1)}),
        "columns of two types": ({"k_0": x, "k_1": label}, {"k_0": x, "k_1": label}),
        "an array and its name": ({"k": x, "k_0": x, "k_1": -x}, {"k": x, "k_0": x, "k_1": -x}),
        "a name of the map's": ({"x_0": x, "x_1": -x}, {"x_0": x, "x_1": -x}),
        "what colours are not kept as": ({f"color_{i}": x for i in range(3)}, {f"color_{i}": x for i in range(3)}),
        "texture coordinates of three": ({"uv": columns}, {"uv": columns}),
    }


@pytest.mark.parametrize("case", given_values())
def test_values_come_back_as_they_were_given(case, tmp_path):
    given, expected = given_values()[case]
    made = sp.map(*potato(2), values=given)
    made.save(tmp_path / "a.sph.ply")
    for values in (made.values, made.mesh.values, sp.load(tmp_path / "a.sph.ply").values):
        assert set(values) == set(expected)
        for name, array in expected.items():
            assert values[name].dtype == array.dtype and (values[name] == array).all()
        for name, array in given.items():
            assert (values[name].reshape(array.shape) == array).all()


def test_values_that_a_mesh_is_given_take_the_place_of_its_own():
    x = np.linspace(0, 1, 66)
    mesh = sp.Mesh(*potato(2), values={"k": np.stack([x, x, x], 1), "label": np.arange(66)})
    for new in (x, np.stack([x, -x], 1)):
        made = sp.Mesh(mesh, values={"k": new})
        assert set(made.values) == {"k", "label"} and (made.values["k"] == new).all()
    with pytest.raises(ValueError, match="'k_0'.*'k'"):
        sp.Mesh(mesh, values={"k_0": x})
    assert mesh.values["k"].shape == (66, 3)


def test_columns_go_by_the_name_of_their_array_and_by_their_own():
    points = potato(2)[0]
    made = sp.map(*potato(2), values={"pc": points[:, :2].copy()})
    assert (made.resample("pc_1", made.points) == made.resample("pc", made.points)[:, 1]).all()
    assert made.spharm(2, values=["pc"]).functions == ["x", "y", "z", "pc_0", "pc_1"]
    for names, found in ((["pc"], "pc"), (["pc_0", "pc_1"], "pc"), (["pc_1"], "pc_1")):
        assert list(made.remesh("ico:1", transfer=names).values) == [found]
    assert made.bake("scalar:pc_1", size=16).shape == (8, 16, 1)


def test_a_sphere_seen_from_inside_is_one_to_one_as_it_is_in_files(tmp_path):
    vertices, faces = octahedron()
    mirrored = vertices * (1, 1, -1)
    sp.write(tmp_path / "mesh.off", vertices, faces)
    sp.write(tmp_path / "mirrored.off", mirrored, faces)
    for told in (
        sp.verify(vertices, faces, mirrored),
        sp.verify(tmp_path / "mesh.off", points=tmp_path / "mirrored.off"),
    ):
        assert told.one_to_one and told.reversed and told.covering == 1 and len(told.folded) == 0


def test_a_mesh_that_was_mapped_is_still_there():
    mesh = sp.Mesh(V, F)
    first = sp.map(mesh)
    assert (mesh.vertices == V).all() and (sp.map(mesh).points == first.points).all()


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_the_same_bits_for_any_number_of_threads(threads, mapped):
    assert (sp.map(V, F, threads=threads).points == mapped.points).all()


def program():
    return os.environ["SPHPARAM_PROGRAM"]


@pytest.mark.parametrize("name", ["potato.ply", "potato.obj"])
def test_the_program_writes_the_same_bytes(name, tmp_path):
    path = tmp_path / name
    sp.write(path, V, F, values={"sulc": V[:, 0].astype(np.float32)})
    ours, theirs = tmp_path / "ours.sph.ply", tmp_path / "theirs.sph.ply"
    sp.map(sp.read(path)).save(ours)
    subprocess.run([program(), "map", path, "-o", theirs, "--quiet"], check=True)
    assert ours.read_bytes() == theirs.read_bytes()


def test_a_map_that_stands_is_that_of_the_program_and_says_so(tmp_path):
    sp.write(tmp_path / "a.ply", V, F)
    ours, theirs = tmp_path / "ours.sph.ply", tmp_path / "theirs.sph.ply"
    m = sp.map(sp.read(tmp_path / "a.ply"), up="y", front=(0, 0, -2))
    m.save(ours)
    way = ["--up", "y", "--front", "-z"]
    subprocess.run([program(), "map", tmp_path / "a.ply", "-o", theirs, "--quiet", *way], check=True)
    assert ours.read_bytes() == theirs.read_bytes()
    assert m.provenance["upright"] == "y, front -z"
    assert m.vertices[m.poles[0], 1] == V[:, 1].max() and m.points[m.poles[0], 2] == 1
    again = sp.map(sp.read(ours), poles="up")
    assert again.poles == m.poles and again.meridian == m.meridian
    assert m.picture(size=32) == m.picture(size=32, up="y", front="-z")
    assert m.picture(size=32) != m.picture(size=32, up="z")
    assert m.picture(size=32, view="sphere") == sp.load(theirs).picture(size=32, view="sphere")
    assert "upright" not in sp.map(V, F).provenance


def test_points_of_arrays_are_those_of_the_program(mapped, tmp_path):
    sp.write(tmp_path / "a.ply", V, F)
    subprocess.run([program(), "map", tmp_path / "a.ply", "-o", tmp_path / "a.sph.ply", "--quiet"], check=True)
    read = sp.load(tmp_path / "a.sph.ply")
    assert (read.points == mapped.points).all()
    assert (read.theta == mapped.theta).all() and (read.phi == mapped.phi).all()
    assert sp.verify(tmp_path / "a.sph.ply").one_to_one


def test_progress_is_told_in_the_thread_that_asked():
    told = []
    vertices, faces = potato(6)

    def listen(stage, fraction):
        assert threading.current_thread() is threading.main_thread()
        told.append((stage, fraction))

    sp.map(vertices, faces, progress=listen)
    assert told and all(isinstance(s, str) and 0 <= f <= 1 for s, f in told)


@pytest.mark.parametrize("no", [False, np.False_, np.float64(1) < 0])
def test_progress_that_says_false_stops(no):
    with pytest.raises(sp.Cancelled):
        sp.map(*potato(7), progress=lambda stage, fraction: no)


def test_progress_that_says_false_stops_what_ends_before_the_answer():
    no = lambda stage, fraction: False
    for use in (lambda: sp.map(*potato(1), progress=no), lambda: sp.map(*potato(1)).remesh("ico:1", progress=no)):
        with pytest.raises(sp.Cancelled):
            use()


@pytest.mark.parametrize("answer", [None, True, np.True_, 0])
def test_progress_that_says_anything_else_goes_on(answer):
    assert sp.map(*potato(4), progress=lambda stage, fraction: answer).certificate.one_to_one


def test_progress_that_raises_stops():
    def broken(stage, fraction):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        sp.map(*potato(7), progress=broken)


def test_a_bar_appears_and_goes(capsys, monkeypatch):
    import sphparam._progress as progress

    monkeypatch.setattr(progress.Bar, "patience", 0)
    sp.map(*potato(6), progress=True)
    written = capsys.readouterr().err
    assert "%|" in written and written.endswith("\r")
    sp.map(*potato(4), progress=None)  # nobody watches here
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("delay", [0.02, 0.2, 0.6])
def test_ctrl_c_is_heard(delay):
    vertices, faces = sphere(8)
    vertices = vertices * (1 + 0.3 * np.sin(5 * vertices[:, :1]))
    hit = []

    def press():
        time.sleep(delay)
        hit.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(20):
            sp.map(vertices, faces, quality="best")
    late = time.monotonic() - hit[0]
    thread.join()
    assert late < 5  # the figure, half a second, is measured by tests/bench/python_figures.py
    assert sp.map(*octahedron()).certificate.one_to_one  # all is well afterwards


def test_ctrl_c_leaves_no_file(tmp_path):
    mapped = sp.map(*potato(5))

    def press():
        time.sleep(0.15)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100):
            mapped.bake_files({"ao": tmp_path / "ao.png"}, size=1024, rays=256)
            (tmp_path / "ao.png").unlink()
    thread.join()
    time.sleep(0.3)
    assert list(tmp_path.iterdir()) == []


def test_other_threads_go_on():
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.002)

    thread = threading.Thread(target=tick)
    thread.start()
    sp.map(*potato(7))
    stop.set()
    thread.join()
    assert len(ticks) > 20


def test_other_threads_go_on_while_a_map_is_proved_again_for_its_mesh():
    made = sp.map(*potato(8), quality="draft")
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    time.sleep(0.05)
    before = len(ticks)
    made.vertices  # when it is first wanted
    during = len(ticks) - before
    stop.set()
    thread.join()
    assert during > 10


def test_a_map_is_whole_after_a_call_that_was_left_as_it_began():
    class Enough(Exception):
        pass

    def ring(*_):
        raise Enough

    vertices, faces = potato(8)
    made, other = sp.map(vertices, faces, quality="draft"), sp.map(*octahedron())
    held = signal.signal(signal.SIGALRM, ring)
    try:
        with pytest.raises(Enough):
            signal.setitimer(signal.ITIMER_REAL, 0.001)  # heard while the mesh is proved
            sp.match(made, other, ())
    finally:
        signal.signal(signal.SIGALRM, held)
    assert (made.vertices == vertices).all() and (made.faces == faces).all()


def test_several_threads_map_at_once(mapped):
    found = []

    def work():
        found.append((sp.map(V, F).points == mapped.points).all())

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [True] * 4


def test_threads_that_read_arrays_at_once_leave_the_filters_of_warnings_as_they_were():
    vertices, faces = octahedron()
    inside, both, over = threading.Event(), threading.Event(), threading.Event()

    class Slow:
        def __init__(self, here, until):
            self.here, self.until = here, until

        def __array__(self, *_):
            self.here.set()
            assert self.until.wait(60)
            return vertices

    def first():
        sp.Mesh(Slow(inside, both), faces)
        over.set()

    def second():
        assert inside.wait(60)
        sp.Mesh(Slow(both, over), faces)

    before = list(warnings.filters)
    threads = [threading.Thread(target=work) for work in (first, second)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert over.is_set() and warnings.filters == before


def test_importing_opens_no_images_and_casts_no_rays():
    code = (
        "import sphparam, sys\n"
        "maps = open('/proc/self/maps').read()\n"
        "assert 'embree' not in maps and 'OpenImageIO' not in maps\n"
        "assert 'numpy' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_program_may_end_while_a_left_call_runs():
    code = (
        "import os, signal, sys, threading, time\n"
        f"sys.path.insert(0, {os.path.dirname(__file__)!r})\n"
        "import shapes, sphparam as sp\n"
        "threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
        "try:\n"
        "    sp.map(*shapes.potato(8), quality='best')\n"
        "except KeyboardInterrupt:\n"
        "    print('heard')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.stdout, done.returncode) == ("heard\n", 0), done.stderr


@pytest.mark.parametrize("use", ["sp.map(*shapes.potato(7), quality='best')", "sp.map(mesh, quality='draft').vertices"])
def test_a_program_may_end_while_a_daemon_thread_maps(use):
    code = (
        "import os, sys, threading, time\n"
        f"sys.path.insert(0, {os.path.dirname(__file__)!r})\n"
        "import numpy, shapes, sphparam as sp\n"
        "mesh = shapes.potato(4)\n"
        "def work():\n"
        "    while True:\n"
        "        try:\n"
        f"            {use}\n"
        "        except sp.Cancelled:\n"
        "            os.write(1, b'cancelled\\n')\n"  # print holds a lock that Python's end cannot wait for
        "            time.sleep(0.01)\n"
        "threading.Thread(target=work, daemon=True).start()\n"
        "time.sleep(0.5)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("waits", ["queue.put(1)", "held.acquire()", "time.sleep(1)"])
def test_a_program_ends_though_a_callback_never_comes_back(waits):
    comes_back = "sleep" in waits
    code = (
        "import atexit, sys, threading, time\n"
        "ended = threading.Event()\n"
        f"atexit.register(ended.wait, {60 if comes_back else 0})  # behind what the package does at the end\n"
        f"sys.path.insert(0, {os.path.dirname(__file__)!r})\n"
        "import numpy, queue as queues, shapes, sphparam as sp\n"
        "queue, held, told = queues.Queue(1), threading.Lock(), threading.Event()\n"
        "queue.put(0)\n"
        "held.acquire()\n"
        "def progress(stage, fraction):\n"
        "    told.set()\n"
        f"    {waits}\n"
        "def work():\n"
        "    try:\n"
        "        while True:  # one may be done before it is stopped\n"
        "            sp.map(*shapes.potato(6), progress=progress)\n"
        "    except sp.Cancelled:\n"
        "        print('cancelled', flush=True)\n"
        "        ended.set()\n"
        "threading.Thread(target=work, daemon=True).start()\n"
        "assert told.wait(60)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert done.stdout == ("cancelled\n" if comes_back else "")
