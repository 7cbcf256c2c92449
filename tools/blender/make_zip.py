#!/usr/bin/env python3
"""Makes the add-on's zip, which Blender installs: the same bytes whenever and wherever it is made.

    make_zip.py OUT
"""

import pathlib
import sys
import zipfile

_folder = pathlib.Path(__file__).resolve().parent / "spherical_map"
_day = (1980, 1, 1, 0, 0, 0)  # the first that a zip knows
_mode = 0o100644 << 16


def main(out: str) -> None:
    files = sorted(_folder.rglob("*.py"), key=lambda path: path.relative_to(_folder).as_posix())
    with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as archive:  # what zlib makes depends on its version
        for path in [*files, _folder / "README.md", _folder.parents[2] / "LICENSE"]:
            inside = path.name if path.name == "LICENSE" else path.relative_to(_folder).as_posix()
            entry = zipfile.ZipInfo(f"{_folder.name}/{inside}", _day)
            entry.external_attr, entry.create_system = _mode, 3
            archive.writestr(entry, path.read_bytes())


main(sys.argv[1])
