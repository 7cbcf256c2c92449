// See ../browse.sh: spot and Duck of a folder of meshes,
// exported with their baked textures, against themselves with their own: PSNR over six sides of
// 1024², without light, by the same viewer; with anisotropic filtering (16) and without. Near a pole
// many texels of a row lie within a pixel, and mip levels without anisotropy blur them all.
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { runPage } from './serve.mjs';

const least = 36;  // decibels
const [packages, chromium, program, output, folder] = process.argv.slice(2);
mkdirSync(output, { recursive: true });
const at = (name) => join(output, name);
const run = (...args) => execFileSync(program, [...args, '-q'], { stdio: 'inherit' });
for (const [from, to] of [['spot_triangulated.obj', 'spot.obj'], ['spot_texture.png', 'spot.png'], ['Duck.glb', 'duck.glb']])
  copyFileSync(join(folder, from), at(to));
run('map', at('spot.obj'), '-o', at('spot.sph.ply'));
run('bake', at('spot.sph.ply'), '--map', 'basecolor', '--size', '4096', '--texture', at('spot.png'), '-o', at('spot_baked.png'));
run('export', at('spot.sph.ply'), '--up', 'y', '--image', at('spot_baked.png'), '-o', at('spot_ours.glb'));
run('export', at('duck.glb'), '--image-size', '4096', '-o', at('duck_ours.glb'));

const models = [], comparisons = [];
for (const anisotropy of [16, 1]) {
  const files = { spot: { file: 'spot.obj', texture: 'spot.png' }, duck: { file: 'duck.glb' } };
  for (const [name, own] of Object.entries(files)) {
    const [a, b] = [`${name}_own_${anisotropy}`, `${name}_ours_${anisotropy}`];
    models.push({ ...own, name: a, mode: 'uv', anisotropy, save: true },
                { file: `${name}_ours.glb`, name: b, mode: 'uv', anisotropy, save: true });
    comparisons.push({ a, b, anisotropy });
  }
}
const report = await runPage({
  chromium, output, page: 'views.html', job: { size: 1024, models, comparisons },
  roots: { page: dirname(fileURLToPath(import.meta.url)), three: join(packages, 'node_modules/three'), files: output },
});
if (report.error) throw new Error(report.error);
let failed = false;
for (const { b, psnr, views, anisotropy } of report.comparisons) {
  console.log(`${b}: ${psnr.toFixed(1)} dB (${views.map((x) => x.toFixed(1)).join(' ')})`);
  failed ||= anisotropy > 1 && psnr < least;
}
process.exit(failed ? 1 : 0);
