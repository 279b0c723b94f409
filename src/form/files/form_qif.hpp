// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/form.hpp"

namespace trueaxis {

/// What a value of a name may be at most, mm: the tolerance of a drawing.
struct FormTolerance {
  std::string name;
  double limit_mm;
};

/// The form as a QIF results document (`trueaxis.qif/1`): each section a circle with its roundness,
/// the whole a cylinder, cone, plane or line with its form, all about the minimum zone, and of
/// every tolerance the characteristic that it is of, judged by ISO 14253-1. `in_part_frame` is
/// false of points, whose sections have no place in a frame of the user's.
std::string form_qif(const FormResult& result, const std::vector<FormTolerance>& tolerances,
                     bool in_part_frame);

}  // namespace trueaxis
