// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/form.hpp"

namespace trueaxis {

const char* to_string(ProfileFilter filter) {
  constexpr const char* names[] = {"none", "gaussian", "robust_gaussian", "spline"};
  return names[static_cast<std::size_t>(filter)];
}

const char* name_of(Criterion criterion) {
  return criterion_names[static_cast<std::size_t>(criterion)];
}

namespace {

bool is_within_U(const Estimate& e, double k) { return e.value <= bound_factor(k) * e.u; }

}  // namespace

double least_of(const FormValue& value, double k) {
  const Estimate& e = value.estimate;
  if (e.interval) return e.interval->front();
  return is_within_U(e, k) ? 0.0 : e.value - k * e.u;
}

double most_of(const FormValue& value, double k) {
  const Estimate& e = value.estimate;
  if (e.interval) return e.interval->back();
  return e.value + (is_within_U(e, k) ? bound_factor(k) : k) * e.u;
}

double size_of(const FormValue& value) {
  const Estimate& e = value.estimate;
  return e.interval ? e.interval->back() : e.value;
}

}  // namespace trueaxis
