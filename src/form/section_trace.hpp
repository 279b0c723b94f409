// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "form/sections.hpp"
#include "form/trace.hpp"

namespace trueaxis::form {

/// The readings of one section in order of angle, about the centre of their least-squares circle.
class SectionTrace {
 public:
  /// @param radius_known false: the readings are of a gauge without a nominal radius; Eq. 265
  /// @param high_upr cut-off, by which a section of very many readings is averaged to places
  SectionTrace(const SectionReadings& readings, bool radius_known, double high_upr);

  /// Of a trace that is about its circle.
  struct Circle {
    double x_mm, y_mm, mean_mm;
  };
  SectionTrace(Trace about, const Circle& circle, bool radius_known)
      : trace_(std::move(about)),
        x_mm_(circle.x_mm),
        y_mm_(circle.y_mm),
        mean_mm_(circle.mean_mm),
        radius_known_(radius_known) {}

  /// Deviations at the places of `trace()` of readings at the same angles, little changed, about
  /// the same centre and mean.
  std::vector<double> changed(const SectionReadings& readings) const;

  const std::string& trouble() const { return trouble_; }  ///< why there is no section
  const Trace& trace() const { return trace_; }
  double x_mm() const { return x_mm_; }  ///< centre in the part frame
  double y_mm() const { return y_mm_; }
  double mean_mm() const { return mean_mm_; }  ///< radius, or the gauge's mean
  double radius_mm() const { return radius_known_ ? mean_mm_ : 0.0; }  ///< 0: not known

 private:
  std::vector<double> off_mean(const SectionReadings& readings) const;
  Trace at_places(const std::vector<double>& off_mm) const;

  std::vector<double> angle_rad_;  ///< of the readings about the centre, in the order of the stream
  Trace trace_;
  double x_mm_ = 0.0, y_mm_ = 0.0, mean_mm_ = 0.0, turns_ = 1.0;
  bool radius_known_ = true;
  std::size_t most_ = 0;
  std::string trouble_;
};

}  // namespace trueaxis::form
