// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A job that runs as it is, of the one stream at `path`, a reference for every seat in it, with
/// what else a job may say as comments.
std::string job_stub(const std::string& path, const ProbeStream& stream);

}  // namespace trueaxis
