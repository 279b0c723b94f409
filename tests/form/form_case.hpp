// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "trueaxis/form.hpp"

/// The sealed study of the form of a surface: parts are drawn, probed and their form is worked out
/// by means that the program does not have.
namespace trueaxis::form_study {

/// How the lobes run along Z.
enum class Course { none, constant, growing, local };

struct Drawn {
  Course course = Course::none;
  bool sections = false;  ///< of angles that differ, else a helix
  double largest_um = 0.0;
  ProbeStream stream;
  double high_upr = 0.0;                ///< below 2: the readings carry none
  double ront_mm = 0.0, cylt_mm = 0.0;  ///< the truth, filtered
};

/// @param readings about so many
Drawn draw(std::uint64_t seed, std::size_t readings);

/// What one value says of a truth.
struct Judged {
  bool holds = false;  ///< value ± 2u, or the bound
  bool bound = false;
  double off_mm = 0.0;  ///< value less truth; of a bound 0
  double U_mm = 0.0;    ///< 2u; of a bound that
};
Judged judged(const FormResult& result, const std::string& name, const std::string& reference,
              double truth_mm);

/// U of the worst RONt where every turn is assessed by itself as far as it carries; 0: it does not.
double U_by_turns_mm(const Drawn& drawn);

FormResult assessed(const Drawn& drawn);

}  // namespace trueaxis::form_study
