// What the address of the page remembers after its "#": camera, variant, node, joints that were moved.
// A copied address shows the same.

const numbers = (list) => list.map((x) => Number(x.toPrecision(7))).join(',');

/** { camera: { position, target, up, half }, variant, node, joints: Map of a chain to values } -> "camera=...&variant=1" */
export function written({ camera, variant, node, joints }) {
  const parts = [];
  if (camera) {
    const { position, target, up, half } = camera;
    parts.push(`camera=${numbers(position)},${numbers(target)},${up}${half ? `,${numbers([half])}` : ''}`);
  }
  if (variant) parts.push(`variant=${variant}`);
  if (node) parts.push(`node=${encodeURIComponent(node)}`);
  for (const [chain, values] of joints ?? []) parts.push(`joints=${numbers([chain, ...values])}`);
  return parts.join('&');
}

/** The reverse; what cannot be understood is left out. */
export function read(text) {
  const result = {};
  for (const part of text.replace(/^#/, '').split('&')) {
    const [name, value = ''] = part.split('=');
    if (name === 'camera') {
      const words = value.split(',');
      const values = [...words.slice(0, 6), words[7] ?? '1'].map(Number);
      const known = words.length >= 7 && words.length <= 8 && ['y', 'z'].includes(words[6]) && values.every(Number.isFinite);
      const apart = values.slice(0, 3).some((x, i) => x !== values[3 + i]);
      if (known && apart && values[6] > 0) {
        result.camera = { position: values.slice(0, 3), target: values.slice(3, 6), up: words[6], half: words[7] === undefined ? null : values[6] };
      }
    }
    if (name === 'variant' && /^\d+$/.test(value)) result.variant = Number(value);
    if (name === 'joints') {
      const [chain, ...values] = value.split(',').map((word) => (word === '' ? NaN : Number(word)));
      if (Number.isInteger(chain) && chain >= 0 && values.length > 0 && values.every(Number.isFinite)) {
        (result.joints ??= new Map()).set(chain, values);
      }
    }
    if (name === 'node') {
      try {
        result.node = decodeURIComponent(value);
      } catch {
        // not an address of ours
      }
    }
  }
  return result;
}
