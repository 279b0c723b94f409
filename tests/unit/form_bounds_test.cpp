// SPDX-License-Identifier: Apache-2.0
// Form that is not beyond the noise: the same bound on the screen, in every file and for every k.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "form/files/form_files.hpp"
#include "format/text_layout.hpp"
#include "support/form_profiles.hpp"

namespace trueaxis::form_bounds_test {
namespace {

using namespace testing;

/// The first number of JSON values by this name.
const nlohmann::json& named(const nlohmann::json& values, const std::string& name) {
  const auto found =
      std::ranges::find_if(values, [&](const auto& one) { return one.at("name") == name; });
  return *found;
}

// A flat face with noise alone is a bound in every file, as on the screen.
TEST(FormBounds, NoiseAloneIsABoundInEveryFile) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> noise(0.0, 3e-3);
  ProbeStream face;
  face.kind = StreamKind::face;
  for (int i = 0; i < 1440; ++i) {
    face.c_rad.push_back(i * rad_per_deg);
    face.position_mm.push_back(30.0 - i / 100.0);
    face.reading_mm.push_back(noise(random));
  }
  FormOptions options = quick();
  options.trials = 100;
  const FormResult result = assess_form(face, options);
  for (const FormValue& one : group_of(result, "flatness")) {
    EXPECT_TRUE(one.unresolved) << one.name << one.reference;
    EXPECT_FALSE(one.estimate.determined()) << one.name << one.reference;
    EXPECT_EQ(least_of(one, 2.0), 0.0);
    EXPECT_GT(most_of(one, 2.0), 0.0);
  }
  const auto json = nlohmann::json::parse(form_json(result));
  const nlohmann::json& flat = named(json.at("groups").at(0).at("values"), "FLTt");
  EXPECT_TRUE(flat.at("value").is_null());
  EXPECT_TRUE(flat.at("unresolved"));
  EXPECT_GT(flat.at("at_most"), 0.0);
  const std::string qif = form_qif(result, {}, false);
  EXPECT_EQ(qif.find("<Form"), std::string::npos) << qif;
  const FormValue& zone = value_of(group_of(result, "flatness"), "FLTt", "MZPL");
  EXPECT_NE(qif.find("FLTt " + form_value_text(zone, 2.0, 1e3, "µm")), std::string::npos) << qif;
}

// A bound is at 95 % whatever k is: k = 1 does not make it smaller, nor a tolerance easier to meet.
TEST(FormBounds, ABoundDoesNotShrinkWithK) {
  const FormValue little{"RONt", "MZCI", {1.5e-3, 1e-3, "mm", ""}};
  for (const double k : {1.0, 2.0}) {
    EXPECT_DOUBLE_EQ(most_of(little, k), 3.5e-3) << k;
    EXPECT_EQ(least_of(little, k), 0.0) << k;
    EXPECT_EQ(layout::size_plus_minus(little.estimate, k, 1e3, "µm"),
              "below 3.5 µm (95 % confidence)");
    EXPECT_EQ(form_value_text(little, k, 1e3, "µm"), "below 3.5 µm (95 % confidence)");
    // Not 1.1e+02, and no less than the 110.4 µm that it is.
    EXPECT_EQ(layout::size_plus_minus({0.05, 0.0302, "mm", ""}, 2.0, 1e3, "µm"),
              "below 111 µm (95 % confidence)");
  }
  EXPECT_DOUBLE_EQ(most_of(little, 3.0), 4.5e-3);
  const FormValue much{"RONt", "MZCI", {5e-3, 1e-3, "mm", ""}};
  EXPECT_DOUBLE_EQ(most_of(much, 1.0), 6e-3);
  EXPECT_DOUBLE_EQ(least_of(much, 1.0), 4e-3);
}

}  // namespace
}  // namespace trueaxis::form_bounds_test
