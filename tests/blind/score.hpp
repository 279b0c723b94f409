// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "blind/sealed_run.hpp"

namespace trueaxis::blind {

enum class Outcome {
  correct,
  too_wide,            ///< every truth in a class, a class with a member that the geometry excludes
  wrong_name,          ///< a truth in no class, and a cause whose class holds no truth
  missed,              ///< a truth in no class, nothing else found
  false_alarm,         ///< a null case with a cause
  extra_finding,       ///< every truth in a class, and one more cause
  not_called_unknown,  ///< a cause outside the catalogue was named, or not seen
  not_abstained,       ///< an absorbed cause: something was found, or it is not in not_observable
  crash
};

std::string to_string(Outcome outcome);
std::vector<Outcome> all_outcomes();

/// A class member besides the truth, and how far the judge finds it.
struct Member {
  std::string effect;
  double distance = 0.0;
};

struct Score {
  Outcome outcome = Outcome::crash;
  std::vector<std::string>
      named;  ///< per true effect the cause that holds it, or what is in its place
  std::vector<Member> members;  ///< all listed rival causes of all truths
  bool strict = true;           ///< every member within the demanded distance
};

/// Pairs truths and causes so that the most truths lie in the class of their cause; at most eight
/// causes.
std::vector<int> pair_up(const std::vector<Effect>& truths,
                         const std::vector<std::vector<std::string>>& classes);

Score score(const BlindCase& blind_case, const Sealed& truth, const Answer& answer);

}  // namespace trueaxis::blind
