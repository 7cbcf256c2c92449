#!/usr/bin/env python3
"""Proves maps and charts once more, with other code: in whole numbers, by files alone.

  verify.py FILE…       .ply with a map (sx, sy, sz) or a chart (texcoord), sphere*.gii, .obj with a chart
  verify.py --below FOLDER [--most-faces 50000]      all of these that are there

It shares nothing with the program but the two theorems, which open sphere/certificate.cpp and
chart/chart_certificate.cpp. A line a proof, and how many; a map that its file calls folded must be so.
Ends with 1 where a file is not as it says, or where there was nothing to prove.
"""

import argparse
import pathlib
import sys

from chart_proof import prove_chart
from files import chart_of_ply, map_of_ply, read_gifti, read_obj, read_ply
from sphere_proof import prove_map
from surface import Refused


def claims_of_ply(path):
    """Texture coordinates beside a map are the mesh's own, and no chart of it."""
    ply, verdict = read_ply(path)
    found = map_of_ply(ply)
    if found:
        return [("map", prove_map, found, verdict in ("", "one-to-one"))]
    return [("chart", prove_chart, chart_of_ply(ply), True)]


def claims_of(path):
    """What a file says of itself: (what, proof, its arguments, whether it says that it holds)."""
    if path.suffix == ".ply":
        found = claims_of_ply(path)
    elif path.suffix == ".gii":
        found = [("map", prove_map, read_gifti(path), True)]
    else:
        found = [("chart", prove_chart, read_obj(path), True)]
    return [claim for claim in found if claim[2] is not None]


def outcome(prove, data, said):
    """What was found, and whether it is as the file says."""
    try:
        prove(*data)
        return ("one-to-one" if said else "one-to-one, and the file says it is NOT"), said
    except Refused as error:
        return f"{'REFUSED' if said else 'not one-to-one, as the file says'}: {error}", not said


def proofs_of(path):
    """Lines of what is as the file says, and of what is not."""
    lines = ([], [])
    for what, prove, data, said in claims_of(path):
        told, holds = outcome(prove, data, said)
        lines[0 if holds else 1].append(f"{path}: {what} {told}")
    return lines


def wanted_below(folder, most_faces):
    names = ("*.sph.ply", "*.sphere*.surf.gii", "*.export.ply", "*.export.obj")
    paths = sorted(path for name in names for path in folder.rglob(name))
    # A triangle of a map has some 70 bytes in a file.
    return [path for path in paths if path.stat().st_size < 100 * most_faces]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    parser.add_argument("--below", type=pathlib.Path)
    parser.add_argument("--most-faces", type=int, default=50000)
    a = parser.parse_args()
    paths = a.files + (wanted_below(a.below, a.most_faces) if a.below else [])
    count, failures = 0, 0
    for path in paths:
        proved, failed = proofs_of(path)
        count, failures = count + len(proved), failures + len(failed)
        print("\n".join(proved + failed), flush=True)
    print(f"{count} proved, {failures} refused")
    return 1 if failures or not count else 0


if __name__ == "__main__":
    sys.exit(main())
