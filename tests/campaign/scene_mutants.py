#!/usr/bin/env python3
"""FBX and COLLADA files of strangers, mutated by chance, through the program: assimp works in a process of its own,
where libFuzzer does not see, so these come from outside.

    tests/campaign/scene_mutants.py build/release/bin/sphparam --count 3000 [--seed 1] [--keep FOLDER] [FILE…]

Starts from the files of tests/hostile that are right, or from those named. A run may end with 0, 3, 4 or 5, within
10 s of a processor and 1 GB; whatever else it does is told with its number, and its file is kept. Exit code 1 then.
"""
import argparse
import collections
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DOCUMENTED = {0, 3, 4, 5}
SECONDS, BYTES = 10, 1 << 30
NUMBERS = [b"-1", b"0", b"1e300", b"nan", b"inf", b"4294967295", b"2147483648", b"99999999999999999999", b"", b"x", b"\0"]


def any_place(random, data):
    return random.randrange(len(data) + 1)


def mutated(random, data, others):
    """One to eight changes: of bytes, of numbers in the text, of pieces that move, go or come from another file."""
    data = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 4, 8))):
        at = any_place(random, data)
        end = min(len(data), at + random.choice((1, 4, 16, 200)))
        kind = random.randrange(7)
        if kind == 0 and at < len(data):
            data[at] = random.randrange(256)
        elif kind == 1 and at < len(data):
            data[at] ^= 1 << random.randrange(8)
        elif kind == 2:
            del data[at:end]
        elif kind == 3:
            data[at:at] = data[at:end] * random.choice((1, 2, 50))
        elif kind == 4:
            other = random.choice(others)
            begin = any_place(random, other)
            data[at:end] = other[begin:begin + random.choice((4, 64, 1000))]
        elif kind == 5:
            places = [i for i, byte in enumerate(data) if chr(byte) in "0123456789"]
            if places:
                first = random.choice(places)
                last = first
                while last < len(data) and chr(data[last]) in "0123456789.-+e":
                    last += 1
                data[first:last] = random.choice(NUMBERS)
        elif at + 4 <= len(data):
            data[at:at + 4] = random.choice((0, 1, 2**31 - 1, 2**31, 2**32 - 1)).to_bytes(4, "little")
    return bytes(data)


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_DATA, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="where files go that fail")
    arguments = parser.parse_intermixed_args()
    hostile = HERE.parent / "hostile" / "files"
    files = arguments.files or sorted([*hostile.glob("fbx_ok_*"), *hostile.glob("collada_ok_*")])
    seeds = [(path.suffix, path.read_bytes()) for path in files]
    codes, failed = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(arguments.count):
            chance = random.Random(arguments.seed * 1_000_003 + number)
            suffix, data = chance.choice(seeds)
            path = pathlib.Path(folder) / ("mutant" + suffix)
            path.write_bytes(mutated(chance, data, [other for _, other in seeds]))
            command = [arguments.program, "map", str(path), "-o", str(path) + ".sph.ply", "--threads", "1"]
            try:
                code = subprocess.run(command, capture_output=True, preexec_fn=limited, timeout=6 * SECONDS).returncode
            except subprocess.TimeoutExpired:
                code = "no end"
            codes[code] += 1
            if code in DOCUMENTED:
                continue
            failed += 1
            print(f"mutant {number}: {code}", flush=True)
            if arguments.keep:
                arguments.keep.mkdir(exist_ok=True)
                (arguments.keep / f"mutant_{number}{suffix}").write_bytes(path.read_bytes())
    print(", ".join(f"{count} ended with {code}" for code, count in sorted(codes.items(), key=str)))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
