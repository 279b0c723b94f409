// SPDX-License-Identifier: Apache-2.0
// Where the axes are: the seats along Z with their axes magnified, and both ends in µm with the ellipses of U.

/** The axes that are drawn, each with its style; the target axis is the broad one behind. */
function axisLines(target, references) {
  const lines = target.references.filter((r) => r.axis && !r.face)
    .map((r, i) => ({name: references[r.index].name, index: r.index, axis: r.axis, width: 2, mark: 8, opacity: 1, ...styleOf(i < 2 ? i : i + 1)}));
  if (target.axis) lines.push({name: 'target axis', index: -1, axis: target.axis, width: 6, mark: 13, opacity: 0.5, colour: colours.series[2], dash: 'solid', symbol: 'circle'});
  return lines;
}

/** x of an axis at Z by its ends, in mm: the part of it along `towards` (rad). */
function offsetAlong({start, end}, towards, z) {
  const share = end.z_mm === start.z_mm ? 0 : (z - start.z_mm) / (end.z_mm - start.z_mm);
  const at = (key) => start[key] + share * (end[key] - start[key]);
  return at('x_mm') * Math.cos(towards) + at('y_mm') * Math.sin(towards);
}

/** A seat's outline as polygons of [Z, radius], upper and lower side, about a centre that runs `off(z)` to the side. */
function outline({face, bore, z_mm: z, radius_mm: r}, off, {thickness, wall}) {
  if (face) return [1, -1].map((side) => [[z[0], side * r[0]], [z[0], side * r[1]], [z[0] + thickness, side * r[1]], [z[0] + thickness, side * r[0]]]);
  const near = (k) => Math.max(0, r[k] + (bore ? wall : -wall));  // where the material is
  return [1, -1].map((side) => [[z[0], off(z[0]) + side * r[0]], [z[1], off(z[1]) + side * r[1]], [z[1], off(z[1]) + side * near(1)], [z[0], off(z[0]) + side * near(0)]]);
}

const polygons = (name, list, {colour, opacity = 0.35, dash = 'solid'}) => ({
  name, type: 'custom', itemStyle: {color: colour}, lineStyle: {type: dash}, silent: true, clip: false, data: list.map((points) => points.flat()), encode: {x: 0, y: 1},
  renderItem: (params, api) => ({type: 'polygon', shape: {points: list[params.dataIndex].map((point) => api.coord(point))},
    style: {fill: colour, fillOpacity: opacity, stroke: colour, lineWidth: 1.4, lineDash: dash === 'solid' ? null : dash === 'dashed' ? [6, 4] : [2, 3]}}),
});

/** The seats drawn along Z; the offsets of their axes are magnified until they are seen. */
function seatsChart({seats: {seats, cut}, target, references}) {
  const lines = axisLines(target, references);
  const drawn = seats.map((seat) => ({seat, line: lines.find((l) => l.index === seat.index), name: references[seat.index].name}));
  if (!drawn.length) return null;
  const solid = [...seats, ...(cut ? [cut] : [])];
  const radius = largest(solid.flatMap((s) => s.radius_mm)) || 1;
  const spanned = solid.flatMap((s) => s.z_mm), low = Math.min(...spanned), high = Math.max(...spanned);
  const ends = lines.flatMap(({axis: a}) => [a.start, a.end]);
  const farthest = ends.reduce((most, end) => !most || offsetOf(end) > offsetOf(most) ? end : most, null);
  const towards = farthest ? Math.atan2(farthest.y_mm, farthest.x_mm) : 0;
  const magnified = farthest && offsetOf(farthest) > 0 ? Number((roundUp(0.12 * radius / offsetOf(farthest))).toPrecision(3)) : 1;
  const span = Math.max(high - low, 1e-3), size = {thickness: 0.012 * span, wall: 0.2 * radius};
  const series = drawn.map(({seat, line, name}, i) => {
    const style = line ?? {...styleOf(i < 2 ? i : i + 1)};
    return polygons(name, outline(seat, line ? (z) => magnified * offsetAlong(line.axis, towards, z) : () => 0, size), {...style, opacity: 0.35});
  });
  if (cut) series.push(polygons('what is cut', outline(cut, target.axis ? (z) => magnified * offsetAlong(target.axis, towards, z) : () => 0, size),
    {colour: colours.series[2], opacity: 0.15, dash: 'dashed'}));
  lines.forEach(({name, axis: a, index, width, colour, dash, opacity}) => {
    const from = seats.find((s) => s.index === index)?.z_mm ?? cut?.z_mm ?? [low, high];
    series.push({name: index < 0 ? 'target axis' : name, type: 'line', symbol: 'none', silent: true, emphasis: {disabled: true}, z: 4, lineStyle: {width: Math.min(width, 4), color: colour, type: dash, opacity},
      itemStyle: {color: colour}, data: from.map((z) => [z, magnified * offsetAlong(a, towards, z)])});
  });
  const margin = 0.04 * span, reach = roundUpFinely(Math.max(1.2 * radius, solid.some((s) => s.bore) ? 1.1 * radius + size.wall : 0));
  series.push({name: 'spindle axis', type: 'line', symbol: 'none', silent: true, emphasis: {disabled: true}, z: 3, itemStyle: {color: colours.ink},
    lineStyle: {width: 1.2, color: colours.ink, type: [12, 4, 2, 4]}, data: [[low - margin, 0], [high + margin, 0]]});
  const names = series.filter((s, i) => series.findIndex((other) => other.name === s.name) === i);
  const c = ((towards * 180 / Math.PI) + 360) % 360;
  const caption = `The seats along Z, cut open in the plane of the largest offset (C = ${fixed(c, 0)}°). Offsets of the axes are magnified ${tick(magnified)} times, radii are not.` +
    (seats.some((s) => references[s.index].relative) ? ' A gauge shows no radius: the nominal one is drawn.' : '');
  const build = (width) => ({
    ...roomFor(names, width),
    xAxis: axis('Z in mm', spanning([low - margin, high + margin])),
    yAxis: uprightAxis('radius in mm', {...aboutZero(reach), axisLabel: {color: colours.ink, hideOverlap: true, formatter: (v) => tick(Math.abs(v))}}),
    series,
  });
  return figure({caption, description: `${caption} ${lines.map(({name, axis: a}) => `${name}: ${micrometres(offsetOf(a.start))} off at Z = ${millimetres(a.start.z_mm, 2)}, ${micrometres(offsetOf(a.end))} at ${millimetres(a.end.z_mm, 2)}`).join('; ')}.`,
    size: 'map', renderer: 'svg', build, height: (width) => 240 + legendAbove(names, width).height});
}

/** Points of the ellipse of U about the end of an axis, µm. */
function ellipseOf({x_mm: x, y_mm: y, ellipse: {u_long_mm: long, u_short_mm: short, towards_deg: towards}}, k) {
  const [c, s] = [Math.cos(towards * Math.PI / 180), Math.sin(towards * Math.PI / 180)];
  return Array.from({length: 73}, (_, i) => {
    const a = k * long * Math.cos(i * Math.PI / 36), b = k * short * Math.sin(i * Math.PI / 36);
    return [1000 * (x + a * c - b * s), 1000 * (y + a * s + b * c)];
  });
}

/** One end of the length in µm: where the axes are, each with its ellipse. */
function endChart(lines, key, k, place) {
  const series = lines.flatMap(({name, axis: a, colour, dash, symbol}) => {
    const end = a[key], at = {name, type: 'scatter', symbol, symbolSize: 8, z: 4, emphasis: {disabled: true}, itemStyle: {color: colour}, data: [[1000 * end.x_mm, 1000 * end.y_mm]]};
    const ring = isNumber(end.ellipse?.u_long_mm) ? [{name, type: 'line', symbol: 'none', emphasis: {disabled: true}, lineStyle: {width: 1.6, color: colour, type: dash},
      itemStyle: {color: colour}, areaStyle: {color: colour, opacity: 0.1}, data: ellipseOf(end, k)}] : [];
    return [...ring.map((r) => ({...r, areaStyle: undefined})), at];
  });
  const points = series.flatMap((s) => s.data);
  const middle = [0, 1].map((i) => { const v = points.map((p) => p[i]); return (Math.min(...v) + Math.max(...v)) / 2; });
  const half = Math.max(...points.map((p) => Math.max(Math.abs(p[0] - middle[0]), Math.abs(p[1] - middle[1]))), 1e-3) * 1.15;
  const step = roundUp(half / 2.2);
  const ends = (i) => ({min: tidy(step * Math.floor((middle[i] - half) / step)), interval: step});
  const [x, y] = [ends(0), ends(1)];
  const count = Math.max(...[x, y].map(({min}, i) => Math.ceil((middle[i] + half - min) / step - 1e-9)));
  [x, y].forEach((e) => { e.max = tidy(e.min + count * step); });
  const marks = series.filter((s) => s.type === 'scatter');
  const off = lines.map(({name, axis: a}) => `${name} ${micrometres(offsetOf(a[key]), k * a[key].u_mm)} towards ${direction(a[key], k)}`);
  const caption = `${place ? `At Z = ${place}` : 'The axis'}, in µm from the spindle axis, seen along −Z. An ellipse is U (k = ${tick(k)}): its shadow on any direction is ± U there.`;
  const side = (width) => Math.min(width - 90, 320);  // of the plot, which is square: the scales are the same
  const build = (width) => {
    const above = legendAbove(marks, width);
    return {legend: above.legend, grid: {left: 60, top: 30 + above.height, width: side(width), height: side(width)}, xAxis: axis('x in µm', x), yAxis: uprightAxis('y in µm', y), series};
  };
  return figure({caption, description: `${caption} Offsets: ${off.join('; ')}.`, size: 'inset', renderer: 'svg', build, height: (width) => side(width) + 84 + legendAbove(marks, width).height});
}

/** x or y of each axis along Z: the slope is the tilt. */
function alongChart(lines, letter) {
  const series = lines.map(({name, axis: a, width, opacity, colour, dash}) => ({name, type: 'line', symbol: 'none', emphasis: {disabled: true},
    lineStyle: {width, opacity, color: colour, type: dash}, itemStyle: {color: colour}, data: [a.start, a.end].map((end) => [end.z_mm, end[`${letter}_mm`] * 1000])}));
  const build = (width) => ({...roomFor(series, width), xAxis: axis('Z in mm', spanning(lines.flatMap(({axis: a}) => [a.start.z_mm, a.end.z_mm]))),
    yAxis: uprightAxis(`${letter} in µm`, {scale: true}), series});
  return figure({caption: `${letter} of the axes along Z. A level line runs true to the spindle; its slope is the tilt.`,
    description: `${letter} of the axes along Z: ${lines.map(({name, axis: a}) => `${name} from ${micrometres(a.start[`${letter}_mm`])} to ${micrometres(a.end[`${letter}_mm`])}`).join('; ')}.`,
    renderer: 'svg', build, height: (width) => 250 + legendAbove(series, width).height});
}
