// Makes the template of pages: one HTML file with program and style inside, and a policy that lets a browser run
// these and load nothing else.
//
//   node bundle.mjs FOLDER-WITH-NODE_MODULES OUTPUT.html
import { createHash } from 'node:crypto';
import { readFileSync, renameSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, output] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const { build } = createRequire(join(packages, 'package.json'))('esbuild');

async function bundled(entry, more = {}) {
  const { outputFiles } = await build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    legalComments: 'inline', // three's licence asks for its notice
    nodePaths: [join(packages, 'node_modules')],
    logLevel: 'warning',
    ...more,
  });
  return outputFiles[0].text.trimEnd();
}

const program = await bundled('src/main.js', { format: 'iife', target: 'es2022' });
const style = await bundled('src/style.css');
for (const [name, text] of Object.entries({ program, style })) {
  if (/<\/(script|style)|<!--/i.test(text)) throw new Error(`the ${name} would end its element`);
}

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const values = {
  policy: `default-src 'none'; base-uri 'none'; form-action 'none'; script-src ${hash(program)}; style-src ${hash(style)}`,
  style,
  program,
};
const page = readFileSync(join(here, 'page.html'), 'utf8').replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]);
writeFileSync(`${output}.tmp`, page);
renameSync(`${output}.tmp`, output);
