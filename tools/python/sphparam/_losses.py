"""What is left out is told at the line of the user's that it is about."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Iterable

from ._errors import LossWarning, as_typed_here

_here = os.path.dirname(__file__) + os.sep


def _levels() -> int:
    """How many calls the user's own is away from ``tell``, for ``warnings.warn``."""
    frame, count = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_here):
        frame, count = frame.f_back, count + 1
    return count


def tell(messages: Iterable[str]) -> None:
    """Each as a :class:`LossWarning`."""
    for message in messages:
        warnings.warn(as_typed_here(message), LossWarning, stacklevel=_levels())
