"""Work in a thread of its own, which can be watched and stopped."""

import tempfile
import threading
from typing import Any, Callable, Optional, Tuple

from .refusal import Stopped


class Job:
    """Runs `work(route, folder)`, which asks a route and knows nothing of Blender."""

    def __init__(self, route: Any, work: Callable[[Any, str], Any]):
        self._route, self._work = route, work
        self._stop = False
        self._told: Tuple[str, float] = ("", 0.0)
        self._result: Any = None
        self._error: Optional[BaseException] = None
        self._thread: Optional[threading.Thread] = None
        route.progress = self._progress

    @property
    def told(self) -> Tuple[str, float]:
        """The stage, and how much of it is done."""
        return self._told

    @property
    def is_done(self) -> bool:
        """Whether a started job has ended."""
        return self._thread is None or not self._thread.is_alive()

    def start(self) -> None:
        """Begins, and returns at once."""
        self._thread = threading.Thread(target=self._run, name="sphparam", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Asks it to end soon: `result` raises Stopped then."""
        self._stop = True

    def result(self) -> Any:
        """What came out, once it has ended; runs it here where it was not started. Raises what it raised."""
        if self._thread is None:
            self._run()
        else:
            self._thread.join()
        if self._error is not None:
            raise self._error
        return self._result

    def _progress(self, stage: str, fraction: float) -> bool:
        self._told = stage, fraction
        return not self._stop

    def _run(self) -> None:
        try:
            with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
                self._result = self._work(self._route, folder)
            if self._stop:
                raise Stopped
        except BaseException as error:  # told where the result is asked for
            self._error = error
