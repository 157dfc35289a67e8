// What the fuzzer has seen so far is handled; what it finds becomes a file of the corpus.
#include "corpus.hpp"

namespace ballflow {

TEST(graph_json_fuzz, handles_its_corpus) { test::replay_corpus("graph_json"); }

}  // namespace ballflow
