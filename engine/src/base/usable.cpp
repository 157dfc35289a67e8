#include "base/usable.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>
#include <vector>

#include "base/process_usage.hpp"

namespace ballflow {
namespace {

/// One hierarchy of control groups that this process is in: the line "4:cpu,cpuacct:/user" of
/// /proc/self/cgroup.
struct Membership {
  std::vector<std::string> controllers;  // none: version 2
  std::string group;
};

/// A line of /proc/self/mountinfo about a hierarchy.
struct MountPoint {
  std::string root;  // the group that is shown at the point
  std::string point;
  bool version_2 = false;
  std::vector<std::string> options;  // of version 1: its controllers are among them
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

bool has(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

std::vector<Membership> memberships(const std::string& root) {
  std::vector<Membership> result;
  std::ifstream in(root + "/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    result.push_back({split(line.substr(first + 1, second - first - 1), ','), line.substr(second + 1)});
  }
  return result;
}

/// mountinfo writes space, tab, newline and backslash as "\040" and so on.
std::string unescaped(const std::string& text) {
  const auto octal = [&text](std::size_t i) { return text[i] >= '0' && text[i] <= '7'; };
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 3 < text.size() && octal(i + 1) && octal(i + 2) && octal(i + 3)) {
      plain += static_cast<char>((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 + (text[i + 3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

std::vector<MountPoint> mounts(const std::string& root) {
  std::vector<MountPoint> result;
  std::ifstream in(root + "/proc/self/mountinfo");
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> words = split(line, ' ');
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (words.size() < 6 || words.end() - dash < 4) continue;
    if (dash[1] != "cgroup" && dash[1] != "cgroup2") continue;
    result.push_back({unescaped(words[3]), unescaped(words[4]), dash[1] == "cgroup2", split(dash[3], ',')});
  }
  return result;
}

/// The group below the mount point, "" for the point itself; nothing when the mount shows another part of the
/// tree.
std::optional<std::string> below(const MountPoint& mount, const std::string& group) {
  if (group.empty() || group[0] != '/') return std::nullopt;
  if (group.find("/..") != std::string::npos) return std::nullopt;  // outside the namespace of this process
  if (mount.root == "/") return group == "/" ? "" : group;
  if (group == mount.root) return "";
  if (group.rfind(mount.root + "/", 0) == 0) return group.substr(mount.root.size());
  return std::nullopt;
}

/// Calls `look` with the folder of every group on the way up that can be seen. A container often sees its own
/// group only, under another name: then that is looked at.
void walk_up(const std::string& root, const std::vector<MountPoint>& all, const std::string& controller,
             const std::string& group, const std::function<void(const std::string& folder)>& look) {
  std::vector<const MountPoint*> mounted;
  for (const MountPoint& mount : all) {
    if (controller.empty() ? mount.version_2 : !mount.version_2 && has(mount.options, controller))
      mounted.push_back(&mount);
  }
  bool found = false;
  for (const MountPoint* mount : mounted) {
    std::optional<std::string> path = below(*mount, group);
    if (!path) continue;
    found = true;
    for (;;) {
      look(root + mount->point + *path);
      if (path->empty()) break;
      path->resize(path->rfind('/'));
    }
  }
  if (found) return;
  for (const MountPoint* mount : mounted) look(root + mount->point);
}

/// The first words of a file; none when it cannot be read.
std::vector<std::string> words_of(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return split(line, ' ');
}

/// Nothing for "max" and for what is no number.
std::optional<double> number(const std::vector<std::string>& words, std::size_t i) {
  if (i >= words.size()) return std::nullopt;
  std::istringstream in(words[i]);
  double value = 0;
  if (in >> value && in.eof() && value >= 0) return value;
  return std::nullopt;
}

template <class T>
void lower(std::optional<T>& limit, T value) {
  if (!limit || value < *limit) limit = value;
}

std::optional<unsigned> affinity() {
  for (int count = 1024; count <= 1 << 20;
       count *= 2) {  // the kernel may know more than the default set holds
    cpu_set_t* const set = CPU_ALLOC(static_cast<std::size_t>(count));
    if (set == nullptr) return std::nullopt;
    const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(count));
    const bool read = sched_getaffinity(0, size, set) == 0;
    const int allowed = read ? CPU_COUNT_S(size, set) : 0;
    CPU_FREE(set);
    if (read && allowed > 0) return static_cast<unsigned>(allowed);
  }
  return std::nullopt;
}

}  // namespace

ControlGroupLimits control_group_limits(const std::string& root) {
  ControlGroupLimits limits;
  const auto limit_memory = [&limits](const std::string& file) {
    const std::optional<double> bytes = number(words_of(file), 0);
    // Version 1 writes "no limit" as a number near 2^63.
    if (bytes && *bytes < 0x1p62) lower(limits.memory_bytes, static_cast<std::uint64_t>(*bytes));
  };
  const auto limit_processors = [&limits](std::optional<double> quota, std::optional<double> period) {
    if (quota && period && *quota > 0 && *period > 0) lower(limits.processors, *quota / *period);
  };
  const std::vector<MountPoint> all = mounts(root);
  for (const Membership& one : memberships(root)) {
    if (one.controllers.empty()) {
      walk_up(root, all, "", one.group, [&](const std::string& folder) {
        limit_memory(folder + "/memory.max");
        limit_memory(folder + "/memory.high");
        const std::vector<std::string> words = words_of(folder + "/cpu.max");
        limit_processors(number(words, 0), number(words, 1));
      });
    }
    if (has(one.controllers, "memory")) {
      walk_up(root, all, "memory", one.group,
              [&](const std::string& folder) { limit_memory(folder + "/memory.limit_in_bytes"); });
    }
    if (has(one.controllers, "cpu")) {
      walk_up(root, all, "cpu", one.group, [&](const std::string& folder) {
        limit_processors(number(words_of(folder + "/cpu.cfs_quota_us"), 0),
                         number(words_of(folder + "/cpu.cfs_period_us"), 0));
      });
    }
  }
  return limits;
}

std::uint64_t usable_memory_bytes() {
  const std::uint64_t machine = physical_memory_bytes();
  const std::optional<std::uint64_t> limit = control_group_limits().memory_bytes;
  return limit && *limit > 0 ? std::min(*limit, machine) : machine;
}

unsigned usable_processors() {
  unsigned count = affinity().value_or(std::thread::hardware_concurrency());
  if (const std::optional<double> quota = control_group_limits().processors)
    count = std::min(count, static_cast<unsigned>(std::min(std::ceil(*quota), 1e6)));
  return std::max(1u, count);
}

}  // namespace ballflow
