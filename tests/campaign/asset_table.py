#!/usr/bin/env python3
"""What becomes of artists' assets: `sphparam FILE` on every glTF, GLB, OBJ, FBX and COLLADA below some folders.

    asset_table.py --program build/release/bin/sphparam --out made/ --log assets.tsv FOLDER ...

Public repositories with such files: bevyengine/bevy, playcanvas/engine, aframevr/assets, assimp/assimp,
donmccurdy/glTF-Transform, mikedh/trimesh, alecjacobson/common-3d-test-models. A line an asset, then shares. An asset
in several files counts once; files of the same bytes count once. `whole` are those that end with 0 as they are,
mended with 98 % of their area, or wrapped; of every other one the reason is told. With --validator PROGRAM each
.glb is validated (`gltf_validator -o`), and its errors counted.
"""

import argparse
import hashlib
import json
import pathlib
import subprocess
import time

ENDINGS = {".glb", ".gltf", ".obj", ".fbx", ".dae"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--out", required=True, type=pathlib.Path, help="a folder for what is made")
    parser.add_argument("--log", required=True, type=pathlib.Path, help="a line an asset; known ones are left out")
    parser.add_argument("--size", type=int, default=1024)
    parser.add_argument("--seconds", type=float, default=300, help="an asset that takes longer is stopped")
    parser.add_argument("--validator", help="program that validates a .glb and prints JSON")
    return parser.parse_args()


def assets(folders):
    seen = set()
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() not in ENDINGS or not path.is_file():
                continue
            digest = hashlib.sha256(path.read_bytes()).hexdigest()
            if digest not in seen:
                seen.add(digest)
                yield str(path.relative_to(folder.parent)), path, digest[:12]


def errors_in(validator, glb):
    told = subprocess.run([validator, "-o", glb], capture_output=True, text=True, check=False).stdout
    return json.loads(told)["issues"]["numErrors"]


def row_of(options, path, digest):
    folder = options.out / digest
    record = options.out / (digest + ".json")
    command = [options.program, path, "-o", folder, "--size", str(options.size), "--json", record, "-q", "--no-page"]
    begun = time.monotonic()
    try:
        ended = subprocess.run(command, capture_output=True, text=True, timeout=options.seconds, check=False)
    except subprocess.TimeoutExpired:
        return "stopped", "", "", f"{options.seconds:.0f}", "took too long"
    seconds = f"{time.monotonic() - begun:.1f}"
    if ended.returncode != 0:
        return f"exit {ended.returncode}", "", "", seconds, " ".join(ended.stderr.split())[:200]
    made = json.loads(record.read_text())
    told = "; ".join(made["warnings"])[:200]
    if options.validator:
        told = f"{errors_in(options.validator, next(folder.glob('*.glb')))} errors; " + told
    return made["surface"], f"{made['area_kept']:.4f}", str(made["triangles"]), seconds, told


def known(log):
    return {line.split("\t")[0] for line in log.read_text().splitlines()} if log.exists() else set()


def tell(log):
    rows = [line.split("\t") for line in log.read_text().splitlines()]
    ways = sorted({row[1] for row in rows})
    whole = sum(row[1] in ("itself", "repair", "wrap") for row in rows)
    for way in ways:
        print(f"{way:10} {sum(row[1] == way for row in rows):4}")
    print(f"whole: {whole} of {len(rows)} ({100 * whole / max(1, len(rows)):.1f} %)")


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    done = known(options.log)
    with options.log.open("a") as log:
        for name, path, digest in assets(options.folders):
            if name in done:
                continue
            print("\t".join((name, *row_of(options, path, digest))), file=log, flush=True)
    tell(options.log)


if __name__ == "__main__":
    main()
