// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "support/command_streams.hpp"
#include "support/part_streams.hpp"

namespace trueaxis::testing {

/// A test that runs the command in an empty folder of its own.
class CommandTest : public ::testing::Test {
 protected:
  void SetUp() override;

  void file(const std::string& name, const std::string& text) { write_text(folder_ / name, text); }
  CommandStreams command(const std::string& arguments) { return run_in(folder_, arguments); }
  nlohmann::json result(const std::string& name) { return read_json(folder_ / name); }
  bool there(const std::string& name) { return std::filesystem::exists(folder_ / name); }

  /// The command ends with code 3, says why on standard error only, and writes no file.
  void expect_input_error(const std::string& arguments, const std::string& why);

  std::filesystem::path folder_;
};

/// A job of one reference and a cylinder to be turned next to it.
std::string simple_job(const std::string& reference, double speed_rpm = 600.0,
                       double tolerance_um = 20.0);

/// What TrueAxis would take for a table of its own.
inline const char* const earlier_table = "# schema: trueaxis.correction/1\nof an earlier run\n";

inline const char* const cylinder_reference = "stream = \"part.csv\"\nsurface = \"cylinder\"\n";

/// A shaft probed in 21 turns, one each second, with an effect; the axis is 20 µm below.
std::string shaft_with(const std::string& effect, const std::string& sigma_um, double x0_um,
                       double radius_mm, int seed);

}  // namespace trueaxis::testing
