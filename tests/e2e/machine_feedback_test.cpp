// SPDX-License-Identifier: Apache-2.0
// From part to part: `run --previous` corrects the next table for what the verification of the
// parts before showed of the machine. The lathe of the test is integrated in time; every part has
// its own clamping and lobes.
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "support/command_fixture.hpp"
#include "support/shop_lathe.hpp"

namespace trueaxis::testing {
namespace {

constexpr double z_low = 42.0, z_high = 60.0, cut_radius_mm = 28.0;

ShopLathe::Part drawn_part(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  ShopLathe::Part part;
  part.place_mm = std::polar(between(0.1, 0.2), between(0.0, 2.0 * std::numbers::pi));
  part.slope = std::polar(between(1e-4, 5e-4), between(0.0, 2.0 * std::numbers::pi));
  part.lobes_mm = between(1e-3, 3e-3), part.lobes_phase_rad = between(0.0, 2.0 * std::numbers::pi);
  return part;
}

class MachineFeedback : public CommandTest {
 protected:
  std::string job(int k, bool verified, const std::string& more = "") const {
    const std::string n = std::to_string(k);
    return "[header]\nmachine = \"lathe 7\"\npart = \"" + n +
           "\"\n[[reference]]\nname = \"seat\"\nstream = \"part_" + n +
           ".csv\"\nsurface = \"cylinder\"\n[target]\nsurface = \"cylinder\"\nradius_mm = 28\n"
           "z_start_mm = 60\nz_end_mm = 42\ncoaxiality_tolerance_um = 100\n[cut]\nspeed_rpm = 600\n"
           "sense = \"+c\"\nfeed_mm_per_rev = 0.5\ninterpolation = \"linear\"\n" +
           (verified ? "[verification]\nstream = \"cut_" + n + ".csv\"\ntable = \"part_" + n +
                           "/table.csv\"\n"
                     : "") +
           more;
  }
  static std::string previous(int k) {
    return k == 0 ? "" : " --previous cut_" + std::to_string(k) + "/result.json";
  }
  /// The part is probed, and its table made with what the parts before told.
  CommandStreams plan(int k, const ShopLathe& lathe, const ShopLathe::Part& part,
                      const std::string& arguments) {
    const std::string n = std::to_string(k);
    file("part_" + n + ".csv", lathe.probed_part(part, 0.0, 40.0, 2 * k));
    file("part_" + n + ".toml", job(k, false));
    return command("run part_" + n + ".toml -o part_" + n + arguments);
  }
  /// The finished cut, measured elsewhere, with what a chuck leaves.
  void measure(int k, const ShopLathe::Cut& cut) {
    const std::string n = std::to_string(k);
    file("form_" + n + ".csv", ShopLathe::measured_form(cut, 1e-3, own_lobes_mm, 1000 + k));
    std::string text = job(k, true);
    text.replace(text.find("[verification]\n"), 15,
                 "[verification]\nform = \"form_" + n + ".csv\"\n");
    file("cut_" + n + ".toml", text);
  }
  static constexpr double own_lobes_mm = 1e-4;
  /// It is cut with the table and probed again.
  ShopLathe::Cut cut(int k, const ShopLathe& lathe) {
    const std::string n = std::to_string(k);
    ShopLathe::Cut out =
        lathe.turned(read_text(folder_ / ("part_" + n + "/table.csv")), cut_radius_mm);
    file("cut_" + n + ".csv", lathe.probed_cut(out, 43.0, 59.0, cut_radius_mm, 2 * k + 1));
    file("cut_" + n + ".toml", job(k, true));
    return out;
  }
  CommandStreams verify(int k, const std::string& arguments) {
    const std::string n = std::to_string(k);
    return command("run cut_" + n + ".toml -o cut_" + n + arguments);
  }
  /// The first `parts` of a shop, each learned from.
  void make(int parts, const ShopLathe& lathe, std::mt19937_64& random) {
    for (int k = 1; k <= parts; ++k) {
      const CommandStreams planned = plan(k, lathe, drawn_part(random), previous(k - 1));
      ASSERT_EQ(planned.exit_code, 0) << planned.out << planned.err;
      cut(k, lathe);
      const CommandStreams verified = verify(k, previous(k - 1));
      ASSERT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    }
  }
};

// The lathe is more than 5 % off, of an eccentricity of at least 0.1 mm: more than 10 µm, a
// diameter, at U of some 0.1 µm. A script that acts on the exit code must not take this part.
TEST_F(MachineFeedback, ACutBeyondItsToleranceIsNotMet) {
  std::mt19937_64 random(11);
  const ShopLathe lathe;
  ASSERT_EQ(plan(1, lathe, drawn_part(random), "").exit_code, 0);
  cut(1, lathe);
  EXPECT_EQ(verify(1, "").out.find("NOT MET"), std::string::npos) << "of 100 µm";
  std::string narrow = job(1, true);
  narrow.replace(narrow.find("tolerance_um = 100"), 18, "tolerance_um = 8");
  file("cut_1.toml", narrow);
  const CommandStreams verified = verify(1, "");
  EXPECT_EQ(verified.exit_code, 1) << verified.out << verified.err;
  EXPECT_NE(verified.out.find("cut    NOT MET, coaxiality at least "), std::string::npos)
      << verified.out;
}

/// The axis of the cut over that of the part, at the middle of the cut: 1 is a true one.
std::complex<double> ratio(const ShopLathe::Cut& cut, const ShopLathe::Part& part) {
  const double z = 0.5 * (z_low + z_high);
  return cut.axis_at(z) / part.axis_at(z);
}

/// u of the ratio because of the noise of the reference's readings alone. Its axis has N readings
/// over 40 mm, and the cut is 31 mm from their middle.
double u_of_ratio(const ShopLathe& lathe, const ShopLathe::Part& part) {
  const double readings = 41.3 * 36.7, lever = 31.0 / (40.0 / std::sqrt(12.0));
  return lathe.noise_mm * std::sqrt(2.0 / readings) * std::hypot(1.0, lever) /
         std::abs(part.axis_at(0.5 * (z_low + z_high)));
}

TEST_F(MachineFeedback, OfTwentyPartsTheErrorThatStaysFallsBelowAThirdAndDoesNotOscillate) {
  constexpr int parts = 20;
  std::printf("seed 11\n");
  std::mt19937_64 random(11);
  const ShopLathe lathe;
  std::complex<double> first;
  double u_first = 0.0;
  for (int k = 1; k <= parts; ++k) {
    SCOPED_TRACE("part " + std::to_string(k));
    const ShopLathe::Part part = drawn_part(random);
    const CommandStreams planned = plan(k, lathe, part, previous(k - 1));
    ASSERT_EQ(planned.exit_code, 0) << planned.out << planned.err;
    const std::complex<double> off = std::log(ratio(cut(k, lathe), part));
    const double u = u_of_ratio(lathe, part);
    if (k == 1) first = off, u_first = u;
    const CommandStreams verified = verify(k, previous(k - 1));
    ASSERT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    if (k == 1) {
      EXPECT_GT(std::abs(first), 0.05) << "the machine was hardly off: the test tests nothing";
      continue;
    }
    // Four standard deviations of both parts' axes: missed by 19 parts in 1 of 800 seeds.
    const double noise = 4.0 * std::hypot(u, u_first);
    if (k > 3) {
      EXPECT_LT(std::abs(off), std::abs(first) / 3.0);
    }
    EXPECT_LT(std::abs(off), noise);
    // No overshoot: along the first error nothing of the other sign but noise.
    EXPECT_GT((off / first).real() * std::abs(first), -noise);
    // What came with the parts before (clamping, lobes of three) is in neither number of the
    // machine nor in the table.
    const auto got = result("cut_" + std::to_string(k) + "/result.json");
    const auto& learned = got.at("feedback").at("learned");
    EXPECT_EQ(learned.at("parts"), k);
    EXPECT_NEAR(learned.at("gain").at("value").get<double>(), first.real(), 4.0 * u_first);
    EXPECT_NEAR(learned.at("lag").at("value").get<double>() * std::numbers::pi / 180.0,
                first.imag(), 4.0 * u_first);
    const std::string table = read_text(folder_ / ("part_" + std::to_string(k) + "/table.csv"));
    EXPECT_TRUE(table.starts_with("# schema: trueaxis.correction/1\n"));
    EXPECT_TRUE(contains(table, "# machine_loop: the table is corrected for gain"));
    for (const auto& harmonic : got.at("correction").at("harmonics"))
      EXPECT_NE(harmonic.at("order"), 3) << harmonic;
  }
}

// The spindle moves the part three times per revolution by 2 µm, against tool and probe alike: the
// cut as it is probed again is round, and the form tester shows it. Every part has lobes of its
// own, two of 1 µm and three of 0.1 µm, which are not followed.
TEST_F(MachineFeedback, FollowsAMotionOfTheSpindleThatTheFormOfThePartsShows) {
  constexpr int parts = 12;
  std::printf("seed 11\n");
  std::mt19937_64 random(11);
  ShopLathe lathe;
  lathe.motion_mm = 2e-3, lathe.motion_phase_rad = 0.8;
  const double middle = 0.5 * (z_low + z_high);
  std::complex<double> first;
  for (int k = 1; k <= parts; ++k) {
    SCOPED_TRACE("part " + std::to_string(k));
    const CommandStreams planned = plan(k, lathe, drawn_part(random), previous(k - 1));
    ASSERT_EQ(planned.exit_code, 0) << planned.out << planned.err;
    const ShopLathe::Cut done = cut(k, lathe);
    measure(k, done);
    const CommandStreams verified = verify(k, previous(k - 1));
    ASSERT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    const std::complex<double> left = done.order_at(3, middle);
    if (k == 1) {
      first = left;
      EXPECT_NEAR(std::abs(first), lathe.motion_mm, 0.02 * lathe.motion_mm);
    }
    // One part does not tell its own form from a motion.
    if (k == 2) {
      EXPECT_NEAR(std::abs(left - first), 0.0, 0.02 * lathe.motion_mm);
    }
    if (k > 3) {
      EXPECT_LT(std::abs(left), std::abs(first) / 3.0);
      // No overshoot but for the mean of the parts' own lobes, a tenth of a micrometre each.
      EXPECT_GT((left / first).real() * std::abs(first),
                -4.0 * own_lobes_mm / std::sqrt(2.0 * (k - 1)));
    }
    if (k > 10) {
      EXPECT_LT(std::abs(left), std::abs(first) / 8.0);
    }
    const auto learned =
        result("cut_" + std::to_string(k) + "/result.json").at("feedback").at("learned");
    const auto motion = learned.value("motion", nlohmann::json::array());
    EXPECT_EQ(motion.empty(), k < 2) << k;
    for (const auto& one : motion) EXPECT_EQ(one.at("order"), 3) << one;
  }
}

TEST_F(MachineFeedback, RefusesAMotionOfTheWrongSignAndOneThatChangedByName) {
  std::mt19937_64 random(13);
  ShopLathe lathe;
  lathe.motion_mm = 2e-3;
  for (int k = 1; k <= 3; ++k) {
    ASSERT_EQ(plan(k, lathe, drawn_part(random), previous(k - 1)).exit_code, 0);
    measure(k, cut(k, lathe));
    const CommandStreams verified = verify(k, previous(k - 1));
    ASSERT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  }
  ASSERT_EQ(plan(4, lathe, drawn_part(random), previous(3)).exit_code, 0);
  const auto expect = [&](const ShopLathe::Cut& measured, const std::string& why) {
    measure(4, measured);
    const CommandStreams verified = verify(4, previous(3));
    EXPECT_EQ(verified.exit_code, 3) << verified.out;
    EXPECT_TRUE(contains(verified.err, why)) << verified.err;
  };
  // As if the servo went the other way at three per revolution: the form is twice the motion.
  ShopLathe::Cut wrong = cut(4, lathe);
  const ShopLathe::Cut right = wrong;
  for (std::size_t i = 0; i < wrong.radius_mm.size(); ++i)
    wrong.radius_mm[i] -= 2.0 * lathe.motion_at(2.0 * std::numbers::pi * static_cast<double>(i) /
                                                static_cast<double>(wrong.rows));
  expect(wrong, "shows the wrong sign");
  for (std::size_t i = 0; i < wrong.radius_mm.size(); ++i)
    wrong.radius_mm[i] =
        right.radius_mm[i] + 8e-3 * std::sin(6.0 * std::numbers::pi * static_cast<double>(i) /
                                             static_cast<double>(wrong.rows));
  expect(wrong, "shows that the machine changed since cut_3/result.json");
  measure(4, right);
  EXPECT_EQ(verify(4, previous(3)).exit_code, 0);
}

/// Every refusal has the place, and what mends it.
TEST_F(MachineFeedback, RefusesAResultThatIsNotOfThePartBeforeOnThisMachine) {
  std::mt19937_64 random(5);
  const ShopLathe lathe;
  make(1, lathe, random);
  file("part_2.csv", lathe.probed_part(drawn_part(random), 0.0, 40.0, 4));
  const auto expect = [&](const std::string& text, const std::string& previous_result,
                          const std::string& why) {
    SCOPED_TRACE(why);
    file("part_2.toml", text);
    const CommandStreams done = command("run part_2.toml -o out --previous " + previous_result);
    EXPECT_EQ(done.exit_code, 3) << done.out;
    EXPECT_TRUE(contains(done.err, why)) << done.err;
    EXPECT_FALSE(there("out"));
  };
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = job(2, false);
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, before.size(), after);
  };
  const std::string last = "cut_1/result.json", plain = job(2, false);
  expect(plain, "part_1/result.json", "add [verification] to its job");
  expect(plain, "part_2.csv", "is not a result of `trueaxis run`");
  expect(with("lathe 7", "lathe 8"), last, "machine is \"lathe 8\", and \"lathe 7\" in cut_1");
  expect(with("machine = \"lathe 7\"\n", ""), last, "add machine to [header]");
  expect(with("\"+c\"", "\"-c\""), last, "sense is \"-c\", and \"+c\"");
  expect(with("speed_rpm = 600", "speed_rpm = 500"), last, "speed_rpm is 500.0, and 600.0");
  expect(job(2, false, "[actuator]\nnatural_frequency_hz = 500\n"), last, "actuator is {");
  expect(job(2, false, "[sensor]\nlag_ms = 2\nu_lag_ms = 0.1\n"), last, "known is [[");
  expect(with("surface = \"cylinder\"\nradius",
              "surface = \"cone\"\nhalf_angle_deg = 1\nopens = \"+z\"\nradius"),
         last, "target is \"cone, shaft\", and \"cylinder, shaft\"");
  expect(with("part_2.csv", "part_1.csv"), last, "a part does not come before itself");
  expect(with("part_2.csv", "cut_1.csv"), last, "a part does not come before itself");
  std::string changed = read_text(folder_ / last);
  const std::size_t at = changed.find("\"per_mm\"");
  changed[changed.find('.', at) - 1] ^= 1;
  file("changed.json", changed);
  expect(plain, "changed.json", "was changed after TrueAxis wrote it");
  file("part_2.toml", plain);
  ASSERT_EQ(command("run part_2.toml -o part_2 --previous " + last).exit_code, 0);
  file("part_3.csv", lathe.probed_part(drawn_part(random), 0.0, 40.0, 6));
  file("part_3.toml", job(3, false));
  const CommandStreams not_verified =
      command("run part_3.toml -o part_3 --previous part_2/result.json");
  EXPECT_EQ(not_verified.exit_code, 3);
  EXPECT_TRUE(contains(not_verified.err, "was not probed again after its cut")) << not_verified.err;
}

TEST_F(MachineFeedback, RefusesAVerificationThatIsNotOfThisCut) {
  std::mt19937_64 random(6);
  ShopLathe lathe;
  make(1, lathe, random);
  ASSERT_EQ(plan(2, lathe, drawn_part(random), previous(1)).exit_code, 0);
  const ShopLathe::Cut done = cut(2, lathe);
  const auto expect = [&](const std::string& arguments, const std::string& why) {
    SCOPED_TRACE(why);
    const CommandStreams verified = verify(2, arguments);
    EXPECT_EQ(verified.exit_code, 3) << verified.out;
    EXPECT_TRUE(contains(verified.err, why)) << verified.err;
    EXPECT_FALSE(there("cut_2/result.json"));
  };
  expect("", "part_2/table.csv: is not the table that this job makes");  // without --previous
  const std::string readings = read_text(folder_ / "cut_2.csv");
  file("cut_2.csv", read_text(folder_ / "part_2.csv"));
  expect(previous(1), "has the readings of a reference or of an earlier cut");
  lathe.probing_rpm = 200.0;
  file("cut_2.csv", lathe.probed_cut(done, 43.0, 59.0, cut_radius_mm, 5));
  expect(previous(1), "was probed at 200 rpm, and the references at 120 rpm");
  file("cut_2.csv", readings);
  EXPECT_EQ(verify(2, previous(1)).exit_code, 0);
}

TEST_F(MachineFeedback, RefusesAWrongSignByName) {
  std::mt19937_64 random(7);
  const ShopLathe lathe;
  make(1, lathe, random);
  const ShopLathe::Part part = drawn_part(random);
  ASSERT_EQ(plan(2, lathe, part, "").exit_code, 0);
  const ShopLathe::Cut without = cut(2, lathe);
  ASSERT_EQ(plan(2, lathe, part, previous(1)).exit_code, 0);
  ShopLathe::Cut wrong = cut(2, lathe);
  // The correction has the other sign.
  for (std::size_t i = 0; i < wrong.radius_mm.size(); ++i)
    wrong.radius_mm[i] = 2.0 * without.radius_mm[i] - wrong.radius_mm[i];
  file("cut_2.csv", lathe.probed_cut(wrong, 43.0, 59.0, cut_radius_mm, 5));
  const CommandStreams verified = verify(2, previous(1));
  EXPECT_EQ(verified.exit_code, 3) << verified.out;
  EXPECT_TRUE(contains(verified.err, "cut_2.csv: shows the wrong sign")) << verified.err;
  EXPECT_TRUE(contains(verified.err, "start anew without --previous")) << verified.err;
}

TEST_F(MachineFeedback, RefusesAMachineThatChangedAndAnInvertedServoByName) {
  std::mt19937_64 random(8);
  ShopLathe lathe;
  make(3, lathe, random);  // they tell how far its cuts scatter
  ASSERT_EQ(plan(4, lathe, drawn_part(random), previous(3)).exit_code, 0);
  lathe.servo_lag_s = 2e-3;
  cut(4, lathe);
  const CommandStreams changed = verify(4, previous(3));
  EXPECT_EQ(changed.exit_code, 3) << changed.out;
  EXPECT_TRUE(contains(changed.err, "shows that the machine changed since cut_3/result.json"))
      << changed.err;
  lathe.servo_gain = -1.0;
  cut(4, lathe);
  const CommandStreams inverted = verify(4, previous(3));
  EXPECT_EQ(inverted.exit_code, 3) << inverted.out;
  EXPECT_TRUE(contains(inverted.err, "The servo or the probe is inverted")) << inverted.err;
}

}  // namespace
}  // namespace trueaxis::testing
