// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "surface/surface.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// What a fit takes of a stream although nothing says it, what of the stream it does not use, and
/// what looks like another unit of C; a sentence each. Only of a stream that was read from a file:
/// who fills one in a program knows what is in it.
std::vector<std::string> notes_on_input(const ProbeStream& stream, const SurfaceInfo& info);

}  // namespace trueaxis
