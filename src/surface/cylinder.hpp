// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "surface/catalogue.hpp"

namespace trueaxis {

CatalogueEntry cylinder_entry();

}  // namespace trueaxis
