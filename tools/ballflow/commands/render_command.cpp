#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/model_file.hpp"
#include "commands/watched.hpp"
#include "show/motion.hpp"
#include "show/picture/number.hpp"
#include "show/picture/picture.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  std::vector<std::string> names, layers, colour_by, opacity, clips;
  std::string output, size = "1600x1200", view = "30,20", up, ground = "white", animate;
  int frames = 24;
  double point_size = 0;
  bool beside = false, no_legend = false;
  unsigned threads = 0;
};

/// What one artifact or model shows, and what it is called on the command line.
struct Source {
  std::string label;
  std::vector<show::Layer> layers;
  ArtifactPtr artifact;  // whose memory the layers view
  std::string from;      // what of the command line it comes from, in short
};

/// Says on a terminal how much is drawn.
class DrawingMonitor final : public geometry::Monitor {
 public:
  ~DrawingMonitor() override {
    if (live_) std::fprintf(stderr, "\r\033[K");
  }
  bool cancelled() override { return flag_.load(); }
  void progress(double fraction) override {
    const int percent = static_cast<int>(100 * fraction);
    int shown = shown_.load();
    while (live_ && percent > shown) {
      if (!shown_.compare_exchange_weak(shown, percent)) continue;
      std::fprintf(stderr, "\r\033[K  %d %% drawn", percent);
      break;
    }
  }

 private:
  const std::atomic<bool>& flag_ = cancel_on_signals();
  const bool live_ = isatty(STDERR_FILENO) != 0;
  std::atomic<int> shown_ = -1;
};

Source source_of_model(const std::string& name) {
  Source source;
  source.label =
      name.starts_with("shape:") ? name.substr(6, name.find('?') - 6) : fs::path(name).stem().string();
  source.artifact = artifact_of_model(name);
  source.layers = show::layers_of(*source.artifact);
  return source;
}

void add_run(const Common& common, std::vector<Source>& sources, Store& store, const std::string& name) {
  const RunRecord run = named_run(common, store, name);
  const std::size_t before = sources.size();
  std::string others;
  for (const auto& [output, entry] : run.report.at("outputs").items()) {
    if (!show::can_be_shown(entry.at("type").get<std::string>())) {
      others += (others.empty() ? "" : ", ") + output;
      continue;
    }
    const auto digest = Digest::from_hex(entry.at("digest").get<std::string>());
    Source source;
    source.label = output;
    if (digest) source.artifact = cached_artifact(store, *digest);
    if (source.artifact == nullptr) {
      std::fprintf(stderr, "%s is not in the cache any more and is left out; a run makes it again\n",
                   printable(output).c_str());
      continue;
    }
    source.layers = show::layers_of(*source.artifact);
    sources.push_back(std::move(source));
  }
  if (sources.size() == before) {
    throw Error(ExitCode::usage, "the run " + run.id + " has no output that can be drawn",
                others.empty() ? "" : "its outputs are " + others);
  }
}

std::vector<Source> find_sources(const Common& common, const std::vector<std::string>& names) {
  const auto store = common.store();
  std::vector<Source> sources;
  for (const std::string& name : names) {
    const std::size_t before = sources.size();
    if (is_model(name)) {
      if (!name.starts_with("shape:")) common.places->reads("a model", name);
      sources.push_back(source_of_model(name));
    } else if (is_run(*store, name)) {
      add_run(common, sources, *store, name);
    } else {
      Source source;
      source.label = fs::path(name).filename().string();
      source.artifact = find_artifact(common, name);
      source.layers = show::layers_of(*source.artifact);
      sources.push_back(std::move(source));
    }
    for (std::size_t i = before; i < sources.size(); ++i) sources[i].from = fs::path(name).stem().string();
  }
  // Outputs of several runs may have one name.
  std::vector<bool> repeated;
  for (const Source& source : sources) {
    repeated.push_back(std::count_if(sources.begin(), sources.end(),
                                     [&](const Source& other) { return other.label == source.label; }) > 1);
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (repeated[i]) sources[i].label = sources[i].from + "/" + sources[i].label;
  }
  return sources;
}

/// The layers that a name means: a layer by its name or by source/name, or all of a source.
std::vector<show::Layer*> layers_named(std::vector<Source>& sources, const std::string& name) {
  std::vector<show::Layer*> found, of_source;
  std::vector<std::string> known;
  for (Source& source : sources) {
    known.push_back(source.label);
    for (show::Layer& layer : source.layers) {
      known.push_back(layer.name);
      if (layer.name == name || source.label + "/" + layer.name == name) found.push_back(&layer);
      if (source.label == name) of_source.push_back(&layer);
    }
  }
  if (!of_source.empty()) return of_source;
  if (!found.empty()) return found;
  std::string all;
  for (const Source& source : sources) {
    for (const show::Layer& layer : source.layers) {
      all += (all.empty() ? "" : ", ") + (sources.size() > 1 ? source.label + "/" : "") + layer.name;
    }
  }
  const std::string near = nearest(name, known);
  throw Error(ExitCode::usage, "there is no layer \"" + name + "\"",
              (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "the layers are " + all);
}

/// "LAYER=VALUE", or "VALUE" for all layers.
struct DrawSetting {
  std::vector<show::Layer*> layers;
  std::string value;
};

DrawSetting setting_of(std::vector<Source>& sources, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals != std::string::npos)
    return {layers_named(sources, text.substr(0, equals)), text.substr(equals + 1)};
  DrawSetting setting{{}, text};
  for (Source& source : sources) {
    for (show::Layer& layer : source.layers) setting.layers.push_back(&layer);
  }
  return setting;
}

void colour(std::vector<Source>& sources, const std::string& text) {
  const DrawSetting setting = setting_of(sources, text);
  bool any = setting.value == "none";
  std::vector<std::string> known;
  for (show::Layer* layer : setting.layers) {
    for (const show::Attribute& attribute : layer->attributes) known.push_back(attribute.name);
    if (setting.value == "none") {
      layer->colour_by.clear();
    } else if (layer->find(setting.value) != nullptr) {
      layer->colour_by = setting.value;
      any = true;
    }
  }
  if (any) return;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::string all = "none";
  for (const std::string& name : known) all += ", " + name;
  throw Error(ExitCode::usage,
              "--colour-by " + text + ": no layer has an attribute \"" + setting.value + "\"",
              "use one of " + all);
}

void set_opacity(std::vector<Source>& sources, const std::string& text) {
  const DrawSetting setting = setting_of(sources, text);
  const auto value = show::number_in(setting.value);
  if (!value || !(*value > 0 && *value <= 1)) {
    throw Error(ExitCode::usage, "--opacity " + text + ": not a number above 0 and at most 1",
                "write it as --opacity mesh=0.3");
  }
  for (show::Layer* layer : setting.layers) layer->opacity = *value;
}

/// The scenes of the picture: one, or with --beside one per source; --layers chooses and orders.
std::vector<std::vector<show::Layer>> scenes_of(std::vector<Source>& sources,
                                                const RenderArguments& arguments) {
  std::vector<std::vector<show::Layer>> scenes;
  if (!arguments.layers.empty()) {
    for (const std::string& name : arguments.layers) {
      std::vector<show::Layer> chosen;
      const std::vector<show::Layer*> named = layers_named(sources, name);
      const bool any =
          std::any_of(named.begin(), named.end(), [](const show::Layer* l) { return l->visible; });
      for (const show::Layer* layer : named) {
        if (any && !layer->visible) continue;
        chosen.push_back(*layer);
        chosen.back().visible = true;
      }
      scenes.push_back(std::move(chosen));
    }
  } else {
    for (Source& source : sources) scenes.push_back(std::move(source.layers));
  }
  if (arguments.beside) return scenes;
  std::vector<show::Layer> all;
  for (auto& scene : scenes) std::move(scene.begin(), scene.end(), std::back_inserter(all));
  return {all};
}

std::optional<show::Colour> ground_named(const std::string& text) {
  if (text == "none") return std::nullopt;
  if (text == "white") return show::Colour{255, 255, 255};
  if (text == "dark") return show::Colour{24, 26, 30};
  std::uint32_t value = 0;
  if (text.size() == 7 && text[0] == '#') {
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
    if (error == std::errc() && end == text.data() + 7) {
      return show::Colour{static_cast<std::uint8_t>(value >> 16),
                          static_cast<std::uint8_t>(value >> 8 & 0xff),
                          static_cast<std::uint8_t>(value & 0xff)};
    }
  }
  throw Error(ExitCode::usage, "there is no ground \"" + text + "\"",
              "use none (transparent), white, dark, or a colour as #e8ecf0");
}

std::pair<int, int> size_named(const std::string& text) {
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == 'x') {
    const auto second = std::from_chars(first.ptr + 1, end, height);
    if (second.ec == std::errc() && second.ptr == end) return {width, height};
  }
  throw Error(ExitCode::usage, "\"" + text + "\" is no size of a picture", "write it as 1600x1200");
}

/// A joint from one end to the other and back.
std::string animation(const std::vector<std::vector<show::Layer>>& scenes, const std::string& name,
                      int frames, show::PictureOptions options, geometry::Monitor& monitor) {
  std::vector<show::Layer> all;
  for (const auto& scene : scenes) all.insert(all.end(), scene.begin(), scene.end());
  const show::Chain::Joint joint = show::joint_named(all, name);
  constexpr int ways = 8;
  for (int k = 0; k <= ways; ++k) {
    auto there = show::with_joint(all, name, joint.lower + k * (joint.upper - joint.lower) / ways);
    std::erase_if(there, [](const show::Layer& layer) { return !layer.visible; });
    std::move(there.begin(), there.end(), std::back_inserter(options.room_for));
  }
  show::AnimatedPng file(80, options.ground.has_value());
  for (int i = 0; i < frames; ++i) {
    const double t = 2.0 * i / frames, share = t < 1 ? t : 2 - t;
    std::vector<std::vector<show::Layer>> posed;
    for (const auto& scene : scenes)
      posed.push_back(show::with_joint(scene, name, joint.lower + share * (joint.upper - joint.lower)));
    geometry::PartMonitor part(monitor, static_cast<double>(i) / frames, (i + 1.0) / frames);
    file.add(show::draw_beside(posed, options, part));
  }
  return file.file();
}

int render(const Common& common, const RenderArguments& arguments) {
  show::PictureOptions options;
  std::tie(options.width, options.height) = size_named(arguments.size);
  options.from = show::direction_named(arguments.view);
  options.ground = ground_named(arguments.ground);
  for (const std::string& clip : arguments.clips) options.clips.push_back(show::clip_named(clip));
  options.point_size = arguments.point_size;
  options.legend = !arguments.no_legend;
  options.threads = arguments.threads;

  common.store();
  common.places->writes("--output", arguments.output);
  watched("no picture was written", [&](geometry::Monitor&) {
    std::vector<Source> sources = find_sources(common, arguments.names);
    for (const std::string& text : arguments.colour_by) colour(sources, text);
    for (const std::string& text : arguments.opacity) set_opacity(sources, text);
    const std::vector<std::vector<show::Layer>> scenes = scenes_of(sources, arguments);
    options.up = arguments.up == "z" ? show::Upward::z : show::Upward::y;
    if (arguments.up.empty()) {
      for (const auto& scene : scenes) options.up = std::max(options.up, show::upward_of(scene));
    }
    const std::string picture = [&] {
      DrawingMonitor drawing;
      if (!arguments.animate.empty())
        return animation(scenes, arguments.animate, arguments.frames, options, drawing);
      return show::png(show::draw_beside(scenes, options, drawing));
    }();
    write_atomically(arguments.output, picture);
  });
  std::printf("wrote %s (%d x %d)\n", printable(arguments.output).c_str(), options.width, options.height);
  return 0;
}

}  // namespace

void add_render(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand("render", "draw artifacts, runs and models into a PNG file");
  const auto arguments = std::make_shared<RenderArguments>();
  command
      .option(
          "source", arguments->names,
          "digests or files of artifacts; runs (an id, latest, previous, a report file), of which the\n"
          "outputs are drawn; files of models (OFF, OBJ, PLY, STL, ...) and of balls, shapes (shape:torus)")
      .required()
      .type_name("ARTIFACT|RUN|FILE...");
  command.option("-o,--output", arguments->output, "picture to write (.png)").required().type_name("FILE");
  command.option("--size", arguments->size, "width and height in pixels").type_name("WxH").shows_default();
  command
      .option("--view", arguments->view,
              "iso, front, back, left, right, top, bottom, or azimuth,elevation in degrees")
      .shows_default();
  command
      .option("--up", arguments->up, "the axis that points up in the picture; default: z for robots, else y")
      .one_of({"y", "z"});
  command.option("--ground", arguments->ground, "white, dark, none (transparent) or a colour as #e8ecf0")
      .shows_default();
  command
      .option("--layers", arguments->layers,
              "draw only these: names of layers, or of outputs of a run for what they show at first")
      .delimiter(',')
      .one_at_a_time()
      .type_name("NAME,NAME");
  command
      .option("--colour-by", arguments->colour_by,
              "attribute that gives the colour, of one layer or of all that have it; none: plain")
      .one_at_a_time()
      .type_name("[LAYER=]ATTRIBUTE");
  command.option("--opacity", arguments->opacity, "of one layer or of all, above 0 and at most 1")
      .one_at_a_time()
      .type_name("[LAYER=]X");
  command
      .option("--clip", arguments->clips,
              "cut off what is beyond a plane: x=0.5 removes x > 0.5, -x=0.5 removes x < 0.5, in model\n"
              "units; x=50% is the middle of the bounding box")
      .one_at_a_time()
      .type_name("AXIS=VALUE");
  command.option("--point-size", arguments->point_size, "diameter of points and width of lines in pixels")
      .between(0.1, 1000.0);
  command.flag("--beside", arguments->beside,
               "one picture beside the other, for every source or name of --layers, in one scale");
  command
      .option(
          "--animate", arguments->animate,
          "a joint of a robot, or a mode of a model of shapes (\"mode 0\"), from one end to the other and\n"
          "back: an animated PNG")
      .type_name("JOINT");
  command.option("--frames", arguments->frames, "pictures of the animation").between(2, 500).shows_default();
  command.flag("--no-legend", arguments->no_legend, "do not explain the colours");
  command.option("--threads", arguments->threads, "threads; default: all cores").between(1, 1024);
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return render(common, *arguments); };
  });
}

}  // namespace ballflow::cli
