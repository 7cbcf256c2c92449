// node check.mjs PACKAGES CHROMIUM PROGRAM OUTPUT [MESH…]: see ../browse.sh.
import { execFileSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { basename, dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { runPage } from './serve.mjs';

const [packages, chromium, program, output, ...given] = process.argv.slice(2);
mkdirSync(output, { recursive: true });
const run = (...args) => execFileSync(program, args, { stdio: ['ignore', 'inherit', 'inherit'] });

/// A sphere with bumps, no symmetry: an octahedron halved five times, as OFF.
function bumpySphere(path) {
  let points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
  for (let level = 0; level < 5; ++level) {
    const middles = new Map();
    const middle = (a, b) => {
      const key = a < b ? `${a},${b}` : `${b},${a}`;
      if (!middles.has(key)) {
        const sum = points[a].map((x, k) => x + points[b][k]);
        middles.set(key, points.push(sum.map((x) => x / Math.hypot(...sum))) - 1);
      }
      return middles.get(key);
    };
    faces = faces.flatMap(([a, b, c]) => {
      const [d, e, f] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, d, f], [d, b, e], [f, e, c], [d, e, f]];
    });
  }
  points = points.map(([x, y, z]) => {
    const r = 1 + 0.15 * Math.sin(3 * x + 1) * Math.cos(4 * y) + 0.2 * z * z;
    return [r * x, 0.8 * r * y, r * z];
  });
  const rows = [...points, ...faces.map((face) => [3, ...face])].map((row) => row.join(' '));
  writeFileSync(path, `OFF\n${points.length} ${faces.length} 0\n${rows.join('\n')}\n`);
}

/// Exports of a mesh, the pictures to take of them and what to compare.
function prepare(mesh) {
  const name = basename(mesh, extname(mesh)).split('.')[0];
  const map = join(output, `${name}.sph.ply`);
  run('map', mesh, '-q', '-o', map);
  run('bake', map, '-q', '--size', '2048', '--map', 'axes,checker,graticule',
      '-o', join(output, `${name}_{map}.png`));
  run('bake', map, '-q', '--size', '2048', '--map', 'axes', '--convention', 'envmap',
      '-o', join(output, `${name}_envmap_{map}.png`));
  run('bake', map, '-q', '--size', '2048', '--map', 'checker', '--refine-poles', '16',
      '-o', join(output, `${name}_poles_{map}.png`));
  const export_ = (as, texture, ...options) => {
    run('export', map, '-q', '--unlit', '--up', 'z', '--image', join(output, `${name}_${texture}.png`),
        '-o', join(output, `${name}_${as}.glb`), ...options);
    return `${name}_${as}.glb`;
  };
  const models = [], comparisons = [];
  const add = (as, file, mode, save) =>
    models.push({ name: `${name}_${as}`, file, mode, filter: mode === 'region' ? undefined : 'linear', save });
  for (const texture of ['axes', 'checker', 'graticule']) {
    const file = export_(texture, texture, '--morph', 'sphere');
    add(texture, file, 'uv', true);
    add(`${texture}_rays`, file, 'rays', false);
    if (texture === 'axes') add('region', file, 'region', false);
    comparisons.push({ a: `${name}_${texture}`, b: `${name}_${texture}_rays`, region: `${name}_region` });
  }
  const poles = export_('poles', 'poles_checker', '--morph', 'sphere', '--refine-poles', '16');
  add('poles', poles, 'uv', true);
  comparisons.push({ a: `${name}_poles`, b: `${name}_checker_rays`, region: `${name}_region` });
  const envmap = export_('envmap', 'envmap_axes', '--convention', 'envmap');
  add('envmap', envmap, 'uv', true);
  comparisons.push({ a: `${name}_envmap`, b: `${name}_axes_rays`, region: `${name}_region` });
  const webp = export_('webp', 'graticule', '--textures', 'webp');
  add('webp', webp, 'uv', true);
  comparisons.push({ a: `${name}_webp`, b: `${name}_graticule_rays`, region: `${name}_region` });
  return { models, comparisons };
}

let meshes = given;
if (meshes.length === 0) {
  meshes = [join(output, 'bumpy.off')];
  bumpySphere(meshes[0]);
}
let wrong = 0;
const complain = (text) => { ++wrong; console.log(`WRONG ${text}`); };
for (const mesh of meshes) {
  const job = { size: 512, ...prepare(mesh) };
  const report = await runPage({
    chromium, job, output, page: 'views.html',
    roots: { page: dirname(fileURLToPath(import.meta.url)), three: join(packages, 'node_modules/three'), files: output },
  });
  if (report.error) throw new Error(report.error);
  for (const [name, { uv }] of Object.entries(report.models)) {
    if (uv[0] !== 0 || uv[1] !== 1 || uv[2] !== 0 || uv[3] !== 1) complain(`${name}: (u, v) fills ${uv}`);
  }
  for (const { a, seam, pole, rest } of report.comparisons) {
    const figures = ({ mean, wrong }) => `${mean.toFixed(2)} (${(100 * wrong).toFixed(2)} % wrong)`;
    console.log(`${a}: of 255, at the date line ${figures(seam)}, elsewhere ${figures(rest)}, at the poles ${figures(pole)}`);
    // A seam shows as a line of wrong pixels; what is smooth is wrong at no more than rims.
    if (seam.wrong > rest.wrong + 0.005) complain(`${a}: the date line shows`);
    if (rest.wrong > 0.02) complain(`${a}: textured otherwise than θ and ϕ say`);
  }
}
process.exit(wrong > 0 ? 1 : 0);
