#include "document/sweep.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/quote.hpp"
#include "document/file_patterns.hpp"
#include "document/labels.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

std::string text_of(const PlacedSetting& setting) {
  return setting.value ? plain_text(*setting.value) : setting.text;
}

class SweepPlanner {
 public:
  SweepPlanner(const GraphFile& top, const std::vector<PlacedSetting>& sets, const SweepOptions& options,
               Findings& findings)
      : top_(top), sets_(sets), options_(options), findings_(findings) {}

  std::optional<Sweep> run() {
    read_inputs();
    if (top_.sweep) {
      for (const SweepAxis& axis : top_.sweep->axes) add_axis(axis);
    }
    for (const Setting& axis : options_.axes) add_axis(axis);
    if (sweep_.axes.empty()) return std::nullopt;
    refuse_fixed();
    for (std::size_t i = 0; i < sweep_.axes.size(); ++i) {
      refuse_doubles(sweep_.axes[i]);
      std::vector<std::string> texts;
      for (const PlacedSetting& value : sweep_.axes[i].values) texts.push_back(text_of(value));
      sweep_.axes[i].labels = labels_of(texts, i < inputs_);
    }
    if (good_) combine();
    if (sweep_.variants.empty()) sweep_.variants.emplace_back(sweep_.axes.size(), 0);
    return std::move(sweep_);
  }

 private:
  void error(Offset offset, std::string message, std::string hint = {}) {
    findings_.error(top_, offset, std::move(message), std::move(hint));
    good_ = false;
  }
  void error(const PlacedSetting& about, std::string message, std::string hint = {}) {
    findings_.add(about_setting(about, std::move(message), std::move(hint)));
    good_ = false;
  }

  static PlacedSetting from_option(const char* option, const std::string& name, const std::string& text) {
    PlacedSetting setting;
    setting.name = name;
    setting.text = text;
    setting.origin = std::string(option) + " " + (name.empty() ? text : name + "=" + text);
    return setting;
  }
  PlacedSetting from_file(const SweepAxis& axis, const SweepAxis::Value& value) const {
    PlacedSetting setting;
    setting.name = axis.name;
    setting.value = value.json;
    setting.file = &top_;
    setting.offset = value.offset;
    setting.name_offset = axis.offset;
    return setting;
  }

  Sweep::Axis* find_axis(const std::string& name) {
    for (Sweep::Axis& axis : sweep_.axes) {
      if (setting_target(axis.name) == setting_target(name)) return &axis;
    }
    return nullptr;
  }

  /// Names of the file parameters of the graph.
  std::vector<std::string> file_params() const {
    std::vector<std::string> names;
    for (const GraphParam& param : top_.params) {
      if (!param.broken && param.decl.kind == ParamKind::file) names.push_back(param.decl.name);
    }
    return names;
  }

  void read_inputs() {
    const std::vector<std::string> files = file_params();
    const auto is_file = [&](const std::string& name) {
      return std::find(files.begin(), files.end(), name) != files.end();
    };
    std::map<std::string, std::vector<PlacedSetting>> given;
    for (const std::string& text : options_.inputs) {
      const std::size_t equals = text.find('=');
      if (equals != std::string::npos && top_.param_index.contains(text.substr(0, equals))) {
        const std::string name = text.substr(0, equals);
        const PlacedSetting pattern = from_option("--inputs", name, text.substr(equals + 1));
        if (!is_file(name))
          error(pattern, in_quotes(name) + " is no parameter of kind file", file_hint(files));
        given[name].push_back(pattern);
        continue;
      }
      PlacedSetting pattern = from_option("--inputs", "", text);
      if (top_.maps.size() == 1) {
        pattern.name = top_.maps[0].name;
      } else if (top_.maps.empty() && files.size() == 1) {
        pattern.name = files[0];
      } else {
        error(pattern,
              files.empty() ? "the graph has no parameter of kind file"
                            : "which parameter shall have these files is not clear",
              files.empty() ? "--axis NAME=VALUE,VALUE takes other parameters" : file_hint(files));
        continue;
      }
      given[pattern.name].push_back(std::move(pattern));
    }
    for (const SweepAxis& map : top_.maps) {
      if (!is_file(map.name)) {
        const std::string hint = did_you_mean(map.name, files);
        error(map.offset,
              "\"map\" needs a parameter of kind file; " + in_quotes(map.name) + " is none of the graph's",
              hint.empty() ? file_hint(files) : hint);
      }
      if (given.contains(map.name)) continue;
      for (const SweepAxis::Value& value : map.values) {
        if (value.json.is_string()) {
          given[map.name].push_back(from_file(map, value));
        } else {
          error(value.offset, "a file pattern must be a text, " + described(value.json));
        }
      }
    }
    for (const auto& [name, patterns] : given) add_files(name, patterns);
    inputs_ = sweep_.axes.size();
  }

  static std::string file_hint(const std::vector<std::string>& files) {
    if (files.empty()) return "the graph has no parameter of kind file";
    return "file parameters are " + listed(files) + "; write --inputs '" + files[0] + "=PATTERN'";
  }

  void add_files(const std::string& name, const std::vector<PlacedSetting>& patterns) {
    Sweep::Axis axis;
    axis.name = name;
    std::map<std::string, PlacedSetting> found;  // each once, sorted
    for (const PlacedSetting& pattern : patterns) {
      const std::string text = text_of(pattern);
      const std::vector<std::string> paths = matching_files(text);
      if (paths.empty()) {
        error(pattern, "no file matches " + in_quotes(text),
              "patterns are relative to the current directory, " + in_quotes(fs::current_path().string()));
      }
      for (const std::string& path : paths) {
        PlacedSetting value = pattern;
        value.name = name;
        if (value.value) {
          value.value = path;
        } else {
          value.text = path;
        }
        found.emplace(path, std::move(value));
      }
    }
    for (auto& [path, value] : found) axis.values.push_back(std::move(value));
    if (!axis.values.empty()) sweep_.axes.push_back(std::move(axis));
  }

  void add_axis(const SweepAxis& written) {
    for (const Setting& option : options_.axes) {
      if (setting_target(option.name) == setting_target(written.name)) return add_axis(option);
    }
    Sweep::Axis axis;
    axis.name = written.name;
    for (const SweepAxis::Value& value : written.values) axis.values.push_back(from_file(written, value));
    if (axis.values.empty()) {
      good_ = false;  // reported when it was read
    } else if (find_axis(axis.name) != nullptr) {
      error(written.offset, in_quotes(axis.name) + " is swept twice",
            "\"map\", \"--inputs\" and \"axes\" cannot have the same parameter");
    } else {
      sweep_.axes.push_back(std::move(axis));
    }
  }

  void add_axis(const Setting& option) {
    if (!added_.insert(setting_target(option.name)).second) {
      if (std::count_if(options_.axes.begin(), options_.axes.end(), [&](const Setting& other) {
            return setting_target(other.name) == setting_target(option.name);
          }) > 1) {
        error(from_option("--axis", option.name, option.value), "this axis is given twice",
              "put all values into one: --axis NAME=A,B,C");
      }
      return;
    }
    const PlacedSetting whole = from_option("--axis", option.name, option.value);
    if (find_axis(option.name) != nullptr) {
      error(whole, in_quotes(option.name) + " is swept twice", "--inputs has this parameter already");
      return;
    }
    Sweep::Axis axis;
    axis.name = option.name;
    if (option.value.starts_with("[")) {
      const auto list = nlohmann::json::parse(option.value, nullptr, false);
      if (!list.is_array()) {
        error(whole, "this is no JSON list", "write it as --axis '" + option.name + "=[0.1, 0.3]'");
        return;
      }
      for (const auto& item : list) {
        PlacedSetting value = whole;
        if (item.is_structured() || item.is_null()) {
          error(whole, "a value of an axis must be a number, a text, true or false");
          return;
        }
        value.value = Json(item);
        axis.values.push_back(std::move(value));
      }
    } else {
      for (std::size_t begin = 0; begin <= option.value.size();) {
        const std::size_t comma = std::min(option.value.find(',', begin), option.value.size());
        PlacedSetting value = whole;
        value.text = option.value.substr(begin, comma - begin);
        axis.values.push_back(std::move(value));
        begin = comma + 1;
      }
    }
    if (axis.values.empty()) {
      error(whole, "this axis has no values");
      return;
    }
    sweep_.axes.push_back(std::move(axis));
  }

  void refuse_fixed() {
    for (const PlacedSetting& set : sets_) {
      if (find_axis(set.name) == nullptr) continue;
      error(set, in_quotes(set.name) + " is an axis of the sweep",
            "to run one value of it only: --axis " + set.name + "=" + set.text);
    }
  }

  void refuse_doubles(const Sweep::Axis& axis) {
    std::set<std::string> seen;
    for (const PlacedSetting& value : axis.values) {
      if (!seen.insert(text_of(value)).second)
        error(value, "axis " + in_quotes(axis.name) + " has " + in_quotes(text_of(value)) + " twice");
    }
  }

  /// For every excluded combination: axis and value; empty where it cannot occur.
  std::vector<std::vector<std::pair<std::size_t, std::uint32_t>>> exclusions() {
    std::vector<std::vector<std::pair<std::size_t, std::uint32_t>>> result;
    if (!top_.sweep) return result;
    for (const std::vector<SweepAxis>& combination : top_.sweep->excluded) {
      auto& excluded = result.emplace_back();
      bool possible = true;
      for (const SweepAxis& part : combination) {
        const Sweep::Axis* const axis = find_axis(part.name);
        std::vector<std::string> known;
        if (axis == nullptr) {
          for (const Sweep::Axis& one : sweep_.axes) known.push_back(one.name);
          const std::string hint = did_you_mean(part.name, known);
          error(part.offset, "the sweep has no axis " + in_quotes(part.name),
                hint.empty() ? "axes are " + listed(known) : hint);
          continue;
        }
        for (const PlacedSetting& value : axis->values) known.push_back(text_of(value));
        const std::string wanted = plain_text(part.values[0].json);
        const auto place = std::find(known.begin(), known.end(), wanted);
        if (place != known.end()) {
          excluded.emplace_back(axis - sweep_.axes.data(), place - known.begin());
          continue;
        }
        possible = false;
        if (axis->values[0].file == nullptr) continue;  // the command line has chosen other values
        const std::string hint = did_you_mean(wanted, known);
        error(part.values[0].offset, "axis " + in_quotes(axis->name) + " has no value " + in_quotes(wanted),
              hint.empty() ? "values are " + listed(known) : hint);
      }
      if (!possible) excluded.clear();
    }
    return result;
  }

  void combine() {
    const bool zip = top_.sweep && top_.sweep->zip;
    const auto& axes = sweep_.axes;
    const auto excluded = exclusions();
    // What counts one by one: each file axis, then each other axis, or all of those together.
    std::vector<std::pair<std::size_t, std::size_t>> digits;  // first axis of a group, and its length
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (zip && i > inputs_) {
        if (axes[i].values.size() != axes[inputs_].values.size()) {
          error(axes[i].values[0].file != nullptr ? axes[i].values[0].name_offset : top_.sweep->offset,
                "axes of a zip have the same number of values; " + in_quotes(axes[inputs_].name) + " has " +
                    std::to_string(axes[inputs_].values.size()) + ", " + in_quotes(axes[i].name) + " has " +
                    std::to_string(axes[i].values.size()),
                "\"mode\": \"product\" takes every combination");
          return;
        }
        continue;
      }
      digits.emplace_back(i, axes[i].values.size());
    }
    double count = 1;
    for (const auto& [axis, length] : digits) count *= static_cast<double>(length);
    if (count > static_cast<double>(max_variants)) {
      const std::string text =
          count < 1e15 ? std::to_string(static_cast<std::uint64_t>(count)) : shortest(count);
      const std::string message =
          "the sweep has " + text + " variants, more than " + std::to_string(max_variants);
      const std::string hint = "take fewer values, or \"mode\": \"zip\"";
      if (top_.sweep) {
        error(top_.sweep->offset, message, hint);
      } else {
        error(axes.back().values[0], message, hint);
      }
      return;
    }
    const auto total = static_cast<std::size_t>(count);
    for (std::size_t number = 0; number < total; ++number) {
      Sweep::Choice choice(axes.size());
      std::size_t rest = number;
      for (std::size_t d = digits.size(); d-- > 0;) {
        const auto value = static_cast<std::uint32_t>(rest % digits[d].second);
        rest /= digits[d].second;
        const std::size_t end = d + 1 < digits.size() ? digits[d + 1].first : axes.size();
        for (std::size_t axis = digits[d].first; axis < end; ++axis) choice[axis] = value;
      }
      const bool out = std::any_of(excluded.begin(), excluded.end(), [&](const auto& combination) {
        return !combination.empty() &&
               std::all_of(combination.begin(), combination.end(),
                           [&](const auto& part) { return choice[part.first] == part.second; });
      });
      if (!out) sweep_.variants.push_back(std::move(choice));
    }
    if (sweep_.variants.empty() && good_)
      error(top_.sweep->offset, "every combination of the sweep is excluded");
  }

  const GraphFile& top_;
  const std::vector<PlacedSetting>& sets_;
  const SweepOptions& options_;
  Findings& findings_;
  Sweep sweep_;
  std::set<std::string> added_;  // axes of the command line
  std::size_t inputs_ = 0;       // axes that are inputs; they come first
  bool good_ = true;
};

}  // namespace

std::string Sweep::label_of(std::size_t axis, std::uint32_t value) const {
  std::string name = axes[axis].name;
  std::replace(name.begin(), name.end(), '/', '.');
  return label_text(name) + "=" + axes[axis].labels[value];
}

std::string Sweep::name_of(const Choice& choice) const {
  std::string name;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    name += (axis == 0 ? "" : ",") + label_of(axis, choice[axis]);
  return cut(name, longest_variant_name);
}

std::optional<Sweep> plan_sweep(const GraphFile& top, const std::vector<PlacedSetting>& sets,
                                const SweepOptions& options, Findings& findings) {
  return SweepPlanner(top, sets, options, findings).run();
}

}  // namespace ballflow
