// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/dictionary.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "diagnose/search/causes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

Hypothesis function_of(int order, int degree, bool spindle = false, bool in_time = false) {
  Hypothesis h;
  h.pattern = {.order = static_cast<double>(order),
               .spindle = spindle,
               .degree = degree,
               .in_time = in_time};
  return h;
}

/// But for the degree: a carrier has the highest.
bool same_shape(const TermShape& a, TermShape b) {
  b.degree = a.degree;
  return a == b;
}

/// The form of a hypothesis that holds all columns of its variants.
Hypothesis carrier_of(const Hypothesis& h) {
  Hypothesis out = h;
  out.free.clear();
  if (h.effect->search.highest_degree > 0) out.shape.degree = h.effect->search.highest_degree;
  return out;
}

Columns subset(const Columns& all, const Hypothesis& h) {
  Columns out;
  if (h.free.empty()) {
    out.assign(all.begin(), all.begin() + static_cast<long>(h.columns()));
  } else {
    for (const std::size_t j : h.free) out.push_back(all[j]);
  }
  return out;
}

/// The functions of the basis that a cause is made of: form along the normal, constant or growing
/// along the part around it, a polynomial along its profile; empty: it is made of none.
std::vector<std::pair<double, int>> functions_of(const Hypothesis& h) {
  std::vector<std::pair<double, int>> out;  // order and degree
  const auto* around = std::get_if<Harmonic>(&h.effect->term);
  const auto* along = std::get_if<PolynomialInZ>(&h.effect->term);
  if (around && around->angle == Harmonic::Angle::part && has_free_order(*h.effect) &&
      around->envelope == Harmonic::Envelope::growing && around->port == TermPort::normal) {
    out.emplace_back(h.shape.order, 0);
    if (h.free.empty()) out.emplace_back(h.shape.order, 1);
  } else if (along && along->port == TermPort::normal && !along->plain && !along->dish) {
    for (std::size_t k = 0; k < h.columns(); ++k) {
      const std::size_t place = h.free.empty() ? k : h.free[k];
      out.emplace_back(0.0, along->first + static_cast<int>(place));
    }
  }
  return out;
}

/// Their columns, where the basis has them all.
std::optional<Columns> in_basis(const Hypothesis& h, const std::vector<Hypothesis>& basis,
                                const std::vector<Columns>& places) {
  Columns out;
  for (const auto& [order, degree] : functions_of(h)) {
    const auto found = std::ranges::find_if(basis, [&](const Hypothesis& c) {
      return c.pattern.order == order && c.pattern.degree == degree && !c.pattern.spindle &&
             !c.pattern.in_time;
    });
    if (found == basis.end()) return std::nullopt;
    const Columns& own = places[static_cast<std::size_t>(found - basis.begin())];
    out.insert(out.end(), own.begin(), own.end());
  }
  if (out.empty()) return std::nullopt;
  return out;
}

/// Causes that show from pass to pass, first what is most easily mistaken for noise.
std::vector<Hypothesis> shown_between_passes(const LinearisationPoint& point,
                                             const Resolution& resolution) {
  std::vector<Hypothesis> list;
  if (resolution.one_variable || resolution.sections) return list;
  std::vector<const Effect*> shown;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.between_passes > 0 && is_of(effect, point.base) &&
        (!effect.needs.length || resolution.degrees > 0) && (!effect.needs.time || point.has_time))
      shown.push_back(&effect);
  }
  std::ranges::sort(shown, {}, &Effect::between_passes);
  for (const Effect* effect : shown) {
    TermShape sensor;
    sensor.reference_x_mm = point.reference_x_mm;
    sensor.range_mm = point.range_x_mm;
    list.push_back(of_effect(*effect, sensor));
  }
  return list;
}

}  // namespace

std::vector<Hypothesis> fourier_legendre_basis(const LinearisationPoint& point,
                                               const Resolution& resolution) {
  std::vector<Hypothesis> basis;
  for (int n = 0; n <= resolution.harmonics; ++n) {
    for (int l = 0; l <= resolution.degrees + (n == 0 && resolution.degrees > 3 ? 1 : 0); ++l)
      basis.push_back(function_of(n, l));
  }
  if (point.reindexed || point.two_sided) {
    for (int n = 2; n <= resolution.harmonics; ++n) {
      basis.push_back(function_of(n, 0, true));
      if (resolution.degrees > 0) basis.push_back(function_of(n, 1, true));
    }
  }
  if (point.has_time && !resolution.one_variable && !resolution.sections) {
    for (int n = 0; n <= std::min(resolution.harmonics, 3); ++n) {
      for (int l = 1; l <= 3; ++l) basis.push_back(function_of(n, l, true, true));
    }
  }
  return basis;
}

std::vector<Hypothesis> small_fourier_legendre_basis(const LinearisationPoint& point,
                                                     const Resolution& resolution) {
  std::vector<Hypothesis> basis;
  const std::size_t most = point.size() / 3;
  std::size_t columns = point.base.columns();
  const auto fits = [&](const Hypothesis& h) {
    if (columns + h.columns() > most) return false;
    columns += h.columns();
    return true;
  };
  // A constant of every pass is what a walk of the noise looks like: it has its room before any
  // harmonic, and its place after them, which may already hold it.
  std::vector<Hypothesis> shown = shown_between_passes(point, resolution);
  std::erase_if(shown, [&](const Hypothesis& h) { return !fits(h); });
  const auto take = [&](Hypothesis h) {
    if (fits(h)) basis.push_back(std::move(h));
  };
  const auto add = [&](int n, int l) { take(function_of(n, l)); };
  for (int n = 0; n <= resolution.harmonics; ++n) {
    add(n, 0);
    if (resolution.degrees > 0) add(n, 1);
    if (n == 0 || n == 2) {
      for (int l = 2; l <= resolution.degrees; ++l) add(n, l);
    }
  }
  // Between passes: machine terms seen from the rear, drift, backlash, latency.
  const auto add_machine = [&](int n, int l, bool in_time) {
    take(function_of(n, l, true, in_time));
  };
  if (point.two_sided || point.reindexed) {
    for (int l = 0; l <= std::min(3, resolution.degrees); ++l) add_machine(0, l, false);
    for (int n = 2; n <= resolution.harmonics; ++n) {
      add_machine(n, 0, false);
      if (resolution.degrees > 0) add_machine(n, 1, false);
    }
  }
  if (point.has_time && !resolution.one_variable && !resolution.sections) {
    for (int n = 0; n <= 1; ++n)
      for (int l = 1; l <= 3; ++l) add_machine(n, l, true);
  }
  std::ranges::move(shown, std::back_inserter(basis));
  return basis;
}

std::unique_ptr<Dictionary> make_dictionary(const Problem& problem,
                                            const std::vector<double>& phi) {
  auto out = std::make_unique<Dictionary>(Dictionary{
      phi,
      NormalEquations(problem.point, problem.mask, problem.deviation_mm, phi, problem.threads),
      preset_causes(problem),
      fourier_legendre_basis(problem.point, problem.resolution),
      {},
      {},
      0,
      0.0});
  for (Hypothesis& h : out->basis) h.tests = static_cast<double>(out->basis.size());
  std::vector<Hypothesis> list = out->basis;
  std::vector<std::size_t> carrier(out->presets.size(), 0);
  // The basis comes first: their places are known before anything is appended.
  std::vector<Columns> basis_places;
  std::size_t next = 1 + out->equations.base().size();
  for (const Hypothesis& h : out->basis) {
    Columns own(h.columns());
    for (std::size_t& c : own) c = next++;
    basis_places.push_back(std::move(own));
  }
  std::vector<std::optional<Columns>> shared;
  for (std::size_t i = 0; i < out->presets.size(); ++i) {
    shared.push_back(in_basis(out->presets[i], out->basis, basis_places));
    if (shared.back()) continue;
    const Hypothesis wanted = carrier_of(out->presets[i]);
    const auto found = std::find_if(
        list.begin() + static_cast<long>(out->basis.size()), list.end(), [&](const Hypothesis& h) {
          return h.effect == wanted.effect && same_shape(h.shape, wanted.shape);
        });
    carrier[i] = static_cast<std::size_t>(found - list.begin());
    if (found == list.end()) list.push_back(wanted);
  }
  const std::vector<Columns> places = out->equations.append(list, 0);
  out->basis_places.assign(places.begin(), places.begin() + static_cast<long>(out->basis.size()));
  for (std::size_t i = 0; i < out->presets.size(); ++i) {
    out->preset_places.push_back(shared[i] ? *shared[i]
                                           : subset(places[carrier[i]], out->presets[i]));
  }
  if (!problem.whole || problem.whole->point.size() < very_many) out->equations.keep_columns();
  out->columns = static_cast<std::size_t>(out->equations.total().rows());
  out->noise_freedom =
      static_cast<double>(out->equations.count()) -
      static_cast<double>(out->equations.base().size() + columns_of(small_fourier_legendre_basis(
                                                             problem.point, problem.resolution)));
  return out;
}

}  // namespace trueaxis::diagnose_detail
