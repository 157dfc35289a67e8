#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "ballflow/gc.hpp"
#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/viewer_page.hpp"
#include "show/page/page.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  std::vector<std::string> names;
  std::string output = "view.html", max_size;
};

std::uint64_t page_bytes(const std::string& size) {
  if (size.empty()) return show::default_page_bytes;
  if (const auto bytes = parse_size(size)) return *bytes;
  throw Error(ExitCode::usage, "--max-size " + size + ": not a size",
              "write it as 64M, 1G, or a number of bytes");
}

int view(const Common& common, const ViewArguments& arguments) {
  const std::string page_template = viewer_template(common);
  common.places->writes("--output", arguments.output);
  const auto registry = common.registry();
  const auto store = common.store();
  show::Page page(*registry, page_bytes(arguments.max_size));
  std::vector<std::string> names = arguments.names;
  if (names.empty()) names.push_back("latest");
  for (const std::string& name : names) {
    if (is_run(*store, name)) {
      page.add_run(named_run(common, *store, name));
    } else {
      const std::string file = fs::path(name).filename().string();
      page.add_artifact(file.size() == 64 ? file.substr(0, 12) : file, find_artifact(common, name));
    }
  }
  const bool live = isatty(STDERR_FILENO) != 0;
  show::PageSources sources;
  sources.load = [&store](const Digest& digest) { return cached_artifact(*store, digest); };
  sources.describe = [](const OutputEntry& output) { return describe(output); };
  sources.progress = [live](std::size_t done, std::size_t of, std::uint64_t bytes) {
    if (!live) return;
    std::fprintf(stderr, "\r\033[K  %zu of %zu artifacts, %.1f MB", done, of,
                 static_cast<double>(bytes) / 1e6);
  };
  page.pack(sources);
  if (live) std::fprintf(stderr, "\r\033[K");
  const std::string html = page.html(page_template, BALLFLOW_VERSION);
  write_atomically(arguments.output, html);
  for (const std::string& missing : page.left_out())
    std::fprintf(stderr, "not in the page: %s\n", printable(missing).c_str());
  std::printf("wrote %s (%.1f MB, %zu layers)\n", printable(arguments.output).c_str(),
              static_cast<double>(html.size()) / 1e6, page.layers());
  return 0;
}

}  // namespace

void add_view(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand(
      "view", "write a page that shows runs and artifacts in 3D, in any browser and without a network");
  const auto arguments = std::make_shared<ViewArguments>();
  command
      .option("what", arguments->names,
              "runs: an id or the beginning of one (see \"ballflow runs\"), latest, previous, a report\n"
              "file, or a folder with a report.json; artifacts: a digest from a report, a file of the\n"
              "cache, or a file of a model or of balls (OFF, OBJ, PLY, ...); default: latest")
      .type_name("RUN|ARTIFACT...");
  command.option("-o,--output", arguments->output, "page to write; default: view.html")
      .type_name("PAGE.html");
  command
      .option("--max-size", arguments->max_size,
              "leave out what would make the page larger than this; outputs of the graph come first;\n"
              "default: 64M")
      .type_name("SIZE");
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.footer("  ballflow view latest -o dragon.html");
  command.callback(
      [&common, &action, arguments] { action = [&common, arguments] { return view(common, *arguments); }; });
}

}  // namespace ballflow::cli
