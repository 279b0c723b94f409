// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trueaxis {

/// The one of `known` that an unknown key may mean, or "". It is the same with its unit ("sigma":
/// sigma_mm), a letter or two off, or the same without what precedes it ("rpm": speed_rpm,
/// "sigma_um": noise.sigma_um). Or it is what the thing is called here ("sigma_um" for noise_um,
/// "kind" for surface). Of equals the first.
std::string nearest_key(std::string_view word, const std::vector<std::string>& known);

}  // namespace trueaxis
