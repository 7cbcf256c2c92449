#!/bin/sh
# validate.sh EXPORT_FILES WORK [MESH…]: exports with every option, through the Khronos validator.
# All real meshes: tests/gltf/validate.sh build/…/export_files WORK MESHES/genus0/*
set -u
here=$(cd "$(dirname "$0")" && pwd)
export_files=$1 work=$2
shift 2
command -v node >/dev/null || { echo "skipped: no nodejs"; exit 77; }
[ -e "$work/packages/node_modules/gltf-validator" ] || { echo "skipped: no validator"; exit 77; }
failed=0
validate() {
  rm -rf "$work/files"
  "$export_files" "$work/files" "$@" || return 1
  node "$here/validate.mjs" "$work/packages" "$work/files"/*.gl* || return 1
}
if [ $# -eq 0 ]; then validate || failed=1; fi
for mesh in "$@"; do validate "$mesh" || { echo "  of $mesh"; failed=1; }; done
rm -rf "$work/files"
exit $failed
