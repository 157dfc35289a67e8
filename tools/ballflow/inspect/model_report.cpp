#include "inspect/model_report.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "inspect/advice.hpp"
#include "io/file_content.hpp"

namespace ballflow::inspect {
namespace {

namespace fs = std::filesystem;

/// Keeps what the reader warns of.
class Listener final : public geometry::Monitor {
 public:
  Listener(geometry::Monitor& whole, std::vector<std::string>& warnings)
      : whole_(whole), warnings_(warnings) {}
  void progress(double fraction) override { whole_.progress(fraction); }
  bool cancelled() override { return whole_.cancelled(); }
  void warn(const std::string& text) override { warnings_.push_back(text); }

 private:
  geometry::Monitor& whole_;
  std::vector<std::string>& warnings_;
};

/// "STL, packed"
std::string words_of(geometry::MeshFormat format, std::uint64_t file_bytes, std::size_t content_bytes) {
  return geometry::name_of(format) + std::string(file_bytes < content_bytes ? ", packed" : "");
}

}  // namespace

std::string place(geometry::Vec3 p) {
  return "(" + short_number(p.x) + ", " + short_number(p.y) + ", " + short_number(p.z) + ")";
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::pair<std::string, std::string> guess_units(const std::string& format, double longest_edge) {
  const std::string size = "its longest edge is " + short_number(longest_edge);
  const bool stl = format.starts_with("STL");
  if (std::abs(longest_edge - 1) < 0.01 || std::abs(longest_edge - 2) < 0.02)
    return {"none", size + ": it was scaled to a box of that size"};
  if (stl && longest_edge >= 5)
    return {"millimetres", size + ", and STL files of that extent are nearly always in millimetres"};
  if (longest_edge >= 20 && longest_edge <= 5000)
    return {"millimetres", size + ": as parts and organs are in millimetres"};
  if (longest_edge >= 0.01 && longest_edge < 5)
    return {"metres", size + ": as scans and parts of robots are in metres"};
  return {"unknown", size + ", which no usual unit makes likely"};
}

ModelReport look_at_file(const std::string& path, geometry::Monitor& monitor) {
  ModelReport report;
  report.path = path;
  Listener listener(monitor, report.read);
  geometry::PartMonitor reading(listener, 0, 0.3), looking(listener, 0.3, 0.9);
  const geometry::FileContent content =
      geometry::read_file_content(path, geometry::ReadOptions().max_unpacked_bytes);
  const geometry::MeshFormat format = geometry::format_of(path, content.view(), reading);
  std::error_code ignored;
  report.bytes = fs::file_size(path, ignored);
  report.format = words_of(format, report.bytes, content.view().size());
  report.model = geometry::parse_mesh(content.view(), format, {}, reading);
  report.look = geometry::look_at(report.model, {}, looking);
  if (const auto& gaps = report.look.gaps.small) {
    geometry::ReadOptions options;
    options.weld.value = gaps->tolerance;
    geometry::PartMonitor again(monitor, 0.9, 1);
    std::vector<std::string> known;
    Listener quiet(again, known);
    report.welded =
        geometry::look_at(geometry::parse_mesh(content.view(), format, options, quiet), {}, quiet);
  }
  std::tie(report.units, report.units_reason) = guess_units(report.format, report.look.box.longest_edge());
  advise(report);
  return report;
}

}  // namespace ballflow::inspect
