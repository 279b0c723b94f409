// SPDX-License-Identifier: Apache-2.0
// What `advise` says where no further measurement of the lathe is what is wanted.
#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class AdviseCommand : public CommandTest {};

const std::string data = places::source() + "/data";

TEST_F(AdviseCommand, AConeThatIsACylinderIsAdvisedToBeOne) {
  const std::string stream = data + "/streams/shaft_cylinder_seat.csv";
  const CommandStreams cone = command("advise " + stream + " --surface cone");
  EXPECT_EQ(cone.exit_code, 4);
  EXPECT_TRUE(contains(cone.out, "fit a cylinder: --surface cylinder")) << cone.out;
  EXPECT_FALSE(contains(cone.out, "All plans")) << cone.out;
  // What it advises ends well, and a cone that is one is not told to be a cylinder.
  EXPECT_EQ(command("advise " + stream + " --surface cylinder").exit_code, 0);
  const CommandStreams true_cone =
      command("advise " + data + "/streams/shaft_cone_seat.csv --surface cone");
  EXPECT_EQ(true_cone.exit_code, 0);
  EXPECT_FALSE(contains(true_cone.out, "--surface cylinder")) << true_cone.out;
}

// The job of a machine of several axes is read as one: what `advise --machine` says of its files.
TEST_F(AdviseCommand, AMachinesJobIsAdvisedAsItsMeasurements) {
  const CommandStreams of_job = command("advise " + data + "/jobs/blade.toml");
  EXPECT_EQ(of_job.exit_code, 0) << of_job.err;
  const std::string five_axis = data + "/five_axis/";
  const CommandStreams of_files =
      command("advise " + five_axis + "zxacy_ball.csv --machine " + five_axis +
              "zxacy.toml --program " + five_axis + "blade.nc");
  EXPECT_EQ(of_files.exit_code, 0) << of_files.err;
  EXPECT_EQ(of_job.out, of_files.out);
  EXPECT_TRUE(contains(of_job.out, "NEXT: ")) << of_job.out;
}

}  // namespace
}  // namespace trueaxis::testing
