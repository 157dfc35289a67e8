#include "report/spheres_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "report/plot.hpp"
#include "report/spheres_words.hpp"

namespace ballflow::report {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A share near 1 is never rounded to it.
std::string part(double share) {
  if (std::isnan(share)) return "-";
  if (share >= 1) return "100 %";
  return share > 0.9995 ? "over 99.9 %" : percent(share);
}

/// How much of the link's volume is in spheres: all of it where they enclose the link, and where none of them
/// stands out as much as they have.
double volume_inside(const LinkCheck& link) {
  if (!has_volume(link)) return unknown;
  if (link.enclosure.encloses()) return link.solid_volume;
  return link.enclosure.protrusion == 0 ? link.volume : unknown;
}

std::vector<std::string> row(const std::string& name, const std::vector<LinkCheck>& links) {
  const auto sum = [&](const auto& of) {
    return std::accumulate(links.begin(), links.end(), 0.0,
                           [&](double all, const LinkCheck& link) { return all + of(link); });
  };
  std::int64_t balls = 0;
  double protrusion = 0;
  for (const LinkCheck& link : links) {
    balls += link.enclosure.balls;
    protrusion = std::max(protrusion, link.enclosure.protrusion);
  }
  const double area = sum([](const LinkCheck& link) { return link.enclosure.area; });
  const double open = sum([](const LinkCheck& link) { return link.enclosure.open_area; });
  const double solid =
      sum([](const LinkCheck& link) { return has_volume(link) ? link.solid_volume : unknown; });
  const double spheres = sum([](const LinkCheck& link) { return link.ball_volume; }) / solid;
  const bool covered =
      std::all_of(links.begin(), links.end(), [](const LinkCheck& link) { return link.enclosure.covers(); });
  // A few triangles may be open by less than is looked at.
  const double surface = covered ? 1 : area > 0 ? std::min(1 - open / area, 0.99999) : unknown;
  return {name,
          std::to_string(balls),
          part(surface),
          part(sum(volume_inside) / solid),
          length(protrusion),
          std::isnan(spheres) ? "-" : with_format("%.3g", spheres)};
}

/// What a curve shows of the spheres that were made.
double loss_of(const SpheresCheck& check, const LinkCheck& link) {
  if (check.mode == "protrude") return open_share(link);
  if (!has_volume(link)) return unknown;
  return check.mode == "inside" ? 1 - link.volume / link.solid_volume : link.volume / link.solid_volume - 1;
}

}  // namespace

std::vector<std::vector<std::string>> measures(const SpheresCheck& check) {
  std::vector<std::vector<std::string>> rows = {
      {"link", "spheres", "surface inside", "volume inside", "protrusion", "sum of spheres / link"}};
  for (const LinkCheck& link : check.links) rows.push_back(row(link.link, {link}));
  if (check.links.size() > 1) rows.push_back(row("all links", check.links));
  return rows;
}

std::string curves(const SpheresCheck& check) {
  Plot plot;
  plot.x_name = "spheres";
  plot.y_name = check.mode == "protrude" ? "surface in no sphere, %"
                : check.mode == "inside" ? "volume in no sphere, % of the link's"
                                         : "volume outside, % of the link's";
  plot.title = "How many spheres do how well";
  bool several = false;
  for (const LinkCurve& curve : check.curves) {
    struct Point {
      double balls = 0, loss = 0;
      std::string label;
    };
    std::vector<Point> points;
    for (const auto& [balls, loss] : curve.points) points.push_back({balls, loss, "tried quickly"});
    for (const LinkCheck& link : check.links) {
      if (link.link != curve.link) continue;
      const auto balls = static_cast<double>(link.enclosure.balls);
      std::erase_if(points, [balls](const Point& p) { return p.balls == balls; });
      points.push_back({balls, loss_of(check, link), "made"});
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const Point& a, const Point& b) { return a.balls < b.balls; });
    Series series;
    series.name = curve.link;
    for (const Point& point : points) {
      series.x.push_back(point.balls);
      series.y.push_back(100 * point.loss);
      series.labels.push_back(point.label);
    }
    several = several || points.size() > 1;
    plot.series.push_back(std::move(series));
  }
  return several ? svg(plot) : "";
}

}  // namespace ballflow::report
