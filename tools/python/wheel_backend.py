"""Wheels and source archives, by the hooks of PEP 517: CMake builds, this packs.

    python3 -m build --no-isolation                             both, in dist/
    python3 -m build --no-isolation --wheel -C build-dir=FOLDER  compiles there, and finds it there again
    CMAKE_ARGS="-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"           goes to CMake
"""

import os
import re
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
packed = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "pyproject.toml", "libsphparam", "tools")


def _project():
    try:
        import tomllib
    except ImportError:  # before Python 3.11
        import tomli as tomllib

    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    project["version"] = re.search(r"project\(sphparam VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text())[1]
    return project


def _metadata(project):
    needed = "".join(f"Requires-Dist: {name}\n" for name in project["dependencies"])
    return (
        f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n"
        f"Summary: {project['description']}\nLicense: {project['license']['text']}\n"
        f"Requires-Python: {project['requires-python']}\n{needed}"
        f"Description-Content-Type: text/markdown\n\n{(root / 'README.md').read_text()}"
    )


def _build(build, staged):
    """The package as CMake installs it, in `staged`."""
    options = {
        "CMAKE_BUILD_TYPE": "Release",
        "SPHPARAM_PYTHON": "ON",
        "Python_EXECUTABLE": sys.executable,
    }
    if not (build / "CMakeCache.txt").exists():  # one that is there keeps what it is for
        options.update(SPHPARAM_BUILD_TOOLS="OFF", SPHPARAM_BUILD_SAMPLES="OFF", SPHPARAM_BUILD_TESTS="OFF")
    given = [f"-D{name}={value}" for name, value in options.items()] + shlex.split(os.environ.get("CMAKE_ARGS", ""))
    for command in (
        ["cmake", "-G", "Ninja", "-S", root, "-B", build, *given],
        ["cmake", "--build", build, "--target", "sphparam_python"],
        ["cmake", "--install", build, "--component", "python_wheel", "--prefix", staged, "--strip"],
    ):
        subprocess.run(command, check=True)


def _numpy(build):
    """The NumPy that a module is for: those made with pybind11 before 2.12 cannot read arrays of NumPy 2."""
    folder = Path(re.search(r"^pybind11_DIR:PATH=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)[1])
    version = re.search(r'PACKAGE_VERSION "(\d+)\.(\d+)', (folder / "pybind11ConfigVersion.cmake").read_text())
    return "numpy<2" if (int(version[1]), int(version[2])) < (2, 12) else "numpy"


def _packed_tightly(wheel_file):
    """Wheels as small as deflate makes them, which WheelFile has no word for."""

    class Tight(wheel_file):
        def writestr(self, zinfo_or_arcname, data, compress_type=None):
            if hasattr(zinfo_or_arcname, "_compresslevel"):
                zinfo_or_arcname._compresslevel = 9  # pylint: disable=protected-access
            super().writestr(zinfo_or_arcname, data, compress_type)

    return Tight


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The wheel's name; it lies in `wheel_directory`."""
    from wheel.wheelfile import WheelFile

    project = _project()
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    name = f"{project['name']}-{project['version']}"
    with tempfile.TemporaryDirectory() as work:
        staged = Path(work) / "staged"
        build = Path((config_settings or {}).get("build-dir") or Path(work) / "build").resolve()
        _build(build, staged)
        project["dependencies"] = [_numpy(build)]
        about = staged / f"{name}.dist-info"
        about.mkdir()
        (about / "METADATA").write_text(_metadata(project))
        (about / "LICENSE").write_text((root / "LICENSE").read_text())
        (about / "WHEEL").write_text(
            f"Wheel-Version: 1.0\nGenerator: sphparam\nRoot-Is-Purelib: false\nTag: {tag}\n"
        )
        with _packed_tightly(WheelFile)(Path(wheel_directory) / f"{name}-{tag}.whl", "w") as wheel:
            wheel.write_files(str(staged))
    return f"{name}-{tag}.whl"


def _sources():
    """What is packed, by names from the root."""
    for part in packed:
        paths = [root / part] if (root / part).is_file() else sorted((root / part).rglob("*"))
        yield from (p.relative_to(root) for p in paths if p.is_file() and "__pycache__" not in p.parts)


def build_sdist(sdist_directory, config_settings=None):
    """The archive's name; it lies in `sdist_directory`."""
    project = _project()
    name = f"{project['name']}-{project['version']}"
    with tempfile.TemporaryDirectory() as work, tarfile.open(
        Path(sdist_directory) / f"{name}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT
    ) as archive:
        for source in _sources():
            archive.add(root / source, f"{name}/{source}")
        about = Path(work) / "PKG-INFO"
        about.write_text(_metadata(project))
        archive.add(about, f"{name}/PKG-INFO")
    return f"{name}.tar.gz"
