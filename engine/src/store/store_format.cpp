#include "store/store_format.hpp"

#include <utility>

#include "base/record.hpp"

namespace ballflow {
namespace {

constexpr std::string_view action_magic = "bfaction", memo_magic = "bfdigest";
constexpr std::uint32_t action_format = 1, memo_format = 1;
}  // namespace

std::string encode(const Digest& key, const ActionEntry& entry) {
  RecordWriter writer;
  writer.raw(action_magic);
  writer.number(action_format);
  writer.digest(key);
  writer.number(entry.seconds);
  writer.number(entry.cpu_seconds);
  writer.text(entry.manifest);
  writer.number(static_cast<std::uint32_t>(entry.outputs.size()));
  for (const OutputEntry& output : entry.outputs) {
    writer.text(output.port);
    writer.text(output.type);
    writer.number(std::int32_t{output.type_version});
    writer.digest(output.digest);
    writer.number(output.bytes);
    writer.number(output.checksum.low);
    writer.number(output.checksum.high);
    writer.text(output.summary);
  }
  writer.number(static_cast<std::uint32_t>(entry.warnings.size()));
  for (const std::string& warning : entry.warnings) writer.text(warning);
  return std::move(writer).sealed();
}

std::optional<ActionEntry> decode_action(const Digest& key, std::string_view bytes) {
  constexpr std::size_t smallest_output = 3 * 4 + 4 + 32 + 3 * 8, smallest_text = 4;
  RecordReader reader(bytes);
  if (!reader.unseal() || reader.raw(action_magic.size()) != action_magic) return std::nullopt;
  std::uint32_t format = 0;
  reader.number(format);
  Digest stored_key;
  reader.digest(stored_key);
  if (format != action_format || stored_key != key) return std::nullopt;
  ActionEntry entry;
  reader.number(entry.seconds);
  reader.number(entry.cpu_seconds);
  reader.text(entry.manifest);
  entry.outputs.resize(reader.count(smallest_output));
  for (OutputEntry& output : entry.outputs) {
    reader.text(output.port);
    reader.text(output.type);
    reader.number(output.type_version);
    reader.digest(output.digest);
    reader.number(output.bytes);
    reader.number(output.checksum.low);
    reader.number(output.checksum.high);
    reader.text(output.summary);
  }
  entry.warnings.resize(reader.count(smallest_text));
  for (std::string& warning : entry.warnings) reader.text(warning);
  if (!reader.at_end()) return std::nullopt;
  return entry;
}

std::string encode(const Memo& memo) {
  RecordWriter writer;
  writer.raw(memo_magic);
  writer.number(memo_format);
  encode(memo.state, writer);
  writer.digest(memo.digest);
  return std::move(writer).sealed();
}

std::optional<Memo> decode_memo(std::string_view bytes) {
  RecordReader reader(bytes);
  if (!reader.unseal() || reader.raw(memo_magic.size()) != memo_magic) return std::nullopt;
  std::uint32_t format = 0;
  Memo memo;
  reader.number(format);
  memo.state = decode_state(reader);
  reader.digest(memo.digest);
  if (!reader.at_end() || format != memo_format) return std::nullopt;
  return memo;
}

}  // namespace ballflow
