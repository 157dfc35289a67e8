// Numbers and values for people.

/** 35676 -> "35 676" (with a thin space) */
export function grouped(count) {
  return String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, '\u2009');
}

/** At most `digits` significant digits, without trailing zeros. */
export function rounded(value, digits = 4) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e');
  return String(Number(value.toPrecision(digits)));
}

/** Numbers of one scale with as many digits as it takes to tell them apart. */
export function ticks(values) {
  for (let digits = 3; digits < 9; ++digits) {
    const texts = values.map((value) => rounded(value, digits));
    if (new Set(texts).size === new Set(values).size) return texts;
  }
  return values.map(String);
}

/** 0.0123 -> "12.3 ms", 1.239 -> "1.24 s", 125 -> "2 min 05 s" */
export function duration(seconds) {
  if (seconds < 0.9995) return `${rounded(1000 * seconds, seconds < 0.01 ? 2 : 3)}\u2009ms`;
  if (seconds < 59.95) return `${rounded(seconds, 3)}\u2009s`;
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)}\u2009min ${String(whole % 60).padStart(2, '0')}\u2009s`;
}

export function bytes(count) {
  if (count < 1000) return `${count}\u2009B`;
  const [size, unit] = count < 1e6 ? [count / 1e3, 'kB'] : count < 1e9 ? [count / 1e6, 'MB'] : [count / 1e9, 'GB'];
  return `${rounded(size, 3)}\u2009${unit}`;
}

/** A JSON value: texts without quotes, numbers with at most six digits. */
export function plain(value) {
  if (typeof value === 'string') return value;
  if (typeof value === 'number') return Number.isInteger(value) ? String(value) : rounded(value, 6);
  return JSON.stringify(value);
}

const singular = { points: 'point', balls: 'ball', segments: 'segment', triangles: 'triangle' };

/** (1, "balls") -> "1 ball" */
export function counted(count, shape) {
  return `${grouped(count)} ${count === 1 ? singular[shape] : shape}`;
}
