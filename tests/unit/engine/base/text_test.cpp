// Text that is printed for a shell.
#include "ballflow/text.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "process.hpp"

namespace ballflow {
namespace {

TEST(shell_word, leaves_plain_words_alone_and_quotes_the_rest) {
  EXPECT_EQ(shell_word("graphs/a_b-1.json"), "graphs/a_b-1.json");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("\xc3\xa4"), "'\xc3\xa4'");
  EXPECT_EQ(shell_word("a\nb'\\"), "$'a\\012b\\'\\\\'");
  EXPECT_EQ(shell_word("\xff"
                       "7"),
            "$'\\3777'");
}

TEST(shell_word, means_the_same_text_to_a_shell_and_can_always_be_printed) {
  std::mt19937 random(5);
  std::vector<std::string> texts = {"~", "$HOME", "`id`", "!!", "*",           "a=b",
                                    "#", "-n",    "\\",   "\t", "\xe2\x80\xae"};
  const std::string nasty = "'\"\\$`!\n\t *?[]{}()<>|&;~#=%-\x7f\x01\xc3\xa4\xff\x80 aZ09";
  while (texts.size() < 300) {
    std::string text;
    for (std::size_t length = random() % 12; length > 0; --length)
      text += random() % 2 == 0 ? nasty[random() % nasty.size()] : static_cast<char>(1 + random() % 255);
    texts.push_back(text);
  }
  std::string command = "printf '%s\\0'";
  std::string expected;
  for (const std::string& text : texts) {
    const std::string word = shell_word(text);
    EXPECT_EQ(printable(word), word);
    command += " " + word;
    expected += text + '\0';
  }
  const auto result = test::run_process({"/bin/bash", "-c", command});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out == expected);
}

}  // namespace
}  // namespace ballflow
