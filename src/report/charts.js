// SPDX-License-Identifier: Apache-2.0
// What all charts share: colours that colour-blind readers can tell apart, axes, and figures that redraw
// themselves when the width of the page changes.

const palettes = {
  light: {measured: '#0072b2', model: '#d55e00', rejected: '#b3001b', grey: '#5b6673', grid: '#e3e7ec', ink: '#1d2733', line: '#9aa4b0', paper: '#ffffff',
    soft: '#eef1f4', veil: 'rgb(255 255 255 / 85%)',
    series: ['#0072b2', '#d55e00', '#009e73', '#a0569b', '#8a6d00', '#3a86c8', '#7a3b12', '#00757a', '#c2377a', '#5a6b00', '#4b4fb8', '#5b6673'],
    diverging: ['#14477f', '#4393c3', '#b5d5e8', '#f4f4f2', '#f6c3a5', '#d6604d', '#8c1127'],
    before: ['#f7f4ee', '#f6d9b8', '#f0a35e', '#d6604d', '#8c1127', '#3f0713'], after: ['#f1f5f8', '#c3dcea', '#7fb5d5', '#3a86b8', '#14477f']},
  dark: {measured: '#4fb0ea', model: '#ff9248', rejected: '#ff6b7d', grey: '#a9b3be', grid: '#2d3640', ink: '#e3e8ed', line: '#6b7783', paper: '#14191f',
    soft: '#242c35', veil: 'rgb(20 25 31 / 85%)',
    series: ['#4fb0ea', '#ff9248', '#2fc99b', '#d69ad1', '#d1b13c', '#86c5ff', '#d99a6c', '#45c3c9', '#ff8fc0', '#b4c74a', '#a3a6ff', '#a9b3be'],
    diverging: ['#7cc0ff', '#4a90cc', '#2c567a', '#2a3038', '#7d4b38', '#d2714c', '#ffab8c'],
    before: ['#2a2622', '#5c4128', '#a0652f', '#e0803c', '#ffb27a', '#ffe3cb'], after: ['#1f272e', '#27465a', '#2f6f96', '#4fa3d4', '#a9dcff']},
};
const colours = {...palettes.light};
const charts = [];
const oneCanvas = 1e9;  // marks from which on a series has a canvas of its own: on paper the other one would be blank

/** Twelve colours; from the seventh curve on another dash and another mark as well. */
const styleOf = (i) => ({colour: colours.series[i % colours.series.length], dash: ['solid', 'dashed', 'dotted'][Math.floor(i / 6) % 3],
  symbol: ['circle', 'triangle', 'diamond', 'rect'][Math.floor(i / 6) % 4]});
const fontFamily = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif';

/** A chart with its caption. `build(width)` returns the ECharts option for a width in px; `height(width)`, in px, is
 * what a chart asks for whose size does not say it. */
function figure({caption, description, size = 'normal', renderer = 'canvas', build, height}) {
  const box = element('div', {class: `chart ${size}`, role: 'img', 'aria-label': description});
  const made = element('figure', {}, box, element('figcaption', {}, joined(caption)));
  const fit = () => { if (height) box.style.height = `${height(box.clientWidth)}px`; };
  made.start = () => {
    if (made.redraw) return;
    fit();
    const chart = echarts.init(box, null, {renderer});
    const draw = () => chart.setOption({...common(description), ...build(box.clientWidth)}, true);
    draw();
    charts.push(chart);
    made.chart = chart;
    let width = box.clientWidth;
    made.redraw = () => {
      if (box.clientWidth === width) return;
      width = box.clientWidth;
      fit();
      chart.resize({animation: {duration: 0}});
      draw();
    };
  };
  return made;
}

function common(description) {
  return {
    animation: false,
    backgroundColor: 'transparent',
    color: colours.series,
    textStyle: {fontFamily, fontSize: 12, color: colours.ink},
    aria: {enabled: true, label: {description}},
  };
}

function axis(name, more = {}) {
  return {
    type: 'value',
    name,
    nameLocation: 'middle',
    nameGap: 30,
    nameTextStyle: {color: colours.grey, fontFamily},
    axisLine: {show: true, onZero: false, lineStyle: {color: colours.line}},
    axisTick: {show: true, lineStyle: {color: colours.line}},
    axisLabel: {color: colours.ink, hideOverlap: true, formatter: tick},
    splitLine: {lineStyle: {color: colours.grid}},
    ...more,
  };
}

/** Upright axis: its name is level above it, which needs no width. */
const uprightAxis = (name, more = {}) =>
  axis(name, {nameLocation: 'end', nameGap: 12, nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -24]}, ...more});

/** An axis that ends just beyond its values, labelled at round numbers. */
function spanning(values) {
  const kept = values.filter(isNumber);
  const low = kept.reduce((a, b) => Math.min(a, b), Infinity), high = kept.reduce((a, b) => Math.max(a, b), -Infinity);
  const margin = high > low ? 0.02 * (high - low) : 1;
  const step = 10 ** Math.floor(Math.log10(margin));
  const min = Number((step * Math.floor((low - margin) / step)).toPrecision(10)), max = Number((step * Math.ceil((high + margin) / step)).toPrecision(10));
  const customValues = niceTicks(min, max, 6);
  return {min, max, axisTick: {show: true, customValues, lineStyle: {color: colours.line}},
    axisLabel: {color: colours.ink, hideOverlap: true, formatter: tick, customValues}};
}

/** An axis about zero whose ends, of roundUpFinely, are labelled like the steps between. */
function aboutZero(limit) {
  const leading = Number((limit / 10 ** Math.floor(Math.log10(limit))).toPrecision(6));
  return {min: -limit, max: limit, interval: Number((limit / ([1.2, 2.4, 3, 6].includes(leading) ? 3 : 2)).toPrecision(6))};
}

const angleAxis = (width, name = 'spindle angle C in °') =>
  axis(name, {min: 0, max: 360, interval: width < 480 ? 90 : 45});

const tick = (value) => String(Math.abs(value) < 1e-12 ? 0 : Number(value.toPrecision(10))).replace('-', '−');

const grid = (more = {}) => ({left: 12, right: 22, top: 44, bottom: 34, containLabel: true, ...more});

/** A name as long as a legend on a phone has room for. */
const shortened = (name) => name.length > 42 ? `${name.slice(0, 41)}…` : name;

const legend = (more = {}) => ({top: 0, right: 0, itemWidth: 18, itemHeight: 9, textStyle: {color: colours.ink}, formatter: shortened, ...more});

/** A legend of series; lines are shown without a mark, which they do not have. */
const legendOf = (series, more = {}) => legend({
  ...more, data: series.map((s) => s.type === 'line' && s.symbol === 'none' ? {name: s.name, itemStyle: {opacity: 0}} : {name: s.name})});

/** A legend above a chart of this width, and the height it takes; a name that needs more than a line is broken. */
function legendAbove(series, width) {
  const most = width - 40;
  let height = 20, used = 0, broken = false;
  for (const {name} of series) {
    const letters = textWidth(name), lines = Math.ceil(1.1 * letters / most);
    const needs = 40 + Math.min(letters, most);  // sign, gaps and letters
    broken ||= lines > 1;
    if (used > 0 && (used + needs > width - 10 || broken)) { height += 23; used = 0; }
    height += 15 * (lines - 1);
    used += needs;
  }
  const text = {color: colours.ink, lineHeight: 15, ...(broken ? {width: most, overflow: 'break'} : {})};
  return {height, legend: legendOf(series, {left: 0, right: 0, itemGap: 8, textStyle: text})};
}

/** What a name takes in a legend, px. */
function textWidth(words) {
  textWidth.canvas ??= document.createElement('canvas').getContext('2d');
  textWidth.canvas.font = `12px ${fontFamily}`;
  return textWidth.canvas.measureText(words).width;
}

/** A chart's grid below its legend. */
function roomFor(series, width) {
  const above = legendAbove(series, width);
  return {grid: grid({top: 30 + above.height}), legend: above.legend};
}

/** What a chart with such a legend needs, so that the plot stays as it is. */
const heightFor = (series, least) => (width) => Math.max(least, 250 + legendAbove(series, width).height);

/** Smallest 1-2-5 number that is at least `value`. */
function roundUp(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 2.5, 5, 10].map((step) => step * power).find((step) => step >= value * (1 - 1e-9));
}

/** The same in finer steps, for the ends of a scale. */
function roundUpFinely(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return Number(([1, 1.2, 1.6, 2, 2.4, 3, 4, 5, 6, 8, 10].find((step) => step * power >= value * (1 - 1e-9)) * power).toPrecision(6));
}

/** Largest magnitude of the numbers in a list, 0 for none. */
const largest = (values) => values.reduce((most, v) => isNumber(v) ? Math.max(most, Math.abs(v)) : most, 0);

/** Nice tick values inside [low, high]. */
function niceTicks(low, high, about) {
  const step = roundUp((high - low) / about);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1) ticks.push(Number((i * step).toPrecision(10)));
  return ticks;
}

/** Colour scale about zero, in µm, below the chart. */
const colourScale = (limit, width, seriesIndex = 0) => ({
  type: 'continuous', min: -limit, max: limit, dimension: 2, seriesIndex, orient: 'horizontal', left: 'center', bottom: 0,
  itemWidth: 12, itemHeight: Math.min(260, width * 0.4), calculable: false,
  inRange: {color: colours.diverging},
  text: [`+${tick(limit)} µm`, `−${tick(limit)} µm`], textStyle: {color: colours.ink},
});

/** A category axis over equal bins of [low, high] that is labelled with round numbers. */
function binAxis(make, name, {low, high, count, ticks}) {
  const width = (high - low) / count;
  const labels = new Map(ticks.map((value) => [Math.min(count - 1, Math.max(0, Math.round((value - low) / width - 0.5))), value]));
  const labelled = (i) => labels.has(Number(i));
  return make(name, {
    type: 'category',
    data: Array.from({length: count}, (_, i) => String(i)),
    axisLabel: {color: colours.ink, interval: labelled, hideOverlap: true, formatter: (_, i) => tick(labels.get(i) ?? 0)},
    axisTick: {show: true, interval: labelled, alignWithLabel: true, lineStyle: {color: colours.line}},
    splitLine: {show: false},
  });
}

/** Heat map of cells [rows × columns] of an unrolled surface, values in µm about zero. */
function cellMap(cells, values, {limit, positionName, width, cName}) {
  const data = [];
  for (let i = 0; i < values.length; i += 1) {
    if (isNumber(values[i])) data.push([i % cells.columns, Math.floor(i / cells.columns), values[i]]);
  }
  const {position_min_mm: low, position_max_mm: high} = cells;
  // Whole pixels a cell, or seams show between them.
  const pixels = (room, count) => Math.max(1, Math.floor(room / count)) * count;
  return {
    grid: {left: 58, top: 44, width: pixels(width - 76, cells.columns), height: pixels(250, cells.rows)},
    xAxis: binAxis(axis, cName ?? 'spindle angle C in °', {low: 0, high: 360, count: cells.columns, 
      ticks: Array.from({length: width < 480 ? 5 : 9}, (_, i) => i * (width < 480 ? 90 : 45))}),
    yAxis: binAxis(uprightAxis, positionName, {low, high, count: cells.rows, ticks: niceTicks(low, high, 6)}),
    visualMap: colourScale(limit, width),
    series: [{type: 'heatmap', data, progressive: 0, progressiveThreshold: oneCanvas, emphasis: {disabled: true}}],
  };
}

/** Those of the figures that nothing folds away. */
const shownFigures = () => [...document.querySelectorAll('figure')].filter((f) => !f.closest('details:not([open])'));
const startShown = () => shownFigures().forEach((f) => f.start());
const redrawShown = () => shownFigures().forEach((f) => f.redraw());

/** Paper has no scroll bar: a table that is wider than it is made smaller. */
function fitTables(on) {
  for (const box of document.querySelectorAll('.scroll')) {
    const inside = box.querySelector('table');
    inside.style.zoom = '';
    if (on && box.scrollWidth > box.clientWidth) inside.style.zoom = String(Math.floor(990 * box.clientWidth / box.scrollWidth) / 1000);
  }
}

/** Charts keep their size in px: before printing the page takes the width and the colours of paper, and unfolds. */
function follow(draw) {
  let folded = [];
  const unfold = () => {
    folded = [...document.querySelectorAll('details:not([open])')].map((d) => d.id);
    document.querySelectorAll('details').forEach((d) => { d.open = true; });
    startShown();
  };
  const printing = (on) => {
    if (document.body.classList.contains('printing') === on) return;
    document.body.classList.toggle('printing', on);
    if (!on) folded.forEach((id) => { document.getElementById(id).open = false; });
    draw();
    if (on) unfold();
    redrawShown();
    charts.forEach((chart) => chart.getZr().flush());  // paper waits for no frame
    fitTables(on);
  };
  window.addEventListener('resize', redrawShown);
  window.addEventListener('beforeprint', () => printing(true));
  window.addEventListener('afterprint', () => printing(false));
  document.addEventListener('toggle', (event) => { if (event.target.open) { startShown(); redrawShown(); } }, true);
  return unfold;
}

/** Builds the page in the colours that the reader asks for (paper is light) and draws its charts, those that are folded
 * when they are unfolded; says so to a test when two frames have passed. */
function startPage(build) {
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  let drawn = null;
  const draw = () => {
    const scheme = dark.matches && !document.body.classList.contains('printing') ? 'dark' : 'light';
    if (scheme === drawn) return;
    drawn = scheme;
    charts.splice(0).forEach((chart) => chart.dispose());
    Object.assign(colours, palettes[scheme]);
    const open = [...document.querySelectorAll('details[id][open]')].map((d) => d.id);
    build();
    open.forEach((id) => { document.getElementById(id).open = true; });
    startShown();
  };
  draw();
  const unfold = follow(draw);
  dark.addEventListener('change', draw);
  window.trueaxisReport = {charts, unfold, ready: false};
  requestAnimationFrame(() => requestAnimationFrame(() => { window.trueaxisReport.ready = true; }));
}
