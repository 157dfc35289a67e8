#include "report/spheres_page.hpp"

#include <algorithm>
#include <set>

#include "report/html.hpp"
#include "report/spheres_measures.hpp"
#include "report/spheres_words.hpp"
#include "report/style.hpp"

namespace ballflow::report {
namespace {

using geometry::Enclosure;

/// How much of the balls is outside of the link, by volumes; only where all of the link is inside.
std::string outside(const LinkCheck& link) {
  if (link.solid_volume <= 0 || link.volume < link.solid_volume || !link.enclosure.encloses()) return "-";
  return percent(link.volume / link.solid_volume - 1);
}

std::string place(geometry::Vec3 p) {
  return "(" + with_format("%.5g", p.x) + ", " + with_format("%.5g", p.y) + ", " + with_format("%.5g", p.z) +
         ")";
}

struct Totals {
  std::size_t enclosed = 0;
  std::int64_t balls = 0;
  double area = 0, open_area = 0, gap = 0, protrusion = 0;
  double volume = 0, solid_volume = 0;  // the latter 0 where one of the links has none
};

Totals totals(const SpheresCheck& check) {
  Totals all;
  bool known = true;
  for (const LinkCheck& link : check.links) {
    all.enclosed += link.enclosure.encloses() ? 1 : 0;
    all.balls += link.enclosure.balls;
    all.area += link.enclosure.area;
    all.open_area += link.enclosure.open_area;
    all.gap = std::max(all.gap, link.enclosure.gap);
    all.protrusion = std::max(all.protrusion, link.enclosure.protrusion);
    all.volume += link.volume;
    all.solid_volume += link.solid_volume;
    known = known && link.solid_volume > 0 && link.volume >= link.solid_volume;
  }
  if (!known) all.solid_volume = 0;
  return all;
}

std::string verdict_of(const LinkCheck& link, bool enclosing) {
  if (link.enclosure.balls == 0) return "no spheres";
  if (!enclosing) return link.enclosure.protrusion == 0 ? "nothing stands out" : "stand out: bounded";
  if (link.enclosure.encloses()) return "enclosed: proven";
  if (link.enclosure.covers()) return "void inside";
  return "not enclosed";
}

const std::vector<std::string>& explanations() {
  static const std::vector<std::string> lines = {
      "A link is enclosed when its spheres contain every triangle of it and leave no void inside; then they "
      "contain "
      "everything that the surface separates from infinity. Both are decided exactly, by bisecting triangles "
      "until each "
      "part is in one sphere, and by the dual complex of the spheres; nothing is sampled.",
      "Surface outside: about which part of the surface is in no sphere, by pieces of half a percent of the "
      "box. "
      "Farthest: the farthest of the looked-at points of the surface from the spheres; the true distance is "
      "a little "
      "more.",
      "Protrusion: no point of the spheres is farther than that from the link (a bound). Volume outside: how "
      "much the "
      "spheres have beyond the volume of the link, where it is enclosed and its surface is closed; where "
      "parts "
      "of a link overlap, that counts once.",
      "Surface and volume inside: how much of surface and volume of the link is in its spheres, which others "
      "call coverage; all of it only where that is proven. Sum of spheres: their volumes, added up where "
      "they "
      "overlap, over the volume of the link.",
  };
  return lines;
}

std::vector<std::string> sources(const SpheresCheck& check) {
  std::vector<std::string> lines;
  const auto file = [&](const char* what, const std::string& name, const std::string& digest) {
    lines.push_back(std::string(what) + ": " + name + (digest.empty() ? "" : " (SHA-256 " + digest + ")"));
  };
  file(check.geometry.empty() ? "Link" : "Robot", check.robot, check.robot_digest);
  file("Spheres", check.spheres, check.spheres_digest);
  if (!check.geometry.empty()) lines.push_back("Shapes: " + check.geometry);
  if (check.buffer != 0) lines.push_back("Added to every radius: " + length(check.buffer));
  lines.push_back("Checked by: ballflow " + check.version);
  return lines;
}

/// Where a link is open, at most `most` places.
std::vector<std::string> places(const LinkCheck& link, std::size_t most) {
  std::vector<std::string> lines;
  const Enclosure& e = link.enclosure;
  std::set<std::string> told;  // triangles share their corners
  for (std::size_t i = 0; i < e.open_points.size() && told.size() < most; ++i) {
    const std::string where = place(e.open_points[i]);
    if (told.insert(where).second)
      lines.push_back("triangle " + std::to_string(e.open_triangles[i]) + " at " + where);
  }
  for (std::size_t i = 0; i < e.void_points.size() && i < most; ++i) {
    if (e.void_places[i] != static_cast<std::uint8_t>(geometry::VoidPlace::outside))
      lines.push_back("a void around " + place(e.void_points[i]));
  }
  return lines;
}

constexpr std::size_t most_places = 5;

std::string title(const SpheresCheck& check) {
  const std::string what = check.geometry.empty() ? "link" : "robot";
  return check.enclosing ? "Do the spheres contain the " + what + "?" : "Spheres for the " + what;
}

std::string counted_places(const LinkCheck& link) {
  const std::size_t open = link.enclosure.open_triangles.size();
  return std::to_string(open) + " of " + std::to_string(link.enclosure.triangles) +
         " triangles are not covered" + (open > most_places ? "; some of them:" : ":");
}

std::string cell(std::string value) {
  for (std::size_t at = 0; (at = value.find('|', at)) != std::string::npos; at += 2) value.insert(at, "\\");
  return value;
}

using TextRows = std::vector<std::vector<std::string>>;

std::string markdown_table(const TextRows& rows, const char* alignment) {
  std::string table;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table += "|";
    for (const std::string& value : rows[i]) table += " " + cell(value) + " |";
    table += "\n";
    if (i == 0) table += alignment;
  }
  return table;
}

std::string html_table(const TextRows& rows) {
  std::string table = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string tag = i == 0 ? "th" : "td";
    table += "<tr>";
    for (const std::string& value : rows[i]) table += "<" + tag + ">" + escaped(value) + "</" + tag + ">";
    table += "</tr>\n";
  }
  return table + "</table></div>\n";
}

constexpr const char* measures_title = "The same in the numbers of other programs";

}  // namespace

std::string verdict(const SpheresCheck& check) {
  const Totals all = totals(check);
  const std::string links =
      std::to_string(check.links.size()) + (check.links.size() == 1 ? " link" : " links");
  const std::string balls = std::to_string(all.balls) + (all.balls == 1 ? " sphere" : " spheres");
  const bool one = check.links.size() == 1;
  if (!check.enclosing) {
    return balls + " for " + links + (all.protrusion == 0 ? ": nothing stands out" : ": they stand out by ") +
           (all.protrusion == 0 ? "" : length(all.protrusion) + " at most") + "; " +
           percent(all.area > 0 ? all.open_area / all.area : 0) + " of the surface is in none";
  }
  if (all.enclosed == check.links.size()) {
    std::string line = links + (one ? " is" : " are") + " enclosed by " + balls + ": proven";
    if (all.solid_volume > 0)
      line += "; " + percent(all.volume / all.solid_volume - 1) + " of the volume is outside";
    return line;
  }
  std::string line = std::to_string(all.enclosed) + " of " + links + " enclosed by " + balls;
  const auto hollow = std::count_if(check.links.begin(), check.links.end(), [](const LinkCheck& link) {
    return link.enclosure.covers() && !link.enclosure.encloses();
  });
  if (hollow > 0)
    line += "; " + std::to_string(hollow) + (hollow == 1 ? " has" : " have") +
            " voids inside that no sphere fills";
  if (all.area > 0 && all.open_area > 0)
    line += "; " + percent(all.open_area / all.area) + " of the surface is outside, up to " + length(all.gap);
  return line;
}

std::vector<std::vector<std::string>> table(const SpheresCheck& check) {
  std::vector<std::vector<std::string>> rows = {
      {"link", "spheres", "verdict", "surface outside", "farthest", "protrusion", "volume outside"}};
  for (const LinkCheck& link : check.links) {
    rows.push_back({link.link, std::to_string(link.enclosure.balls), verdict_of(link, check.enclosing),
                    percent(open_share(link)), length(link.enclosure.gap), length(link.enclosure.protrusion),
                    outside(link)});
  }
  return rows;
}

bool all_enclosed(const SpheresCheck& check) {
  return std::all_of(check.links.begin(), check.links.end(),
                     [](const LinkCheck& link) { return link.enclosure.encloses(); });
}

std::string markdown_page(const SpheresCheck& check) {
  std::string page = "# " + title(check) + "\n\n" + verdict(check) + ".\n\n";
  for (const std::string& line : sources(check)) page += "- " + line + "\n";
  page += "\n" + markdown_table(table(check), "|---|--:|---|--:|--:|--:|--:|\n");
  page += std::string("\n## ") + measures_title + "\n\n" +
          markdown_table(measures(check), "|---|--:|--:|--:|--:|--:|\n");
  bool heading = false;
  for (const LinkCheck& link : check.links) {
    const std::vector<std::string> open = places(link, most_places);
    if (open.empty() || !check.enclosing) continue;
    if (!heading) page += "\n## Where\n\nPoints in the frame of each link, metres.\n\n";
    heading = true;
    page += "- " + link.link + ": " + counted_places(link) + "\n";
    for (const std::string& line : open) page += "  - " + line + "\n";
  }
  page += "\n## What the numbers mean\n\n";
  for (const std::string& line : explanations()) page += line + "\n\n";
  page.pop_back();
  return page;
}

std::string html_page(const SpheresCheck& check) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      escaped(check.spheres) + " for " + escaped(check.robot) + "</title>\n<style>" + style_sheet() +
      "</style></head><body>\n<h1>" + escaped(title(check)) + "</h1>\n<p>" + escaped(verdict(check)) +
      ".</p>\n<ul>";
  for (const std::string& line : sources(check)) page += "<li>" + escaped(line) + "</li>\n";
  page += "</ul>\n" + html_table(table(check));
  for (const Picture& picture : check.pictures) page += figure(picture);
  page += std::string("<h2>") + measures_title + "</h2>\n" + html_table(measures(check)) + curves(check);
  bool heading = false;
  for (const LinkCheck& link : check.links) {
    const std::vector<std::string> open = places(link, most_places);
    if (open.empty() || !check.enclosing) continue;
    if (!heading) page += "<h2>Where</h2>\n<p>Points in the frame of each link, metres.</p>\n<ul>\n";
    heading = true;
    page += "<li>" + escaped(link.link + ": " + counted_places(link)) + "<ul>";
    for (const std::string& line : open) page += "<li>" + escaped(line) + "</li>";
    page += "</ul></li>\n";
  }
  if (heading) page += "</ul>\n";
  page += "<h2>What the numbers mean</h2>\n";
  for (const std::string& line : explanations()) page += "<p>" + escaped(line) + "</p>\n";
  return page + "</body></html>\n";
}

}  // namespace ballflow::report
