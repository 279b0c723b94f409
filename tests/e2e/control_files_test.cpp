// SPDX-License-Identifier: Apache-2.0
// The verdict of a job is that of the files that it writes, as their controls read them. Readers
// and evaluators are this test's own (support/control_readers.hpp); what is wanted is a circle
// about the target axis, X = a cos C + b sin C + √(R² − (a sin C − b cos C)²) − R with (a, b) the
// axis at Z: a tilt t of the axis makes it an ellipse, R t²/4 < 2 pm off.
#include <cmath>

#include "support/command_fixture.hpp"
#include "support/control_readers.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

constexpr double rad = 3.14159265358979323846 / 180.0;
constexpr double radius_mm = 28.0, z_start = 60.0, z_end = 30.0;
constexpr double x0 = 0.09, y0 = -0.03, tilt_x = 5e-4, tilt_y = -4e-4;  // of the part, at Z = 0

/// The axis that result.json says the table is about.
struct TargetLine {
  double x, y, slope_x, slope_y;

  explicit TargetLine(const json& axis)
      : x(axis.at("x_at_start").at("value")),
        y(axis.at("y_at_start").at("value")),
        slope_x(axis.at("slope_x").at("value")),
        slope_y(axis.at("slope_y").at("value")) {}

  double wanted_mm(double c_deg, double z) const {
    const double a = x + slope_x * (z - z_start), b = y + slope_y * (z - z_start);
    const double c = c_deg * rad, across = a * std::sin(c) - b * std::cos(c);
    return a * std::cos(c) + b * std::sin(c) + std::sqrt(radius_mm * radius_mm - across * across) -
           radius_mm;
  }
};

class ControlFiles : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    char scenario[400];
    std::snprintf(scenario, sizeof scenario,
                  "seed = 3\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = %g\ny0_mm = %g\n"
                  "l = %.17g\nm = %.17g\n[noise]\nsigma_um = 0.5\n[[pass]]\nz_start_mm = 0\n"
                  "z_end_mm = 40\nfeed_mm_per_rev = 1\nreadings_per_revolution = 36.7\n",
                  x0, y0, tilt_x, tilt_y);
    file("seat.toml", scenario);
    ASSERT_EQ(command("simulate seat.toml -o seat.csv").exit_code, 0);
  }

  static std::string job(const std::string& outputs, const std::string& cut = "",
                         const std::string& target = "") {
    return "[[reference]]\nname = \"seat\"\nstream = \"seat.csv\"\nsurface = \"cylinder\"\n"
           "[target]\nsurface = \"cylinder\"\nradius_mm = 28\nz_start_mm = 60\nz_end_mm = 30\n"
           "stock_um = 4000\ncoaxiality_tolerance_um = 10\n" +
           target + "[cut]\nspeed_rpm = 60\nsense = \"+c\"\nfeed_mm_per_rev = 0.5\n" + cut +
           outputs;
  }

  CommandStreams run(const std::string& text) {
    file("job.toml", text);
    return command("run job.toml -o out --force");
  }

  json verdict() { return result("out/result.json").at("verdict"); }
  std::string text(const std::string& name) { return read_text(folder_ / name); }

  /// A part 0.2 mm off the spindle.
  void probe_far_off() {
    file("far.toml",
         "seed = 3\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.2\n[noise]\n"
         "sigma_um = 0.5\n[[pass]]\nz_start_mm = 0\nz_end_mm = 40\nfeed_mm_per_rev = 1\n"
         "readings_per_revolution = 36.7\n");
    ASSERT_EQ(command("simulate far.toml -o seat.csv --force").exit_code, 0);
  }

  /// Coaxiality of what the lathe cuts with this table, with the axis (x, y) + tilt · Z, mm.
  double coaxiality_of_cut(const std::string& table, double x, double y, double tilt_x_,
                           double tilt_y_) {
    file("read.csv", table);
    file("cut.toml",
         "seed = 1\n[part]\nkind = \"cylinder\"\nradius_mm = 28\n[cut]\nuse = \"wanted\"\n"
         "[cut.target]\nkind = \"cylinder\"\nradius_mm = 28\nz_start_mm = 60\nz_end_mm = 30\n"
         "[cut.tool]\nspeed_rpm = 60\nfeed_mm_per_rev = 0.05\nnose_radius_mm = 0.8\nsense = 1\n"
         "[cut.actuator]\nperfect = true\n[[pass]]\nz_start_mm = 34.9\nz_end_mm = 30.1\n"
         "feed_mm_per_rev = 0.1618\nreadings_per_revolution = 101.3\n");
    EXPECT_EQ(command("simulate cut.toml --table read.csv -o cut.csv --force").exit_code, 0);
    EXPECT_EQ(command("fit cut.csv --surface cylinder --json cut.json --force").exit_code, 0);
    const json p = result("cut.json").at("parameters");
    const auto of = [&](const char* name) { return p.at(name).at("value").get<double>(); };
    double coaxiality = 0.0;
    for (const double z : {30.1, 34.9})
      coaxiality = std::max(coaxiality, 2.0 * std::hypot(of("x0") + of("l") * z - x - tilt_x_ * z,
                                                         of("y0") + of("m") * z - y - tilt_y_ * z));
    return coaxiality;
  }

  /// What a file adds by the verdict, mm.
  double said_to_add(const std::string& name) {
    const json files = verdict().at("files");
    for (const json& of : files)
      if (of.at("name") == name) return of.at("by_file").at("value");
    ADD_FAILURE() << name << " is not in the verdict";
    return 0.0;
  }

  /// The worst over the cut of a table over C and Z.
  OffOverATurn evaluated(const PlaneOfControl& plane) {
    const TargetLine axis(result("out/result.json").at("target_axis"));
    OffOverATurn worst;
    for (int k = 0; k <= 3000; ++k) {
      const double z = z_end + (z_start - z_end) * k / 3000.0;
      const OffOverATurn here = over_a_turn(
          [&](double turn) {
            return plane.x_mm(360.0 * turn, z) - axis.wanted_mm(360.0 * turn, z);
          },
          720);
      worst.largest = std::max(worst.largest, here.largest);
      worst.centre = std::max(worst.centre, here.centre);
    }
    return worst;
  }
};

// The rows of a table whose following error is not the matter.
const std::string follows = "[actuator]\nfollowing_limit_um = 5\n";

const char* const servo =
    "[[output]]\nformat = \"servo_nc\"\nx = \"diameter\"\n"
    "f = \"blocks_per_minute\"\n";

// A band of 30 mm has the axis of its middle: 15 mm away the axis is 15 mm · tilt elsewhere, which
// no uncertainty of the axis holds.
TEST_F(ControlFiles, ATableOfTooLongBandsIsNoGo) {
  const CommandStreams done = run(job("[[output]]\nformat = \"sinumerik_cec\"\nband_mm = 30\n"));
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(contains(done.out, "NO-GO: coaxiality at most")) << done.out;
  EXPECT_TRUE(contains(done.out, "with cec.ini or table.csv (worst: cec.ini")) << done.out;
  EXPECT_FALSE(there("out/cec.ini"));
  EXPECT_FALSE(there("out/table.csv"));
  const TargetLine axis(result("out/result.json").at("target_axis"));
  const double leans_mm = 15.0 * std::hypot(axis.slope_x, axis.slope_y);
  // The chord over 2° of 0.12 mm is 0.02 µm.
  EXPECT_NEAR(said_to_add("cec.ini"), 2.0 * leans_mm, 4e-5);
  EXPECT_NEAR(leans_mm, 15.0 * std::hypot(tilt_x, tilt_y), 1e-4);  // U of the axis
  EXPECT_GE(verdict().at("coaxiality_at_most").at("value").get<double>(), 2.0 * leans_mm);
  // The step that is advised does.
  const std::string next = verdict().at("what_would_prove");
  const std::size_t key = next.find("band_mm = ");
  ASSERT_NE(key, std::string::npos) << next;
  const CommandStreams finer =
      run(job("[[output]]\nformat = \"sinumerik_cec\"\n" + next.substr(key) + "\n"));
  EXPECT_EQ(finer.exit_code, 0) << finer.out;
  EXPECT_TRUE(there("out/cec.ini"));
}

// Every table over C and Z, evaluated here: the verdict counts what it is off, and its centre.
TEST_F(ControlFiles, TheVerdictIsOfEveryTable) {
  const std::string outputs =
      "[[output]]\nformat = \"sinumerik_cec\"\nband_mm = 6\nc_step_deg = 10\n"
      "[[output]]\nformat = \"grid\"\nc_step_deg = 12\nposition_step_mm = 7\n"
      "[[output]]\nformat = \"beckhoff_crosscomp2\"\nx_axis = 1\nc_axis = 2\nz_axis = 3\n"
      "c_step_deg = 5\nposition_step_mm = 5\n";
  const CommandStreams done = run(job(outputs));
  ASSERT_EQ(done.exit_code, 0) << done.out;
  const std::pair<const char*, PlaneOfControl> tables[] = {
      {"cec.ini", read_cec(text("out/cec.ini"))},
      {"grid.csv", read_grid(text("out/grid.csv"))},
      {"crosscomp2.lis", read_crosscomp(text("out/crosscomp2.lis"))}};
  const double axis_alone_mm = verdict().at("coaxiality_at_most").at("value").get<double>();
  double most = 0.0;
  for (const auto& [name, plane] : tables) {
    const OffOverATurn off = evaluated(plane);
    const double adds = std::max(2.0 * off.centre, off.largest);
    // 720 angles and 3001 places miss 1 % of the last digit's rounding and of a chord.
    EXPECT_NEAR(said_to_add(name), adds, 0.02 * adds + 1e-7) << name;
    EXPECT_GT(axis_alone_mm, adds) << name;
    EXPECT_TRUE(contains(done.out, std::string(name) + ": ")) << done.out;
    most = std::max(most, said_to_add(name));
  }
  EXPECT_TRUE(
      contains(done.out, "with cec.ini, grid.csv, crosscomp2.lis or table.csv (worst: cec.ini"))
      << done.out;
  EXPECT_EQ(verdict().at("file"), "cec.ini");
  EXPECT_EQ(most, said_to_add("cec.ini"));
  // The report's next step names what was asked for.
  const std::string page = text("out/report.html");
  EXPECT_TRUE(contains(page, "Run cec.ini or grid.csv or crosscomp2.lis at 60 rpm"));
  EXPECT_FALSE(contains(page, "Run table.csv"));
}

// The lathe, which shares no formula with the table, cuts with what the control makes of the file.
TEST_F(ControlFiles, ThePartThatIsCutIsWithinTheVerdict) {
  ASSERT_EQ(run(job("[[output]]\nformat = \"sinumerik_cec\"\nband_mm = 5\n")).exit_code, 0);
  const PlaneOfControl plane = read_cec(text("out/cec.ini"));
  std::string table = "# schema: trueaxis.correction/1\nrev,Z[mm],C[deg],X_fts[mm],X_command[mm]\n";
  for (int i = 0; i <= 600 * 360; ++i) {
    char row[128];
    const double z = std::max(z_end, z_start - 0.05 * i / 360.0), x = plane.x_mm(i % 360, z);
    std::snprintf(row, sizeof row, "%d,%.6f,%d.000000,%.7f,%.7f\n", i / 360, z, i % 360, x, x);
    table += row;
  }
  const double coaxiality = coaxiality_of_cut(table, x0, y0, tilt_x, tilt_y);
  EXPECT_LE(coaxiality, verdict().at("coaxiality_at_most").at("value").get<double>());
  // A band of 5 mm is straight: its end is 2.5 mm · tilt off, of which U of the axis knows 1 µm.
  EXPECT_NEAR(coaxiality, 4.8 * std::hypot(tilt_x, tilt_y), 1e-3);
}

// Straight lines between 24 rows of a wave of 0.2 mm are A (1 − cos 7.5°) = 1.71 µm off.
TEST_F(ControlFiles, RowsTooFarApartAreSaid) {
  const std::string coarse = "interpolation = \"linear\"\nrows_per_revolution = 24\n" + follows;
  probe_far_off();
  const CommandStreams done = run(job("[[output]]\nformat = \"grid\"\nc_step_deg = 15\n", coarse));
  ASSERT_EQ(done.exit_code, 0) << done.out;
  const double off_mm = 0.2 * (1.0 - std::cos(7.5 * rad));
  const auto largest = [&] {
    return result("out/result.json").at("correction").at("between_rows").at("largest").at("value");
  };
  EXPECT_NEAR(largest().get<double>(), off_mm, 0.01 * off_mm);  // U of the axis is below 1 µm
  EXPECT_TRUE(contains(done.out, "rows   24 rows per revolution: straight lines")) << done.out;
  EXPECT_TRUE(contains(text("out/table.csv"), "24, linear in between, X_fts there off by at most"));
  // The grid has its nodes where the rows are, and is no better for that.
  EXPECT_NEAR(said_to_add("grid.csv"), 2.0 * 0.2 * std::pow(7.5 * rad, 2) / 3.0, 0.02 * off_mm);
  const std::string advice =
      result("out/result.json").at("correction").at("between_rows").at("coarse");
  const std::size_t at = advice.find("rows_per_revolution = ");
  ASSERT_NE(at, std::string::npos) << advice;
  const int rows = std::stoi(advice.substr(at + 22));
  // A tenth of 10 µm: A (1 − cos(π/M)) = 1 µm at M = 31.4.
  EXPECT_NEAR(rows, 31.4, 1.0);
  const CommandStreams finer =
      run(job("", "interpolation = \"linear\"\nrows_per_revolution = " + std::to_string(rows) +
                      "\n" + follows));
  EXPECT_EQ(finer.exit_code, 0) << finer.out;
  EXPECT_FALSE(contains(finer.out, "rows   ")) << finer.out;
  EXPECT_LE(largest().get<double>(), 1e-3);
}

// 24 rows keep the tolerance only if the control joins them: nobody said so.
TEST_F(ControlFiles, ATableOfWhichNobodySaysHowItIsReadIsNotProven) {
  probe_far_off();
  const CommandStreams done = run(job("", "rows_per_revolution = 24\n" + follows));
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(contains(done.out, "NOT PROVEN")) << done.out;
  EXPECT_TRUE(contains(done.out, "state interpolation = ")) << done.out;
  EXPECT_FALSE(there("out/table.csv"));
  const json reason = verdict().at("reasons").at(0);
  EXPECT_EQ(reason.at("code"), "interpolation_not_stated");
  const json between = result("out/result.json").at("correction").at("between_rows");
  EXPECT_EQ(between.at("interpolation"), "not_stated");
  // Eq. 114b: the last value before the next row, and half a row late. U of the axis is below 1 µm.
  const double off_mm = 2.0 * 0.2 * std::sin(7.5 * rad);
  EXPECT_NEAR(between.at("held").at("largest").at("value").get<double>(), off_mm, 0.01 * off_mm);
  const double x = 7.5 * rad, kept = std::sin(x) / x;
  const double once_mm = 0.2 * std::hypot(1.0 - kept * std::cos(x), kept * std::sin(x));
  EXPECT_NEAR(between.at("held").at("once").at("value").get<double>(), once_mm, 0.01 * once_mm);
  // The rows that are advised keep it for a control that holds them, and without a statement.
  const std::string line = verdict().at("line");
  const std::size_t at = line.find("rows_per_revolution = ");
  ASSERT_NE(at, std::string::npos) << line;
  const std::string rows = line.substr(at, line.find(' ', at + 22) - at) + "\n";
  for (const char* stated : {"", "interpolation = \"none\"\n"})
    EXPECT_EQ(run(job("", rows + stated + follows)).exit_code, 0) << rows << stated;
}

// The lathe cuts with rows that are held: the verdict of that statement has its error.
TEST_F(ControlFiles, ThePartCutWithHeldRowsIsWithinTheVerdict) {
  probe_far_off();
  const std::string held = "interpolation = \"none\"\n";
  const CommandStreams coarse = run(job("", "rows_per_revolution = 24\n" + held + follows));
  EXPECT_EQ(coarse.exit_code, 1) << coarse.out;
  EXPECT_TRUE(contains(coarse.out, "NO-GO")) << coarse.out;
  EXPECT_TRUE(contains(coarse.out, "table.csv keeps the tolerance with rows_per_revolution = "))
      << coarse.out;
  ASSERT_EQ(run(job("", "rows_per_revolution = 300\n" + held + follows)).exit_code, 0);
  const auto rows = read_rows(text("out/table.csv"));
  std::string table = "# schema: trueaxis.correction/1\nrev,Z[mm],C[deg],X_fts[mm],X_command[mm]\n";
  for (int i = 0; i <= 600 * 600; ++i) {  // a row where it begins and just before the next
    char row[128];
    const double turns = i / 2 / 300.0 + (i % 2 == 0 ? 0.0 : 0.98 / 300.0);
    const double z = std::max(z_end, z_start - 0.05 * turns);
    const double x = rows.at(static_cast<std::size_t>(i % 600 / 2)).x_mm;
    std::snprintf(row, sizeof row, "%d,%.6f,%.6f,%.7f,%.7f\n", i / 600, z,
                  360.0 * (turns - i / 600), x, x);
    table += row;
  }
  const double coaxiality = coaxiality_of_cut(table, 0.2, 0.0, 0.0, 0.0);
  EXPECT_LE(coaxiality, verdict().at("coaxiality_at_most").at("value").get<double>());
  // Half a row late, 2 A π/M, of which U of the axis knows 1 µm.
  EXPECT_NEAR(coaxiality, 2.0 * 0.2 * std::sin(0.6 * rad), 1e-3);
}

// halstreamer holds a line until the next: half a row late, A π/M, a diameter of 2 A π/M.
TEST_F(ControlFiles, ALineThatIsHeldIsCounted) {
  ASSERT_EQ(run(job("[[output]]\nformat = \"halstreamer\"\n")).exit_code, 0);
  const double amplitude = std::hypot(x0 + 60.0 * tilt_x, y0 + 60.0 * tilt_y);
  const double held_mm = 2.0 * amplitude * 180.0 * rad / 360.0;
  EXPECT_NEAR(said_to_add("halstreamer.txt"), held_mm, 0.02 * held_mm);
  EXPECT_EQ(verdict().at("file"), "halstreamer.txt");
  const CommandStreams coarse =
      run(job("[[output]]\nformat = \"halstreamer\"\n", "rows_per_revolution = 60\n"));
  EXPECT_EQ(coarse.exit_code, 1) << coarse.out;
  EXPECT_TRUE(
      contains(coarse.out, "halstreamer.txt keeps the tolerance with rows_per_revolution = "))
      << coarse.out;
}

// A servo's program, straight between its blocks in C, X and Z.
TEST_F(ControlFiles, AProgramIsReadBlockByBlock) {
  ASSERT_EQ(run(job(servo, "interpolation = \"linear\"\nrows_per_revolution = 90\n")).exit_code, 0);
  const TargetLine axis(result("out/result.json").at("target_axis"));
  const auto blocks = read_blocks(text("out/servo.nc"), true);
  OffOverATurn worst;
  for (std::size_t from = 0; from + 90 < blocks.size(); from += 90) {
    const OffOverATurn here = over_a_turn([&](double turn) {
      const double at = 90.0 * turn;
      const std::size_t i = from + static_cast<std::size_t>(at);
      const double share = at - std::floor(at);
      const auto of = [&](double PointOfControl::*word) {
        return blocks[i].*word + share * (blocks[i + 1].*word - blocks[i].*word);
      };
      return of(&PointOfControl::x_mm) - radius_mm -
             axis.wanted_mm(of(&PointOfControl::c_deg), of(&PointOfControl::z_mm));
    });
    worst.largest = std::max(worst.largest, here.largest);
    worst.centre = std::max(worst.centre, here.centre);
  }
  const double adds = std::max(2.0 * worst.centre, worst.largest);
  EXPECT_NEAR(said_to_add("servo.nc"), adds, 0.02 * adds + 1e-6);
}

}  // namespace
}  // namespace trueaxis::testing
