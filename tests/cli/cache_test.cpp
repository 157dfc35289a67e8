// The cache as a user meets it: what is in it, its size, damage, pins.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

struct CacheCliTest : testing::Test {
  test::TempFolder folder;
  std::map<std::string, std::string> environment{{"BALLFLOW_CACHE", folder.file("cache")}};

  ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, environment);
  }
  ProcessResult cache(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "cache");
    return ballflow(std::move(arguments));
  }
  ProcessResult run(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"run",      test::source_file("graphs/medial_axis.json"),
                                       "--set",    "sampling=vertices",
                                       "--set",    "growth=additive",
                                       "--set",    "repair=none",
                                       "--set",    "input=shape:torus?n=1000",
                                       "--out",    folder.file("out"),
                                       "--report", folder.file("report.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ballflow(arguments);
  }
  std::map<std::string, std::string> statuses() {
    const json report = json::parse(test::read_file(folder.file("report.json")));
    std::map<std::string, std::string> result;
    for (const auto& [path, node] : report.at("nodes").items()) result[path] = node.at("status");
    return result;
  }
  /// Paths of the artifacts in the cache.
  std::vector<std::string> artifacts() {
    std::vector<std::string> paths;
    for (const auto& file : fs::recursive_directory_iterator(folder.file("cache/cas"))) {
      if (file.is_regular_file()) paths.push_back(file.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
  }
  static std::string digest_of(const std::string& path) {
    const fs::path place(path);
    return place.parent_path().filename().string() + place.filename().string();
  }
  std::uint64_t artifact_bytes() {
    std::uint64_t sum = 0;
    for (const std::string& path : artifacts()) sum += fs::file_size(path);
    return sum;
  }
  static std::vector<std::string> lines(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> result;
    for (std::string line; std::getline(in, line);) result.push_back(line);
    return result;
  }
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
};

}  // namespace

TEST_F(CacheCliTest, stat_ls_and_du_tell_what_is_there) {
  ASSERT_EQ(run().exit_code, 0);
  const ProcessResult stat = cache({"stat", "--cache", folder.file("cache")});
  EXPECT_EQ(stat.exit_code, 0);
  for (const char* word : {"folder", "on the disk", "limit", "artifacts", "actions", "pins"}) {
    EXPECT_TRUE(contains(stat.out, word)) << stat.out;
  }
  const ProcessResult ls = cache({"ls"});
  EXPECT_EQ(ls.exit_code, 0);
  for (const std::string& path : artifacts()) {
    EXPECT_TRUE(contains(ls.out, digest_of(path).substr(0, 16))) << path;
  }
  EXPECT_TRUE(contains(ls.out, "PoleSet") || contains(ls.out, "Balls")) << ls.out;
  const ProcessResult du = cache({"du"});
  EXPECT_EQ(du.exit_code, 0);
  for (const char* node : {"VoronoiPoles", "LabelPoles", "MedialAxis", "all"}) {
    EXPECT_TRUE(contains(du.out, node)) << du.out;
  }
  EXPECT_FALSE(contains(du.out, "(no action)")) << du.out;
}

TEST_F(CacheCliTest, an_empty_cache_is_no_error) {
  for (const char* command : {"stat", "ls", "du", "gc", "verify"}) {
    EXPECT_EQ(cache({command}).exit_code, 0) << command;
  }
}

TEST_F(CacheCliTest, gc_goes_down_to_the_size_and_the_next_run_makes_the_same) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string medial_axis = test::read_file(folder.file("out/medial_axis.ply"));
  const auto before = artifacts();

  const ProcessResult dry = cache({"gc", "--dry-run", "--size", "0"});
  EXPECT_EQ(dry.exit_code, 0);
  EXPECT_EQ(artifacts(), before);
  for (const std::string& path : before) EXPECT_TRUE(contains(dry.out, digest_of(path)));

  EXPECT_EQ(cache({"gc", "--size", "100K"}).exit_code, 0);
  EXPECT_LE(artifact_bytes(), 100u * 1024);
  EXPECT_EQ(cache({"gc", "--size", "0"}).exit_code, 0);
  EXPECT_TRUE(artifacts().empty());
  fs::remove_all(folder.file("out"));
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_EQ(test::read_file(folder.file("out/medial_axis.ply")), medial_axis);
}

TEST_F(CacheCliTest, a_run_keeps_the_cache_within_its_size) {
  ASSERT_EQ(run({"--cache-size", "none"}).exit_code, 0);
  ASSERT_GT(artifact_bytes(), 200u * 1024);
  ASSERT_EQ(run({"--cache-size", "200K", "--set", "epsilon=0.4"}).exit_code, 0);
  EXPECT_LE(artifact_bytes(), 200u * 1024);
  environment["BALLFLOW_CACHE_SIZE"] = "50K";
  ASSERT_EQ(run({"--set", "epsilon=0.5"}).exit_code, 0);
  EXPECT_LE(artifact_bytes(), 50u * 1024);
}

TEST_F(CacheCliTest, sizes_that_are_none_are_refused_before_anything_runs) {
  const ProcessResult option = run({"--cache-size", "much"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_TRUE(contains(option.err, "\"much\" is not a size")) << option.err;
  EXPECT_FALSE(fs::exists(folder.file("report.json")));
  EXPECT_EQ(cache({"gc", "--size", "-1"}).exit_code, 2);
  environment["BALLFLOW_CACHE_SIZE"] = "5X";
  const ProcessResult variable = run();
  EXPECT_EQ(variable.exit_code, 2);
  EXPECT_TRUE(contains(variable.err, "BALLFLOW_CACHE_SIZE")) << variable.err;
}

TEST_F(CacheCliTest, a_pinned_artifact_survives_collection_until_it_is_unpinned) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string path = artifacts().front();
  const std::string digest = digest_of(path);
  EXPECT_EQ(cache({"pin", digest.substr(0, 12)}).exit_code, 0);
  const auto listed = lines(cache({"ls"}).out);
  EXPECT_EQ(
      std::count_if(listed.begin(), listed.end(), [](const std::string& l) { return contains(l, "pinned"); }),
      1);
  const ProcessResult gc = cache({"gc", "--size", "0"});
  EXPECT_EQ(gc.exit_code, 0);
  EXPECT_TRUE(contains(gc.out, "more than the limit is left")) << gc.out;
  EXPECT_EQ(artifacts(), std::vector<std::string>{path});
  EXPECT_EQ(cache({"unpin", digest.substr(0, 12)}).exit_code, 0);
  EXPECT_EQ(cache({"unpin", digest}).exit_code, 2) << "it is not pinned any more";
  EXPECT_EQ(cache({"gc", "--size", "0"}).exit_code, 0);
  EXPECT_TRUE(artifacts().empty());
  EXPECT_EQ(cache({"pin", digest}).exit_code, 2) << "it is not there any more";
  EXPECT_EQ(cache({"pin", "ab"}).exit_code, 2);
}

TEST_F(CacheCliTest, damage_is_found_and_healed_by_the_next_run) {
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_EQ(cache({"verify"}).exit_code, 0);
  EXPECT_EQ(cache({"verify", "--full"}).exit_code, 0);
  const std::string medial_axis = test::read_file(folder.file("out/medial_axis.ply"));
  const auto paths = artifacts();
  for (const std::string& path : paths) {
    std::string bytes = test::read_file(path);
    bytes.back() = static_cast<char>(bytes.back() ^ 4);
    fs::remove(path);
    test::write_file(path, bytes);
    fs::permissions(path, fs::perms(0444));
  }
  const ProcessResult found = cache({"verify"});
  EXPECT_EQ(found.exit_code, 5);
  EXPECT_TRUE(contains(found.out, "moved to quarantine")) << found.out;
  EXPECT_TRUE(contains(found.out, std::to_string(paths.size()) + " bad")) << found.out;
  EXPECT_EQ(cache({"verify"}).exit_code, 0) << "what is bad is out of the way";
  fs::remove_all(folder.file("out"));
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_EQ(test::read_file(folder.file("out/medial_axis.ply")), medial_axis);
  EXPECT_EQ(cache({"verify", "--full"}).exit_code, 0);
  for (const auto& [path, status] : statuses()) EXPECT_NE(status, "failed") << path;
}

}  // namespace ballflow
