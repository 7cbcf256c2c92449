#!/bin/sh
# browse.sh check PROGRAM WORK [MESH…]: exports in a browser, six sides each, against the same mesh
#   textured per pixel by θ and ϕ; without meshes: one of our own
# browse.sh fidelity PROGRAM WORK MESHES: spot and Duck of a folder, baked, against themselves
# Pictures stay in WORK/pictures. Ends with 77, `skipped` for ctest, where something is missing.
set -u
here=$(cd "$(dirname "$0")" && pwd)
script=$1 program=$2 work=$3
shift 3
if [ "$script" = fidelity ]; then
  set -- "${SPHPARAM_MESHES:-$1}/genus0"
  [ -e "$1/spot_texture.png" ] && [ -e "$1/Duck.glb" ] || { echo "skipped: no meshes"; exit 77; }
fi
chromium=$(command -v chromium || command -v chromium-browser) || { echo "skipped: no chromium"; exit 77; }
command -v node >/dev/null || { echo "skipped: no nodejs"; exit 77; }
[ -e "$work/packages/node_modules/three" ] || { echo "skipped: no three.js"; exit 77; }
exec node "$here/browser/$script.mjs" "$work/packages" "$chromium" "$program" "$work/pictures" "$@"
