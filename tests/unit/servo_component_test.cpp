// SPDX-License-Identifier: Apache-2.0
// The C files of the servo component for LinuxCNC, built natively: the table as the library
// interpolates it, and what the component refuses. The part under the probe and the spindle are
// this test's own.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>

#include "correct/files/table_files.hpp"
#include "correct/profile.hpp"
#include "support/places.hpp"
#include "trueaxis/control_table.hpp"
#include "trueaxis/units.hpp"

extern "C" {
#include "fts_servo.h"
}

namespace trueaxis {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double speed_rpm = 600.0, period_s = 1e-3;

struct Cut {
  double z_start_mm, z_end_mm, feed_mm;
  int sense, rows;
  double c_start_deg;
};

AxisEstimate axis() {
  AxisEstimate found;
  found.axis = {0.09, -0.05, 4e-4, -7e-4, 50.0};
  return found;
}

Correction correction_of(const Cut& cut, Interpolation interpolation = Interpolation::linear) {
  TargetSurface target;
  target.kind = TargetKind::cone, target.radius_mm = 20.0, target.tan_half_angle = 0.05;
  target.z_start_mm = cut.z_start_mm, target.z_end_mm = cut.z_end_mm;
  ToolSetup tool;
  tool.nose_radius_mm = 0.4, tool.speed_rpm = speed_rpm, tool.feed_mm_per_rev = cut.feed_mm;
  tool.sense = cut.sense, tool.rows_per_revolution = cut.rows;
  tool.c_start_rad = cut.c_start_deg * rad_per_deg, tool.interpolation = interpolation;
  return make_correction(axis(), target, tool, {});
}

/// A table in a file of its own.
class Table {
 public:
  explicit Table(const std::string& text) {
    static int number = 0;
    path_ = (std::filesystem::temp_directory_path() /
             ("trueaxis_servo_" + std::to_string(getpid()) + "_" + std::to_string(number++)))
                .string();
    std::ofstream(path_) << text;
    char words[1000] = "";
    if (fts_table_read(&c, path_.c_str(), words, sizeof words) != 0) why = words;
  }
  ~Table() {
    fts_table_free(&c);
    std::filesystem::remove(path_);
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  fts_table c{};
  std::string why;  ///< refused, and this is what the log has

 private:
  std::string path_;
};

const Cut ordinary{70.0, 40.0, 0.2, 1, 90, 0.0};

/// The rows as they are written.
CorrectionRows rows_in(const std::string& csv) {
  CorrectionRows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#' || line[0] == 'r') continue;
    for (char& c : line)
      if (c == ',') c = ' ';
    std::istringstream in(line);
    double rev = 0.0, z = 0.0, c = 0.0, wanted = 0.0, command = 0.0;
    in >> rev >> z >> c >> wanted >> command;
    rows.position_mm.push_back(z), rows.c_rad.push_back(c);
    rows.wanted_mm.push_back(wanted), rows.command_mm.push_back(command);
  }
  return rows;
}

// The same bits as the library at 10⁵ places, beyond the ends and at whole revolutions among them.
TEST(ServoComponent, InterpolatesAsTheLibraryDoes) {
  std::mt19937_64 random(20261127);
  for (const Cut& cut :
       {ordinary, Cut{40.0, 70.03, 0.2, -1, 97, 271.25}, Cut{70.0, 69.3, 0.5, 1, 24, 12.0},
        Cut{10.0, 30.0, 0.071, 1, 360, 359.9}}) {
    const std::string csv = correction_csv(correction_of(cut));
    const Table table(csv);
    ASSERT_EQ(table.why, "");
    const CorrectionRows rows = rows_in(csv);
    const double low = std::min(cut.z_start_mm, cut.z_end_mm) - 1.0;
    const double length = std::abs(cut.z_end_mm - cut.z_start_mm) + 2.0;
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 25000; ++i) {
      double c_deg = 7200.0 * (share(random) - 0.5), z = low + length * share(random);
      if (i % 10 == 0) c_deg = 360.0 * (i % 7) + cut.c_start_deg;
      if (i % 20 == 0) z = rows.position_mm[static_cast<std::size_t>(i) % rows.position_mm.size()];
      const double turns = fts_table_turns(&table.c, c_deg);
      const double here = fts_table_at(&table.c, turns, z);
      const double library = table_value_mm(rows, rows.command_mm, cut.rows, turns, z);
      ASSERT_EQ(std::memcmp(&here, &library, sizeof here), 0)
          << "C " << c_deg << " Z " << z << ": " << here << " and " << library;
    }
  }
}

// A hair before the first row is one before the end of a turn: the remainder rounds up to 1.
TEST(ServoComponent, ATurnLessARoundingIsAtItsBeginning) {
  const CorrectionRows rows = rows_in(correction_csv(correction_of(ordinary)));
  const double first = rows.position_mm.front(), feed = rows.position_mm[ordinary.rows] - first;
  for (const double revolution : {0.0, 0.3, 1.6})
    EXPECT_EQ(
        table_value_mm(rows, rows.command_mm, ordinary.rows, -1e-20, first + revolution * feed),
        table_value_mm(rows, rows.command_mm, ordinary.rows, 0.0, first + revolution * feed));
}

// What is interpolated is the correction at any C and Z of the path, and equal on both sides of
// 360°. It is off by straight lines between rows (Eq. 114a) and by the digits of the table.
TEST(ServoComponent, FollowsTheWantedCorrection) {
  for (const Cut& cut : {ordinary, Cut{40.0, 70.03, 0.2, -1, 97, 271.25}}) {
    Correction correction = correction_of(cut);
    correction.rows.command_mm = correction.rows.wanted_mm;
    const Table table(correction_csv(correction));
    ASSERT_EQ(table.why, "");
    const Profile profile(axis().axis, correction.target, correction.tool);
    const double digits_mm = 1e-7 + 1e-6 * 1e-3;  // of a value; of Z at the largest tilt
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 5000; ++i) {
      const double c_deg = 360.0 * share(random);
      const double z = correction.position_start_mm +
                       share(random) * (correction.position_end_mm - correction.position_start_mm);
      const double value = fts_table_at(&table.c, fts_table_turns(&table.c, c_deg), z);
      // Linear along Z is exact but for what grows with the square of the tilt, below 1 nm here.
      EXPECT_NEAR(value, profile.at(c_deg * rad_per_deg, z),
                  1.05 * correction.between_rows.largest_mm + digits_mm + 1e-6)
          << c_deg << ' ' << z;
    }
    for (const double z : {40.0, 47.77, 70.0}) {
      const double before = fts_table_at(&table.c, 1.0 - 1e-12, z);
      // Before the first revolution is over, the next two are prolonged: as far as their digits go.
      EXPECT_NEAR(before, fts_table_at(&table.c, 1.0, z), z == cut.z_start_mm ? 2e-7 : 1e-11);
    }
  }
}

std::string with(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), by);
}

TEST(ServoComponent, AFileThatIsNotTheWholeTableIsRefused) {
  const std::string csv = correction_csv(correction_of(ordinary));
  ASSERT_EQ(Table(csv).why, "");
  const std::size_t last = csv.rfind('\n', csv.size() - 2) + 1, digit = csv.rfind('.') + 4;
  std::string other = csv;
  other[digit] = other[digit] == '7' ? '8' : '7';
  const Correction face = [] {
    Correction of = correction_of(ordinary);
    of.target.kind = TargetKind::face;
    return of;
  }();
  const std::pair<std::string, std::string> cases[] = {
      {other, "has changed since it was written"},
      {csv.substr(0, last), "has changed since it was written"},
      {with(csv, "# c_sense: +1", "# c_sense: -1"), "has a row that is not where the header"},
      {with(csv, "# c_sense: +1", "# c_sense: 1e300"), "does not say c_sense"},
      {with(csv, "# c_sense: +1", "# c_sense: 1.5"), "does not say c_sense"},
      {with(csv, "# rows_per_revolution: 90", "# rows_per_revolution: 90.5"),
       "does not say rows_per_revolution"},
      {with(csv, "# rows_per_revolution: 90", "# rows_per_revolution: 1e300"),
       "does not say rows_per_revolution"},
      {with(csv, "# speed: 600 rpm", "# speed: 500 rpm"), "has changed since it was written"},
      {with(csv, "# schema: trueaxis.correction/1", "# schema: trueaxis.grid/1"), "is not a table"},
      {"", "is not a table"},
      {csv.substr(0, csv.find("# checksum")) + csv.substr(csv.find("# version")),
       "does not have a checksum"},
      {correction_csv(correction_of(ordinary, Interpolation::not_stated)),
       "state interpolation = \"linear\""},
      {correction_csv(correction_of(ordinary, Interpolation::none)),
       "state interpolation = \"linear\""},
      {correction_csv(face), "a face cannot be cut"}};
  for (const auto& [text, says] : cases) {
    const Table refused(text);
    EXPECT_NE(refused.why.find(says), std::string::npos) << refused.why << " not " << says;
    EXPECT_EQ(refused.c.z_mm, nullptr);
  }
}

/// A lathe that the component runs on: a spindle, a slide, and a part under a probe.
struct Machine {
  explicit Machine(const Table& table) : table_(table.c) {}

  fts_limits limits{0.6, 41.0, 69.0, 28800.0, 0.002, 0.05, 0.02, 0.0, 10.0};
  fts_input in{0.0, 60.0, 0.0, 0.0, 10.0, 0, 0, 1};
  double rpm = speed_rpm, c_zero_deg = 0.0, probe_gain = 1.0;
  double x_mm = 0.09, y_mm = -0.05;  ///< of the part at Z = 50
  fts_servo servo{};

  void period() {
    in.c_deg += 6.0 * rpm * period_s;
    const double c = (in.c_deg + c_zero_deg) * rad_per_deg;
    const double x = x_mm + 4e-4 * (in.z_mm - 50.0), y = y_mm - 7e-4 * (in.z_mm - 50.0);
    in.probe_mm = probe_gain * (20.0 + x * std::cos(c) + y * std::sin(c));
    fts_servo_period(&servo, &table_, &limits, &in, period_s);
  }
  void run(int periods) {
    for (int i = 0; i < periods; ++i) period();
  }
  /// A revolution under the probe, then the ramp.
  void check_and_enable() {
    in.check = 1;
    for (int i = 0; i < 500 && !servo.out.checked; ++i) period();
    in.check = 0;
    in.enable = 1;
    run(400);
  }
  double wanted() const {
    return fts_table_at(&table_, fts_table_turns(&table_, in.c_deg), in.z_mm);
  }

 private:
  const fts_table& table_;
};

TEST(ServoComponent, RampsInFollowsAndRampsOut) {
  const Table table(correction_csv(correction_of(ordinary)));
  Machine machine(table);
  machine.check_and_enable();
  EXPECT_EQ(machine.servo.out.fault, FTS_NONE) << fts_fault_name(machine.servo.out.fault);
  EXPECT_TRUE(machine.servo.out.checked);
  EXPECT_TRUE(machine.servo.out.active);
  double before = machine.servo.out.position_mm;
  for (int i = 0; i < 2000; ++i) {
    machine.in.z_mm -= 0.01;
    if (machine.in.z_mm < 41.0) machine.in.z_mm = 41.0;
    machine.period();
    EXPECT_EQ(machine.servo.out.position_mm, machine.wanted());
    before = machine.servo.out.position_mm;
  }
  machine.in.enable = 0;
  // The ramp of 20 periods (smoothstep, at most 1.5/20 a period) and the motion of 3.6° a period.
  const double largest = std::max(table.c.most_mm, -table.c.least_mm);
  const double most = largest * (1.5 / 20.0 + 3.6 * rad_per_deg) * 1.01;
  for (int i = 0; i < 25; ++i) {
    machine.period();
    EXPECT_LE(std::abs(machine.servo.out.position_mm - before), most);
    before = machine.servo.out.position_mm;
  }
  EXPECT_EQ(machine.servo.out.position_mm, 0.0);
  EXPECT_FALSE(machine.servo.out.active);
}

struct Planted {
  const char* what;
  int fault;
  std::function<void(Machine&)> mistake;
};

// Each is refused by its name before the servo moves.
TEST(ServoComponent, PlantedMistakesAreRefusedByName) {
  const Table table(correction_csv(correction_of(ordinary)));
  const Planted all[] = {
      {"spindle turns the other way", FTS_SENSE, [](Machine& m) { m.rpm = -speed_rpm; }},
      {"faster than the servo follows", FTS_SPEED_LIMIT,
       [&](Machine& m) { m.rpm = 1.2 * table.c.speed_limit_rpm; }},
      {"C zero 10° off", FTS_C_ZERO, [](Machine& m) { m.c_zero_deg = 10.0; }},
      {"C zero 180° off or probe inverted", FTS_PROBE_INVERTED,
       [](Machine& m) { m.probe_gain = -1.0; }},
      {"clamped anew", FTS_OTHER_CLAMPING, [](Machine& m) { m.x_mm = 0.02; }},
      {"no limit of the feedback", FTS_LIMIT_NOT_STATED,
       [](Machine& m) { m.limits.following_limit_mm = -1.0; }},
      {"stale table", FTS_AGE, [](Machine& m) { m.in.age_s = 30000.0; }},
      {"table from the future", FTS_AGE, [](Machine& m) { m.in.age_s = -1.0; }},
      {"C not homed", FTS_C_NOT_HOMED, [](Machine& m) { m.in.c_homed = 0; }},
      {"small servo", FTS_STROKE, [](Machine& m) { m.limits.stroke_mm = 0.15; }},
      {"longer program", FTS_RANGE, [](Machine& m) { m.limits.z_high_mm = 75.0; }},
      {"range not stated", FTS_RANGE, [](Machine& m) { m.limits.z_low_mm = m.limits.z_high_mm; }},
      {"probe not connected", FTS_OTHER_CLAMPING, [](Machine& m) { m.probe_gain = 0.0; }},
      {"not a number", FTS_NO_NUMBER, [](Machine& m) { m.in.z_mm = std::nan(""); }}};
  for (const Planted& planted : all) {
    Machine machine(table);
    planted.mistake(machine);
    machine.check_and_enable();
    EXPECT_EQ(machine.servo.out.fault, planted.fault)
        << planted.what << ": " << fts_fault_name(machine.servo.out.fault);
    EXPECT_EQ(machine.servo.out.position_mm, 0.0) << planted.what;
    EXPECT_FALSE(machine.servo.out.active) << planted.what;
  }
  Machine shifted(table);
  shifted.c_zero_deg = 10.0;
  shifted.check_and_enable();
  EXPECT_NEAR(shifted.servo.out.check_c_off_deg, -10.0, 0.01);
  Machine unchecked(table);
  unchecked.in.enable = 1;
  unchecked.run(400);
  EXPECT_EQ(unchecked.servo.out.fault, FTS_NOT_CHECKED);
  Machine slow(table);  // waits, and does not move
  slow.rpm = 300.0;
  slow.check_and_enable();
  EXPECT_EQ(slow.servo.out.fault, FTS_NONE);
  EXPECT_EQ(slow.servo.out.position_mm, 0.0);
  slow.limits.wait_s = 0.5;  // and not for ever: the cut would go on without the table
  slow.run(600);
  EXPECT_EQ(slow.servo.out.fault, FTS_SPEED);
  EXPECT_EQ(slow.servo.out.position_mm, 0.0);
}

// A feed hold in the cut. If the spindle turns on, so does the correction. If C is an axis, it
// stops with Z: a tool that is held then would dig in by up to the range of the table, and the
// fault stays for the program, as the lag was another one. What was in order before the ramp is not
// asked again.
TEST(ServoComponent, AFeedHoldDoesNotDigIn) {
  const Table table(correction_csv(correction_of(ordinary)));
  Machine turning(table);
  turning.check_and_enable();
  for (int i = 0; i < 1000; ++i) {
    turning.period();
    ASSERT_EQ(turning.servo.out.position_mm, turning.wanted());
  }
  EXPECT_TRUE(turning.servo.out.active);
  turning.in.age_s = 1e9;
  turning.period();
  EXPECT_EQ(turning.servo.out.position_mm, turning.wanted());

  Machine stopping(table);
  stopping.check_and_enable();
  double least = 1.0, most = -1.0;
  for (int i = 0; i < 1000; ++i) {
    stopping.rpm = std::max(0.0, speed_rpm * (1.0 - i / 300.0));  // one and a half revolutions
    stopping.period();
    ASSERT_EQ(stopping.servo.out.position_mm, stopping.wanted());
    if (stopping.servo.out.fault == FTS_NONE) continue;
    least = std::min(least, stopping.servo.out.position_mm);
    most = std::max(most, stopping.servo.out.position_mm);
  }
  EXPECT_EQ(stopping.servo.out.fault, FTS_SPEED);
  EXPECT_FALSE(stopping.servo.out.active);
  EXPECT_GT(most - least, 0.15);  // what a position that was held would have left: 2 x 0.1 mm
  stopping.in.c_homed = 0;        // a doubt of C after one of the speed
  stopping.period();
  EXPECT_EQ(stopping.servo.out.fault, FTS_C_NOT_HOMED);
}

// While it follows: the position stays where it is, until `enable` is false, and then ramps out.
TEST(ServoComponent, HoldsOnAnyDoubtOfCAndZ) {
  const Table table(correction_csv(correction_of(ordinary)));
  const Planted all[] = {
      {"an encoder that jumps", FTS_C_JUMPED, [](Machine& m) { m.in.c_deg += 120.0; }},
      {"an encoder that jumps back", FTS_C_JUMPED, [](Machine& m) { m.in.c_deg -= 20.0; }},
      {"an encoder that is lost", FTS_NO_NUMBER, [](Machine& m) { m.in.c_deg = std::nan(""); }},
      {"index lost", FTS_C_NOT_HOMED, [](Machine& m) { m.in.c_homed = 0; }},
      {"servo stuck", FTS_FOLLOWING, [](Machine& m) { m.limits.following_limit_mm = 0.005; }}};
  for (const Planted& planted : all) {
    Machine machine(table);
    machine.check_and_enable();
    ASSERT_TRUE(machine.servo.out.active) << planted.what;
    planted.mistake(machine);
    double held = machine.servo.out.position_mm;
    for (int i = 0; i < 200 && machine.servo.out.fault == FTS_NONE; ++i) {
      held = machine.servo.out.position_mm;
      machine.period();
    }
    EXPECT_EQ(machine.servo.out.fault, planted.fault)
        << planted.what << ": " << fts_fault_name(machine.servo.out.fault);
    for (int i = 0; i < 50; ++i) {
      machine.period();
      EXPECT_EQ(machine.servo.out.position_mm, held) << planted.what;
    }
    if (planted.fault == FTS_NO_NUMBER) machine.in.c_deg = 0.0;
    machine.rpm = speed_rpm;
    machine.in.enable = 0;
    machine.run(25);
    EXPECT_EQ(machine.servo.out.position_mm, 0.0) << planted.what;
    EXPECT_EQ(machine.servo.out.fault, FTS_NONE) << planted.what;
  }
}

}  // namespace
}  // namespace trueaxis
