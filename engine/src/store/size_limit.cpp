// How large the store may get.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "ballflow/gc.hpp"
#include "store/parts.hpp"

namespace ballflow {

std::optional<std::uint64_t> parse_size(std::string_view text) {
  if (text == "none") return no_limit;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  if (parsed.ec != std::errc() || !std::isfinite(number) || number < 0 || std::signbit(number))
    return std::nullopt;
  std::string_view unit(parsed.ptr, static_cast<std::size_t>(end - parsed.ptr));
  double factor = 1;
  if (!unit.empty()) {
    const std::size_t power = std::string_view("KMGT").find(unit.front() & ~0x20);
    if (power == std::string_view::npos) return std::nullopt;
    factor = std::ldexp(1, 10 * static_cast<int>(power + 1));
    unit.remove_prefix(1);
    if (!unit.empty() && unit != "iB" && unit != "B") return std::nullopt;
  }
  const double bytes = std::floor(number * factor);
  if (bytes >= 0x1p63) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

std::uint64_t default_limit(Store& store) {
  const StoreFolders& folders = store.parts().folders;
  constexpr std::uint64_t at_most = std::uint64_t{20} << 30;
  std::uint64_t disk = 0;
  if (!folders.root.is_open() || folders.files->capacity(folders.root.get(), disk) < 0 || disk == 0) {
    return at_most;
  }
  return std::min(at_most, disk / 10);
}

}  // namespace ballflow
