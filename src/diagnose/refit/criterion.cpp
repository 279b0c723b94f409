// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "diagnose/refit/places_before.hpp"
#include "diagnose/refit/relinearised_fit.hpp"
#include "diagnose/search/scan.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// What shapes a term, in addition to its sizes: a date, a frequency, a length, the place of a
/// form.
std::size_t shape_parameters(const Hypothesis& h) {
  if (is_slip(h)) return is_step_at_once(h) ? 1 : 2;
  if (is_line(h)) return 1;
  if (!h.effect) return h.pattern.kind == Pattern::Kind::bump ? 4 : 0;
  return h.effect->refinement && !is_linearised_at_its_size(h) ? 1 : 0;
}

}  // namespace

double criterion_of(const Joint& joint) {
  // Columns of an absurd model, which cancel, may leave less than nothing.
  if (!(joint.solution.rss > 0.0)) return std::numeric_limits<double>::infinity();
  const auto rows = static_cast<double>(joint.equations.count());
  std::size_t parameters = joint.solution.rank;
  for (const Hypothesis& h : joint.terms) parameters += shape_parameters(h);
  return rows * std::log(joint.solution.rss) - joint.equations.log_volume() +
         static_cast<double>(parameters) * std::log(rows);
}

}  // namespace trueaxis::diagnose_detail
