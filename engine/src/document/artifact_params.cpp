#include "document/artifact_params.hpp"

#include "base/quote.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

namespace {

/// The last setting of a parameter of the top graph; null when there is none.
const PlacedSetting* setting_of(const std::vector<const PlacedSetting*>& settings, const std::string& name) {
  const PlacedSetting* last = nullptr;
  for (const PlacedSetting* setting : settings) {
    if (setting_target(setting->name) == "." + name) last = setting;
  }
  return last;
}

}  // namespace

std::map<std::string, ArtifactPtr> find_given(const GraphFile& top, const Registry& registry,
                                              const std::vector<const PlacedSetting*>& settings,
                                              const std::map<std::string, ArtifactPtr>& given,
                                              const FindArtifact& find,
                                              std::map<std::string, ArtifactPtr>& found, Findings& findings) {
  std::map<std::string, ArtifactPtr> all = given;
  for (const GraphParam& param : top.params) {
    if (param.decl.kind != ParamKind::artifact || param.broken || given.contains(param.decl.name)) continue;
    const PlacedSetting* setting = setting_of(settings, param.decl.name);
    const std::string what = "parameter " + in_quotes(param.decl.name);
    const auto complain = [&](const std::string& message, const std::string& hint) {
      if (setting != nullptr) {
        findings.add(about_setting(*setting, message, hint));
      } else {
        findings.error(top, param.offset, message, hint);
      }
    };
    if (setting == nullptr && param.decl.required) {
      complain(what + " has no value",
               "give it one: --set " + param.decl.name + "=FILE, or a digest in the cache");
      continue;
    }
    const Json value = setting == nullptr ? param.decl.default_value
                       : setting->value   ? *setting->value
                                          : Json(setting->text);
    if (const std::string why = param.decl.refuse(value); !why.empty()) {
      complain(what + " " + why, "a safetensors file, or 6 digits or more of a digest in the cache");
      continue;
    }
    const auto& name = value.get_ref<const std::string&>();
    ArtifactPtr& artifact = found[name];
    try {
      if (artifact == nullptr && find) artifact = find(name);
    } catch (const Error& error) {
      complain(what + ": " + error.what(), error.hint());
      continue;
    }
    if (artifact == nullptr) {
      complain(what + ": nobody looks for artifacts here", "hand it over as an artifact");
      continue;
    }
    const TypeDeclaration* type = registry.type(param.decl.type);
    if (type == nullptr) continue;  // reported with the inputs of the graph
    if (const std::string broken = check_artifact(*type, *artifact); !broken.empty()) {
      complain(what + ": " + in_quotes(name) + " " + broken, "give an artifact of type " + param.decl.type);
      continue;
    }
    all[param.decl.name] = artifact;
  }
  return all;
}

}  // namespace ballflow
