// Records of submissions that nobody needs any more.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "cluster/submission.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct SubmissionsTest : testing::Test {
  static constexpr std::int64_t day = 86400;

  void submit(const std::string& run, const std::string& same) {
    Submission submission;
    submission.run = run;
    submission.same = same;
    submission.arrays.emplace_back().job = run;
    submissions.make(run);
    submissions.write(submission);
    write_status(submissions.folder(run), "0-0", {});
  }
  void make_old(const std::string& run) {
    const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(50);
    for (const auto& entry : fs::recursive_directory_iterator(submissions.folder(run)))
      fs::last_write_time(entry.path(), long_ago);
    fs::last_write_time(submissions.folder(run), long_ago);
  }
  SubmissionsCollected collect(bool dry_run = false) {
    return submissions.collect(day, dry_run, [](const Submission& run) { return run.run == "waits"; });
  }
  bool is_there(const std::string& name) const { return fs::exists(root + '/' + name); }

  const test::TempFolder folder;
  const std::string root = folder.file("submissions");
  const Submissions submissions{folder.path()};
};

TEST_F(SubmissionsTest, old_ones_go_unless_their_jobs_wait_or_run) {
  EXPECT_EQ(collect().removed + collect().left, 0u) << "there are none";
  for (const char* run : {"old", "waits", "young", "writes"}) submit(run, std::string(run) + "-same");
  for (const char* run : {"old", "waits", "writes"}) make_old(run);
  write_progress(submissions.folder("writes"), "0-1", {});
  EXPECT_EQ(collect(true).removed, 1u);
  EXPECT_TRUE(is_there("old")) << "a dry run";
  const SubmissionsCollected done = collect();
  EXPECT_EQ(done.removed, 1u);
  EXPECT_EQ(done.left, 3u);
  EXPECT_TRUE(done.why.empty()) << done.why;
  EXPECT_FALSE(is_there("old"));
  EXPECT_FALSE(is_there("of-old-same"));
  EXPECT_FALSE(submissions.latest_of("old-same"));
  for (const char* run : {"waits", "young", "writes"}) {
    EXPECT_TRUE(is_there(run)) << run;
    EXPECT_EQ(submissions.latest_of(std::string(run) + "-same")->run, run);
  }
}

TEST_F(SubmissionsTest, nodes_took_what_they_took_on_the_average_of_some_units) {
  EXPECT_TRUE(submissions.usual_seconds().empty());
  for (const char* run : {"1", "2"}) {
    submit(run, "same");
    UnitStatus status;
    for (const double seconds : {1.0, 3.0})
      status.nodes.push_back({"a", "Toy", "run", std::nullopt, {}, {}, seconds});
    status.nodes.push_back({"b", "Other", "hit", std::nullopt, {}, {}, 0});
    status.nodes.push_back({"c", "Other", "failed", std::nullopt, {}, {}, 9});
    Submission submission = submissions.read(run);
    submission.arrays[0].units = 1000;
    submissions.write(submission);
    write_status(submissions.folder(run), "0-0", status);
    status.nodes[0].seconds = 7;
    write_status(submissions.folder(run), "0-999", status);
    status.nodes[0].seconds = 1e9;
    write_status(submissions.folder(run), "0-1", status);  // not one of the few that are looked at
  }
  test::write_file(submissions.folder("2") + "/submission.json", "{");
  EXPECT_EQ(submissions.usual_seconds(), (std::map<std::string, double>{{"Toy", 3.5}}));
}

TEST_F(SubmissionsTest, a_damaged_one_goes_and_a_link_is_left_alone) {
  submit("damaged", "d");
  test::write_file(submissions.folder("damaged") + "/submission.json", "{");
  make_old("damaged");
  fs::create_directory(folder.file("elsewhere"));
  test::write_file(folder.file("elsewhere/file"), "x");
  fs::create_directory_symlink(folder.file("elsewhere"), root + "/link");
  EXPECT_EQ(collect().removed, 1u);
  EXPECT_FALSE(is_there("damaged"));
  EXPECT_TRUE(is_there("link/file"));
}

}  // namespace
}  // namespace ballflow
