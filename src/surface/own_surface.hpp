// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "surface/catalogue.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// A profile of the user's in the place of a catalogue line.
/// @throws ContractViolation for more parameters than a profile may have
CatalogueEntry own_entry(std::shared_ptr<const RevolvedProfile> profile);

}  // namespace trueaxis
