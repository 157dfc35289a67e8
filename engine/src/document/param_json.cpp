// The section "params" of a graph file.
#include <algorithm>

#include "base/quote.hpp"
#include "document/graph_json.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {
namespace {

using json_text::Member;
using json_text::Value;

const char* const kinds_hint =
    "kinds are number, integer, boolean, string, choice, file, list, files and artifact";

class ParamReader {
 public:
  ParamReader(const GraphFile& file, Findings& findings) : file_(file), findings_(findings) {}

  /// False when something is wrong.
  bool read(const Member& member, GraphParam& param) {
    ParamDecl& decl = param.decl;
    bool good = true;
    if (!is_identifier(member.key)) {
      error(member.offset, in_quotes(member.key) + " is no name of a parameter",
            "use letters, digits and _, no digit first");
      good = false;
    }
    if (!member.value.is_object()) {
      error(member.value.offset,
            "parameter " + in_quotes(member.key) + " must be an object, " + described(member.value.scalar),
            "{ \"kind\": \"number\", \"default\": 0, \"doc\": \"...\" }");
      return false;
    }
    good = known_keys(member.value, "a parameter",
                      {"kind", "default", "minimum", "maximum", "choices", "unit", "doc", "type", "alias"}) &&
           good;
    const Value* kind = member.value.find("kind");
    if (kind == nullptr) {
      error(member.offset, "parameter " + in_quotes(member.key) + " has no \"kind\"", kinds_hint);
      return false;
    }
    if (!kind->is_string() || !kind_from_name(kind->string(), decl.kind)) {
      std::string hint = kind->is_string()
                             ? did_you_mean(kind->string(), {"number", "integer", "boolean", "string",
                                                             "choice", "file", "list", "files", "artifact"})
                             : "";
      error(kind->offset,
            kind->is_string() ? "unknown kind " + in_quotes(kind->string())
                              : "\"kind\" must be a text, " + described(kind->scalar),
            hint.empty() ? kinds_hint : hint);
      return false;
    }
    const Value* default_value = nullptr;
    const Member* choices = nullptr;
    for (const Member& field : member.value.members) {
      if (field.key == "doc") good = text(field, decl.doc) && good;
      if (field.key == "unit") good = text(field, decl.unit) && good;
      if (field.key == "minimum") good = bound(field, decl, decl.minimum) && good;
      if (field.key == "maximum") good = bound(field, decl, decl.maximum) && good;
      if (field.key == "choices") good = read_choices(*(choices = &field), decl) && good;
      if (field.key == "default") default_value = &field.value;
      if (field.key == "type") good = artifact_type(field, decl) && good;
      if (field.key == "alias") good = read_alias(field, member.key, decl, param.alias) && good;
    }
    if (decl.kind == ParamKind::artifact && decl.type.empty()) {
      if (good)
        error(member.offset, "parameter " + in_quotes(member.key) + " is an artifact without \"type\"",
              "\"type\": \"PointSet\"");
      return false;
    }
    if (decl.kind == ParamKind::choice && choices == nullptr) {
      error(member.offset, "parameter " + in_quotes(member.key) + " is a choice without \"choices\"",
            "\"choices\": [\"a\", \"b\"]");
      return false;
    }
    decl.required = default_value == nullptr;
    if (default_value == nullptr || !good) return good;
    const Json given = is_list(decl.kind) ? default_value->json() : default_value->scalar;
    if (std::string why = decl.refuse(given); !why.empty()) {
      error(default_value->offset, "the default of " + in_quotes(member.key) + " " + why,
            choice_hint(decl, given));
      return false;
    }
    decl.default_value = normalised(decl, given);
    return true;
  }

 private:
  void error(Offset offset, std::string message, std::string hint = {}) {
    findings_.error(file_, offset, std::move(message), std::move(hint));
  }

  bool known_keys(const Value& object, const std::string& what, const std::vector<std::string>& known) {
    return ballflow::known_keys(file_, findings_, object, what, known);
  }

  bool text(const Member& member, std::string& to) { return read_text(file_, findings_, member, to); }

  bool read_alias(const Member& field, const std::string& name, const ParamDecl& decl, std::string& alias) {
    if (!text(field, alias)) return false;
    std::string why;
    if (!is_identifier(alias)) why = "is no name of a parameter";
    if (alias == name || file_.param_index.contains(alias)) why = "is the name of a parameter already";
    for (const GraphParam& other : file_.params) {
      if (other.alias == alias) why = "is the alias of " + in_quotes(other.decl.name) + " already";
    }
    if (decl.kind == ParamKind::artifact) why = "cannot stand for an artifact";
    if (!why.empty()) error(field.value.offset, "the alias " + in_quotes(alias) + " " + why);
    return why.empty();
  }

  bool artifact_type(const Member& field, ParamDecl& decl) {
    if (decl.kind != ParamKind::artifact) {
      error(field.offset, std::string("\"type\" is for the kind artifact, the parameter is of kind ") +
                              kind_name(decl.kind));
      return false;
    }
    return text(field, decl.type);
  }

  bool bound(const Member& field, const ParamDecl& decl, std::optional<double>& to) {
    if (decl.kind != ParamKind::number && decl.kind != ParamKind::integer) {
      error(field.offset,
            in_quotes(field.key) + " is for numbers, the parameter is of kind " + kind_name(decl.kind));
      return false;
    }
    if (!field.value.scalar.is_number()) {
      error(field.value.offset, in_quotes(field.key) + " must be a number, " + described(field.value.scalar));
      return false;
    }
    to = field.value.scalar.get<double>();
    return true;
  }

  bool read_choices(const Member& field, ParamDecl& decl) {
    if (decl.kind != ParamKind::choice) {
      error(field.offset, std::string("\"choices\" are for the kind choice, the parameter is of kind ") +
                              kind_name(decl.kind));
      return false;
    }
    if (!field.value.is_array() || field.value.members.empty()) {
      error(field.value.offset, "\"choices\" must be a list of texts",
            "[\"a\", \"b\"] or [{ \"value\": \"a\", \"doc\": \"...\" }]");
      return false;
    }
    bool good = true;
    for (const Member& item : field.value.members) {
      const Value* value = &item.value;
      std::string doc;
      if (item.value.is_object()) {
        good = known_keys(item.value, "a choice", {"value", "doc"}) && good;
        for (const Member& part : item.value.members) {
          if (part.key == "doc") good = text(part, doc) && good;
        }
        value = item.value.find("value");
      }
      if (value == nullptr || !value->is_string()) {
        error(item.offset, "a choice must be a text", "\"a\" or { \"value\": \"a\", \"doc\": \"...\" }");
        good = false;
        continue;
      }
      const auto same = [&](const auto& choice) { return choice.first == value->string(); };
      if (std::any_of(decl.choices.begin(), decl.choices.end(), same)) {
        error(value->offset, "the choice " + in_quotes(value->string()) + " is listed twice");
        good = false;
      }
      decl.choices.emplace_back(value->string(), doc);
    }
    return good;
  }

  static std::string choice_hint(const ParamDecl& decl, const Json& value) {
    if (decl.kind != ParamKind::choice || !value.is_string()) return {};
    std::vector<std::string> names;
    for (const auto& choice : decl.choices) names.push_back(choice.first);
    return did_you_mean(value.get<std::string>(), names);
  }

  const GraphFile& file_;
  Findings& findings_;
};

}  // namespace

GraphParam read_param(const GraphFile& file, Findings& findings, const Member& member) {
  GraphParam param;
  param.offset = member.offset;
  param.decl.name = member.key;
  param.broken = !ParamReader(file, findings).read(member, param);
  return param;
}

}  // namespace ballflow
