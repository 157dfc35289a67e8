#include "document/labels.hpp"

#include <filesystem>
#include <set>
#include <string_view>

#include "ballflow/digest.hpp"
#include "base/quote.hpp"

namespace ballflow {

namespace {
constexpr std::size_t longest_label = 60;  // bytes
}

std::string cut(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  const std::string mark = "~" + sha256(text).hex().substr(0, 8);
  std::size_t end = longest - mark.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + mark;
}

std::string label_text(const std::string& text) {
  std::string label;
  for (const char c : printable(text)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       (c & 0x80) != 0 || std::string_view("._-+%@:").find(c) != std::string_view::npos;
    label += plain ? c : '_';
  }
  return cut(label, longest_label);
}

std::vector<std::string> labels_of(const std::vector<std::string>& texts, bool files) {
  std::vector<std::string> labels;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    labels.push_back(label_text(files ? std::filesystem::path(text).filename().string() : text));
    names.insert(labels.back());
  }
  if (names.size() == labels.size()) return labels;
  names.clear();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string label = label_text(texts[i]);
    labels[i] = label;
    for (int number = 2; !names.insert(labels[i]).second; ++number)
      labels[i] = label + "~" + std::to_string(number);
  }
  return labels;
}

}  // namespace ballflow
