#include "document/graph_file.hpp"

#include <algorithm>
#include <utility>

#include "base/quote.hpp"

namespace ballflow {

std::optional<Json> Template::evaluate(const std::vector<std::optional<Json>>& params) const {
  if (broken) return std::nullopt;
  if (fixed) return *fixed;
  for (const Part& part : parts) {
    if (part.param && !params[*part.param]) return std::nullopt;
  }
  if (parts.size() == 1 && parts[0].param) return params[*parts[0].param];
  std::string text;
  for (const Part& part : parts) text += part.param ? plain_text(*params[*part.param]) : part.text;
  return Json(std::move(text));
}

namespace {

template <class Item, class Key>
const Item* find_sorted(const std::vector<Item>& items, const std::string& name, Key key) {
  const auto place =
      std::lower_bound(items.begin(), items.end(), name,
                       [&](const Item& item, const std::string& wanted) { return item.*key < wanted; });
  return place != items.end() && (*place).*key == name ? &*place : nullptr;
}

}  // namespace

const GraphNode::Input* GraphNode::input(const std::string& port) const {
  return find_sorted(inputs, port, &Input::port);
}
const GraphNode::Param* GraphNode::param(const std::string& wanted) const {
  return find_sorted(params, wanted, &Param::name);
}
const GraphNode::Param* GraphNode::Loop::param(const std::string& wanted) const {
  return find_sorted(params, wanted, &Param::name);
}

}  // namespace ballflow
