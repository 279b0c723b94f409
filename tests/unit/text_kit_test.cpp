// SPDX-License-Identifier: Apache-2.0
// What every reader of a text shares: numbers at its front, blanks, lists of words, what is wrong.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "base/angle.hpp"
#include "base/diagnostics.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

TEST(TextKit, ANumberIsTakenOffTheFrontAndElseNothingIs) {
  std::string_view text = "+1.5e1mm";
  EXPECT_EQ(take_number<double>(text), 15.0);
  EXPECT_EQ(text, "mm");
  EXPECT_FALSE(take_number<double>(text));
  EXPECT_EQ(text, "mm");
  text = "-7.";
  EXPECT_EQ(take_number<int>(text), -7);
  EXPECT_EQ(text, ".");
  for (const char* none : {"", "+5", "300", "x1"}) {
    text = none;
    EXPECT_FALSE(take_number<signed char>(text)) << none;
    EXPECT_EQ(text, none);
  }
}

// A control takes "X5E3" as X5 and a word E3.
TEST(TextKit, APlainNumberHasNoExponent) {
  for (const auto& [written, value, rest] : {std::tuple{"5E3", 5.0, "E3"},
                                             {"-.5Y", -0.5, "Y"},
                                             {"+12.", 12.0, ""},
                                             {"1.2.3", 1.2, ".3"}}) {
    std::string_view text = written;
    EXPECT_EQ(take_plain_number(text), value) << written;
    EXPECT_EQ(text, rest);
  }
  for (std::string_view none : {"", "+", "-.", "+-5", "inf", "nan", "E3"})
    EXPECT_FALSE(take_plain_number(none)) << none;
}

TEST(TextKit, ADigitIsWorthItsPlace) {
  EXPECT_EQ(digit_worth(1234.0, 1), 1000.0);
  EXPECT_EQ(digit_worth(1234.0, 2), 100.0);
  EXPECT_NEAR(digit_worth(0.0567, 2), 1e-3, 4.0 * std::numeric_limits<double>::epsilon() * 1e-3);
}

TEST(TextKit, TrimmedTextLiesInItsText) {
  const std::string_view text = " \t a b\r", none = " \t";
  EXPECT_EQ(trimmed(text), "a b");
  EXPECT_EQ(trimmed("\n<a>\n"), "\n<a>\n");
  EXPECT_EQ(trimmed("\n<a>\n", blanks_of_text), "<a>");
  EXPECT_TRUE(trimmed(none).empty());
  EXPECT_LE(trimmed(none).data(), none.data() + none.size());
  EXPECT_GE(trimmed(none).data(), none.data());
}

TEST(TextKit, WordsStandInAList) {
  EXPECT_EQ(word_list(std::vector<std::string>{"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(word_list(std::vector{1.5, 2.0}, " ", exact_text), "1.5 2");
  EXPECT_EQ(word_list(std::vector<std::string>{}), "");
  EXPECT_EQ(lower_case("X_M\xC3\x84"), "x_m\xC3\x84");  // Ä stays as it is
  EXPECT_EQ(upper_case('g'), 'G');
}

TEST(TextKit, AnglesAreHeldWithoutWholeTurns) {
  // Rounding of a sum of turns: two of its ulps.
  constexpr double near = 2.0 * 40.0 * std::numeric_limits<double>::epsilon();
  for (const double rad : {0.25, 3.0, 6.0})
    for (const int turns : {-5, 0, 5}) {
      EXPECT_NEAR(within_turn(rad + turns * two_pi), rad, near);
      EXPECT_NEAR(apart_rad(rad + turns * two_pi, rad - 0.125), 0.125, near);
    }
}

TEST(TextKit, APercentageNeverRoundsToCertainty) {
  EXPECT_EQ(layout::percent_of(0.9964), "99.6 %");
  EXPECT_EQ(layout::percent_of(0.9996), "> 99.9 %");
  EXPECT_EQ(layout::percent_of(0.514), "51 %");
  EXPECT_EQ(layout::percent_of(0.0004), "< 0.1 %");
}

TEST(TextKit, ALargeNumberHasNoExponent) {
  EXPECT_EQ(significant(1803.4, 3), "1803");
  EXPECT_EQ(significant(999.7, 3), "1000");
  EXPECT_EQ(significant(-943.0, 2), "-943");
  EXPECT_EQ(significant(94.26, 3), "94.3");
  EXPECT_EQ(significant(0.00004, 2), "4e-05");
}

TEST(TextKit, WhatIsWrongWithSeveralIsThrownTogetherUnderTheNameOfItsFile) {
  const auto read = [](const std::string& name) {
    if (name != "good") throw InputError(name, "is bad");
    return name.size();
  };
  EXPECT_EQ(read_each(std::vector<std::string>{"good", "good"}, read),
            (std::vector<std::size_t>{4, 4}));
  try {
    of_file("job.toml", [&] { return read_each(std::vector<std::string>{"", "good", "b"}, read); });
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "job.toml: is bad\nb: is bad");
  }
  EXPECT_EQ(to_string(Diagnostic{"", 0, 0, "is bad"}), "is bad");
}

}  // namespace
}  // namespace trueaxis
