// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trueaxis {

/// The one of `known` that a key which is none of them may mean, or "": the same with its unit
/// ("sigma": sigma_mm), a letter or two off, the same without what stands before it ("rpm":
/// speed_rpm, "sigma_um": noise.sigma_um), or what the thing is called here ("sigma_um" beside
/// noise_um, "kind" beside surface). Of equals the first.
std::string nearest_key(std::string_view word, const std::vector<std::string>& known);

}  // namespace trueaxis
