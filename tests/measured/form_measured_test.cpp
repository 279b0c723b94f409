// SPDX-License-Identifier: Apache-2.0
// Form of the measured trace of a roundness instrument (skipped where it is not present). Its
// eccentricity and second order were found by others, apart from this engine.
#include <gtest/gtest.h>

#include <filesystem>

#include "measure/files/stream_csv.hpp"
#include "support/form_profiles.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

TEST(MeasuredForm, ATraceOfARoundnessInstrument) {
  const std::filesystem::path path =
      std::filesystem::path(places::measured_data()) / "talyrond_trace.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  StreamReadOptions read;
  read.indication = Indication::relative;
  const ProbeStream gauge = read_stream_csv(path.string(), read);
  read.nominal_radius_mm = 14.5;
  const ProbeStream known = read_stream_csv(path.string(), read);
  for (const ProfileFilter filter :
       {ProfileFilter::gaussian, ProfileFilter::robust_gaussian, ProfileFilter::spline}) {
    double before = 0.0;
    for (const double cutoff : {15.0, 50.0, 150.0, 500.0}) {
      const auto values = assess_form(known, quick(filter, cutoff)).sections[0].values;
      const double zone = value_of(values, "RONt", "MZCI").estimate.value;
      for (const char* circle : {"LSCI", "MCCI", "MICI"})
        EXPECT_GE(value_of(values, "RONt", circle).estimate.value, zone) << circle << cutoff;
      EXPECT_GT(zone, before) << "more orders, more form";
      EXPECT_NEAR(value_of(values, "eccentricity").estimate.value, 0.2015, 0.2e-3);
      before = zone;
    }
  }
  // Two lobes of 0.70 µm are the eccentricity on R = 14.5 mm, which circles in the plane know.
  const auto lobes = [](const FormResult& result) {
    return result.sections[0].harmonics.at(1).amplitude_mm;
  };
  const double limacon = lobes(assess_form(gauge, quick(ProfileFilter::gaussian, 50.0)));
  const double circle = lobes(assess_form(known, quick(ProfileFilter::gaussian, 50.0)));
  EXPECT_NEAR(limacon, 0.70e-3, 0.1e-3);  // defects of 3 % of the readings are in it
  EXPECT_LT(circle, 0.35e-3);
}

}  // namespace
}  // namespace trueaxis::testing
