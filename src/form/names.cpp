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

const char* name_of(Criterion criterion) {
  return criterion_names[static_cast<std::size_t>(criterion)];
}

double least_of(const FormValue& value, double k) {
  const Estimate& e = value.estimate;
  return e.interval ? e.interval->front() : e.value - k * e.u;
}

double most_of(const FormValue& value, double k) {
  const Estimate& e = value.estimate;
  return e.interval ? e.interval->back() : e.value + k * e.u;
}

double size_of(const FormValue& value) {
  const Estimate& e = value.estimate;
  return e.interval ? e.interval->back() : e.value;
}

}  // namespace trueaxis
