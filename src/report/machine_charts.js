// SPDX-License-Identifier: Apache-2.0
// Charts of a machine's job: the error over the volume and along the program, the path with its errors, errors by name.

const shades = {get before_um() { return colours.before; }, get after_um() { return colours.after; }};
const stages = {get before() { return colours.series[1]; }, get after() { return colours.series[0]; }, get nominal() { return colours.line; }, get limit() { return colours.rejected; }};
const um = (value) => micrometres(value / 1000);
const degreesOrMm = ({unit, value}) => `${tick(Number(value.toPrecision(4)))}${unit === '°' ? '' : nbsp}${unit}`;

/** Colour scale of sizes in µm, below the chart. */
const sizeScale = (limit, width, color) => ({
  type: 'continuous', min: 0, max: limit, dimension: 2, seriesIndex: 0, orient: 'horizontal', left: 'center', bottom: 0,
  itemWidth: 12, itemHeight: Math.min(220, width * 0.4), calculable: false, inRange: {color},
  text: [`${tick(limit)} µm`, '0'], textStyle: {color: colours.ink}});

/** The tip's error over the positions of two axes. */
function volumeMap(map, key, words, limit) {  // `key` has a scale of its own
  const {across, up} = map;
  const values = map[key];
  const reached = values.filter(isNumber);
  const at = map.at.length ? `, at ${map.at.map((a) => `${a.name}${nbsp}${degreesOrMm(a)}`).join(', ')}` : '';
  const most = largest(reached);
  const caption = `${words}: up to ${um(most)}${at}.${reached.length < values.length ? ' White: out of reach.' : ''}`;
  const data = values.map((value, i) => [i % across.count, Math.floor(i / across.count), value]).filter((cell) => isNumber(cell[2]));
  const pixels = (room, count) => Math.max(1, Math.floor(room / count)) * count;
  return figure({caption, description: `Heat map over ${across.name} and ${up.name}. ${caption} The least is ${um(reached.reduce((a, b) => Math.min(a, b), Infinity))}.`, size: 'map',
    build: (width) => ({
      grid: {left: 58, top: 44, width: pixels(width - 76, across.count), height: pixels(250, up.count)},
      xAxis: binAxis(axis, `${across.name} in ${across.unit}`, {...across, ticks: niceTicks(across.low, across.high, width < 480 ? 4 : 6)}),
      yAxis: binAxis(uprightAxis, `${up.name} in ${up.unit}`, {...up, ticks: niceTicks(up.low, up.high, 6)}),
      visualMap: sizeScale(limit, width, shades[key]),
      series: [{type: 'heatmap', data, progressive: 0, progressiveThreshold: oneCanvas, emphasis: {disabled: true}}],
    })});
}

/** Error of the tip along the program. */
function alongProgram(tips, verdict) {
  const atMost = tips.after_um.map((after, i) => after + verdict.not_corrected_um + 2 * tips.u_um[i]);
  const curve = (name, values, colour, more = {}) => ({name, type: 'line', symbol: 'none', emphasis: {disabled: true}, itemStyle: {color: colour},
    lineStyle: {color: colour, width: 1.6, ...more}, data: tips.line.map((line, i) => [line, values[i]])});
  const series = [curve('before', tips.before_um, stages.before), curve('after', tips.after_um, stages.after),
    curve('after, at most (95 % confidence)', atMost, stages.after, {type: 'dashed', width: 1.2})];
  const ends = [tips.line[0], tips.line[tips.line.length - 1]];
  if (isNumber(verdict.tolerance_um)) series.push({name: 'tolerance', type: 'line', symbol: 'none', emphasis: {disabled: true}, itemStyle: {color: stages.limit},
    lineStyle: {color: stages.limit, width: 1.2, type: 'dotted'}, data: ends.map((line) => [line, verdict.tolerance_um])});
  const most = Math.max(largest(tips.before_um), largest(atMost), isNumber(verdict.tolerance_um) && verdict.tolerance_um < 3 * largest(tips.before_um) ? verdict.tolerance_um : 0);
  const build = (width) => ({grid: grid({top: width < 480 ? 76 : 60}), legend: legendOf(series, {left: 0, right: 0}),
    xAxis: axis('line of the program', spanning(tips.line)), yAxis: uprightAxis('tip off by, in µm', {min: 0, max: roundUpFinely(1.05 * most)}), series});
  return figure({caption: `How far the tip is off at the end of every cutting block, the displacement of the part as a whole taken off. Between the ends the new program leaves the line by up to ${um(verdict.between_um)}.${tips.thinned ? ' Of neighbours the one that is furthest off is drawn.' : ''}`,
    description: `Tip error along the program: before up to ${um(largest(tips.before_um))}, after up to ${um(largest(tips.after_um))}, at most ${um(largest(atMost))} in 95 of 100.`,
    size: 'map', renderer: tips.line.length > 2000 ? 'canvas' : 'svg', build});
}

/** Spans of the program's tips along x, y, z. */
const spansOf = (tips) => tips.tip_mm.map((list) => ({low: list.reduce((a, b) => Math.min(a, b), Infinity), high: list.reduce((a, b) => Math.max(a, b), -Infinity)}));

const magnifiedBy = (tips) => {
  const reach = Math.max(...spansOf(tips).map(({low, high}) => high - low), 1), most = Math.max(largest(tips.before_um), 1e-3) / 1000;
  return Math.max(1, Number(roundUp(0.06 * reach / most).toPrecision(3)));
};

/** How x, y, z are drawn: seen along z, or from above at an angle with equal scales (isometric). */
const views = {
  plan: {words: 'seen along z', show: ([x, y]) => [x, y], across: 'x in mm', up: 'y in mm'},
  isometric: {words: 'seen at an angle from above (isometric)', show: ([x, y, z]) => [0.866 * (x - y), 0.5 * (x + y) + z], across: '', up: ''},
};

/** The path in the part and where the tip really goes, its errors magnified: one scale along both sides. */
function pathView(tips, {words, show, across, up}, magnified) {
  const point = (i, by) => show([0, 1, 2].map((k) => tips.tip_mm[k][i] + (by ? magnified * by[k][i] / 1000 : 0)));
  const all = tips.line.map((_, i) => i), every = Math.ceil(all.length / 150);
  const path = (name, by, colour, width, z) => ({name, type: 'line', symbol: 'none', silent: true, emphasis: {disabled: true}, z, itemStyle: {color: colour},
    lineStyle: {color: colour, width}, data: all.map((i) => point(i, by))});
  // Gaps between the strokes: a series of `lines` has a canvas of its own, which printers leave blank.
  const vectors = {name: 'before', type: 'line', symbol: 'none', silent: true, emphasis: {disabled: true}, z: 3, itemStyle: {color: stages.before}, lineStyle: {color: stages.before, width: 0.9, opacity: 0.7},
    data: all.filter((i) => i % every === 0).flatMap((i) => [point(i), point(i, tips.by_before_um), ['-', '-']])};
  const series = [path('programmed', null, stages.nominal, 3, 1), path('before', tips.by_before_um, stages.before, 1.1, 4), path('after', tips.by_after_um, stages.after, 1.1, 5), vectors];
  const drawn = series.slice(0, 3).flatMap((s) => s.data), ends = [0, 1].map((k) => drawn.reduce(([low, high], p) => [Math.min(low, p[k]), Math.max(high, p[k])], [Infinity, -Infinity]));
  const sizes = ends.map(([low, high]) => 1.06 * Math.max(high - low, 1e-3));
  const wide = (width) => width - 70, tall = (width) => Math.min(460, Math.max(180, wide(width) * sizes[1] / sizes[0]));
  const build = (width) => {
    const pixels = [wide(width), tall(width)], scale = Math.min(pixels[0] / sizes[0], pixels[1] / sizes[1]);
    const made = (k, name) => { const middle = (ends[k][0] + ends[k][1]) / 2, half = pixels[k] / scale / 2, [min, max] = [middle - half, middle + half];
      const customValues = name ? niceTicks(min, max, pixels[k] < 300 ? 4 : 6) : [];
      return {min, max, axisLine: {show: name !== '', lineStyle: {color: colours.line}}, splitLine: {show: false}, axisTick: {show: name !== '', customValues, lineStyle: {color: colours.line}},
        axisLabel: {show: name !== '', color: colours.ink, hideOverlap: true, formatter: tick, customValues}}; };
    return {grid: {left: 48, top: 64, width: pixels[0], height: pixels[1]}, legend: {...legendOf(series.slice(0, 3), {left: 0, right: 0})},
      xAxis: axis(across, made(0, across)), yAxis: uprightAxis(up, made(1, up)), series};
  };
  const caption = `The path in the part, ${words}, the tip's errors magnified ${tick(magnified)} times.`;
  return figure({caption, description: `${caption} Before up to ${um(largest(tips.before_um))}, after up to ${um(largest(tips.after_um))}.`, size: 'path', renderer: tips.line.length > 2000 ? 'canvas' : 'svg', build, height: (width) => tall(width) + 116});
}

const pathViews = (tips) => element('div', {class: 'pair'}, Object.values(views).reverse().map((view) => pathView(tips, view, magnifiedBy(tips))));

/** What each error alone does to the tip on this program. */
function errorBars(byError) {
  const shown = byError.filter(({tip}) => tip.value > 0).slice(0, 12);
  if (!shown.length) return null;
  const build = (width) => ({
    grid: grid({top: 18, right: 56}),
    xAxis: axis('tip moved by at most, in µm', {min: 0, splitNumber: width < 480 ? 4 : 8}),
    yAxis: axis('', {type: 'category', inverse: true, data: shown.map(({name}) => name), axisTick: {show: false}, splitLine: {show: false},
      axisLabel: {color: colours.ink, interval: 0, formatter: (name) => `${titleOf(name)} (${name})`, ...(width < 480 ? {width: 116, overflow: 'break', fontSize: 10, lineHeight: 12} : {})}}),
    series: [{name: 'alone', type: 'bar', barWidth: '62%', emphasis: {disabled: true}, itemStyle: {color: colours.series[0]},
      label: {show: true, position: 'right', color: colours.ink, formatter: ({value}) => significant(value, 3)}, data: shown.map(({tip}) => 1000 * tip.value)}],
  });
  return figure({caption: 'What each error does to the tip on this program when it is the only one, the largest of it; they add as vectors, and partly cancel.',
    description: `Largest errors by name: ${shown.slice(0, 6).map(({name, tip}) => `${titleOf(name)} (${name}) ${um(1000 * tip.value)}`).join(', ')}.`,
    size: 'bars', renderer: 'svg', build, height: (width) => 70 + (width < 480 ? 30 : 24) * shown.length});
}
