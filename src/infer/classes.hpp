// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "infer/gram.hpp"
#include "trueaxis/inference.hpp"

namespace trueaxis::infer {

/// d from which two causes are told apart: Φ(d/2) = 0.95 (Eq. 88).
inline constexpr double told_apart = 3.2897;
/// 2 ln(L_named/L_rival) that tells. If the rival cause at distance d is the true one, it is
/// Gaussian about −d² with variance 4 d². It is above t with probability Φ(−(t + d²)/(2 d)) ≤
/// Φ(−√t), the most at d² = t: 0.4 % for 7 (Eq. 91).
inline constexpr double likelihood_tells = 7.0;

/// Probability below which a cause is in no class.
inline constexpr double in_no_class = 1e-3;

/// Probability of the right name of two at the distance d: Φ(d/2) (Eq. 88).
double right_name(double d);
/// Against rival causes at some distances, each as often as it is the cause (Eq. 99).
double right_name_of(const std::vector<Rival>& rivals, const std::vector<double>& distances);

/// The least distance of a measurement that is advised: 2 ln L of the true cause over a rival cause
/// is Gaussian about d² with variance 4 d², and tells in Φ((d² − 7)/(2 d)) = 89 % (Eq. 188).
inline constexpr double sure_distance = 4.1;
inline constexpr double told_for_sure = 0.98;  ///< Φ(d/2) there
inline constexpr double found_for_sure = 0.9;  ///< power, likewise

/// ‖(I − P) μ‖² of μ = columns × coefficients, P what the projection took out.
double left_of(const Projection& beside, const Columns& columns,
               const Eigen::VectorXd& coefficients);

/// What a cause is called, and what it may be instead.
struct Named {
  Columns columns;
  Eigen::VectorXd coefficients;
  double criterion = 0.0;  ///< −2 ln of its likelihood, all paid for
};
struct Cause {
  std::string effect;
  Columns columns;
  double gain = 0.0;
  std::size_t rank = 0;
  double criterion = 0.0;
};

/// The class of a cause.
struct Class {
  struct Member {
    std::size_t cause = 0;
    Rival rival;
  };
  /// Effects that are dropped: too improbable, or told apart only as far as they are linear in
  /// their size.
  struct Dropped {
    std::size_t cause = 0;
    double probability = 0.0;
    bool told = false;
  };
  double probability = 1.0;     ///< of the name
  std::vector<Member> members;  ///< without it, the most probable first
  std::vector<Dropped> dropped;
};

/// A cause belongs to the class when its best fit is nearer to the named prediction than
/// `told_apart`, or when the data's own likelihood ratio does not tell (Eqs. 87–93). Of several
/// causes of one effect the first counts.
/// @param others columns that are fitted with it, base and terms
/// @param beside the residuals after them
/// @param variance of a residual with all terms, of `freedom` degrees of freedom
Class distinguish(const Eigen::MatrixXd& gram, const Columns& others, const Projection& beside,
                  const Named& named, std::span<const Cause> causes, double variance,
                  double freedom);

}  // namespace trueaxis::infer
