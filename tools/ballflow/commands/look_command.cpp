#include <cstdio>

#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/watched.hpp"
#include "inspect/model_report.hpp"
#include "inspect/picture.hpp"
#include "show/picture/picture.hpp"

namespace ballflow::cli {
namespace {

struct LookArguments {
  std::string file, picture, view = "30,20", up = "y";
  bool json = false;
};

int look_at(const Common& common, const LookArguments& arguments) {
  show::PictureOptions options;
  options.from = show::direction_named(arguments.view);
  options.up = arguments.up == "z" ? show::Upward::z : show::Upward::y;
  common.places->reads("the model", arguments.file);
  common.places->writes("--output", arguments.picture);
  inspect::ModelReport report;
  watched("nothing was found out",
          [&](geometry::Monitor& monitor) { report = inspect::look_at_file(arguments.file, monitor); });
  if (arguments.json) {
    std::printf("%s\n", inspect::json_of(report).dump(1, ' ', false, Json::error_handler_t::replace).c_str());
  } else {
    std::fputs(inspect::text_of(report).c_str(), stdout);
  }
  if (arguments.picture.empty()) return 0;
  watched("no picture was written", [&](geometry::Monitor& monitor) {
    write_atomically(arguments.picture,
                     show::png(show::draw(inspect::layers_of(report, monitor), options, monitor)));
  });
  std::fprintf(arguments.json ? stderr : stdout, "wrote %s\n", printable(arguments.picture).c_str());
  return 0;
}

}  // namespace

void add_look(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand(
      "look", "say what a model file is, what a run would make of it, and which options suit it");
  const auto arguments = std::make_shared<LookArguments>();
  command.option("file", arguments->file, "a model: OFF, OBJ, PLY, STL, points as text, also packed")
      .required()
      .type_name("FILE");
  command.flag("--json", arguments->json, "print JSON (docs/look.md) instead of text");
  command
      .option("-o,--output", arguments->picture,
              "a picture besides (.png): walls by their width, open edges, crossings, stray points")
      .type_name("FILE");
  command.option("--view", arguments->view, "of the picture, as in \"ballflow render\"").shows_default();
  command.option("--up", arguments->up, "the axis that points up in the picture")
      .one_of({"y", "z"})
      .shows_default();
  command.footer("  ballflow look scan.ply -o scan.png");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return look_at(common, *arguments); };
  });
}

}  // namespace ballflow::cli
