// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/regression/joint.hpp"
#include "diagnose/search/search.hpp"

namespace trueaxis::diagnose_detail {

/// Terms by what they are of a part: "a local form at 30.0° (± 10.0°) and lobes of order 2, 4".
std::string form_words(const std::vector<Hypothesis>& terms);

/// Of few angles local forms of the part and lobes are one class where either explains the
/// readings: all in words, their probabilities, and the least number of angles a section that
/// would tell them from the one that is named. Empty: that one alone does.
/// @param joint of the model that is named
std::vector<std::string> form_class_remark(const Problem& problem, const Joint& joint,
                                           const std::vector<Otherwise>& others);

/// Of sections of few even angles what lobes no such section shows: they look like eccentricity or
/// like another radius (Eq. 76a). Empty: of another stream.
std::vector<std::string> alias_remark(const Resolution& resolution);

/// The least number of angles in each of the same sections at which the one model's best fit is
/// told from the other's with the probability 0.98 (Eq. 88); 0: none of those that are tried.
int angles_that_tell(const Problem& problem, const Joint& named, const Joint& other);

}  // namespace trueaxis::diagnose_detail
