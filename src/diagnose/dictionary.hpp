// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnose/atlas.hpp"
#include "diagnose/evidence.hpp"

namespace trueaxis::diagnose_detail {

/// All hypotheses that are tried one by one in every step, and their Gram matrix, which one pass
/// over the readings makes and every step of a search uses again. Variants of one effect share its
/// columns, and causes that are cells of the atlas those of the cells.
struct Dictionary {
  std::vector<double> phi;
  Evidence evidence;
  std::vector<Hypothesis> presets, cells;
  std::vector<Columns> preset_places, cell_places;
  std::size_t columns = 0;  ///< of the evidence, without what a step appends for a while
};

std::unique_ptr<Dictionary> make_dictionary(const Scene& scene, const Rows& rows,
                                            const Resolution& resolution,
                                            std::span<const double> deviation_mm,
                                            const std::vector<double>& phi, int threads);

}  // namespace trueaxis::diagnose_detail
