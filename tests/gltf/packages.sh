#!/bin/sh
# packages.sh FOLDER: puts the pinned packages of package-lock.json there, by npm. Ends with 77,
# `skipped` for ctest, where there is no npm, nodejs or network.
set -u
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1" && cd "$1" || exit 1
command -v npm >/dev/null && command -v node >/dev/null || { echo "skipped: no npm"; exit 77; }
if cmp -s "$here/package-lock.json" package-lock.json && [ -d node_modules/gltf-validator ]; then
  exit 0
fi
cp "$here/package.json" "$here/package-lock.json" .
if ! npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1; then
  rm -f package-lock.json
  grep -q EINTEGRITY npm.log && { cat npm.log; exit 1; }
  echo "skipped: npm could not fetch the packages"; tail -3 npm.log
  exit 77
fi
