// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/job.hpp"

/// The risk of a GO: jobs whose truth is sealed, decided by the library, judged by the part that
/// the table would cut. The judge knows the drawn axes alone and shares nothing with the decision.
namespace trueaxis::risk {

/// What the streams of a job are like.
enum class Group {
  one_reference,    ///< noise alone
  two_references,   ///< noise alone, seats that are out of coaxial by up to 20 µm
  correlated,       ///< an autoregressive noise
  form,             ///< one effect at a size that machines show
  ambiguous_forms,  ///< two to four at once
  without_t,        ///< one or two effects, no clock
  slip,             ///< the part slips by 10 to 50 µm
  slip_without_t,
  two_slips,
  creeping_slip,  ///< by 20 to 100 µm over a fifth of the stream: evenly, in an S, settling, by
                  ///< jerks
  slip_beside_drift,
  slip_at_an_end,  ///< in the first or last 3 % of the stream
  slip_with_turn,
  slip_in_correlated_noise,  ///< an autoregression of 0.8
  slip_in_a_bore,
  slip_probed_behind
};
inline constexpr Group groups[] = {Group::one_reference,
                                   Group::two_references,
                                   Group::correlated,
                                   Group::form,
                                   Group::ambiguous_forms,
                                   Group::without_t,
                                   Group::slip,
                                   Group::slip_without_t,
                                   Group::two_slips,
                                   Group::creeping_slip,
                                   Group::slip_beside_drift,
                                   Group::slip_at_an_end,
                                   Group::slip_with_turn,
                                   Group::slip_in_correlated_noise,
                                   Group::slip_in_a_bore,
                                   Group::slip_probed_behind};
std::string_view name_of(Group group);

/// What came of one job.
struct Outcome {
  Decision decision = Decision::no_go;  ///< without a tolerance: `untoleranced` stands for a GO
  double upper_mm = 0.0;                ///< the smallest tolerance that would be a GO
  double coaxiality_mm = 0.0;           ///< of the part that the table cuts, in truth
  bool plain_go() const { return decision == Decision::untoleranced && !reserved; }
  bool reserved = false;
  std::string hidden, found;  ///< ids, joined by +
};

/// Draws the job of this seed, simulates, runs and judges it.
/// @param slips false: of a group of slips the same part held fast
Outcome judge(Group group, std::uint64_t seed, bool slips = true);

}  // namespace trueaxis::risk
