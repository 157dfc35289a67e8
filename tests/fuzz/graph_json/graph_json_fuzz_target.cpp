// One input of the fuzzer: the text of a graph file over the toy nodes. It is accepted, or every finding
// about it has a message and a place.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "ballflow/graph.hpp"
#include "toy_nodes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ballflow;
  static const Registry registry = test::toy_registry();
  const std::string text(reinterpret_cast<const char*>(data), size);
  // Subgraphs are looked for in a folder that does not exist: the text is the only input.
  try {
    parse_graph(text, "/nowhere/else/graph.json", registry, {});
  } catch (const GraphError& error) {
    if (error.findings().empty()) std::abort();
    for (const Diagnostic& finding : error.findings()) {
      if (finding.message.empty() || finding.line < 0 || finding.column < 0) std::abort();
    }
  }
  return 0;
}
