// SPDX-License-Identifier: Apache-2.0
// Opens reports in headless Chromium as a reader would, wide, on a phone, in the dark and on paper, and lists what is wrong:
//   node report_page.mjs REPORT.html [--folded | --wide] [FOLDER_FOR_SCREENSHOTS]
//   node report_page.mjs --each     reads such words, one report a line as a JSON array; "--" ends what is said of each
// --folded opens it wide and prints its banner, no more; --wide leaves out the phone, and it gets dark while the page is open.
// Else the wide one is dark from the start and prints, and the phone is light: every page is drawn once less.
// Pictures of whole pages are half of the work, so that they are made when they are asked for.
import {existsSync, mkdirSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {createInterface} from 'node:readline';
import {pathToFileURL} from 'node:url';
import {launch} from './browser.mjs';


const shoot = async (page, folder, name) => { if (folder) await page.screenshot({path: join(folder, name), fullPage: true}); };

/** What is wrong with each chart, seen from inside the page. */
function inspectCharts() {
  const problems = [];
  const isBlank = (canvas) => {  // fewer than 8 colours
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let i = 0; i < data.length && seen.size < 8; i += 4) seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return seen.size < 8;
  };
  /** Every text that is drawn, and where. */
  const texts = (chart) => chart.getZr().storage.getDisplayList(true).filter((e) => e.type === 'tspan' && !e.ignore && !e.invisible && e.style.text).map((e) => {
    const box = e.getBoundingRect().clone();
    if (e.transform) box.applyTransform(e.transform);
    return {text: e.style.text, box, middle: box.y + box.height / 2, turned: Math.abs(e.transform?.[1] ?? 0) > 0.1, size: parseFloat(/([\d.]+)px/.exec(e.style.font)?.[1] ?? 12)};
  });
  const seriesOf = (chart) => chart.getModel().getSeries().map((one) => one.option);  // getOption() copies all data
  const {charts} = window.trueaxisReport;
  charts.forEach((chart, i) => {
    const box = chart.getDom();
    const name = `chart ${i + 1} (${box.closest('section')?.id}: ${box.getAttribute('aria-label') ?? 'no aria-label'})`;
    if (!(box.getAttribute('aria-label')?.length > 12) || box.getAttribute('role') !== 'img') problems.push(`${name}: has no text for screen readers`);
    const series = seriesOf(chart);
    if (!series.length) problems.push(`${name}: no series`);
    series.forEach((s) => {
      if (!(s.data?.length > 0)) problems.push(`${name}: series ${s.name ?? s.type} has no data`);
    });
    if (box.clientWidth < 200 || box.clientHeight < 150) problems.push(`${name}: ${box.clientWidth} × ${box.clientHeight} px`);
    // Curves of different names must differ in colour, dash or mark.
    const looks = new Map();
    series.filter((s) => s.name && (s.itemStyle?.color || s.lineStyle?.color)).forEach((s) => {
      const look = JSON.stringify([s.type, s.lineStyle?.color ?? s.itemStyle.color, s.lineStyle?.type, s.lineStyle?.opacity, s.symbol, s.itemStyle?.opacity]);
      if (looks.has(look) && looks.get(look) !== s.name) problems.push(`${name}: ${s.name} looks like ${looks.get(look)}`);
      looks.set(look, s.name);
    });
    const canvas = box.querySelector('canvas');
    const svg = box.querySelector('svg');
    if (canvas && isBlank(canvas)) problems.push(`${name}: the canvas is blank`);
    if (svg) {
      const shapes = new Set([...svg.querySelectorAll('path')].map((p) => p.getAttribute('d')));
      if (shapes.size < 8 || !svg.querySelector('text')) problems.push(`${name}: the drawing is blank`);
    }
    if (box.querySelectorAll('canvas').length > 1) problems.push(`${name}: a second canvas, which is blank on paper`);
    if (!canvas && !svg) problems.push(`${name}: nothing is drawn`);
    const drawn = texts(chart);
    const cut = drawn.filter(({box: at}) => at.x < -1 || at.x + at.width > box.clientWidth + 1 || at.y < -1 || at.y + at.height > box.clientHeight + 1);
    if (cut.length) problems.push(`${name}: text is cut at the edge: ${cut.map((t) => `"${t.text}"`).slice(0, 4).join(', ')}`);
    // Letters are as high as their font says: a drawing measures lines too low where the font lacks a sign.
    const all = drawn.filter((t) => !t.turned), width = (a, b) => Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
    const on = all.flatMap((a, k) => all.slice(k + 1).filter((b) => width(a.box, b.box) > 4 && Math.abs(a.middle - b.middle) < 0.8 * Math.min(a.size, b.size)).map((b) => `"${a.text}" and "${b.text}"`));
    if (on.length) problems.push(`${name}: texts lie on each other: ${on.slice(0, 3).join(', ')}`);
    const plot = chart.getModel().getComponent('grid')?.coordinateSystem?.getRect();
    const names = new Set(series.map((s) => s.name));
    const over = !plot || plot.height < 100 ? [] : drawn.filter(({text, box: at}) => names.has(text) && at.x + at.width > plot.x + 1 && at.y + at.height > plot.y + 1 && at.y < plot.y + plot.height);
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
  return ['NaN', 'undefined', '[object', 'Infinity', 'null', 'radius 0.00', 'radius 0 '].filter((word) => new RegExp(`(^|[^\\w])${word.replace('[', '\\[')}`).test(text))
    .map((word) => `the page shows "${word}"`);
}

/** Codes of measurements, and ids of effects that stand without their name: who reads the page has no catalogue. */
function inspectWords() {
  const shown = document.body.cloneNode(true);
  shown.querySelectorAll('script, small').forEach((e) => e.remove());
  const {words} = JSON.parse(document.getElementById('data').textContent);
  const drawn = window.trueaxisReport.charts.flatMap((chart) => chart.getZr().storage.getDisplayList(true)).filter((e) => e.type === 'tspan').map((e) => e.style.text);
  const text = [shown.textContent, ...drawn].join('\n');
  const codes = [...Object.keys(words?.measurements ?? {}), 'B1', 'B2', 'L2', 'AC'].filter((code) => new RegExp(`(^|[\\s(,:])${code}([\\s),.:;]|$)`, 'm').test(text));
  const ids = Object.keys(words?.effects ?? {}).filter((id) => text.includes(id));
  return [...codes.map((code) => `the page shows the code "${code}"`), ...ids.map((id) => `the page shows the id "${id}"`)];
}

/** Contrast (WCAG 2) of all text, the page's and the charts', against what is behind the page. */
function inspectContrast() {
  const canvas = document.createElement('canvas').getContext('2d');
  const light = (colour) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = '#000';
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].map((v) => v / 255).map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const paper = getComputedStyle(document.body).backgroundColor;
  const known = new Map();
  const contrast = (colour) => {
    if (!known.has(colour)) {
      const [a, b] = [light(colour), light(paper)];
      known.set(colour, (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05));
    }
    return known.get(colour);
  };
  const faint = [...document.querySelectorAll('p, td, th, dd, dt, li, h1, h2, h3, small, figcaption, summary')].filter((e) => e.offsetParent && e.textContent.trim() && contrast(getComputedStyle(e).color) < 4.5)
    .map((e) => e.textContent.trim().slice(0, 30));
  const drawn = window.trueaxisReport.charts.flatMap((chart) => chart.getZr().storage.getDisplayList(true)).filter((e) => e.type === 'tspan' && !e.ignore && !e.invisible && e.style.text && e.style.fill)
    .filter((e) => contrast(e.style.fill) < 4.5).map((e) => e.style.text);
  return [...new Set([...faint, ...drawn])].slice(0, 5).map((text) => `"${text}" is hard to read on ${paper}`);
}

const paperIsDark = () => { const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number); return r + g + b < 200; };

/** In the dark: dark paper that all can be read on; then printed: light, unfolded and nothing beyond the paper's width. */
async function lookDark(page, folder) {
  const problems = [];
  page.on('pageerror', (error) => problems.push(`dark: page error: ${error.message}`));
  await page.emulateMedia({colorScheme: 'dark'});
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  if (!await page.evaluate(paperIsDark)) problems.push('dark: the page is light');
  problems.push(...(await page.evaluate(inspectContrast)).map((problem) => `dark: ${problem}`));
  await shoot(page, folder, 'dark.png');
  await page.evaluate(() => document.querySelectorAll('details').forEach((d) => { d.open = false; }));
  // As a browser does: the page is told first, and then has the width and the rules of paper. It waits for no frame.
  const charts = await page.evaluate(`window.dispatchEvent(new Event('beforeprint')); (${inspectCharts})()`);
  const landscape = await page.evaluate(() => document.body.classList.contains('landscape'));
  await page.setViewportSize(landscape ? {width: 1032, height: 703} : {width: 703, height: 1000});  // A4 less its margins
  await page.emulateMedia({media: 'print', colorScheme: 'dark'});
  const folded = await page.evaluate(() => document.querySelectorAll('details:not([open])').length);
  if (folded) problems.push(`print: ${folded} parts stay folded`);
  if (await page.evaluate(paperIsDark)) problems.push('print: the paper is dark');
  problems.push(...[...charts.problems, ...await page.evaluate(inspectWidth), ...await page.evaluate(inspectContrast), ...await page.evaluate(inspectClipped), ...await page.evaluate(inspectSmall)].map((problem) => `print: ${problem}`));
  console.log(`print: ${charts.count} charts`);
  await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
  const open = await page.evaluate(() => document.querySelectorAll('details[open]').length);
  if (open) problems.push(`print: ${open} parts stay unfolded afterwards`);
  return problems;
}

/** Tables whose letters are too small to read on paper: below 6 pt. */
const inspectSmall = () => [...document.querySelectorAll('table')].filter((one) => one.offsetParent)
  .map((one) => [one, Number(one.style.zoom || 1) * Math.min(...[...one.querySelectorAll('th, td')].map((cell) => parseFloat(getComputedStyle(cell).fontSize)))])
  .filter(([, size]) => size < 8).map(([one, size]) => `a table has letters of ${size.toFixed(1)} px: ${one.textContent.slice(0, 40)}`);

/** Tables that are wider than the paper, which has no scroll bar. */
const inspectClipped = () => [...document.querySelectorAll('.scroll, .chart')].filter((box) => box.offsetParent && box.scrollWidth > box.clientWidth + 1)
  .map((box) => `${box.className} is clipped: ${box.scrollWidth} px where there are ${box.clientWidth}: ${box.textContent.slice(0, 40)}`);

async function look(browser, {report, folded, folder}, {name, width, height, colorScheme}) {
  const page = await browser.newPage({viewport: {width, height}, colorScheme});
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
    console.log(`${name} folded: ${(await page.evaluate(() => document.documentElement.scrollHeight) / height).toFixed(1)} screens`);
    problems.push(...await page.evaluate(inspectWidth));
    await shoot(page, folder, `${name}_folded.png`);
    console.log(await page.evaluate(() => document.querySelector('.banner')?.innerText ?? ''));
    if (folded) return {page, problems};
    await page.evaluate(() => { window.trueaxisReport.unfold(); });
    const charts = await page.evaluate(inspectCharts);
    if (charts.count === 0) problems.push('there is no chart');
    problems.push(...charts.problems, ...await page.evaluate(inspectWidth), ...await page.evaluate(inspectText), ...await page.evaluate(inspectFits), ...await page.evaluate(inspectWords));
    console.log(`${name}: ${charts.count} charts at ${width} px`);
    const cut = await page.evaluate(() => [...document.querySelectorAll('.wide .scroll')].filter((box) => box.scrollWidth > box.clientWidth).length);
    console.log(`${name}: ${cut} wide tables scroll`);
    const curves = await page.evaluate(() => window.trueaxisReport.charts.filter((c) => c.getDom().closest('#error'))
      .flatMap((c) => c.getModel().getSeries()).filter((s) => s.subType === 'scatter').length);
    if (curves) console.log(`${name}: ${curves} curves of errors`);
  } catch (error) {
    problems.push(`the page does not get ready: ${error.message}`);
  }
  await shoot(page, folder, `${name}.png`);
  return {page, problems: problems.map((problem) => `${name}: ${problem}`)};
}

/** What is wrong with a report, by the words of a command line. */
async function judge(browser, words) {
  const [report, folder] = words.filter((word) => !word.startsWith('--'));
  const asked = {report, folder, folded: words.includes('--folded')};
  if (!existsSync(report)) return [`${report} is not there`];
  if (folder) mkdirSync(folder, {recursive: true});
  const alone = asked.folded || words.includes('--wide');
  const {page, problems} = await look(browser, asked, {name: 'wide', width: 1400, height: 1000, colorScheme: alone ? 'light' : 'dark'});
  if (!alone) problems.push(...(await look(browser, asked, {name: 'phone', width: 390, height: 844})).problems);
  if (!asked.folded && !problems.length) problems.push(...await lookDark(page, folder));
  await Promise.all(browser.contexts().map((context) => context.close()));
  return problems;
}

const words = process.argv.slice(2);
if (!words.length) {
  console.error('usage: node report_page.mjs REPORT.html [--folded | --wide] [FOLDER_FOR_SCREENSHOTS]');
  process.exit(2);
}
const browser = await launch();
let wrong = 0;
for await (const asked of words[0] === '--each' ? createInterface({input: process.stdin}) : [JSON.stringify(words)]) {
  const problems = await judge(browser, JSON.parse(asked));
  problems.forEach((problem) => console.log(problem));
  console.log(problems.length ? `${problems.length} problems` : 'the report is sound');
  if (words[0] === '--each') console.log('--');
  wrong += problems.length;
}
await browser.close();
process.exit(wrong ? 1 : 0);
