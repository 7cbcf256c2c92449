// node beside.mjs --program build/release/bin/sphparam --out FOLDER [--chromium PROGRAM] [-- OPTION … --] FILE.glb|.gltf …
//
// Artists' assets beside what `sphparam FILE` makes of them, as a browser shows both: in model-viewer of the build, under
// its neutral light, from ten directions. Into the folder go, an asset each, what was made (not again where it is there)
// and NAME.png: rows original, made, twice the difference; and beside.tsv with decibels (means of the directions) over
// whole pictures, over the pixels where either shows something and where both do, the worst direction of the latter, and
// how much brighter (+) ours is there, of 255.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { runPage } from '../../gltf/browser/serve.mjs';

const here = dirname(fileURLToPath(import.meta.url));

function parse(words) {
  const options = { chromium: 'chromium', more: [], files: [] };
  while (words.length > 0) {
    const word = words.shift();
    if (word === '--') while (words.length > 0 && words[0] !== '--') options.more.push(words.shift());
    if (word === '--') words.shift();
    else if (word.startsWith('--')) options[word.slice(2)] = words.shift();
    else options.files.push(resolve(word));
  }
  if (!options.program || !options.out || options.files.length === 0)
    throw new Error('beside.mjs --program PROGRAM --out FOLDER FILE …');
  return options;
}

/// Names of files may repeat in other folders: the folder's name is put before.
function names(files) {
  const stems = files.map((file) => basename(file, extname(file)));
  return stems.map((stem, i) =>
    stems.indexOf(stem) === stems.lastIndexOf(stem) ? stem : `${basename(dirname(files[i]))}_${stem}`);
}

function make(options, file, name) {
  const folder = join(options.out, name), record = join(options.out, `${name}.json`);
  if (!existsSync(record))
    execFileSync(options.program, [file, '-o', folder, '--json', record, '--no-page', '-q', ...options.more]);
  const { surface, triangles } = JSON.parse(readFileSync(record));
  return { glb: join(folder, `${basename(file, extname(file))}.glb`), surface, triangles };
}

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

function row({ name, views, error }, { surface, triangles }) {
  if (error) return [name, surface, triangles, error];
  const of = (key) => views.map((view) => view[key]);
  return [name, surface, triangles, ...[mean(of('psnr')), mean(of('psnrWithout')), mean(of('psnrShared')),
    Math.min(...of('psnrShared')), mean(of('brighter'))].map((value) => value.toFixed(1))];
}

const options = parse(process.argv.slice(2));
mkdirSync(options.out, { recursive: true });
const viewer = join(dirname(dirname(resolve(options.program))), 'share/sphparam/model-viewer');
const rows = [['asset', 'surface', 'triangles', 'dB', 'where either is', 'where both are', 'worst', 'brighter']];
let failed = false;
for (const [i, name] of names(options.files).entries()) {
  const file = options.files[i], made = make(options, file, name);
  const report = await runPage({
    chromium: options.chromium, page: 'beside.html', output: options.out, seconds: 900,
    roots: { page: here, viewer, original: dirname(file), made: dirname(resolve(made.glb)) },
    job: { assets: [{ name, original: `original/${basename(file)}`, made: `made/${basename(made.glb)}` }] },
  });
  if (report.error) throw new Error(report.error);
  rows.push(row(report.assets[0], made));
  failed ||= report.assets[0].error !== undefined;
  console.log(rows.at(-1).join('\t'));
}
writeFileSync(join(options.out, 'beside.tsv'), rows.map((cells) => cells.join('\t') + '\n').join(''));
process.exit(failed ? 1 : 0);
