// Khronos gltf-validator over files: node validate.mjs PACKAGES FILE…
// Says what it has to say of each and ends with 1 if that is anything but what may be: one note that
// it does not know MSFT_lod or EXT_meshopt_compression, and one of a second set of texture
// coordinates that no material uses.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';

const [packages, ...files] = process.argv.slice(2);
const validator = createRequire(resolve(packages, 'package.json'))('gltf-validator');

const isAllowed = (issue) =>
  issue.severity === 2 &&
  ((issue.code === 'UNSUPPORTED_EXTENSION' &&
    /MSFT_lod|EXT_meshopt_compression/.test(issue.message)) ||
    (issue.code === 'UNUSED_OBJECT' && /TEXCOORD_1$/.test(issue.pointer)));

let bad = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    maxIssues: 100,
    externalResourceFunction: async (uri) =>
      new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
  });
  const allowed = report.issues.messages.filter(isAllowed);
  const wrong = report.issues.messages.filter((issue) => !isAllowed(issue));
  if (new Set(allowed.map((issue) => issue.code)).size !== allowed.length) wrong.push(...allowed);
  const { numErrors, numWarnings, numInfos, numHints } = report.issues;
  if (wrong.length > 0) {
    ++bad;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
    for (const issue of wrong.slice(0, 5))
      console.log(`  ${issue.severity} ${issue.code} ${issue.pointer ?? ''}: ${issue.message}`);
  }
}
console.log(`${files.length} files, ${bad} with something wrong`);
process.exit(bad > 0 ? 1 : 0);
