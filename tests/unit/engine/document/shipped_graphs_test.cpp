// Graphs that come with ballflow are found by name, and files of the user come first.
#include "ballflow/shipped_graphs.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "ballflow/error.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct ShippedGraphs : testing::Test {
  ShippedGraphs() {
    test::write_file(graphs + "/medial_axis.json",
                     R"({ "doc": "A stable\n  axis. ", /* two lines */ "nodes": {} })");
    test::write_file(graphs + "/minkowski_sum.json", R"({ "nodes": {} })");
    test::write_file(graphs + "/minkowski_2d.json", "{}");
    test::write_file(graphs + "/README.md", "no graph");
    test::write_file(graphs + "/experiments/table_3_3.json", R"({ "doc": "A table." })");
    test::write_file(graphs + "/strategies/greedy.json", R"({ "doc": "A part." })");
    fs::current_path(folder.path());
  }
  ~ShippedGraphs() override { fs::current_path(before); }

  /// The words of the error, or the file that was found.
  std::string find(const std::string& text) const {
    try {
      return find_graph(text, graphs);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what() + (" | " + error.hint());
    }
  }

  fs::path before = fs::current_path();
  test::TempFolder folder;
  std::string graphs = folder.file("share/ballflow/graphs");
};

TEST_F(ShippedGraphs, are_listed_by_name_with_their_doc_on_one_line) {
  std::vector<std::string> lines;
  for (const ShippedGraph& graph : shipped_graphs(graphs)) {
    EXPECT_TRUE(fs::is_regular_file(graph.file)) << graph.file;
    lines.push_back(graph.name + ": " + graph.doc);
  }
  EXPECT_EQ(lines, (std::vector<std::string>{"medial_axis: A stable axis.", "minkowski_2d: ",
                                             "minkowski_sum: ", "experiments/table_3_3: A table."}));
  EXPECT_EQ(
      shipped_graph_names(graphs),
      (std::vector<std::string>{"medial_axis", "minkowski_2d", "minkowski_sum", "experiments/table_3_3"}));
}

TEST_F(ShippedGraphs, lie_beside_the_node_libraries_they_belong_to) {
  EXPECT_EQ(shipped_graphs_folder("/opt/x/lib/ballflow"), "/opt/x/share/ballflow/graphs");
  EXPECT_EQ(shipped_graphs_folder(folder.file("lib/ballflow")), graphs);
}

TEST_F(ShippedGraphs, are_missed_with_an_error_but_names_are_just_none) {
  EXPECT_TRUE(shipped_graph_names(folder.file("nowhere")).empty());
  EXPECT_THROW(shipped_graphs(folder.file("nowhere")), Error);
}

TEST_F(ShippedGraphs, are_found_by_name) {
  EXPECT_EQ(find("medial_axis"), graphs + "/medial_axis.json");
  EXPECT_EQ(find("experiments/table_3_3"), graphs + "/experiments/table_3_3.json");
}

TEST_F(ShippedGraphs, come_after_a_file_of_that_path_but_before_a_folder) {
  fs::create_directory(folder.file("medial_axis"));  // --out medial_axis
  EXPECT_EQ(find("medial_axis"), graphs + "/medial_axis.json");
  fs::remove(folder.file("medial_axis"));
  test::write_file(folder.file("medial_axis"), "{}");
  EXPECT_EQ(find("medial_axis"), "medial_axis");
}

TEST_F(ShippedGraphs, leave_paths_as_they_are) {
  for (const char* path : {"/dev/null", "absent.json", "./absent", "/absent", "graphs/absent.json", ""})
    EXPECT_EQ(find(path), path);
}

TEST_F(ShippedGraphs, that_are_misspelt_or_unknown_are_errors_with_the_nearest_names) {
  const std::string unknown = ", and no graph of this name comes with ballflow | ";
  EXPECT_EQ(find("medial_axs"),
            "there is no file \"medial_axs\"" + unknown + "did you mean \"medial_axis\"?");
  EXPECT_EQ(find("minkowski"), "there is no file \"minkowski\"" + unknown +
                                   "did you mean \"minkowski_2d\" or \"minkowski_sum\"?");
  EXPECT_EQ(find("table_3_3"),
            "there is no file \"table_3_3\"" + unknown + "did you mean \"experiments/table_3_3\"?");
  EXPECT_EQ(find("strategies/greedy"), "there is no file \"strategies/greedy\"" + unknown +
                                           "\"ballflow graph --list\" lists those that do");
  EXPECT_EQ(find("graphs/medial_axis.json"),
            "there is no file \"graphs/medial_axis.json\" | did you mean \"medial_axis\", which comes with "
            "ballflow?");
}

}  // namespace
}  // namespace ballflow
