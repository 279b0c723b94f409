// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "surface/catalogue.hpp"

namespace trueaxis {

CatalogueEntry section_entry();

}  // namespace trueaxis
