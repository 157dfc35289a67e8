#include "document/setting.hpp"

#include <algorithm>
#include <utility>

#include "ballflow/text.hpp"

namespace ballflow {

std::string setting_target(const std::string& name) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '.', '/');
  const std::size_t last = path.rfind('/');
  return last == std::string::npos ? "." + path : path.substr(0, last) + "." + path.substr(last + 1);
}

Diagnostic about_setting(const PlacedSetting& setting, std::string message, std::string hint) {
  if (setting.file != nullptr) {
    return json_text::finding(setting.file->source, setting.file->root, setting.offset, std::move(message),
                              std::move(hint));
  }
  Diagnostic found;
  found.file = printable(setting.origin);
  found.message = std::move(message);
  found.hint = std::move(hint);
  return found;
}

Settings::Settings(const std::vector<const PlacedSetting*>& settings)
    : all_(settings), used_(settings.size(), false) {
  for (std::size_t i = 0; i < all_.size(); ++i) by_name_[setting_target(all_[i]->name)].push_back(i);
}

const PlacedSetting* Settings::find(const std::string& path, const std::string& param) {
  if (all_.empty()) return nullptr;
  const auto found = by_name_.find(path + "." + param);
  if (found == by_name_.end()) return nullptr;
  for (const std::size_t i : found->second) used_[i] = true;
  return all_[found->second.back()];
}

std::vector<const PlacedSetting*> Settings::unused() const {
  std::vector<const PlacedSetting*> result;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (!used_[i]) result.push_back(all_[i]);
  }
  return result;
}

}  // namespace ballflow
