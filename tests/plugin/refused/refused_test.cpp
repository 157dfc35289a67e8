// Node libraries that cannot be used are refused with a reason, before any of their code runs where the file
// alone tells, and the program goes on.
#include <elf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>

#include "ballflow/error.hpp"
#include "ballflow/key.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/run.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

std::string library(const std::string& name) { return std::string(REFUSED_LIBRARIES) + "/" + name + ".so"; }

/// A folder with copies of libraries.
class plugin : public testing::Test {
 protected:
  void SetUp() override { unsetenv("BALLFLOW_PLUGIN_PATH"); }
  std::string copy(const std::string& name) {
    fs::copy_file(library(name), folder_.file(name + ".so"), fs::copy_options::overwrite_existing);
    return folder_.file(name + ".so");
  }
  std::string write(const std::string& name, const std::string& bytes) {
    test::write_file(folder_.file(name), bytes);
    return folder_.file(name);
  }
  /// The reason why a file of the folder was refused.
  std::string reason(const std::string& name) {
    const auto registry = Registry::load({folder_.path()});
    for (const PluginCandidate& candidate : registry->candidates()) {
      if (candidate.path == folder_.file(name + ".so")) return candidate.refused;
    }
    return "not a candidate";
  }
  test::TempFolder folder_;
};

TEST_F(plugin, loads_with_its_nodes_and_types) {
  const auto registry = Registry::load({library("good")});
  ASSERT_NE(registry->node("MakeToy"), nullptr);
  EXPECT_EQ(registry->node("MakeToy")->plugin_path, library("good"));
  EXPECT_EQ(registry->node("MakeToy")->params.at(0).default_value, 1.0);
  ASSERT_NE(registry->node("MakeToy")->entry, nullptr);
  ASSERT_NE(registry->type("Toy"), nullptr);
  EXPECT_TRUE(registry->type("Toy")->arrays.at(0).shape.empty());
  const PluginCandidate& candidate = registry->candidates().at(0);
  EXPECT_EQ(candidate.name, "good");
  EXPECT_EQ(candidate.version, "1.2.3");
  EXPECT_EQ(candidate.refused, "");
}

TEST_F(plugin, of_another_abi_is_refused_before_its_code_runs) {
  copy("wrong_abi");
  EXPECT_EQ(reason("wrong_abi"),
            "is built for plugin ABI 3, this program has plugin ABI 2: rebuild it against the headers of "
            "this version");
  copy("old_abi");
  EXPECT_EQ(reason("old_abi"),
            "is built for plugin ABI 1, this program has plugin ABI 2: rebuild it against the headers of "
            "this version");
}

TEST_F(plugin, any_other_library_is_refused_before_its_code_runs) {
  copy("no_note");
  EXPECT_EQ(reason("no_note"),
            "is no node library: it has no section .ballflow.abi (see BALLFLOW_PLUGIN in ballflow/sdk.hpp)");
}

TEST_F(plugin, files_that_are_no_libraries) {
  write("text.so", "hello");
  write("empty.so", "");
  write("short.so",
        "\x7f"
        "ELF");
  fs::create_directory(folder_.file("folder.so"));
  fs::create_symlink("/nowhere", folder_.file("dangling.so"));
  EXPECT_EQ(reason("text"), "is no ELF file (no shared library)");
  EXPECT_EQ(reason("empty"), "is no ELF file (no shared library)");
  EXPECT_EQ(reason("short"), "is truncated: its ELF header is cut off");
  EXPECT_EQ(reason("folder"), "is no regular file");
  EXPECT_EQ(reason("dangling"), "cannot be read: No such file or directory");
}

TEST_F(plugin, libraries_of_other_machines) {
  const std::string good = test::read_file(library("good"));
  Elf64_Ehdr header;
  const auto with = [&](auto change) {
    std::memcpy(&header, good.data(), sizeof header);
    change(header);
    std::string bytes = good;
    std::memcpy(bytes.data(), &header, sizeof header);
    return refuse_plugin_file(write("changed.so", bytes));
  };
  EXPECT_EQ(with([](Elf64_Ehdr&) {}), "");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_ident[EI_CLASS] = ELFCLASS32; }),
            "is a 32-bit library, this program is 64-bit");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_ident[EI_DATA] = ELFDATA2MSB; }),
            "is a big-endian library, this program is little-endian");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_machine = EM_RISCV; }).substr(0, 28),
            "is built for another machine");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_type = ET_EXEC; }), "is an ELF file but no shared library");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_shoff = 0; }).substr(0, 20), "carries no ABI note:");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_shoff = ~std::uint64_t{0}; }),
            "is truncated: its section headers are cut off");
  EXPECT_EQ(with([](Elf64_Ehdr& h) { h.e_phoff = ~std::uint64_t{0} - 8; }),
            "is truncated: its program headers are cut off");
}

TEST_F(plugin, truncated_anywhere_is_refused) {
  const std::string good = test::read_file(library("good"));
  std::mt19937 random(7);
  std::vector<std::size_t> lengths = {good.size() - 1, good.size() / 2, 63, 64, 65};
  for (int i = 0; i < 100; ++i) lengths.push_back(random() % good.size());
  for (const std::size_t length : lengths) {
    EXPECT_NE(refuse_plugin_file(write("cut.so", good.substr(0, length))), "")
        << length << " of " << good.size();
  }
}

TEST_F(plugin, reading_the_note_survives_damaged_bytes) {
  std::string good = test::read_file(library("good"));
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    std::string bytes = good;
    // The headers at the front, and the section headers at the end, are what is interpreted.
    for (int k = 0; k < 4; ++k) {
      const std::size_t range = random() % 2 == 0 ? 64 + 12 * 56 : 40 * 64;
      const std::size_t at = range < 1000 ? random() % range : bytes.size() - 1 - random() % range;
      bytes[at] = static_cast<char>(random());
    }
    refuse_plugin_file(write("damaged.so", bytes));  // only reads; whether it is refused depends on the byte
  }
  // A note with a damaged magic is found and refused.
  const std::size_t note = good.find("BALLFLOW");
  ASSERT_NE(note, std::string::npos);
  std::size_t at = note;
  while (at != std::string::npos) {
    good[at] = 'X';
    at = good.find("BALLFLOW", at + 1);
  }
  EXPECT_EQ(refuse_plugin_file(write("damaged.so", good)), "is damaged: its ABI note is unreadable");
}

TEST_F(plugin, tables_that_cannot_be_used) {
  for (const char* name : {"no_entry", "null_tables", "small_tables", "malformed", "unknown_type", "good"})
    copy(name);
  EXPECT_EQ(reason("no_entry"), "exports no function ballflow_plugin");
  EXPECT_EQ(reason("null_tables"), "could not make its tables of nodes and types");
  EXPECT_EQ(reason("small_tables"), "hands over a plugin table that is too small");
  EXPECT_EQ(reason("malformed"), "node \"Half\" has no \"summary\"");
  EXPECT_EQ(
      reason("unknown_type"),
      "node \"Lonely\": port \"out\" has the type \"Nowhere\" version 1, which no loaded library declares");
  EXPECT_EQ(reason("good"), "");
  const auto registry = Registry::load({folder_.path()});
  EXPECT_NE(registry->node("MakeToy"), nullptr) << "the program goes on with the others";
  EXPECT_EQ(registry->node("Lonely"), nullptr);
}

TEST_F(plugin, named_explicitly_and_refused_is_an_error) {
  try {
    Registry::load({library("wrong_abi")});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    EXPECT_EQ(std::string(error.what()).substr(0, 17 + library("wrong_abi").size()),
              "the node library " + library("wrong_abi"));
  }
  EXPECT_THROW(Registry::load({folder_.file("absent.so")}), Error);
}

TEST_F(plugin, found_twice_is_loaded_once) {
  const std::string path = copy("good");
  fs::create_symlink(path, folder_.file("link.so"));
  setenv("BALLFLOW_PLUGIN_PATH", ("/nowhere::" + folder_.path()).c_str(), 1);
  const auto registry = Registry::load({path, folder_.path()});
  unsetenv("BALLFLOW_PLUGIN_PATH");
  // The built-in node libraries may be beside the executable or not.
  const auto& all = registry->candidates();
  EXPECT_EQ(std::count_if(all.begin(), all.end(),
                          [&](const PluginCandidate& c) { return c.path.rfind(folder_.path(), 0) == 0; }),
            1);
}

TEST_F(plugin, path_variable_adds_folders) {
  copy("good");
  EXPECT_EQ(Registry::load()->node("MakeToy"), nullptr);
  setenv("BALLFLOW_PLUGIN_PATH", folder_.path().c_str(), 1);
  EXPECT_NE(Registry::load()->node("MakeToy"), nullptr);
  unsetenv("BALLFLOW_PLUGIN_PATH");
}

TEST_F(plugin, copies_of_one_library_are_fine) {
  const std::string path = copy("good");
  const auto registry = Registry::load({library("good"), path});
  EXPECT_EQ(registry->node("MakeToy")->plugin_path, library("good"));
  EXPECT_EQ(registry->candidates().at(1).refused, "");
}

TEST_F(plugin, equal_words_of_two_different_files_are_an_error) {
  try {
    Registry::load({library("good"), library("good_again")});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    EXPECT_EQ(error.what(), "node \"MakeToy\" is declared in the same words by two different files, " +
                                library("good") + " and " + library("good_again") +
                                ", and may compute different things");
  }
}

/// The key of MakeToy as the library at `path` declares it.
ActionKey key_with(const std::string& path) {
  const auto registry = Registry::load({path});
  DagNode node{"make", *registry->node("MakeToy")};
  node.params["value"] = 1.0;
  return action_key(node, {}, 0, *Store::open({"", false}));
}

TEST_F(plugin, another_build_of_a_library_has_other_keys_and_explain_says_why) {
  const ActionKey first = key_with(copy("good"));
  const ActionKey again = key_with(copy("good_again"));  // declares the same in equal words
  EXPECT_NE(first.key.hex(), again.key.hex());
  EXPECT_EQ(manifest_differences(first.manifest, again.manifest),
            (std::vector<std::string>{"file of the node library: other content"}));
  for (const ActionKey& key : {first, again}) EXPECT_EQ(key_of(key.manifest).hex(), key.key.hex());
  EXPECT_EQ(key_with(library("good")).key.hex(), first.key.hex()) << "the content counts, not the path";
}

TEST_F(plugin, the_file_of_an_installed_library_is_in_no_key) {
  const auto registry = Registry::load({library("good")});
  EXPECT_NE(registry->node("MakeToy")->library_file, "");
  std::size_t installed = 0;  // in ../lib/ballflow beside this executable
  for (const auto& [id, node] : registry->nodes()) {
    if (fs::path(node.plugin_path).parent_path() != Registry::default_folder()) continue;
    ++installed;
    EXPECT_EQ(node.library_file, "") << id;
  }
  if (installed == 0) GTEST_SKIP() << "no node library is built";
}

TEST_F(plugin, different_declarations_under_one_name_name_both_files) {
  try {
    Registry::load({library("good"), library("other_content")});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    EXPECT_EQ(error.what(), "node \"MakeToy\" is declared differently by " + library("good") +
                                " (version 1) and by " + library("other_content") + " (version 1)");
  }
}

}  // namespace
}  // namespace ballflow
