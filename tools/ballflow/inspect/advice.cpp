#include "inspect/advice.hpp"

#include <algorithm>
#include <cmath>

#include "ballflow/text.hpp"

namespace ballflow::inspect {
namespace {

std::string count_of(std::int64_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// Collects findings and the options that follow from them.
class Adviser {
 public:
  explicit Adviser(ModelReport& report) : report_(report), look_(report.look) {}

  void run() {
    predict();
    extent();
    if (!look_.strays.points.empty()) stray();
    if (!report_.model.mesh.triangles.empty()) {
      open();
      connected();
      crossing();
      shells();
      thin();
    }
    std::string line = "ballflow run medial_axis --set " + shell_word("input=" + report_.path);
    for (const std::string& option : options_) line += " --set " + option;
    report_.command = line + " --out out";
  }

 private:
  void say(std::string what, std::string remedy) {
    report_.findings.push_back({std::move(what), std::move(remedy)});
  }

  void predict() {
    report_.samples = static_cast<std::int64_t>(report_.model.points.points.size());
    if (report_.model.mesh.triangles.empty()) {
      report_.labels = "angle";
      report_.labels_reason = "a cloud of points has no mesh that says what is inside";
    } else if (look_.closed) {
      report_.samples = -1;
      report_.labels = "mesh";
      report_.labels_reason = "the surface is closed: what is inside is decided exactly";
    } else {
      report_.labels = "winding";
      report_.labels_reason =
          "the surface is not closed: the generalized winding number tells inside from outside";
    }
  }

  /// Beyond these sizes areas and volumes are no numbers that doubles can hold or tell from 0.
  void extent() {
    const double size = look_.box.longest_edge();
    if (size >= 1e-40 && size <= 1e40) return;
    options_.push_back(sample_node + ".scale=" + short_number(1 / size));
    say("the model is " + short_number(size) +
            " long: areas, volumes and widths are not what they are said to be",
        "read it in a unit in which it has an ordinary size: --set " + options_.back());
  }

  void stray() {
    const geometry::Strays& strays = look_.strays;
    std::string places;
    for (std::size_t i = 0; i < std::min<std::size_t>(strays.points.size(), 3); ++i)
      places += (i == 0 ? "" : ", ") +
                place(report_.model.points.points[static_cast<std::size_t>(strays.points[i])]);
    options_.push_back(sample_node + ".strays=drop");
    say(count_of(static_cast<std::int64_t>(strays.points.size()), "point lies", "points lie") + " " +
            short_number(strays.nearest / strays.diagonal) +
            " times as far away as the others are large: " + places,
        "leave what is no part of the shape out: --set " + options_.back());
  }

  void open() {
    const geometry::Gaps& gaps = look_.gaps;
    if (gaps.open_edges == 0) return;
    const geometry::Rim& rim = gaps.rims.front();
    const std::string what = "the surface is open: " + count_of(gaps.open_edges, "edge", "edges") +
                             " with one triangle in " +
                             count_of(static_cast<std::int64_t>(gaps.rims.size()), "rim", "rims") +
                             ", the longest with " + count_of(rim.edges, "edge", "edges") + " and " +
                             short_number(rim.size) + " wide around " + place(rim.middle);
    if (!gaps.small) {
      say(what, "no welding closes it: fill the holes, or expect poles near them to be labelled by a vote");
      return;
    }
    options_.push_back(sample_node + ".weld=" + short_number(gaps.small->tolerance));
    say(what, "weld vertices that are nearly equal: --set " + options_.back() +
                  (gaps.small->left == 0 ? " closes all of it"
                                         : " closes all but " + count_of(gaps.small->left, "edge", "edges") +
                                               "; the holes that are left have to be filled") +
                  (report_.welded && report_.welded->betti
                       ? ", and gives a solid with " + geometry::describe(*report_.welded->betti)
                       : std::string()));
  }

  void connected() {
    const geometry::MeshTopology& mesh = look_.topology;
    if (mesh.nonmanifold_edges > 0) {
      say(count_of(mesh.nonmanifold_edges, "edge belongs", "edges belong") + " to more than two triangles",
          look_.closed ? "what is inside is known all the same; the topology of the solid is not"
                       : "remove inner walls and parts that only touch");
    } else if (!mesh.manifold && mesh.boundary_edges == 0) {
      say("parts of the surface touch in single corners",
          "the topology of the solid is not compared; separate them");
    }
    if (!look_.orientable) {
      say("the surface is not orientable: it has only one side", "no inside can be told; cut it or close it");
    } else if (look_.turned > 0) {
      say(count_of(look_.turned, "triangle faces another way than its",
                   "triangles face another way than their") +
              " neighbours",
          "they are turned over for the labels; nothing has to be done");
    }
  }

  void crossing() {
    // Flanks of cracks cross each other; what welding mends is no second finding.
    const geometry::SelfIntersections& found =
        report_.welded ? report_.welded->intersections : look_.intersections;
    if (!found.flat.empty()) {
      say(count_of(static_cast<std::int64_t>(found.flat.size()), "triangle has", "triangles have") +
              " three different corners and no area",
          "collapse them where the mesh was made; the topology of the solid is not compared otherwise");
    }
    if (!found.pairs.empty()) {
      say((found.all ? "" : "more than ") +
              count_of(static_cast<std::int64_t>(found.pairs.size()), "pair of triangles crosses",
                       "pairs of triangles cross") +
              ": the surface intersects itself, first at " +
              place(geometry::place_of(report_.model.mesh, found.pairs.front())),
          look_.closed
              ? "inside is what it winds around at least once; the volume by formula counts overlaps twice"
              : "repair it where the mesh was made");
    }
  }

  void shells() {
    if (!look_.shells) return;
    std::int64_t turned = 0, idle = 0;
    for (const geometry::Shell& shell : look_.shells->shells) {
      turned += shell.turned;
      idle += !shell.bounds;
    }
    if (look_.shells->inside_out) {
      say("the surface faces inwards", "it is turned over for the labels; nothing has to be done");
    }
    if (turned > 0) {
      say(count_of(turned, "shell faces", "shells face") + " inwards and bounds no cavity",
          "they count as solids; turn them in the file if they should not");
    }
    if (idle > 0) {
      say(count_of(idle, "shell lies", "shells lie") +
              " inside the solid and faces outwards as the shell around does: it bounds nothing",
          "turn it over in the file if it is a cavity, else remove it: its samples only cost balls");
    }
  }

  void thin() {
    if (!look_.widths) return;
    const geometry::Widths& widths = *look_.widths;
    std::string what;
    if (widths.thin_walls > 0) {
      what = count_of(widths.thin_walls, "place is", "places are") + " thinner than its triangle is long, " +
             short_number(widths.wall->width) + " at the thinnest, at " + place(widths.wall->from);
    }
    if (widths.narrow_slots > 0) {
      what += (what.empty() ? "" : "; ") + count_of(widths.narrow_slots, "place has", "places have") +
              " another one opposite as near, " + short_number(widths.slot->width) + " at the nearest, at " +
              place(widths.slot->from);
    }
    if (what.empty() && look_.spacing.largest > look_.box.longest_edge() / 10) {
      what = "vertices are up to " + short_number(look_.spacing.largest) +
             " apart, more than a tenth of the model";
    }
    if (what.empty()) return;
    if (look_.closed) {
      say(what,
          "nothing has to be done: samples of closed surfaces follow the shape (sampling=auto, see Refine)");
    } else {
      options_.push_back("sampling=surface");
      say(what, "sample the faces instead of the vertices: sampling=surface");
    }
  }

  ModelReport& report_;
  const geometry::Look& look_;
  std::vector<std::string> options_;
};

}  // namespace

const std::string sample_node = "dmt/sampling/sample";

void advise(ModelReport& report) { Adviser(report).run(); }

}  // namespace ballflow::inspect
