// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace trueaxis::testing {

/// A lathe in time: probe, servo and spindle are integrated step by step, and the part is a radius
/// over an angle. It shares nothing with TrueAxis but the meaning of X, C and Z.
struct ShopLathe {
  // What stays with the machine.
  double probe_lag_s = 2e-3, probe_gain = 1.004;
  double servo_lag_s = 1.5e-3, servo_gain = 1.01;
  double motion_mm = 0.0, motion_phase_rad = 0.0;  ///< of the spindle along X, three per revolution
  double probing_rpm = 120.0, cutting_rpm = 600.0, noise_mm = 5e-4;

  /// What comes with a part: clamping and lobes.
  struct Part {
    double radius_mm = 30.0;
    std::complex<double> place_mm, slope;          ///< of the axis at Z 0, per mm
    double lobes_mm = 0.0, lobes_phase_rad = 0.0;  ///< three per revolution
    std::complex<double> axis_at(double z_mm) const { return place_mm + slope * z_mm; }
  };

  /// The servo on its way over a table, row by row.
  struct Cut {
    std::size_t rows = 0;  ///< per revolution
    std::vector<double> z_mm, radius_mm;
    /// At an angle and a height, between the two revolutions next to it.
    double at(double c_rad, double z) const {
      const double turns = c_rad / (2.0 * std::numbers::pi);
      const double share = (turns - std::floor(turns)) * static_cast<double>(rows);
      const auto low = static_cast<std::size_t>(share) % rows;
      const double w = share - std::floor(share);
      return (1.0 - w) * along(low, z) + w * along((low + 1) % rows, z);
    }
    /// The axis of the surface at a height: the first harmonic of its radius.
    std::complex<double> axis_at(double z) const { return order_at(1, z); }
    /// a e^{iφ} of a cos(nC − φ) in its radius.
    std::complex<double> order_at(int n, double z) const {
      std::complex<double> sum;
      for (std::size_t i = 0; i < rows; ++i)
        sum += along(i, z) * std::polar(1.0, 2.0 * std::numbers::pi * n * static_cast<double>(i) /
                                                 static_cast<double>(rows));
      return 2.0 / static_cast<double>(rows) * sum;
    }

   private:
    double along(std::size_t row, double z) const {
      std::size_t i = row;
      const auto passed = [&](std::size_t k) {
        return (z_mm.back() < z_mm.front()) ? z_mm[k] <= z : z_mm[k] >= z;
      };
      while (i + rows < z_mm.size() && !passed(i + rows)) i += rows;
      if (i + rows >= z_mm.size() || z_mm[i + rows] == z_mm[i]) return radius_mm[i];
      const double w = (z - z_mm[i]) / (z_mm[i + rows] - z_mm[i]);
      return radius_mm[i] + w * (radius_mm[i + rows] - radius_mm[i]);
    }
  };

  double motion_at(double c_rad) const {
    return motion_mm * std::cos(3.0 * c_rad - motion_phase_rad);
  }

  /// A pass along Z; `surface_mm` is where the probe meets the part at C and Z.
  std::string probed(double z_from, double z_to, double radius_mm,
                     const std::function<double(double, double)>& surface_mm,
                     std::uint64_t seed) const {
    constexpr double step_s = 2e-4, turns = 41.3, per_turn = 36.7;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, noise_mm);
    const double speed = probing_rpm / 60.0, duration = turns / speed;
    const auto c_at = [&](double t) { return 2.0 * std::numbers::pi * speed * t; };
    const auto z_at = [&](double t) {
      return z_from + (z_to - z_from) * std::max(0.0, t) / duration;
    };
    const auto true_x = [&](double t) {
      const double c = c_at(t);
      return surface_mm(c, z_at(t)) + motion_at(c);
    };
    std::ostringstream out;
    out << "# x_convention: radius\nt[s],X_M[mm],C[deg],Z[mm]\n";
    double follows = true_x(-0.1), t = -0.1;
    char line[120];
    for (int i = 0; i < static_cast<int>(turns * per_turn); ++i) {
      const double until = i / (per_turn * speed);
      while (t < until) {
        const double step = std::min(step_s, until - t);
        // The low pass, exact for a straight line between the two ends of the step.
        const double before = true_x(t), slope = (true_x(t + step) - before) / step;
        const double settled = before - slope * probe_lag_s;
        follows = settled + slope * step + (follows - settled) * std::exp(-step / probe_lag_s);
        t += step;
      }
      const double x = radius_mm + probe_gain * (follows - radius_mm) + noise(random);
      std::snprintf(line, sizeof line, "%.6f,%.7f,%.5f,%.6f\n", until, x,
                    c_at(until) * 180.0 / std::numbers::pi, z_at(until));
      out << line;
    }
    return out.str();
  }

  /// The seat of a part between two heights.
  std::string probed_part(const Part& part, double z_from, double z_to, std::uint64_t seed) const {
    return probed(
        z_from, z_to, part.radius_mm,
        [&](double c, double z) {
          double x = part.radius_mm;
          for (int i = 0; i < 8; ++i) {  // contracts by the eccentricity over the radius
            const std::complex<double> off = std::polar(x, c) - part.axis_at(z);
            const double wanted = part.radius_mm + part.lobes_mm * std::cos(3.0 * std::arg(off) -
                                                                            part.lobes_phase_rad);
            x += wanted - std::abs(off);
          }
          return x;
        },
        seed);
  }

  std::string probed_cut(const Cut& cut, double z_from, double z_to, double radius_mm,
                         std::uint64_t seed) const {
    return probed(
        z_from, z_to, radius_mm, [&](double c, double z) { return cut.at(c, z); }, seed);
  }

  /// The cut on a form tester, in the part's C: three sections about an axis of the tester's own,
  /// with lobes that the part has by itself, as a chuck leaves them.
  static std::string measured_form(const Cut& cut, double two_lobes_mm, double three_lobes_mm,
                                   std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 2e-5);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    const std::complex<double> off = std::polar(5e-3, phase(random));
    const double two = phase(random), three = phase(random);
    std::ostringstream out;
    out << "# x_convention: radius\nX_M[mm],C[deg],Z[mm]\n";
    char line[80];
    for (int i = 0; i < 3 * 720; ++i) {
      const double c = std::numbers::pi / 360.0 * i, z = 45.0 + 6.0 * (i / 720);
      // About its own axis, and set up on the tester a little off.
      const double x = cut.at(c, z) - (cut.axis_at(z) * std::polar(1.0, -c)).real() +
                       (off * std::polar(1.0, -c)).real() + two_lobes_mm * std::cos(2.0 * c - two) +
                       three_lobes_mm * std::cos(3.0 * c - three) + noise(random);
      std::snprintf(line, sizeof line, "%.8f,%.5f,%.5f\n", x, 0.5 * i, z);
      out << line;
    }
    return out.str();
  }

  /// A cylinder turned with the rows of a table.csv: the servo follows X_command as a low pass of
  /// its own, and the spindle moves the part against the tool.
  Cut turned(const std::string& table, double radius_mm) const {
    Cut cut;
    std::vector<double> command, c_deg;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
      double rev, z, c, wanted, sent;
      if (line.empty() || line[0] == '#' || line[0] == 'r') continue;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &rev, &z, &c, &wanted, &sent) != 5)
        continue;
      if (rev == 0.0) ++cut.rows;
      cut.z_mm.push_back(z), command.push_back(sent), c_deg.push_back(c);
    }
    const double step = 60.0 / cutting_rpm / static_cast<double>(cut.rows);
    // A revolution before the first row, with its commands: the tool runs in.
    double follows = command.front();
    for (std::size_t i = 0; i < cut.rows + command.size(); ++i) {
      const std::size_t now = i < cut.rows ? i : i - cut.rows;
      const std::size_t next = std::min(now + 1, command.size() - 1);
      if (i >= cut.rows)
        cut.radius_mm.push_back(radius_mm + follows -
                                motion_at(c_deg[now] * std::numbers::pi / 180.0));
      const double slope = servo_gain * (command[next] - command[now]) / step;
      const double settled = servo_gain * command[now] - slope * servo_lag_s;
      follows = settled + slope * step + (follows - settled) * std::exp(-step / servo_lag_s);
    }
    return cut;
  }
};

}  // namespace trueaxis::testing
