// What libraries declare is kept in the cache folder: a registry that is made from there is the same, and no
// library is opened for it.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>

#include "ballflow/error.hpp"
#include "ballflow/file_system.hpp"
#include "ballflow/registry.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

/// Its clock is ahead, so that files that were just written count as old.
class Later : public FileSystem {
 public:
  std::int64_t now() override { return FileSystem::now() + 10'000'000'000; }
};

class library_index : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("BALLFLOW_PLUGIN_PATH");
    fs::create_directory(cache());
  }

  static std::string library(const std::string& name) {
    return std::string(REFUSED_LIBRARIES) + "/" + name + ".so";
  }
  /// A copy with this name, in the place of what was there: another file, as a build or a package writes it.
  std::string copy(const std::string& name, const std::string& as) const {
    const std::string path = folder_.file(as + ".so");
    fs::remove(path);
    fs::copy_file(library(name), path);
    return path;
  }
  std::string cache() const { return folder_.file("cache"); }
  std::string index() const { return folder_.file("cache/libraries"); }
  std::shared_ptr<const Registry> load(const std::vector<std::string>& extra) const {
    return Registry::load(extra, Registry::default_folder(), cache(), std::make_shared<Later>());
  }
  static ino_t inode(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
  }

  test::TempFolder folder_;
};

void expect_same(const Registry& a, const Registry& b) {
  ASSERT_EQ(a.nodes().size(), b.nodes().size());
  ASSERT_EQ(a.types().size(), b.types().size());
  for (const auto& [id, node] : a.nodes()) {
    const NodeDeclaration* const other = b.node(id);
    ASSERT_NE(other, nullptr) << id;
    EXPECT_TRUE(node.same_content(*other)) << id;
    EXPECT_EQ(node.plugin_path, other->plugin_path);
    EXPECT_EQ(node.library_file, other->library_file);
    EXPECT_EQ(node.lists_files, other->lists_files);
    EXPECT_EQ(node.entry->run, other->entry->run) << id;
  }
  for (const auto& [id, type] : a.types()) {
    const TypeDeclaration* const other = b.type(id);
    ASSERT_NE(other, nullptr) << id;
    EXPECT_TRUE(type.same_content(*other)) << id;
    EXPECT_EQ(type.plugin_path, other->plugin_path);
    EXPECT_EQ(type.entry->check, other->entry->check) << id;
  }
  ASSERT_EQ(a.candidates().size(), b.candidates().size());
  for (std::size_t i = 0; i < a.candidates().size(); ++i) {
    const PluginCandidate &one = a.candidates()[i], &two = b.candidates()[i];
    EXPECT_EQ(std::tie(one.path, one.name, one.version, one.refused),
              std::tie(two.path, two.name, two.version, two.refused));
  }
  EXPECT_EQ(a.folders(), b.folders());
}

TEST_F(library_index, makes_the_registry_that_opening_all_libraries_makes) {
  const std::string good = copy("good", "good");
  copy("no_note", "no_note");
  copy("unknown_type", "unknown_type");
  const auto opened = Registry::load({folder_.path()});
  expect_same(*opened, *load({folder_.path()}));
  ASSERT_TRUE(fs::exists(index()));
  const ino_t written = inode(index());
  expect_same(*opened, *load({folder_.path()}));
  EXPECT_EQ(inode(index()), written) << "nothing was added, so nothing is written";
  EXPECT_NE(opened->node("MakeToy"), nullptr);
  EXPECT_EQ(opened->node("Lonely"), nullptr);
}

TEST_F(library_index, tells_duplicates_as_opening_does) {
  const auto what = [](const std::function<void()>& load_all) {
    try {
      load_all();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  for (const char* other : {"good_again", "other_content"}) {
    load({library("good")});
    load({library(other)});
    EXPECT_EQ(what([&] {
                load({library("good"), library(other)});
              }),
              what([&] {
                Registry::load({library("good"), library(other)});
              }));
  }
}

TEST_F(library_index, that_is_damaged_is_ignored_and_written_anew) {
  const auto opened = load({library("good")});
  const std::string good = test::read_file(index());
  std::vector<std::string> damaged = {"", "bflibrary", good + "x", good.substr(0, good.size() - 1)};
  for (std::size_t i = 0; i < 40; ++i) {
    damaged.push_back(good);
    damaged.back()[i * 7919 % good.size()] ^= 4;
  }
  for (const std::string& bytes : damaged) {
    fs::remove(index());
    test::write_file(index(), bytes);
    expect_same(*opened, *load({library("good")}));
    EXPECT_EQ(test::read_file(index()), good);
  }
  fs::remove(index());
  fs::create_directory(index());
  expect_same(*opened, *load({library("good")}));
}

TEST_F(library_index, that_others_may_write_is_not_believed) {
  load({library("good")});
  const ino_t first = inode(index());
  fs::permissions(index(), fs::perms::others_write, fs::perm_options::add);
  load({library("good")});
  EXPECT_NE(inode(index()), first) << "replaced by one that is ours alone";

  fs::permissions(cache(), fs::perms::group_write, fs::perm_options::add);
  fs::remove(index());
  EXPECT_NE(load({library("good")})->node("MakeToy"), nullptr);
  EXPECT_FALSE(fs::exists(index()));
}

TEST_F(library_index, makes_no_cache_folder) {
  fs::remove(cache());
  EXPECT_NE(load({library("good")})->node("MakeToy"), nullptr);
  EXPECT_FALSE(fs::exists(cache()));
}

TEST_F(library_index, does_not_take_a_library_that_was_just_written) {
  const std::string path = copy("good", "good");
  const std::string nowhere = folder_.file("no folder");
  Registry::load({path}, nowhere, cache());  // by the real clock
  EXPECT_FALSE(fs::exists(index()));
  Registry::load({path}, nowhere, cache(), std::make_shared<Later>());
  EXPECT_TRUE(fs::exists(index()));
}

/// In another process, which leaves an index: this one has not opened what is in it.
#define INDEXED_ELSEWHERE(...) \
  EXPECT_EXIT(                 \
      {                        \
        load(__VA_ARGS__);     \
        _exit(0);              \
      },                       \
      testing::ExitedWithCode(0), "")

TEST_F(library_index, forgets_a_library_that_changed_or_went) {
  const std::string path = copy("good", "changed");
  INDEXED_ELSEWHERE({path});
  copy("other_content", "changed");
  const auto changed = load({path});
  EXPECT_EQ(changed->node("MakeToy")->params.at(0).default_value,
            Registry::load({library("other_content")})->node("MakeToy")->params.at(0).default_value);
  EXPECT_NE(changed->node("MakeToy")->library_file,
            Registry::load({library("good")})->node("MakeToy")->library_file);

  const std::string gone = copy("good", "gone");
  INDEXED_ELSEWHERE({gone});
  EXPECT_NE(test::read_file(index()).find(gone), std::string::npos);
  fs::remove(gone);
  EXPECT_THROW(load({gone}), Error);
  load({copy("good_again", "added")});
  EXPECT_EQ(test::read_file(index()).find(gone), std::string::npos);
}

// Declarations have versions of such libraries in them, and keys have the declarations.
TEST_F(library_index, counts_for_nothing_when_a_library_that_node_libraries_use_is_another_one) {
  const std::string path = copy("uses_helper", "uses_helper");
  copy("libhelper", "libhelper");
  INDEXED_ELSEWHERE({path});
  const ino_t first = inode(index());
  INDEXED_ELSEWHERE({path});
  EXPECT_EQ(inode(index()), first);
  copy("libhelper", "libhelper");
  INDEXED_ELSEWHERE({path});
  const ino_t second = inode(index());
  EXPECT_NE(second, first);

  setenv("LD_LIBRARY_PATH", folder_.path().c_str(), 1);
  INDEXED_ELSEWHERE({path});
  unsetenv("LD_LIBRARY_PATH");
  EXPECT_NE(inode(index()), second);
}

TEST_F(library_index, a_library_that_changes_before_it_is_opened_fails_with_words) {
  const std::string path = copy("good", "late");
  INDEXED_ELSEWHERE({path});
  const auto known = load({path});
  ASSERT_NE(known->node("MakeToy"), nullptr);
  copy("other_content", "late");
  try {
    static_cast<void>(known->node("MakeToy")->entry->run);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    EXPECT_EQ(error.what(), "the node library " + path + " was written while it was loaded: try again");
  }
}

// The loader gives the code that it has, so what it declares says nothing about the file that is there now.
TEST_F(library_index, does_not_take_old_code_for_a_new_file) {
  const std::string path = copy("good", "kept");
  const auto first = load({path});
  const std::string bytes = test::read_file(index());
  copy("other_content", "kept");
  const auto second = load({path});
  EXPECT_TRUE(first->node("MakeToy")->same_content(*second->node("MakeToy")));
  EXPECT_EQ(first->node("MakeToy")->library_file, second->node("MakeToy")->library_file);
  EXPECT_EQ(test::read_file(index()), bytes);
}

}  // namespace
}  // namespace ballflow
