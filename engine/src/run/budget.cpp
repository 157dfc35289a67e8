#include <charconv>

#include "ballflow/gc.hpp"
#include "ballflow/run.hpp"
#include "base/usable.hpp"

namespace ballflow {

std::optional<std::uint64_t> parse_memory(std::string_view text) {
  if (!text.empty() && text.back() == '%') {
    unsigned percent = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size() - 1, percent);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() - 1) return std::nullopt;
    if (percent == 0 || percent > 100) return std::nullopt;
    return usable_memory_bytes() / 100 * percent;
  }
  const auto bytes = parse_size(text);
  if (!bytes || *bytes == 0 || *bytes == no_limit) return std::nullopt;
  return bytes;
}

}  // namespace ballflow
