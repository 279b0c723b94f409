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

/** The grid as the charts see it: the longest axis lies across, what is left makes curves. */
function gridView(sweep) {
  const longest = sweep.axes.reduce((most, a, i) => a.labels.length > (sweep.axes[most]?.labels.length ?? 1) ? i : most, -1);
  const across = sweep.axes[longest] ?? {name: '', labels: [''], values: [null]};
  const curves = new Map();
  sweep.cells.forEach((cell, index) => {
    const words = sweep.axes.flatMap((a, i) => i === longest || a.labels.length < 2 ? [] : [`${axisWords(a.name)}: ${a.labels[cell.at[i]]}`]);
    if (sweep.methods.length > 1) words.push(cell.method);
    const key = words.join(', ') || cell.method;
    if (!curves.has(key)) curves.set(key, {name: key, cells: []});
    curves.get(key).cells.push({point: longest < 0 ? 0 : cell.at[longest], index, ...cell});
  });
  const values = across.values;
  const numeric = values.every(isNumber);
  const log = numeric && Math.min(...values) > 0 && Math.max(...values) >= 4 * Math.min(...values);
  const place = (point) => !numeric ? point : log ? Math.log10(values[point]) : values[point];
  return {name: axisWords(across.name), labels: across.labels, values, log, place, all: [...curves.values()], curves: [...curves.values()].slice(0, 6)};
}

/** The axis across, labelled at the points of the grid. */
function acrossAxis(view, width) {
  const places = view.labels.map((_, i) => view.place(i));
  const span = Math.max(...places) - Math.min(...places) || 1;
  const label = (value) => view.labels[places.reduce((best, p, i) => Math.abs(p - value) < Math.abs(places[best] - value) ? i : best, 0)];
  const words = !view.values.every(isNumber);
  const margin = words ? 0.5 : 0.07 * span;
  return axis(view.log ? `${view.name} (log)` : view.name, {
    nameGap: words ? 44 : 30, min: Math.min(...places) - margin, max: Math.max(...places) + margin,
    axisTick: {show: true, customValues: places}, axisLabel: {color: colours.ink, hideOverlap: true, customValues: places, formatter: label,
      ...(words ? {width: (width - 60) / view.labels.length, overflow: 'break', lineHeight: 14} : {})},
    splitLine: {show: false},
  });
}

const colourOf = (i) => colours.series[i % colours.series.length];

/** The same without that of what studies add. */
const curveColour = (i) => colours.series[[0, 2, 3, 4, 5, 1][i % 6]];

/** Height that a legend of these names takes: about 7 px a letter. */
function legendHeight(names, width) {
  let rows = 1, used = 0;
  for (const name of names) {
    const needs = 36 + 7 * name.length;
    if (used > 0 && used + needs > width) { rows += 1; used = 0; }
    used += needs;
  }
  return 18 * rows;
}

/** RMSE of one quantity over the grid, its bound, and what studies add. */
function errorChart(sweep, view, quantity, q) {
  const [factor, unit] = shown(quantity.unit);
  const positive = (cells, key) => cells.filter((c) => c.rows[q][key] > 0).map((c) => [view.place(c.point), factor * c.rows[q][key]]);
  const series = view.curves.flatMap((curve, i) => [
    {name: view.curves.length > 1 ? curve.name : 'RMSE', type: 'scatter', symbolSize: 8, z: 4, data: positive(curve.cells, 'rmse'), itemStyle: {color: curveColour(i)}},
    {name: 'bound', type: 'line', symbol: 'none', data: positive(curve.cells, 'bound'), itemStyle: {color: colours.grey}, lineStyle: {color: colours.grey, type: 'dashed', width: 1.4}},
  ]).filter((s) => s.data.length);
  series.push(...studies.flatMap((study) => study.errorSeries(sweep, view, quantity)));
  if (!series.length) return null;
  const names = [...new Set(series.map((s) => s.name))].map((name) => series.find((s) => s.name === name));
  return figure({caption: `${quantity.name}: root mean square error and the least that is possible.`, description: `RMSE of ${quantity.name} over ${view.name}`, size: view.curves.length > 2 ? 'map' : 'normal',
    build: (width) => ({grid: grid({top: 38 + legendHeight(names.map((s) => s.name), width)}), legend: legendOf(names, {left: 0, right: 0}), xAxis: acrossAxis(view, width),
      yAxis: uprightAxis(unit, {type: 'log', nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -20]}, nameGap: 14, minorTick: {show: true}, minorSplitLine: {show: true, lineStyle: {color: '#f0f2f5'}}}), series})});
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
  const all = view.curves.flatMap((c) => c.cells);
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
  const limit = roundUp(1.05 * largest(series.flatMap((s) => s.data.flatMap((d) => d.slice(1)))));
  return figure({caption: `${quantity.name}: ${known ? 'errors over the bound’s standard deviation' : 'errors'}, the line is the median.`,
    description: `Spread of the errors of ${quantity.name} over ${view.name}`, size: view.curves.length > 2 ? 'map' : 'normal',
    build: (width) => ({grid: grid({top: 38 + legendHeight(series.map((s) => s.name), width)}), legend: legend({left: 0, right: 0}), xAxis: acrossAxis(view, width),
      yAxis: uprightAxis(known ? 'standard deviations' : unit, {min: -limit, max: limit, interval: limit / 2, nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -20]}, nameGap: 14}), series})});
}

/** A share with its interval for every quantity, one mark a point of the grid; of one curve. */
function shareChart(sweep, view, curve, {keys, factor, reference, name, words}) {
  const points = [...curve.cells].sort((a, b) => a.point - b.point);
  const colour = (i) => points.length <= 6 ? colourOf(i) : colours.measured;
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
  const many = series.length > 6;
  const of = view.all.length > 1 ? ` ${curve.name}.` : '';
  return figure({caption: `${words}${of} From left to right: ${view.name} ${view.labels.join(', ')}.`, description: words, size: 'map',
    build: (width) => ({grid: grid({top: many ? 44 : 62, bottom: width < 700 ? 8 : 20}), ...(many ? {} : {legend: legend({left: 0, right: 0})}),
      xAxis: axis('', {min: -0.5, max: names.length - 0.5, axisTick: {show: false}, splitLine: {show: false},
        axisLabel: {color: colours.ink, rotate: width < 900 ? 60 : 0, customValues: names.map((_, i) => i), formatter: (v) => names[Math.round(v)], hideOverlap: false}}),
      yAxis: uprightAxis(name, {min: Math.max(0, step * Math.floor((Math.min(...values) - margin) / step)), max: step * Math.ceil((Math.max(...values) + margin) / step), interval: step,
        nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -30]}}), series})});
}

/** How often a diagnosis finds, over the grid, with its interval; `key` is "found" or "named". */
function detectionChart(sweep, view, key, caption) {
  const curves = view.all.map((curve, i) => ({...curve, colour: curveColour(i), cells: curve.cells.filter((c) => c.method === 'diagnosis' && c[key])
    .sort((a, b) => view.place(a.point) - view.place(b.point))})).filter((curve) => curve.cells.length).slice(0, 6);
  if (!curves.length) return null;
  const name = (curve) => curves.length > 1 ? curve.name : key;
  const series = curves.flatMap((curve) => [
    {name: name(curve), type: 'line', symbol: 'circle', symbolSize: 6, z: 4, data: curve.cells.map((c) => [view.place(c.point), 100 * c[key][1]]),
      itemStyle: {color: curve.colour}, lineStyle: {color: curve.colour, width: view.values.every(isNumber) ? 1.6 : 0}},
    {...spans(name(curve), curve.cells.map((c) => [view.place(c.point), ...c[key].map((share) => 100 * share)]), {colour: curve.colour, half: 4}), tooltip: {show: false}}]);
  const names = series.filter((s) => s.type === 'line');
  return figure({caption, description: caption, size: curves.length > 2 ? 'map' : 'normal',
    build: (width) => ({grid: grid({top: 38 + legendHeight(names.map((s) => s.name), width)}), legend: legendOf(names, {left: 0, right: 0}), xAxis: acrossAxis(view, width),
      yAxis: uprightAxis('% of the repeats', {min: 0, max: 100, interval: 25, nameTextStyle: {align: 'left', color: colours.grey, padding: [0, 0, 0, -20]}, nameGap: 14}), series})});
}
