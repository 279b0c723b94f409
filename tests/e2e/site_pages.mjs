// SPDX-License-Identifier: Apache-2.0
// Serves the site of the documentation and opens every page of it in headless Chromium, wide and on a phone; follows every link, and searches:
//   node site_pages.mjs build/site
import {createReadStream, existsSync, readFileSync, statSync} from 'node:fs';
import {createServer} from 'node:http';
import {extname, join, resolve} from 'node:path';
import {launch} from './browser.mjs';

const site = resolve(process.argv[2] ?? 'build/site');
const types = {'.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.svg': 'image/svg+xml', '.png': 'image/png'};

// Each page would make an index of the words of all pages, which is half of the time: until the search, they are left out.
let searching = false;
const withoutWords = (file) => JSON.stringify({...JSON.parse(readFileSync(file)), docs: []});

const server = createServer((request, response) => {
  let file = join(site, decodeURIComponent(new URL(request.url, 'http://x').pathname));
  if (existsSync(file) && statSync(file).isDirectory()) file = join(file, 'index.html');
  if (!existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, {'content-type': types[extname(file)] ?? 'application/octet-stream'});
  if (!searching && file.endsWith('search_index.json')) return response.end(withoutWords(file));
  createReadStream(file).pipe(response);
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
const home = `http://127.0.0.1:${server.address().port}/`;
const problems = [], pages = new Map(), asked = [];  // of each page its anchors; of each link where it is and leads

/** What a reader would meet on a page: formulas that failed, pictures without text or that did not load, a page wider than the screen. */
const inspect = () => ({
  ids: [...document.querySelectorAll('[id]')].map((e) => e.id),
  links: [...document.querySelectorAll('a[href]')].map((a) => a.href),
  formulas: document.querySelectorAll('.katex').length,
  problems: [
    ...[...document.querySelectorAll('.katex-error')].map((e) => `a formula failed: ${e.textContent.slice(0, 60)}`),
    ...[...document.querySelectorAll('.arithmatex')].filter((e) => !e.querySelector('.katex')).map((e) => `a formula is not drawn: ${e.textContent.slice(0, 60)}`),
    ...[...document.images].filter((i) => !i.complete || !i.naturalWidth).map((i) => `a picture did not load: ${i.src}`),
    ...[...document.images].filter((i) => !i.alt).map((i) => `a picture has no text: ${i.src}`),
    ...(document.documentElement.scrollWidth > document.documentElement.clientWidth + 1 ? [`wider than the screen: ${document.documentElement.scrollWidth} px`] : []),
  ],
});

const browser = await launch();
let formulas = 0;
/** Opens the pages from the first one on, and each on a phone too. */
async function visit(addresses) {
  const page = await browser.newPage();
  page.setDefaultTimeout(120000);
  let at = '', width;
  const resize = (to) => page.setViewportSize({width: width = to, height: 900});
  const complain = (what) => problems.push(`${at || 'start'} at ${width} px: ${what}`);
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) complain(`console: ${message.text()}`); });
  page.on('pageerror', (error) => complain(`page error: ${error.message}`));
  page.on('response', (response) => { if (response.status() >= 400) complain(`${response.status()} ${response.url()}`); });
  page.on('request', (request) => { if (!request.url().startsWith(home) && !/^(data|blob):/.test(request.url())) complain(`asks another host: ${request.url()}`); });
  for (const address of addresses) {  // grows while it is walked
    at = address;
    await resize(1400);
    await page.goto(home + address, {waitUntil: 'load'});
    await page.waitForFunction(() => document.documentElement.dataset.ready === 'yes' || window.trueaxisReport?.ready);
    const seen = await page.evaluate(inspect);
    seen.problems.forEach(complain);
    await resize(390);
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    const phone = await page.evaluate(inspect);
    phone.problems.forEach(complain);
    formulas += seen.formulas;
    pages.set(address, new Set(seen.ids));
    for (const link of seen.links.filter((l) => l.startsWith(home))) {
      const [path, part] = link.slice(home.length).split('#');
      asked.push({from: address, path: path || 'index.html', part: decodeURIComponent(part ?? '')});
      if (/\.html$/.test(path) && existsSync(join(site, path)) && !addresses.includes(path)) addresses.push(path);
    }
  }
  await page.close();
}

const all = ['index.html'];
await visit(all);
for (const {from, path, part} of asked) {
  if (!existsSync(join(site, path))) problems.push(`${from}: ${path} is not there`);
  else if (part && !part.startsWith('__') && pages.has(path) && !pages.get(path).has(part)) problems.push(`${from}: ${path} has no #${part}`);
}

// Search, and the dark.
searching = true;
const page = await browser.newPage({viewport: {width: 1400, height: 900}, colorScheme: 'dark'});
await page.goto(home);
await page.fill('.md-search__input', 'roundness');
await page.waitForSelector('.md-search-result__item', {timeout: 120000}).catch(() => problems.push('the search for "roundness" finds nothing'));
const paper = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).map(Number).reduce((a, b) => a + b));
if (paper > 250) problems.push(`the dark page is light: ${paper}`);
await browser.close();
server.close();
console.log(`${all.length} pages, ${formulas} formulas, ${asked.length} links`);
if (all.length < 30 || formulas < 150) problems.push('too few pages or formulas: the site was not read');
console.log([...new Set(problems)].slice(0, 60).join('\n'));
process.exit(problems.length ? 1 : 0);
