#!/usr/bin/env python3
"""The zip has the same bytes whenever it is made, the version of the project, and one folder.

check_zip.py MAKE_ZIP OUT
"""

import os
import pathlib
import re
import subprocess
import sys
import zipfile

make, out = map(pathlib.Path, sys.argv[1:])
subprocess.run([sys.executable, make, out], check=True)
again = out.with_suffix(".again")
os.umask(0o077)
subprocess.run([sys.executable, make, again], check=True, cwd="/")
assert out.read_bytes() == again.read_bytes(), "the same bytes"
with zipfile.ZipFile(out) as archive:
    names = archive.namelist()
    text = archive.read("spherical_map/__init__.py").decode()
assert all(name.startswith("spherical_map/") for name in names) and len(names) > 20, names
for name in ("README.md", "LICENSE"):
    assert "spherical_map/" + name in names, name
project = (make.parents[2] / "CMakeLists.txt").read_text()
version = re.search(r"VERSION\s+(\d+)\.(\d+)\.(\d+)", project).groups()
assert f'"version": ({", ".join(version)})' in text, version
print(f"blender: a zip of {len(names)} files, the same bytes each time")
