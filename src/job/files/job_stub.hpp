// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "job/evidence.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A job that runs as it is, of the one stream at `path`, with what else a job may say as comments.
std::string job_stub(const std::string& path, const ProbeStream& stream,
                     const SurfaceEvidence& evidence);

}  // namespace trueaxis
