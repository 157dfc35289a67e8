#include "show/page/page.hpp"

#include <algorithm>
#include <cstdio>

#include "ballflow/error.hpp"
#include "show/page/graph_json.hpp"
#include "show/page/layer_json.hpp"
#include "show/palette.hpp"

namespace ballflow::show {
namespace {

constexpr std::string_view data_mark = "<!-- ballflow data -->";

std::string size_text(std::uint64_t bytes) {
  char text[32];
  const auto size = static_cast<double>(bytes);
  std::snprintf(text, sizeof text, bytes < 1'000'000 ? "%.0f kB" : "%.1f MB",
                bytes < 1'000'000 ? size / 1e3 : size / 1e6);
  return text;
}

/// JSON that may stand in a script element: no "<" can end it or open a comment.
std::string script_json(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

void Page::document(const std::string& type) {
  const NodeDeclaration* decl = registry_.node(type);
  if (decl == nullptr || types_.contains(type)) return;
  Json params = Json::object();
  for (const ParamDecl& param : decl->params) {
    params[param.name] = {{"doc", param.doc}};
    if (!param.unit.empty()) params[param.name]["unit"] = param.unit;
  }
  types_[type] = {{"summary", decl->summary}, {"params", std::move(params)}};
}

void Page::want(const std::string& digest, Wanted wanted) {
  const auto [known, is_new] = wanted_.try_emplace(digest, std::move(wanted));
  if (!is_new) known->second.rank = std::min(known->second.rank, wanted.rank);
}

void Page::add_run(const RunRecord& run) {
  const RunJson parts = run_json(run, graphs_.size());
  for (const auto& node : parts.graph.at("nodes")) {
    document(node.at("type").get<std::string>());
    for (const auto& [port, output] : node.at("outputs").items()) {
      want(output.at("digest").get<std::string>(),
           {node.at("path").get<std::string>() + "." + port, output.at("type").get<std::string>(),
            output.at("bytes").get<std::uint64_t>(), 2, output.at("summary"), nullptr});
    }
  }
  for (const Json& variant : parts.variants) {
    for (const Json& output : variant.at("outputs")) {
      const auto found = wanted_.find(output.at("digest").get<std::string>());
      if (found == wanted_.end()) continue;
      found->second.rank = std::min(found->second.rank, 1);
      found->second.name = output.at("name").get<std::string>();
    }
    variants_.push_back(variant);
  }
  graphs_.push_back(parts.graph);
}

void Page::add_graph(const Dag& dag, const std::vector<NodePlan>& plans) {
  for (const DagNode& node : dag.nodes) document(node.kind.type());
  for (const Json& variant : variants_json(dag, graphs_.size())) variants_.push_back(variant);
  graphs_.push_back(graph_json(dag, plans));
}

void Page::add_artifact(const std::string& name, ArtifactPtr artifact) {
  const std::string digest = artifact->digest().hex();
  const std::string type = artifact->type();
  const std::uint64_t bytes = artifact->file_size();
  loose_.push_back({{"name", name}, {"type", type}, {"digest", digest}});
  Wanted wanted{name, type, bytes, 0, nlohmann::json::parse(artifact->summary()), std::move(artifact)};
  wanted_.insert_or_assign(digest, std::move(wanted));
}

Json Page::packed(const std::string& digest, const Wanted& wanted, const PageSources& sources) {
  const auto missing = [](const std::string& why) { return Json{{"missing", why}}; };
  if (!can_be_shown(wanted.type)) return Json::object();
  const std::size_t before = blocks_.all().size();
  const std::string too_large = "left out: the page would be larger than " + size_text(max_bytes_);
  Json layers = Json::array();
  try {
    ArtifactPtr artifact = wanted.artifact;
    if (artifact == nullptr) {
      if (const auto name = Digest::from_hex(digest)) artifact = sources.load(*name);
    }
    if (artifact == nullptr) return missing("not in the cache any more; the next run makes it again");
    const std::vector<Layer> all = layers_of(*artifact);
    // Indices shrink most, to a quarter and less; what is larger even so is not compressed in vain.
    constexpr std::size_t most_shrinking = 8;
    if (blocks_.bytes() + raw_bytes(all) / most_shrinking > max_bytes_) return missing(too_large);
    for (const Layer& layer : all) {
      layers.push_back(layer_json(layer, blocks_, chains_));
      if (blocks_.bytes() <= max_bytes_) continue;
      blocks_.shrink(before);
      return missing(too_large);
    }
  } catch (const Error& error) {
    blocks_.shrink(before);
    return missing(error.what());
  }
  layers_ += layers.size();
  return {{"layers", std::move(layers)}};
}

void Page::pack(const PageSources& sources) {
  std::vector<std::pair<const std::string, Wanted>*> order;
  for (auto& entry : wanted_) order.push_back(&entry);
  std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return std::tie(a->second.rank, a->second.bytes, a->first) <
           std::tie(b->second.rank, b->second.bytes, b->first);
  });
  std::size_t done = 0;
  for (auto* entry : order) {
    sources.progress(done++, order.size(), blocks_.bytes());
    const Wanted& wanted = entry->second;
    Json json = {{"type", wanted.type}, {"bytes", wanted.bytes}, {"summary", wanted.summary}};
    OutputEntry output;
    output.type = wanted.type;
    output.summary = wanted.summary.dump(-1, ' ', false, Json::error_handler_t::replace);
    json["words"] = sources.describe(output);
    json.update(packed(entry->first, wanted, sources));
    if (json.contains("missing"))
      left_out_.push_back(wanted.name + ": " + json.at("missing").get<std::string>());
    artifacts_[entry->first] = std::move(json);
  }
}

std::string Page::html(const std::string& page_template, const std::string& version) const {
  const std::size_t mark = page_template.find(data_mark);
  if (mark == std::string::npos) {
    throw Error(ExitCode::store, "the template of the viewer has no place for data", "build ballflow again");
  }
  Json scene = {{"version", version},      {"palette", palette_json()}, {"types", types_},
                {"graphs", graphs_},       {"variants", variants_},     {"loose", loose_},
                {"artifacts", artifacts_}, {"left_out", left_out_},     {"blocks", Json::array()},
                {"chains", chains_}};
  for (const Block& block : blocks_.all())
    scene["blocks"].push_back({{"type", to_string(block.type)}, {"count", block.count}});
  const std::string json = script_json(scene);
  if (json.size() > max_bytes_) {
    throw Error(ExitCode::usage,
                "what is known of the nodes alone takes " + size_text(json.size()) + ", more than --max-size",
                "give a larger --max-size, or artifacts instead of the run");
  }
  std::string page;
  page.reserve(page_template.size() + json.size() + blocks_.bytes() + 64 * blocks_.all().size() + 128);
  page.append(page_template, 0, mark);
  page += "<script type=\"application/json\" id=\"ballflow-scene\">" + json + "</script>\n";
  for (std::size_t i = 0; i < blocks_.all().size(); ++i) {
    page += "<script type=\"text/plain\" id=\"block-" + std::to_string(i) + "\">";
    page += blocks_.all()[i].base64;
    page += "</script>\n";
  }
  page.append(page_template, mark + data_mark.size());
  return page;
}

}  // namespace ballflow::show
