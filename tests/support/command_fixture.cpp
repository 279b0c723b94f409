// SPDX-License-Identifier: Apache-2.0
#include "support/command_fixture.hpp"

namespace trueaxis::testing {

void CommandTest::SetUp() { folder_ = fresh_folder("command"); }

void CommandTest::expect_input_error(const std::string& arguments, const std::string& why) {
  const auto before = files_in(folder_);
  const CommandStreams done = command(arguments);
  EXPECT_EQ(done.exit_code, 3) << arguments << '\n' << done.err;
  EXPECT_EQ(done.out, "") << arguments;
  EXPECT_TRUE(contains(done.err, why)) << arguments << '\n' << done.err;
  EXPECT_EQ(files_in(folder_), before) << arguments;
}

std::string simple_job(const std::string& reference, double speed_rpm, double tolerance_um) {
  char cut[400];
  std::snprintf(
      cut, sizeof cut,
      "\n[target]\nsurface = \"cylinder\"\nradius_mm = 28\nz_start_mm = 40\n"
      "z_end_mm = 36\nstock_um = 20000\ncoaxiality_tolerance_um = %g\n[cut]\nspeed_rpm = %g\n"
      "sense = \"+c\"\nfeed_mm_per_rev = 0.1\n",
      tolerance_um, speed_rpm);
  return "[[reference]]\n" + reference + cut;
}

std::string shaft_with(const std::string& effect, const std::string& sigma_um, double x0_um,
                       double radius_mm, int seed) {
  char part[400];
  std::snprintf(part, sizeof part,
                "seed = %d\n[part]\nkind = \"cylinder\"\nx0_um = %g\ny0_um = -20\nl = 0.0002\n"
                "m = 0.0004\nradius_mm = %g\n[noise]\nsigma_um = %s\n[[pass]]\nz_start_mm = 0\n"
                "z_end_mm = 20\nfeed_mm_per_rev = 1\nreadings_per_revolution = 24.3\n"
                "speed_rpm = 60\n[[effect]]\n",
                seed, x0_um, radius_mm, sigma_um.c_str());
  return part + effect;
}

}  // namespace trueaxis::testing
