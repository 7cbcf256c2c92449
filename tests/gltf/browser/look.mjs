// node look.mjs PACKAGES CHROMIUM JOB.json OUTPUT: pictures to OUTPUT, the report to standard output.
import { readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { runPage } from './serve.mjs';

const [packages, chromium, jobFile, output] = process.argv.slice(2);
const job = JSON.parse(readFileSync(jobFile));
const report = await runPage({
  chromium,
  roots: {
    page: dirname(fileURLToPath(import.meta.url)),
    three: join(packages, 'node_modules/three'),
    files: dirname(resolve(jobFile)),
  },
  page: 'views.html',
  job,
  output,
});
console.log(JSON.stringify(report, null, 1));
process.exit(report.error ? 1 : 0);
