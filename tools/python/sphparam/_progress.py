"""Progress on terminals and in notebooks, or told to whoever wants it."""

from __future__ import annotations

import sys
import time
from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

Progress = Union[None, bool, Callable[[str, float], Any]]
"""None: a bar on terminals and in notebooks; True, False: a bar, none; or a function."""


class Bar:
    """A line that is written again and again, once a call has taken a while."""

    patience = 0.7
    """Seconds before anything is shown."""
    width = 24
    """Characters of the bar itself."""

    def __init__(self) -> None:
        self._begin = time.monotonic()
        self._shown = 0

    def __call__(self, stage: str, fraction: float) -> None:
        """Shows how far a stage is, 0 to 1."""
        if time.monotonic() - self._begin < self.patience:
            return
        done = min(max(fraction, 0.0), 1.0)
        full = int(done * self.width)
        line = f"{stage[:20]:20} {100 * done:3.0f}%|{'█' * full}{' ' * (self.width - full)}|"
        sys.stderr.write("\r" + line.ljust(self._shown))
        sys.stderr.flush()
        self._shown = len(line)

    def close(self) -> None:
        """Takes the line away."""
        if self._shown:
            sys.stderr.write("\r" + " " * self._shown + "\r")
            sys.stderr.flush()


def _is_watched() -> bool:
    if "ipykernel" in sys.modules:
        return True
    return sys.stderr is not None and sys.stderr.isatty()


@contextmanager
def told(progress: Progress) -> Iterator[Optional[Callable[[str, float], Any]]]:
    """What is called with stage and fraction while something runs, or None."""
    if progress is None:
        progress = _is_watched()
    if progress is False:
        yield None
    elif progress is True:
        bar = Bar()
        try:
            yield bar
        finally:
            bar.close()
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress: a function, True, False or None, not {type(progress).__name__}")
