// SPDX-License-Identifier: Apache-2.0
// Cylindricity and its parts, run-out, coaxiality, parallelism and flatness of parts whose values
// follow from how they are made.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>

#include "support/form_profiles.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis::testing {
namespace {

constexpr double rounding_mm = 1e-9;
const std::vector<double> five_z{-20.0, -10.0, 0.0, 10.0, 20.0};
const std::vector<double> uneven_z{-20.0, -15.0, -10.0, 20.0};

double of(const FormResult& result, const char* group, const char* name,
          const char* reference = "") {
  return value_of(group_of(result, group), name, reference).estimate.value;
}

TEST(FormWhole, AConstantLobedCylinder) {
  const double a = 3e-3;
  const FormResult result = assess_form(
      part_stream([&](double t, double) { return 15.0 + a * std::cos(3.0 * t); }, 360, five_z),
      quick());
  for (const char* cylinder : {"LSCY", "MZCY", "MCCY", "MICY"})
    EXPECT_NEAR(of(result, "cylindricity", "CYLt", cylinder), 2.0 * a, rounding_mm) << cylinder;
  EXPECT_NEAR(of(result, "cylindricity", "CYLq", "LSCY"), a / std::sqrt(2.0), rounding_mm);
  for (const char* none : {"STRsa", "STRsg", "CYLrr", "CYLtt", "CYLat"})
    EXPECT_NEAR(of(result, "cylindricity", none), 0.0, rounding_mm) << none;
}

// A taper of s: radii ± 20 s; the cylinder of the minimum zone is in their middle.
TEST(FormWhole, ATaper) {
  const double s = 1e-4;
  const FormResult result = assess_form(
      part_stream([&](double, double z) { return 15.0 + s * z; }, 360, five_z), quick());
  EXPECT_NEAR(of(result, "cylindricity", "CYLt", "MZCY"), 40.0 * s, rounding_mm);
  EXPECT_NEAR(of(result, "cylindricity", "CYLrr"), 40.0 * s, rounding_mm);
  EXPECT_NEAR(of(result, "cylindricity", "CYLtt"), 40.0 * s, rounding_mm);
  EXPECT_NEAR(of(result, "cylindricity", "CYLat"), std::atan(s), 1e-12);
  EXPECT_NEAR(of(result, "cylindricity", "CONt", "MZCO"), 0.0, rounding_mm);
  EXPECT_NEAR(of(result, "cylindricity", "STRsg"), 0.0, rounding_mm);
}

// A barrel b (z/20)²: straight generatrices are 25 % off by the zone of {16, 4, 0, 4, 16} b/16.
TEST(FormWhole, ABarrel) {
  const double b = 4e-3;
  const FormResult result = assess_form(
      part_stream([&](double, double z) { return 15.0 - b * z * z / 400.0; }, 360, five_z),
      quick());
  EXPECT_NEAR(of(result, "cylindricity", "STRsg"), b, rounding_mm);
  EXPECT_NEAR(of(result, "cylindricity", "CYLt", "MZCY"), b, rounding_mm);
  EXPECT_NEAR(of(result, "cylindricity", "STRsa"), 0.0, rounding_mm);
}

// An axis bent by b (z/20)² is held by a cylinder of diameter b. Centres by exact circles.
TEST(FormWhole, ABentAxis) {
  const double b = 6e-3;
  const FormResult result = assess_form(
      part_stream([&](double t, double z) { return eccentric(15.0, b * z * z / 400.0, t); }, 360,
                  five_z),
      quick());
  EXPECT_NEAR(of(result, "cylindricity", "STRsa"), b, rounding_mm);
  EXPECT_NEAR(result.sections[1].values[0].estimate.value, b / 4.0, rounding_mm);
  for (const SectionForm& section : result.sections)
    EXPECT_NEAR(value_of(section.values, "RONt", "MZCI").estimate.value, 0.0, rounding_mm);
}

// An axis that leaves the spindle axis by 5 µm + z/1000, wherever the sections are. These are cut
// at right angles to the spindle: the part's own are ellipses of l²R/2 = 8 nm less, which the part
// here does not have.
TEST(FormWhole, AnAxisBesideTheSpindle) {
  const double l = 1e-3, e = 5e-3;
  for (const std::vector<double>& z_mm : {five_z, uneven_z}) {
    const FormResult result = assess_form(
        part_stream([&](double t, double z) { return eccentric(15.0, e + l * z, t); }, 360, z_mm),
        quick());
    const double end = e + 20.0 * l;
    EXPECT_NEAR(of(result, "datum", "runout_circular"), 2.0 * end, rounding_mm);
    EXPECT_NEAR(of(result, "datum", "runout_total"), 2.0 * end, rounding_mm);
    EXPECT_NEAR(of(result, "datum", "coaxiality"), 2.0 * end, rounding_mm);
    EXPECT_NEAR(of(result, "datum", "parallelism"), 40.0 * l, rounding_mm);
    EXPECT_NEAR(of(result, "cylindricity", "STRsa"), 0.0, rounding_mm);
    EXPECT_NEAR(of(result, "cylindricity", "CYLt", "MZCY"), 0.5 * l * l * 15.0, 1e-9);
  }
}

// Against a datum that is placed alike, the part is coaxial.
TEST(FormWhole, AgainstADatum) {
  const PartShape shape = [](double t, double z) { return eccentric(15.0, 0.02 + 5e-4 * z, t); };
  const ProbeStream part = part_stream(shape, 360, five_z);
  const ProbeStream datum = part_stream(
      [](double t, double z) { return eccentric(10.0, 0.02 + 5e-4 * z, t); }, 360, {40.0, 60.0});
  const FormResult result = assess_form(part, quick(), &datum);
  // Sections that are circles across the spindle are off a tilted cylinder by l²R/2 = 2e-6 mm.
  EXPECT_NEAR(of(result, "datum", "coaxiality"), 0.0, 2e-6);
  EXPECT_NEAR(of(result, "datum", "parallelism"), 0.0, 2e-6);
  EXPECT_NEAR(of(assess_form(part, quick()), "datum", "coaxiality"), 2.0 * 0.03, rounding_mm);
}

// A cone leans: the centres of its sections across the spindle are τ R l off its axis (3.2 µm
// here). Neither coaxiality nor run-out depends on how it is clamped. What remains is of the second
// order, l² R and τ² l times the eccentricity. The datum is about the same axis, a cone or a
// cylinder.
TEST(FormWhole, AConeThatLeansIsAboutItsAxis) {
  const double l = 4e-4, m = -3e-4, e = 0.03, second_order_mm = (l * l + m * m) * 30.0;
  const auto leaning = [&](double taper, const std::vector<double>& z_mm) {
    const Revolved shape{{e, 0.0, l, m, 0.0}, 30.0, taper};
    return part_stream([=](double c, double z) { return intersect(shape, c, z).x_mm; }, 360, z_mm);
  };
  const double end_mm = std::hypot(e + 20.0 * l, -20.0 * m);
  for (const double taper : {0.2, -0.2}) {
    EXPECT_NEAR(of(assess_form(leaning(taper, uneven_z), quick()), "datum", "coaxiality"),
                2.0 * end_mm, second_order_mm);
    const ProbeStream part = leaning(taper, five_z);
    EXPECT_NEAR(of(assess_form(part, quick()), "datum", "coaxiality"), 2.0 * end_mm,
                second_order_mm);
    for (const double of_datum : {0.0, 0.15, -0.3})
      for (const std::vector<double>& z_mm : {std::vector{40.0, 60.0}, {40.0, 47.0, 60.0}}) {
        const ProbeStream datum = leaning(of_datum, z_mm);
        const FormResult result = assess_form(part, quick(), &datum);
        for (const char* value : {"coaxiality", "parallelism", "runout_circular"})
          EXPECT_NEAR(of(result, "datum", value), 0.0, 2.0 * second_order_mm)
              << value << ", tapers " << taper << " and " << of_datum;
      }
  }
}

// A ball's centre is further from a cone by 1/cos α: by 20 µm here. Eq. 10.
TEST(FormWhole, TheRadiusOfAConeThatABallReads) {
  const double taper = 0.2, ball_mm = 1.0, radius_mm = 30.0;
  const Revolved of_centre{{}, radius_mm + ball_mm * std::hypot(1.0, taper), taper};
  FormOptions options = quick();
  options.ball_radius_mm = ball_mm;
  const FormResult result =
      assess_form(part_stream([&](double c, double z) { return intersect(of_centre, c, z).x_mm; },
                              360, uneven_z),
                  options);
  for (const SectionForm& section : result.sections)
    EXPECT_NEAR(value_of(section.values, "radius").estimate.value,
                radius_mm + taper * *section.z_mm, rounding_mm);
}

// Across the spindle the sections of a leaning cylinder are ellipses of range R t²/2, and a note
// says so: to the fourth order in t. There is none for an upright part, nor next to larger lobes.
TEST(FormWhole, ALeaningCylinderHasEllipsesAcrossTheSpindle) {
  const double radius_mm = 32.0, lean = 0.01, range_mm = 0.5 * radius_mm * lean * lean;
  for (const double slope : {lean, 0.0})
    for (const double lobes_mm : {0.0, 0.02}) {
      const Revolved shape{Axis{0.0, 0.0, slope, 0.0, 0.0}, radius_mm, 0.0};
      const FormResult result =
          assess_form(part_stream(
                          [&](double c, double z) {
                            return intersect(shape, c, z).x_mm + lobes_mm * std::cos(3.0 * c);
                          },
                          360, uneven_z),
                      quick());
      const bool said = std::ranges::any_of(result.notes, [](const std::string& note) {
        return note.find("leans by 10 mrad") != std::string::npos &&
               note.find("a RONt of 1.6 µm") != std::string::npos;
      });
      EXPECT_EQ(said, slope > 0.0 && lobes_mm == 0.0) << slope << ' ' << lobes_mm;
      if (lobes_mm > 0.0 || slope == 0.0) continue;
      for (const SectionForm& section : result.sections)
        EXPECT_NEAR(value_of(section.values, "RONt", "MZCI").estimate.value, range_mm,
                    radius_mm * std::pow(lean, 4));
      EXPECT_NEAR(of(result, "cylindricity", "CYLt", "MZCY"), 0.0, rounding_mm);
    }
}

// A helix of 0.5 mm a turn on a tilted cone: the turns are as round as the cone.
TEST(FormWhole, AHelixIsCutIntoTurns) {
  const double s = 0.02, l = 2e-4;
  ProbeStream stream;
  for (int i = 0; i < 360 * 6; ++i) {
    const double c = two_pi * i / 360.0, z = 0.5 * i / 360.0;
    stream.c_rad.push_back(c);
    stream.position_mm.push_back(z);
    stream.reading_mm.push_back(20.0 + s * z + l * z * std::cos(c));
  }
  const FormResult result = assess_form(stream, quick());
  ASSERT_EQ(result.sections.size(), 6U);
  for (const SectionForm& section : result.sections) {
    EXPECT_EQ(section.readings, 360U);
    // Eq. 268 is exact for this part; the residual is the limaçon, (l z)²/4R.
    EXPECT_LT(value_of(section.values, "RONt", "MZCI").estimate.value, 1e-8);
  }
  EXPECT_NE(result.notes.front().find("helix"), std::string::npos);
}

// C that jumps by many turns takes memory for the turns that are there alone.
TEST(FormWhole, AJumpOfManyTurnsIsNoTurnsWithoutReadings) {
  ProbeStream stream;
  for (int i = 0; i < 360 * 6; ++i) {
    stream.c_rad.push_back(two_pi * (i / 360.0 + (i < 360 * 3 ? 0.0 : 1e12)));
    stream.position_mm.push_back(0.5 * i / 360.0);
    stream.reading_mm.push_back(20.0);
  }
  EXPECT_LE(assess_form(stream, quick()).sections.size(), 7U);
}

// Over one turn Z is C: a tilt takes two lobes in, and a roundness would come out too small.
TEST(FormWhole, OneTurnOfAHelixIsRefused) {
  ProbeStream stream;
  for (int i = 0; i < 400; ++i) {
    const double c = two_pi * i / 360.0;
    stream.c_rad.push_back(c);
    stream.position_mm.push_back(0.5 * i / 360.0);
    stream.reading_mm.push_back(20.0 + 1e-3 * std::cos(2.0 * c));
  }
  EXPECT_THROW(assess_form(stream, quick()), InputError);
}

// A ring that goes up and down twice: flatness 2a; a tilted one is flat, and runs out 2 l X.
TEST(FormWhole, Faces) {
  const auto face = [](const std::function<double(double)>& height) {
    ProbeStream stream;
    stream.kind = StreamKind::face;
    for (int i = 0; i < 360; ++i) {
      stream.c_rad.push_back(i * rad_per_deg);
      stream.position_mm.push_back(30.0);
      stream.reading_mm.push_back(height(i * rad_per_deg));
    }
    return stream;
  };
  const double a = 2e-3, l = 1e-4;
  const FormResult wavy =
      assess_form(face([&](double t) { return a * std::cos(2.0 * t); }), quick());
  EXPECT_NEAR(of(wavy, "flatness", "FLTt", "MZPL"), 2.0 * a, rounding_mm);
  EXPECT_NEAR(of(wavy, "flatness", "FLTt", "LSPL"), 2.0 * a, rounding_mm);
  const FormResult tilted =
      assess_form(face([&](double t) { return l * 30.0 * std::cos(t); }), quick());
  EXPECT_NEAR(of(tilted, "flatness", "FLTt", "MZPL"), 0.0, rounding_mm);
  EXPECT_NEAR(of(tilted, "datum", "axial_runout_circular"), 2.0 * l * 30.0, rounding_mm);
}

// A face and a shaft that lean differently, by 1e-4: the face runs out 2 X 1e-4 about the shaft.
// The slope of its axis has u = σ √(2/Σz²), which counts 2 X times; 400 trials give u to 4 %.
TEST(FormWhole, AFaceIsAboutTheAxisOfItsDatum) {
  const double l = 5e-4, more = 1e-4, x_mm = 30.0, sigma_mm = 1e-3;
  ProbeStream face;
  face.kind = StreamKind::face;
  for (int i = 0; i < 360; ++i) {
    face.c_rad.push_back(i * rad_per_deg);
    face.position_mm.push_back(x_mm);
    face.reading_mm.push_back(-(l + more) * x_mm * std::cos(i * rad_per_deg));
  }
  ProbeStream datum = part_stream(
      [&](double t, double z) { return eccentric(15.0, 0.01 + l * z, t); }, 360, five_z);
  const FormResult exact = assess_form(face, quick(), &datum);
  EXPECT_NEAR(of(exact, "datum", "axial_runout_circular"), 2.0 * x_mm * more, 1e-7);
  EXPECT_EQ(exact.datum_source, "part");
  boost::random::mt19937_64 engine(1);
  boost::random::normal_distribution<double> noise(0.0, sigma_mm);
  for (double& r : datum.reading_mm) r += noise(engine);
  FormOptions options = quick();
  options.trials = 400;
  const FormResult noisy = assess_form(face, options, &datum);
  const double sum_of_z2 = 360.0 * 2.0 * (20.0 * 20.0 + 10.0 * 10.0);
  const double u_slope = sigma_mm * std::sqrt(2.0 / sum_of_z2);
  const FormValue& value = value_of(group_of(noisy, "datum"), "axial_runout_circular");
  EXPECT_NEAR(value.estimate.u, 2.0 * x_mm * u_slope, 0.2 * 2.0 * x_mm * u_slope);
  EXPECT_NEAR(value.estimate.value, 2.0 * x_mm * more, 3.0 * value.estimate.u);
  EXPECT_THROW(assess_form(datum, quick(), &face), InputError);
}

// A spiral on a face that leans by 1e-4, and a vibration of 1 µm, 3.37 waves per revolution. It is
// slow from reading to reading, and elsewhere a turn later. The range of the readings has twice its
// amplitude, of which nothing is in the face: the lower end must be below the run-out.
TEST(FormWhole, AVibrationIsNotRunOut) {
  constexpr double lean = 1e-4, from_mm = 15.0, to_mm = 28.0, wave_mm = 1e-3;
  constexpr int readings = 530, each = 20;
  int above = 0;
  for (int phase = 0; phase < each; ++phase) {
    boost::random::mt19937_64 engine(50 + phase);
    boost::random::normal_distribution<double> noise(0.0, 2e-4);
    ProbeStream face;
    face.kind = StreamKind::face;
    for (int i = 0; i < readings; ++i) {
      const double c = i * two_pi / 24.37, x = from_mm + (to_mm - from_mm) * i / readings;
      face.c_rad.push_back(c);
      face.position_mm.push_back(x);
      face.reading_mm.push_back(lean * x * std::cos(c) +
                                wave_mm * std::sin(3.37 * c + two_pi * phase / each) +
                                noise(engine));
    }
    FormOptions options = quick();
    options.trials = 100;
    const FormResult result = assess_form(face, options);
    const FormValue& total = value_of(group_of(result, "datum"), "axial_runout_total");
    above += least_of(total, 2.0) > 2.0 * lean * to_mm ? 1 : 0;
    const FormValue& turn = value_of(group_of(result, "datum"), "axial_runout_circular");
    // The last turn is that of the largest radius, but for its feed of 0.6 mm.
    EXPECT_GE(most_of(turn, 2.0), 2.0 * lean * (to_mm - 0.6));
    EXPECT_LE(most_of(turn, 2.0), most_of(total, 2.0));
  }
  // 2.5 % each: of 20 more than 3 once in 2000 times.
  EXPECT_LE(above, 3);
}

// A chip of 50 µm on a face that leans by 1e-4: the lower end is not above the run-out of the face.
TEST(FormWhole, AChipIsNotProvenRunOut) {
  constexpr double lean = 1e-4, x_mm = 20.0;
  boost::random::mt19937_64 engine(5);
  boost::random::normal_distribution<double> noise(0.0, 2e-4);
  ProbeStream face;
  face.kind = StreamKind::face;
  for (int i = 0; i < 360; ++i) {
    const double c = i * 3.0 * rad_per_deg;
    face.c_rad.push_back(c);
    face.position_mm.push_back(x_mm);
    face.reading_mm.push_back(lean * x_mm * std::cos(c) + (i == 100 ? 0.05 : 0.0) + noise(engine));
  }
  const FormResult result = assess_form(face, quick());
  for (const char* name : {"axial_runout_circular", "axial_runout_total"}) {
    const FormValue& value = value_of(group_of(result, "datum"), name);
    EXPECT_LE(least_of(value, 2.0), 2.0 * lean * x_mm);
    EXPECT_GE(most_of(value, 2.0), 0.05);
  }
}

}  // namespace
}  // namespace trueaxis::testing
