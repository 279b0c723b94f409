// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/form.hpp"

namespace trueaxis {

const char* to_string(ProfileFilter filter) {
  switch (filter) {
    case ProfileFilter::none:
      return "none";
    case ProfileFilter::gaussian:
      return "gaussian";
    case ProfileFilter::robust_gaussian:
      return "robust_gaussian";
    case ProfileFilter::spline:
      return "spline";
  }
  return "";
}

const char* to_string(ReferenceFeature feature) {
  constexpr const char* names[] = {"least_squares", "minimum_zone", "minimum_circumscribed",
                                   "maximum_inscribed"};
  return names[static_cast<std::size_t>(feature)];
}

const char* to_string(FormElement element) {
  constexpr const char* names[] = {"line", "circle", "plane", "cylinder"};
  return names[static_cast<std::size_t>(element)];
}

}  // namespace trueaxis
