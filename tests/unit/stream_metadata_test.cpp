// SPDX-License-Identifier: Apache-2.0
// Metadata are strict, prose is free: what a comment must not leave unsaid.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "fit/uncertainty.hpp"
#include "measure/files/stream_csv.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

ProbeStream read(const std::string& text, const StreamReadOptions& options = {}) {
  const auto folder = std::filesystem::path(places::scratch()) / "stream_metadata";
  std::filesystem::create_directories(folder);
  const std::string path =
      (folder / testing::UnitTest::GetInstance()->current_test_info()->name()).string();
  std::ofstream(path, std::ios::binary) << text;
  return read_stream_csv(path, options);
}

TEST(StreamMetadata, WhatLooksLikeAKeyIsRefusedWithItsSpelling) {
  const std::pair<const char*, const char*> wrong[] = {
      {"x_convention = diameter", "x_convention: diameter"},
      {"x_convention=diameter", "x_convention: diameter"},
      {"x_convention diameter", "x_convention: diameter"},
      {"x-convention: diameter", "x_convention: diameter"},
      {"X convention is a diameter", "x_convention: diameter"},
      {"xconventoin: radius", "x_convention: radius"},
      {"- ball_radius: 1.5 mm", "ball_radius: 1.5 mm"},
      {"ball radius 1.5 mm", "ball_radius: 1.5 mm"},
      {"Ball radius = 1.5 mm", "ball_radius: 1.5 mm"},
      {"tip radius: 1.5 mm", "ball_radius: 1.5 mm"},
      {"Probe ball radius: 1.5 mm", "ball_radius: 1.5 mm"},
      {"noise level 2 um", "sensor_noise: 2 um"},
      {"sensornoise: 2 um", "sensor_noise: 2 um"},
      {"sensor: noise 2 um", "sensor_noise: 2 um"},
      {"sigma = .002 mm", "sensor_noise: 2 um"},
      {"nominal diameter: 29 mm", "nominal_radius: 14.5 mm"},
      {"Spindle speed: 60 rpm", "spindle_rpm: 60"},
      {"feature = bore", "feature: bore"},
      {"readings: relative", "reading: relative"},
      {"reading relative", "reading: relative"},
      {"set-up 12 z-shift 3 mm", "setup.2.z_shift: 12 mm"},
      {"setup2.reindex: 70 deg", "setup.2.reindex: 70 deg"},
      {"reindex: 70 deg", "setup.2.reindex: 70 deg"},
      {"side: rear", "setup.2.side: rear"},
  };
  for (const auto& [line, right] : wrong) {
    SCOPED_TRACE(line);
    try {
      read(std::string("  # ") + line + "\nX_M,C\n1,0\n2,90\n");
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      const Diagnostic& first = error.diagnostics().front();
      EXPECT_EQ(error.diagnostics().size(), 1u);
      EXPECT_EQ(first.line, 1u);
      EXPECT_EQ(first.column, 5u);
      EXPECT_NE(first.message.find(std::string("'# ") + right + "'"), std::string::npos)
          << first.message;
    }
  }
}

TEST(StreamMetadata, UnitsAndConventionsOfTheFileAreRefused) {
  for (const char* line :
       {"units: inch", "unit = mm", "Einheiten: Zoll", "pulgadas", "degrés:", "inch",
        "all lengths in inch.", "diameter", "X_M is a diameter", "X: diameter", "C = rad",
        "diameter: 80", "Radius: 40 mm", "X_M in mm, C in deg", "values are radii", "units mm"}) {
    SCOPED_TRACE(line);
    EXPECT_THROW(read(std::string("# ") + line + "\nX_M,C\n1,0\n2,90\n"), InputError);
    EXPECT_THROW(read(std::string("X_M,C # ") + line + "\n1,0\n2,90\n"), InputError);
    EXPECT_THROW(read(std::string("X_M,C\n1,0 # ") + line + "\n2,90\n"), InputError);
    EXPECT_NO_THROW(read(std::string("## ") + line + "\nX_M,C\n1,0\n2,90\n"));
  }
}

TEST(StreamMetadata, ProseIsFree) {
  std::string text;
  for (const char* line : {"Note: probed after lunch",
                           "operator: Meier",
                           "Date: 2024-01-02 10:30",
                           "readings: 1469",
                           "Reading 5 was repeated",
                           "noise: low today",
                           "side A of the part",
                           "Side: A",
                           "meter: Mitutoyo 543",
                           "the radius of the ball is on the drawing",
                           "diameter of the part 80 mm by drawing",
                           "part: cone",
                           "Setup: chuck 2",
                           "X",
                           "units are those of the header",
                           "speed: slow",
                           "==",
                           "nominal_radius_note: free",
                           "a: b",
                           ":",
                           "sensor noise was not measured",
                           "z_datum: face",
                           "machine: a lathe, X_M in mm"}) {
    text += std::string("# ") + line + "\n";
  }
  const ProbeStream s = read(text + "## units: inch\nX_M,C # what\n1,0 # chip: 2\n2,90\n");
  EXPECT_EQ(s.metadata.at("Note"), "probed after lunch");
  EXPECT_EQ(s.metadata.at("readings"), "1469");
  EXPECT_FALSE(s.metadata.contains("units"));
  EXPECT_FALSE(s.metadata.contains("chip"));
}

TEST(StreamMetadata, AKnownKeyBehindARowIsRefused) {
  for (const char* text : {"X_M,C # x_convention: diameter\n1,0\n2,90\n",
                           "X_M,C\n1,0 # setup.1.reindex: 70 deg\n2,90\n"}) {
    EXPECT_THROW(read(text), InputError) << text;
  }
}

TEST(StreamMetadata, AQuantityWithoutItsUnitIsRefused) {
  for (const char* key : {"nominal_radius", "sensor_noise", "ball_radius"}) {
    const std::string head = std::string("# ") + key + ": 2";
    EXPECT_THROW(read(head + "\nX_M,C\n1,0\n2,90\n"), InputError) << key;
    EXPECT_NO_THROW(read(head + " um\nX_M,C\n1,0\n2,90\n")) << key;
  }
}

TEST(StreamMetadata, WhoSaysWhatXIsIsKept) {
  const std::string rows = "\n80,0,1\n80.5,90,1\n";
  StreamReadOptions job;
  job.diameter = true;
  job.diameter_said_by = SaidBy::job;
  const auto said = [](bool diameter, SaidBy by) {
    return std::optional<XConvention>({diameter, by});
  };
  EXPECT_EQ(read("X_M,C,Z" + rows).x_convention, said(false, SaidBy::nobody));
  EXPECT_EQ(read("X_M,C,Z" + rows, job).x_convention, said(true, SaidBy::job));
  EXPECT_EQ(read("X_M[mm dia],C,Z" + rows, job).x_convention, said(true, SaidBy::stream));
  EXPECT_EQ(read("# x_convention: radius\nX_M,C,Z" + rows).x_convention,
            said(false, SaidBy::stream));
  EXPECT_EQ(ProbeStream().x_convention, std::nullopt);
}

/// Thirty-six readings of a cylinder of 40 mm in three sections, C written as `factor` degrees.
std::string tube(const std::string& header, double factor = 1.0) {
  std::string text = header + "\n";
  for (int i = 0; i < 36; ++i) {
    const double c_deg = 30.0 * (i % 12);
    text += std::to_string(40.0 + 0.05 * std::cos(c_deg * rad_per_deg)) + "," +
            std::to_string(factor * c_deg) + "," + std::to_string(10 * (i / 12)) + "\n";
  }
  return text;
}

std::string notes_of(const std::string& text, SurfaceKind surface) {
  FitOptions options;
  options.surface = surface;
  std::string notes;
  for (const std::string& note : fit(read(text), options).input_notes) notes += note + "\n";
  return notes;
}

TEST(StreamMetadata, AFitSaysWhatWasTakenAndWhatWasNotUsed) {
  const std::string said = "# x_convention: radius\n";
  EXPECT_EQ(notes_of(tube(said + "X_M,C,Z"), SurfaceKind::cylinder), "");
  EXPECT_EQ(notes_of(tube("X_M[mm dia],C,Z"), SurfaceKind::cylinder), "");
  EXPECT_TRUE(notes_of(tube("X_M,C,Z"), SurfaceKind::cylinder)
                  .starts_with("TrueAxis assumes that X_M is a"));
  EXPECT_TRUE(notes_of(tube(said + "X_M,C,Z"), SurfaceKind::section)
                  .starts_with("Z is not used: 36 readings from Z = 0 to 20 mm in 3 sections"));
  EXPECT_TRUE(notes_of(tube(said + "X_M,C[rad],Z"), SurfaceKind::cylinder)
                  .ends_with("if it is in degrees, write C[deg]\n"));
  EXPECT_TRUE(notes_of(tube(said + "X_M,C[deg],Z", rad_per_deg), SurfaceKind::cylinder)
                  .starts_with("C covers only 5.76° of the part"));
}

TEST(StreamMetadata, NoiseDisagreesBeyondThreeEitherWay) {
  EXPECT_FALSE(noise_disagrees(1.0, 2.9, 100.0));
  EXPECT_TRUE(noise_disagrees(1.0, 3.1, 100.0));
  EXPECT_FALSE(noise_disagrees(2.9, 1.0, 100.0));
  EXPECT_TRUE(noise_disagrees(3.1, 1.0, 100.0));
  EXPECT_FALSE(noise_disagrees(3.1, 1.0, 4.0));  // too few readings show it
  EXPECT_FALSE(noise_disagrees(0.0, 1.0, 100.0));
}

}  // namespace
}  // namespace trueaxis
