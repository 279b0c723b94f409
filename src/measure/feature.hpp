// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/error.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// What a stream states by `feature: bore` or `feature: shaft`.
inline bool states_feature(const ProbeStream& stream, const char* feature) {
  const auto stated = stream.metadata.find("feature");
  return stated != stream.metadata.end() && stated->second == feature;
}
inline bool states_bore(const ProbeStream& stream) { return states_feature(stream, "bore"); }
inline bool states_other_feature(const ProbeStream& stream, bool bore) {
  return states_feature(stream, bore ? "shaft" : "bore");
}

/// @throws InputError if the stream states the other feature: the ball would be on the wrong side
inline void expect_feature(const ProbeStream& stream, bool bore) {
  if (!states_other_feature(stream, bore)) return;
  if (!bore)
    throw InputError(stream.source,
                     "the stream states 'feature: bore': add --bore (in a job: feature = "
                     "\"bore\", in Python: bore=True)");
  throw InputError(stream.source,
                   "the stream states 'feature: shaft': leave out --bore (in a job: feature = "
                   "\"shaft\", in Python: bore=False)");
}

}  // namespace trueaxis
