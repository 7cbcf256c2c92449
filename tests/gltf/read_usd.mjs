// tinyusdz over exports: node read_usd.mjs PACKAGES MESH.glb USD…
// Ends with 1 where a mesh of USD has other numbers than the .glb, bit by bit: points, triangles,
// normals, (u, 1 - v); and where its material does not show what that of the .glb does.
import { copyFileSync, readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [packages, glb, ...files] = process.argv.slice(2);
const folder = resolve(packages, 'node_modules/tinyusdz');

// It is made for browsers, and asks whether this is one.
globalThis.window = globalThis;
process.type = 'renderer';
// Its package does not say that it is a module: Debian's node knows it by the name alone.
const tinyusdz = join(dirname(resolve(glb)), 'tinyusdz.mjs');
copyFileSync(join(folder, 'tinyusdz.js'), tinyusdz);
const { default: initialise } = await import(pathToFileURL(tinyusdz));
const module = await initialise({ wasmBinary: readFileSync(join(folder, 'tinyusdz.wasm')) });

const bytes = readFileSync(glb);
const jsonEnd = 20 + bytes.readUInt32LE(12);
const gltf = JSON.parse(bytes.subarray(20, jsonEnd).toString());
const attributes = gltf.meshes[0].primitives[0].attributes;

function numbersOf(accessorIndex) {
  const accessor = gltf.accessors[accessorIndex];
  const width = { SCALAR: 1, VEC2: 2, VEC3: 3 }[accessor.type];
  const Numbers = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array }[accessor.componentType];
  const view = gltf.bufferViews[accessor.bufferView];
  const start = bytes.byteOffset + jsonEnd + 8 + view.byteOffset + (accessor.byteOffset ?? 0);
  const length = accessor.count * width * Numbers.BYTES_PER_ELEMENT;
  return Array.from(new Numbers(bytes.buffer.slice(start, start + length)));
}

const upward = (number, index) => (index % 2 === 1 ? Math.fround(1 - number) : number);
const wanted = {
  points: numbersOf(attributes.POSITION),
  normals: numbersOf(attributes.NORMAL),
  texcoords: numbersOf(attributes.TEXCOORD_0).map(upward),
  faceVertexIndices: numbersOf(gltf.meshes[0].primitives[0].indices),
};

let bad = 0;
function require(holds, words) {
  if (holds) return;
  console.log(words);
  bad = 1;
}

for (const file of files) {
  const scene = new module.TinyUSDZLoaderNative();
  if (!scene.loadFromBinary(new Uint8Array(readFileSync(file)), file)) {
    require(false, `${file}: ${scene.error()}`);
    continue;
  }
  require(scene.numMeshes() === 1, `${file}: ${scene.numMeshes()} meshes`);
  const mesh = scene.getMesh(0);
  for (const [name, numbers] of Object.entries(wanted)) {
    const found = Array.from(mesh[name]);
    require(found.length === numbers.length, `${file}: ${found.length} ${name}, not ${numbers.length}`);
    const other = numbers.findIndex((number, i) => number !== found[i]);
    require(other === -1, `${file}: ${name} ${other}: ${found[other]}, not ${numbers[other]}`);
  }
  require(mesh.faceVertexCounts.every((count) => count === 3), `${file}: no triangles`);
  const material = scene.getMaterial(mesh.materialId);
  const shown = gltf.materials[0];
  for (const [input, there] of [
    ['diffuseColorTextureId', shown.pbrMetallicRoughness.baseColorTexture],
    ['normalTextureId', shown.normalTexture],
    ['occlusionTextureId', shown.occlusionTexture],
  ])
    require((material[input] >= 0) === (there !== undefined), `${file}: ${input} ${material[input]}`);
}
console.log(`${files.length} files, ${wanted.points.length / 3} vertices: ${bad ? 'wrong' : 'as the .glb'}`);
process.exit(bad);
