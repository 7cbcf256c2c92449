#!/bin/sh
# read_usd.sh SPHPARAM WORK [MESH…]: what another reader of USD, tinyusdz, finds in exports is what
# the .glb of the same mesh has.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=$1 work=$2
shift 2
command -v node >/dev/null || { echo "skipped: no nodejs"; exit 77; }
[ -e "$work/packages/node_modules/tinyusdz" ] || { echo "skipped: no tinyusdz"; exit 77; }
folder=$work/usd
rm -rf "$folder"
mkdir -p "$folder/images"
if [ $# -eq 0 ]; then
  printf 'v 1 0 0\nv 0 2 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\nf 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3
f 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n' >"$folder/octahedron.obj"
  "$program" remesh "$folder/octahedron.obj" --grid ico:4 -o "$folder/small.sph.ply" --quiet
  set -- "$folder/small.sph.ply"
fi
for mesh in "$@"; do
  "$program" map "$mesh" -o "$folder/mesh.sph.ply" --quiet
  for map in normal-tangent ao; do
    "$program" bake "$folder/mesh.sph.ply" --map $map --size 64 -o "$folder/images/mesh_$map.png" --quiet
  done
  for kind in glb usda usdz; do
    "$program" export "$folder/mesh.sph.ply" --images "$folder/images" -o "$folder/mesh.$kind" --quiet
  done
  node "$here/read_usd.mjs" "$work/packages" "$folder/mesh.glb" "$folder/mesh.usda" "$folder/mesh.usdz"
done
rm -rf "$folder"
