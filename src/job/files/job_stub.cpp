// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "format/reason_words.hpp"
#include "job/files/starter.hpp"
#include "job/files/stream_job.hpp"
#include "measure/feature.hpp"
#include "measure/seats.hpp"

namespace trueaxis {

namespace {

std::string reference_text(const std::string& file, const std::string& name,
                           const ProbeStream& stream, const SurfaceEvidence& evidence,
                           const Seat* seat) {
  const std::string surface = to_string(evidence.surface);
  std::string text = fmt::format(
      "[[reference]]\n"
      "name = \"{}\"\n"
      "stream = '{}'\n"
      "surface = \"{}\"      # {}\n",
      name.empty() ? surface : name, file, surface, words_of(evidence.why));
  if (seat)
    text += fmt::format("z_from_mm = {:.10g}\nz_to_mm = {:.10g}\n", seat->z.from_mm, seat->z.to_mm);
  if (stream.kind == StreamKind::lateral)
    text += states_bore(stream) ? "feature = \"bore\"         # as the stream states\n"
                                : "feature = \"shaft\"        # or \"bore\"\n";
  return text + "# loss = \"tukey\"         # if chips or coolant left spikes\n";
}

}  // namespace

std::string job_stub(const std::string& path, const ProbeStream& stream) {
  const std::string file = std::filesystem::path(path).filename().string();
  const Seats seats = find_seats(stream);
  std::string references, title;
  bool section = false;
  for (std::size_t i = 0; i < seats.seats.size(); ++i) {
    const SurfaceEvidence evidence = surface_by_evidence(within(stream, seats.seats[i].z));
    if (i > 0) references += '\n', title += ", ";
    references += reference_text(file, std::string(1, static_cast<char>('A' + i)), stream, evidence,
                                 &seats.seats[i]);
    title += to_string(evidence.surface);
    section = section || evidence.surface == SurfaceKind::section;
  }
  if (seats.seats.empty()) {
    const SurfaceEvidence evidence = surface_by_evidence(stream);
    references = reference_text(file, "", stream, evidence, nullptr);
    title = to_string(evidence.surface);
    section = evidence.surface == SurfaceKind::section;
  }
  std::string text = fmt::format(
      "# trueaxis run THIS_FILE -o result\n"
      "name = \"{0}\"\n\n"
      "[sensor]\n"
      "# ball_radius_mm = 1.0   # if the readings are those of the ball's centre\n"
      "# noise_um = 1.0         # standard deviation of one reading, if known\n"
      "# u_height_um = 20       # how well the probe's height is set (standard uncertainty)\n\n",
      title);
  text += references;
  if (section) return text;
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
      "# nose_radius_mm = 0.8\n"
      "# interpolation = \"linear\" # or \"none\": what the control does between two rows\n",
      high, low);
  return text;
}

}  // namespace trueaxis
