// SPDX-License-Identifier: Apache-2.0
// Numbers as text: the uncertainty decides the decimals (two digits of u), minus is a minus sign, and
// every number carries its unit behind a no-break space.

const nbsp = '\u00a0';

/** No line ends between a number and its unit or within an equation. */
const joined = (text) => worded(text).replace(/(\d) (?=(?:µm|mm|nm|%|°|rpm|min|Hz|s)(?!\p{L}))/gu, `$1${nbsp}`)
  .replace(/(?<!\p{L})(\p{L}) = (?=[\d−])/gu, `$1${nbsp}=${nbsp}`);

/** A text in which an effect goes by its id, with the effect's name in words: each page has its own. */
let worded = (text) => text;

/** A clause that begins with a word in small letters, with a capital; a name stays as it is. */
const capital = (text) => /^\p{Ll}+ /u.test(text) ? `${text[0].toUpperCase()}${text.slice(1)}` : text;

/** A clause as a sentence. */
const sentence = (text) => !text ? '' : /^\S+\.\S/.test(text) ? `${text}.` : `${text[0].toUpperCase()}${text.slice(1)}${/[.!?…]$/.test(text) ? '' : '.'}`;

const isNumber = (x) => typeof x === 'number' && Number.isFinite(x);

function fixed(value, decimals) {
  const text = value.toFixed(Math.min(Math.max(decimals, 0), 12));
  const zero = Number(text) === 0;
  return zero ? text.replace('-', '') : text.replace('-', '\u2212');
}

/** Decimals that show two significant digits of `u`. */
function decimalsFor(u) {
  if (!isNumber(u) || u <= 0) return null;
  return Math.min(Math.max(1 - Math.floor(Math.log10(u)), 0), 10);
}

/** `digits` significant digits, never in powers of ten between 1e-3 and 1e6. */
function significant(value, digits = 3) {
  if (value === 0) return '0';
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent < -3 || exponent > 5) return scientific(value, digits - 1);
  return fixed(value, digits - 1 - exponent);
}

const superscript = (n) => [...String(n)].map((c) => c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]).join('');

function scientific(value, decimals) {
  if (value === 0) return '0';
  let exponent = Math.floor(Math.log10(Math.abs(value)));
  if (Math.abs(Number((value / 10 ** exponent).toFixed(decimals))) >= 10) exponent += 1;
  return `${fixed(value / 10 ** exponent, decimals)}${nbsp}×${nbsp}10${superscript(exponent)}`;
}

/** A small length: µm with the decimals of its uncertainty, else three significant digits. */
function micrometres(mm, u_mm) {
  if (!isNumber(mm)) return 'not determined';
  const decimals = decimalsFor(u_mm * 1000);
  const um = mm * 1000;
  const text = decimals !== null ? fixed(um, decimals) : Math.abs(um) >= 0.001 ? significant(um) : Math.abs(um) < 1e-6 ? '0' : '< 0.001';
  return `${text}${nbsp}µm`;
}

/** "≤ 24 µm" of a bound of 23.35 µm: two digits, upwards. */
function atMost(mm) {
  if (!isNumber(mm)) return 'not determined';
  const um = mm * 1000, decimals = decimalsFor(um) ?? 3;
  return `≤ ${fixed(Math.ceil(um * 10 ** decimals * (1 - 1e-9)) / 10 ** decimals, decimals)}${nbsp}µm`;
}

const millimetres = (mm, decimals = 3) => isNumber(mm) ? `${fixed(mm, decimals)}${nbsp}mm` : 'not determined';

/** µm below 1 mm, mm from there. */
function length(mm, u_mm) {
  if (!isNumber(mm)) return 'not determined';
  if (Math.abs(mm) < 1) return micrometres(mm, u_mm);
  return millimetres(mm, decimalsFor(u_mm) ?? 4);
}

function degrees(deg, u_deg, least = 1e-4) {
  if (!isNumber(deg)) return 'not determined';
  if (deg !== 0 && Math.abs(deg) < least) return `${scientific(deg, 1)}${nbsp}°`;
  return `${fixed(deg, decimalsFor(u_deg) ?? 4)}${nbsp}°`;
}

/** A tilt as an angle and as what it makes over a length. */
const tilt = (deg, u_deg) => isNumber(deg)
  ? `${degrees(deg, u_deg)} (${significant(Math.tan(deg * Math.PI / 180) * 1000, 3)}${nbsp}µm/mm)`
  : 'not determined';

function ratio(value, u) {
  if (!isNumber(value)) return 'not determined';
  if (value !== 0 && Math.abs(value) < 0.01) {
    const exponent = Math.floor(Math.log10(Math.abs(value)));
    const decimals = decimalsFor(u / 10 ** exponent) ?? 3;
    return scientific(value, Math.min(decimals, 9));
  }
  return fixed(value, decimalsFor(u) ?? 5);
}

/** A value in a unit of the contract (mm, deg, 1, …), shown in the unit that suits its size. */
function quantity(value, u, unit) {
  if (unit === 'mm') return length(value, u);
  if (unit === 'deg') return degrees(value, u);
  if (unit === '1' || unit === '') return ratio(value, u);
  return isNumber(value) ? `${fixed(value, decimalsFor(u) ?? 4)}${nbsp}${unit}` : 'not determined';
}

/** An uncertainty alone: two significant digits. */
function uncertainty(u, unit) {
  if (!isNumber(u)) return '–';
  if (unit === 'mm') return u < 1 ? `${significant(u * 1000, 2)}${nbsp}µm` : `${significant(u, 2)}${nbsp}mm`;
  if (unit === 'deg') return `${u < 1e-6 ? significant(u, 2) : fixed(u, decimalsFor(u) ?? 2)}${nbsp}°`;
  return significant(u, 2) + (unit === '1' || unit === '' ? '' : nbsp + unit);
}

const percent = (share) => isNumber(share) ? `${significant(share * 100, 3)}${nbsp}%` : 'not determined';
