// SPDX-License-Identifier: Apache-2.0
// Form: what is left about the associated surface, centred, as polar plots; the roundness of one section.

/** A polar plot about a circle: `marks` or `line` of {c_deg, um}, `curve` of what was found. */
function centredPolar({measured, found, words, description, asLine = false, size = 'polar', legendWords = 'measured − model', least = 0}) {
  const kept = (part) => part.c_deg.map((c, i) => [part.um[i], c]).filter(([um]) => isNumber(um));
  const data = kept(measured), foundData = found ? kept(found) : [];
  const most = largest([...data, ...foundData].map(([um]) => um));
  const step = roundUp(Math.max(most, least) / 3);
  const out = step * Math.max(1, Math.ceil(Math.max(most, least) * 1.02 / step)), base = asLine ? 1.5 * out : 2 * out;
  const ring = Array.from({length: 121}, (_, i) => [0, i * 3]);
  const line = (name, values, more) => ({name, type: 'line', coordinateSystem: 'polar', symbol: 'none', emphasis: {disabled: true}, data: values, ...more});
  // Around the whole turn, but not across a stretch without readings.
  const closed = (values) => {
    if (!values.length) return values;
    const widest = Math.max(15, 4 * 360 / values.length);
    return [...values, [values[0][0], values[0][1] + 360]].flatMap((at, i) => i && at[1] - values[i - 1][1] > widest ? [['-', '-'], at] : [at]);
  };
  const series = [line('circle', ring, {lineStyle: {type: 'dashed', color: colours.grey, width: 1}, itemStyle: {color: colours.grey}})];
  if (foundData.length) series.push(line('found', closed(foundData), {z: 5, lineStyle: {color: colours.model, width: 1.8}, itemStyle: {color: colours.model}}));
  series.push(asLine ? line(legendWords, closed(data), {z: 4, lineStyle: {color: colours.measured, width: 1.2}, itemStyle: {color: colours.measured}})
    : {name: legendWords, type: 'scatter', coordinateSystem: 'polar', symbolSize: data.length > 120 ? 3 : 5, z: 4, itemStyle: {color: colours.measured}, emphasis: {disabled: true}, data});
  const build = (width) => ({
    legend: legendOf(series.slice(1), {left: 'center', right: 'auto', ...(width < 300 ? {itemWidth: 12, itemGap: 6, textStyle: {color: colours.ink, fontSize: 10}} : {})}),
    polar: {radius: width < 300 ? '66%' : '76%', center: ['50%', width < 300 ? '57%' : '54%']},
    angleAxis: {type: 'value', min: 0, max: 360, interval: width < 300 ? 90 : 45, startAngle: 0, clockwise: false,
      axisLabel: {color: colours.grey, formatter: (v) => v === 360 ? '' : `${v}°`}, axisLine: {lineStyle: {color: colours.line}}, axisTick: {show: false}, splitLine: {lineStyle: {color: colours.grid}}},
    radiusAxis: {min: step * -Math.floor(base / step), max: out, interval: step, axisLine: {show: false}, axisTick: {show: false}, axisLabel: {show: false}, splitLine: {lineStyle: {color: colours.grid}}},
    series,
  });
  return figure({caption: `${words} ${tick(step)} µm a ring.`, description: `${description} Up to ${micrometres(most / 1000)} from the circle.`, size, renderer: 'svg', build});
}

/** The residual at each section of a surface. */
function residualPolars(readings) {
  const parts = readings.sections.filter((part) => part.residual?.um.length);
  const place = (part) => `${readings.face ? 'X' : 'Z'} = ${millimetres(part.position_mm, 2)}`;
  const least = largest(parts.flatMap((part) => [...part.residual.um, ...part.found?.um ?? []]));  // one scale for all
  return parts.map((part) => centredPolar({measured: part.residual, found: part.found, least,
    words: `At ${place(part)}, ${part.residual.averaged ? `${part.readings} readings as means per degree` : `${part.readings} readings`}:`,
    description: `Polar plot of the residuals of the ideal fit at ${place(part)}${part.found ? ', with what was found' : ''}.`}));
}

/** The trace of one section about its least-squares circle, and its harmonics. */
function roundnessBlock(reference) {
  const {roundness: r} = reference;
  const um = (value) => micrometres(value / 1000);
  const trace = `${r.readings} readings of ${tick(Number(r.turns.toPrecision(3)))} ${r.turns === 1 ? 'turn' : 'turns'}${r.averaged ? ', means of half a degree' : ''}`;
  const list = [['Roundness, peak to valley (RONt, not filtered)', um(r.peak_um + r.valley_um)], ['Peak, valley', `${um(r.peak_um)}, ${um(r.valley_um)}`],
    ['RMS (RONq)', um(r.rms_um)]];
  if (r.orders.length) list.push([`Peak to valley of 2 to ${r.order_max} undulations a turn`, um(r.of_orders_um)], [`Left beside these, RMS`, um(r.left_um)]);
  const polar = centredPolar({measured: r, asLine: r.turns < 1.05 || r.averaged, size: 'polar', legendWords: 'trace', words: `The trace about its least-squares circle (dashed): ${trace}, eccentricity taken out; outside is away from the axis.`,
    description: `Roundness trace about its least-squares circle: ${um(r.peak_um + r.valley_um)} peak to valley.`});
  const charts = r.orders.length ? [polar, harmonicBars(r)] : [polar];
  return [facts(list), element('div', {class: 'pair'}, charts),
    r.orders.length ? null : paragraph('The trace has gaps, or too few readings: its undulations cannot be told apart.', 'quiet')];
}

function harmonicBars({orders, order_max: limit, u_amplitude_um: u}) {
  const highest = [...orders].sort((a, b) => b.amplitude_um - a.amplitude_um).slice(0, 3).map((o) => `${o.order} (${micrometres(o.amplitude_um / 1000)})`).join(', ');
  const caption = `Amplitude of each number of undulations a turn, 2 to ${limit}. Noise alone would make bars of about ${micrometres(u / 1000 * 1.25)}.`;
  const build = (width) => ({grid: grid(), xAxis: axis('undulations per revolution', {type: 'category', data: orders.map((o) => String(o.order)), splitLine: {show: false},
    axisLabel: {color: colours.ink, interval: (i) => limit < 16 || orders[i].order % (width < 480 ? 10 : 5) === 0 || orders[i].order === 2}}),
    yAxis: uprightAxis('amplitude in µm', {min: 0}),
    series: [{name: 'amplitude', type: 'bar', barWidth: '70%', emphasis: {disabled: true}, itemStyle: {color: colours.series[0]}, data: orders.map((o) => o.amplitude_um)}]});
  return figure({caption, description: `Harmonics of the trace. The largest: ${highest}.`, size: 'map', renderer: 'svg', build});
}

function roundnessTable({orders}) {
  const rows = [...orders].sort((a, b) => b.amplitude_um - a.amplitude_um).slice(0, 15);
  return table(`The ${rows.length} largest harmonics, A cos(nC − φ)`, ['Undulations', 'A', '2 A', 'φ'],
    rows.map((o) => [String(o.order), micrometres(o.amplitude_um / 1000), micrometres(2 * o.amplitude_um / 1000), `${fixed(o.phase_deg, 0)}${nbsp}°`]));
}
