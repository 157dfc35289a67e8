// Whose folders and files are believed: links, modes, owners.
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "store_fixture.hpp"

namespace ballflow {
namespace {

class TrustTest : public StoreTest {};

}  // namespace

TEST_F(TrustTest, a_store_of_the_superuser_serves_others_read_only) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs to become another user";
  open()->put_blob(*probe, false);
  fs::permissions(folder.path(), fs::perms{0755});
  const pid_t child = ::fork();
  if (child == 0) {
    if (::setgid(65534) != 0 || ::setuid(65534) != 0) ::_exit(9);
    const auto store = Store::open({root});
    const bool good = store->read_only() && store->why().find("Permission denied") != std::string::npos &&
                      store->load(entry_for(*probe)) != nullptr && !store->put_blob(*make_probe(2), false);
    ::_exit(good ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(TrustTest, folders_that_others_may_write_are_refused) {
  open();
  for (const std::string& place : {root, root + "/cas", root + "/ac", root + "/tmp", root + "/files"}) {
    for (const unsigned mode : {0775u, 0757u, 0777u, 01777u}) {
      ASSERT_EQ(::chmod(place.c_str(), mode), 0);
      const std::string text = refusal({root});
      EXPECT_NE(text.find("can be written by other users"), std::string::npos) << place << ' ' << text;
      EXPECT_NE(text.find(place), std::string::npos) << text;
      EXPECT_NE(refusal({root, true}), "opened") << "reading is what must not be trusted";
    }
    ASSERT_EQ(::chmod(place.c_str(), 0755), 0);
  }
  EXPECT_EQ(refusal({root}), "opened");
}

TEST_F(TrustTest, a_folder_of_another_user_is_refused) {
  open();
  files->after_status = [](struct stat& status) { status.st_uid = ::geteuid() + 4242; };
  EXPECT_NE(refusal({root}, files).find("belongs to another user"), std::string::npos);
  if (::geteuid() == 0) {
    ASSERT_EQ(::chown(root.c_str(), 4242, 4242), 0);
    EXPECT_NE(refusal({root}).find("belongs to another user (id 4242)"), std::string::npos);
  }
}

TEST_F(TrustTest, a_wide_open_umask_does_not_make_it_untrusted) {
  const mode_t before = ::umask(0);
  open()->put_blob(*probe, false);
  open()->put_action(key, action);
  ::umask(before);
  EXPECT_NE(open()->load(entry_for(*probe)), nullptr);
  EXPECT_TRUE(open()->find_action(key));
}

TEST_F(TrustTest, the_root_may_be_a_link_but_nothing_inside) {
  open()->put_blob(*probe, false);
  const std::string alias = folder.file("alias");
  fs::create_directory_symlink(root, alias);
  EXPECT_NE(Store::open({alias})->load(entry_for(*probe)), nullptr);

  fs::rename(root + "/cas", folder.file("elsewhere"));
  fs::create_directory_symlink(folder.file("elsewhere"), root + "/cas");
  EXPECT_NE(refusal({root}).find("\"cas\" is a link"), std::string::npos);
}

TEST_F(TrustTest, a_linked_subfolder_is_neither_read_nor_written) {
  const auto store = open();
  store->put_blob(*probe, false);
  store->put_action(key, action);
  for (const std::string& place : {place_of(root, "cas", probe->digest()), place_of(root, "ac", key)}) {
    const std::string shard = fs::path(place).parent_path();
    fs::rename(shard, folder.file("elsewhere"));
    fs::create_directory_symlink(folder.file("elsewhere"), shard);
    const bool blob_moved = place.starts_with(root + "/cas/");
    EXPECT_EQ(store->load(entry_for(*probe)) == nullptr, blob_moved);
    EXPECT_EQ(store->has_blob(entry_for(*probe)), !blob_moved);
    EXPECT_EQ(store->find_action(key).has_value(), blob_moved);
    const auto before = names_in(folder.file("elsewhere"));
    fs::remove(folder.file("elsewhere") + "/" + before.front());
    const bool blob = store->put_blob(*probe, false), entry = store->put_action(key, action).stored;
    EXPECT_EQ(blob, !blob_moved);
    EXPECT_EQ(entry, blob_moved);
    EXPECT_TRUE(names_in(folder.file("elsewhere")).empty()) << "written through the link";
    fs::remove(shard);
    fs::remove_all(folder.file("elsewhere"));
    EXPECT_TRUE(store->put_blob(*probe, false));
    EXPECT_TRUE(store->put_action(key, action));
  }
}

TEST_F(TrustTest, a_linked_file_is_a_miss_and_is_replaced) {
  const auto store = open();
  store->put_blob(*probe, false);
  store->put_action(key, action);
  for (const std::string& place : {place_of(root, "cas", probe->digest()), place_of(root, "ac", key)}) {
    const std::string elsewhere = folder.file(fs::path(place).filename());
    fs::rename(place, elsewhere);
    fs::create_symlink(elsewhere, place);
  }
  EXPECT_FALSE(store->has_blob(entry_for(*probe)));
  EXPECT_EQ(store->load(entry_for(*probe)), nullptr);
  EXPECT_FALSE(store->find_action(key));
  EXPECT_TRUE(store->put_blob(*probe, false));
  EXPECT_TRUE(store->put_action(key, action));
  EXPECT_NE(store->load(entry_for(*probe)), nullptr);
  EXPECT_TRUE(store->find_action(key));
  EXPECT_FALSE(fs::is_symlink(place_of(root, "cas", probe->digest())));
}

TEST_F(TrustTest, files_that_others_may_write_are_misses) {
  const auto store = open();
  store->put_blob(*probe, false);
  store->put_action(key, action);
  ASSERT_EQ(::chmod(place_of(root, "cas", probe->digest()).c_str(), 0666), 0);
  ASSERT_EQ(::chmod(place_of(root, "ac", key).c_str(), 0666), 0);
  EXPECT_FALSE(store->find_action(key));
  EXPECT_FALSE(store->has_blob(entry_for(*probe)));
  EXPECT_EQ(store->load(entry_for(*probe)), nullptr);
}

TEST_F(TrustTest, pipes_and_folders_in_the_place_of_files_are_misses) {
  for (const bool pipe : {true, false}) {
    const auto store = open();
    for (const std::string& place : {place_of(root, "cas", probe->digest()), place_of(root, "ac", key)}) {
      fs::create_directories(fs::path(place).parent_path());
      ASSERT_EQ(pipe ? ::mkfifo(place.c_str(), 0600) : ::mkdir(place.c_str(), 0700), 0);
    }
    EXPECT_EQ(store->load(entry_for(*probe)), nullptr);
    EXPECT_FALSE(store->find_action(key));
    EXPECT_TRUE(store->put_blob(*probe, false));
    EXPECT_NE(store->load(entry_for(*probe)), nullptr);
    EXPECT_EQ(store->put_action(key, action).stored, pipe) << "a file does not replace a folder";
    fs::remove_all(root);
  }
}

}  // namespace ballflow
