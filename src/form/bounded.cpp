// SPDX-License-Identifier: Apache-2.0
#include "form/bounded.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace trueaxis::form {
namespace {

constexpr std::string_view of_form[] = {"RONt",
                                        "RONp",
                                        "RONv",
                                        "RONq",
                                        "CYLt",
                                        "CYLp",
                                        "CYLv",
                                        "CYLq",
                                        "CONt",
                                        "FLTt",
                                        "FLTp",
                                        "FLTv",
                                        "FLTq",
                                        "STRt",
                                        "STRp",
                                        "STRv",
                                        "STRq",
                                        "STRsa",
                                        "STRsg",
                                        "runout_circular",
                                        "runout_total",
                                        "axial_runout_circular",
                                        "axial_runout_total"};

/// RONt, and not its parts RONp, RONv and RONq.
bool is_whole(const NamedValue& value) {
  return value.name.size() > 4 || value.name.ends_with('t');
}

/// The values RONt, RONp … about one circle.
std::string family(const NamedValue& value) {
  return value.name.substr(0, 3) + (value.name.size() > 4 ? value.name : "") + value.reference;
}

/// A picometre: what is smaller with its u is rounding, such as RONp about the circle around it,
/// which is 0 by its definition.
constexpr double rounding = 1e-9;

bool is_nothing(const NamedValue& value, const Spread& spread) {
  return std::abs(value.value) < rounding && spread.u < rounding;
}

}  // namespace

FormValue as_measured(const NamedValue& value, const Spread& spread) {
  const bool nothing = is_nothing(value, spread);
  return {value.name,
          value.reference,
          {nothing ? 0.0 : value.value, nothing ? 0.0 : spread.u, value.unit, ""},
          spread.bias};
}

Bounded::Bounded(const std::vector<NamedValue>& values, const std::vector<Spread>& spread,
                 double coverage_factor)
    : factor_(bound_factor(coverage_factor)) {
  for (std::size_t v = 0; v < values.size(); ++v)
    resolved_[family(values[v])] |= is_whole(values[v]) && values[v].value > factor_ * spread[v].u;
}

bool Bounded::unresolved(const NamedValue& value, const Spread& spread) const {
  return std::ranges::find(of_form, value.name) != std::end(of_form) && spread.u > 0.0 &&
         !resolved_.at(family(value));
}

FormValue Bounded::operator()(const NamedValue& value, const Spread& spread,
                              double unseen_mm) const {
  const bool nothing = is_nothing(value, spread);
  if (nothing ? unseen_mm == 0.0 : !unresolved(value, spread)) return as_measured(value, spread);
  const double most_mm = std::max({spread.bound, value.value + factor_ * spread.u, unseen_mm});
  return {value.name,
          value.reference,
          {.unit = value.unit,
           .why_not = "no form beyond the noise",
           .interval = std::array{0.0, most_mm}},
          spread.bias,
          true};
}

}  // namespace trueaxis::form
