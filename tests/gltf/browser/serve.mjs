// Runs a page in headless chromium and waits for what it posts to /done: the page, its modules and
// the files of the job come from a server of our own, so that nothing leaves the machine.
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

const types = { '.html': 'text/html', '.mjs': 'text/javascript', '.js': 'text/javascript' };

// The browser's helpers outlive it for a moment, and write to its profile until they end.
async function remove(profile) {
  for (let attempt = 0; attempt < 50; ++attempt) {
    try {
      return rmSync(profile, { recursive: true, force: true });
    } catch {
      await new Promise((resolve) => setTimeout(resolve, 200));
    }
  }
}

/// `roots`: folders by the first part of a path. `job` is what the page gets from /job.
export async function runPage({ chromium, roots, page, job, output, seconds = 300 }) {
  const profile = mkdtempSync(join(tmpdir(), 'sphparam-browser-'));
  let settle;
  const done = new Promise((resolve, reject) => (settle = { resolve, reject }));
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    if (request.method === 'POST') {
      const parts = [];
      request.on('data', (part) => parts.push(part));
      request.on('end', () => {
        const body = Buffer.concat(parts);
        if (path === '/done') settle.resolve(JSON.parse(body));
        else writeFileSync(join(output, path.slice(1)), body);
        response.end();
      });
      return;
    }
    try {
      const [root, ...rest] = path.slice(1).split('/');
      const bytes = root === 'job' ? JSON.stringify(job) : readFileSync(join(roots[root], ...rest));
      response.setHeader('content-type', types[extname(path)] ?? 'application/octet-stream');
      response.end(bytes);
    } catch (error) {
      response.statusCode = 404;
      response.end(String(error));
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const browser = spawn(chromium, [
    '--headless=new', '--no-sandbox', '--disable-background-networking', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-dev-shm-usage', '--no-first-run', `--user-data-dir=${profile}`,
    `http://127.0.0.1:${server.address().port}/page/${page}`,
  ], { stdio: 'ignore' });
  const timer = setTimeout(() => settle.reject(new Error('the browser took too long')), seconds * 1000);
  try {
    return await done;
  } finally {
    clearTimeout(timer);
    const ended = new Promise((resolve) => browser.once('exit', resolve));
    browser.kill();
    await ended;
    server.close();
    server.closeAllConnections();
    await remove(profile);
  }
}
