// "ballflow spheres": collision spheres of robots and links. Reads which links there are, and runs a graph.
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "ballflow/output_file.hpp"
#include "ballflow/shipped_graphs.hpp"
#include "ballflow/text.hpp"
#include "commands/output_folder.hpp"
#include "commands/run_command.hpp"
#include "commands/spheres_findings.hpp"
#include "commands/watched.hpp"
#include "export/export.hpp"
#include "io/file_content.hpp"
#include "report/spheres_page.hpp"
#include "urdf/sample_robot.hpp"
#include "urdf/urdf.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

struct SpheresArguments {
  RunArguments run;
  std::string file, check, page, picture;
  std::vector<std::string> links, packages, per_link, formats;
  std::string mode = "enclose", within, effort;
  bool visual = false;
  double buffer = 0;
  std::uint64_t balls = 0, minimum = 4;
};

/// The exit code where a link is not proven to be in its spheres: nothing has failed, the answer is no.
constexpr int not_enclosed = 1;

constexpr const char* usual_formats[] = {"urdf", "srdf", "curobo", "xrdf", "csv"};

std::string joined(const std::vector<std::string>& texts, const char* separator) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
  return all;
}

bool is_scheme(const std::string& file, std::string_view scheme) { return file.starts_with(scheme); }

/// The text of the file when it is a robot's; else none.
std::optional<std::string> robot_text(const Common& common, const std::string& file) {
  if (is_scheme(file, geometry::sample_robot_scheme)) return geometry::sample_robot(file);
  if (is_scheme(file, "shape:")) return std::nullopt;
  common.places->reads("the robot or link", file);
  constexpr std::int64_t most_bytes = std::int64_t{2} << 30;
  const geometry::FileContent content = geometry::read_file_content(file, most_bytes);
  const std::string_view text = content.view();
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '<') return std::nullopt;
  return std::string(text);
}

[[noreturn]] void throw_usage(const geometry::InputError& error) {
  const std::string text = error.what();
  const std::size_t split = text.find('\n');
  throw Error(ExitCode::usage, text.substr(0, split),
              split == std::string::npos ? "" : text.substr(split + 1));
}

/// Names of the links that the command is about.
std::vector<std::string> links_of(const SpheresArguments& arguments, const std::string& text) {
  const geometry::Urdf urdf = geometry::parse_urdf(text, arguments.file);
  std::vector<std::string> known = geometry::links_with_shapes(urdf, arguments.visual);
  if (known.empty()) {
    throw Error(
        ExitCode::usage,
        arguments.file + ": no link has a shape that is meant " +
            (arguments.visual ? "to be seen" : "for collisions"),
        arguments.visual ? "leave out --visual" : "--visual takes the shapes that are meant to be seen");
  }
  if (arguments.links.empty()) return known;
  for (const std::string& name : arguments.links) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest(name, known);
    throw Error(ExitCode::usage, arguments.file + " has no link \"" + name + "\" with a shape",
                near.empty() ? "its links are " + joined(known, ", ") : "did you mean \"" + near + "\"?");
  }
  return arguments.links;
}

std::string graph_file(const std::string& name) {
  return (fs::path(shipped_graphs_folder()) / name).string();
}

std::string list_text(const std::vector<std::string>& names) {
  return Json(names).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string digest_of(Store& store, const std::string& file) {
  return fs::is_regular_file(file) ? store.file_digest(file).hex() : std::string();
}

bool is_markdown(const std::string& file) { return file.ends_with(".md") || file.ends_with(".markdown"); }

/// What a page says of spheres that are checked, or made.
report::SpheresCheck page_of(const Common& common, const SpheresArguments& arguments, bool is_robot,
                             std::vector<report::LinkCheck> checks) {
  const bool made = arguments.check.empty();
  const auto store = common.store();
  report::SpheresCheck page;
  page.robot = fs::path(arguments.file).filename().string();
  page.robot_digest = digest_of(*store, arguments.file);
  page.spheres =
      made ? "ballflow spheres, mode " + arguments.mode : fs::path(arguments.check).filename().string();
  if (!made) page.spheres_digest = digest_of(*store, arguments.check);
  if (is_robot) page.geometry = arguments.visual ? "visual" : "collision";
  page.buffer = made ? 0 : arguments.buffer;
  page.mode = made ? arguments.mode : "";
  page.enclosing = !made || arguments.mode == "enclose";
  page.links = std::move(checks);
  page.version = BALLFLOW_VERSION;
  return page;
}

void claim_pages(const Common& common, const SpheresArguments& arguments) {
  common.places->writes("--page", arguments.page);
  common.places->writes("--picture", arguments.picture);
}

/// Draws, and writes the page and the picture that are wished for. Returns their files.
std::vector<std::string> write_page(const SpheresArguments& arguments, report::SpheresCheck& page,
                                    const Dag& dag, const LoadArtifact& load) {
  const bool html = !arguments.page.empty() && !is_markdown(arguments.page);
  if (html || !arguments.picture.empty()) {
    watched("no page or picture was written", [&](geometry::Monitor& monitor) {
      page.pictures = link_pictures(dag, page, load, html ? 2 : 1, monitor);
    });
  }
  std::vector<std::string> written;
  if (!arguments.page.empty()) {
    write_atomically(arguments.page, html ? report::html_page(page) : report::markdown_page(page));
    written.push_back(arguments.page);
  }
  if (!arguments.picture.empty() && !page.pictures.empty()) {
    write_atomically(arguments.picture, page.pictures.front().png);
    written.push_back(arguments.picture);
  }
  return written;
}

/// Of reading; what the copies warn about is in the table.
void tell_warnings(const Dag& dag, const RunResult& result) {
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (dag.nodes[i].path.find('/') != std::string::npos || dag.nodes[i].path == "verify" ||
        dag.nodes[i].path == "measure")
      continue;
    for (const std::string& warning : result.nodes[i].warnings)
      std::fprintf(stderr, "warning: %s\n", printable(warning).c_str());
  }
}

int check(const Common& common, SpheresArguments arguments) {
  std::vector<std::string> links;
  bool is_robot = false;
  GraphArguments& graph = arguments.run.graph;
  try {
    if (const std::optional<std::string> text = robot_text(common, arguments.file)) {
      is_robot = true;
      links = links_of(arguments, *text);
      graph.graph = graph_file("check_spheres.json");
      graph.sets = {"robot=" + arguments.file,
                    "spheres=" + arguments.check,
                    "links=" + list_text(links),
                    std::string("geometry=") + (arguments.visual ? "visual" : "collision"),
                    "packages=" + joined(arguments.packages, ":"),
                    "buffer=" + Json(arguments.buffer).dump()};
    } else {
      if (!arguments.links.empty() || arguments.visual || arguments.buffer != 0)
        throw Error(ExitCode::usage,
                    arguments.file + " is a mesh: --links, --visual and --buffer are for robots",
                    "leave them out, or give a URDF");
      links = {fs::path(arguments.file).filename().string()};
      graph.graph = graph_file("enclosure.json");
      graph.sets = {"input=" + arguments.file, "balls=" + arguments.check};
    }
  } catch (const geometry::InputError& error) {
    throw_usage(error);
  }
  claim_pages(common, arguments);
  arguments.run.table = false;
  bool enclosed = true;
  const int code =
      run_graph(common, arguments.run, [&](const Dag& dag, const RunResult& result, const auto& load) {
        report::SpheresCheck page =
            page_of(common, arguments, is_robot, link_checks(dag, result, links, load));
        enclosed = report::all_enclosed(page);
        if (!arguments.run.quiet && !arguments.run.json) {
          tell_warnings(dag, result);
          print_table(report::table(page));
          std::printf("\n%s\n", printable(report::verdict(page)).c_str());
        }
        for (const std::string& file : write_page(arguments, page, dag, load)) {
          if (!arguments.run.quiet && !arguments.run.json) std::printf("wrote %s\n", printable(file).c_str());
        }
      });
  return code == 0 && !enclosed ? not_enclosed : code;
}

/// "5mm" in metres.
double metres(const std::string& text) {
  static const std::pair<const char*, double> units[] = {
      {"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"", 1}};
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const std::string unit(error == std::errc() ? stop : end, end);
  for (const auto& [name, factor] : units) {
    if (error == std::errc() && unit == name && value >= 0 && value < 1e6) return factor * value;
  }
  throw Error(ExitCode::usage, "--within " + text + " is no length", "write it as 5mm or 0.005");
}

/// The numbers of balls that are fixed, for each link; empty when none is.
std::string fixed_counts(const SpheresArguments& arguments, const std::vector<std::string>& links) {
  if (arguments.per_link.empty()) return {};
  std::vector<std::uint64_t> counts(links.size(), 0);
  for (const std::string& text : arguments.per_link) {
    const auto [pattern, number] = split_setting("--per-link", text, "hand=24");
    std::uint64_t count = 0;
    const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), count);
    if (error != std::errc() || stop != number.data() + number.size() || count == 0)
      throw Error(ExitCode::usage, "--per-link " + text + ": \"" + number + "\" is no number of balls",
                  "hand=24,*finger=8");
    bool met = false;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (fnmatch(pattern.c_str(), links[i].c_str(), 0) != 0) continue;
      counts[i] = count;
      met = true;
    }
    if (met) continue;
    const std::string near = nearest(pattern, links);
    throw Error(ExitCode::usage, "--per-link " + text + ": no link is called so",
                near.empty() ? "links are " + joined(links, ", ") : "did you mean \"" + near + "\"?");
  }
  std::string all;
  for (const std::uint64_t count : counts) all += (all.empty() ? "" : ",") + std::to_string(count);
  return all;
}

bool all_fixed(const std::string& counts) {
  return !counts.empty() && ("," + counts + ",").find(",0,") == std::string::npos;
}

/// What a file of the robot's balls is called.
std::string sphere_file(const SpheresArguments& arguments, const std::string& format) {
  return (fs::path(arguments.run.out) / ("spheres." + extension_of("RobotSpheres", format))).string();
}

void check_formats(const std::vector<std::string>& formats) {
  const std::vector<std::string> known = export_formats("RobotSpheres");
  for (const std::string& format : formats) {
    if (std::find(known.begin(), known.end(), format) == known.end())
      throw Error(ExitCode::usage, "--format " + format + ": spheres of a robot are not written so",
                  "formats are " + joined(known, ", "));
  }
}

/// Balls for a mesh: graphs/enclose.json and its neighbours as they are.
int make_for_mesh(const Common& common, SpheresArguments arguments) {
  if (!arguments.links.empty() || !arguments.per_link.empty() || arguments.visual)
    throw Error(ExitCode::usage,
                arguments.file + " is a mesh: --links, --per-link and --visual are for robots",
                "leave them out, or give a URDF");
  GraphArguments& graph = arguments.run.graph;
  graph.graph = graph_file(arguments.mode + ".json");
  graph.sets = {"input=" + arguments.file,
                "balls=" + std::to_string(arguments.balls == 0 ? 20 : arguments.balls)};
  if (arguments.mode == "protrude" && !arguments.within.empty())
    graph.sets.insert(graph.sets.end(), {"unit=model", "within=" + Json(metres(arguments.within)).dump()});
  if (arguments.mode == "enclose" && !arguments.effort.empty())
    graph.sets.push_back("effort=" + arguments.effort);
  for (const std::string& format : arguments.formats) arguments.run.formats.push_back("balls=" + format);
  claim_pages(common, arguments);
  return run_graph(common, arguments.run, [&](const Dag& dag, const RunResult& result, const auto& load) {
    const std::vector<std::string> link = {fs::path(arguments.file).filename().string()};
    report::SpheresCheck page = page_of(common, arguments, false, link_checks(dag, result, link, load));
    const bool talk = !arguments.run.quiet && !arguments.run.json;
    for (const std::string& file : write_page(arguments, page, dag, load)) {
      if (talk) std::printf("wrote %s\n", printable(file).c_str());
    }
  });
}

int make(const Common& common, SpheresArguments arguments) {
  std::vector<std::string> links;
  try {
    const std::optional<std::string> text = robot_text(common, arguments.file);
    if (!text) return make_for_mesh(common, arguments);
    links = links_of(arguments, *text);
  } catch (const geometry::InputError& error) {
    throw_usage(error);
  }
  if (arguments.formats.empty()) arguments.formats.assign(std::begin(usual_formats), std::end(usual_formats));
  check_formats(arguments.formats);
  const std::uint64_t balls = arguments.balls == 0 ? 20 * links.size() : arguments.balls;
  const std::string fixed = fixed_counts(arguments, links);
  GraphArguments& graph = arguments.run.graph;
  graph.graph = graph_file("robot_spheres.json");
  graph.sets = {"robot=" + arguments.file,
                "links=" + list_text(links),
                "mode=" + arguments.mode,
                "balls=" + std::to_string(balls),
                "minimum=" + std::to_string(arguments.minimum),
                "fixed=" + fixed,
                std::string("geometry=") + (arguments.visual ? "visual" : "collision"),
                "packages=" + joined(arguments.packages, ":")};
  if (arguments.mode == "protrude" && !arguments.within.empty()) {
    const std::string within = Json(metres(arguments.within)).dump();
    graph.sets.insert(graph.sets.end(), {"links.within=" + within, "curves.within=" + within});
  }
  if (arguments.mode == "enclose" && !arguments.effort.empty())
    graph.sets.push_back("links.effort=" + arguments.effort);
  // Where nothing is handed out, fits tell nothing: one ball is quick.
  if (links.size() == 1 || all_fixed(fixed)) graph.sets.push_back("curves.fits=1");
  const std::string out = std::exchange(arguments.run.out, std::string());  // files of links nobody asked for
  SpheresArguments files = arguments;
  files.run.out = out;
  claim_pages(common, arguments);
  if (!out.empty()) {
    for (const std::string& format : arguments.formats)
      common.places->writes("--format " + format, sphere_file(files, format));
    prepare_folder(out);
  }
  arguments.run.table = false;
  return run_graph(common, arguments.run, [&](const Dag& dag, const RunResult& result, const auto& load) {
    report::SpheresCheck page = page_of(common, arguments, true, link_checks(dag, result, links, load));
    const bool talk = !arguments.run.quiet && !arguments.run.json;
    if (talk) {
      tell_warnings(dag, result);
      print_table(report::table(page));
      std::printf("\n%s\n", printable(report::verdict(page)).c_str());
    }
    std::vector<std::string> written;
    for (const DagOutput& output : dag.outputs) {
      if (output.name != "spheres" || out.empty()) continue;
      const ArtifactPtr artifact = load(output.from);
      for (const std::string& format : arguments.formats) {
        export_artifact(*artifact, sphere_file(files, format), format);
        written.push_back(sphere_file(files, format));
      }
    }
    page.curves = link_curves(dag, result, links);
    for (std::string& file : write_page(arguments, page, dag, load)) written.push_back(std::move(file));
    for (const std::string& file : written) {
      if (talk) std::printf("wrote %s\n", printable(file).c_str());
    }
  });
}

int spheres(const Common& common, const SpheresArguments& arguments) {
  return arguments.check.empty() ? make(common, arguments) : check(common, arguments);
}

}  // namespace

void add_spheres(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand(
      "spheres", "collision spheres of a robot or link: tell what those of another program leave out");
  const auto arguments = std::make_shared<SpheresArguments>();
  command.option("file", arguments->file, "a URDF, or the mesh of a link; robot:arm is a small robot to try")
      .required()
      .type_name("ROBOT");
  command
      .option(
          "--check", arguments->check,
          "spheres to check: cuRobo YAML, XRDF, foam or ballpark JSON, URDF, SRDF, CSV (link,x,y,z,radius);\n"
          "for a mesh balls, as in \"graphs/enclosure.json\". Exit code 1 where a link is not enclosed")
      .type_name("SPHERES");
  command.option("--balls", arguments->balls,
                 "spheres of all links together (default: 20 a link); of a mesh (default: 20)");
  command
      .option("--mode", arguments->mode,
              "enclose: everything is inside, proven; inside: nothing stands out; protrude: nothing farther "
              "than --within")
      .one_of({"enclose", "inside", "protrude"})
      .shows_default();
  command.option("--within", arguments->within, "of --mode protrude: 5mm, 0.005 (metres)")
      .type_name("LENGTH");
  command
      .option("--per-link", arguments->per_link,
              "fixed numbers of spheres, by names of links or patterns: 'hand=24,*finger=8'")
      .type_name("NAME=N,NAME=N")
      .delimiter(',');
  command.option("--minimum", arguments->minimum, "spheres of each link at least").shows_default();
  command.option("--effort", arguments->effort, "of --mode enclose: low, normal or high")
      .one_of({"low", "normal", "high"});
  command
      .option("--format", arguments->formats,
              "files of spheres in --out: urdf, srdf, curobo, xrdf, foam, mjcf, csv, glb (default: all but\n"
              "foam, mjcf and glb);\n"
              "of a mesh: csv, ply and others")
      .type_name("NAME,NAME")
      .delimiter(',');
  command
      .option("--page", arguments->page,
              "file that receives the verdict as a page: .html (with pictures) or .md")
      .type_name("FILE");
  command
      .option(
          "--picture", arguments->picture,
          "file that receives a picture of the links and their spheres (.png); what these leave out is red")
      .type_name("FILE");
  command.option("--links", arguments->links, "names of the links; default: all that have a shape")
      .type_name("NAME,NAME")
      .delimiter(',');
  command.flag("--visual", arguments->visual,
               "the shapes that are meant to be seen, not those for collisions");
  command.option("--packages", arguments->packages, "a folder with ROS packages or meshes; may be repeated")
      .type_name("DIR")
      .one_at_a_time();
  command.option("--buffer", arguments->buffer, "metres that are added to every radius").between(0.0, 1e6);
  command
      .option("--out", arguments->run.out,
              "folder that receives the spheres; of --check the verdict, spheres and mesh of each link")
      .type_name("DIR");
  command.option("--report", arguments->run.report, "file that receives the report of the run (JSON)")
      .type_name("FILE");
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.flag("--no-cache", common.no_cache, "neither read nor write a cache");
  command.option("--threads", arguments->run.settings.threads, "number of threads; 0: all").between(0, 4096);
  command.flag("--json", arguments->run.json, "write events as lines of JSON to the standard output");
  command.flag("--quiet", arguments->run.quiet, "print errors only");
  command.footer(
      "  ballflow spheres robot.urdf --balls 220 --out spheres --page spheres.html\n"
      "  ballflow spheres robot.urdf --per-link 'hand=24,*finger=8' --minimum 6 --format urdf,srdf --out "
      "spheres\n"
      "  ballflow spheres link.stl --balls 20 --mode protrude --within 5mm --out link\n"
      "  ballflow spheres robot.urdf --check spheres.yml --page check.html\n"
      "  ballflow spheres link.stl --check spheres.csv");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return spheres(common, *arguments); };
  });
}

}  // namespace ballflow::cli
