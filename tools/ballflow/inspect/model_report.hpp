// What "ballflow look" says of a model: facts, what they mean for a run, and the command that suits them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/json.hpp"
#include "base/monitor.hpp"
#include "io/read_mesh.hpp"
#include "look/look.hpp"

namespace ballflow::inspect {

/// Something that will show in the results, and what to do about it.
struct Finding {
  std::string what, remedy;
};

struct ModelReport {
  std::string path, format;  // format: "STL, packed"
  std::uint64_t bytes = 0;   // of the file
  geometry::MeshFile model;
  geometry::Look look;
  std::optional<geometry::Look>
      welded;                     // where welding closes most of the gaps: the model read with that tolerance
  std::vector<std::string> read;  // what reading it changed or left out, in words
  std::string units, units_reason;

  // What a run with the default parameters does.
  std::int64_t samples = 0;           // -1: Refine chooses them
  std::string labels, labels_reason;  // "mesh", "winding" or "angle"

  std::vector<Finding> findings;  // the most important first
  std::string command;            // that suits the model
};

/// Reads a model and looks at it. Throws InputError where it cannot be read.
ModelReport look_at_file(const std::string& path, geometry::Monitor& monitor = geometry::no_monitor());

/// What the extent of a model says about its unit of length, and why; a guess.
std::pair<std::string, std::string> guess_units(const std::string& format, double longest_edge);

/// For people: lines of at most some hundred characters.
std::string text_of(const ModelReport& report);
/// For programs; docs/look.md names the fields.
Json json_of(const ModelReport& report);

/// "1.234", "2.5e-05": four digits.
std::string short_number(double value);
/// "(1.5, 0, -2)".
std::string place(geometry::Vec3 p);

}  // namespace ballflow::inspect
