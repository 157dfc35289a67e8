#include "ballflow/text.hpp"

#include <algorithm>
#include <string_view>

#include "inspect/advice.hpp"
#include "inspect/model_report.hpp"

namespace ballflow::inspect {
namespace {

using geometry::Vec3;

constexpr std::size_t names = 14;  // width of what stands before the text of a line
constexpr std::size_t most_shells = 8, most_places = 3;

std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ' ');
  return digits;
}

std::string counted(std::int64_t n, const std::string& one, const std::string& many) {
  return grouped(n) + " " + (n == 1 ? one : many);
}

/// Lines with a name before them, broken between words.
class Lines {
 public:
  void line(const std::string& name, const std::string& text, std::size_t indent = names) {
    constexpr std::size_t width = 104;
    const std::string whole = printable(text);
    std::string_view rest = whole;
    text_.append("  ").append(name);
    std::size_t column = 2 + name.size();
    do {
      const std::size_t blanks = column < indent ? indent - column : 1;
      text_.append(blanks, ' ');
      column += blanks;
      std::size_t end = rest.size();
      if (column + end > width) {
        end = rest.rfind(' ', width > column ? width - column : 0);
        if (end == std::string_view::npos || end == 0) end = std::min(rest.find(' '), rest.size());
      }
      text_.append(rest.substr(0, end)).append("\n");
      rest.remove_prefix(std::min(end + 1, rest.size()));
      column = 0;
    } while (!rest.empty());
  }
  void heading(const std::string& text) { text_.append("\n").append(text).append("\n"); }
  void plain(const std::string& text) { text_.append(text).append("\n"); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string surface(const geometry::Look& look) {
  const geometry::MeshTopology& mesh = look.topology;
  std::string text = mesh.boundary_edges > 0 ? "open" : look.closed ? "closed" : "not closed";
  text += mesh.manifold ? ", manifold" : ", not manifold";
  if (!look.orientable) {
    text += ", not orientable";
  } else if (look.turned > 0) {
    text += ", " + counted(look.turned, "triangle faces", "triangles face") + " the wrong way";
  } else {
    text += ", all triangles face one way";
  }
  return text;
}

std::string intersections(const geometry::SelfIntersections& found, const geometry::TriangleMesh& mesh) {
  std::string text = found.pairs.empty()
                         ? "no triangles cross"
                         : (found.all ? "" : "more than ") +
                               counted(static_cast<std::int64_t>(found.pairs.size()),
                                       "pair of triangles crosses", "pairs of triangles cross");
  for (std::size_t i = 0; i < std::min(found.pairs.size(), most_places); ++i) {
    const auto& [a, b] = found.pairs[i];
    text += (i == 0 ? ": " : ", ") + std::to_string(a) + " and " + std::to_string(b) + " at " +
            place(geometry::place_of(mesh, found.pairs[i]));
  }
  if (!found.flat.empty()) {
    text += "; " + counted(static_cast<std::int64_t>(found.flat.size()), "triangle has", "triangles have") +
            " no area, first " + std::to_string(found.flat.front());
  }
  return text;
}

void shells(const geometry::Shells& shells, Lines& out) {
  if (shells.shells.size() == 1) return;
  std::vector<std::size_t> by_size;
  for (std::size_t i = 0; i < shells.shells.size(); ++i) by_size.push_back(i);
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
    return shells.shells[a].triangles > shells.shells[b].triangles;
  });
  std::string text =
      counted(static_cast<std::int64_t>(by_size.size()), "shell", "shells") + ", the largest first";
  out.line("shells", text);
  for (std::size_t k = 0; k < std::min(by_size.size(), most_shells); ++k) {
    const geometry::Shell& shell = shells.shells[by_size[k]];
    text = std::to_string(by_size[k] + 1) + ": " + counted(shell.triangles, "triangle", "triangles") +
           ", genus " + std::to_string(shell.genus) + ", volume " + short_number(std::abs(shell.volume));
    if (shell.parent >= 0) text += ", in " + std::to_string(shell.parent + 1);
    text += !shell.bounds ? ", bounds nothing" : shell.faces_outwards ? ", a solid" : ", a cavity";
    if (shell.turned) text += ", faces the wrong way";
    out.line("", text);
  }
  if (by_size.size() > most_shells)
    out.line("", "and " + grouped(static_cast<std::int64_t>(by_size.size() - most_shells)) + " more");
}

std::string width(const std::optional<geometry::Width>& found, const char* none) {
  return found ? short_number(found->width) + " at " + place(found->from) : none;
}

}  // namespace

std::string text_of(const ModelReport& report) {
  const geometry::Look& look = report.look;
  const geometry::TriangleMesh& mesh = report.model.mesh;
  const bool cloud = mesh.triangles.empty();
  Lines out;
  out.plain(printable(report.path) + ": " + (cloud ? "a cloud of points" : "a mesh") + ", " + report.format +
            ", " + grouped(static_cast<std::int64_t>(report.bytes)) + " bytes");
  std::string counts = counted(static_cast<std::int64_t>(report.model.points.points.size()),
                               cloud ? "point" : "vertex", cloud ? "points" : "vertices");
  if (!cloud)
    counts += ", " + counted(static_cast<std::int64_t>(mesh.triangles.size()), "triangle", "triangles");
  if (!report.model.points.normals.empty()) counts += ", with normals";
  out.line("size", counts);
  const Vec3 extent = look.box.upper - look.box.lower;
  out.line("box", short_number(extent.x) + " x " + short_number(extent.y) + " x " + short_number(extent.z) +
                      ", from " + place(look.box.lower) + " to " + place(look.box.upper));
  std::string unit =
      report.units == "none" || report.units == "unknown" ? report.units : "probably " + report.units;
  unit += ": " + report.units_reason;
  if (report.units == "millimetres") unit += "; --set " + sample_node + ".scale=mm makes metres of them";
  out.line("unit", unit);
  for (const std::string& text : report.read) out.line("reading", text);
  out.line("spacing", std::string(cloud ? "the next point" : "edges") + ": " +
                          short_number(look.spacing.median) + " in the median, " +
                          short_number(look.spacing.largest) + " at most");
  if (!cloud) {
    out.line("surface", surface(look));
    out.line("crossings", intersections(look.intersections, mesh));
    if (look.gaps.open_edges > 0) {
      std::string text = counted(look.gaps.open_edges, "open edge", "open edges") + " in " +
                         counted(static_cast<std::int64_t>(look.gaps.rims.size()), "rim", "rims");
      for (std::size_t i = 0; i < std::min(look.gaps.rims.size(), most_places); ++i) {
        const geometry::Rim& rim = look.gaps.rims[i];
        text += (i == 0 ? ": " : ", ") + counted(rim.edges, "edge", "edges") + " around " + place(rim.middle);
      }
      out.line("gaps", text);
      if (const auto& small = look.gaps.small) {
        text = short_number(small->tolerance) + " closes " + grouped(look.gaps.open_edges - small->left) +
               " of " + grouped(look.gaps.open_edges) + " open edges";
        if (report.welded) text += "; then it is " + surface(*report.welded);
        if (report.welded && report.welded->betti)
          text += ", with " + geometry::describe(*report.welded->betti);
        out.line("welding", text);
      }
    }
    if (look.betti) {
      out.line("solid", geometry::describe(*look.betti) + "; volume " + short_number(look.shells->volume()) +
                            ", area " + short_number(look.area));
    } else {
      std::string text = "area " + short_number(look.area);
      if (look.shells) text += ", volume by formula " + short_number(look.shells->volume());
      out.line("solid", text + "; topology unknown: " + look.unknown_because);
    }
    if (look.shells) shells(*look.shells, out);
    if (look.widths) {
      out.line("walls", "the thinnest: " + width(look.widths->wall, "none is opposite to another one"));
      out.line("slots", "the narrowest: " + width(look.widths->slot, "none"));
    }
  }
  out.heading("A run with the default parameters");
  out.line("samples",
           report.samples < 0
               ? "chosen so that they follow the shape (node Refine), a few thousand for most models"
               : grouped(report.samples) + (cloud ? ", the points" : ", the vertices"));
  out.line("labels", report.labels + ": " + report.labels_reason);
  if (!report.findings.empty()) out.heading("What matters");
  for (const Finding& finding : report.findings) {
    out.line("-", finding.what, 4);
    out.line("", finding.remedy, 6);
  }
  out.heading("A command that suits it");
  out.plain("  " + report.command);
  return out.text();
}

}  // namespace ballflow::inspect
