// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/part_of_unknown.hpp"

#include <algorithm>

namespace trueaxis::calibrate_detail {
namespace {

constexpr double times_the_unknown = 4.0;  // twice in amplitude

/// Letter of the axis that a term is of; t of drifts and slips.
char letter_of(const MachineTerm& term) {
  const auto axis = axis_of(term);
  return axis ? trueaxis::letter_of(*axis) : 't';
}

/// The catalogue's term of every cause of a class.
std::vector<const MachineTerm*> terms_of(const MachineFinding& finding, const Found& search) {
  std::vector<const MachineTerm*> out;
  for (const std::string& member : finding.members()) {
    const auto at = std::ranges::find(search.terms, member, &Term::effect);
    if (at != search.terms.end() && !at->is_pattern()) out.push_back(&at->of.term);
  }
  return out;
}

bool shares_its_axis(const MachineFinding& finding, const Found& search) {
  return std::ranges::any_of(terms_of(finding, search), [&](const MachineTerm* member) {
    return std::ranges::any_of(search.found, [&](std::size_t t) {
      return search.terms[t].letters.find(letter_of(*member)) != std::string::npos;
    });
  });
}

/// Whether a cause of a class is that component error, as a function of its axis.
bool may_be(const MachineFinding& finding, const Found& search, const ErrorName& error) {
  return std::ranges::any_of(terms_of(finding, search), [&](const MachineTerm* member) {
    const auto* own = std::get_if<ErrorOfPosition>(member);
    return own != nullptr && own->error == error;
  });
}

/// The third of one error among the classes is not an order or degree of it.
bool one_of_three(const MachineFinding& finding, const std::vector<MachineFinding>& all,
                  const Found& search) {
  return std::ranges::any_of(terms_of(finding, search), [&](const MachineTerm* member) {
    const auto* own = std::get_if<ErrorOfPosition>(member);
    return own != nullptr && std::ranges::count_if(all, [&](const MachineFinding& other) {
                               return may_be(other, search, own->error);
                             }) >= 3;
  });
}

/// A ball that slips twice is one that goes along with something in time.
bool slips_again(std::size_t at, const Found& search) {
  const Term& own = search.terms[search.found[at]];
  return own.is_slip() && std::ranges::count_if(search.found, [&](std::size_t t) {
                            return search.terms[t].is_slip() &&
                                   search.terms[t].target == own.target;
                          }) > 1;
}

/// What some of the terms gain together after the others.
double gain_of_some(const Found& search, const std::vector<bool>& some) {
  Set others;
  for (std::size_t i = 0; i < some.size(); ++i)
    if (!some[i]) others.push_back(search.found[i]);
  return search.dictionary->gain(search.found) - search.dictionary->gain(others);
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
    unknown[at] = search.terms[search.found[at]].is_pattern() ||
                  shares_its_axis(findings[at], search) ||
                  one_of_three(findings[at], findings, search) || slips_again(at, search);
  add_what_gains_less(search, unknown);
  return unknown;
}

}  // namespace trueaxis::calibrate_detail
