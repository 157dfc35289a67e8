#include "cover/load_cover.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "cover/cover_matrix.hpp"
#include "cover/residual.hpp"
#include "io/file_content.hpp"
#include "io/formats.hpp"
#include "io/load_balls.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t max_bytes = std::int64_t{2} << 30;
constexpr std::size_t tokens_per_step = 1 << 15;
const char* const damaged = "the file is cut off, damaged, or of another format: check it, or set format";

/// The integers of a file and where they stand.
struct Numbers {
  std::string_view text;
  std::vector<std::int32_t> values;
  std::vector<std::uint32_t> places;  // offsets into `text`, which has at most max_bytes

  std::string place(std::size_t k) const {
    const std::size_t at = k < places.size() ? places[k] : text.size();
    return TextCursor(text).place_of(text.substr(at, 0));
  }
};

Numbers numbers_of(std::string_view content, Monitor& monitor) {
  Numbers numbers{content, {}, {}};
  TextCursor text(content);
  for (std::string_view token = text.token(); !token.empty(); token = text.token()) {
    if (numbers.values.size() % tokens_per_step == 0) {
      monitor.step(0.5 * static_cast<double>(text.offset()) / static_cast<double>(content.size()));
    }
    const auto value = parse_integer(token);
    if (!value || *value < 0 || *value > most) {
      refuse_other_formats(content, readable_covers);
      throw InputError(excerpt(token) + " is not an integer from 0 to 2147483647" + text.place_of(token),
                       readable_covers);
    }
    numbers.values.push_back(static_cast<std::int32_t>(*value));
    numbers.places.push_back(static_cast<std::uint32_t>(token.data() - content.data()));
  }
  return numbers;
}

/// What a number of the file is, spelled out only when it is wrong: "set of element 5".
struct Role {
  const char* what;
  const char* owner = nullptr;
  std::int64_t number = 0;

  std::string text() const {
    return owner == nullptr ? what : std::string(what) + " of " + owner + " " + std::to_string(number);
  }
};

/// Reads numbers in order; a misfit is an InputError that names the line.
class Reader {
 public:
  explicit Reader(const Numbers& numbers) : numbers_(numbers) {}

  std::int32_t next(const Role& role) {
    if (at_ == numbers_.values.size()) {
      throw InputError("the file ends where the " + role.text() + " should be" + numbers_.place(at_),
                       damaged);
    }
    return numbers_.values[at_++];
  }
  /// A number from 1 to `limit`, counted from 0.
  std::int32_t index(std::int64_t limit, const Role& role) {
    const std::int32_t value = next(role);
    if (value >= 1 && value <= limit) return value - 1;
    refuse(role, value, ", not from 1 to " + std::to_string(limit));
  }
  /// How many of something there are, each of which needs at least one more number of the file: memory stays
  /// proportional to the file whatever it claims.
  std::int32_t count(const Role& role) {
    const std::int32_t value = next(role);
    if (static_cast<std::size_t>(value) <= numbers_.values.size() - at_) return value;
    refuse(role, value, ", but only " + std::to_string(numbers_.values.size() - at_) + " numbers follow");
  }
  /// `count` distinct numbers from 1 to `limit`, appended to `list` ascending and counted from 0.
  void list(std::int32_t count, std::int64_t limit, const Role& role, std::vector<std::int32_t>& list) {
    const auto first = static_cast<std::ptrdiff_t>(list.size());
    for (std::int32_t k = 0; k < count; ++k) list.push_back(index(limit, role));
    std::sort(list.begin() + first, list.end());
    const auto twice = std::adjacent_find(list.begin() + first, list.end());
    if (twice == list.end()) return;
    throw InputError(
        "the " + role.text() + " is twice " + std::to_string(*twice + 1) + numbers_.place(at_ - 1),
        "remove one of the two");
  }
  void end() const {
    if (at_ == numbers_.values.size()) return;
    throw InputError(std::to_string(numbers_.values.size() - at_) +
                         " numbers follow where the file should end" + numbers_.place(at_),
                     damaged);
  }

 private:
  [[noreturn]] void refuse(const Role& role, std::int32_t value, const std::string& why) const {
    throw InputError("the " + role.text() + " is " + std::to_string(value) + why + numbers_.place(at_ - 1),
                     damaged);
  }

  const Numbers& numbers_;
  std::size_t at_ = 0;
};

/// An instance by its elements or by its sets, whichever way the file lists it.
struct Lists {
  std::int64_t sets = 0, elements = 0;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> entries;  // each list ascending
  bool of_elements = false;           // list e: the sets of element e; else list s: the elements of set s
  std::int32_t least_cost = 1, greatest_cost = 1;

  void add_cost(std::int32_t cost) {
    least_cost = std::min(least_cost, cost);
    greatest_cost = std::max(greatest_cost, cost);
  }
  void end_list() { offsets.push_back(static_cast<std::int64_t>(entries.size())); }
};

void step(Monitor& monitor, std::int64_t done, std::int64_t all) {
  if (done % 256 == 0) monitor.step(0.5 + 0.4 * static_cast<double>(done) / static_cast<double>(all));
}

Lists parse_scp(const Numbers& numbers, Monitor& monitor) {
  Reader reader(numbers);
  Lists lists;
  lists.of_elements = true;
  lists.elements = reader.count({"number of elements"});
  lists.sets = reader.count({"number of sets"});
  for (std::int64_t s = 1; s <= lists.sets; ++s) lists.add_cost(reader.next({"cost", "set", s}));
  for (std::int64_t e = 1; e <= lists.elements; ++e) {
    step(monitor, e, lists.elements);
    const std::int32_t count = reader.count({"number of sets", "element", e});
    reader.list(count, lists.sets, {"set", "element", e}, lists.entries);
    lists.end_list();
  }
  reader.end();
  return lists;
}

Lists parse_rail(const Numbers& numbers, Monitor& monitor) {
  Reader reader(numbers);
  Lists lists;
  lists.elements = reader.count({"number of elements"});
  lists.sets = reader.count({"number of sets"});
  for (std::int64_t s = 1; s <= lists.sets; ++s) {
    step(monitor, s, lists.sets);
    lists.add_cost(reader.next({"cost", "set", s}));
    const std::int32_t count = reader.count({"number of elements", "set", s});
    reader.list(count, lists.elements, {"element", "set", s}, lists.entries);
    lists.end_list();
  }
  reader.end();
  return lists;
}

Lists parse_steiner(const Numbers& numbers, Monitor& monitor) {
  Reader reader(numbers);
  Lists lists;
  lists.of_elements = true;
  lists.sets = reader.count({"number of points"});
  lists.elements = reader.count({"number of blocks"});
  for (std::int64_t b = 1; b <= lists.elements; ++b) {
    step(monitor, b, lists.elements);
    reader.list(3, lists.sets, {"point", "block", b}, lists.entries);
    lists.end_list();
  }
  reader.end();
  return lists;
}

CoverState cover_of(Lists lists, Monitor& monitor) {
  if (lists.least_cost != 1 || lists.greatest_cost != 1) {
    monitor.warn("the costs, from " + std::to_string(lists.least_cost) + " to " +
                 std::to_string(lists.greatest_cost) + ", are ignored: every set counts 1");
  }
  const auto elements = static_cast<std::size_t>(lists.elements);
  const bool of_elements = lists.of_elements;
  const Csr listed{std::move(lists.offsets), std::move(lists.entries)};
  const Csr rows = of_elements ? transpose(listed, static_cast<std::size_t>(lists.sets), monitor) : listed;
  monitor.step(0.95);

  std::vector<std::int32_t> number(elements, -1), column_ids, uncovered, row_ids(rows.size());
  for (const std::int32_t e : rows.entries) number[static_cast<std::size_t>(e)] = 0;
  for (std::size_t e = 0; e < elements; ++e) {
    auto& ids = number[e] == 0 ? column_ids : uncovered;
    number[e] = static_cast<std::int32_t>(ids.size());
    ids.push_back(static_cast<std::int32_t>(e));
  }
  for (std::size_t i = 0; i < row_ids.size(); ++i) row_ids[i] = static_cast<std::int32_t>(i);

  CoverState cover;
  cover.balls = lists.sets;
  cover.samples = lists.elements;
  cover.row_offsets = rows.offsets;
  cover.columns = rows.entries;
  if (!uncovered.empty()) {
    monitor.warn(std::to_string(uncovered.size()) + " of " + std::to_string(elements) +
                 " elements are in no set, the first is element " + std::to_string(uncovered.front() + 1) +
                 "; the cover will not contain them");
    std::vector<std::int32_t> columns(rows.entries.begin(), rows.entries.end());
    for (std::int32_t& c : columns) c = number[static_cast<std::size_t>(c)];
    cover.columns = std::move(columns);
  }
  cover.row_ids = std::move(row_ids);
  cover.column_ids = std::move(column_ids);
  cover.uncovered = std::move(uncovered);
  raise_lower_bound(cover);
  return cover;
}

struct Parser {
  const char* name;
  CoverFormat format;
  Lists (*parse)(const Numbers&, Monitor&);
};
constexpr std::array parsers = {Parser{"scp", CoverFormat::scp, parse_scp},
                                Parser{"rail", CoverFormat::rail, parse_rail},
                                Parser{"steiner", CoverFormat::steiner, parse_steiner}};

/// The formats do not say their names, but a whole file hardly ever fits two of them.
Lists parse_any(const Numbers& numbers, Monitor& monitor) {
  std::optional<Lists> found;
  std::string fitting, misfits;
  for (const Parser& parser : parsers) {
    try {
      found = parser.parse(numbers, monitor);
      fitting += (fitting.empty() ? "" : " and ") + std::string(parser.name);
    } catch (const InputError& error) {
      const std::string what = error.what();
      misfits += (misfits.empty() ? "" : "; ") + std::string("as ") + parser.name + ", " +
                 what.substr(0, what.find('\n'));
    }
  }
  if (!found) throw InputError("the file fits no format: " + misfits, damaged);
  if (fitting.find(' ') != std::string::npos) {
    throw InputError("the file can be read as " + fitting, "set format to the one that is meant");
  }
  return std::move(*found);
}

Balls grown_balls(std::string_view content, double dilation, Monitor& monitor) {
  PartMonitor reading(monitor, 0, 0.5);
  Balls balls = parse_ball_rows(content, reading);
  if (dilation == 0) return balls;
  std::vector<double> radii(balls.radii.begin(), balls.radii.end());
  for (double& r : radii) r += dilation;
  balls.radii = std::move(radii);
  return balls;
}

/// The points of the affine space over the field of three elements, and its lines. Point p has the digits of
/// p to base 3 as coordinates.
CoverState affine_space(const std::string& name) {
  const auto points = parse_integer(std::string_view(name).substr(name.find(':') + 1));
  constexpr std::array sizes = {3, 9, 27, 81, 243, 729};
  if (!points || std::find(sizes.begin(), sizes.end(), *points) == sizes.end()) {
    throw InputError(excerpt(name) + " is no Steiner triple system that can be made",
                     "N of steiner:N is one of 3, 9, 27, 81, 243, 729");
  }
  const auto n = static_cast<std::int32_t>(*points);
  const auto third = [n](std::int32_t a, std::int32_t b) {
    std::int32_t c = 0;
    for (std::int32_t power = 1; power < n; power *= 3) {
      c += (6 - a / power % 3 - b / power % 3) % 3 * power;
    }
    return c;
  };
  Lists lists;
  lists.of_elements = true;
  lists.sets = n;
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      const std::int32_t c = third(a, b);
      if (c <= b) continue;
      for (const std::int32_t p : {a, b, c}) lists.entries.push_back(p);
      lists.end_list();
      ++lists.elements;
    }
  }
  return cover_of(std::move(lists), no_monitor());
}

}  // namespace

LoadedCover parse_cover(std::string_view content, CoverFormat format, double dilation, const PointSet* points,
                        Monitor& monitor) {
  if (!(dilation >= 0 && dilation <= std::numeric_limits<double>::max())) {
    throw InputError("dilation is " + std::to_string(dilation), "it is a finite number of at least 0");
  }
  monitor.step(0);
  if (format == CoverFormat::balls || (format == CoverFormat::automatic && is_ball_rows(content))) {
    if (points == nullptr) {
      throw InputError("the file lists balls, and there are no points for them to cover",
                       "connect the samples to the input points");
    }
    PartMonitor rest(monitor, 0.5, 1);
    CoverMatrix matrix = cover_matrix(grown_balls(content, dilation, monitor), *points,
                                      {.uncovered = UncoveredPolicy::report}, rest);
    return {std::move(matrix.cover), std::move(matrix.balls)};
  }
  const Numbers numbers = numbers_of(content, monitor);
  if (format == CoverFormat::automatic) return {cover_of(parse_any(numbers, monitor), monitor), {}};
  const auto parser = std::find_if(parsers.begin(), parsers.end(),
                                   [format](const Parser& known) { return known.format == format; });
  return {cover_of(parser->parse(numbers, monitor), monitor), {}};
}

LoadedCover load_cover(const LoadCoverOptions& options, const PointSet* points, Monitor& monitor) {
  if (options.file.starts_with("steiner:")) return {affine_space(options.file), {}};
  const FileContent content = read_file_content(options.file, max_bytes);
  return parse_cover(content.view(), options.format, options.dilation, points, monitor);
}

}  // namespace ballflow::geometry
