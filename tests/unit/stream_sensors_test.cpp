// SPDX-License-Identifier: Apache-2.0
// Streams of several sensors: read as written, to the last bit, and only by who can take them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

StreamReadOptions several() {
  StreamReadOptions options;
  options.several_sensors = true;
  return options;
}

std::string place(const std::string& text) {
  const auto folder = std::filesystem::path(places::scratch()) / "stream_sensors";
  std::filesystem::create_directories(folder);
  std::string path =
      (folder / testing::UnitTest::GetInstance()->current_test_info()->name()).string();
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

TEST(StreamSensors, AreReadInTheOrderOfTheirNumbersWhateverThatOfTheColumns) {
  const ProbeStream stream =
      read_stream_csv(place("# sensor_angles: 0, 90, 200 deg\nC[deg],X_M3[um],X_M1[um],X_M2[um]\n"
                            "0,30,10,20\n120,31,11,21\n240,32,12,22\n"),
                      several());
  EXPECT_EQ(stream.reading_mm, (std::vector<double>{0.010, 0.011, 0.012}));
  ASSERT_EQ(stream.more_reading_mm.size(), 2u);
  EXPECT_DOUBLE_EQ(stream.more_reading_mm[0][1], 0.021);
  EXPECT_DOUBLE_EQ(stream.more_reading_mm[1][2], 0.032);
  ASSERT_EQ(stream.sensor_angles_rad.size(), 3u);
  EXPECT_DOUBLE_EQ(stream.sensor_angles_rad[1], 0.5 * std::numbers::pi);
}

TEST(StreamSensors, ADiameterIsHalvedForAll) {
  const ProbeStream stream =
      read_stream_csv(place("# sensor_angles: 0, 90 deg\n# x_convention: diameter\n"
                            "X_M1,X_M2,C\n20,40,0\n20,40,120\n"),
                      several());
  EXPECT_EQ(stream.reading_mm[0], 10.0);
  EXPECT_EQ(stream.more_reading_mm[0][1], 20.0);
}

TEST(StreamSensors, AreTheSameAfterWriting) {
  virtual_lathe::Scenario scenario;
  scenario.part.radius_mm = 17.0;
  scenario.part.x0_mm = 0.01;
  scenario.probe.sensor_angles_rad = {0.0, 1.0, 2.345678901234567};
  scenario.noise.sigma_mm = 1e-4;
  virtual_lathe::PlannedPass pass;
  pass.revolutions = 3.0;
  scenario.plan.passes = {pass};
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  const std::string path = place("");
  write_stream_csv(stream, path);
  const ProbeStream read = read_stream_csv(path, several());
  EXPECT_EQ(read.reading_mm, stream.reading_mm);
  EXPECT_EQ(read.more_reading_mm, stream.more_reading_mm);
  EXPECT_EQ(read.sensor_angles_rad, stream.sensor_angles_rad);
  EXPECT_THROW(read_stream_csv(path), InputError);
}

TEST(StreamSensors, ASensorMeetsAfterATurnWhatAnotherMetBefore) {
  virtual_lathe::Scenario scenario;
  scenario.part.radius_mm = 20.0;
  scenario.effects = {{"part.roundness", {{"order", 3.0}, {"amplitude_mm", 0.01}}}};
  scenario.probe.sensor_angles_rad = {0.0, 0.25 * two_pi};
  virtual_lathe::PlannedPass pass;
  pass.revolutions = 2.0;
  pass.readings_per_revolution = 40.0;
  scenario.plan.passes = {pass};
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  for (std::size_t i = 0; i + 10 < stream.size(); ++i)
    EXPECT_NEAR(stream.more_reading_mm[0][i], stream.reading_mm[i + 10], 1e-12);
}

}  // namespace
}  // namespace trueaxis
