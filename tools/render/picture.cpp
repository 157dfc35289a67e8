#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballflow::render {

namespace {

constexpr int supersampling = 2;

struct Pixel {
  double depth = -std::numeric_limits<double>::infinity();  // towards the viewer
  Vector normal{0, 0, 1};
  Vector color{1, 1, 1};
};

struct Canvas {
  int width, height;
  std::vector<Pixel> pixels;

  Canvas(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  Pixel* at(int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height) return nullptr;
    return &pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)];
  }
};

// From violet (0) over blue and green to yellow (1): light grows with the value, also without colours.
Vector color_of(double value) {
  static const Vector stops[] = {
      {0.50, 0.33, 0.72}, {0.33, 0.47, 0.84}, {0.22, 0.70, 0.74}, {0.56, 0.85, 0.45}, {1.00, 0.88, 0.30}};
  const double place = std::clamp(value, 0.0, 1.0) * 4;
  const auto i = std::min<std::size_t>(3, static_cast<std::size_t>(place));
  return stops[i] + (place - static_cast<double>(i)) * (stops[i + 1] - stops[i]);
}

void draw(Canvas& canvas, int x, int y, double depth, Vector normal, Vector color) {
  Pixel* pixel = canvas.at(x, y);
  if (pixel == nullptr || depth <= pixel->depth) return;
  *pixel = {depth, normal[2] < 0 ? -1.0 * normal : normal, color};
}

void draw_ball(Canvas& canvas, Vector c, double r, Vector color) {
  for (int y = static_cast<int>(std::floor(c[1] - r)); y <= c[1] + r; ++y) {
    for (int x = static_cast<int>(std::floor(c[0] - r)); x <= c[0] + r; ++x) {
      const double dx = x + 0.5 - c[0], dy = y + 0.5 - c[1];
      const double zz = r * r - dx * dx - dy * dy;
      if (zz < 0) continue;
      const double z = std::sqrt(zz);
      draw(canvas, x, y, c[2] + z, {dx / r, dy / r, z / r}, color);
    }
  }
}

struct Corner {
  Vector position, normal, color;
};

void draw_triangle(Canvas& canvas, const Corner& a, const Corner& b, const Corner& c) {
  const Vector &p = a.position, &q = b.position, &r = c.position;
  const double area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  if (area == 0) return;
  const auto [left, right] = std::minmax({p[0], q[0], r[0]});
  const auto [low, high] = std::minmax({p[1], q[1], r[1]});
  for (int y = static_cast<int>(std::floor(low)); y <= high; ++y) {
    for (int x = static_cast<int>(std::floor(left)); x <= right; ++x) {
      const double u = x + 0.5, v = y + 0.5;
      const double wa = ((q[0] - u) * (r[1] - v) - (q[1] - v) * (r[0] - u)) / area;
      const double wb = ((r[0] - u) * (p[1] - v) - (r[1] - v) * (p[0] - u)) / area;
      const double wc = 1 - wa - wb;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      draw(canvas, x, y, wa * p[2] + wb * q[2] + wc * r[2],
           normalised(wa * a.normal + wb * b.normal + wc * c.normal),
           wa * a.color + wb * b.color + wc * c.color);
    }
  }
}

void draw_segment(Canvas& canvas, Vector a, Vector b, double r, Vector from_color, Vector to_color) {
  const Vector d = b - a;
  const int steps = std::max(1, static_cast<int>(std::sqrt(dot(d, d)) / r));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    draw_ball(canvas, a + t * d, r, from_color + t * (to_color - from_color));
  }
}

// `model` is in pixels already.
void draw_model(Canvas& canvas, const Model& model, double largest_radius) {
  const Vector plain{0.66, 0.70, 0.76};
  std::vector<Vector> colors(model.vertices.size(), plain);
  for (std::size_t i = 0; i < model.radii.size(); ++i)
    colors[i] = color_of(std::sqrt(model.radii[i] / largest_radius));

  if (!model.has_surface()) {
    const double bead = 0.0035 * canvas.height;
    for (std::size_t i = 0; i < model.vertices.size(); ++i) {
      draw_ball(canvas, model.vertices[i], model.radii.empty() ? bead : model.radii[i], colors[i]);
    }
    return;
  }
  const bool smooth = model.radii.empty();
  std::vector<Vector> normals(model.vertices.size(), {0, 0, 0});
  const auto normal_of = [&model](const std::vector<std::uint32_t>& polygon) {
    Vector sum{0, 0, 0};  // twice the vector area
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Vector origin = model.vertices[polygon[0]];
      sum = sum + cross(model.vertices[polygon[k - 1]] - origin, model.vertices[polygon[k]] - origin);
    }
    return sum;
  };
  for (const auto& polygon : model.polygons) {
    for (const std::uint32_t v : polygon) normals[v] = normals[v] + normal_of(polygon);
  }
  for (const auto& polygon : model.polygons) {
    const Vector flat = normalised(normal_of(polygon));
    const auto corner = [&](std::size_t k) {
      const std::uint32_t v = polygon[k];
      return Corner{model.vertices[v], smooth ? normalised(normals[v]) : flat, colors[v]};
    };
    for (std::size_t k = 2; k < polygon.size(); ++k)
      draw_triangle(canvas, corner(0), corner(k - 1), corner(k));
  }
  for (const auto& [a, b] : model.edges) {
    draw_segment(canvas, model.vertices[a], model.vertices[b], 0.002 * canvas.height, colors[a], colors[b]);
  }
}

// How much of the surroundings stands in front of the tangent plane of a pixel, from 0 (nothing) to 1.
double occlusion(Canvas& canvas, int x, int y, double radius) {
  constexpr int samples = 40;
  const Pixel& here = *canvas.at(x, y);
  const double nz = std::max(0.25, here.normal[2]);
  double sum = 0;
  double cosine = 1, sine = 0;
  for (int i = 0; i < samples; ++i) {
    // A spiral that turns by the golden angle, so that the samples cover the disc evenly.
    const double c = -0.7373688780783197, s = 0.6754902942615238;
    const double turned = cosine * c - sine * s;
    sine = cosine * s + sine * c;
    cosine = turned;
    const double distance = radius * std::sqrt((i + 0.5) / samples);
    const double dx = distance * cosine, dy = distance * sine;
    const Pixel* there =
        canvas.at(x + static_cast<int>(std::lround(dx)), y + static_cast<int>(std::lround(dy)));
    if (there == nullptr || std::isinf(there->depth)) continue;
    const double plane = here.depth - (here.normal[0] * dx + here.normal[1] * dy) / nz;
    const double above = there->depth - plane - 0.03 * radius;
    if (above > 0)
      sum += 1 / (1 + above * above / (4 * radius * radius));  // what is far in front shades less
  }
  return sum / samples;
}

// The outline: a jump in depth to a neighbour that is not explained by the slope.
bool on_outline(Canvas& canvas, int x, int y, double jump) {
  const double depth = canvas.at(x, y)->depth;
  for (const auto& [dx, dy] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const Pixel* there = canvas.at(x + dx, y + dy);
    if (there != nullptr && there->depth < depth - jump) return true;
  }
  return false;
}

Vector shaded(Canvas& canvas, int x, int y) {
  const Pixel& pixel = *canvas.at(x, y);
  if (std::isinf(pixel.depth)) return {1, 1, 1};
  static const Vector key = normalised({-0.5, -0.7, 0.9}), fill = normalised({0.9, 0.1, 0.5});
  static const Vector half = normalised(key + Vector{0, 0, 1});
  const double diffuse =
      0.62 * std::max(0.0, dot(pixel.normal, key)) + 0.20 * std::max(0.0, dot(pixel.normal, fill));
  double gloss = std::max(0.0, dot(pixel.normal, half));
  for (int i = 0; i < 5; ++i) gloss *= gloss;  // to the power of 32
  const double open = 1 - std::min(0.7, 1.1 * occlusion(canvas, x, y, 0.035 * canvas.height));
  const double line = on_outline(canvas, x, y, 0.02 * canvas.height) ? 0.65 : 1;
  const Vector light =
      line * open * (0.48 + diffuse) * pixel.color + 0.12 * line * open * gloss * Vector{1, 1, 1};
  return {std::min(1.0, light[0]), std::min(1.0, light[1]), std::min(1.0, light[2])};
}

// Averages in linear light, so that edges do not look thin.
Image reduced(Canvas& canvas) {
  Image image{canvas.width / supersampling, canvas.height / supersampling, {}};
  image.rgb.reserve(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      Vector sum{0, 0, 0};
      for (int j = 0; j < supersampling; ++j) {
        for (int i = 0; i < supersampling; ++i) {
          const Vector c = shaded(canvas, supersampling * x + i, supersampling * y + j);
          sum = sum + Vector{c[0] * c[0], c[1] * c[1], c[2] * c[2]};
        }
      }
      for (const double channel : sum) {
        const double mean = std::sqrt(channel / (supersampling * supersampling));
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * mean)));
      }
    }
  }
  return image;
}

}  // namespace

Image picture(const std::vector<Model>& models, const PictureOptions& options) {
  const Vector towards = normalised(options.from);
  const Vector right = normalised(cross(options.up, towards));
  const Vector up = cross(towards, right);

  // Into the frame of the viewer, x to the right, y down.
  std::vector<Model> views = models;
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300}, largest_radius = 1e-300;
  for (Model& view : views) {
    for (std::size_t i = 0; i < view.vertices.size(); ++i) {
      Vector& v = view.vertices[i];
      v = {dot(v, right), -dot(v, up), dot(v, towards)};
      const double r = view.radii.empty() || view.has_surface() ? 0 : view.radii[i];
      for (const std::size_t axis : {0U, 1U}) {
        low[axis] = std::min(low[axis], v[axis] - r);
        high[axis] = std::max(high[axis], v[axis] + r);
      }
      if (!view.radii.empty()) largest_radius = std::max(largest_radius, view.radii[i]);
    }
  }
  const int height = supersampling * options.height;
  const double margin = 0.04 * height;
  const double extent = std::max(high[1] - low[1], 1e-300);
  // A very wide model is scaled down, so that a panel is at most twice as wide as high.
  const double scale =
      std::min((height - 2 * margin) / extent, 2 * height / std::max(high[0] - low[0], 1e-300));
  const int panel =
      supersampling * static_cast<int>((scale * (high[0] - low[0]) + 2 * margin) / supersampling);
  Canvas canvas(panel * static_cast<int>(views.size()), height);
  for (std::size_t k = 0; k < views.size(); ++k) {
    const double center[2] = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
    const double middle = panel * (static_cast<double>(k) + 0.5);
    for (Vector& v : views[k].vertices) {
      v = {middle + scale * (v[0] - center[0]), 0.5 * height + scale * (v[1] - center[1]), scale * v[2]};
    }
    for (double& r : views[k].radii) r *= scale;
    draw_model(canvas, views[k], scale * largest_radius);
  }
  return reduced(canvas);
}

}  // namespace ballflow::render
