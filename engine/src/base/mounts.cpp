#include "base/mounts.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace ballflow {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Blanks and the like are octal there: "\040".
std::string unescaped(std::string_view text) {
  const auto octal = [](char c) { return c >= '0' && c <= '7'; };
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 3 < text.size() && octal(text[i + 1]) && octal(text[i + 2]) &&
        octal(text[i + 3])) {
      plain += static_cast<char>((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 + (text[i + 3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

}  // namespace

std::optional<Mount> find_mount(std::string_view mountinfo, long id) {
  for (const std::string_view line : split(mountinfo, '\n')) {
    // id parent major:minor root point options [optional fields] - type source super-options
    const std::vector<std::string_view> fields = split(line, ' ');
    long number = 0;
    if (fields.size() < 6 ||
        std::from_chars(fields[0].data(), fields[0].data() + fields[0].size(), number).ec != std::errc() ||
        number != id) {
      continue;
    }
    const auto dash = std::find(fields.begin() + 6, fields.end(), "-");
    if (fields.end() - dash < 4) return std::nullopt;
    return Mount{std::string(dash[1]), unescaped(fields[4]),
                 std::string(fields[5]) + ',' + std::string(dash[3])};
  }
  return std::nullopt;
}

std::string host_local_locks(const Mount& mount) {
  struct Rule {
    std::string_view type, option;
  };
  static constexpr std::array rules = {Rule{"nfs", "nolock"},
                                       Rule{"nfs", "local_lock=flock"},
                                       Rule{"nfs", "local_lock=all"},
                                       Rule{"nfs4", "nolock"},
                                       Rule{"nfs4", "local_lock=flock"},
                                       Rule{"nfs4", "local_lock=all"},
                                       Rule{"lustre", "localflock"},
                                       Rule{"gfs2", "localflocks"},
                                       Rule{"ocfs2", "localflocks"},
                                       Rule{"cifs", "nobrl"},
                                       Rule{"smb3", "nobrl"}};
  const std::vector<std::string_view> options = split(mount.options, ',');
  for (const Rule& rule : rules) {
    if (rule.type == mount.type && std::find(options.begin(), options.end(), rule.option) != options.end()) {
      return std::string(rule.option);
    }
  }
  // The server of sshfs knows no locks at all.
  return mount.type == "fuse.sshfs" ? "fuse.sshfs" : std::string();
}

}  // namespace ballflow
