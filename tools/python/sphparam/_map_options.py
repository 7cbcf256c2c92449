"""The options of a map, as `_core` takes them."""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _arrays
from ._map_facts import MapFacts
from ._numpy import np
from ._up import as_direction

_of_the_paper = ("weights", "epsilon", "iterations", "rings", "sweeps")


def _angles(place: Any, name: str) -> Tuple[float, float]:
    try:
        theta, phi = place
        return _arrays.real(theta, name), _arrays.real(phi, name)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: two angles are needed, (theta, phi), not {place!r}") from None


def _pins(pins: Any) -> List[Tuple[float, float, float]]:
    """Vertex to (theta, phi), as rows."""
    try:
        places = dict(pins)
    except (TypeError, ValueError):
        raise TypeError(f"pins: a dict is needed, {{vertex: (theta, phi)}}, not {type(pins).__name__}") from None
    rows = []
    for number, place in places.items():
        vertex = _arrays.vertex(number, "pins")
        theta, phi = _angles(place, f"pins[{vertex}]")
        if not (np.isfinite(theta) and 0 <= phi <= np.pi):
            raise ValueError(f"pins[{vertex}]: theta is finite and phi from 0 to π, not {theta}, {phi}")
        rows.append((float(vertex), theta, phi))
    return rows


def _weight(balance: Union[str, float], weight: Optional[float]) -> Dict[str, Any]:
    """A word, or the number that it stands for."""
    if weight is not None and not (isinstance(balance, str) and balance == "balanced"):
        raise ValueError("balance and weight contradict each other")
    options: Dict[str, Any] = {"balance": balance} if isinstance(balance, str) else {"lambda": _arrays.real(balance, "balance")}
    if weight is not None:
        options["lambda"] = _arrays.real(weight, "weight")
    return options


def _poles(poles: Any) -> Dict[str, Any]:
    if not isinstance(poles, str):
        try:
            north, south = poles
        except (TypeError, ValueError):
            raise ValueError(f"poles: 'auto', 'none', 'up' or two vertices, not {poles!r}") from None
        return {"poles": (_arrays.vertex(north, "poles"), _arrays.vertex(south, "poles"))}
    if poles not in ("auto", "none", "up"):
        raise ValueError(f"poles: 'auto', 'none', 'up' or two vertices, not {poles!r}")
    return {"automatic_poles": poles != "none"}


def _stance(up: Any, front: Any, poles: Any, pins: Any, align: Any, method: str) -> Dict[str, Any]:
    """How the mesh stands, where that is to be how the map lies."""
    if up is None and front is None and not (isinstance(poles, str) and poles == "up"):
        return {}
    if pins or align is not None:
        raise ValueError("up, front, poles='up': not with pins or align, which say where the map lies")
    upright = isinstance(poles, str) and poles != "none" and (method != "radial" or poles == "up")
    return {"up": as_direction(up, "up"), "front": as_direction(front, "front"), "stands": True, "upright_poles": upright}


def _alignment(align: Any) -> Dict[str, Any]:
    if isinstance(align, str):
        if align != "body":
            raise ValueError(f"align: 'body', a map or rays, not {align!r}")
        return {"to_body": True}
    return {"align_to": align.points if isinstance(align, MapFacts) else _arrays.directions(align, "align")}


def _paper(settings: Any) -> Dict[str, Any]:
    if not isinstance(settings, Mapping):
        raise TypeError(f"paper: a dict of {', '.join(_of_the_paper)} is needed, not {type(settings).__name__}")
    for name in settings:
        if name not in _of_the_paper:
            raise TypeError(f"paper: no option is called {name!r}; there are {', '.join(_of_the_paper)}")
    return dict(settings)


def _require_of_method(
    method: str, *, settings: Tuple[Any, ...], weight: Any, centre: Any, align: Any, paper: Any, repair: bool
) -> None:
    """What only some methods read is not taken where it would do nothing."""
    if method != "progressive" and settings != ("balanced", "normal", "angle-and-area"):
        raise ValueError("balance, quality and energy are for method='progressive'")
    if paper is not None and method != "paper":
        raise ValueError("paper is for method='paper'")
    if weight is not None and method == "radial":
        raise ValueError("weight is not for method='radial', which minimises nothing")
    if repair and method != "paper":
        raise ValueError("repair_map is for method='paper'")
    if centre is not None and method != "radial" and not (isinstance(align, str) and align == "body"):
        raise ValueError("centre is for method='radial' and align='body'")


def requested(
    *,
    method: str = "progressive",
    balance: Union[str, float] = "balanced",
    weight: Optional[float] = None,
    quality: str = "normal",
    energy: str = "angle-and-area",
    poles: Any = "auto",
    meridian: Optional[int] = None,
    up: Any = None,
    front: Any = None,
    pins: Any = None,
    centre: Union[str, Tuple[float, float, float], None] = None,
    align: Any = None,
    filler_share: float = 0.02,
    paper: Any = None,
    repair_map: bool = False,
    measure_stages: bool = False,
    threads: int = 0,
) -> Dict[str, Any]:
    """What :func:`map` was asked for; a ``centre`` of ``"centroid"`` is still to be found."""
    options: Dict[str, Any] = dict(
        method=_arrays.text(method, "method"), quality=_arrays.text(quality, "quality"),
        energy=_arrays.text(energy, "energy"), filler_share=filler_share, repair_map=repair_map,
        measure_stages=measure_stages, threads=_arrays.threads(threads),
    )  # fmt: skip
    pinned = [] if pins is None else _pins(pins)
    options.update(_weight(balance, weight), **_poles(poles), **_stance(up, front, poles, pinned, align, method))
    if meridian is not None:
        options["meridian"] = _arrays.vertex(meridian, "meridian")
    if pinned:
        options["pins"] = pinned
    if centre is not None:
        options["centre"] = centre if isinstance(centre, str) and centre == "centroid" else _arrays.three(centre, "centre")
    if align is not None:
        options.update(_alignment(align))
    if paper is not None:
        options.update(_paper(paper))
    _require_of_method(
        method,
        settings=(balance, quality, energy),
        weight=weight,
        centre=centre,
        align=align,
        paper=paper,
        repair=repair_map,
    )
    return options
