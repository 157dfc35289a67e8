// What the fuzzer has seen so far is handled; what it finds becomes a file of the corpus.
#include "corpus.hpp"

namespace ballflow {

TEST(mesh_readers_fuzz, handles_its_corpus) { test::replay_corpus("mesh_readers"); }

}  // namespace ballflow
