// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// The noise-free readings of a scenario at the arguments of a measured stream, mm.
///
/// A gauge's zero is in no scenario: it is set so that the mean difference over the readings that
/// are not `masked` is zero; `scenario.probe.relative_zero_mm` is given that value.
/// @throws InputError as simulate_at().
std::vector<double> resimulate(Scenario& scenario, const ProbeStream& measured,
                               const std::vector<bool>& masked);

}  // namespace trueaxis::virtual_lathe
