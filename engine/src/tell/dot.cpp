#include "ballflow/dot.hpp"

#include <algorithm>

#include "base/quote.hpp"

namespace ballflow {
namespace {

/// Inside an HTML-like label.
std::string html(std::string_view text) {
  std::string result;
  for (const char c : printable(text)) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

/// A quoted DOT string; entities are understood in it.
std::string dot_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '&' ? std::string("&amp;") : std::string(1, c);
  }
  return result + '"';
}

std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 48;
  if (text.size() <= longest) return text;
  std::size_t cut = longest;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0) == 0x80) --cut;
  return text.substr(0, cut) + "...";
}

/// Names of the subgraphs around a node: "a/b/c" -> "a/b".
std::string parent(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

class Writer {
 public:
  std::string write(const Dag& dag, const std::vector<NodePlan>& plans) {
    text_ = "digraph " + dot_string(dag.file) + " {\n  rankdir=LR;\n  label=" + dot_string(dag.doc) +
            ";\n  node [shape=plain, fontname=\"sans-serif\", fontsize=11];\n"
            "  edge [arrowsize=0.7];\n  fontname=\"sans-serif\";\n";
    nodes(dag, "n", "", plans);
    for (std::size_t i = 0; i < dag.outputs.size(); ++i) {
      const DagOutput& output = dag.outputs[i];
      const std::string id = "out" + std::to_string(i);
      line("  ", id + " [shape=note, label=" + dot_string(output.name) + "];");
      line("  ", out_port("n", output.from) + " -> " + id + ";");
    }
    return text_ + "}\n";
  }

 private:
  void line(const std::string& indent, const std::string& text) { text_ += indent + text + "\n"; }

  static std::string node_id(const std::string& prefix, std::size_t i) { return prefix + std::to_string(i); }
  static std::string out_port(const std::string& prefix, const EdgeRef& edge) {
    return node_id(prefix, edge.node) + ":out_" + edge.port + ":e";
  }

  /// All nodes of a graph or body. The ones of a subgraph stand together, whatever their order is.
  void nodes(const Dag& dag, const std::string& prefix, const std::string& inside,
             const std::vector<NodePlan>& plans) {
    std::vector<std::size_t> order(dag.nodes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<std::string> place(order.size());  // what sorts the nodes of "a/b" before those of "a-b"
    for (std::size_t i = 0; i < order.size(); ++i) {
      place[i] = parent(dag.nodes[i].path);
      std::replace(place[i].begin(), place[i].end(), '/', '\1');
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
    std::vector<std::string> open;  // subgraphs, outermost first
    const auto indent = [&] { return std::string(2 * (open.size() + depth_ + 1), ' '); };
    const auto close_to = [&](const std::string& path) {
      while (!open.empty() && path != open.back() && path.rfind(open.back() + "/", 0) != 0) {
        open.pop_back();
        line(indent(), "}");
      }
    };
    for (const std::size_t i : order) {
      const std::string around = parent(dag.nodes[i].path);
      close_to(around);
      while ((open.empty() ? inside : open.back()) != around) {
        const std::string& base = open.empty() ? inside : open.back();
        const std::size_t slash = around.find('/', base.empty() ? 0 : base.size() + 1);
        const std::string next = around.substr(0, slash);
        line(indent(), "subgraph \"cluster_" + std::to_string(clusters_++) + "\" {");
        open.push_back(next);
        line(indent(), "label=" + dot_string(last_name(next)) + "; style=rounded; color=gray50;");
      }
      depth_ += open.size();
      node(dag.nodes[i], node_id(prefix, i), i < plans.size() ? to_string(plans[i].verdict) : "");
      depth_ -= open.size();
    }
    close_to("/");  // no path begins so
    for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
      for (const auto& [port, edge] : dag.nodes[i].inputs) {
        if (edge.node == loop_input) continue;  // drawn by the loop
        line(indent(), out_port(prefix, edge) + " -> " + node_id(prefix, i) + ":in_" +
                           std::string(port_of_slot(port)) + ":w;");
      }
    }
  }

  void node(const DagNode& node, const std::string& id, std::string_view verdict) {
    const std::string indent(2 * (depth_ + 1), ' ');
    if (node.kind.loop() == nullptr) return line(indent, id + " [label=" + table(node, verdict) + "];");
    const Loop& loop = *node.kind.loop();
    line(indent, "subgraph \"cluster_" + std::to_string(clusters_++) + "\" {");
    line(indent + "  ", "label=" + dot_string("loop until " + loop.until) + "; style=\"rounded,dashed\";");
    line(indent + "  ", id + " [label=" + table(node, verdict) + "];");
    ++depth_;
    nodes(loop.body, id + "_", node.path, {});
    --depth_;
    for (std::size_t i = 0; i < loop.body.nodes.size(); ++i) {
      for (const auto& [port, edge] : loop.body.nodes[i].inputs) {
        if (edge.node != loop_input) continue;
        line(indent + "  ", id + ":in_" + edge.port + " -> " + node_id(id + "_", i) + ":in_" +
                                std::string(port_of_slot(port)) + ":w [color=gray50];");
      }
    }
    for (const DagOutput& state : loop.body.outputs) {
      if (state.from.node == loop_input) continue;  // a state that the body does not change
      line(indent + "  ", out_port(id + "_", state.from) + " -> " + id + ":out_" + state.name +
                              " [style=dashed, constraint=false];");
    }
    line(indent, "}");
  }

  static std::string ports(const char* prefix, const std::vector<PortDecl>& ports) {
    if (ports.empty()) return {};
    std::string cells;
    for (const PortDecl& port : ports) {
      cells += "<TR><TD PORT=\"" + std::string(prefix) + port.name + "\">" + html(port.name) + "</TD></TR>";
    }
    return "<TD><TABLE BORDER=\"0\" CELLSPACING=\"0\">" + cells + "</TABLE></TD>";
  }

  static std::string table(const DagNode& node, std::string_view verdict) {
    std::string middle = "<B>" + html(last_name(node.path)) + "</B><BR/>" + html(node.kind.type());
    for (const ParamDecl& param : node.kind.params()) {
      const Json& value = node.params.at(param.name);
      if (!param.required && value == param.default_value) continue;
      middle += "<BR/><I>" + html(param.name) + " = " + html(shortened(plain_text(value))) + "</I>";
    }
    if (!verdict.empty()) middle += "<BR/><B>" + html(verdict) + "</B>";
    const char* color = verdict == "HIT"     ? "palegreen"
                        : verdict == "RUN"   ? "lightsalmon"
                        : verdict == "MAYBE" ? "khaki"
                                             : "white";
    return std::string("<<TABLE BORDER=\"1\" CELLBORDER=\"0\" CELLSPACING=\"0\" BGCOLOR=\"") + color +
           "\"><TR>" + ports("in_", node.kind.inputs()) + "<TD>" + middle + "</TD>" +
           ports("out_", node.kind.outputs()) + "</TR></TABLE>>";
  }

  std::string text_;
  std::size_t clusters_ = 0, depth_ = 0;
};

}  // namespace

std::string dot(const Dag& dag, const std::vector<NodePlan>& plans) { return Writer().write(dag, plans); }

}  // namespace ballflow
