"""The program `sphparam`, as a process a step."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
from typing import Callable, Dict, List, Optional, Sequence, Tuple

from .refusal import Defect, MeshRefused, Refusal, Stopped
from .routes import BakeSettings, Fit, Verdict

_mesh_exit, _interrupted_exit = 4, 130


def find(program: str) -> Optional[str]:
    """The path of the program; None: it is not there."""
    return shutil.which(program or "sphparam")


def _told(messages: List[str]) -> str:
    """What was wrong, without what to type in a shell."""
    lines = [line.removeprefix("sphparam: error: ") for line in messages]
    return "\n".join(line for line in lines if not line.startswith(("Try ", "sphparam: warning:")))


class ProgramRoute:
    """See `routes`."""

    name = "program"

    def __init__(self, program: str, threads: int = 0):
        self._program, self._threads = program, threads
        self.progress: Callable[[str, float], bool] = lambda stage, fraction: True

    def map(self, mesh: str, out: str, balance: str, quality: str) -> Verdict:
        found = self._reported("map", mesh, "-o", out, "--balance", balance, "--quality", quality)
        distortion = found["distortion"]
        return Verdict(
            found["certificate"]["verdict"], distortion["mean_abs_ln_angle"], distortion["mean_abs_ln_area"]
        )

    def chart(self, mapped: str, out: str, keep_topology: bool) -> None:
        words = ["--keep-topology"] if keep_topology else []
        self._run("export", mapped, "-o", out, "--shape", "sphere", "--image-size", "16", *words)

    def bake(self, mapped: str, images: Dict[str, str], settings: BakeSettings) -> None:
        for field, path in images.items():
            words = ["--size", str(settings.size), "--samples", str(settings.samples)]
            words += ["--rays", str(settings.rays), "--filter", settings.filter]
            words += ["--texture", settings.texture] if settings.texture else []
            words += ["--for", settings.target] if settings.target else []
            depth = ["--depth", "float"] if path.endswith(".exr") else []
            self._run("bake", mapped, "-o", path, "--map", field, *words, *depth)

    def remesh(self, mapped: str, grid: str, out: str) -> None:
        self._run("remesh", mapped, "--grid", grid, "-o", out)

    def fit(self, mapped: str, grid: str, out: str, image: str, size) -> Fit:
        width, height = size
        words = ["--subdiv-fit", "catmark", "--uv", "mesh", "--displace", image, "--displace-size", f"{width}x{height}"]
        found = self._reported("remesh", mapped, "--grid", grid, "-o", out, *words)
        displacement = found["displacement"]
        return Fit(found["subdivision"]["two_sided_rms"], displacement["min"], displacement["max"])

    def _reported(self, *words: str) -> dict:
        with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
            path = os.path.join(folder, "report.json")
            self._run(*words, "--json", path)
            if not os.path.exists(path):
                raise Refusal(f"{self._program} is not sphparam: say in the add-on's preferences where it is")
            with open(path, encoding="utf-8") as file:
                return json.load(file)

    def _run(self, *words: str) -> None:
        """One subcommand; progress and messages come as lines."""
        command = [self._program, *words, "--progress", "json", "--threads", str(self._threads)]
        messages: List[str] = []
        with subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            encoding="utf-8", errors="replace",
        ) as process:  # fmt: skip
            for line in process.stderr:
                if not line.startswith('{"stage"'):
                    messages.append(line.rstrip())
                    continue
                told = json.loads(line)
                if not self.progress(told["stage"], told["percent"] / 100):
                    process.send_signal(signal.SIGTERM)
            code = process.wait()
        if code == _interrupted_exit or code == -signal.SIGTERM:
            raise Stopped
        if code == _mesh_exit:
            raise self._refused(words, messages)
        if code:
            raise Refusal(_told(messages) or f"sphparam {words[0]} ended with status {code}")

    def _refused(self, words: Sequence[str], messages: List[str]) -> Exception:
        """Of the meshes that a subcommand was given, the first that is broken; where none is, as a mesh
        without area that is to be fitted, what was said."""
        meshes = [words[1]] + [path for word, path in zip(words, words[1:]) if word == "--for"]
        for mesh in meshes:
            defects = self._defects(mesh)
            if any(defect.fatal for defect in defects):
                return MeshRefused(defects, mesh)
        return Refusal(_told(messages) or f"sphparam {words[0]} ended with status {_mesh_exit}")

    def _defects(self, mesh: str) -> Tuple[Defect, ...]:
        done = subprocess.run(
            [self._program, "info", mesh, "--json", "-"], capture_output=True, encoding="utf-8", check=False
        )
        if not done.stdout:
            return ()
        found = json.loads(done.stdout)["inspection"]["defects"]
        return tuple(Defect(d["kind"], d["fatal"], tuple(d["first"]), d["message"], d["hint"]) for d in found)
