// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/association.hpp"

namespace trueaxis {

/// Points with the line of the file that each stands in.
struct PointText {
  std::string source, hash;
  std::vector<Point3> points_mm;
  std::vector<std::size_t> lines;
};

/// A point a line: x y z between blanks, tabs or commas, comments behind '#'. A first line may name
/// the columns, `x y z` or `x[um],y[um],z[um]`; `unit` ("mm", "um", "m", "in"; empty: not said)
/// must then be the same. Without either it is mm.
/// @throws InputError with every line that is no point, with its column.
PointText read_points(const std::string& path, const std::string& unit);

std::string association_text(const AssociatedFeature& associated);
std::string association_json(const AssociatedFeature& associated, const PointText& points);

/// The optimum as an auditor checks it by hand (Eq. 253).
std::string association_certificate(const AssociatedFeature& associated, const PointText& points);

}  // namespace trueaxis
