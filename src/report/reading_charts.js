// SPDX-License-Identifier: Apache-2.0
// Charts of one reference: maps, polar sections, residuals, histogram.

const pairs = (x, y, keep) => keep.map((i) => [x[i], y[i]]);

/** Indices of kept and of excluded readings. */
function split(points) {
  const rejected = new Set(points.rejected);
  const all = points.c_deg.map((_, i) => i);
  return {kept: all.filter((i) => !rejected.has(i)), rejected: points.rejected};
}

const rejectedSeries = (data) => ({
  name: 'rejected', type: 'scatter', symbol: 'triangle', symbolSize: 9, data, z: 5,
  itemStyle: {color: 'transparent', borderColor: colours.rejected, borderWidth: 1.6},
});

const positionName = (readings) => readings.face ? 'X in mm' : 'Z in mm';

/** What a mark of an unrolled map is. */
function mapNote(readings) {
  if (readings.thinned && !readings.cells) return '';
  return readings.thinned
    ? `${readings.count} readings as means of ${readings.cells.columns} × ${readings.cells.rows} cells; cells without a reading are blank, rejected readings are left out.`
    : `Each mark is one of ${readings.count} readings${readings.points.rejected.length ? '; triangles are excluded readings' : ''}.`;
}

/** Unrolled map of `key` (deviation_um or residual_um): cells for long streams, else every reading. */
function readingMap(readings, key, words, sameLimit = null, note = ` ${mapNote(readings)}`) {
  const values = readings.thinned ? readings.cells[key] : readings.points[key];
  const shown = readings.thinned ? values : split(readings.points).kept.map((i) => values[i]);
  const limit = sameLimit ?? roundUpFinely(largest(shown));
  const build = (width) => readings.thinned
    ? cellMap(readings.cells, values, {limit, positionName: positionName(readings), width})
    : pointMap(readings, values, {limit, width});
  return figure({caption: words + note, description: `${words} Values up to ${micrometres(largest(shown) / 1000)} from zero.`, size: 'map', build});
}

function pointMap(readings, values, {limit, width}) {
  const {points, per_turn: perTurn} = readings;
  const {kept, rejected} = split(points);
  // Each mark is as large as the share of the map that its reading stands for.
  const within = (px) => Math.min(16, Math.max(3, px));
  const mark = [within((width - 70) / perTurn), within(250 * perTurn / values.length)];
  const series = [{
    type: 'scatter', symbol: 'rect', symbolSize: mark, progressive: 0, progressiveThreshold: oneCanvas, emphasis: {disabled: true},
    data: kept.map((i) => [points.c_deg[i], points.position_mm[i], values[i]]),
  }];
  if (rejected.length) series.push(rejectedSeries(pairs(points.c_deg, points.position_mm, rejected)));
  return {
    grid: grid({bottom: 66}),
    xAxis: angleAxis(width),
    yAxis: uprightAxis(positionName(readings), spanning(points.position_mm)),
    visualMap: colourScale(limit, width),
    series,
  };
}

/** Residuals against one quantity: points, or the band between least and greatest of each bin. */
function residualChart(readings, {x, envelope, name, words}) {
  const thinned = readings.thinned;
  const band = thinned ? readings.envelopes[envelope] : null;
  const data = thinned ? null : split(readings.points);
  const shown = thinned ? band.min.concat(band.max) : data.kept.map((i) => readings.points.residual_um[i]);
  const limit = roundUpFinely(largest(shown) * 1.05);
  const far = thinned ? 0 : data.rejected.filter((i) => Math.abs(readings.points.residual_um[i]) > limit).length;
  const long = thinned
    ? ` ${readings.count} readings in ${band.mean.length} bins: the band spans least to greatest of each bin, the line is the mean; rejected readings are left out.` : '';
  const edge = far ? ` ${far} rejected ${far === 1 ? 'reading lies' : 'readings lie'} outside and ${far === 1 ? 'is' : 'are'} drawn at the edge.` : '';
  const inside = (v) => Math.max(-limit, Math.min(limit, v));
  const build = (width) => ({
    grid: grid(),
    xAxis: thinned ? bandAxis(band, name, envelope === 'c' ? (width < 480 ? 4 : 8) : 6) : envelope === 'c' ? angleAxis(width) : axis(name, spanning(x)),
    yAxis: uprightAxis('measured − model in µm', aboutZero(limit)),
    series: thinned ? bandSeries(band) : [
      {name: 'residual', type: 'scatter', symbolSize: readings.count > 4000 ? 2 : 4, progressive: 0, progressiveThreshold: oneCanvas, emphasis: {disabled: true},
        itemStyle: {color: colours.measured, opacity: 0.65}, data: pairs(x, readings.points.residual_um, data.kept)},
      ...(data.rejected.length ? [rejectedSeries(data.rejected.map((i) => [x[i], inside(readings.points.residual_um[i])]))] : []),
    ],
  });
  return figure({caption: words + long + edge, description: `${words} Up to ${micrometres(largest(shown) / 1000)} from zero.`, build});
}

/** Stacking needs a category axis: the bins of the band, labelled with round numbers. */
function bandAxis({low, high, mean}, name, about) {
  const ticks = high - low === 360 ? Array.from({length: about + 1}, (_, i) => i * 360 / about) : niceTicks(low, high, about);
  return binAxis(axis, name, {low, high, count: mean.length, ticks});
}

function bandSeries({min, max, mean}) {
  const line = {type: 'line', symbol: 'none', emphasis: {disabled: true}};
  const gaps = (values) => values.map((v) => isNumber(v) ? v : '-');
  return [
    {...line, name: 'least', stack: 'band', stackStrategy: 'all', lineStyle: {opacity: 0}, data: gaps(min)},
    {...line, name: 'least to greatest', stack: 'band', stackStrategy: 'all', lineStyle: {opacity: 0},
      areaStyle: {color: colours.measured, opacity: 0.3}, data: gaps(max.map((most, i) => isNumber(most) ? most - min[i] : null))},
    {...line, name: 'mean', lineStyle: {color: colours.measured, width: 1.5}, data: gaps(mean)},
  ];
}

function residualCharts(readings) {
  const points = readings.points ?? {c_deg: []};
  const time = readings.has_time;
  const numbers = points.c_deg.map((_, i) => i + 1);
  const list = [residualChart(readings, {x: points.c_deg, envelope: 'c', name: 'spindle angle C in °',
    words: 'Residuals against the spindle angle. A wave here is form (roundness) or spindle error motion that the surface does not contain.'})];
  if (readings.has_position) {
    list.push(residualChart(readings, {x: points.position_mm, envelope: 'position', name: positionName(readings),
      words: `Residuals against ${readings.face ? 'X' : 'Z'}. A bow or a wave here is straightness or waviness along the feed.`}));
  }
  list.push(residualChart(readings, {x: time ? points.time_s : numbers, envelope: 'time', name: time ? 'time in s' : 'reading number',
    words: `Residuals against ${time ? 'time' : 'the reading number (the stream has no time)'}. A trend here is drift, a step is a slip or a bump.`}));
  return list;
}

/** Polar section: deviations outside or inside the circle of the true-running surface, magnified. */
function polarChart(readings, part, relative) {
  const model = part.model ? part.model.um : [];
  const largestUm = Math.max(largest(part.measured.um), largest(model));
  const step = roundUp(largestUm / 2);
  const out = step * Math.ceil(largestUm * 1.05 / step);
  const base = 2 * out;
  const magnification = part.nominal_mm > 0 && !readings.face && !relative ? part.nominal_mm * 1000 / base : null;
  const place = !readings.has_position ? 'the section' : `${readings.face ? 'X' : 'Z'} = ${millimetres(part.position_mm, 2)}`;
  const near = readings.has_position ? `readings within ±${millimetres(part.half_width_mm, 2)}` : `${part.readings} readings`;
  const caption = `At ${place}, ${near}${part.measured.averaged ? `, ${part.readings} readings as means per degree` : ''}. ` +
    `Dashed: ${readings.has_model ? (readings.face ? 'a face square to the spindle axis' : relative ? 'true running' : 'true running, radius ' + millimetres(part.nominal_mm, 3)) : 'mean of the readings'}; ` +
    `${tick(step)} µm a ring${magnification ? `; deviations magnified ${significant(magnification, 2)} times` : ''}.`;
  const curve = model.map((um, i) => [um, i * part.model.step_deg]);
  const zero = Array.from({length: 121}, (_, i) => [0, i * 3]);
  const series = [{name: readings.has_model ? 'true running' : 'mean', type: 'line', coordinateSystem: 'polar', symbol: 'none', data: zero,
    lineStyle: {type: 'dashed', color: colours.grey, width: 1}, emphasis: {disabled: true}}];
  if (model.length) {
    series.push({name: 'model', type: 'line', coordinateSystem: 'polar', symbol: 'none', data: curve, z: part.measured.um.length > 120 ? 5 : 3,
      lineStyle: {color: colours.model, width: part.measured.um.length > 120 ? 1.2 : 1.8}, itemStyle: {color: colours.model}, emphasis: {disabled: true}});
  }
  series.push({name: 'measured', type: 'scatter', coordinateSystem: 'polar', symbolSize: part.measured.um.length > 120 ? 3 : 5, z: 4,
    itemStyle: {color: colours.measured}, data: part.measured.c_deg.map((c, i) => [part.measured.um[i], c]), emphasis: {disabled: true}});
  const build = (width) => ({
    legend: legendOf(series, {left: 'center', right: 'auto', ...(width < 300 ? {itemWidth: 12, itemGap: 6, textStyle: {fontSize: 10}} : {})}),
    polar: {radius: width < 300 ? '64%' : '74%', center: ['50%', width < 300 ? '57%' : '54%']},
    angleAxis: {type: 'value', min: 0, max: 360, interval: width < 300 ? 90 : 45, startAngle: 0, clockwise: false,
      axisLabel: {color: colours.grey, formatter: (v) => v === 360 ? '' : `${v}°`},
      axisLine: {lineStyle: {color: colours.line}}, axisTick: {show: false}, splitLine: {lineStyle: {color: colours.grid}}},
    radiusAxis: {min: -base, max: out, interval: step, axisLine: {show: false}, axisTick: {show: false},
      axisLabel: {show: false}, splitLine: {lineStyle: {color: colours.grid}}},
    series,
  });
  return figure({caption, description: `Polar section at ${place}: measured${model.length ? ' and model' : ''}, up to ${micrometres(largestUm / 1000)} from the dashed circle.`, size: 'polar', renderer: 'svg', build});
}

/** Histogram of the residuals with the normal curve of sigma. */
function histogramChart(histogram, sigma_mm, sigmaSource) {
  const {center, count, width: bin} = histogram;
  const total = count.reduce((sum, n) => sum + n, 0);
  const sigma = sigma_mm * 1000;
  const low = center[0] - bin, high = center[center.length - 1] + bin;
  const normal = Array.from({length: 121}, (_, i) => {
    const x = low + (high - low) * i / 120;
    return [x, total * bin * Math.exp(-0.5 * (x / sigma) ** 2) / (sigma * Math.sqrt(2 * Math.PI))];
  });
  const hasSigma = isNumber(sigma) && sigma > 0;
  const caption = `Histogram of ${total} residuals in bins of ${significant(bin, 2)} µm` +
    (hasSigma ? ` with the normal distribution of σ = ${significant(sigma, 3)} µm (from ${sigmaSource || 'the fit'}). ` : '. ') +
    'Heavier tails than the curve, or two humps, mean more than noise.';
  const series = [{name: 'residuals', type: 'bar', data: center.map((x, i) => [x, count[i]]), barWidth: '96%',
    itemStyle: {color: colours.measured, opacity: 0.7}, emphasis: {disabled: true}}];
  if (hasSigma) {
    series.push({name: 'normal', type: 'line', symbol: 'none', data: normal, lineStyle: {color: colours.model, width: 2},
      itemStyle: {color: colours.model}, emphasis: {disabled: true}});
  }
  const build = () => ({
    grid: grid(),
    legend: legendOf(series),
    xAxis: axis('measured − model in µm', {min: tidy(low), max: tidy(high), axisLabel: {showMinLabel: false, showMaxLabel: false, color: colours.ink, formatter: tick}}),
    yAxis: uprightAxis('readings'),
    series,
  });
  return figure({caption, description: `Histogram of ${total} residuals${hasSigma ? ` and the normal curve of σ = ${significant(sigma, 3)} µm` : ''}.`, renderer: 'svg', build});
}

const tidy = (value) => Number(value.toPrecision(6));
