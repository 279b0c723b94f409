// SPDX-License-Identifier: Apache-2.0
// Law: the columns of a block of readings are those of its readings one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t readings = 700;  // more than two chunks, and no multiple of one
constexpr unsigned seed = 61;

/// Random geometry of a cone met off its axis.
class Readings {
 public:
  Readings() {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (auto& column : columns_) {
      column.resize(readings);
      for (double& value : column) value = uniform(random);
    }
    for (double& x : columns_[4]) x += 40.0;
    for (double& x : columns_[5]) x += 40.0;
  }

  TermContext part(std::size_t from, std::size_t count) const {
    TermContext at;
    std::size_t next = 0;
    for (auto* column : {&at.c_rad, &at.z_mm, &at.time_s, &at.speed_rad_per_s, &at.x_mm,
                         &at.sensed_mm, &at.velocity_mm_per_s, &at.dx_dc, &at.dx_dz, &at.d2x_dc2,
                         &at.theta_rad, &at.theta_chuck_rad, &at.s_mm, &at.clamp_force_ratio}) {
      *column = std::span(columns_[next++]).subspan(from, count);
    }
    at.z_half_mm = 0.8;
    at.height_mm = 0.3;
    at.tan_half_angle = 0.1;
    return at;
  }

 private:
  std::vector<double> columns_[14];
};

TEST(EffectBlockLaw, ABlockIsFilledAsItsReadingsAre) {
  const Readings data;
  TermShape shape;
  shape.order = 3.0;
  shape.degree = 5;
  for (const Effect& effect : effect_catalogue()) {
    const std::size_t count = linear_parameters(effect.term, shape).size();
    std::vector<std::vector<double>> block(count, std::vector<double>(readings, std::nan("")));
    std::vector<double*> columns;
    for (auto& column : block) columns.push_back(column.data());
    fill_columns(effect.term, data.part(0, readings), shape, columns);
    std::vector<double> one(count, std::nan(""));
    for (std::size_t j = 0; j < count; ++j) columns[j] = &one[j];
    for (std::size_t i = 0; i < readings; ++i) {
      fill_columns(effect.term, data.part(i, 1), shape, columns);
      for (std::size_t j = 0; j < count; ++j) {
        // Each reading goes through the same operations: the same bits.
        EXPECT_EQ(block[j][i], one[j]) << effect.id << ' ' << j << ' ' << i << " seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace trueaxis
