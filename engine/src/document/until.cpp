#include "document/until.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "base/quote.hpp"

namespace ballflow {
namespace {

using Op = Loop::Comparison::Op;

// Two characters before one: "<=" begins with "<".
constexpr std::pair<const char*, Op> operators[] = {{"==", Op::equal},   {"!=", Op::unequal},
                                                    {"<=", Op::at_most}, {">=", Op::at_least},
                                                    {"<", Op::less},     {">", Op::greater}};
const char* const example = "write it like \"cover.remaining == 0 or cover.gap < 0.01\"";

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  template <class Check>
  std::vector<std::vector<Loop::Comparison>> parse(const Check& check) {
    std::vector<std::vector<Loop::Comparison>> any(1);
    while (true) {
      any.back().push_back(comparison(check));
      skip_space();
      if (at_ == text_.size()) return any;
      const std::size_t begin = at_;
      const std::string word = name();
      if (word == "or") {
        any.emplace_back();
      } else if (word != "and") {
        fail(begin, "expected \"and\", \"or\" or the end, found " + found(begin));
      }
    }
  }

 private:
  [[noreturn]] static void fail(std::size_t at, std::string message) {
    throw UntilProblem{at, std::move(message), example};
  }

  std::string found(std::size_t at) const {
    return at >= text_.size() ? std::string("the end") : in_quotes(text_.substr(at, 20));
  }

  void skip_space() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  /// Letters, digits and _; empty when there are none.
  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_identifier("_" + text_.substr(at_, 1))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  template <class Check>
  Loop::Comparison comparison(const Check& check) {
    Loop::Comparison result;
    skip_space();
    const std::size_t state_at = at_;
    result.state = name();
    if (result.state.empty()) fail(state_at, "expected the name of a state, found " + found(state_at));
    if (at_ >= text_.size() || text_[at_] != '.')
      fail(at_, "expected \".\" and a field of the summary of " + in_quotes(result.state) + ", found " +
                    found(at_));
    const std::size_t field_at = ++at_;
    result.field = name();
    if (result.field.empty())
      fail(field_at,
           "expected a field of the summary of " + in_quotes(result.state) + ", found " + found(field_at));
    check(result, state_at, field_at);
    skip_space();
    const auto* const op =
        std::find_if(std::begin(operators), std::end(operators), [&](const auto& candidate) {
          return text_.compare(at_, std::string::traits_type::length(candidate.first), candidate.first) == 0;
        });
    if (op == std::end(operators)) fail(at_, "expected ==, !=, <, <=, > or >=, found " + found(at_));
    at_ += std::string::traits_type::length(op->first);
    result.op = op->second;
    skip_space();
    const char* const begin = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(begin, end, result.number);
    if (error != std::errc() || !std::isfinite(result.number))
      fail(at_, "expected a number, found " + found(at_));
    at_ += static_cast<std::size_t>(stop - begin);
    if (at_ < text_.size() && text_[at_] != ' ')
      fail(at_, "expected a space after the number, found " + found(at_));
    return result;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

bool holds(const Loop::Comparison& comparison, double value) {
  switch (comparison.op) {
    case Op::equal:
      return value == comparison.number;
    case Op::unequal:
      return value != comparison.number;
    case Op::less:
      return value < comparison.number;
    case Op::at_most:
      return value <= comparison.number;
    case Op::greater:
      return value > comparison.number;
    case Op::at_least:
      return value >= comparison.number;
  }
  return false;
}

}  // namespace

std::vector<std::vector<Loop::Comparison>> parse_until(
    const std::string& text, std::vector<UntilProblem>& problems,
    const std::function<void(const Loop::Comparison&, std::size_t, std::size_t)>& check) {
  try {
    return Parser(text).parse(check);
  } catch (UntilProblem& problem) {
    problems.push_back(std::move(problem));
    return {};
  }
}

std::optional<double> summary_number(const Artifact& artifact, const Loop::Comparison& comparison) {
  const Json summary = Json::parse(artifact.summary());
  const auto field = summary.find(comparison.field);
  if (field == summary.end()) {
    throw Error(ExitCode::node_failed, "the summary of " + in_quotes(comparison.state) + " has no field " +
                                           in_quotes(comparison.field) + ", which \"until\" reads");
  }
  if (field->is_null()) return std::nullopt;
  if (field->is_boolean()) return field->get<bool>() ? 1.0 : 0.0;
  if (!field->is_number()) {
    throw Error(ExitCode::node_failed,
                in_quotes(comparison.state + "." + comparison.field) + " " + described(*field),
                "\"until\" compares numbers");
  }
  return field->get<double>();
}

bool until_holds(const Loop& loop, const std::map<std::string, ArtifactPtr>& states) {
  return std::any_of(loop.conditions.begin(), loop.conditions.end(), [&](const auto& all) {
    return std::all_of(all.begin(), all.end(), [&](const Loop::Comparison& comparison) {
      const std::optional<double> value = summary_number(*states.at(comparison.state), comparison);
      return value && holds(comparison, *value);
    });
  });
}

}  // namespace ballflow
