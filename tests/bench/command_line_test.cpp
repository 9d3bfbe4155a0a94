// SPDX-License-Identifier: Apache-2.0
#include "bench/command_line.h"

#include <gtest/gtest.h>

namespace dismantle::bench {
namespace {

/// Variables of each kind, and the parser that sets them.
struct Parsed {
  CommandLine line{"test [OPTIONS] [WORD...]"};
  int steps = 5;
  double gap = 0.5;
  std::string folder = "here";
  bool quiet = false;
  char kind = 'a';
  std::vector<int> sizes;
  std::vector<std::string> words;

  bool parse(std::vector<std::string> arguments) {
    line.option("--steps", steps, 1);
    line.option("--gap", gap);
    line.option("--folder", folder);
    line.flag("--quiet", quiet);
    line.choice("--kind", kind, {{"alpha", 'a'}, {"beta", 'b'}});
    line.choices("--size", sizes, {{"small", 1}, {"large", 9}});
    line.words(words);
    arguments.insert(arguments.begin(), "test");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    return line.parse(static_cast<int>(argv.size()), argv.data());
  }
};

TEST(CommandLine, KeepsTheDefaultsWhereNothingIsGiven) {
  Parsed p;
  EXPECT_TRUE(p.parse({}));
  EXPECT_EQ(p.steps, 5);
  EXPECT_EQ(p.gap, 0.5);
  EXPECT_FALSE(p.quiet);
  EXPECT_TRUE(p.words.empty());
}

TEST(CommandLine, SetsOptionsFlagsAndWordsInAnyOrder) {
  Parsed p;
  EXPECT_TRUE(p.parse({"one", "--steps", "12", "--gap", "-2.5e-3", "--quiet", "--folder", "there", "--kind", "beta",
                       "--size", "large", "two", "--size", "small"}));
  EXPECT_EQ(p.steps, 12);
  EXPECT_EQ(p.gap, -2.5e-3);
  EXPECT_EQ(p.folder, "there");
  EXPECT_TRUE(p.quiet);
  EXPECT_EQ(p.kind, 'b');
  EXPECT_EQ(p.sizes, (std::vector<int>{9, 1}));
  EXPECT_EQ(p.words, (std::vector<std::string>{"one", "two"}));
}

TEST(CommandLine, RefusesWhatIsNoOptionNumberOrName) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"--unknown"},
                                                                                         {"--steps"},
                                                                                         {"--steps", "0"},
                                                                                         {"--steps", "3x"},
                                                                                         {"--steps", "1e99"},
                                                                                         {"--gap", ""},
                                                                                         {"--gap", "wide"},
                                                                                         {"--kind", "gamma"},
                                                                                         {"--size", "medium"}}) {
    Parsed p;
    EXPECT_FALSE(p.parse(arguments)) << arguments.front();
  }
}

TEST(CommandLine, TakesOnlyAllowedWordsAndOnlyNumbersWhereTheseAreWanted) {
  std::string program = "test", word = "peg", number = "12", zero = "0";
  char* with_word[] = {program.data(), word.data()};
  char* with_number[] = {program.data(), number.data()};
  char* with_zero[] = {program.data(), zero.data()};

  CommandLine none("test");
  EXPECT_FALSE(none.parse(2, with_word));
  std::vector<std::string> words;
  CommandLine some("test");
  some.words(words, {"peg", "key"});
  EXPECT_TRUE(some.parse(2, with_word));
  EXPECT_FALSE(some.parse(2, with_number));
  std::vector<unsigned> numbers{3, 4};
  CommandLine counts("test");
  counts.numbers(numbers);
  EXPECT_TRUE(counts.parse(2, with_number));
  EXPECT_EQ(numbers, std::vector<unsigned>{12});
  EXPECT_FALSE(counts.parse(2, with_word));
  EXPECT_FALSE(counts.parse(2, with_zero));
}

}  // namespace
}  // namespace dismantle::bench
