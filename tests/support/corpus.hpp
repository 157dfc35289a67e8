// Replays the corpus of a fuzzer, tests/fuzz/<name>/corpus, as a test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "test_data.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ballflow::test {

inline void replay_corpus(const std::string& name) {
  std::size_t inputs = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(source_file("tests/fuzz/" + name + "/corpus"))) {
    const std::string content = read_file(entry.path());
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content.data()), content.size());
    ++inputs;
  }
  EXPECT_GT(inputs, 10u);
}

}  // namespace ballflow::test
