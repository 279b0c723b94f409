// SPDX-License-Identifier: Apache-2.0
// Opens a page of HTML and SVG, without a script of its own, in headless Chromium, in the light, the dark and on paper, and lists what is wrong:
//   node plain_page.mjs PAGE.html [FOLDER_FOR_SCREENSHOTS]
import {mkdirSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';
import {launch} from './browser.mjs';

const [file, folder] = process.argv.slice(2);
if (folder) mkdirSync(folder, {recursive: true});

/** Paper, and what is hard to see on it: texts below 4.5, lines and areas below 1.3 (WCAG 2); areas of the paper's colour, and lines of none, do not count. */
function inspect() {
  const rgb = (colour) => colour.match(/[\d.]+/g).map(Number);
  const light = (colour) => {
    const [r, g, b] = rgb(colour).map((v) => v / 255).map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const paper = getComputedStyle(document.body).backgroundColor;
  const contrast = (colour) => (Math.max(light(colour), light(paper)) + 0.05) / (Math.min(light(colour), light(paper)) + 0.05);
  const problems = [];
  for (const e of document.querySelectorAll('p, th, td, h1, h2, summary, svg text')) {
    const {color, fill} = getComputedStyle(e), colour = e.tagName === 'text' ? fill : color;
    if (e.textContent.trim() && contrast(colour) < 4.5) problems.push(`"${e.textContent.trim().slice(0, 30)}" is ${colour} on ${paper}`);
  }
  for (const e of document.querySelectorAll('svg path, svg circle')) {
    const {fill, stroke} = getComputedStyle(e), colour = stroke === 'none' ? fill : stroke;
    if (contrast(colour) < 1.3) problems.push(`${e.tagName}.${e.getAttribute('class')} is ${colour} on ${paper}`);
  }
  for (const e of document.querySelectorAll('svg rect'))
    if (getComputedStyle(e).fill !== paper) problems.push(`a plot is ${getComputedStyle(e).fill} on ${paper}`);
  if (document.documentElement.scrollWidth > document.documentElement.clientWidth) problems.push('the page is wider than the screen');
  return {dark: rgb(paper).slice(0, 3).reduce((a, b) => a + b) < 200, problems: [...new Set(problems)].slice(0, 8), plots: document.querySelectorAll('svg path').length};
}

const browser = await launch();
const problems = [];
for (const [name, width, colorScheme, media] of [['wide', 1400, 'light', 'screen'], ['phone', 390, 'light', 'screen'], ['dark', 1400, 'dark', 'screen'], ['paper', 703, 'dark', 'print']]) {
  const page = await browser.newPage({viewport: {width, height: 900}, colorScheme});
  await page.emulateMedia({media, colorScheme});
  await page.goto(pathToFileURL(resolve(file)).href);
  await page.evaluate(() => document.querySelectorAll('details').forEach((d) => { d.open = true; }));
  const seen = await page.evaluate(inspect);
  if (seen.dark !== (name === 'dark')) problems.push(`${name}: the page is ${seen.dark ? 'dark' : 'light'}`);
  if (!seen.plots) problems.push(`${name}: nothing is drawn`);
  problems.push(...seen.problems.map((problem) => `${name}: ${problem}`));
  if (folder) await page.screenshot({path: join(folder, `${name}.png`), fullPage: true});
  await page.close();
}
await browser.close();
problems.forEach((problem) => console.error(problem));
console.log(problems.length ? `${problems.length} problems` : 'the page is sound');
process.exit(problems.length ? 1 : 0);
