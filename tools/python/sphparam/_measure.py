"""How far surfaces are apart."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, Optional, Tuple, Union

from . import _arrays, _core
from ._figures import Alignment, Distance, one_sided
from ._losses import tell
from ._mesh import any_mesh
from ._progress import Progress, told

if TYPE_CHECKING:
    from ._map_facts import Floats


def growth(first: Any, second: Any) -> Tuple[Floats, Floats]:
    """How areas grow from one surface to another of the same faces: of each face (F,), and of the faces about each vertex (V,).

    ``first``, ``second``: meshes as :class:`Mesh` takes them, a pair of arrays among them, or maps; of other faces
    ValueError. What is told is the second's area over the first's: above 1 it grew; 0 where the first has none.
    """
    meshes = [any_mesh(mesh, None) for mesh in (first, second)]
    for mesh in meshes:
        mesh._require_sound()
    return _core.growth(meshes[0]._source, meshes[1]._source)


def measure(
    first: Any,
    second: Any,
    *,
    samples: int = 1_000_000,
    seed: int = 1,
    over: Union[str, Iterable[str]] = "faces",
    extremes: bool = True,
    signed: bool = False,
    within: Optional[float] = None,
    upright: bool = False,
    align: str = "none",
    leave_out_border: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Distance:
    """How far two surfaces are apart, both ways; neither needs to be closed. Fillers are left out.

    Parameters
    ----------
    first, second
        Meshes as :class:`Mesh` takes them, a pair of arrays among them, or maps.
    samples
        On the faces of each, from 1, and as many on its edges where ``over`` has these.
    over
        What mean and RMS are over: ``"faces"``, ``"edges"``, ``"vertices"`` or several of these; MeshLab's filter takes all three.
    extremes
        False: RMS and mean alone, in half the time.
    signed
        Also on which side of the second surface the points of the first are, less than 0 inside:
        ``forth.deviation``. The second must be closed (else ValueError), by its fillers where holes were kept; the first need not.
    within
        Also which share of the samples is no farther than this, ``forth.within`` and ``back.within``.
    upright
        The second is first turned as the first stands, by what their files say is up and in front: y and z in glTF;
        z and -y where nothing says.
    align
        ``"rigid"``: the second is first put onto the first, turned and moved until samples of both are as near as
        they come; what one of them lacks is left out. ``"similarity"``: also scaled. ``.alignment`` says how.
    leave_out_border
        Leaves out points whose nearest point lies on the border of the other surface, as those over holes of a scan
        and beyond its end do: ``forth.left_out`` is their share, ``forth.left_out_vertices`` which vertices are.

    Warns where both seem to be one body in two units, or are farther from one another than either is large.

    ``forth.at_vertices`` has the distance of every vertex of the first from the second, ``back.at_vertices`` the
    other way.
    """
    samples, seed = _arrays.whole(samples, "samples", 1, 2**63 - 1), _arrays.whole(seed, "seed", 0, 2**64 - 1)
    words = {_arrays.text(word, "over") for word in ([over] if isinstance(over, str) else _arrays.listed(over, "over", "texts"))}
    if not words or words - {"faces", "edges", "vertices"}:
        raise ValueError(f"over: 'faces', 'edges', 'vertices' or several of these, not {over!r}")
    if _arrays.text(align, "align") not in ("none", "rigid", "similarity"):
        raise ValueError(f"align: 'none', 'rigid' or 'similarity', not {align!r}")
    meshes = [any_mesh(mesh, None) for mesh in (first, second)]
    for mesh in meshes:
        mesh._require_sound()
    with told(progress) as report:
        found = _core.measure(
            meshes[0]._source, meshes[1]._source, samples, seed, words, _arrays.flag(extremes, "extremes"), _arrays.flag(signed, "signed"),
            None if within is None else _arrays.real(within, "within"), _arrays.flag(upright, "upright"), align,
            _arrays.flag(leave_out_border, "leave_out_border"), _arrays.threads(threads), report,  # fmt: skip
        )
    tell(found.pop("warnings"))
    found["forth"], found["back"] = one_sided(found["forth"]), one_sided(found["back"])
    moved = found.pop("alignment")
    return Distance(**found, alignment=None if moved is None else Alignment(*moved))
