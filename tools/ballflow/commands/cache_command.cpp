#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <set>

#include "ballflow/gc.hpp"
#include "ballflow/upstream_gc.hpp"
#include "cluster/slurm.hpp"
#include "cluster/submission.hpp"
#include "commands/commands.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

using Table = std::vector<std::vector<std::string>>;

std::string count(std::uint64_t n) { return grouped(static_cast<std::int64_t>(n)); }

/// "12.3 MB": as for --size, with powers of 1024.
std::string size_text(std::uint64_t bytes) {
  static constexpr const char* units[] = {"B", "KB", "MB", "GB", "TB"};
  double number = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; number >= 1023.95 && unit + 1 < std::size(units); ++unit) number /= 1024;
  char text[32];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", number, units[unit]);
  return text;
}

std::string limit_text(std::uint64_t bytes) { return bytes == no_limit ? "none" : size_text(bytes); }

/// "3 h ago", from nanoseconds since 1970.
std::string ago(std::int64_t time) {
  using namespace std::chrono;
  const std::int64_t now = duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
  const std::int64_t seconds = std::max<std::int64_t>(0, (now - time) / 1'000'000'000);
  if (seconds < 60) return "just now";
  if (seconds < 3600) return count(static_cast<std::uint64_t>(seconds / 60)) + " min ago";
  if (seconds < 48 * 3600) return count(static_cast<std::uint64_t>(seconds / 3600)) + " h ago";
  return count(static_cast<std::uint64_t>(seconds / 86400)) + " days ago";
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

/// The store of a command; null after having said that there is none.
std::shared_ptr<Store> existing(const Common& common) {
  auto store = common.store();
  if (!store->root().empty()) return store;
  std::printf("there is no cache: %s\n", store->why().c_str());
  return nullptr;
}

/// Leases of other hosts, where this one cannot see whether their runs live.
void say_what_cannot_be_seen(const Store& store, const Collected& collected) {
  if (collected.unseen.empty()) return;
  std::printf(
      "%s, so runs of other hosts cannot be seen. These count as live, and what was used since stays:\n",
      collected.locks_stay_here.c_str());
  for (const UnseenRun& run : collected.unseen) {
    std::printf("  %s/%s (%s, began %s)\n", store.root().c_str(), run.file.c_str(),
                run.host.empty() ? "host unknown" : ("host " + run.host).c_str(), ago(run.since).c_str());
  }
  std::printf("remove the file of a run that is dead, or mount the folder so that locks reach all hosts\n");
}

int show_statistics(const Common& common) {
  const auto store = existing(common);
  if (store == nullptr) return 0;
  const Store::Statistics s = store->statistics();
  const Collected counted = collect(*store, {no_limit, no_limit, true, true});
  Table rows = {
      {"folder", store->root()},
      {"on the disk", size_text(counted.bytes_before)},
      {"limit", limit_text(common.cache_limit(*store))},
      {"artifacts", count(s.blobs) + " (" + size_text(s.blob_bytes) + ")"},
      {"actions", count(s.actions) + " (" + size_text(s.action_bytes) + ")"},
      {"pins", count(find_pins(*store, "").size())},
      {"quarantined", count(s.quarantined)},
      {"run records", count(s.runs)},
  };
  if (store->read_only()) rows.push_back({"read only", store->why()});
  if (!counted.locks_stay_here.empty())
    rows.push_back({"locks", "of this host only: " + counted.locks_stay_here});
  print_table(rows);
  say_what_cannot_be_seen(*store, counted);
  return 0;
}

int list_artifacts(const Common& common) {
  const auto store = existing(common);
  if (store == nullptr) return 0;
  Table rows = {{"digest", "type", "node", "size", "to recompute", "last use", ""}};
  for (const CachedArtifact& artifact : read_contents(*store).artifacts) {
    rows.push_back({artifact.digest.hex().substr(0, 16), or_dash(artifact.type), or_dash(artifact.node),
                    size_text(artifact.bytes), artifact.actions.empty() ? "-" : duration(artifact.seconds),
                    ago(artifact.last_use), artifact.pinned ? "pinned" : ""});
  }
  if (rows.size() == 1) {
    std::printf("no artifacts in %s\n", store->root().c_str());
    return 0;
  }
  print_table(rows);
  std::printf("\n%s artifacts; the first would be collected first\n", count(rows.size() - 1).c_str());
  return 0;
}

int show_usage_by_node(const Common& common) {
  struct Total {
    std::uint64_t actions = 0, artifacts = 0, bytes = 0;
    double seconds = 0;
    std::int64_t last_use = 0;
  };
  const auto store = existing(common);
  if (store == nullptr) return 0;
  const CacheContents contents = read_contents(*store);
  std::map<std::string, Total> totals;
  for (const CachedAction& action : contents.actions) {
    Total& total = totals[action.node];
    ++total.actions;
    total.seconds += action.seconds;
    total.last_use = std::max(total.last_use, action.last_use);
  }
  Total sum;
  for (const CachedArtifact& artifact : contents.artifacts) {
    Total& total = totals[artifact.node];
    ++total.artifacts;
    total.bytes += artifact.bytes;
    total.last_use = std::max(total.last_use, artifact.last_use);
  }
  std::vector<std::pair<std::string, Total>> sorted(totals.begin(), totals.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second.bytes > b.second.bytes; });
  for (const auto& [node, total] : sorted) {
    sum.actions += total.actions;
    sum.artifacts += total.artifacts;
    sum.bytes += total.bytes;
    sum.seconds += total.seconds;
    sum.last_use = std::max(sum.last_use, total.last_use);
  }
  Table rows = {{"node", "actions", "artifacts", "size", "to recompute", "last use"}};
  const auto add = [&rows](const std::string& node, const Total& total) {
    rows.push_back({node, count(total.actions), count(total.artifacts), size_text(total.bytes),
                    duration(total.seconds), total.last_use == 0 ? "-" : ago(total.last_use)});
  };
  for (const auto& [node, total] : sorted) add(node.empty() ? "(no action)" : node, total);
  add("all", sum);
  print_table(rows);
  return 0;
}

int collect_garbage(const Common& common, const std::string& size, bool dry_run) {
  const auto store = existing(common);
  if (store == nullptr) return 0;
  const auto given = parse_size(size);
  if (!size.empty() && !given) {
    throw Error(ExitCode::usage, "--size " + size + ": not a size",
                "write it as 5G, 800M, 1.5T, a number of bytes, or none");
  }
  const std::uint64_t limit = given ? *given : common.cache_limit(*store);
  if (store->read_only() && !dry_run) {
    throw Error(ExitCode::store, "the cache cannot be written: " + store->why());
  }
  const Collected done = collect(*store, {limit, limit, dry_run, true});
  if (dry_run) {
    for (const Digest& digest : done.removed) std::printf("would remove %s\n", digest.hex().c_str());
  }
  std::printf(
      "%s %s artifacts, %s action entries, %s digests of input files, %s quarantined files, %s "
      "records of runs\n",
      dry_run ? "would remove" : "removed", count(done.artifacts).c_str(), count(done.actions).c_str(),
      count(done.memos).c_str(), count(done.quarantined).c_str(), count(done.runs).c_str());
  std::printf("%s before, %s after, limit %s\n", size_text(done.bytes_before).c_str(),
              size_text(done.bytes_after).c_str(), limit_text(limit).c_str());
  if (!done.complete) {
    std::printf("more than the limit is left: %s pinned, %s live run%s\n",
                size_text(done.pinned_bytes).c_str(), count(done.live_runs).c_str(),
                done.live_runs == 1 ? "" : "s");
    if (!done.locks_stay_here.empty()) {
      std::printf("what was used within the last hour stays: %s\n", done.locks_stay_here.c_str());
    }
    say_what_cannot_be_seen(*store, done);
  }
  return 0;
}

struct UpstreamArguments {
  std::string place, age;
  bool nothing_runs = false;
};

/// "12 entries (3.4 MB)".
std::string count(const FileCount& files, const char* what) {
  return count(files.files) + ' ' + what + " (" + size_text(files.bytes) + ')';
}

/// What jobs have left beside their results. Where there is no Slurm, age alone counts.
SubmissionsCollected collect_submissions(const std::string& place, std::int64_t age, bool dry_run) {
  const auto is_active = [](const Submission& submission) {
    try {
      return slurm::tasks(submission.jobs()).active() > 0;
    } catch (const Error&) {
      return false;
    }
  };
  return Submissions(place).collect(age, dry_run, is_active);
}

int collect_upstream_garbage(const UpstreamArguments& arguments, bool dry_run) {
  constexpr std::int64_t day = 86400;
  const auto age = parse_age(arguments.age);
  if (!age) {
    throw Error(ExitCode::usage,
                arguments.age.empty() ? "--upstream needs --older-than"
                                      : "--older-than " + arguments.age + ": not an age",
                "write it as 36h, 90d, 8w or 1y; upstream there are no times of use, only those of writing");
  }
  if (*age < day && !arguments.nothing_runs) {
    throw Error(ExitCode::usage,
                "--older-than " + arguments.age + ": a job may be older than that, and lose what it reads",
                "give a day (1d) or more, or say with --nothing-runs that nothing uses " + arguments.place);
  }
  const UpstreamCollected done = collect_upstream(arguments.place, {*age, dry_run});
  std::printf("%s %s, %s and %s\n", dry_run ? "would remove" : "removed",
              count(done.entries, "entries").c_str(), count(done.blobs, "artifacts").c_str(),
              count(done.leftovers, "drafts and damaged files").c_str());
  std::printf("%s and %s are left\n", count(done.entries_left, "entries").c_str(),
              count(done.blobs_left, "artifacts").c_str());
  const SubmissionsCollected runs = collect_submissions(arguments.place, *age, dry_run);
  if (runs.removed + runs.left > 0) {
    std::printf("records of submissions: %s as old, %s left\n", count(runs.removed).c_str(),
                count(runs.left).c_str());
  }
  if (done.failed.files == 0 && !runs.why.empty()) {
    throw Error(ExitCode::store, "records of submissions could not be removed, first " + runs.why,
                "collect as their owner");
  }
  if (done.failed.files == 0) return 0;
  throw Error(
      ExitCode::store,
      count(done.failed, "files") + " could not be removed from " + arguments.place + ", first " + done.why,
      "collect as their owner or as the owner of the folder; what is left is whole");
}

int verify_cache(const Common& common, bool full) {
  const auto store = existing(common);
  if (store == nullptr) return 0;
  const Verified found = verify(*store, full);
  for (const Finding& bad : found.bad) {
    std::printf("%s: %s%s\n", bad.file.c_str(), bad.what.c_str(), bad.moved ? "; moved to quarantine" : "");
  }
  std::printf("%s artifacts (%s) with good %s, %s action entries, %s digests of input files; %s bad\n",
              count(found.artifacts - static_cast<std::uint64_t>(std::count_if(
                                          found.bad.begin(), found.bad.end(),
                                          [](const Finding& bad) { return bad.file.rfind("cas/", 0) == 0; })))
                  .c_str(),
              size_text(found.bytes).c_str(), full ? "SHA-256" : "checksums", count(found.actions).c_str(),
              count(found.memos).c_str(), count(found.bad.size()).c_str());
  if (found.bad.empty()) return 0;
  std::printf("the next run computes again what it needs of it\n");
  return static_cast<int>(ExitCode::store);
}

Digest the_one(const std::vector<Digest>& found, const std::string& digits, const std::string& what) {
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw Error(ExitCode::usage, "there is no " + what + " \"" + digits + "\"",
                "give its digest (6 digits or more); \"ballflow cache ls\" lists them");
  }
  throw Error(ExitCode::usage, "\"" + digits + "\" is the beginning of several digests", "give more digits");
}

int change_pin(const Common& common, const std::string& digits, bool on) {
  const auto store = common.store();
  const bool enough = digits.size() >= 6;
  if (on) {
    const Digest digest =
        the_one(enough ? find_artifacts(*store, digits) : std::vector<Digest>(), digits, "artifact");
    pin(*store, digest);
    std::printf("pinned %s\n", digest.hex().c_str());
  } else {
    const Digest digest = the_one(enough ? find_pins(*store, digits) : std::vector<Digest>(), digits, "pin");
    unpin(*store, digest);
    std::printf("unpinned %s\n", digest.hex().c_str());
  }
  return 0;
}

}  // namespace

void add_cache(const Command& app, Common& common, Action& action) {
  struct Arguments {
    std::string size, digest;
    UpstreamArguments upstream;
    bool dry_run = false, full = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  const Command command = app.subcommand("cache", "look at the cache, check it, make it smaller");
  command.requires_subcommand();
  const auto add = [&](const char* name, const char* what, std::function<int()> act) {
    const Command sub = command.subcommand(name, what);
    sub.option("--cache", common.cache, "cache folder").type_name("DIR");
    sub.callback([&action, act = std::move(act)] { action = act; });
    return sub;
  };
  add("stat", "say where the cache is, what is in it and how large it may get",
      [&common] { return show_statistics(common); });
  add("ls", "list the artifacts, those that would be collected first on top",
      [&common] { return list_artifacts(common); });
  add("du", "sum up by type of node", [&common] { return show_usage_by_node(common); });
  const Command gc =
      add("gc", "remove what is worth least until the cache is small enough", [&common, arguments] {
        if (!arguments->upstream.place.empty())
          return collect_upstream_garbage(arguments->upstream, arguments->dry_run);
        if (!arguments->upstream.age.empty() || arguments->upstream.nothing_runs) {
          throw Error(ExitCode::usage, "--older-than and --nothing-runs are about an upstream",
                      "name its folder with --upstream; the cache of this machine is collected by --size");
        }
        return collect_garbage(common, arguments->size, arguments->dry_run);
      });
  gc.flag("--dry-run", arguments->dry_run, "only say what would be removed");
  Option size = gc.option("--size", arguments->size,
                          "size to reach, e.g. 5G (default: the limit that \"cache stat\" shows)");
  size.type_name("SIZE");
  Option upstream = gc.option(
      "--upstream", arguments->upstream.place,
      "instead of the cache, an upstream in a folder: remove entries older than --older-than, then artifacts "
      "as old that no entry names; while no job uses it");
  upstream.type_name("DIR").excludes(size).excludes(gc.find("--cache"));
  gc.option("--older-than", arguments->upstream.age,
            "age of what goes from the upstream: 36h, 90d, 8w, 1y; a day or more")
      .type_name("AGE");
  gc.flag("--nothing-runs", arguments->upstream.nothing_runs,
          "nothing uses the upstream: --older-than may be less than a day");
  const Command check =
      add("verify", "read everything, move what is damaged to quarantine; exit 5 if there was any",
          [&common, arguments] { return verify_cache(common, arguments->full); });
  check.flag("--full", arguments->full, "check the SHA-256 of every artifact, not only its fast checksum");
  for (const bool on : {true, false}) {
    add(on ? "pin" : "unpin",
        on ? "keep an artifact whatever the size of the cache" : "let go of a pinned artifact",
        [&common, arguments, on] { return change_pin(common, arguments->digest, on); })
        .option("digest", arguments->digest, "digest of the artifact, or its first digits")
        .required();
  }
}

void add_version(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("version", "print the version, the plugin ABI and the node libraries");
  command.callback([&common, &action] {
    action = [&common] {
      std::printf("ballflow %s, plugin ABI %u\n", BALLFLOW_VERSION, BALLFLOW_ABI_VERSION);
      const auto registry = common.registry();
      for (const PluginCandidate& candidate : registry->candidates()) {
        if (candidate.refused.empty()) {
          std::printf("  %s %s  %s\n", candidate.name.c_str(), candidate.version.c_str(),
                      candidate.path.c_str());
        } else {
          std::printf("  not loaded: %s: %s\n", candidate.path.c_str(), candidate.refused.c_str());
        }
      }
      return 0;
    };
  });
}

}  // namespace ballflow::cli
