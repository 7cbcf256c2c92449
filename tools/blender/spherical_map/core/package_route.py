"""The Python package `sphparam`, in Blender's own process."""

import importlib
import sys
import warnings
from typing import Any, Callable, Dict

from .refusal import Defect, MeshRefused, Refusal, Stopped
from .routes import BakeSettings, Fit, Verdict


def find(folder: str) -> Any:
    """The package, also of a folder where Blender's Python does not look; or why there is none."""
    if folder and folder not in sys.path:
        sys.path.insert(0, folder)
        importlib.invalidate_caches()
    try:
        return importlib.import_module("sphparam")
    except ImportError as error:
        return str(error)


class PackageRoute:
    """See `routes`."""

    name = "package"

    def __init__(self, package: Any, threads: int = 0):
        self._sphparam, self._threads, self._mesh = package, threads, ""
        self.progress: Callable[[str, float], bool] = lambda stage, fraction: True

    def map(self, mesh: str, out: str, balance: str, quality: str) -> Verdict:
        def step(sp, common):
            made = sp.map(self._opened(sp.read, mesh), balance=balance, quality=quality, **common)
            made.save(out)
            distortion = made.distortion
            return Verdict(
                made.certificate.verdict, distortion.mean_abs_ln_angle, distortion.mean_abs_ln_area
            )

        return self._run(step)

    def chart(self, mapped: str, out: str, keep_topology: bool) -> None:
        options = dict(shape="sphere", image_size=16, keep_topology=keep_topology)
        self._run(lambda sp, common: self._load(mapped).export(out, **options, **common))

    def bake(self, mapped: str, images: Dict[str, str], settings: BakeSettings) -> None:
        def step(sp, common):
            source = self._load(mapped)
            target = self._load(settings.target) if settings.target else None
            for field, path in images.items():
                source.bake_files(
                    {field: path}, size=settings.size, samples=settings.samples, texture=settings.texture,
                    filter=settings.filter, rays=settings.rays, target=target,
                    depth="float" if path.endswith(".exr") else None, **common,
                )  # fmt: skip

        self._run(step)

    def remesh(self, mapped: str, grid: str, out: str) -> None:
        self._run(lambda sp, common: self._load(mapped).remesh(grid, **common).save(out))

    def fit(self, mapped: str, grid: str, out: str, image: str, size) -> Fit:
        def step(sp, common):
            fitted = self._load(mapped).fit(grid, scheme="catmark", **common)
            fitted.control.save(out)
            found = fitted.displace(image, size=tuple(size), **common)
            return Fit(fitted.two_sided_rms, found.least, found.greatest)

        return self._run(step)

    def _load(self, path: str) -> Any:
        return self._opened(self._sphparam.load, path, threads=self._threads)

    def _opened(self, read: Callable[..., Any], path: str, **options: int) -> Any:
        """What `read` makes of a file; errors about a mesh are about the last one."""
        self._mesh = path
        return read(path, **options)

    def _run(self, step) -> Any:
        """A step with the options that all calls have; its exceptions as those of `routes`."""
        sp = self._sphparam
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", sp.LossWarning)
                return step(sp, dict(threads=self._threads, progress=self.progress))
        except sp.Cancelled:
            raise Stopped from None
        except sp.MeshError as error:
            defects = tuple(Defect(d.kind, d.fatal, d.ids, d.message, d.hint) for d in error.defects)
            if any(defect.fatal for defect in defects):
                raise MeshRefused(defects, self._mesh) from None
            raise Refusal(str(error)) from None
        except (sp.NotCertified, ValueError, OSError, ArithmeticError) as error:
            raise Refusal(str(error)) from None
