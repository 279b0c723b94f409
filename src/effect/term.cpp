// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <type_traits>

#include "effect/kinds.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

template <class T>
constexpr bool is_nothing = std::is_same_v<std::decay_t<T>, std::monostate>;

// A column that is not there is empty; the one column that only probe.lag reads may be.
void check(const Term& term, const TermContext& at) {
  for (const auto column :
       {at.z_mm, at.time_s, at.speed_rad_per_s, at.velocity_mm_per_s, at.x_mm, at.sensed_mm,
        at.dx_dc, at.dx_dz, at.theta_rad, at.theta_chuck_rad, at.s_mm, at.clamp_force_ratio}) {
    expects(column.size() == at.size(), "every column of the context has its size");
  }
  const auto* response = std::get_if<Response>(&term);
  const bool second = response != nullptr && response->of == Response::Of::lag;
  expects(!second || at.d2x_dc2.size() == at.size(), "probe.lag has d2x_dc2");
  expects(at.z_half_mm > 0.0, "the probed length is not 0");
}

// The readings [from, from + count) of every column that is there.
TermContext part_of(const TermContext& at, std::size_t from, std::size_t count) {
  TermContext part = at;
  for (auto* column :
       {&part.c_rad, &part.z_mm, &part.time_s, &part.speed_rad_per_s, &part.velocity_mm_per_s,
        &part.x_mm, &part.sensed_mm, &part.dx_dc, &part.dx_dz, &part.d2x_dc2, &part.theta_rad,
        &part.theta_chuck_rad, &part.s_mm, &part.clamp_force_ratio}) {
    if (!column->empty()) *column = column->subspan(from, count);
  }
  return part;
}

}  // namespace

std::vector<LinearParameter> linear_parameters(const Term& term, const TermShape& shape) {
  return std::visit(
      [&](const auto& of) -> kind::Linear {
        if constexpr (is_nothing<decltype(of)>) {
          return {};
        } else {
          return kind::linear(of, shape);
        }
      },
      term);
}

std::vector<std::string> shape_parameters(const Term& term) {
  return std::visit(
      [](const auto& of) -> kind::Names {
        if constexpr (is_nothing<decltype(of)>) {
          return {};
        } else {
          return kind::shapes(of);
        }
      },
      term);
}

void fill_columns(const Term& term, const TermContext& context, const TermShape& shape,
                  std::span<double* const> columns) {
  check(term, context);
  expects(columns.size() == linear_parameters(term, shape).size(), "one column a linear parameter");
  std::vector<double*> out(columns.begin(), columns.end());
  for (std::size_t from = 0; from < context.size(); from += kind::chunk_size) {
    const std::size_t count = std::min(kind::chunk_size, context.size() - from);
    const TermContext part = part_of(context, from, count);
    std::visit(
        [&](const auto& of) {
          if constexpr (!is_nothing<decltype(of)>) kind::fill(of, part, shape, out);
        },
        term);
    for (double*& column : out) column += count;
  }
}

}  // namespace trueaxis
