"""NumPy, imported when the first array is touched: it takes longer than all of this package."""

from __future__ import annotations

from typing import Any


class _NumPy:
    def __getattr__(self, name: str) -> Any:
        import numpy

        return getattr(numpy, name)


np: Any = _NumPy()
