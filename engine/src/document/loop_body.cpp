#include "document/loop_body.hpp"

#include <algorithm>
#include <utility>

#include "ballflow/text.hpp"
#include "base/quote.hpp"
#include "document/until.hpp"

namespace ballflow {

const std::vector<ParamDecl>& loop_params() {
  static const std::vector<ParamDecl> params = [] {
    ParamDecl until, most, at_limit;
    until.name = "until";
    until.doc =
        "ends the loop, looked at before every iteration: fields of the summaries of states compared with "
        "numbers, joined by \"and\" and \"or\", like \"cover.remaining == 0\"";
    until.required = true;
    most.name = "max_iterations";
    most.doc = "how often the body runs at most";
    most.kind = ParamKind::integer;
    most.default_value = std::int64_t{10'000};
    most.minimum = 1;
    most.maximum = 1'000'000'000;
    at_limit.name = "at_limit";
    at_limit.doc = "what to do when max_iterations have run";
    at_limit.kind = ParamKind::choice;
    at_limit.default_value = "error";
    at_limit.choices = {{"error", "fail"}, {"stop", "go on with the state reached, and warn"}};
    return std::vector<ParamDecl>{until, most, at_limit};
  }();
  return params;
}

bool read_interface(const GraphFile& file, const GraphNode& node, const GraphNode::Loop& written,
                    const GraphFile& body, const Registry& registry, Loop& loop, Findings& findings) {
  const std::string owner = "loop " + in_quotes(node.name);
  bool good = true;
  for (const GraphParam& param : body.params) {
    for (const ParamDecl& own : loop_params()) {
      if (param.decl.name != own.name) continue;
      findings.error(body, param.offset,
                     "the body of " + owner + " cannot have a parameter " + in_quotes(param.decl.name),
                     "every loop has a parameter of that name; choose another one");
      good = false;
    }
  }
  const auto port = [&](const GraphInput& input) {
    PortDecl decl;
    decl.name = input.name;
    decl.type = input.type;
    const TypeDeclaration* type = registry.type(input.type);
    decl.type_version = type == nullptr ? 0 : type->version;
    decl.optional = input.optional;
    return decl;
  };
  for (const GraphInput& input : body.inputs) {
    good = good && !input.broken;
    loop.inputs.push_back(port(input));
  }
  if (body.outputs.empty()) {
    findings.error(file, written.body.offset,
                   owner + " has no state: " + printable(body.source.file()) + " has no \"outputs\"",
                   "a loop passes its outputs to its inputs of the same names");
    good = false;
  }
  for (const GraphOutput& output : body.outputs) {
    const auto input = body.input_index.find(output.name);
    if (input == body.input_index.end()) {
      findings.error(body, output.offset,
                     "output " + in_quotes(output.name) + " is a state of " + owner +
                         ", but there is no input of that name",
                     "a loop passes its outputs to its inputs: declare " + in_quotes(output.name) +
                         " under \"inputs\" with the type of the output");
      good = false;
      continue;
    }
    const GraphInput& state = body.inputs[input->second];
    if (state.optional && !state.broken) {
      findings.error(
          body, state.offset,
          "input " + in_quotes(state.name) + " is a state of " + owner + " and cannot be optional");
      good = false;
    }
    loop.outputs.push_back(port(state));
    loop.outputs.back().optional = false;
  }
  return good;
}

bool read_until(const GraphFile& file, const GraphNode& node, const GraphNode::Loop& written,
                const PlacedSetting* setting, const std::string& text, const Registry& registry, Loop& loop,
                Findings& findings) {
  std::vector<UntilProblem> problems;
  loop.until = text;
  loop.conditions = parse_until(
      text, problems, [&](const Loop::Comparison& comparison, std::size_t state_at, std::size_t field_at) {
        std::vector<std::string> known;
        const auto state = std::find_if(loop.outputs.begin(), loop.outputs.end(),
                                        [&](const PortDecl& port) { return port.name == comparison.state; });
        if (state == loop.outputs.end()) {
          for (const PortDecl& port : loop.outputs) known.push_back(port.name);
          const std::string hint = did_you_mean(comparison.state, known);
          problems.push_back({state_at,
                              "loop " + in_quotes(node.name) + " has no state " + in_quotes(comparison.state),
                              hint.empty() ? "states are " + listed(known) : hint});
          return;
        }
        const TypeDeclaration* const type = registry.type(state->type);
        if (type == nullptr) return;  // reported where the body declares it
        for (const auto& [field, doc] : type->summary) known.push_back(field);
        if (std::find(known.begin(), known.end(), comparison.field) != known.end()) return;
        const std::string hint = did_you_mean(comparison.field, known);
        problems.push_back({field_at,
                            "the summary of a " + type->id + " has no field " + in_quotes(comparison.field),
                            !hint.empty()   ? hint
                            : known.empty() ? "it has no fields"
                                            : "fields are " + listed(known)});
      });
  for (UntilProblem& problem : problems) {
    problem.message = "\"until\": " + problem.message;
    if (setting != nullptr) {
      findings.add(about_setting(*setting, std::move(problem.message), std::move(problem.hint)));
      continue;
    }
    // Inside the text when it stands in the file as it is, without escapes and parameters.
    const std::size_t begin = written.param("until")->value.offset;
    const bool verbatim = file.source.content().substr(begin + 1, text.size()) == text &&
                          file.source.content().substr(begin + 1 + text.size(), 1) == "\"";
    findings.error(file, static_cast<Offset>(verbatim ? begin + 1 + problem.at : begin),
                   std::move(problem.message), std::move(problem.hint));
  }
  return problems.empty();
}

}  // namespace ballflow
