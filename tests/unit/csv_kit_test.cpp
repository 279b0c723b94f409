// SPDX-License-Identifier: Apache-2.0
// What all readers of text have in common: numbers, fields, units.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Fields = std::vector<std::string_view>;

TEST(CsvKit, ANumberIsAllOfItsTextAndFinite) {
  double value = 0.0;
  for (const char* text : {"12.5", "+12.5", "1.25e1", "12.50", "12.5000000000000000000000"}) {
    EXPECT_TRUE(parse_number(text, value)) << text;
    EXPECT_EQ(value, 12.5) << text;
  }
  for (const char* text :
       {"", "+", "-", ".", "+-5", "--5", "5 ", " 5", "5,5", "5x", "inf", "nan", "1e400", "0x10"})
    EXPECT_FALSE(parse_number(text, value)) << text;
}

TEST(CsvKit, AWholeNumberThatDoesNotFitIsNone) {
  EXPECT_EQ(whole_number<int>("-17"), -17);
  EXPECT_EQ(whole_number<std::int64_t>("9223372036854775807"), INT64_MAX);
  for (const char* text : {"", "1.0", "2147483648", "99999999999999999999", "1 "})
    EXPECT_FALSE(whole_number<int>(text)) << text;
  EXPECT_FALSE(whole_number<unsigned>("-1"));
}

TEST(CsvKit, FieldsLieInTheirLineTheEmptyOnesToo) {
  const std::string line = " a ;; c;";
  const Fields fields = csv_fields(line, ';');
  EXPECT_EQ(fields, (Fields{"a", "", "c", ""}));
  for (const std::string_view field : fields) {
    EXPECT_GE(field.data(), line.data());
    EXPECT_LE(field.data() + field.size(), line.data() + line.size());
  }
  EXPECT_EQ(csv_character(line, fields[2]), 7U);
  EXPECT_EQ(csv_fields("", ';'), Fields{""});
  EXPECT_EQ(csv_fields("", ' '), Fields{});
  EXPECT_EQ(csv_fields("  1 \t 2  ", ' '), (Fields{"1", "2"}));
}

TEST(CsvKit, BracketsKeepAUnitTogetherAndQuotesAField) {
  EXPECT_EQ(csv_fields("X_M [mm dia] C[deg]", ' '), (Fields{"X_M [mm dia]", "C[deg]"}));
  EXPECT_EQ(csv_fields("X[a,b],C", ','), (Fields{"X[a,b]", "C"}));
  Fields fields;
  csv_split("\"1,5\",\"a \"\"b\"\"\", 2", ',', fields, CsvKeep::quotes);
  EXPECT_EQ(fields, (Fields{"1,5", "a \"\"b\"\"", "2"}));
  csv_split("X [mm] C", ' ', fields, CsvKeep::quotes);
  EXPECT_EQ(fields, (Fields{"X", "[mm]", "C"}));
}

TEST(CsvKit, LinesHaveNoMarkOfTheirOrderAndNoEnds) {
  std::vector<std::string> lines;
  for_each_line(
      "\xEF\xBB\xBF"
      "a\r\n\nb",
      [&](std::string_view line, std::size_t number) {
        lines.push_back(std::to_string(number) + std::string(line));
      });
  EXPECT_EQ(lines, (std::vector<std::string>{"1a", "2", "3b"}));
}

// A unit is worth the same in a key, in the header of a column and in words.
TEST(CsvKit, AUnitHasOneSize) {
  struct Kind {
    UnitKind kind;
    const char* inside;
    std::vector<std::pair<std::string, double>> others;
  };
  const Kind kinds[] = {
      {UnitKind::length, "_mm", {{"um", mm_per_um}, {"in", mm_per_inch}, {"m", mm_per_m}}},
      {UnitKind::angle, "_rad", {{"deg", rad_per_deg}, {"mrad", 1e-3}}},
      {UnitKind::time, "_s", {{"ms", 1e-3}}}};
  for (const auto& [kind, inside, others] : kinds)
    for (const auto& [name, factor] : others) {
      const auto unit = find_unit(kind, name);
      ASSERT_TRUE(unit) << name;
      EXPECT_EQ(unit->factor, factor) << name;
      EXPECT_EQ(unit_choice(name).second, factor);
      bool found = false;
      for (const KeySpelling& spelling : key_spellings(std::string("x") + inside))
        if (spelling.key == "x_" + name) {
          found = true;
          EXPECT_EQ(spelling.factor, factor) << name;
        }
      EXPECT_TRUE(found) << name;
      EXPECT_EQ(parts_of_key("x_" + name).stem, "x");
    }
  EXPECT_EQ(key_spellings("x_mm_per_s").size(), 4U);
  EXPECT_EQ(parts_of_key("x_um_per_min").unit, "_um_per_min");
  for (const char* word : {"Zoll", "pouces", "µm", "°", "secondes", "ミリ", "rev"}) {
    const auto unit = unit_of_word(word);
    ASSERT_TRUE(unit) << word;
    EXPECT_TRUE(find_unit(UnitKind::length, *unit) || find_unit(UnitKind::angle, *unit) ||
                find_unit(UnitKind::time, *unit))
        << word;
  }
}

}  // namespace
}  // namespace trueaxis
