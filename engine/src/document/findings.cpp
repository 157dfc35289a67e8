#include "document/findings.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>
#include <utility>

namespace ballflow {

void Findings::error(const GraphFile& file, Offset offset, std::string message, std::string hint) {
  add(json_text::finding(file.source, file.root, offset, std::move(message), std::move(hint)));
}

void Findings::warning(const GraphFile& file, Offset offset, std::string message, std::string hint) {
  add(json_text::finding(file.source, file.root, offset, std::move(message), std::move(hint),
                         Diagnostic::Severity::warning));
}

void Findings::add(Diagnostic finding) {
  const std::string key = finding.file + '\0' + std::to_string(finding.line) + ':' +
                          std::to_string(finding.column) + '\0' + finding.message;
  if (!keys_.insert(key).second) return;
  failed_ = failed_ || finding.severity == Diagnostic::Severity::error;
  all_.push_back(std::move(finding));
}

std::vector<Diagnostic> Findings::take(const std::vector<std::string>& files) {
  std::map<std::string, std::size_t> rank;
  for (const std::string& file : files) rank.try_emplace(file, rank.size());
  const auto key = [&](const Diagnostic& d) {
    const auto file = rank.find(d.file);
    return std::make_tuple(file == rank.end() ? rank.size() : file->second, std::cref(d.file), d.line,
                           d.column, std::cref(d.message));
  };
  std::sort(all_.begin(), all_.end(),
            [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  return std::move(all_);
}

}  // namespace ballflow
