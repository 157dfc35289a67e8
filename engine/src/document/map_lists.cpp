#include "document/map_lists.hpp"

#include <algorithm>
#include <set>

#include "base/quote.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

const MapList* MapEntry::list_of(const ParamDecl& param) const {
  if (lists == nullptr) return nullptr;
  for (const MapList& list : *lists) {
    if (list.param == &param) return &list;
  }
  return nullptr;
}

bool read_map(const GraphFile& file, const std::vector<std::optional<Json>>& params, const GraphNode& node,
              const GraphNode::Map& written, const GraphFile& body, std::vector<MapList>& lists,
              Findings& findings) {
  const std::string owner = "map " + in_quotes(node.name);
  std::vector<std::string> known;
  for (const GraphParam& param : body.params) known.push_back(param.decl.name);
  bool good = true;
  const auto error = [&](Offset offset, std::string message, std::string hint) {
    findings.error(file, offset, std::move(message), std::move(hint));
    good = false;
  };
  for (const GraphNode::Param& over : written.over) {
    const auto place = body.param_index.find(over.name);
    if (place == body.param_index.end()) {
      const std::string hint = did_you_mean(over.name, known);
      error(over.offset,
            "map body " + in_quotes(body.source.file()) + " has no parameter " + in_quotes(over.name),
            !hint.empty()   ? hint
            : known.empty() ? "it has no parameters: declare " + in_quotes(over.name) + " there"
                            : "parameters are " + listed(known));
      continue;
    }
    if (const GraphNode::Param* twice = node.param(over.name)) {
      error(twice->offset, "parameter " + in_quotes(over.name) + " of " + owner + " is in \"over\", too",
            "remove one of them");
    }
    const std::optional<Json> value = over.value.evaluate(params);
    if (!value || body.params[place->second].broken) {
      good = false;  // reported
      continue;
    }
    if (!value->is_array()) {
      error(over.value.offset,
            owner + " goes over lists; what " + in_quotes(over.name) + " has " + described(*value),
            "declare a parameter of kind list or files and write \"${name}\", or write [\"a\", \"b\"]");
      continue;
    }
    MapList list;
    list.param = &body.params[place->second].decl;
    list.offset = over.value.offset;
    for (const Json& entry : *value) {
      if (entry.is_structured() || entry.is_null()) {
        error(over.value.offset,
              "an entry of a list must be a text, a number, true or false, " + described(entry), {});
        break;
      }
      list.entries.push_back(plain_text(entry));
    }
    lists.push_back(std::move(list));
  }
  if (!good || lists.empty()) return false;
  if (!written.index.empty()) {
    const auto place = body.param_index.find(written.index);
    const auto in_over = [&](const GraphNode::Param& over) { return over.name == written.index; };
    if (place == body.param_index.end()) {
      const std::string hint = did_you_mean(written.index, known);
      error(written.index_offset,
            "map body " + in_quotes(body.source.file()) + " has no parameter " + in_quotes(written.index),
            hint.empty() ? "parameters are " + listed(known) : hint);
      return false;
    }
    if (node.param(written.index) != nullptr ||
        std::any_of(written.over.begin(), written.over.end(), in_over)) {
      error(written.index_offset,
            "parameter " + in_quotes(written.index) + " of " + owner + " has a value already",
            "let \"index\" be another one");
      return false;
    }
    MapList places;
    places.param = &body.params[place->second].decl;
    places.offset = written.index_offset;
    for (std::size_t i = 0; i < lists.front().entries.size(); ++i)
      places.entries.push_back(std::to_string(i));
    lists.push_back(std::move(places));
  }
  const MapList& first = lists.front();
  if (first.entries.empty()) {
    error(first.offset,
          owner + " has nothing to go over: the list for " + in_quotes(first.param->name) + " is empty",
          "give it entries, like --set name=a,b,c");
    return false;
  }
  std::set<std::string> seen;
  for (const std::string& entry : first.entries) {
    if (!seen.insert(entry).second)
      error(first.offset,
            owner + " has " + in_quotes(entry) + " twice in the list for " + in_quotes(first.param->name),
            "the first list names the copies: let it have every entry once");
  }
  for (const MapList& list : lists) {
    if (list.entries.size() == 1 || list.entries.size() == first.entries.size()) continue;
    error(list.offset,
          "the lists of " + owner + " do not go together: " + in_quotes(first.param->name) + " has " +
              std::to_string(first.entries.size()) + ", " + in_quotes(list.param->name) + " has " +
              std::to_string(list.entries.size()) + " entries",
          in_quotes(list.param->name) + " needs one entry for each " + in_quotes(first.param->name) +
              ", or one for all");
  }
  return good;
}

std::optional<Json> entry_value(const GraphFile& file, const MapList& list, std::size_t copy,
                                Findings& findings) {
  const std::size_t index = list.entries.size() == 1 ? 0 : copy;
  const std::string& text = list.entries[index];
  Json value;
  const bool read = from_text(*list.param, text, value);
  const std::string why = read ? list.param->refuse(value) : "is of another kind";
  if (why.empty()) return normalised(*list.param, value);
  const std::string what =
      "entry " + std::to_string(index + 1) + " of the list for " + in_quotes(list.param->name);
  findings.error(file, list.offset,
                 read ? what + " " + why
                      : what + " must be of kind " + kind_name(list.param->kind) + ", is " + in_quotes(text),
                 list.param->doc.empty() ? std::string() : list.param->name + ": " + list.param->doc);
  return std::nullopt;
}

}  // namespace ballflow
