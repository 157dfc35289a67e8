// What the fuzzer has seen so far is handled; what it finds becomes a file of the corpus.
#include "corpus.hpp"

namespace ballflow {

TEST(artifact_fuzz, handles_its_corpus) { test::replay_corpus("artifact"); }

}  // namespace ballflow
