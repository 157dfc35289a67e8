#include <map>
#include <optional>

#include "ballflow/artifact_view.hpp"
#include "ballflow/registry.hpp"
#include "base/quote.hpp"

namespace ballflow {

namespace {

/// "n+1" -> ("n", 1)
std::pair<std::string, std::int64_t> length_name(const std::string& text) {
  const std::size_t plus = text.find('+');
  if (plus == std::string::npos) return {text, 0};
  std::int64_t more = 0;
  for (const char c : text.substr(plus + 1)) {
    if (c < '0' || c > '9' || more > 1'000'000) return {text, 0};
    more = more * 10 + (c - '0');
  }
  return {text.substr(0, plus), more};
}

std::string shape_text(const NamedArray& array) {
  std::string text;
  for (const std::uint64_t length : array.shape) text += (text.empty() ? "" : " x ") + std::to_string(length);
  return text.empty() ? "one number" : text;
}

struct Length {
  std::int64_t value;
  const ArrayDecl* array;  // which has it
};

std::string declared_shape(const ArrayDecl& decl) {
  std::string text;
  for (const Json& length : decl.shape) text += (text.empty() ? "" : " x ") + plain_text(length);
  return text.empty() ? "one number" : text;
}

/// Empty, and nothing allocated, where the array is as declared: the engine calls this for every output.
std::string check_array(const ArrayDecl& decl, const NamedArray& array,
                        std::map<std::string, Length>& lengths) {
  const auto start = [&decl] { return "array " + in_quotes(decl.name); };
  if (dtype_name(array.dtype) != decl.dtype) {
    return start() + " holds " + std::string(dtype_name(array.dtype)) + ", must hold " + decl.dtype;
  }
  bool fits = array.shape.size() == decl.shape.size();
  for (std::size_t i = 0; fits && i < decl.shape.size(); ++i) {
    if (decl.shape[i].is_number()) fits = array.shape[i] == decl.shape[i].get<std::uint64_t>();
  }
  if (!fits) return start() + " is " + shape_text(array) + ", must be " + declared_shape(decl);
  if (decl.shape.empty() || !decl.shape[0].is_string()) return {};

  const auto [name, more] = length_name(decl.shape[0].get_ref<const std::string&>());
  const std::int64_t value = static_cast<std::int64_t>(array.shape[0]) - more;
  if (value < 0)
    return start() + " has length " + std::to_string(array.shape[0]) + ", must have " +
           decl.shape[0].get<std::string>();
  const auto [place, fresh] = lengths.try_emplace(name, Length{value, &decl});
  if (!fresh && place->second.value != value) {
    return start() + " has length " + std::to_string(array.shape[0]) + ", must have " +
           std::to_string(place->second.value + more) + " (" + decl.shape[0].get<std::string>() + ", " +
           name + " = " + std::to_string(place->second.value) + " by array " +
           in_quotes(place->second.array->name) + ")";
  }
  return {};
}

}  // namespace

std::string check_arrays(const TypeDeclaration& type, const Artifact& artifact) {
  if (artifact.type() != type.id || artifact.version() != type.version) {
    return "is a " + in_quotes(artifact.type()) + " version " + std::to_string(artifact.version()) +
           ", must be a " + in_quotes(type.id) + " version " + std::to_string(type.version);
  }
  std::map<std::string, Length> lengths;
  for (const ArrayDecl& decl : type.arrays) {
    const NamedArray* array = artifact.find(decl.name);
    if (array == nullptr) {
      if (decl.optional) continue;
      return "has no array " + in_quotes(decl.name) + " (" + decl.doc + ")";
    }
    if (std::string wrong = check_array(decl, *array, lengths); !wrong.empty()) return wrong;
  }
  for (const NamedArray& array : artifact.arrays()) {
    bool declared = false;
    for (const ArrayDecl& decl : type.arrays) declared = declared || decl.name == array.name;
    if (!declared)
      return "has an array " + in_quotes(array.name) + " that type " + in_quotes(type.id) +
             " does not declare";
  }
  return {};
}

std::string check_artifact(const TypeDeclaration& type, const Artifact& artifact) {
  if (std::string wrong = check_arrays(type, artifact); !wrong.empty()) return wrong;
  if (type.entry == nullptr || type.entry->check == nullptr) return {};
  // The type's own check reads the arrays through the plugin boundary; the artifact outlives the call.
  const ArtifactView view(artifact);
  std::string broken;
  type.entry->check(type.entry->self, &view.raw(), &broken, [](void* context, bf_bytes text) noexcept {
    auto& first = *static_cast<std::string*>(context);
    if (!first.empty()) return;
    try {
      first = printable({text.data, static_cast<std::size_t>(text.size)});
    } catch (...) {
      first = "is broken";  // short enough to need no memory
    }
  });
  return broken;
}

ArtifactPtr make_artifact(const TypeDeclaration& type, const std::vector<NamedArray>& arrays,
                          const std::shared_ptr<const void>& owner) {
  ArtifactPtr artifact = Artifact::seal(type.id, type.version, arrays, "{}", owner);
  if (const std::string wrong = check_artifact(type, *artifact); !wrong.empty())
    throw Error(ExitCode::plugin, "no valid " + type.id + ": " + wrong);
  if (type.entry == nullptr || type.entry->struct_size < BALLFLOW_SIZE_UP_TO(bf_type, summarize) ||
      type.entry->summarize == nullptr) {
    return artifact;
  }
  const ArtifactView view(*artifact);
  std::optional<std::string> summary;
  type.entry->summarize(type.entry->self, &view.raw(), &summary, [](void* context, bf_bytes text) noexcept {
    try {
      *static_cast<std::optional<std::string>*>(context) =
          std::string(text.data, static_cast<std::size_t>(text.size));
    } catch (...) {  // told below
    }
  });
  if (!summary) throw Error(ExitCode::plugin, "the summary of a " + type.id + " could not be made");
  return Artifact::seal(type.id, type.version, arrays, *summary, owner);
}

}  // namespace ballflow
