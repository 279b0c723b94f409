// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/unknown.hpp"

#include <algorithm>

namespace trueaxis::calibrate_detail {
namespace {

/// Place in the order of `location_unknowns`.
int rank_of(const ErrorName& name) {
  if (name.body == spindle_body) return name.angular() ? 51 : 50;
  const bool rotary = name.body >= 3, own = name.direction == name.body;
  if (rotary) return own ? 40 : name.angular() ? 20 : 10;
  if (!name.angular()) return 60;  // a zero of a linear axis: like the spindle's offset
  if (name.body == 0) return 35;
  return name.body == 1 && name.direction == 3 ? 34 : 30;  // C0Y, A0Z and B0Z before A0Y
}

struct Scale {
  double factor;
  ErrorFunction operator()(ConstantError e) const {
    e.value *= factor;
    return e;
  }
  ErrorFunction operator()(PolynomialError e) const {
    for (double& c : e.coefficients) c *= factor;
    return e;
  }
  ErrorFunction operator()(FourierError e) const {
    for (auto& term : e.terms) term.cos *= factor, term.sin *= factor;
    return e;
  }
  ErrorFunction operator()(TableError e) const {
    for (double& v : e.values) v *= factor;
    return e;
  }
};

}  // namespace

ErrorFunction scaled(const ErrorFunction& function, double factor) {
  return std::visit(Scale{factor}, function);
}

std::vector<Unknown> location_unknowns(const Machine& machine, double largest_length_mm,
                                       double largest_angle_rad) {
  std::vector<Unknown> unknowns;
  const auto add = [&](std::size_t body, std::size_t direction) {
    const ErrorName name{false, direction, body};
    if (without_effect(name)) return;
    unknowns.push_back({to_string(name),
                        {name, ConstantError{1.0}, 0.0},
                        name.angular() ? largest_angle_rad : largest_length_mm});
  };
  for (const MachineAxis& axis : machine.axes)
    for (std::size_t direction = 0; direction < 6; ++direction) add(index_of(axis.name), direction);
  for (std::size_t direction = 0; direction < 5; ++direction) add(spindle_body, direction);
  std::ranges::stable_sort(unknowns, {}, [](const Unknown& u) { return rank_of(u.unit.name); });
  return unknowns;
}

ErrorModel with(const ErrorModel& given, const std::vector<Unknown>& unknowns,
                const VectorXd& values) {
  ErrorModel errors = given;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const double value = values[static_cast<Eigen::Index>(j)];
    if (value == 0.0) continue;
    ErrorTerm term = unknowns[j].unit;
    term.function = scaled(term.function, value);
    errors.terms.push_back(std::move(term));
  }
  return errors;
}

}  // namespace trueaxis::calibrate_detail
