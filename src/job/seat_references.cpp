// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "fit/plausible.hpp"
#include "job/evidence.hpp"
#include "measure/seats.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

std::optional<Reason> take_every_seat(Job& job, std::vector<ProbeStream>& streams) {
  expects(job.references.size() == 1 && streams.size() == 1, "a job of one stream");
  if (!column_objection(streams.front()).empty()) return {};  // the fit says so
  const Seats found = find_seats(streams.front());
  if (found.seats.empty()) return {};
  const JobReference whole = std::move(job.references.front());
  const ProbeStream all = std::move(streams.front());
  job.references.clear();
  streams.clear();
  for (std::size_t i = 0; i < found.seats.size(); ++i) {
    const ZRange& z = found.seats[i].z;
    job.references.push_back(whole);
    job.references.back().name = std::string(1, static_cast<char>('A' + i));
    streams.push_back(within(all, z));
  }
  return seats_reason(found);
}

}  // namespace trueaxis
