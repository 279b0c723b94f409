// SPDX-License-Identifier: Apache-2.0
// Law: a stream that cannot belong to the surface is an InputError that says what to do.
#include <gtest/gtest.h>

#include <string>

#include "laws/law_case.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::laws {
namespace {

void expect_refused(const ProbeStream& stream, const std::string& surface, const char* hint) {
  FitOptions options;
  options.surface = surface_from_id(surface);
  try {
    fit(stream, options);
    ADD_FAILURE() << surface << ": accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(hint), std::string::npos) << error.what();
  }
}

LawCase case_of(const std::string& surface) {
  LawCase c;
  c.surface = surface;
  c.half_angle_deg = surface == "cone" ? 5.0 : 0.0;
  return c;
}

TEST(InputLaw, StreamsOfAnotherKind) {
  for (const std::string& id : catalogue_ids()) {
    const SurfaceInfo& info = surface_info(surface_from_id(id));
    if (info.stream == StreamKind::face) {
      expect_refused(probe(case_of("cylinder")), id, "Z_M");
    } else {
      expect_refused(probe(case_of("plane")), id, "plane");
    }
    if (!info.needs_position) continue;
    ProbeStream flat = probe(case_of(id));
    flat.position_mm.clear();
    expect_refused(flat, id, info.stream == StreamKind::face ? "X" : "section");
  }
}

TEST(InputLaw, ARelativeGaugeNeedsItsNominalRadius) {
  EXPECT_GE(catalogue_ids().size(), 4u);
  for (const std::string& id : catalogue_ids()) {
    if (id == "plane") continue;
    ProbeStream stream = probe(case_of(id));
    stream.indication = Indication::relative;
    expect_refused(stream, id, "nominal_radius");
  }
}

TEST(InputLaw, AReadingOnTheOtherSideOfTheSpindleAxis) {
  EXPECT_GE(catalogue_ids().size(), 4u);
  for (const std::string& id : catalogue_ids()) {
    if (id == "plane") continue;
    ProbeStream stream = probe(case_of(id));
    stream.reading_mm[7] *= -1.0;
    expect_refused(stream, id, "data row 8");
    stream.reading_mm[7] = 0.0;
    expect_refused(stream, id, "data row 8");
  }
}

TEST(InputLaw, ABallThatTheStreamAndTheJobDisagreeOn) {
  LawCase c = case_of("cylinder");
  c.ball_mm = 2.0;
  ProbeStream stream = probe(c);
  stream.ball_radius_mm = 2.0;
  FitOptions options = options_of(c);
  EXPECT_NO_THROW(fit(stream, options));
  options.ball_radius_mm = 1.0;
  EXPECT_THROW(fit(stream, options), InputError);
}

TEST(InputLaw, UnknownSurface) {
  try {
    surface_from_id("ball");
    ADD_FAILURE() << "no surface is called so";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cone, cylinder"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trueaxis::laws
