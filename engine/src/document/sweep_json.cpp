// The sections "sweep" and "map" of a graph file.
#include "base/quote.hpp"
#include "document/graph_json.hpp"

namespace ballflow {
namespace {

using json_text::Member;
using json_text::Value;

class SweepReader {
 public:
  SweepReader(GraphFile& file, Findings& findings) : file_(file), findings_(findings) {}

  void read() {
    if (const Member* member = section("sweep")) read_sweep(*member);
    if (const Member* member = section("map")) {
      for (const Member& item : member->value.members) {
        SweepAxis axis = {item.key, item.offset, {}};
        read_values(item.value, "a file pattern", axis);
        file_.maps.push_back(std::move(axis));
      }
    }
  }

 private:
  void error(Offset offset, std::string message, std::string hint = {}) {
    findings_.error(file_, offset, std::move(message), std::move(hint));
  }

  /// Null when there is none or it is no object.
  const Member* section(const char* key) {
    for (const Member& member : file_.root.members) {
      if (member.key != key) continue;
      if (is_object(member.value, in_quotes(key))) return &member;
    }
    return nullptr;
  }

  bool is_object(const Value& value, const std::string& what) {
    if (!value.is_object()) error(value.offset, what + " must be an object, " + described(value.scalar));
    return value.is_object();
  }

  void read_sweep(const Member& member) {
    GraphSweep& sweep = file_.sweep.emplace();
    sweep.offset = member.offset;
    known_keys(file_, findings_, member.value, "a sweep", {"axes", "mode", "exclude"});
    if (member.value.find("axes") == nullptr)
      error(member.offset, "a sweep has \"axes\"", "\"axes\": { \"parameter\": [0.1, 0.3] }");
    for (const Member& field : member.value.members) {
      if (field.key == "mode") read_mode(field.value, sweep);
      if (field.key == "axes" && is_object(field.value, "\"axes\"")) {
        for (const Member& item : field.value.members) {
          SweepAxis axis = {item.key, item.offset, {}};
          if (!item.value.is_array()) {
            error(
                item.value.offset,
                "axis " + in_quotes(item.key) + " must be a list of values, " + described(item.value.scalar),
                in_quotes(item.key) + ": [0.1, 0.3]");
            continue;
          }
          read_values(item.value, "a value of axis " + in_quotes(item.key), axis);
          sweep.axes.push_back(std::move(axis));
        }
      }
      if (field.key == "exclude") read_excluded(field.value, sweep);
    }
  }

  void read_mode(const Value& value, GraphSweep& sweep) {
    const std::string mode = value.is_string() ? value.string() : std::string();
    sweep.zip = mode == "zip";
    if (sweep.zip || mode == "product") return;
    const std::string hint = did_you_mean(mode, {"product", "zip"});
    error(value.offset, "\"mode\" must be \"product\" or \"zip\", " + described(value.scalar),
          hint.empty() ? "product: every combination; zip: the first values of all axes, then the second ones"
                       : hint);
  }

  /// A list of values, or one.
  void read_values(const Value& value, const std::string& what, SweepAxis& axis) {
    if (value.is_array() && value.members.empty())
      error(value.offset, in_quotes(axis.name) + " has no values");
    if (!value.is_array()) return read_value(value, what, axis);
    for (const Member& item : value.members) read_value(item.value, what, axis);
  }

  void read_value(const Value& value, const std::string& what, SweepAxis& axis) {
    if (value.is_object() || value.is_array() || value.scalar.is_null()) {
      error(value.offset, what + " must be a number, a text, true or false, " + described(value.scalar));
      return;
    }
    axis.values.push_back({value.scalar, value.offset});
  }

  void read_excluded(const Value& value, GraphSweep& sweep) {
    if (!value.is_array()) {
      error(value.offset, "\"exclude\" must be a list of combinations, " + described(value.scalar),
            "[{ \"epsilon\": 0.1, \"strategy\": \"exact\" }]");
      return;
    }
    for (const Member& item : value.members) {
      if (!is_object(item.value, "an excluded combination")) continue;
      std::vector<SweepAxis> combination;
      for (const Member& part : item.value.members) {
        SweepAxis axis = {part.key, part.offset, {}};
        read_value(part.value, "the value of " + in_quotes(part.key), axis);
        if (!axis.values.empty()) combination.push_back(std::move(axis));
      }
      if (item.value.members.empty())
        error(item.value.offset, "an excluded combination names at least one parameter");
      sweep.excluded.push_back(std::move(combination));
    }
  }

  GraphFile& file_;
  Findings& findings_;
};

}  // namespace

void read_sweep(GraphFile& file, Findings& findings) { SweepReader(file, findings).read(); }

}  // namespace ballflow
