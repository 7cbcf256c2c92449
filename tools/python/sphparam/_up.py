"""Directions of a mesh: what points up, what is in front."""

from __future__ import annotations

import math
from typing import Optional, Sequence, Union

Direction = Union[str, Sequence[float]]


def as_direction(direction: Optional[Direction], what: str) -> str:
    """As the program reads it: an axis, or three numbers; an empty text for None."""
    if direction is None:
        return ""
    if isinstance(direction, str) and direction in ("x", "-x", "y", "-y", "z", "-z"):
        return direction
    try:
        numbers = [float(number) for number in direction if not isinstance(direction, str)]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != 3 or not any(numbers) or not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"{what}: 'x', '-x', 'y', '-y', 'z', '-z', three numbers or None, not {direction!r}")
    return ",".join(repr(number) for number in numbers)
