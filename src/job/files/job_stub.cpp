// SPDX-License-Identifier: Apache-2.0
#include "job/files/job_stub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace trueaxis {

std::string job_stub(const std::string& path, const ProbeStream& stream,
                     const SurfaceEvidence& evidence) {
  const std::string surface = to_string(evidence.surface);
  const std::string file = std::filesystem::path(path).filename().string();
  std::string text = fmt::format(
      "# trueaxis run THIS_FILE -o result\n"
      "name = \"{0}\"\n\n"
      "[sensor]\n"
      "# ball_radius_mm = 1.0   # where the readings are of the ball's centre\n"
      "# noise_um = 1.0         # standard deviation of one reading, if known\n"
      "# u_height_um = 20       # how well the probe's height is set (standard uncertainty)\n\n"
      "[[reference]]\n"
      "name = \"{0}\"\n"
      "stream = '{1}'\n"
      "surface = \"{2}\"      # {3}\n",
      surface, file, surface, evidence.why);
  if (stream.kind == StreamKind::lateral) text += "feature = \"shaft\"        # or \"bore\"\n";
  text += "# loss = \"tukey\"         # where chips or coolant left spikes\n";
  if (evidence.surface == SurfaceKind::section) return text;
  const auto [low, high] = std::ranges::minmax(stream.position_mm);
  text += fmt::format(
      "\n# What is to be cut, about the axis that is found. Without it the job ends with the "
      "axis.\n"
      "# [target]\n"
      "# surface = \"cylinder\"\n"
      "# radius_mm = 30\n"
      "# z_start_mm = {:.6g}\n"
      "# z_end_mm = {:.6g}\n"
      "# stock_um = 200         # the most that may be removed where the target is probed\n"
      "# coaxiality_tolerance_um = 10\n\n"
      "# [cut]\n"
      "# speed_rpm = 600\n"
      "# sense = \"+c\"\n"
      "# feed_mm_per_rev = 0.1\n"
      "# nose_radius_mm = 0.8\n",
      high, low);
  return text;
}

}  // namespace trueaxis
