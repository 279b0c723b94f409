// SPDX-License-Identifier: Apache-2.0
// `trueaxis form` as a user meets it: screen, files, tolerances, and what it refuses.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

class FormCommand : public CommandTest {
 protected:
  using Shape = std::function<double(double angle_rad, double z_mm)>;

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  /// Even readings of a radius in sections; digits to 1e-9 mm.
  void probe(const std::string& name, const Shape& shape, int readings, std::vector<double> z_mm,
             const std::string& head = "# x_convention: radius\nX_M[mm],C[deg],Z[mm]\n") {
    std::string text = head;
    char line[96];
    for (const double z : z_mm)
      for (int i = 0; i < readings; ++i) {
        const double deg = 360.0 * i / readings;
        std::snprintf(line, sizeof line, "%.9f,%.9f,%.4f\n", shape(deg * rad_per_deg, z), deg, z);
        text += line;
      }
    write(name, text);
  }
  static double value(const nlohmann::json& values, const std::string& name,
                      const std::string& reference = "") {
    for (const nlohmann::json& one : values)
      if (one.at("name") == name && (reference.empty() || one.at("reference") == reference))
        return one.at("value");
    return NAN;
  }
};

TEST_F(FormCommand, ASectionOnOneScreen) {
  probe("s.csv", [](double t, double) { return 25.0 + 2e-3 * std::cos(5.0 * t); }, 720, {10.0});
  const CommandStreams done = command("form s.csv --json s.json --profile s_profile.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_LE(std::ranges::count(done.out, '\n'), 15) << done.out;
  for (const char* word :
       {"Gaussian 1-50 UPR", "LSCI", "MZCI", "MCCI", "MICI", "RONt", "k = 2", "lobes           5"})
    EXPECT_TRUE(contains(done.out, word)) << word << done.out;
  const nlohmann::json json = result("s.json");
  EXPECT_EQ(json.at("schema"), "trueaxis.form/1");
  // 2a · 2^−(5/50)²; the file rounds to 1e-9 mm.
  EXPECT_NEAR(value(json.at("sections").at(0).at("values"), "RONt", "MZCI"),
              4e-3 * std::exp2(-0.01), 3e-9);
  EXPECT_EQ(json.at("sections").at(0).at("lobes"), 5);
  const std::string before = read_text(folder_ / "s.json");
  ASSERT_EQ(command("form s.csv --json s.json --profile s_profile.csv --threads 1").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "s.json"), before);
  EXPECT_TRUE(
      read_text(folder_ / "s_profile.csv").starts_with("# schema: trueaxis.form_profile/1"));
}

TEST_F(FormCommand, ACylinderAndItsTolerances) {
  probe("c.csv", [](double t, double z) { return 15.0 + 1e-3 * std::cos(3.0 * t) + 1e-4 * z; }, 360,
        {-10.0, 0.0, 10.0});
  const CommandStreams done = command("form c.csv --upr 1-15 --json c.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_LE(std::ranges::count(done.out, '\n'), 20) << done.out;
  const nlohmann::json groups = result("c.json").at("groups");
  const double lobes = 1e-3 * std::exp2(-0.04);
  EXPECT_NEAR(value(groups.at(0).at("values"), "CYLt", "MZCY"), 2.0 * lobes + 2e-3, 1e-8);
  EXPECT_NEAR(value(groups.at(0).at("values"), "CYLat"), std::atan(1e-4) / rad_per_deg, 1e-7);
  const std::string met = command("form c.csv --upr 1-15 --tolerance-um RONt=3,CYLt=5").out;
  EXPECT_TRUE(met.starts_with("MET: RONt MZCI")) << met;
  const CommandStreams not_met = command("form c.csv --upr 1-15 --tolerance-um RONt=3,CYLt=3");
  EXPECT_EQ(not_met.exit_code, 1);
  EXPECT_TRUE(contains(not_met.out, "NOT MET: CYLt MZCY")) << not_met.out;
  EXPECT_EQ(command("form c.csv --upr 1-15 --tolerance-um RONT=3").exit_code, 3);
  EXPECT_EQ(command("form c.csv --upr 1-15 --tolerance-um RONt=3um").exit_code, 2);
}

// Printed or written, again and by any number of threads, a QIF document is the same bytes.
TEST_F(FormCommand, AQifDocumentIsPrintedAsItIsWritten) {
  probe("q.csv", [](double t, double) { return 15.0 + 1e-3 * std::cos(3.0 * t); }, 360,
        {0.0, 10.0});
  const std::string of = "form q.csv --upr 1-15 --tolerance-um RONt=3,runout_total=1";
  const CommandStreams printed = command(of + " --qif -");
  EXPECT_EQ(printed.exit_code, 1) << printed.err;  // the run-out is 2 µm
  EXPECT_TRUE(printed.out.starts_with("<?xml version=\"1.0\"")) << printed.out;
  for (const char* word : {"CircularityCharacteristicMeasurement", "combinedUncertainty",
                           "TotalRunoutCharacteristicMeasurement", ">PASS<", ">FAIL<"})
    EXPECT_TRUE(contains(printed.out, word)) << word;
  for (const char* again : {"", " --threads 1"}) {  // over its own earlier document
    EXPECT_EQ(command(of + " --qif q.qif" + again).exit_code, 1);
    EXPECT_EQ(read_text(folder_ / "q.qif"), printed.out);
  }
}

TEST_F(FormCommand, AgainstADatumOfItsOwn) {
  const auto part = [](double t, double) { return 15.0 + 0.02 * std::cos(t); };
  probe("p.csv", part, 360, {0.0, 10.0});
  probe("d.csv", [](double t, double) { return 10.0 + 0.02 * std::cos(t); }, 360, {20.0, 30.0});
  ASSERT_EQ(command("form p.csv --datum d.csv --upr 1-15 --json r.json").exit_code, 0);
  const nlohmann::json json = result("r.json");
  EXPECT_EQ(json.at("datum").at("association"), "gaussian");
  // Both are limaçons: their circles' centres are e²/R² of e off it at most, 1e-7 mm.
  EXPECT_LT(value(json.at("groups").at(1).at("values"), "coaxiality"), 5e-5);
}

// A tapered datum, coaxial with the part, rocks in its circumscribed cylinder, which the screen
// says.
TEST_F(FormCommand, ATaperedDatumRocks) {
  const auto lobes = [](double t) { return 1e-4 * std::cos(3 * t); };  // no stuck probe
  probe("p.csv", [&](double t, double) { return 15.0 + lobes(t); }, 360, {0.0, 10.0});
  probe("d.csv", [&](double t, double z) { return 10.0 + 0.01 * z + lobes(t); }, 360,
        {20.0, 30.0, 40.0});
  ASSERT_EQ(command("form p.csv --datum d.csv --upr 1-15 --json r.json").exit_code, 0);
  EXPECT_LT(value(result("r.json").at("groups").at(1).at("values"), "coaxiality"), 1e-6);
  const CommandStreams rocks =
      command("form p.csv --datum d.csv --upr 1-15 --datum-association minimum_circumscribed");
  EXPECT_TRUE(contains(rocks.out, "rock")) << rocks.out;
}

// Truth of the virtual lathe, whose formulas are its own: 0.8 cos(2θ − 40°) + 0.5 cos 3θ µm through
// 1-15 UPR has a range of 2.4150 µm; the spindle's 0.4 cos 2C added makes it 3.0647.
TEST_F(FormCommand, TheSpindlesMotionIsTakenOff) {
  ASSERT_EQ(command("simulate " + places::source() +
                    "/data/scenarios/spindle_three_sensors.toml -o "
                    "three.csv")
                .exit_code,
            0);
  ASSERT_EQ(command("spindle three.csv --json motion.json").exit_code, 0);
  std::istringstream three(read_text(folder_ / "three.csv"));
  std::string one;
  for (std::string line; std::getline(three, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream fields(line);
    std::string field;
    for (int i = 0; std::getline(fields, field, ',') && i < 5; ++i)  // X_M1, C, Z
      if (i == 0 || i > 2) one += (i == 0 && field == "X_M1[mm]" ? "X_M[mm]" : field) + ",";
    one.back() = '\n';
  }
  write("one.csv", "# x_convention: radius\n" + one);
  const auto roundness = [&](const std::string& more) {
    EXPECT_EQ(command("form one.csv --upr 1-15 --json r.json " + more).exit_code, 0);
    return value(result("r.json").at("sections").at(0).at("values"), "RONt", "LSCI");
  };
  // 0.02: U of the separated form, as the spindle command states it; noise alone is 0.004.
  EXPECT_NEAR(roundness(""), 3.0647e-3, 0.02e-3);
  EXPECT_NEAR(roundness("--spindle motion.json"), 2.4150e-3, 0.02e-3);
}

TEST_F(FormCommand, PointsOfEveryElement) {
  std::string cylinder, plane, line, circle;
  char text[96];
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < 360; ++i) {
      const double t = i * rad_per_deg, r = 12.0 + 1e-3 * std::cos(2.0 * t);
      std::snprintf(text, sizeof text, "%.10f %.10f %.10f\n", 1000.0 + 10.0 * s,
                    -5.0 + r * std::cos(t), 7.0 + r * std::sin(t));
      cylinder += text;
      if (s == 0) {
        std::snprintf(text, sizeof text, "%.10f %.10f 0\n", 3.0 + r * std::cos(t), r * std::sin(t));
        circle += text;
        std::snprintf(text, sizeof text, "%.10f %.10f %.10f\n", 20.0 * std::cos(t),
                      20.0 * std::sin(t), 50.0 + 1e-3 * std::cos(2.0 * t));
        plane += text;
        std::snprintf(text, sizeof text, "%.10f %.10f 0\n", 0.1 * i, 5e-4 * std::cos(4.0 * t));
        line += text;
      }
    }
  write("cylinder.txt", cylinder);
  write("plane.txt", plane);
  write("line.txt", line);
  write("circle.txt", circle);
  const auto of = [&](const std::string& element, const std::string& more) {
    const CommandStreams done =
        command("form " + element + ".txt --element " + element + " --json r.json --force " + more);
    EXPECT_EQ(done.exit_code, 0) << element << done.err;
    return done.exit_code == 0 ? result("r.json") : nlohmann::json();
  };
  const double lobes = 2e-3 * std::exp2(-4.0 / 225.0);
  EXPECT_NEAR(value(of("circle", "--upr 1-15").at("sections").at(0).at("values"), "RONt", "MZCI"),
              lobes, 1e-8);
  EXPECT_NEAR(value(of("cylinder", "--upr 1-15").at("groups").at(0).at("values"), "CYLt", "MZCY"),
              lobes, 1e-8);
  EXPECT_NEAR(value(of("plane", "").at("groups").at(0).at("values"), "FLTt", "MZPL"), 2e-3, 1e-8);
  EXPECT_NEAR(value(of("line", "").at("groups").at(0).at("values"), "STRt", "MZLI"), 1e-3, 1e-8);
}

// The words around a number: the unit next to the bound, no direction of an eccentricity that
// points do not have.
TEST_F(FormCommand, TheWordsAroundABoundAndACircleOfPoints) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 1e-3);
  std::string plane, circle;
  char text[96];
  for (int i = 0; i < 400; ++i) {
    std::snprintf(text, sizeof text, "%d %d %.7f\n", i % 20, i / 20, noise(random));
    plane += text;
    const double t = two_pi * i / 400.0, r = 12.0 + noise(random);
    std::snprintf(text, sizeof text, "%.7f %.7f 0\n", 3.0 + r * std::cos(t), r * std::sin(t));
    circle += text;
  }
  write("plane.txt", plane);
  write("circle.txt", circle);
  const std::string met = command("form plane.txt --element plane --tolerance-um FLTt=100").out;
  EXPECT_TRUE(met.starts_with("MET: FLTt MZPL below ")) << met;
  EXPECT_TRUE(contains(first_line(met), " µm (95 % confidence), tolerance 100 µm")) << met;
  const CommandStreams round = command("form circle.txt --element circle");
  EXPECT_EQ(round.exit_code, 0) << round.err;
  EXPECT_FALSE(contains(round.out, "eccentricity")) << round.out;
}

TEST_F(FormCommand, RefusesWhatTheReadingsDoNotCarry) {
  const auto round = [](double t, double) { return 15.0 + 1e-3 * std::cos(3 * t); };
  probe("thousand.csv", round, 1000, {0.0});
  const CommandStreams few = command("form thousand.csv --upr 1-500");
  EXPECT_EQ(few.exit_code, 3);
  EXPECT_TRUE(contains(few.err, "500 UPR needs 3500 readings per revolution")) << few.err;
  EXPECT_TRUE(contains(few.err, "--upr 1-50")) << few.err;
  EXPECT_EQ(command("form thousand.csv --upr 1-15").exit_code, 0);
  const auto refused = [&](const std::string& arguments, const std::string& word) {
    const CommandStreams done = command("form " + arguments);
    EXPECT_EQ(done.exit_code, 3) << arguments << done.out;
    EXPECT_TRUE(contains(done.err, word)) << done.err;
  };
  // Degrees under a header of radians, and radians under one of degrees.
  probe("rad.csv", round, 360, {0.0}, "# x_convention: radius\nX_M[mm],C[rad],Z[mm]\n");
  refused("rad.csv", "write C[deg]");
  std::string radians = "# x_convention: radius\nX_M[mm],C[deg]\n";
  for (int i = 0; i < 720; ++i) {
    const double c_rad = two_pi * i / 720.0;
    radians += std::to_string(round(c_rad, 0.0)) + "," + std::to_string(c_rad) + "\n";
  }
  write("deg.csv", radians);
  refused("deg.csv", "write C[rad]");
  // A gauge's readings taken as positions.
  probe("gauge.csv", [](double t, double) { return 0.2 * std::cos(t); }, 720, {0.0});
  refused("gauge.csv", "--relative");
  write("empty.csv", "");
  EXPECT_EQ(command("form empty.csv").exit_code, 3);
  EXPECT_EQ(command("form thousand.csv --upr 1-15 --json thousand.csv --force").exit_code, 3);
  EXPECT_EQ(command("form thousand.csv --upr 50-1").exit_code, 2);
  EXPECT_EQ(command("form thousand.csv --upr 1-15 --spindle thousand.csv").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.json"));
}

// 57.296 turns are 360 rad, and a cone of 45° is from 20 to 57 mm: both are what they say.
TEST_F(FormCommand, TakesWhatLooksLikeAMistakeAndIsNone) {
  std::string turns = "# x_convention: radius\nX_M[mm],C[rad],Z[mm]\n", cone = turns;
  for (int i = 0; i < 2063; ++i) {
    const double c_rad = two_pi * i / 36.0, z_mm = c_rad / two_pi;
    const double off_mm = 0.05 * std::cos(c_rad) + 0.002 * std::cos(2.0 * c_rad);
    turns += std::to_string(20.0 + off_mm) + "," + std::to_string(c_rad) + "," +
             std::to_string(z_mm) + "\n";
    cone += std::to_string(20.0 + 0.7 * z_mm + off_mm) + "," + std::to_string(1.003 * c_rad) + "," +
            std::to_string(z_mm) + "\n";
  }
  write("turns.csv", turns), write("cone.csv", cone);
  for (const char* name : {"turns.csv", "cone.csv"}) {
    const CommandStreams done = command(std::string("form ") + name + " --upr 1-5");
    EXPECT_EQ(done.exit_code, 0) << done.err;
  }
}

// A spindle that stands still before the helix ended with a bug: no section is there.
TEST_F(FormCommand, AStandstillBeforeTheHelixIsNoSection) {
  std::string text = "# x_convention: radius\nX_M[mm],C[rad],Z[mm]\n";
  for (int i = 0; i < 1600; ++i) {
    const double c_rad = i < 400 ? 0.0 : two_pi * (i - 400) / 30.0, z_mm = c_rad / two_pi;
    text += std::to_string(20.0 + 0.004 * std::cos(3.0 * c_rad)) + "," + std::to_string(c_rad) +
            "," + std::to_string(z_mm) + "\n";
  }
  write("stands.csv", text);
  const CommandStreams done = command("form stands.csv --upr 1-4");
  EXPECT_EQ(done.exit_code, 0) << done.err;
}

}  // namespace
}  // namespace trueaxis::testing
