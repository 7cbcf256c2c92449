// How large assets are, beside glTF-Transform: geometry and images apart, and what images lose.
//
//     npm install --prefix FOLDER @gltf-transform/cli
//     node tests/bench/size_table.mjs PROGRAM FOLDER WORK FILE…
//
// Each FILE becomes an asset in WORK by `sphparam asset`, which is exported with several options, and the plain one is
// given to `gltf-transform meshopt` and `webp`. Two tables in Markdown.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, extname, join, resolve } from 'node:path';

const [program, packages, work, ...files] = process.argv.slice(2);
const sharp = createRequire(resolve(packages, 'package.json'))('sharp');
const transform = (...words) =>
  execFileSync(join(packages, 'node_modules/.bin/gltf-transform'), words, { stdio: 'pipe' });
const sphparam = (...words) => execFileSync(program, [...words, '--quiet'], { stdio: 'pipe' });

/// The JSON of a .glb, and the bytes of its images by their names.
function opened(path) {
  const file = readFileSync(path);
  const length = file.readUInt32LE(12);
  const json = JSON.parse(file.toString('utf8', 20, 20 + length));
  const images = new Map();
  for (const image of json.images ?? []) {
    const view = json.bufferViews[image.bufferView];
    const first = 28 + length + (view.byteOffset ?? 0);
    images.set(image.name, file.subarray(first, first + view.byteLength));
  }
  const image_bytes = [...images.values()].reduce((sum, image) => sum + image.length, 0);
  return { images, image_bytes, geometry: file.length - image_bytes };
}

const thousands = (bytes) => bytes.toLocaleString('en');
const samples = (bytes) => sharp(bytes).removeAlpha().toColourspace('srgb').raw().toBuffer();

/// PSNR in decibels, and the mean angle in degrees of what two texels are as vectors.
async function loss(given, made) {
  const [a, b] = [await samples(given), await samples(made)];
  let squares = 0;
  let angles = 0;
  for (let i = 0; i < a.length; i += 3) {
    const p = [0, 1, 2].map((k) => a[i + k] / 127.5 - 1);
    const q = [0, 1, 2].map((k) => b[i + k] / 127.5 - 1);
    for (let k = 0; k < 3; ++k) squares += (a[i + k] - b[i + k]) ** 2;
    const cross = [0, 1, 2].map((k) => p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]);
    angles += Math.atan2(Math.hypot(...cross), p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
  }
  return { psnr: 10 * Math.log10((255 ** 2 * a.length) / squares), angle: ((angles / a.length) * 3 * 180) / Math.PI };
}

/// "0", "39.8 dB", "5.3°".
async function told(name, given, made) {
  const { psnr, angle } = await loss(given, made);
  if (!Number.isFinite(psnr)) return 'nothing';
  return name.includes('normal') ? `${angle.toFixed(1)}°` : `${psnr.toFixed(1)} dB`;
}

mkdirSync(work, { recursive: true });
const sizes = [];
const losses = [];
for (const file of files) {
  const name = basename(file, extname(file));
  const path = (kind) => join(work, `${name}_${kind}.glb`);
  const folder = join(work, name);
  sphparam('asset', file, '--no-page', '-o', folder);
  const map = join(folder, `${name}.sph.ply`);
  const write = (kind, ...options) => sphparam('export', map, '--images', folder, '-o', path(kind), ...options);
  write('plain');
  write('compress', '--compress');
  for (const format of ['jpeg', 'webp-lossless', 'webp']) write(format, '--compress', '--textures', format);
  transform('meshopt', path('plain'), path('meshopt'));
  transform('webp', path('plain'), path('halfway'));
  transform('meshopt', path('halfway'), path('theirs'));
  const [plain, compressed, meshopt] = ['plain', 'compress', 'meshopt'].map((kind) => opened(path(kind)));
  sizes.push([name, plain.geometry, compressed.geometry, meshopt.geometry].map((n) => (n === name ? n : thousands(n))));
  for (const [image, bytes] of plain.images) {
    const row = [name, image, thousands(bytes.length)];
    for (const kind of ['jpeg', 'webp-lossless', 'webp', 'theirs']) {
      const made = opened(path(kind)).images.get(image);
      row.push(`${thousands(made.length)}, ${await told(image, bytes, made)}`);
    }
    losses.push(row);
  }
}
const table = (head, rows) => [head, head.map(() => '---'), ...rows].map((row) => `| ${row.join(' | ')} |`).join('\n');
console.log(table(['geometry, bytes', 'plain', '`--compress`', '`gltf-transform meshopt`'], sizes));
console.log();
console.log(table(['', 'image', 'PNG, bytes', '`--textures jpeg`, lost', '`webp-lossless`', '`webp`', '`gltf-transform webp`'], losses));
