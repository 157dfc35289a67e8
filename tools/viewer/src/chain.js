// Frames that hang on each other by joints, and what moves with them. No DOM, no 3D.
// A pose is a rotation by rows and a translation: 12 numbers.

const still = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];

export const moved = (p, [x, y, z]) => [0, 1, 2].map((i) => p[3 * i] * x + p[3 * i + 1] * y + p[3 * i + 2] * z + p[9 + i]);

/** b, then a. */
function composed(a, b) {
  const rotation = [0, 1, 2].flatMap((i) => [0, 1, 2].map((k) => a[3 * i] * b[k] + a[3 * i + 1] * b[3 + k] + a[3 * i + 2] * b[6 + k]));
  return [...rotation, ...moved(a, b.slice(9))];
}

function inverse(p) {
  const rotation = [0, 1, 2].flatMap((i) => [0, 1, 2].map((k) => p[3 * k + i]));
  return [...rotation, ...moved([...rotation, 0, 0, 0], p.slice(9)).map((x) => -x)];
}

function turned([x, y, z], angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const d = 1 - c;
  return [c + d * x * x, d * x * y - s * z, d * x * z + s * y, d * y * x + s * z, c + d * y * y, d * y * z - s * x,
    d * z * x - s * y, d * z * y + s * x, c + d * z * z, 0, 0, 0];
}

function motion({ motion: kind, axis }, value) {
  if (kind === 'turn') return turned(axis, value);
  if (kind === 'slide') return [...still.slice(0, 9), ...axis.map((x) => value * x)];
  return still;
}

/** The values of the joints that a chain has at first. */
export const firstValues = ({ joints }) => joints.map(({ value }) => value);

/** Poses of all frames in the model. Frames come after their parents. */
export function poses({ frames }, values) {
  const all = [];
  for (const frame of frames) {
    const value = frame.offset + (frame.joint < 0 ? 0 : frame.factor * values[frame.joint]);
    const own = composed(frame.origin, motion(frame, value));
    all.push(frame.parent < 0 ? own : composed(all[frame.parent], own));
  }
  return all;
}

/** Logarithms of the factors by which radii have grown at each frame. */
function logGrowths({ frames }, values) {
  const all = [];
  for (const { parent, joint, growth = 0 } of frames)
    all.push((joint < 0 ? 0 : growth * values[joint]) + (parent < 0 ? 0 : all[parent]));
  return all;
}

/** By how much radii have grown at each frame since the joints had their first values; null where no frame grows. */
export function growths(chain, values) {
  if (!chain.frames.some(({ growth }) => growth)) return null;
  const before = logGrowths(chain, firstValues(chain));
  return logGrowths(chain, values).map((log, i) => Math.exp(log - before[i]));
}

/** How each frame has moved since the joints had their first values; null where none has. */
export function motions(chain, values) {
  const first = firstValues(chain);
  if (values.every((value, i) => value === first[i])) return null;
  const before = poses(chain, first);
  return poses(chain, values).map((pose, i) => composed(pose, inverse(before[i])));
}

/**
 * The vertices of a layer after its frames have moved, relative to the same centre, and the radii of its balls; and the
 * box around them, in model units. grown: of growths().
 */
export function place({ vertices, frames, radii }, centre, all, grown = null) {
  const result = new Float32Array(vertices.length);
  const after = radii && grown ? Float32Array.from(radii, (radius, i) => radius * grown[frames[i]]) : radii;
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < frames.length; ++i) {
    const p = all[frames[i]];
    const x = vertices[3 * i] + centre[0];
    const y = vertices[3 * i + 1] + centre[1];
    const z = vertices[3 * i + 2] + centre[2];
    const radius = after ? after[i] : 0;
    for (let k = 0; k < 3; ++k) {
      const value = p[3 * k] * x + p[3 * k + 1] * y + p[3 * k + 2] * z + p[9 + k];
      result[3 * i + k] = value - centre[k];
      lower[k] = Math.min(lower[k], value - radius);
      upper[k] = Math.max(upper[k], value + radius);
    }
  }
  return { vertices: result, radii: after, lower, upper };
}
