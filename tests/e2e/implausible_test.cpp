// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>
#include <random>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/own_probe.hpp"

/// Streams that are not a probe's readings of one part, or not all of them: each is refused with
/// its reason, or its axis is right within its U. Parts and probe are those of own_probe.hpp.
namespace trueaxis::testing {
namespace {

using own_probe::contact_mm;
using own_probe::helix;
using own_probe::Part;
using own_probe::Stream;

/// x, y and U of the axis at two places of Z, µm, as the screen has them.
struct AxisLine {
  double x = 0.0, y = 0.0, U = 0.0, z = 0.0;
};

std::vector<AxisLine> axis_of(const std::string& screen) {
  std::vector<AxisLine> out;
  std::istringstream lines(screen);
  for (std::string line; std::getline(lines, line);) {
    AxisLine one;
    const std::size_t at = line.find("x ");
    if (at != 7 || (line.substr(0, 4) != "axis" && out.empty())) continue;
    if (std::sscanf(line.c_str() + at, "x %lf µm, y %lf µm, U %lf µm at Z %lf", &one.x, &one.y,
                    &one.U, &one.z) == 4)
      out.push_back(one);
  }
  return out;
}

class Implausible : public CommandTest {
 protected:
  CommandStreams run(const Stream& stream) {
    file("part.csv", stream.text());
    return command("run part.csv -o out --force");
  }

  void expect_refused(const Stream& stream, const std::string& why) {
    const CommandStreams done = run(stream);
    EXPECT_NE(done.exit_code, 0) << done.out;
    EXPECT_TRUE(contains(done.out + done.err, why)) << done.out << done.err;
    EXPECT_TRUE(axis_of(done.out).empty()) << done.out;
    EXPECT_FALSE(contains(done.out, "\ntap ")) << done.out;
  }

  /// The same of a stream in which two seats are found, each with its own axis.
  void expect_seats_right(const Stream& stream, const Part& first, const Part& second) {
    const CommandStreams done = run(stream);
    const std::vector<AxisLine> axis = axis_of(done.out);
    ASSERT_EQ(axis.size(), 4U) << done.out << done.err;
    for (std::size_t i = 0; i < axis.size(); ++i) expect_near(axis[i], i < 2 ? first : second);
  }

  /// 1.5 U at both ends: 3 u, which one of 370 is beyond.
  void expect_right(const Stream& stream, const Part& truth) {
    const CommandStreams done = run(stream);
    const std::vector<AxisLine> axis = axis_of(done.out);
    ASSERT_EQ(axis.size(), 2U) << done.out << done.err;
    for (const AxisLine& at : axis) expect_near(at, truth);
  }

  static void expect_near(const AxisLine& at, const Part& truth) {
    EXPECT_NEAR(at.x, 1e3 * (truth.x_mm + truth.slope_x * at.z), 1.5 * at.U) << at.z;
    EXPECT_NEAR(at.y, 1e3 * (truth.y_mm + truth.slope_y * at.z), 1.5 * at.U) << at.z;
  }
};

const Part cone{.taper = 0.1};

TEST_F(Implausible, AnOrdinaryPartIsMeasured) {
  expect_right(helix({}), {});
  expect_right(helix(cone), cone);
  const Part far_off{.x_mm = 1.0, .y_mm = -0.4, .radius_mm = 12.0};
  expect_right(helix(far_off), far_off);
}

TEST_F(Implausible, XAndZAreExchanged) {
  for (const Part& part : {Part{}, cone}) {
    Stream stream = helix(part);
    std::swap(stream.x_mm, stream.z_mm);
    expect_refused(stream, "X_M and Z are exchanged");
  }
}

TEST_F(Implausible, CAndZAreExchanged) {
  Stream stream = helix(cone);
  std::swap(stream.c_deg, stream.z_mm);
  expect_refused(stream, "C and Z are exchanged");
}

TEST_F(Implausible, RandomNumbers) {
  Stream stream = helix({});
  std::mt19937_64 engine(7);
  for (double& x : stream.x_mm) x = std::uniform_real_distribution(5.0, 25.0)(engine);
  expect_refused(stream, "No turned part and probe leave more than");
}

TEST_F(Implausible, ReadingsThatScatterLikeNoProbe) {
  expect_refused(helix({}, 10.0, 50.0, 300.0), "single readings scatter by 0.3 mm");
  // A user whose sensor is like that says so, and gets an honest U.
  Stream stream = helix({}, 10.0, 50.0, 300.0);
  stream.header = "# sensor_noise: 0.3 mm\n" + stream.header;
  expect_right(stream, {});
}

TEST_F(Implausible, AProbeThatStandsStill) {
  for (const auto& [from, to] : {std::pair{0, 400}, {600, 900}, {1000, 1469}}) {
    Stream stream = helix({});
    for (int i = from; i < to; ++i)
      stream.x_mm[static_cast<std::size_t>(i)] = stream.x_mm[static_cast<std::size_t>(from)];
    expect_refused(stream, "the probe was stuck");
  }
  Stream still = helix({});
  std::ranges::fill(still.x_mm, 25.0);
  expect_refused(still, "the probe was stuck");
}

TEST_F(Implausible, DecimalPointsWereLost) {
  for (const auto column : {&Stream::x_mm, &Stream::c_deg, &Stream::z_mm}) {
    Stream stream = helix(cone);
    for (std::size_t i = 40; i < stream.size(); i += 97) (stream.*column)[i] *= 10.0;
    expect_refused(stream, "a decimal point was lost");
  }
}

TEST_F(Implausible, TwoPartsInTurn) {
  Stream stream = helix({});
  const Stream other = helix({.x_mm = -0.02, .y_mm = 0.1, .radius_mm = 24.9});
  for (std::size_t i = 0; i < stream.size(); i += 2) stream.x_mm[i] = other.x_mm[i];
  expect_refused(stream, "two recordings are interleaved");
}

TEST_F(Implausible, AnotherChannel) {
  Stream stream = helix({});
  for (std::size_t i = 0; i < stream.size(); ++i)
    stream.x_mm[i] = 25.0 + 0.5 * std::sin(0.37 * stream.c_deg[i] * std::numbers::pi / 180.0) +
                     1e-6 * static_cast<double>((7919 * i) % 4000);
  expect_refused(stream, "X_M is not from a probe");
}

// A coarse sensor on a part that runs true shows the same value for long, and is not a stuck one.
TEST_F(Implausible, ACoarseSensorIsNotStuck) {
  const Part nearly_true{.x_mm = 0.011, .y_mm = 0.004, .slope_x = 1e-5, .slope_y = 0.0};
  Stream stream = helix(nearly_true);
  for (double& x : stream.x_mm) x = 0.01 * std::round(100.0 * x);
  const CommandStreams done = run(stream);
  EXPECT_FALSE(contains(done.out, "stuck")) << done.out;
}

TEST_F(Implausible, CylinderFittedToACone) {
  file("part.csv", helix(cone).text());
  const CommandStreams done = command("fit part.csv --surface cylinder");
  EXPECT_NE(done.exit_code, 0);
  EXPECT_TRUE(contains(done.out, "use --surface cone")) << done.out;
}

TEST_F(Implausible, FitAloneRefusesColumnsInAnotherOrderAndASensorAtItsLimit) {
  Stream sorted = helix({}), c_shuffled = helix({}), z_shuffled = helix({}), scaled = helix({}),
         limited = helix({});
  std::ranges::sort(sorted.x_mm);
  std::ranges::shuffle(c_shuffled.c_deg, std::mt19937_64(1));
  std::ranges::shuffle(z_shuffled.z_mm, std::mt19937_64(2));
  for (double& c : scaled.c_deg) c *= 0.98;
  std::vector<double> ordered = limited.x_mm;
  std::ranges::sort(ordered);
  for (double& x : limited.x_mm) x = std::min(x, ordered[ordered.size() * 7 / 10]);
  const struct {
    const Stream& stream;
    const char* why;
  } cases[] = {{sorted, "X_M never turns back"},
               {c_shuffled, "C jumps at random"},
               {z_shuffled, "Z jumps at random"},
               {scaled, "C has another unit"},
               {limited, "the end of the sensor's range"}};
  for (const auto& [stream, why] : cases) {
    file("part.csv", stream.text());
    for (const char* line : {"fit part.csv --surface cylinder",
                             "fit part.csv --surface cylinder --criterion minimum_zone"}) {
      const CommandStreams done = command(line);
      EXPECT_NE(done.exit_code, 0) << why;
      EXPECT_TRUE(contains(done.out + done.err, why)) << done.out << done.err;
      EXPECT_TRUE(axis_of(done.out).empty()) << done.out;
    }
  }
}

TEST_F(Implausible, EveryCommandRefusesIt) {
  Stream stream = helix(cone);
  std::swap(stream.x_mm, stream.z_mm);
  file("part.csv", stream.text());
  for (const char* line : {"fit part.csv --surface cone", "diagnose part.csv --surface cone"}) {
    const CommandStreams done = command(line);
    EXPECT_NE(done.exit_code, 0) << line;
    EXPECT_TRUE(contains(done.out + done.err, "X_M and Z are exchanged")) << done.out << done.err;
    EXPECT_TRUE(axis_of(done.out).empty()) << done.out;
  }
  EXPECT_NE(command("form part.csv").exit_code, 0);
}

/// A part that is clamped anew after 800 readings.
Stream clamped_anew(const Part& before, const Part& after, std::uint64_t seed) {
  Stream stream = helix(before, 10.0, 50.0, 2.0, seed);
  const Stream later = helix(after, 10.0, 50.0, 2.0, seed + 100);
  std::copy(later.x_mm.begin() + 800, later.x_mm.end(), stream.x_mm.begin() + 800);
  return stream;
}

TEST_F(Implausible, ASlipTiltsThePartToo) {
  const Part after{.x_mm = 0.01, .y_mm = 0.05, .slope_x = 5e-4, .slope_y = 3e-4};
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U})
    expect_right(clamped_anew({}, after, seed), after);
}

TEST_F(Implausible, ASlipOfAnotherRadiusAndTaper) {
  const Part after{.x_mm = 0.01,
                   .y_mm = 0.05,
                   .slope_x = 5e-4,
                   .slope_y = 3e-4,
                   .radius_mm = 25.02,
                   .taper = 2e-4};
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U})
    expect_seats_right(clamped_anew({}, after, seed), {}, after);
}

// Two slips within a few revolutions leave where the part is now open: no axis is printed.
TEST_F(Implausible, AnAxisThatIsNotKnownIsNotPrinted) {
  const Part between{.x_mm = 0.01, .y_mm = 0.05}, after{.x_mm = -0.03, .y_mm = 0.02};
  Stream stream = clamped_anew({}, between, 5);
  const Stream later = helix(after, 10.0, 50.0, 2.0, 6);
  std::copy(later.x_mm.begin() + 1300, later.x_mm.end(), stream.x_mm.begin() + 1300);
  const CommandStreams done = run(stream);
  EXPECT_TRUE(contains(done.out, "slipped in the chuck")) << done.out;
  const std::vector<AxisLine> axis = axis_of(done.out);
  EXPECT_EQ(axis.empty(), done.exit_code != 0) << done.out;
  for (const AxisLine& at : axis) expect_near(at, after);
}

// What takes the axis from a file or the screen learns by the exit code that there is none.
TEST_F(Implausible, AnAxisThatIsNotKnownIsNoSuccess) {
  const Part after{.x_mm = 0.1, .y_mm = 0.05};
  file("part.csv", clamped_anew({}, after, 7).text());
  const CommandStreams fitted = command("fit part.csv --surface cylinder --json fit.json");
  EXPECT_EQ(fitted.exit_code, 1) << fitted.out;
  EXPECT_TRUE(contains(fitted.out, "axis   not known: ")) << fitted.out;
  EXPECT_EQ(fitted.err, "refused: part.csv: the axis is not known\n");
  EXPECT_TRUE(result("fit.json").at("axis").at("x").at("value").is_null());

  // Of four angles an eccentricity and three lobes are one column.
  Stream four = helix({});
  for (std::size_t i = 0; i < four.size(); ++i) {
    const double before = four.c_deg[i] / 180.0 * std::numbers::pi, z = four.z_mm[i];
    const double quarters = static_cast<double>(i);
    four.x_mm[i] +=
        contact_mm({}, 0.5 * std::numbers::pi * quarters, z) - contact_mm({}, before, z);
    four.c_deg[i] = 90.0 * quarters;
  }
  file("four.csv", four.text());
  for (const char* const line : {"diagnose four.csv --surface cylinder", "run four.csv -o four"}) {
    const CommandStreams done = command(line);
    EXPECT_EQ(done.exit_code, 1) << line << done.out;
    EXPECT_TRUE(axis_of(done.out).empty()) << done.out;
  }
}

// RONt of 5 µm of three lobes and 2 µm of five is 11.6 µm. 36.7 readings carry 5 UPR.
TEST_F(Implausible, NoRoundnessAtACutOffThatSwallowsLobes) {
  const Part lobed{.form = [](double theta, double) {
    return 5e-3 * std::cos(3.0 * theta - 0.4) + 2e-3 * std::cos(5.0 * theta + 1.0);
  }};
  const Stream stream = helix(lobed);
  const CommandStreams done = run(stream);
  EXPECT_EQ(done.exit_code, 0) << done.out;
  file("part.csv", stream.text());
  const CommandStreams form =
      command("form part.csv --upr 1-5 --tolerance-um RONt=11 --json f.json --force");
  EXPECT_NE(form.exit_code, 0) << form.out;
  EXPECT_FALSE(contains(form.out, "MET: RONt")) << form.out;
  EXPECT_TRUE(contains(form.out, "NOT PROVEN: RONt MZCI at most")) << form.out;
  const nlohmann::json json = result("f.json");
  ASSERT_EQ(json.at("swallowed").size(), 2U);
  EXPECT_EQ(json.at("swallowed")[0].at("order"), 3);
  EXPECT_EQ(json.at("swallowed")[1].at("order"), 5);
  // The amplitudes: σ √(2/N) is 0.074 µm of 1468 readings, 4 u.
  EXPECT_NEAR(json.at("swallowed")[0].at("amplitude").at("value").get<double>(), 5e-3, 4e-4);
  for (const auto& section : json.at("sections"))
    for (const auto& value : section.at("values"))
      if (value.at("name") == "RONt") {
        EXPECT_TRUE(value.at("value").is_null());
        EXPECT_GE(value.at("at_most").get<double>(), 11.6e-3);
      }
}

}  // namespace
}  // namespace trueaxis::testing
