// SPDX-License-Identifier: Apache-2.0
// Every code has words and a line in docs/reference/reasons.md; what a sentence asks for is there.
#include "format/reason_words.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "job/check.hpp"
#include "job/doubts.hpp"
#include "support/places.hpp"

namespace trueaxis {
namespace {

constexpr auto code_of = [](std::size_t i) { return static_cast<ReasonCode>(i); };

std::string page() {
  std::ifstream file(std::string(places::source()) + "/docs/reference/reasons.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The row of a code: "| `part_slipped` | `onset_time`, … | … |".
std::string row_of(const std::string& page, ReasonCode code) {
  const std::size_t at = page.find(std::string("\n| `") + to_string(code) + "` |");
  return at == std::string::npos ? "" : page.substr(at + 1, page.find('\n', at + 1) - at - 1);
}

/// Names of numbers and names that a template asks for.
std::set<std::string> keys_of(std::string_view words) {
  std::set<std::string> keys;
  for (std::size_t at = words.find('{'); at != std::string_view::npos;
       at = words.find('{', at + 1)) {
    const std::string key(words.substr(at + 1, words.find_first_of(":.}", at) - at - 1));
    if (!key.starts_with('@')) keys.insert(key);
  }
  for (const char* own : {"ref", "name", "file", "name2", "file2", "parts", "remedies"})
    keys.erase(own);
  return keys;
}

TEST(ReasonWords, EveryCodeHasWordsAndALineInTheDocs) {
  const std::string text = page();
  std::set<std::string> ids;
  for (std::size_t i = 0; i < reason_codes; ++i) {
    const std::string_view words = template_of(code_of(i));
    EXPECT_FALSE(words.empty()) << to_string(code_of(i));
    EXPECT_TRUE(ids.insert(to_string(code_of(i))).second) << to_string(code_of(i));
    const std::string row = row_of(text, code_of(i));
    EXPECT_FALSE(row.empty()) << to_string(code_of(i)) << " is not in docs/reference/reasons.md";
    for (const std::string& key : keys_of(words))
      EXPECT_NE(row.find("`" + key + "`"), std::string::npos)
          << key << " of " << to_string(code_of(i));
  }
}

TEST(ReasonWords, BracketsOfATemplateCloseAndItsCodesAreCodes) {
  for (std::size_t i = 0; i < reason_codes; ++i) {
    int open = 0, optional = 0;
    for (const char c : template_of(code_of(i))) {
      open += c == '{' ? 1 : c == '}' ? -1 : 0;
      optional += c == '<' ? 1 : c == '>' ? -1 : 0;
      ASSERT_TRUE(open == 0 || open == 1) << to_string(code_of(i));
      ASSERT_TRUE(optional == 0 || optional == 1) << to_string(code_of(i));
    }
    EXPECT_EQ(open + optional, 0) << to_string(code_of(i));
    EXPECT_NO_THROW(words_of(Reason{code_of(i)})) << to_string(code_of(i));
  }
}

TEST(ReasonWords, NumbersUnitsAndWhatIsMissing) {
  const SpokenReference named[] = {{"seat", "seat.csv"}, {"", ""}};
  const Reason moved{ReasonCode::moved_across, {}, {{"by", 0.02, "mm", 0.0039}}};
  EXPECT_EQ(words_of(moved), "20.0 ± 3.9 µm");
  Reason slip{ReasonCode::part_slipped, {0}, {{"onset_time", 11.982, "s"}}, {}, {moved, moved}};
  EXPECT_EQ(words_of(slip, named),
            "seat: the part slipped in the chuck at 12.0 s by 20.0 ± 3.9 µm");
  slip.numbers.clear(), slip.parts.clear(), slip.references = {1};
  slip.remedies = {{ReasonCode::clamp_again}};
  EXPECT_EQ(words_of(slip, named), "the part slipped in the chuck: clamp it again and probe again");
  // Without what a sentence cannot do without, its code is better than half a sentence.
  EXPECT_EQ(words_of(Reason{ReasonCode::moved_across}), "moved_across");
}

TEST(ReasonWords, AReasonAsDataHasItsCodeNumbersAndUnits) {
  const SpokenReference named[] = {{"seat", "seat.csv"}};
  const Reason met{ReasonCode::cuts_air,
                   {0},
                   {{"at", 12.0, "mm"}, {"c", 0.5 * two_pi, "rad"}, {"material", -0.1, "mm", 0.02}},
                   {{"along", "Z"}}};
  const Json json = reason_object(met, named);
  EXPECT_EQ(json.at("code"), "cuts_air");
  EXPECT_EQ(json.at("references"), Json({"seat"}));
  EXPECT_EQ(json.at("numbers").at("c").at("unit"), "deg");
  EXPECT_DOUBLE_EQ(json.at("numbers").at("c").at("value"), 180.0);
  EXPECT_EQ(json.at("numbers").at("material").at("U"), 0.02);
  EXPECT_EQ(json.at("names").at("along"), "Z");
  EXPECT_EQ(
      json.at("words"),
      "the target cuts air: at Z = 12 mm, C = 180° the probed surface of seat is 100 µm short "
      "of it (U = 20 µm)");
}

TEST(Checks, EachHasItsOwnNameAndSaysWhereItsLimitsComeFrom) {
  std::set<std::string> ids;
  const auto expect_stated = [&](const auto& check) {
    EXPECT_TRUE(ids.insert(check.id).second) << check.id;
    EXPECT_NE(check.find, nullptr) << check.id;
    for (const Threshold& limit : check.thresholds) {
      EXPECT_GT(limit.value, 0.0) << check.id << " " << limit.name;
      EXPECT_STRNE(limit.source, "") << check.id << " " << limit.name;
      EXPECT_STRNE(limit.unit, "") << check.id << " " << limit.name;
    }
  };
  for (const JobCheck* check : checks()) expect_stated(*check);
  for (const AxisDoubt* doubt : axis_doubts()) expect_stated(*doubt);
  EXPECT_GE(ids.size(), 20u);
}

}  // namespace
}  // namespace trueaxis
