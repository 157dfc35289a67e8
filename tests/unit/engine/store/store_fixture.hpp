// A store in a folder of its own, on a file system that fails on demand.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "ballflow/error.hpp"
#include "ballflow/store.hpp"
#include "faulty_file_system.hpp"
#include "probe.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace fs = std::filesystem;
using test::action_for;
using test::entry_for;
using test::FaultyFileSystem;
using test::make_probe;
using test::place_of;

inline std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

inline std::size_t files_below(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) count += entry.is_regular_file() ? 1 : 0;
  return count;
}

inline std::string refusal(const StoreOptions& options, const std::shared_ptr<FileSystem>& files = {}) {
  try {
    Store::open(options, files);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::store);
    EXPECT_FALSE(error.hint().empty());
    return error.what();
  }
  return "opened";
}

class StoreTest : public ::testing::Test {
 protected:
  std::shared_ptr<Store> open() const { return Store::open({root}, files); }

  const test::TempFolder folder;
  const std::string root = folder.file("a cache/with spaces");
  const std::shared_ptr<FaultyFileSystem> files = std::make_shared<FaultyFileSystem>();
  const ArtifactPtr probe = make_probe(1);
  const ActionEntry action = action_for(*probe);
  const Digest key = sha256("key");
};

}  // namespace ballflow
