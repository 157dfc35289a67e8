// GLSL of the four shapes. Positions are in view space: the camera is at the origin and looks along -z.

const precision = 'precision highp float;\nprecision highp int;\n';

// Colours are sRGB and stay so: what a legend shows is what is lit.
const colours = `
uniform int colourMode;  // 0: plain, 1: numbers, 2: categories
uniform vec3 plainColour;
uniform sampler2D table;
uniform vec2 range;
vec3 colourOf(float value) {
  if (colourMode == 0) return plainColour;
  float size = float(textureSize(table, 0).x);
  if (colourMode == 2) return texelFetch(table, ivec2(int(mod(value + 0.5, size)), 0), 0).rgb;
  float t = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) : 0.5;
  return texture(table, vec2((t * (size - 1.0) + 0.5) / size, 0.5)).rgb;
}
`;

const camera = `
uniform bool orthographic;
uniform vec4 clipPlane;  // what has dot(clipPlane.xyz, p) + clipPlane.w > 0 is cut away
uniform bool clipping;
bool clipped(vec3 p) { return clipping && dot(clipPlane.xyz, p) + clipPlane.w > 0.0; }
`;

// One light beside the camera, a weak one from the other side, and surfaces that face away from the camera a
// little darker, which tells balls apart that overlap.
const light = `
vec3 lit(vec3 colour, vec3 normal, vec3 towardsEye) {
  float key = max(dot(normal, normalize(vec3(0.35, 0.6, 0.75))), 0.0);
  float fill = max(dot(normal, normalize(vec3(-0.7, -0.3, 0.45))), 0.0);
  float facing = max(dot(normal, towardsEye), 0.0);
  float shine = pow(max(dot(normal, normalize(normalize(vec3(0.35, 0.6, 0.75)) + towardsEye)), 0.0), 48.0);
  vec3 shaded = colour * (0.40 + 0.56 * key + 0.12 * fill) * mix(0.72, 1.0, smoothstep(0.0, 0.6, facing));
  return min(shaded + 0.10 * shine, vec3(1.0));
}
`;

// Balls are ray-cast: a square that covers the ball in the picture, and in it the exact sphere and its depth. What
// a clipping plane cuts open is closed by a disk. Where disks overlap, that of the ball with the smallest power
// distance is in front: the section of the union is its power diagram.
export const ballVertex = `${precision}
in vec2 corner;  // of the square
in vec3 position;
in float radius;
in float value;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 viewport;
uniform bool orthographic;
${colours}
flat out vec3 c;
flat out float r;
flat out vec3 colour;
void main() {
  c = (modelViewMatrix * vec4(position, 1.0)).xyz;
  r = radius;
  colour = colourOf(value);
  float pixel = 3.0 / (projectionMatrix[1][1] * viewport.y);  // one and a half pixels, at distance 1
  if (orthographic) {
    gl_Position = projectionMatrix * vec4(c + vec3(corner * (r + pixel), r), 1.0);
    return;
  }
  if (c.z - r > 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // behind the camera
    return;
  }
  float d = length(c), front = d - r;
  vec3 axis = c / d;
  vec3 right = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 up = cross(right, axis);
  float size = front * (r / sqrt((d - r) * (d + r)) + pixel);
  if (front <= 0.0 || axis.z * front + size * (abs(right.z) + abs(up.z)) > -1e-3 * front) {
    gl_Position = vec4(corner, -1.0, 1.0);  // the camera is inside, or nearly: the whole picture
    return;
  }
  gl_Position = projectionMatrix * vec4(axis * front + size * (corner.x * right + corner.y * up), 1.0);
  gl_Position.z = max(gl_Position.z, -gl_Position.w);  // the ball may begin before the near plane
}
`;

export const ballFragment = `${precision}
flat in vec3 c;
flat in float r;
flat in vec3 colour;
uniform mat4 projectionMatrix;
uniform vec2 viewport;
uniform float near, opacity, sceneRadius;
uniform bool smoothEdges;
${camera}${light}
out vec4 fragment;
void main() {
  vec2 place = gl_FragCoord.xy / viewport * 2.0 - 1.0;
  vec2 slope = place / vec2(projectionMatrix[0][0], projectionMatrix[1][1]);
  vec3 eye = orthographic ? vec3(slope, 0.0) : vec3(0.0);
  vec3 ray = orthographic ? vec3(0.0, 0.0, -1.0) : normalize(vec3(slope, -1.0));
  vec3 toCentre = c - eye;
  float middle = dot(toCentre, ray);
  float aside = length(toCentre - middle * ray);
  float edge = fwidth(aside);
  if (aside > r) discard;
  float half_ = sqrt((r - aside) * (r + aside));
  float enter = middle - half_, leave = middle + half_;
  bool hidden = !orthographic && enter < near;
  vec3 p = eye + enter * ray, normal;
  float bias = 0.0;
  if (hidden || clipped(p)) {
    float towards = dot(clipPlane.xyz, ray);
    if (!clipping || towards >= 0.0) discard;
    float cut = -(clipPlane.w + dot(clipPlane.xyz, eye)) / towards;
    if (cut < enter || cut > leave || (!orthographic && cut < near)) discard;
    p = eye + cut * ray;
    normal = clipPlane.xyz;
    float depth = sqrt(max(r * r - dot(p - c, p - c), 0.0));
    bias = 5e-4 * min(depth / sceneRadius, 1.0);
    fragment = vec4(mix(colour, vec3(1.0), 0.12) * 0.9, opacity);
  } else {
    normal = (p - c) / r;
    fragment = vec4(lit(colour, normal, -ray), opacity);
    if (smoothEdges) fragment.a = clamp((r - aside) / edge, 0.0, 1.0);
  }
  vec2 zw = vec2(projectionMatrix[2][2] * p.z + projectionMatrix[3][2], orthographic ? 1.0 : -p.z);
  gl_FragDepth = 0.5 * zw.x / zw.y + 0.5 - bias;
}
`;

export const pointVertex = `${precision}
in vec3 position;
in float value;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float pointSize;
${colours}
flat out vec3 colour;
out vec3 p;
void main() {
  p = (modelViewMatrix * vec4(position, 1.0)).xyz;
  colour = colourOf(value);
  gl_Position = projectionMatrix * vec4(p, 1.0);
  gl_PointSize = pointSize;
}
`;

export const pointFragment = `${precision}
flat in vec3 colour;
in vec3 p;
uniform float opacity;
uniform bool smoothEdges;
${camera}${light}
out vec4 fragment;
void main() {
  vec2 at = vec2(2.0, -2.0) * (gl_PointCoord - 0.5);
  float aside = length(at);
  float edge = fwidth(aside);
  if (aside > 1.0 || clipped(p)) discard;
  vec3 normal = vec3(at, sqrt(max(1.0 - dot(at, at), 0.0)));
  fragment = vec4(lit(colour, normal, vec3(0.0, 0.0, 1.0)), opacity);
  if (smoothEdges) fragment.a = clamp((1.0 - aside) / edge, 0.0, 1.0);
}
`;

// WebGL draws lines one pixel wide; these are rectangles that face the camera.
export const segmentVertex = `${precision}
in vec3 position;  // x: 0 at the start, 1 at the end; y: side
in vec3 start, end;
in float startValue, endValue;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 viewport;
uniform float near, lineWidth;
uniform bool orthographic;
${colours}
out vec3 p;
out vec3 colour;
void main() {
  vec3 a = (modelViewMatrix * vec4(start, 1.0)).xyz, b = (modelViewMatrix * vec4(end, 1.0)).xyz;
  if (!orthographic) {
    // The part before the camera; what is behind it has no place in the picture.
    float limit = -1.01 * near;
    if (a.z > limit && b.z > limit) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      return;
    }
    if (a.z > limit) a = mix(b, a, (limit - b.z) / (a.z - b.z));
    if (b.z > limit) b = mix(a, b, (limit - a.z) / (b.z - a.z));
  }
  vec4 from = projectionMatrix * vec4(a, 1.0), to = projectionMatrix * vec4(b, 1.0);
  vec2 along = (to.xy / to.w - from.xy / from.w) * viewport;
  along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);
  vec4 here = position.x < 0.5 ? from : to;
  p = position.x < 0.5 ? a : b;
  colour = colourOf(position.x < 0.5 ? startValue : endValue);
  here.xy += position.y * lineWidth * vec2(-along.y, along.x) / viewport * here.w;
  gl_Position = here;
}
`;

export const segmentFragment = `${precision}
in vec3 p;
in vec3 colour;
uniform float opacity;
${camera}
out vec4 fragment;
void main() {
  if (clipped(p)) discard;
  fragment = vec4(colour, opacity);
}
`;

// Flat shading from the derivatives of the position: it needs no normals and suits sheets that are no manifolds.
export const triangleVertex = `${precision}
in vec3 position;
in float value;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 p;
out float smoothValue;
flat out float flatValue;
void main() {
  p = (modelViewMatrix * vec4(position, 1.0)).xyz;
  smoothValue = flatValue = value;
  gl_Position = projectionMatrix * vec4(p, 1.0);
}
`;

export const triangleFragment = `${precision}
in vec3 p;
in float smoothValue;
flat in float flatValue;
uniform float opacity;
uniform bool unlit;
${camera}${colours}${light}
out vec4 fragment;
void main() {
  vec3 normal = cross(dFdx(p), dFdy(p));
  if (clipped(p)) discard;
  vec3 colour = colourOf(colourMode == 2 ? flatValue : smoothValue);
  vec3 towardsEye = orthographic ? vec3(0.0, 0.0, 1.0) : -normalize(p);
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : towardsEye;
  if (dot(normal, towardsEye) < 0.0) normal = -normal;
  fragment = vec4(unlit ? colour * 0.55 : lit(colour, normal, towardsEye), opacity);
}
`;
