// SPDX-License-Identifier: Apache-2.0
#include "calibrate/part_of_unknown.hpp"

#include <algorithm>

namespace trueaxis::calibrate_detail {
namespace {

using Set = Regression::Set;

constexpr double times_the_unknown = 4.0;  // twice in amplitude

/// The axis of an effect by its letter; t of drifts and slips.
char letter_of_effect(const std::string& effect) {
  if (effect.starts_with("reversal.")) return effect.back();
  return effect.front() == 'E' ? effect[2] : 't';
}

bool shares_its_axis(const MachineFinding& finding, const Found& search) {
  return std::ranges::any_of(finding.members(), [&](const std::string& member) {
    return std::ranges::any_of(search.found, [&](std::size_t t) {
      return search.terms[t].letters.find(letter_of_effect(member)) != std::string::npos;
    });
  });
}

/// The third of one error among the classes is no order or degree of it.
bool one_of_three(const MachineFinding& finding, const std::vector<MachineFinding>& all) {
  return std::ranges::any_of(finding.members(), [&](const std::string& member) {
    return member.front() == 'E' &&
           std::ranges::count_if(all, [&](const MachineFinding& other) {
             return std::ranges::any_of(other.members(), [&](const std::string& one) {
               return one.starts_with(member.substr(0, 4));
             });
           }) >= 3;
  });
}

/// A ball that slips twice is one that goes along with something in time.
bool slips_again(std::size_t at, const Found& search) {
  const auto slip = [&](std::size_t t) { return search.terms[t].effect == "ball.slip"; };
  const std::size_t own = search.found[at];
  return slip(own) && std::ranges::count_if(search.found, [&](std::size_t t) {
                        return slip(t) && search.terms[t].target == search.terms[own].target;
                      }) > 1;
}

/// What some of the terms gain together beside the others.
double gain_of_some(const Found& search, const std::vector<bool>& some) {
  Set others;
  for (std::size_t i = 0; i < some.size(); ++i)
    if (!some[i]) others.push_back(search.found[i]);
  return search.regression->gain(search.found) - search.regression->gain(others);
}

/// What gains less than some times all that is unknown together may be what the nearest form leaves
/// of it.
void add_what_gains_less(const Found& search, std::vector<bool>& unknown) {
  for (bool added = std::ranges::find(unknown, true) != unknown.end(); added;) {
    added = false;
    const double least = times_the_unknown * gain_of_some(search, unknown);
    for (std::size_t at = 0; at < unknown.size(); ++at) {
      std::vector<bool> alone(unknown.size(), false);
      alone[at] = true;
      if (unknown[at] || gain_of_some(search, alone) >= least) continue;
      unknown[at] = added = true;
    }
  }
}

}  // namespace

std::vector<bool> parts_of_unknown(const Found& search,
                                   const std::vector<MachineFinding>& findings) {
  std::vector<bool> unknown(findings.size());
  for (std::size_t at = 0; at < findings.size(); ++at)
    unknown[at] = search.terms[search.found[at]].pattern || shares_its_axis(findings[at], search) ||
                  one_of_three(findings[at], findings) || slips_again(at, search);
  add_what_gains_less(search, unknown);
  return unknown;
}

}  // namespace trueaxis::calibrate_detail
