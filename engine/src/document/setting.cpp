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
  // Entries of lists may have dots in them, which stand for slashes in the name of a setting.
  const auto known = [&](const std::string& place) {
    std::string name = place + "/" + param;
    return by_name_.find(setting_target(name));
  };
  auto found = path.empty() ? by_name_.find("." + param) : known(path);
  if (found == by_name_.end()) {
    const std::string all_copies = without_entries(path);
    if (all_copies != path) found = known(all_copies);
  }
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
