#!/usr/bin/env python3
"""Builds the library in many ways, and compares what each makes of shapes, to the bit, with the plain build.

  same_bytes.py [--count 1000] [--meshes FOLDER] [--work build/same_bytes] [BUILD…]

Compared are maps by all methods, their charts, roundings to float32, distortions, harmonics and
curvatures (same_maps.cpp): of generated shapes, and of the meshes of a folder. Other machines are
emulated by qemu-user, for every tenth shape (`--every`), and only for small meshes. A build is
a compiler with its flags, or a program with flags of its own that links the plain library; all of
them unless some are named. What is not there (a compiler, an emulator, a processor's instructions) is
said. Ends with 1 where a bit differs or nothing was compared; on other machines bits are known to differ
(the laws of ARCHITECTURE.md), and programs linked with -ffast-math make others of subnormal shapes.

Packages of Debian: clang, qemu-user, g++-aarch64-linux-gnu, g++-riscv64-linux-gnu, g++-s390x-linux-gnu.
"""

import argparse
import dataclasses
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
EMULATED_TRIANGLES = 1000  # of the largest mesh


@dataclasses.dataclass
class Build:
    name: str
    compiler: str
    flags: str
    machine: str = ""  # another one than this, as CMake and qemu call it
    needs: str = ""  # of this processor, as /proc/cpuinfo says it
    program: bool = False  # flags of the program alone; the library is the plain one


BUILDS = [
    Build("O0", "g++", "-O0"),
    Build("O1", "g++", "-O1"),
    Build("O2", "g++", "-O2"),
    Build("clang-O2", "clang++", "-O2"),
    Build("clang-O3", "clang++", "-O3"),
    Build("v3", "g++", "-O3 -march=x86-64-v3", needs="avx2"),
    Build("v4", "g++", "-O3 -march=x86-64-v4", needs="avx512vl"),
    Build("clang-v4", "clang++", "-O3 -march=x86-64-v4", needs="avx512vl"),
    Build("fast-math", "g++", "-O3 -ffast-math -march=native"),
    Build("program-native", "g++", "-O2 -march=native", program=True),
    Build("program-fast-math", "g++", "-O2 -ffast-math -march=native", program=True),
    Build("program-fast-math-O0", "g++", "-O0 -ffast-math -march=native", program=True),
    Build("arm64", "aarch64-linux-gnu-g++", "-O3", machine="aarch64"),
    Build("riscv64", "riscv64-linux-gnu-g++", "-O3", machine="riscv64"),
    Build("s390x", "s390x-linux-gnu-g++", "-O3", machine="s390x"),
]


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, **options)


def missing(build):
    """What this machine lacks for a build, or nothing."""
    if not shutil.which(build.compiler):
        return build.compiler
    if build.machine and not shutil.which(f"qemu-{build.machine}"):
        return f"qemu-{build.machine}"
    if build.needs and build.needs not in pathlib.Path("/proc/cpuinfo").read_text().split():
        return f"a processor with {build.needs}"
    return ""


def make_library(build, folder):
    system = ["-DCMAKE_SYSTEM_NAME=Linux", f"-DCMAKE_SYSTEM_PROCESSOR={build.machine}"]
    run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_CXX_COMPILER={build.compiler}", f"-DCMAKE_CXX_FLAGS_RELEASE={build.flags} -DNDEBUG",
        "-DSPHPARAM_BUILD_TOOLS=OFF", "-DSPHPARAM_BUILD_SAMPLES=OFF", "-DSPHPARAM_BUILD_TESTS=OFF",
        "-DSPHPARAM_COMPONENTS=", "-DSPHPARAM_PRECOMPILE_HEADERS=ON", *(system if build.machine else []),
        stdout=subprocess.DEVNULL)
    run("cmake", "--build", folder, "--target", "sphparam_library", "-j2", stdout=subprocess.DEVNULL)


def make_program(build, library, program):
    flags = build.flags.split() if build.program else ["-O1"]
    run(build.compiler, "-std=c++20", *flags, "-w", "-I", ROOT / "libsphparam/include",
        "-isystem", "/usr/include/eigen3", HERE / "same_maps.cpp",
        *([HERE / "stranger.cpp"] if build.program else []),
        library / "libsphparam/libsphparam.a", "-pthread", *(["-static"] if build.machine else []),
        "-o", program)


def results(build, program, shapes, every):
    """(shape, what was made): its bits."""
    command = [f"qemu-{build.machine}"] if build.machine else []
    command += [program, shapes]
    command += [every, EMULATED_TRIANGLES] if build.machine else []
    made = subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True)
    (program.parent / f"{program.name}.txt").write_text(made.stdout)
    lines = (line.split(maxsplit=2) for line in made.stdout.splitlines())
    return {(shape, what): bits for shape, what, bits in lines}


def differences(made, plain):
    return [key for key, bits in made.items() if plain.get(key) != bits]


def tell(build, made, plain):
    """One line; whether all is the same."""
    different = differences(made, plain)
    shapes = len({shape for shape, _ in made})
    line = f"{build.name}: {len(made)} results of {shapes} shapes, {len(different)} differ"
    if different:
        kinds = {what: sum(1 for _, w in different if w == what) for _, what in different}
        line += f": {kinds}, first {' '.join(different[0])}"
    print(line, flush=True)
    return bool(made) and not different


def compare(build, plain_library, plain, shapes, arguments):
    folder = arguments.work / build.name
    library = plain_library if build.program else folder
    if not build.program:
        make_library(build, folder)
    folder.mkdir(exist_ok=True)
    program = folder / "same_maps"
    make_program(build, library, program)
    return tell(build, results(build, program, shapes, arguments.every), plain)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("builds", metavar="BUILD", nargs="*", help=", ".join(b.name for b in BUILDS))
    parser.add_argument("--count", default=1000, type=int)
    parser.add_argument("--every", default=10, type=int)
    parser.add_argument("--meshes", type=pathlib.Path)
    parser.add_argument("--work", default=ROOT / "build/same_bytes", type=pathlib.Path)
    arguments = parser.parse_args()
    unknown = set(arguments.builds) - {b.name for b in BUILDS}
    if unknown:
        parser.error(f"no build {' '.join(unknown)}")
    arguments.work.mkdir(parents=True, exist_ok=True)

    release = ROOT / "build/release"
    run("cmake", "--build", release, "--target", "same_shapes", stdout=subprocess.DEVNULL)
    shapes = arguments.work / "shapes.txt"
    run(release / "tests/campaign/same_shapes", shapes, "--count", arguments.count,
        *(["--meshes", arguments.meshes] if arguments.meshes else []))
    plain_build = Build("plain", "g++", "-O3")
    plain_program = arguments.work / "plain"
    make_program(plain_build, release, plain_program)
    plain = results(plain_build, plain_program, shapes, 1)
    print(f"plain: {len(plain)} results of {len({shape for shape, _ in plain})} shapes", flush=True)

    same = True
    for build in BUILDS:
        if arguments.builds and build.name not in arguments.builds:
            continue
        if lacking := missing(build):
            print(f"{build.name}: not compared, there is no {lacking}", flush=True)
            continue
        same = compare(build, release, plain, shapes, arguments) and same
    return 0 if same and plain else 1


if __name__ == "__main__":
    sys.exit(main())
