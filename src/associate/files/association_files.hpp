// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/association.hpp"

namespace trueaxis {

/// Points with the line of the file for each.
struct PointText {
  std::string source, hash;
  std::vector<Point3> points_mm;
  std::vector<std::size_t> lines;    ///< of a binary file its rows
  std::vector<std::string> notes{};  ///< what was excluded, in sentences
  std::vector<double> metres{};      ///< x, y, z in turn as they were read, where that is in metres
};

/// A coordinate beyond it is a wrong unit or a damaged file, and its square could overflow.
inline constexpr double largest_coordinate_mm = 1e12;

/// One point per line: x y z between blanks, tabs or commas, comments after '#'. A first line may
/// name the columns, `x y z` or `x[um],y[um],z[um]`; `unit` ("mm", "um", "m", "in"; empty: not
/// said) must then be the same. Without either it is mm. X3P (metres), HDF5, MATLAB and NumPy files
/// are known by their first bytes. If it is not clear, `array` names their points: "P" of three
/// columns or "a,b,c". The file (an attribute `units` of HDF5) or `unit` must give the unit.
/// @throws InputError with every line that is not a point, with its column.
PointText read_points(const std::string& path, const std::string& unit,
                      const std::string& array = "");

/// The same of the bytes of a file that is_number_file() knows.
PointText points_of_numbers(const std::string& path, const std::string& bytes,
                            const std::string& unit, const std::string& array);

/// x, y, z in turn in metres: as they were read in metres, else of mm by one rounding.
std::vector<double> metres_of(const PointText& points);

std::string association_text(const AssociatedFeature& associated);
std::string association_json(const AssociatedFeature& associated, const PointText& points);

/// Every point in mm with its distance from the element, in the order of the file (CSV).
std::string association_distances(const AssociatedFeature& associated, const PointText& points);

/// The element as a measured feature of a QIF results document (`trueaxis.qif/1`).
std::string association_qif(const AssociatedFeature& associated, const PointText& points);

/// The optimum as an auditor checks it by hand (Eq. 253).
std::string association_certificate(const AssociatedFeature& associated, const PointText& points);

}  // namespace trueaxis
