// Points as text: x y z per line; optionally normals in the next three columns, or columns in any order under
// a line of their names; optionally the number of points first, also several times (scans in one PTS file).
#include <array>
#include <cmath>
#include <limits>

#include "io/number_rows.hpp"
#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

// Columns 4 to 6 of every point are normals when all of them have about this length; else they are colours or
// the like.
constexpr double unit_tolerance = 0.02;

using Columns = std::array<std::size_t, 3>;

class Parser {
 public:
  Parser(std::string_view content, Monitor& monitor) : rows_(content, 3, monitor) {}

  RawModel parse() {
    if (rows_.read_names()) use_names();
    for (bool first = true; rows_.next(); first = false) {
      if (!is_count(first)) point();
    }
    check_count();
    if (scans_ > 1) warn("the " + std::to_string(scans_) + " scans of the file are joined");
    if (!normals_) {
      model_.normals.clear();
      if (more_columns_) warn("columns 4 and up are not unit normals and are passed over");
    }
    return std::move(model_);
  }

 private:
  void warn(std::string text) { model_.warnings.push_back(std::move(text)); }

  void use_names() {
    const auto named = [this](const std::array<const char*, 3>& names, Columns& columns) {
      std::size_t found = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto column = rows_.column(names[i]);
        if (!column) continue;
        columns[i] = *column;
        ++found;
      }
      return found;
    };
    const std::size_t found = named({"x", "y", "z"}, xyz_);
    if (found == 0) {
      warn("the first line, " + excerpt(rows_.names()) + ", is passed over");
      return;
    }
    if (found < 3) {
      throw InputError("the columns are named " + excerpt(rows_.names()) +
                           ", not all of x, y and z are there" + rows_.place_of(rows_.names()),
                       "name the columns of the coordinates x, y and z, or remove the line");
    }
    named_normals_ = named({"nx", "ny", "nz"}, normal_) == 3;
    normals_ = named_normals_ || (xyz_ == Columns{0, 1, 2} && !rows_.column("nx"));
    named_ = true;
  }

  /// The number of points that follow.
  bool is_count(bool first) {
    if (rows_.fields().size() != 1 || named_) return false;
    const auto points = static_cast<std::int64_t>(model_.vertices.size());
    if (!first && (promised_ < 0 || points != promised_)) return false;
    const auto count = parse_integer(rows_.fields()[0]);
    if (!count || *count < 0 || *count > std::numeric_limits<std::int64_t>::max() - points) return false;
    promised_ = points + *count;
    ++scans_;
    return true;
  }

  void check_count() const {
    const auto points = static_cast<std::int64_t>(model_.vertices.size());
    if (promised_ < 0 || promised_ == points) return;
    throw InputError((scans_ == 1 ? "the first line promises " : "the lines of counts promise ") +
                         std::to_string(promised_) + " points, the file has " + std::to_string(points),
                     "the file is cut off or its first line is wrong");
  }

  void point() {
    const auto number = static_cast<std::int64_t>(model_.vertices.size());
    const auto coordinate = [&](std::size_t i, const char* name) {
      return rows_.coordinate(xyz_[i], "point", number, name);
    };
    const double x = coordinate(0, "x"), y = coordinate(1, "y"), z = coordinate(2, "z");
    add_vertex(model_, {x, y, z});
    if (!normals_) return;
    more_columns_ = more_columns_ || (!named_ && rows_.fields().size() > 3);
    const auto nx = rows_.number(normal_[0]), ny = rows_.number(normal_[1]), nz = rows_.number(normal_[2]);
    normals_ =
        nx && ny && nz && (named_normals_ || std::abs(length(Vec3{*nx, *ny, *nz}) - 1) <= unit_tolerance);
    if (normals_) model_.normals.push_back({*nx, *ny, *nz});
  }

  NumberRows rows_;
  RawModel model_;
  Columns xyz_{0, 1, 2}, normal_{3, 4, 5};
  std::int64_t promised_ = -1, scans_ = 0;
  bool normals_ = true, named_ = false, named_normals_ = false, more_columns_ = false;
};

}  // namespace

RawModel parse_xyz(std::string_view content, Monitor& monitor) { return Parser(content, monitor).parse(); }

}  // namespace ballflow::geometry
