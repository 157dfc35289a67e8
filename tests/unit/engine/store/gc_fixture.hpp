// A store with artifacts of known size, cost and age, for the tests of collector, leases and verifier.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "ballflow/gc.hpp"
#include "child_process.hpp"
#include "faulty_file_system.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::action_for;
using test::entry_for;
using test::FaultyFileSystem;
using test::make_probe;
using test::place_of;

constexpr std::uint64_t block = 4096;
constexpr std::int64_t hour = std::int64_t{3600} * 1'000'000'000;

inline Digest key_of(int i) { return sha256("key " + std::to_string(i)); }

inline std::int64_t modified(const std::string& file) {
  struct stat status {};
  EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
  return std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

class GcTest : public ::testing::Test {
 protected:
  std::shared_ptr<Store> open() const { return Store::open({root}, files); }

  /// An artifact of `blocks` blocks on the disk, made by an action that took `seconds` and was last used
  /// `hours` ago.
  Digest put(int i, std::uint64_t blocks, double seconds, double hours) {
    const auto store = open();
    const ArtifactPtr artifact = make_probe(i, (blocks * block - 1000) / 9);
    EXPECT_EQ((artifact->file_size() + block - 1) / block, blocks);
    ActionEntry entry = action_for(*artifact);
    entry.seconds = seconds;
    EXPECT_TRUE(store->put_blob(*artifact, false));
    EXPECT_TRUE(store->put_action(key_of(i), entry));
    age(place_of(root, "cas", artifact->digest()), hours);
    age(place_of(root, "ac", key_of(i)), hours);
    return artifact->digest();
  }
  static void age(const std::string& file, double hours) {
    const auto nanoseconds = static_cast<std::int64_t>(hours * static_cast<double>(hour));
    const std::int64_t time = FileSystem().now() - nanoseconds;
    const timespec times[2] = {{0, UTIME_OMIT}, {time / 1'000'000'000, time % 1'000'000'000}};
    ASSERT_EQ(::utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
  }
  bool has(const Digest& digest) const { return fs::exists(place_of(root, "cas", digest)); }
  bool has_action(int i) const { return fs::exists(place_of(root, "ac", key_of(i))); }
  /// The sizes of all files that count, found without the store.
  std::uint64_t on_disk() const {
    std::uint64_t sum = 0;
    for (const char* top : {"cas", "ac", "files", "quarantine"}) {
      for (const auto& file : fs::recursive_directory_iterator(root + "/" + top)) {
        if (file.is_regular_file()) sum += (file.file_size() + block - 1) / block * block;
      }
    }
    return sum;
  }
  std::set<std::string> everything() const {
    std::set<std::string> paths;
    for (const char* top : {"cas", "ac", "files", "quarantine", "pins"}) {
      for (const auto& file : fs::recursive_directory_iterator(root + "/" + top)) paths.insert(file.path());
    }
    return paths;
  }
  std::vector<Digest> order() const {
    std::vector<Digest> digests;
    for (const CachedArtifact& artifact : read_contents(*open()).artifacts)
      digests.push_back(artifact.digest);
    return digests;
  }
  Collected collect_to(std::uint64_t limit, bool dry_run = false) const {
    return collect(*open(), {limit, limit, dry_run, true});
  }

  const test::TempFolder folder;
  const std::string root = folder.file("cache");
  const std::shared_ptr<FaultyFileSystem> files = std::make_shared<FaultyFileSystem>();
};

}  // namespace ballflow
