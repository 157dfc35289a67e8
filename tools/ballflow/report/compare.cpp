#include "report/compare.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "ballflow/error.hpp"
#include "ballflow/graph.hpp"
#include "ballflow/text.hpp"
#include "report/member.hpp"

namespace ballflow::cli {
namespace {

using Value = nlohmann::json;

std::string text_at(const Value& object, const std::string& name) {
  const Value& value = member(object, name);
  return value.is_string() ? value.get<std::string>() : std::string();
}

double number_at(const Value& object, const std::string& name) {
  const Value& value = member(object, name);
  return value.is_number() ? value.get<double>() : 0;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts = {""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// What one row is about.
class Subject {
 public:
  Subject(const RunRecord& run, const Value* variant, const std::map<std::string, int>& users)
      : run_(run), variant_(variant) {
    const Value& nodes = member(run.report, "nodes");
    const auto add = [&](const std::string& path, bool shared) {
      const Value& node = member(nodes, path);
      if (!node.is_object()) return;
      nodes_[base_path(path)] = &node;
      const std::string status = text_at(node, "status");
      ran_ += status == "run" || status == "failed" ? 1 : 0;
      hit_ += status == "hit" ? 1 : 0;
      // Reports of older versions do not say what a hit cost.
      const char* const cost = member(node, "cost_seconds").is_number() ? "cost_seconds" : "seconds";
      (shared ? shared_seconds_ : seconds_) += number_at(node, cost);
    };
    if (variant == nullptr) {
      for (const auto& [path, node] : nodes.items()) add(path, false);
    } else {
      for (const Value& path : member(*variant, "nodes")) {
        if (!path.is_string()) continue;
        const auto count = users.find(path.get<std::string>());
        add(path.get<std::string>(), count != users.end() && count->second > 1);
      }
    }
  }

  const RunRecord& run() const { return run_; }
  bool is_variant() const { return variant_ != nullptr; }
  const Value& params() const { return member(variant_ != nullptr ? *variant_ : run_.report, "params"); }
  std::string status() const { return text_at(variant_ != nullptr ? *variant_ : run_.report, "status"); }
  double seconds() const { return seconds_; }
  double shared_seconds() const { return shared_seconds_; }
  int ran() const { return ran_; }
  int hit() const { return hit_; }

  /// Names and summaries of the outputs of the graph.
  std::vector<std::pair<std::string, const Value*>> outputs() const {
    std::vector<std::pair<std::string, const Value*>> found;
    const std::string prefix = variant_ != nullptr ? text_at(*variant_, "name") + "/" : "";
    const Value& all = member(run_.report, "outputs");
    if (!all.is_object()) return found;
    // Sorted by name: those of a variant are one after the other.
    const auto& items = all.get_ref<const Value::object_t&>();
    for (auto item = items.lower_bound(prefix); item != items.end() && item->first.starts_with(prefix);
         ++item)
      found.emplace_back(item->first.substr(prefix.size()), &member(item->second, "summary"));
    return found;
  }

  /// The value of a field, or null; an object when the name stands for all fields of a summary.
  const Value& find(const std::string& field) const {
    static const Value null;
    if (const Value& value = of_output(field); !value.is_null()) return value;
    std::string name = field;
    std::replace(name.begin(), name.end(), '/', '.');
    const std::vector<std::string> parts = split(name, '.');
    const std::string prefix = variant_ != nullptr ? text_at(*variant_, "name") + "/" : "";
    const Value& output = member(member(run_.report, "outputs"), prefix + parts[0]);
    if (output.is_object()) {
      const Value& value = inside(member(output, "summary"), parts, 1);
      if (!value.is_null()) return value;
    }
    std::string path = parts[0];
    for (std::size_t i = 1; i < parts.size(); path += "/" + parts[i++]) {
      const Value& value = of_node(path, parts, i);
      if (!value.is_null()) return value;
      // An output of a subgraph is a port of one of its nodes.
      const Value& subgraphs = member(variant_ != nullptr ? *variant_ : run_.report, "subgraphs");
      const std::string port = text_at(subgraphs, path + "." + parts[i]);
      if (const std::size_t dot = port.rfind('.'); dot != std::string::npos) {
        std::vector<std::string> inner = parts;
        inner[i] = port.substr(dot + 1);
        const Value& there = of_node(base_path(port.substr(0, dot)), inner, i);
        if (!there.is_null()) return there;
      }
    }
    return null;
  }

  /// Every field that `find` knows, for suggestions.
  void list_fields(std::set<std::string>& names) const {
    const auto add = [&names](const std::string& owner, const Value& summary) {
      if (!summary.is_object()) return;
      for (const auto& [field, value] : summary.items()) names.insert(owner + "." + field);
    };
    for (const auto& [name, summary] : outputs()) add(name, *summary);
    for (const auto& [path, node] : nodes_) {
      std::string owner = path;
      std::replace(owner.begin(), owner.end(), '/', '.');
      const Value& ports = member(*node, "outputs");
      if (ports.is_object()) {
        for (const auto& [port, output] : ports.items()) add(owner + "." + port, member(output, "summary"));
      }
      add(owner, member(*node, "params"));
    }
  }

 private:
  /// The field of an output by its whole name, which may have dots: outputs of maps over files have.
  const Value& of_output(const std::string& field) const {
    static const Value null;
    const std::pair<std::string, const Value*>* longest = nullptr;
    const auto all = outputs();
    for (const auto& output : all) {
      const std::string& name = output.first;
      if (field != name && !field.starts_with(name + ".")) continue;
      if (longest == nullptr || name.size() > longest->first.size()) longest = &output;
    }
    if (longest == nullptr) return null;
    const std::string rest = field.substr(longest->first.size());
    return inside(*longest->second, split(rest, '.'), 1);
  }
  /// parts[at] is a parameter or a port of the node.
  const Value& of_node(const std::string& path, const std::vector<std::string>& parts, std::size_t at) const {
    static const Value null;
    const auto node = nodes_.find(path);
    if (node == nodes_.end()) return null;
    const Value& output = member(member(*node->second, "outputs"), parts[at]);
    if (output.is_object()) return inside(member(output, "summary"), parts, at + 1);
    return at + 1 == parts.size() ? member(member(*node->second, "params"), parts[at]) : null;
  }

  /// Follows names into objects and numbers into lists.
  static const Value& inside(const Value& value, const std::vector<std::string>& parts, std::size_t at) {
    static const Value null;
    const Value* here = &value;
    for (; at < parts.size(); ++at) {
      if (here->is_object()) {
        here = &member(*here, parts[at]);
      } else if (here->is_array() && !parts[at].empty() && parts[at].size() < 7 &&
                 parts[at].find_first_not_of("0123456789") == std::string::npos &&
                 std::stoul(parts[at]) < here->size()) {
        here = &(*here)[std::stoul(parts[at])];
      } else {
        return null;
      }
    }
    return *here;
  }

  const RunRecord& run_;
  const Value* variant_;
  std::map<std::string, const Value*> nodes_;  // by path
  double seconds_ = 0, shared_seconds_ = 0;
  int ran_ = 0, hit_ = 0;
};

std::vector<Subject> subjects_of(const std::vector<RunRecord>& runs) {
  std::vector<Subject> subjects;
  for (const RunRecord& run : runs) {
    const Value& variants = member(run.report, "variants");
    if (!variants.is_array() || variants.empty()) {
      subjects.emplace_back(run, nullptr, std::map<std::string, int>());
      continue;
    }
    std::map<std::string, int> users;
    for (const Value& variant : variants) {
      for (const Value& path : member(variant, "nodes")) {
        if (path.is_string()) ++users[path.get<std::string>()];
      }
    }
    for (const Value& variant : variants) subjects.emplace_back(run, &variant, users);
  }
  return subjects;
}

class Comparer {
 public:
  explicit Comparer(const std::vector<RunRecord>& runs) : runs_(runs), subjects_(subjects_of(runs)) {
    result_.rows.resize(subjects_.size());
  }

  Comparison run(const std::vector<std::string>& fields) {
    if (runs_.size() > 1) add("run", [](const Subject& s) { return Value(s.run().id); });
    add_params();
    if (fields.empty()) {
      add_varying_fields();
    } else {
      for (const std::string& field : fields) add_field(field);
    }
    const bool all_good =
        std::all_of(subjects_.begin(), subjects_.end(), [](const Subject& s) { return s.status() == "ok"; });
    if (!all_good) add("status", [](const Subject& s) { return Value(s.status()); });
    add("seconds", [](const Subject& s) { return Value(s.seconds()); });
    result_.shared =
        std::any_of(subjects_.begin(), subjects_.end(), [](const Subject& s) { return s.is_variant(); });
    if (result_.shared) add("shared_seconds", [](const Subject& s) { return Value(s.shared_seconds()); });
    add("run_nodes", [](const Subject& s) { return Value(s.ran()); });
    add("hit_nodes", [](const Subject& s) { return Value(s.hit()); });
    return std::move(result_);
  }

 private:
  template <class Function>
  void add(const std::string& name, Function value) {
    bool number = true;
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      result_.rows[i].push_back(value(subjects_[i]));
      number = number && (result_.rows[i].back().is_number() || result_.rows[i].back().is_null());
    }
    result_.columns.push_back({name, number});
  }

  template <class Function>
  bool varies(Function value) const {
    return std::any_of(subjects_.begin(), subjects_.end(),
                       [&](const Subject& s) { return value(s) != value(subjects_.front()); });
  }

  void add_params() {
    std::vector<std::string> names;
    const auto note = [&](const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const RunRecord& run : runs_) {
      for (const Value& axis : member(run.report, "axes")) {
        if (axis.is_string()) note(axis.get<std::string>());
      }
    }
    const std::size_t axes = names.size();
    for (const RunRecord& run : runs_) {
      const Value& params = member(run.report, "params");
      if (runs_.size() < 2 || !params.is_object()) continue;
      for (const auto& [name, value] : params.items()) note(name);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto value = [&name = names[i]](const Subject& s) {
        const Value& own = member(s.params(), name);
        return own.is_null() ? member(member(s.run().report, "params"), name) : own;
      };
      if (i < axes || varies(value)) add(names[i], value);
    }
  }

  void add_varying_fields() {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (const Subject& subject : subjects_) {
      for (const auto& [output, summary] : subject.outputs()) {
        if (!summary->is_object()) continue;
        for (const auto& [field, value] : summary->items()) {
          if (!value.is_structured() && known.insert(output + "." + field).second)
            names.push_back(output + "." + field);
        }
      }
    }
    std::size_t added = 0;
    for (const std::string& name : names) {
      const auto value = [&name](const Subject& s) { return s.find(name); };
      if (subjects_.size() > 1 && !varies(value)) continue;
      if (++added > most_fields) {
        result_.left_out.push_back(name);
      } else {
        add(name, value);
      }
    }
  }

  void add_field(const std::string& field) {
    if (field == "all") {
      std::set<std::string> outputs;
      for (const Subject& subject : subjects_) {
        for (const auto& [output, summary] : subject.outputs()) outputs.insert(output);
      }
      for (const std::string& output : outputs) add_field(output);
      return;
    }
    std::set<std::string> inner;
    bool known = false;
    for (const Subject& subject : subjects_) {
      const Value& value = subject.find(field);
      known = known || !value.is_null();
      if (!value.is_object()) continue;
      for (const auto& [name, part] : value.items()) inner.insert(field + "." + name);
    }
    if (!known) refuse(field);
    if (inner.empty()) inner.insert(field);
    for (const std::string& name : inner) add(name, [&name](const Subject& s) { return s.find(name); });
  }

  [[noreturn]] void refuse(const std::string& field) const {
    std::set<std::string> known;
    for (const Subject& subject : subjects_) subject.list_fields(known);
    const std::vector<std::string> names(known.begin(), known.end());
    std::string wanted = field;
    std::replace(wanted.begin(), wanted.end(), '/', '.');
    std::string hint;
    if (const std::string near = nearest(wanted, names); !near.empty()) {
      hint = "did you mean \"" + near + "\"?";
    } else {
      for (std::size_t i = 0; i < names.size() && i < 12; ++i)
        hint += (i == 0 ? "fields are " : ", ") + names[i];
      if (names.size() > 12) hint += " and " + std::to_string(names.size() - 12) + " more";
    }
    throw Error(ExitCode::usage, "no run has a field \"" + field + "\"", hint);
  }

  const std::vector<RunRecord>& runs_;
  std::vector<Subject> subjects_;
  Comparison result_;
};

}  // namespace

Comparison compare(const std::vector<RunRecord>& runs, const std::vector<std::string>& fields) {
  return Comparer(runs).run(fields);
}

}  // namespace ballflow::cli
