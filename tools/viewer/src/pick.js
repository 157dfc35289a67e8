// What lies under the pointer, by exact intersection with everything that is visible.

function hitBall(origin, direction, centre, radius) {
  const [x, y, z] = centre.map((c, i) => c - origin[i]);
  const middle = x * direction[0] + y * direction[1] + z * direction[2];
  const aside = x * x + y * y + z * z - middle * middle;
  if (aside > radius * radius) return Infinity;
  return middle - Math.sqrt(radius * radius - aside);
}

const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Moeller and Trumbore. */
function hitTriangle(origin, direction, a, b, c) {
  const ab = subtract(b, a);
  const ac = subtract(c, a);
  const p = cross(direction, ac);
  const determinant = dot(ab, p);
  if (determinant === 0) return Infinity;
  const ao = subtract(origin, a);
  const u = dot(ao, p) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const q = cross(ao, ab);
  const v = dot(direction, q) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  return dot(ac, q) / determinant;
}

/**
 * The nearest ball or triangle along a ray that is not cut away.
 * drawings: [{ layer, arrays }]; origin and direction relative to `centre`; kept(point) in model units.
 * Returns { drawing, index, vertex, point } or null; `vertex` is the corner of a triangle nearest to the point.
 */
export function pick(drawings, origin, direction, centre, kept) {
  let best = null;
  let nearest = Infinity;
  const consider = (drawing, index, t) => {
    if (!(t > 0 && t < nearest)) return;
    const point = origin.map((x, i) => x + t * direction[i] + centre[i]);
    if (!kept(point)) return;
    nearest = t;
    best = { drawing, index, point };
  };
  for (const drawing of drawings) {
    const { layer, arrays } = drawing;
    const own = origin.map((x, i) => x + centre[i] - layer.centre[i]);
    const at = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
    if (layer.shape === 'balls') {
      for (let i = 0; i < layer.count; ++i) {
        consider(drawing, i, hitBall(own, direction, at(arrays.vertices, i), arrays.radii[i]));
      }
    } else if (layer.shape === 'triangles') {
      for (let i = 0; i < layer.count; ++i) {
        const [a, b, c] = at(arrays.triangles, i).map((vertex) => at(arrays.vertices, vertex));
        consider(drawing, i, hitTriangle(own, direction, a, b, c));
      }
    }
  }
  if (!best) return null;
  best.vertex = best.index;
  const { layer, arrays } = best.drawing;
  if (layer.shape === 'triangles') {
    const distance = (vertex) => {
      const p = subtract(subtract(best.point, layer.centre), [0, 1, 2].map((i) => arrays.vertices[3 * vertex + i]));
      return dot(p, p);
    };
    const corners = [0, 1, 2].map((k) => arrays.triangles[3 * best.index + k]);
    best.vertex = corners.reduce((a, b) => (distance(b) < distance(a) ? b : a));
  }
  return best;
}
