// SPDX-License-Identifier: Apache-2.0
// Charts of a sweep: error against its bound, spread, efficiency and coverage over the grid.

const unitWords = {um: 'µm', mm: 'mm', deg: '°', rad: 'rad', mrad: 'mrad', rpm: '1/min', s: 's', hz: 'Hz', mm_per_rev: 'mm/rev'};

/** "pass.length_mm" as "pass.length in mm". */
function axisWords(name) {
  const unit = Object.keys(unitWords).filter((u) => name.endsWith(`_${u}`)).sort((a, b) => b.length - a.length)[0];
  return (unit ? `${name.slice(0, -unit.length - 1)} in ${unitWords[unit]}` : name).replaceAll('_', ' ');
}

/** Factor and unit in which a chart shows small amounts of an edge unit. */
const shown = (unit) => ({mm: [1000, 'µm'], 1: [1000, 'µm/mm'], deg: [1000, '10⁻³ °']})[unit] ?? [1, unit];

/** "pass.length_mm = 10, kind = slow" with the axes in words. */
const placeWords = (name) => name.split(', ').map((part) => part.includes(' = ')
  ? `${axisWords(part.slice(0, part.indexOf(' = ')))}: ${part.slice(part.indexOf(' = ') + 3)}` : part).join(', ');

const curvesAPanel = 12;  // as many as there are colours
const mostPanels = 12;   // of one quantity; the table has what is beyond

/** Curves in panels of so many at most: by the leading words of their names where that is enough, else in turn. */
function panelsOf(curves) {
  if (curves.length <= curvesAPanel) return [{title: '', curves}];
  const grouped = (words) => {
    const groups = new Map();
    for (const c of curves) {
      const title = c.words.slice(0, words).join(', ');
      groups.set(title, [...groups.get(title) ?? [], c]);
    }
    return [...groups];
  };
  const depth = curves[0].words.length;
  let words = 0;
  while (words + 1 < depth && grouped(words).some(([, group]) => group.length > curvesAPanel)) words += 1;
  return grouped(words).flatMap(([title, group]) => {
    const panels = Math.ceil(group.length / curvesAPanel), size = Math.ceil(group.length / panels);
    return Array.from({length: panels}, (_, i) => ({title, curves: group.slice(i * size, (i + 1) * size)
      .map((c) => ({...c, name: c.words.slice(words).join(', ')}))}));
  });
}

/** The grid as the charts see it: the longest axis lies across, the others make curves. */
function gridView(sweep) {
  const longest = sweep.axes.reduce((most, a, i) => a.labels.length > (sweep.axes[most]?.labels.length ?? 1) ? i : most, -1);
  const across = sweep.axes[longest] ?? {name: '', labels: [''], values: [null]};
  const curves = new Map();
  sweep.cells.forEach((cell, index) => {
    const words = sweep.axes.flatMap((a, i) => i === longest || a.labels.length < 2 ? [] : [`${axisWords(a.name)}: ${a.labels[cell.at[i]]}`]);
    if (sweep.methods.length > 1) words.push(cell.method);
    const key = words.join(', ') || cell.method;
    if (!curves.has(key)) curves.set(key, {name: key, words, cells: []});
    curves.get(key).cells.push({point: longest < 0 ? 0 : cell.at[longest], index, ...cell});
  });
  const values = across.values;
  const numeric = values.every(isNumber);
  const log = numeric && Math.min(...values) > 0 && Math.max(...values) >= 4 * Math.min(...values);
  const place = (point) => !numeric ? point : log ? Math.log10(values[point]) : values[point];
  const all = [...curves.values()];
  const view = {name: axisWords(across.name), labels: across.labels, values, log, place, all};
  view.panels = panelsOf(all).slice(0, mostPanels).map((panel) => ({...view, ...panel}));
  for (const panel of view.panels) panel.panels = view.panels;  // they share their scales
  return view;
}

/** The end of a caption that says which panel it is of. */
const panelWords = (view) => view.title ? ` ${view.title[0].toUpperCase()}${view.title.slice(1)}.` : '';

/** The axis across, labelled at the points of the grid. */
function acrossAxis(view, width) {
  const places = view.labels.map((_, i) => view.place(i));
  const span = Math.max(...places) - Math.min(...places) || 1;
  const label = (value) => view.labels[places.reduce((best, p, i) => Math.abs(p - value) < Math.abs(places[best] - value) ? i : best, 0)];
  const words = !view.values.every(isNumber);
  const margin = words ? 0.5 : 0.07 * span;
  // Words take two lines at most.
  const letters = words ? Math.max(3, Math.floor((width - 60) / view.labels.length / 7)) : Infinity;
  const cut = (text) => text.length > letters ? `${text.slice(0, letters - 1)}…` : text;
  const inLines = (text) => {
    if (text.length <= letters) return text;
    const space = text.lastIndexOf(' ', letters), end = space > 0 ? space : letters;
    return `${text.slice(0, end)}\n${cut(text.slice(end).trimStart())}`;
  };
  return axis(view.log ? `${view.name} (log)` : view.name, {
    nameGap: words ? 44 : 30, nameTruncate: {maxWidth: width - 60, ellipsis: '…'}, min: Math.min(...places) - margin, max: Math.max(...places) + margin,
    axisTick: {show: true, customValues: places}, axisLabel: {color: colours.ink, hideOverlap: true, customValues: places, formatter: (value) => inLines(label(value)),
      ...(words ? {lineHeight: 14} : {})},
    splitLine: {show: false},
  });
}

/** Style of a curve; the second colour, which what studies add has, comes last. */
const curveStyle = (i) => ({...styleOf(i), colour: colours.series[[0, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 1][i % 12]]});
const curveColour = (i) => curveStyle(i).colour;

/** Ends of a logarithmic scale that small multiples share: in steps of 1, 2, 5. */
function logEnds(values) {
  const step = (value, up) => {
    const power = 10 ** Math.floor(Math.log10(value));
    const steps = [1, 2, 5, 10].map((s) => Number((s * power).toPrecision(3)));
    return up ? steps.find((s) => s >= value * (1 - 1e-9)) : steps.filter((s) => s <= value * (1 + 1e-9)).at(-1);
  };
  return {min: step(Math.min(...values), false), max: step(Math.max(...values), true)};
}

/** RMSE of one quantity over the grid, its bound, and what studies add. */
function errorChart(sweep, view, quantity, q) {
  const [factor, unit] = shown(quantity.unit);
  const positive = (cells, key) => cells.filter((c) => c.rows[q][key] > 0).map((c) => [view.place(c.point), factor * c.rows[q][key]]);
  const series = view.curves.flatMap((curve, i) => [
    {name: view.curves.length > 1 ? curve.name : 'RMSE', type: 'scatter', symbol: curveStyle(i).symbol, symbolSize: 8, z: 4, data: positive(curve.cells, 'rmse'), itemStyle: {color: curveColour(i)}},
    {name: 'bound', type: 'line', symbol: 'none', data: positive(curve.cells, 'bound'), itemStyle: {color: colours.grey}, lineStyle: {color: colours.grey, type: 'dashed', width: 1.4}},
  ]).filter((s) => s.data.length);
  series.push(...studies.flatMap((study) => study.errorSeries(sweep, view, quantity)));
  if (!series.length) return null;
  const names = [...new Set(series.map((s) => s.name))].map((name) => series.find((s) => s.name === name));
  const shared = view.panels.length > 1 ? logEnds(view.panels.flatMap((p) => p.curves.flatMap((c) => ['rmse', 'bound'].flatMap((key) => positive(c.cells, key).map(([, v]) => v))))) : {};
  return figure({caption: `${quantity.name}: root mean square error and the least that is possible.${panelWords(view)}`, description: `RMSE of ${quantity.name} over ${view.name}${panelWords(view)}`, height: heightFor(names, view.curves.length > 2 ? 360 : 290),
    build: (width) => ({...roomFor(names, width), xAxis: acrossAxis(view, width),
      yAxis: uprightAxis(unit, {type: 'log', ...shared, nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -20]}, nameGap: 14, minorTick: {show: true}, minorSplitLine: {show: true, lineStyle: {color: colours.soft}}}), series})});
}

/** Bars from low to high with a mark between, `data` of [x, low, mark, high]; side by side by `shift` px. */
const spans = (name, data, {colour, half, shift = 0}) => ({
  name, type: 'custom', data, encode: {x: 0, y: [1, 2, 3]}, itemStyle: {color: colour}, z: 3,
  renderItem: (_, api) => {
    const at = [1, 2, 3].map((i) => api.coord([api.value(0), api.value(i)]));
    const x = at[0][0] + shift;
    return {type: 'group', children: [
      {type: 'rect', shape: {x: x - half, y: at[2][1], width: 2 * half, height: at[0][1] - at[2][1]}, style: {fill: colour, opacity: 0.28}},
      {type: 'line', shape: {x1: x - half, x2: x + half, y1: at[1][1], y2: at[1][1]}, style: {stroke: colour, lineWidth: 2}}]};
  },
});

const guide = (values) => ({silent: true, symbol: 'none', animation: false, label: {show: false}, lineStyle: {color: colours.grey, type: 'dashed'}, data: values.map((v) => ({yAxis: v}))});

/** 5 % to 95 % of the errors in standard deviations of the bound, with what was published. */
function spreadChart(sweep, view, quantity, q) {
  const all = view.all.flatMap((c) => c.cells);
  const known = all.every((c) => c.rows[q].bound > 0);
  const [factor, unit] = shown(quantity.unit);
  const scale = (c) => known ? 1 / c.rows[q].bound : factor;
  const half = Math.max(2, 9 - view.curves.length);
  const series = view.curves.map((curve, i) => spans(view.curves.length > 1 ? curve.name : '5 % to 95 % of the repeats',
    curve.cells.filter((c) => isNumber(c.rows[q].q50)).map((c) => [view.place(c.point), ...['q05', 'q50', 'q95'].map((key) => c.rows[q][key] * scale(c))]),
    {colour: curveColour(i), half, shift: (i - (view.curves.length - 1) / 2) * 2 * half})).filter((s) => s.data.length);
  if (!series.length) return null;
  if (known) series[0].markLine = guide([-1.645, 0, 1.645]);
  if (known) series.push(...studies.flatMap((study) => study.spreadSeries(sweep, view, quantity)));
  const beyond = view.panels.flatMap((p) => p.curves.flatMap((c) => c.cells.flatMap((cell) => ['q05', 'q50', 'q95'].map((key) => cell.rows[q][key] * scale(cell)))));
  const limit = roundUp(1.05 * largest([...beyond, ...series.flatMap((s) => s.data.flatMap((d) => d.slice(1)))]));
  return figure({caption: `${quantity.name}: ${known ? 'errors over the bound’s standard deviation' : 'errors'}, the line is the median.${panelWords(view)}`,
    description: `Spread of the errors of ${quantity.name} over ${view.name}${panelWords(view)}`, height: heightFor(series, view.curves.length > 2 ? 360 : 290),
    build: (width) => ({...roomFor(series, width), xAxis: acrossAxis(view, width),
      yAxis: uprightAxis(known ? 'standard deviations' : unit, {min: -limit, max: limit, interval: limit / 2, nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -20]}, nameGap: 14}), series})});
}

/** A share with its interval for every quantity, one mark a point of the grid; of one curve. */
function shareChart(sweep, view, curve, {keys, factor, reference, name, words}) {
  const points = [...curve.cells].sort((a, b) => a.point - b.point);
  const colour = (i) => points.length <= colours.series.length ? styleOf(i).colour : colours.measured;
  const room = 0.8 / points.length;
  const names = sweep.quantities.map((q) => q.name);
  const series = points.map((cell, i) => ({
    name: view.labels[cell.point] || 'this plan', type: 'custom', encode: {x: 0, y: [1, 2, 3]}, itemStyle: {color: colour(i)},
    data: cell.rows.map((row, q) => [q + (i + 0.5) * room - 0.4, ...keys.map((key) => row[key] * factor)]).filter((d) => d.slice(1).every((v) => v > 0)),
    renderItem: (_, api) => {
      const [low, mid, high] = [1, 2, 3].map((k) => api.coord([api.value(0), api.value(k)]));
      return {type: 'group', children: [
        {type: 'line', shape: {x1: low[0], x2: low[0], y1: low[1], y2: high[1]}, style: {stroke: colour(i), lineWidth: 1.6}},
        {type: 'circle', shape: {cx: mid[0], cy: mid[1], r: 2.6}, style: {fill: colour(i)}}]};
    },
  })).filter((s) => s.data.length);
  if (!series.length) return null;
  series[0].markLine = guide([reference]);
  const values = series.flatMap((s) => s.data.flatMap((d) => d.slice(1))).concat(reference);
  const margin = 0.08 * (Math.max(...values) - Math.min(...values));
  const step = roundUp((Math.max(...values) - Math.min(...values) + 2 * margin) / 6);
  const many = series.length > colours.series.length;
  const of = view.all.length > 1 ? ` ${curve.name}.` : '';
  return figure({caption: `${words}${of} From left to right: ${view.name} ${view.labels.join(', ')}.`, description: words, size: 'map',
    height: many ? undefined : heightFor(series, 360),
    build: (width) => ({...(many ? {} : roomFor(series, width)), grid: grid({top: many ? 44 : 30 + legendAbove(series, width).height, bottom: width < 700 ? 8 : 20}),
      xAxis: axis('', {min: -0.5, max: names.length - 0.5, axisTick: {show: false}, splitLine: {show: false},
        axisLabel: {color: colours.ink, rotate: width < 900 ? 60 : 0, customValues: names.map((_, i) => i), formatter: (v) => names[Math.round(v)], hideOverlap: false}}),
      yAxis: uprightAxis(name, {min: Math.max(0, step * Math.floor((Math.min(...values) - margin) / step)), max: step * Math.ceil((Math.max(...values) + margin) / step), interval: step,
        nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -14]}}), series})});
}

/** How often a diagnosis finds, over the grid, with its interval; `key` is "found" or "named". */
function detectionChart(sweep, view, key, caption) {
  const curves = view.curves.map((curve, i) => ({...curve, ...curveStyle(i), cells: curve.cells.filter((c) => c.method === 'diagnosis' && c[key])
    .sort((a, b) => view.place(a.point) - view.place(b.point))})).filter((curve) => curve.cells.length);
  if (!curves.length) return null;
  const name = (curve) => curves.length > 1 ? curve.name : key;
  const series = curves.flatMap((curve) => [
    {name: name(curve), type: 'line', symbol: curve.symbol, symbolSize: 6, z: 4, data: curve.cells.map((c) => [view.place(c.point), 100 * c[key][1]]),
      itemStyle: {color: curve.colour}, lineStyle: {color: curve.colour, type: curve.dash, width: view.values.every(isNumber) ? 1.6 : 0}},
    {...spans(name(curve), curve.cells.map((c) => [view.place(c.point), ...c[key].map((share) => 100 * share)]), {colour: curve.colour, half: 4}), tooltip: {show: false}}]);
  const names = series.filter((s) => s.type === 'line');
  return figure({caption: caption + panelWords(view), description: caption + panelWords(view), height: heightFor(names, curves.length > 2 ? 360 : 290),
    build: (width) => ({...roomFor(names, width), xAxis: acrossAxis(view, width),
      yAxis: uprightAxis('% of the repeats', {min: 0, max: 100, interval: 25, nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -20]}, nameGap: 14}), series})});
}
