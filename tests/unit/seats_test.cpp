// SPDX-License-Identifier: Apache-2.0
// Seats in one stream: where they are, and that a smooth one is never taken apart. The part is
// written here as a closed form that shares nothing with the engine: sections are circles.
#include "measure/seats.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/beta.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// How a part is probed: a helix over [0, length], or sections.
struct Probing {
  double length_mm = 40.0, feed_mm = 0.5;
  int per_turn = 72;
  double noise_mm = 0.001;
  bool back = false;  ///< and back again
  int sections = 0;   ///< at standing Z, instead
};

using Radius = std::function<double(double z_mm, double c_rad)>;
struct Offset {
  double x_mm, y_mm;
};
using Path = std::function<Offset(double z_mm, double share)>;

ProbeStream probed(const Probing& how, const Radius& radius, const Path& axis,
                   std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, how.noise_mm);
  ProbeStream stream;
  const auto read = [&](double z, double c, double share) {
    const auto [x, y] = axis(z, share);
    // A fixed probe at +X on a part turned by C: x cos C + y sin C along it, the rest across.
    const double along = x * std::cos(c) + y * std::sin(c);
    const double across = y * std::cos(c) - x * std::sin(c);
    const double r = radius(z, c);
    stream.reading_mm.push_back(along + std::sqrt(r * r - across * across) + noise(random));
    stream.c_rad.push_back(c);
    stream.position_mm.push_back(z);
  };
  if (how.sections > 0) {
    for (int s = 0; s < how.sections; ++s)
      for (int i = 0; i < how.per_turn; ++i)
        read(how.length_mm * s / (how.sections - 1), turn * (s + 1.0 * i / how.per_turn),
             1.0 * s / how.sections);
    return stream;
  }
  const int each = static_cast<int>(how.length_mm / how.feed_mm * how.per_turn);
  for (int i = 0; i <= each; ++i)
    read(how.length_mm * i / each, turn * i / how.per_turn, 0.5 * i / each);
  for (int i = each; how.back && i >= 0; --i)
    read(how.length_mm * i / each, turn * (2 * each - i) / how.per_turn, 1.0 - 0.5 * i / each);
  return stream;
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
bool chance(std::mt19937_64& random, double p) { return uniform(random, 0, 1) < p; }

Probing any_probing(std::mt19937_64& random) {
  Probing how;
  how.length_mm = uniform(random, 15, 90);
  how.feed_mm = how.length_mm / uniform(random, 12, 160);
  how.per_turn = static_cast<int>(uniform(random, 16, 240));
  how.noise_mm = std::exp(uniform(random, std::log(1e-4), std::log(5e-3)));
  how.back = chance(random, 0.3);
  if (chance(random, 0.2)) how.sections = static_cast<int>(uniform(random, 3, 12));
  return how;
}

/// Eccentricity to 0.5 mm (run-out 1 mm), tilt to 1 mm/m, and in one of three a slip to 60 µm with
/// a tilt.
Path any_axis(std::mt19937_64& random) {
  const double e = uniform(random, 0, 0.5), at = uniform(random, 0, turn);
  const double tx = uniform(random, -1e-3, 1e-3), ty = uniform(random, -1e-3, 1e-3);
  const bool slips = chance(random, 1.0 / 3.0);
  const double when = uniform(random, 0.15, 0.85), dx = uniform(random, -0.06, 0.06),
               dt = uniform(random, -3e-4, 3e-4);
  return [=](double z, double share) {
    const bool after = slips && share > when;
    return Offset{e * std::cos(at) + tx * z + (after ? dx + dt * z : 0.0),
                  e * std::sin(at) + ty * z};
  };
}

/// A smooth cone or cylinder with barrel, lobes, drift along Z, a keyway over part of its length.
Radius any_seat(std::mt19937_64& random, double length_mm) {
  const double taper = chance(random, 0.5) ? 0.0 : uniform(random, -0.14, 0.14);
  const double r0 =
      uniform(random, 8, 60) + std::max(0.0, -taper * length_mm);  // short of the apex
  const double barrel = uniform(random, -0.015, 0.015), drift = uniform(random, -0.02, 0.02);
  const double lobe = uniform(random, 0, 0.01), lobe_at = uniform(random, 0, turn);
  const int lobes = static_cast<int>(uniform(random, 2, 9));
  const bool keyed = chance(random, 0.25);
  const double key_from = uniform(random, 0, 0.6) * length_mm, key_at = uniform(random, 0, 6.0);
  return [=](double z, double c) {
    const double u = 2 * z / length_mm - 1;
    double r = r0 + taper * z + barrel * (1 - u * u) + drift * (1 - std::exp(-1.5 * (u + 1)));
    r += lobe * std::cos(lobes * c + lobe_at);
    const double turned = c - turn * std::floor(c / turn);
    if (keyed && z > key_from && turned > key_at && turned < key_at + 0.25) r -= 3.0;
    return r;
  };
}

void add_spikes(ProbeStream& stream, std::mt19937_64& random) {
  if (!chance(random, 0.3)) return;
  for (double& reading : stream.reading_mm)
    if (chance(random, 0.01)) reading += uniform(random, -0.3, 0.3);
}

/// Upper end of the Clopper-Pearson interval (95 %, one side).
double at_most(int seen, int of) {
  return boost::math::quantile(boost::math::beta_distribution<>(seen + 1.0, of - seen), 0.95);
}

TEST(Seats, ASmoothSeatIsNotTakenApart) {
  constexpr int streams = 2000;
  int split = 0;
  for (int i = 0; i < streams; ++i) {
    std::mt19937_64 random(7000 + i);
    const Probing how = any_probing(random);
    ProbeStream stream = probed(how, any_seat(random, how.length_mm), any_axis(random), random);
    add_spikes(stream, random);
    const Seats found = find_seats(stream);
    if (found.breaks.empty()) continue;
    ++split;
    ADD_FAILURE() << "seed " << 7000 + i << ", break at Z " << found.breaks.front().z_mm
                  << ", step " << found.breaks.front().step_mm << ", slope "
                  << found.breaks.front().slope_change << ", sections " << how.sections;
  }
  std::printf("taken apart: %d of %d, below %.2f %% (95 %%, one side)\n", split, streams,
              100 * at_most(split, streams));
}

TEST(Seats, AFaceOfAPlaneIsNotTakenApart) {
  std::mt19937_64 random(3);
  ProbeStream stream = probed(
      {}, [](double, double) { return 20.0; },
      [](double, double) {
        return Offset{0, 0};
      },
      random);
  stream.kind = StreamKind::face;
  EXPECT_TRUE(find_seats(stream).seats.empty());
}

// What the lines of the turns on both sides leave of a step: a slip's second order (dx e / R), the
// turn that it falls into, noise.
constexpr double line_of_turns_mm = 0.03;

TEST(Seats, TwoDiametersAreFoundWithTheirEnds) {
  constexpr int streams = 300;
  int missed = 0;
  for (int i = 0; i < streams; ++i) {
    std::mt19937_64 random(100 + i);
    Probing how = any_probing(random);
    if (how.sections > 0) how.sections += 4;
    const double at = how.length_mm * uniform(random, 0.3, 0.7), r0 = uniform(random, 15, 40);
    // From 0.1 to 5 mm, up or down.
    const double step = (chance(random, 0.5) ? 1 : -1) * std::exp(uniform(random, -2.3, 1.6));
    const double lobe = uniform(random, 0, 0.005);
    ProbeStream stream = probed(
        how,
        [&](double z, double c) { return r0 + (z > at ? step : 0.0) + lobe * std::cos(3 * c); },
        any_axis(random), random);
    add_spikes(stream, random);
    const Seats found = find_seats(stream);
    std::size_t strange = 0, lost = 0;
    for (const double z : stream.position_mm) {
      const auto in = [&](std::size_t seat) {
        return found.seats.size() > seat && found.seats[seat].z.holds(z);
      };
      strange += in(z <= at ? 1 : 0) ? 1 : 0;
      lost += !in(0) && !in(1) ? 1 : 0;
    }
    // Two of a row of three that is off, there and back; and two turns on both sides.
    const bool exact = found.seats.size() == 2 && found.breaks.size() == 1 &&
                       found.breaks[0].kind == SeatBreak::Kind::step &&
                       std::abs(found.breaks[0].step_mm - step) < line_of_turns_mm &&
                       strange <= 8 && lost <= 8u * static_cast<unsigned>(how.per_turn);
    missed += exact ? 0 : 1;
  }
  std::printf("not found as two, with step and ends: %d of %d, below %.1f %%\n", missed, streams,
              100 * at_most(missed, streams));
  // With few turns, and a slip in one of them: at most 1 in 100 (the binomial's 99 % of 300).
  EXPECT_LE(missed, 8);
}

/// The seats of a part that runs 1 mm out.
Seats seats_of(const Probing& how, const Radius& radius) {
  std::mt19937_64 random(5);
  return find_seats(probed(
      how, radius,
      [](double z, double) {
        return Offset{0.5 + 2e-4 * z, -1e-4 * z};
      },
      random));
}

TEST(Seats, ACylinderThenACone) {
  for (const double taper : {0.02, -0.1, 7.0 / 48}) {
    const Seats found =
        seats_of({}, [&](double z, double) { return 20 + taper * std::max(0.0, z - 22); });
    ASSERT_EQ(found.seats.size(), 2u) << taper;
    EXPECT_EQ(found.breaks[0].kind, SeatBreak::Kind::slope);
    // Lines of 40 turns of 0.2 µm each: far below; a turn is 0.5 mm long.
    EXPECT_NEAR(found.breaks[0].z_mm, 22, 0.5);
    EXPECT_NEAR(found.breaks[0].slope_change, taper, 0.05 * std::abs(taper));
  }
}

TEST(Seats, AGrooveOrAGapBetweenTwoSeatsOfOneDiameter) {
  const Seats groove =
      seats_of({}, [](double z, double) { return z > 18 && z < 21 ? 19.5 : 20.0; });
  ASSERT_EQ(groove.seats.size(), 2u);
  EXPECT_NEAR(groove.seats[0].z.to_mm, 18, 0.6);
  EXPECT_NEAR(groove.seats[1].z.from_mm, 21, 0.6);
  EXPECT_NEAR(groove.breaks[0].step_mm, -0.5, 0.01);

  std::mt19937_64 random(6);
  const ProbeStream whole = probed(
      {}, [](double, double) { return 20.0; },
      [](double, double) {
        return Offset{0.1, 0};
      },
      random);
  ProbeStream lifted = within(whole, {-1, 15});
  const ProbeStream second = within(whole, {28, 41});
  for (std::size_t i = 0; i < second.size(); ++i) {
    lifted.reading_mm.push_back(second.reading_mm[i]);
    lifted.c_rad.push_back(second.c_rad[i]);
    lifted.position_mm.push_back(second.position_mm[i]);
  }
  const Seats gap = find_seats(lifted);
  ASSERT_EQ(gap.seats.size(), 2u);
  EXPECT_EQ(gap.breaks[0].kind, SeatBreak::Kind::gap);
  EXPECT_FALSE(gap.broken());
}

// A ball of 1 mm rolls off the edge of a groove at Z 18 and 22: its centre is there, and it is
// lower by 1 − √(1 − d²) at d beyond. What is off by more than 3 σ is not of the seat, but for a
// reading or three that noise brings back: to 6 σ there are five.
TEST(Seats, TheBallIsClearOfTheEdges) {
  constexpr double noise_mm = 0.001;
  const auto radius = [](double z, double) {
    const double beyond = std::min(z - 18.0, 22.0 - z);
    return 20.0 - (beyond <= 0.0   ? 0.0
                   : beyond >= 0.8 ? 0.4
                                   : 1.0 - std::sqrt(1.0 - beyond * beyond));
  };
  const Seats found = seats_of({.noise_mm = noise_mm}, radius);
  ASSERT_EQ(found.seats.size(), 2u);
  const double off_3_sigma_mm = std::sqrt(2.0 * 3.0 * noise_mm), between_mm = 0.5 / 72.0;
  EXPECT_LT(found.seats[0].z.to_mm, 18.0 + off_3_sigma_mm + 4.0 * between_mm);
  EXPECT_GT(found.seats[1].z.from_mm, 22.0 - off_3_sigma_mm - 4.0 * between_mm);
  EXPECT_NEAR(found.seats[0].z.to_mm, 18.0, 0.5);  // a turn
  EXPECT_NEAR(found.seats[1].z.from_mm, 22.0, 0.5);
}

/// What is probed from `first_mm` on, after what is there.
void then(ProbeStream& stream, const Probing& how, double radius_mm, double taper,
          double first_mm) {
  std::mt19937_64 random(11);
  const ProbeStream next = probed(
      how, [&](double z, double) { return radius_mm + taper * z; },
      [](double z, double) {
        return Offset{0.03 + 1e-4 * z, 0.01};
      },
      random);
  const double c0 = stream.size() == 0 ? 0.0 : turn * std::ceil(stream.c_rad.back() / turn + 1);
  for (std::size_t i = 0; i < next.size(); ++i) {
    stream.reading_mm.push_back(next.reading_mm[i]);
    stream.c_rad.push_back(c0 + next.c_rad[i]);
    stream.position_mm.push_back(first_mm + next.position_mm[i]);
  }
}

// Each seat has a feed of its own: the coarser to four times the finer, in either order, with a
// pass of its own or without. No seat may be lost; a turn may be at each end.
TEST(Seats, EachSeatHasAFeedOfItsOwn) {
  for (const double ratio : {1.6, 2.0, 4.0})
    for (const bool coarse_first : {true, false})
      for (const bool passes : {true, false}) {
        SCOPED_TRACE(::testing::Message() << ratio << ' ' << coarse_first << ' ' << passes);
        const double feed[] = {coarse_first ? 0.6 * ratio : 0.6, coarse_first ? 0.6 : 0.6 * ratio};
        ProbeStream stream;
        then(stream, {.length_mm = 25, .feed_mm = feed[0], .per_turn = 37}, 20, 0, 10);
        stream.pass.assign(stream.size(), 1);
        then(stream, {.length_mm = 25, .feed_mm = feed[1], .per_turn = 37}, 25, 0, 90);
        stream.pass.resize(stream.size(), 2);
        if (!passes) stream.pass.clear();
        const Seats found = find_seats(stream);
        ASSERT_EQ(found.seats.size(), 2u);
        EXPECT_TRUE(found.left_out.empty());
        for (const std::size_t i : {0u, 1u}) {
          EXPECT_LE(found.seats[i].z.from_mm, (i == 0 ? 10 : 90) + feed[i]);
          EXPECT_GE(found.seats[i].z.to_mm, (i == 0 ? 35 : 115) - feed[i]);
        }
      }
}

// The line of the cone meets the cylinder just before the cone's last section, which is of the
// cone.
TEST(Seats, TwoSectionsEachKeepBoth) {
  const Probing sections{.length_mm = 12.8129, .sections = 2};
  for (const double taper : {0.27, -0.27}) {
    ProbeStream stream;
    then(stream, sections, 20, 0, 20);
    then(stream, sections, 22, taper, 55);
    then(stream, sections, 22 + taper * 12.7, 0, 90);
    const Seats found = find_seats(stream);
    ASSERT_EQ(found.seats.size(), 3u);
    for (const Seat& seat : found.seats)
      EXPECT_EQ(seat.readings, 2u * static_cast<unsigned>(sections.per_turn));
    EXPECT_TRUE(found.left_out.empty());
  }
}

// The spindle does not turn at the first seat, which has no radius then.
TEST(Seats, WhatIsOfNoSeatIsCounted) {
  ProbeStream stream;
  then(stream, {.length_mm = 25}, 20, 0, 10);
  const std::size_t first = stream.size();
  for (double& c : stream.c_rad) c *= 1e-4;
  then(stream, {.length_mm = 25}, 22, 0, 50);
  then(stream, {.length_mm = 25}, 25, 0, 90);
  const Seats found = find_seats(stream);
  ASSERT_EQ(found.seats.size(), 2u);
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_EQ(found.left_out[0].readings, first);
  EXPECT_EQ(found.left_out[0].z.from_mm, 10);
  EXPECT_EQ(found.left_out[0].z.to_mm, 35);
}

// Of 2.4 turns one is left between its edges, which tells nothing: it was a cone, on which the part
// slipped.
TEST(Seats, ABandOfTwoTurnsIsNoSeat) {
  const Probing how{.feed_mm = 40.0 / 31, .per_turn = 24};
  const Seats found =
      seats_of(how, [](double z, double) { return std::abs(z - 20) < 1.55 ? 20.02 : 20.0; });
  EXPECT_NE(found.seats.size(), 1u);
  for (const Seat& seat : found.seats) EXPECT_GT(seat.z.to_mm - seat.z.from_mm, 2.0 * how.feed_mm);
}

TEST(Seats, AChamferAtTheEndIsNoSeat) {
  const Seats found = seats_of({}, [](double z, double) { return 20 - std::max(0.0, z - 38); });
  ASSERT_EQ(found.seats.size(), 1u);
  EXPECT_NEAR(found.seats[0].z.to_mm, 38, 0.5);
  EXPECT_TRUE(found.broken());
}

TEST(Seats, WithinKeepsAndCountsTheReadings) {
  std::mt19937_64 random(6);
  const ProbeStream whole = probed(
      {}, [](double, double) { return 20.0; },
      [](double, double) {
        return Offset{0, 0};
      },
      random);
  const ProbeStream part = within(whole, {10.0, 20.0});
  std::size_t inside = 0;
  for (const double z : whole.position_mm) inside += z >= 10 && z <= 20 ? 1 : 0;
  EXPECT_EQ(part.size(), inside);
  EXPECT_EQ(part.c_rad.size(), inside);
  ASSERT_EQ(part.read_as.size(), 1u);
  EXPECT_NE(part.read_as[0].find(std::to_string(whole.size() - inside) + " of "),
            std::string::npos);
  EXPECT_THROW(within(whole, {50.0, 60.0}), InputError);
}

}  // namespace
}  // namespace trueaxis
