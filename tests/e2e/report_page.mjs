// SPDX-License-Identifier: Apache-2.0
// Opens a report in headless Chromium as a reader would, wide and on a phone, and lists what is wrong:
//   node report_page.mjs REPORT.html FOLDER_FOR_SCREENSHOTS
import {existsSync, mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const npm = process.env.TRUEAXIS_NPM ?? join(root, 'build/npm');
const {chromium} = createRequire(join(npm, 'node_modules/'))('playwright-core');

const [report, folder] = process.argv.slice(2);
if (!report || !folder) {
  console.error('usage: node report_page.mjs REPORT.html FOLDER_FOR_SCREENSHOTS');
  process.exit(2);
}
mkdirSync(folder, {recursive: true});

/** What is wrong with each chart, seen from inside the page. */
function inspectCharts() {
  const problems = [];
  const colours = (canvas) => {
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return seen.size;
  };
  /** Every text that is drawn, and where. */
  const texts = (chart) => chart.getZr().storage.getDisplayList(true).filter((e) => e.type === 'tspan' && !e.ignore && !e.invisible && e.style.text).map((e) => {
    const box = e.getBoundingRect().clone();
    if (e.transform) box.applyTransform(e.transform);
    return {text: e.style.text, box};
  });
  const {charts} = window.trueaxisReport;
  charts.forEach((chart, i) => {
    const box = chart.getDom();
    const name = `chart ${i + 1} (${box.closest('section')?.id}: ${box.getAttribute('aria-label') ?? 'no aria-label'})`;
    if (!box.getAttribute('aria-label')) problems.push(`${name}: has no text for screen readers`);
    const series = chart.getOption().series ?? [];
    if (!series.length) problems.push(`${name}: no series`);
    series.forEach((s) => {
      if (!(s.data?.length > 0)) problems.push(`${name}: series ${s.name ?? s.type} has no data`);
    });
    if (box.clientWidth < 200 || box.clientHeight < 150) problems.push(`${name}: ${box.clientWidth} × ${box.clientHeight} px`);
    const canvas = box.querySelector('canvas');
    const svg = box.querySelector('svg');
    if (canvas && colours(canvas) < 8) problems.push(`${name}: the canvas is blank`);
    if (svg) {
      const shapes = new Set([...svg.querySelectorAll('path')].map((p) => p.getAttribute('d')));
      if (shapes.size < 8 || !svg.querySelector('text')) problems.push(`${name}: the drawing is blank`);
    }
    if (!canvas && !svg) problems.push(`${name}: nothing is drawn`);
    const cut = texts(chart).filter(({box: at}) => at.x < -1 || at.x + at.width > box.clientWidth + 1 || at.y < -1 || at.y + at.height > box.clientHeight + 1);
    if (cut.length) problems.push(`${name}: text is cut at the edge: ${cut.map((t) => `"${t.text}"`).slice(0, 4).join(', ')}`);
    const plot = chart.getModel().getComponent('grid')?.coordinateSystem?.getRect();
    const names = new Set(series.map((s) => s.name));
    const over = !plot || plot.height < 100 ? [] : texts(chart).filter(({text, box: at}) => names.has(text) && at.x + at.width > plot.x + 1 && at.y + at.height > plot.y + 1 && at.y < plot.y + plot.height);
    if (over.length) problems.push(`${name}: the legend lies on the plot: ${over.map((t) => `"${t.text}"`).slice(0, 4).join(', ')}`);
  });
  return {count: charts.length, problems};
}

/** Elements that stick out of the page at the right, and the page's own overflow. */
function inspectWidth() {
  const page = document.documentElement;
  if (page.scrollWidth <= page.clientWidth) return [];
  const wide = [...document.querySelectorAll('body *')].filter((e) =>
    e.getBoundingClientRect().right > page.clientWidth + 1 && !e.closest('.scroll table, svg'));
  return [`the page is ${page.scrollWidth} px wide on a screen of ${page.clientWidth} px: ` +
    wide.slice(0, 5).map((e) => `${e.tagName.toLowerCase()}.${e.className}`).join(', ')];
}

/** Notes of a fit that are not shown, and on a phone tables of value, u and U that do not fit. */
function inspectFits() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const hidden = (data.references ?? []).flatMap((r) => r.notes ?? []).filter((note) => !document.body.textContent.includes(note));
  const wide = [...document.querySelectorAll('.scroll')].filter((box) => box.querySelector('th')?.textContent === 'Quantity' && box.scrollWidth > box.clientWidth + 1);
  return [...hidden.map((note) => `a note of a fit is not shown: ${note}`), ...wide.map((box) => `a table of values is ${box.scrollWidth} px wide where there are ${box.clientWidth}`)];
}

function inspectText() {
  const text = document.body.innerText;
  return ['NaN', 'undefined', '[object', 'Infinity', 'null'].filter((word) => new RegExp(`(^|[^\\w])${word.replace('[', '\\[')}`).test(text))
    .map((word) => `the page shows "${word}"`);
}

async function look(browser, {name, width, height}) {
  const page = await browser.newPage({viewport: {width, height}});
  page.setDefaultTimeout(120000);  // a busy machine draws slowly
  const problems = [];
  const own = pathToFileURL(resolve(report)).href;
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) problems.push(`console ${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => problems.push(`page error: ${error.message}`));
  page.on('requestfailed', (request) => problems.push(`failed request: ${request.url()}`));
  page.on('request', (request) => {
    if (request.url() !== own && !request.url().startsWith('data:')) problems.push(`request: ${request.url()}`);
  });
  const broken = new Promise((_, reject) => page.once('pageerror', reject));  // a script that threw never gets ready
  broken.catch(() => {});
  await page.goto(own);
  try {
    const ready = page.waitForFunction(() => window.trueaxisReport?.ready);
    ready.catch(() => {});
    await Promise.race([ready, broken]);
    const charts = await page.evaluate(inspectCharts);
    if (charts.count === 0) problems.push('there is no chart');
    problems.push(...charts.problems, ...await page.evaluate(inspectWidth), ...await page.evaluate(inspectText), ...await page.evaluate(inspectFits));
    console.log(`${name}: ${charts.count} charts at ${width} px`);
    const cut = await page.evaluate(() => [...document.querySelectorAll('.wide .scroll')].filter((box) => box.scrollWidth > box.clientWidth).length);
    console.log(`${name}: ${cut} wide tables scroll`);
    const curves = await page.evaluate(() => window.trueaxisReport.charts.filter((c) => c.getDom().closest('#error'))
      .flatMap((c) => c.getOption().series).filter((s) => s.type === 'scatter').length);
    if (curves) console.log(`${name}: ${curves} curves of errors`);
    console.log(await page.evaluate(() => document.querySelector('.banner')?.innerText ?? ''));
  } catch (error) {
    problems.push(`the page does not get ready: ${error.message}`);
  }
  await page.screenshot({path: join(folder, `${name}.png`), fullPage: true});
  await page.close();
  return problems.map((problem) => `${name}: ${problem}`);
}

if (!existsSync(report)) {
  console.error(`${report} is not there`);
  process.exit(2);
}
const browser = await chromium.launch({
  executablePath: process.env.TRUEAXIS_CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    '--no-first-run', '--disable-default-apps', '--force-device-scale-factor=1'],
});
const problems = [];
for (const screen of [{name: 'wide', width: 1400, height: 1000}, {name: 'phone', width: 390, height: 844}]) {
  problems.push(...await look(browser, screen));
}
await browser.close();
problems.forEach((problem) => console.error(problem));
console.log(problems.length ? `${problems.length} problems` : 'the report is sound');
process.exit(problems.length ? 1 : 0);
