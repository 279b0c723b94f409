// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "form/axis_line.hpp"
#include "form/section_model.hpp"
#include "form/sections.hpp"
#include "form/surface_local.hpp"
#include "form/surface_sums.hpp"

namespace trueaxis::form {

struct ChainOptions {
  int draws = 300;
  std::uint64_t seed = 12181;
  double least_noise_mm = 0.0;  ///< a reading's standard deviation is no less
};

/// Draws from what the readings show of a surface.
struct SurfacePosterior {
  Eigen::MatrixXd coefficients;    ///< a column a draw
  std::vector<double> noise_mm;    ///< of a reading, of each draw
  Eigen::VectorXd order_is_there;  ///< of each order, the share of draws that have any of it
  std::vector<LocalForm> local;    ///< whose coefficients are the last
};

/// A Markov chain of the surface's coefficients, of which terms are there at all, how large those
/// are, and of the noise (Eqs. 319, 320). Radius, cone and axis (orders 0 and 1 of degrees 0 and 1)
/// have no prior. Local forms that explain more than any order are terms too (Eq. 320a).
/// Deterministic.
SurfacePosterior sample_surface(const SurfaceTerms& terms, const SurfaceData& data,
                                const ChainOptions& options);

/// A surface of revolution with its form, by all readings together: what they show of it as draws
/// (`surface_chain.hpp`), read off at angles of stations along Z. Eqs. 317-321.
class SurfaceModel {
 public:
  SurfaceModel(const SurfaceReadings& readings, const FormOptions& options);

  /// The surface of the mean at each station, which is all but its uncertainty.
  std::vector<SectionModel> sections() const;

  std::size_t draws() const { return static_cast<std::size_t>(posterior_.coefficients.cols()); }
  /// Filtered profiles of a draw at the places of `sections()`, with what is not known of
  /// amplitudes that were subtracted.
  std::vector<std::vector<double>> profiles(std::size_t draw) const;

  /// Terms of one u of each amplitude that was subtracted from the readings, and their correlation;
  /// every draw is then off by some of them. Eq. 291.
  void add_taken_off(std::span<const std::vector<double>> columns_mm,
                     std::span<const double> correlation);

  /// Orders of which the cut-off takes part and that are certainly there.
  std::vector<SwallowedLobes> swallowed() const;
  FormSurface form() const;

 private:
  /// f_d(t), and what the columns of the local forms are times of there.
  struct Place {
    Eigen::VectorXd along;
    Eigen::RowVectorXd local;
  };
  struct Station {
    double z_mm = 0.0, gaps_rad = 0.0;
    Place at;
    std::vector<std::size_t> place;  ///< of its angles in the grid
    std::vector<Order> orders;       ///< before the filter
    std::size_t readings = 0;        ///< that are nearer to it than to any other
    /// What the readings about it have on average that no degree follows: radius, x, y.
    Eigen::Vector3d unfollowed_mm = Eigen::Vector3d::Zero();
  };
  void put_about_axis(const SurfaceReadings& readings);
  void make_grid();
  std::vector<double> station_places() const;
  void add_station(double z_mm, std::span<const std::size_t> by_z);
  void keep_coefficients();
  void sample();
  bool leave_out_far();
  std::vector<double> left_mm() const;  ///< readings less the surface of the mean
  void find_unfollowed();
  void find_unfollowed_tops(const std::vector<double>& left_mm);
  std::vector<double> kept_of(std::span<const double> column) const;
  Place place_of(double t) const;
  /// Amplitudes of cos and sin of an order there.
  Eigen::Vector2d amplitudes(const Place& at, int order,
                             const Eigen::Ref<const Eigen::VectorXd>& q) const;
  std::vector<Order> orders_at(const Station& station) const;
  /// @param filtered through the band, else as it is
  std::vector<double> profile(const Station& station, const Eigen::Ref<const Eigen::VectorXd>& q,
                              bool filtered) const;

  FormOptions options_;
  SurfaceTerms terms_;
  double turns_ = 1.0, per_turn_ = 0.0, middle_mm_ = 0.0, half_mm_ = 1.0, radius_mm_ = 0.0;
  bool radius_known_ = true;
  AxisLine axis_;
  std::vector<double> angle_rad_, t_, z_mm_, off_mm_;  ///< of the readings, about the axis
  std::vector<std::size_t> kept_;                      ///< of them by a robust filter; empty: all
  SurfacePosterior posterior_;
  std::vector<Eigen::MatrixXd> local_;  ///< of each order: amplitudes of all local forms' columns
  Eigen::VectorXd mean_, spread_;       ///< of the coefficients
  double noise_mm_ = 0.0;
  std::vector<double> cosine_, sine_;  ///< of the grid of angles
  std::vector<double> band_;           ///< share of each order that the pass band lets through
  std::vector<Station> stations_;
  /// What the readings have on average at the tops of local forms beyond them.
  struct Top {
    LocalForm form;
    double height_mm;
  };
  std::vector<Top> unfollowed_tops_;
  std::vector<Eigen::MatrixXd> taken_off_;  ///< columns for independent normal numbers
};

}  // namespace trueaxis::form
