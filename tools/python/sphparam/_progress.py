"""Progress on terminals and in notebooks, or told to whoever wants it."""

from __future__ import annotations

import html
import sys
import time
from contextlib import contextmanager
from importlib import import_module
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
        self._show(f"{stage[:20]:20} {100 * done:3.0f}%|{'█' * full}{' ' * (self.width - full)}|")

    def _show(self, line: str) -> None:
        sys.stderr.write("\r" + line.ljust(self._shown))
        sys.stderr.flush()
        self._shown = len(line)

    def close(self) -> None:
        """Takes the line away."""
        if self._shown:
            sys.stderr.write("\r" + " " * self._shown + "\r")
            sys.stderr.flush()


class NotebookBar(Bar):
    """The same in the output of a notebook's cell, where nothing is left of it in the end."""

    def __init__(self) -> None:
        super().__init__()
        self._cell: Any = None

    def _show(self, line: str) -> None:
        shown = import_module("IPython.display")
        page = shown.HTML(f"<pre>{html.escape(line)}</pre>" if line else "")
        if self._cell is None:
            self._cell = shown.display(page, display_id=True)
        else:
            self._cell.update(page)

    def close(self) -> None:
        """Takes the line away."""
        if self._cell is not None:
            self._show("")


def _in_notebook() -> bool:
    return "ipykernel" in sys.modules


def _is_watched() -> bool:
    return _in_notebook() or (sys.stderr is not None and sys.stderr.isatty())


@contextmanager
def told(progress: Progress) -> Iterator[Optional[Callable[[str, float], Any]]]:
    """What is called with stage and fraction while something runs, or None."""
    if progress is None:
        progress = _is_watched()
    if progress is False:
        yield None
    elif progress is True:
        bar = NotebookBar() if _in_notebook() else Bar()
        try:
            yield bar
        finally:
            bar.close()
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress: a function, True, False or None, not {type(progress).__name__}")
