#include "terminal/facts.hpp"

#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

constexpr std::size_t most_facts = 3;

class Facts {
 public:
  Facts(const NamedOutputs& outputs, const Json& params) : outputs_(outputs), params_(params) {}

  std::vector<std::string> find() {
    for (const char* type : {"BallDistance", "Way", "ShapeFit", "ShapePrior"}) {
      if (const OutputEntry* const answer = of_type(type)) facts_.push_back(describe(*answer));
    }
    balls();
    topology();
    coverage();
    if (facts_.size() > most_facts) facts_.resize(most_facts);
    others();
    if (facts_.size() > most_facts) facts_.resize(most_facts);
    return facts_;
  }

 private:
  const OutputEntry* of_type(const std::string& type) const {
    for (const auto& [name, output] : outputs_) {
      if (output.type == type) return &output;
    }
    return nullptr;
  }
  static Json summary(const OutputEntry& output) { return Json::parse(output.summary, nullptr, false); }

  /// How many, out of which scaling, and how few there could be.
  bool ellipsoids() {
    const OutputEntry* const pieces = of_type("Ellipsoids");
    if (pieces == nullptr) return false;
    std::string words = describe(*pieces);
    if (const OutputEntry* const cover = of_type("CoverState")) {
      const Json s = summary(*cover);
      if (s.contains("lower_bound") && s.at("lower_bound").is_number())
        words += ", at least " + s.at("lower_bound").dump() + " needed";
    }
    facts_.push_back(words);
    if (const OutputEntry* const scaling = of_type("Scaling")) facts_.push_back(describe(*scaling));
    return true;
  }

  void balls() {
    if (ellipsoids()) return;
    if (const OutputEntry* const cover = of_type("CoverState")) {
      if (const std::int64_t chosen = summary(*cover).value("chosen", std::int64_t{0}); chosen > 0) {
        std::string words = describe(*cover);
        // What was chosen the cover does not know, but the graph gives it out.
        const std::size_t verb = words.find(" chosen");
        if (verb != std::string::npos && of_type("Balls") != nullptr)
          words.insert(verb, chosen == 1 ? " ball" : " balls");
        facts_.push_back(words);
        return;
      }
    }
    // The result stands last: the sum of two solids, say.
    const std::pair<std::string, OutputEntry>* result = nullptr;
    for (const auto& output : outputs_) {
      if (output.second.type == "Balls" && (result == nullptr || result->first != "balls")) result = &output;
    }
    if (result == nullptr) return;
    const std::string words = describe(result->second);
    facts_.push_back(words.find(result->first) == std::string::npos ? result->first + ": " + words : words);
  }

  void topology() {
    for (const char* type : {"TopologyTable", "TopologyCheck"}) {
      const OutputEntry* const output = of_type(type);
      if (output == nullptr) continue;
      const Json s = summary(*output);
      const std::string words = s.value("words", "");
      if (words.empty() || words == "unknown") continue;
      if (!s.contains("changes") || !s.at("changes").is_number()) {
        facts_.push_back("topology: " + words);
      } else if (s.at("changes") == 0) {
        // Nothing was lost on the way; whether it began with the topology of the solid is another question.
        const bool unknown = s.contains("surface") && s.at("surface").is_null();
        facts_.push_back((unknown ? "topology kept from the inner balls on, that of a solid is not known: "
                                  : "topology kept: ") +
                         words);
      } else {
        const std::string remedy = remedy_for(words, params_);
        facts_.push_back("topology CHANGED: " + words + (remedy.empty() ? "" : "; " + remedy));
      }
      return;
    }
  }

  void coverage() {
    if (const OutputEntry* const fit = of_type("EnclosureFit")) facts_.push_back(describe(*fit));
    if (const OutputEntry* const enclosure = of_type("Enclosure")) facts_.push_back(describe(*enclosure));
    const OutputEntry* const check = of_type("CoverCheck");
    if (check == nullptr) return;
    const Json s = summary(*check);
    if (s.contains("covered") && s.contains("samples") && s.at("covered") != s.at("samples"))
      facts_.push_back("NOT everything is covered: " + describe(*check));
  }

  void others() {
    if (const OutputEntry* const surface = of_type("SurfaceReport"))
      facts_.push_back("surface: " + describe(*surface));
    for (const char* type :
         {"Comparison", "OutlineComparison", "MinkowskiReport", "MeshReport", "Bisection"}) {
      if (const OutputEntry* const output = of_type(type)) facts_.push_back(describe(*output));
    }
    if (const OutputEntry* const mass = of_type("MassProperties")) facts_.push_back(describe(*mass));
    if (const OutputEntry* const axis = of_type("MedialAxis"))
      facts_.push_back("medial axis: " + describe(*axis));
  }

  const NamedOutputs& outputs_;
  const Json& params_;
  std::vector<std::string> facts_;
};

}  // namespace

std::string remedy_for(const std::string& warning, const Json& params) {
  const auto says = [&](const char* words) { return warning.find(words) != std::string::npos; };
  if (says("the mesh is open") || says("topology of the solid is unknown"))
    return "\"ballflow look FILE\" says what is wrong with the surface, where, and what closes it";
  const bool change = says(" opened ") || says(" closed ") || says(" added ") || says(" joined or lost ");
  if (!change || !params.is_object()) return "";
  // The first step that changes something is the one to look at.
  const auto param = [&](const char* name) {
    return params.contains(name) && params.at(name).is_string() ? params.at(name).get<std::string>()
                                                                : std::string();
  };
  if (says("the union of inner balls")) {
    const std::string sampling = param("sampling");
    if (sampling == "vertices" || sampling == "surface")
      return "--set sampling=adaptive takes samples that follow walls and slots";
    const std::string look = "\"ballflow look FILE\" says where the shape is thin";
    return sampling.empty() ? "the samples are too far apart for a wall or a slot: " + look
                            : "a smaller delta takes more samples; " + look;
  }
  if (says("growing") && params.contains("epsilon")) {
    const std::string growth = param("growth");
    std::string text = "a smaller epsilon grows less";
    if (growth != "power_diagram")
      text += std::string(", --set ") + (growth.empty() ? "enlarge.mode" : "growth") +
              "=power_diagram only as far as the topology allows";
    return text;
  }
  if (says("pruning") && params.value("repair", "") == "none")
    return "--set repair=topology returns the balls that pruning should have kept";
  return "";
}

std::vector<std::string> key_facts(const NamedOutputs& outputs, const Json& params) {
  try {
    return Facts(outputs, params).find();
  } catch (const Json::exception&) {  // another library's idea of a summary
    return {};
  }
}

}  // namespace ballflow::cli
