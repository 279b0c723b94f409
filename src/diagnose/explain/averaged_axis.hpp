// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/regression/joint.hpp"
#include "diagnose/search/dictionary.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A model of the readings instead of the named one.
struct Alternative {
  double probability = 0.0;
  Eigen::VectorXd off;         ///< its base less that of the named model
  Eigen::MatrixXd covariance;  ///< what its term's own uncertainty adds to the base
};

/// The base of the model averaged over all that may have caused the readings (Hoeting et al. 1999,
/// Statistical Science 14, 382), weighted by their probability (Eq. 95).
struct AveragedAxis {
  Eigen::VectorXd shift;    ///< of the base, against that of the named model by least squares
  Eigen::MatrixXd within;   ///< covariance of the base by the noise, sizes being plausible
  Eigen::MatrixXd between;  ///< what the causes that the data cannot tell add
  /// What each of them adds: an effect that was not found, or what else a named cause may be.
  struct Source {
    const Effect* effect = nullptr;
    std::string instead_of;
    Eigen::MatrixXd covariance;
    std::vector<Alternative> law;  ///< the normals of its mixture; 0 with what they lack of 1
    double share = 0.0;            ///< of u², by which that would be smaller without it
  };
  std::vector<Source> sources;
  std::vector<AxisShare> shares;  ///< the models that move it, the largest first
};

/// @param findings the ambiguous terms of the joint fit
/// @param others models of other terms that explain the readings instead
AveragedAxis average_axis(const Problem& problem, const Joint& joint,
                          const std::vector<AmbiguousFinding>& findings,
                          const std::vector<Otherwise>& others = {});

/// Scales what the causes add so that 2 u is the 95.45 % interval of the mixture about its mean
/// (Eq. 95c). It is that in the worse direction of the axis at the worse end. Few of the causes
/// that are not seen are present, and few of those are large, so that 2 standard deviations hold
/// more or less.
void set_interval(const LinearisationPoint& point, AveragedAxis& average);

/// What u of the axis comes from, the largest share first.
std::vector<AxisLimit> limits_of(const LinearisationPoint& point, const AveragedAxis& average);

/// Before and after: the surface alone and with all terms, cross-validated block by block (Eqs.
/// 101, 102). @param average the axis that is stated
Gain measure_gain(const Problem& problem, const Joint& joint, const AveragedAxis& average,
                  double noise_floor_mm);

/// Amplitude of both residuals over the order, in steps of a resolution cell and at most 400 bins.
std::vector<SpectrumBin> spectrum_of(const LinearisationPoint& point, const Resolution& resolution,
                                     const std::vector<double>& before_mm,
                                     const std::vector<double>& after_mm);

}  // namespace trueaxis::diagnose_detail
