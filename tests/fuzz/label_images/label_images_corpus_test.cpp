// Damaged label images, and what the fuzzer finds, are read or refused.
#include "corpus.hpp"

namespace ballflow {

TEST(label_images_fuzz, handles_its_corpus) { test::replay_corpus("label_images"); }

}  // namespace ballflow
