// SPDX-License-Identifier: Apache-2.0
// `trueaxis setup locators` and `trueaxis setup datums` as a user meets them, and their errors in
// the machine.
#include <cmath>
#include <fstream>
#include <functional>
#include <regex>

#include "support/chain_matrices.hpp"
#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/twelve_holes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

class FixtureCommand : public CommandTest {
 protected:
  static std::string of_data(const std::string& name) {
    return std::string(places::source() + "/data/five_axis/").append(name);
  }
  static std::vector<std::string> lines_of(const nlohmann::json& json, const std::string& format) {
    for (const nlohmann::json& frame : json.at("frames"))
      if (frame.at("format") == format) return frame.at("lines");
    return {};
  }
  /// D of a result by its six errors, and as its matrix.
  static Matrix4 by_errors(const nlohmann::json& json) {
    const auto value = [&](const char* name) {
      return json.at("setup").at(name).at("value").get<double>();
    };
    const double deg = rad_per_deg;
    return times(Tr(value("X0W"), value("Y0W"), value("Z0W")),
                 exp({deg * value("A0W"), deg * value("B0W"), deg * value("C0W")}));
  }
  static void expect_same(const Matrix4& a, const nlohmann::json& matrix, double bound) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        EXPECT_NEAR(a[i][j], matrix.at(i).at(j).get<double>(), bound) << i << ' ' << j;
  }
};

TEST_F(FixtureCommand, TableOneOfHongAndYeh) {
  const CommandStreams done =
      command("setup locators " + of_data("hong.toml") + " --json h.json -o E.toml");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json json = result("h.json"), paper = json.at("paper");
  EXPECT_EQ(json.at("schema"), "trueaxis.setup/1");
  const auto printed = [&](const char* key, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, paper.at(key).get<double>());
    return std::string(text);
  };
  EXPECT_EQ(printed("alpha", "%.4f"), "0.1066");
  EXPECT_EQ(printed("beta", "%.4f"), "-0.0217");
  EXPECT_EQ(printed("gamma", "%.4f"), "-0.0065");
  EXPECT_EQ(printed("gamma_as_printed", "%.4f"), "179.9935");
  EXPECT_EQ(printed("dx", "%.4f"), "-0.1819");
  EXPECT_EQ(printed("dy", "%.4f"), "0.1141");
  EXPECT_EQ(printed("dz", "%.4f"), "-0.0663");
  EXPECT_EQ(lines_of(json, "fanuc.g68.2.p0"),
            std::vector<std::string>{
                "G68.2 X-0.181862 Y0.114244 Z-0.066156 I-11.506192 J0.108786 K11.499672"});
  EXPECT_TRUE(contains(done.out, "SPA+0.106602 SPB-0.021688 SPC-0.006540"));
  const CommandStreams all = command("setup locators " + of_data("hong.toml") + " --verbose");
  EXPECT_TRUE(contains(all.out, "alpha 0.1066  beta -0.0217  gamma -0.0065 deg")) << all.out;
  expect_same(by_errors(json), json.at("matrix"), 1e-13);
  EXPECT_TRUE(read_text(folder_ / "E.toml").starts_with("# schema: trueaxis.errors/1\n"));
  // The same bytes again, over its own results.
  const std::string before = read_text(folder_ / "h.json");
  ASSERT_EQ(
      command("setup locators " + of_data("hong.toml") + " --json h.json -o E.toml").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "h.json"), before);
  const CommandStreams coarse = command("setup locators " + of_data("hong.toml") + " --decimals 4");
  EXPECT_TRUE(contains(coarse.out, "TRANS X-0.1819 Y0.1142 Z-0.0662\n")) << coarse.out;
  EXPECT_EQ(command("setup locators " + of_data("hong.toml") + " --decimals 2").exit_code, 2);
}

// A value that is stated as exact keeps its digits.
TEST_F(FixtureCommand, ExactTipsKeepTheDigitsOfTheTurn) {
  const std::string exact =
      std::regex_replace(read_text(of_data("hong.toml")), std::regex("u_um = [0-9.]+"), "u_um = 0");
  std::ofstream(folder_ / "exact.toml") << exact;
  const CommandStreams done = command("setup locators exact.toml");
  EXPECT_TRUE(contains(done.out, "A0W 0.1066, B0W -0.0217, C0W -0.0065 deg")) << done.out;
}

// Three locators 1 µm uncertain: u of the height at their centre is 1/√3 µm and of D at any point
// what the covariance says; a tip's u alone moves Z at A by itself.
TEST_F(FixtureCommand, CovarianceAtALocatorIsThatOfItsTip) {
  ASSERT_EQ(command("setup locators " + of_data("hong.toml") + " --json h.json").exit_code, 0);
  const nlohmann::json covariance = result("h.json").at("covariance");
  const double x[] = {15, 12}, deg = rad_per_deg;
  // δz = δZ0W + y δA0W − x δB0W to first order of the small angles.
  const double row[] = {0, 0, 1, x[1] * deg, -x[0] * deg, 0};
  double variance = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      variance += row[i] * covariance.at(i).at(j).get<double>() * row[j];
  EXPECT_NEAR(std::sqrt(variance), 1e-3, 5e-6);  // angles of 2 mrad
}

// The program of the twelve holes is right for the machine without errors to its four and five
// decimals (0.5 · 10⁻⁴ mm an axis, 5 · 10⁻⁶ deg at 130 mm); with the errors of `datum` the tool is
// at D⁻¹ of it, up to 0.3 mm off.
TEST_F(FixtureCommand, TwelveHolesAreOffByTheDatums) {
  ASSERT_EQ(command("setup datums " + of_data("holes.toml") + " -o E.toml --json d.json").exit_code,
            0);
  const Holes holes = twelve_holes(read_text(of_data("holes.nc")));
  file("p.csv", positions_csv(holes.at));
  const std::string pose = "machine pose --machine " + of_data("zxacy.toml") + " p.csv";
  const auto nominal = rows_of(command(pose).out);
  const auto actual = rows_of(command(pose + " --errors E.toml").out);
  ASSERT_EQ(nominal.size(), 12U);
  ASSERT_EQ(actual.size(), 12U);
  const Matrix4 part_from_fixture = inverse(by_errors(result("d.json")));
  double most_mm = 0.0;
  for (std::size_t n = 0; n < 12; ++n) {
    const Vector3 tip{nominal[n][0], nominal[n][1], nominal[n][2]};
    Vector3 moved = turned(part_from_fixture, tip);
    double off = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(tip[k], holes.bottom[n][k], 2e-4) << "hole " << n + 1;
      EXPECT_NEAR(nominal[n][k + 3], holes.axis[n][k], 2e-7) << "hole " << n + 1;
      moved[k] += part_from_fixture[k][3];
      EXPECT_NEAR(actual[n][k], moved[k], 1e-11) << "hole " << n + 1;
      off += std::pow(moved[k] - tip[k], 2);
    }
    most_mm = std::max(most_mm, std::sqrt(off));
  }
  EXPECT_NEAR(most_mm, 0.3, 0.03);
}

// The tool that goes where the nominal machine would reach D of a hole is in the hole.
TEST_F(FixtureCommand, TheDisplacedProgramDrillsTheHoles) {
  ASSERT_EQ(command("setup datums " + of_data("holes.toml") + " -o E.toml --json d.json").exit_code,
            0);
  const Matrix4 D = by_errors(result("d.json"));
  const Holes holes = twelve_holes(read_text(of_data("holes.nc")));
  std::string targets = "x,y,z,i,j,k\n";
  for (std::size_t n = 0; n < 12; ++n) {
    const Vector3 tip = turned(D, holes.bottom[n]), axis = turned(D, holes.axis[n]);
    char row[200];
    std::snprintf(row, sizeof row, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", tip[0] + D[0][3],
                  tip[1] + D[1][3], tip[2] + D[2][3], axis[0], axis[1], axis[2]);
    targets += row;
  }
  file("t.csv", targets);
  const auto axes =
      rows_of(command("machine inverse --machine " + of_data("zxacy.toml") + " t.csv").out);
  ASSERT_EQ(axes.size(), 12U);
  std::vector<FiveAxes> positions;
  for (const auto& row : axes) positions.push_back({row[2], row[3], row[4], row[5], row[6]});
  file("q.csv", positions_csv(positions));
  const auto poses = rows_of(
      command("machine pose --machine " + of_data("zxacy.toml") + " q.csv --errors E.toml").out);
  ASSERT_EQ(poses.size(), 12U);
  for (std::size_t n = 0; n < 12; ++n) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(poses[n][k], holes.bottom[n][k], 1e-10) << "hole " << n + 1;
      EXPECT_NEAR(poses[n][k + 3], holes.axis[n][k], 1e-12) << "hole " << n + 1;
    }
  }
}

// Table 2 of the paper as fixtures.md has it: every rate from the sizes, the printed ones
// rounded but for the two that are cut off.
TEST(FixtureDocs, RatesOfTableTwo) {
  std::istringstream page(read_text(places::source() + "/docs/reference/fixtures.md"));
  int rows = 0, cut_off = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.compare(0, 7, "| hole,") != 0 && line.compare(0, 7, "| step,") != 0) continue;
    std::istringstream fields(line.substr(line.find('|', 2) + 1));
    char bar;
    std::string percent;
    double before, after, printed, rate;
    fields >> before >> bar >> after >> bar >> printed >> percent >> bar >> rate >> percent;
    ASSERT_TRUE(fields) << line;
    const double exact = 100.0 * (1.0 - std::abs(after) / std::abs(before));
    EXPECT_EQ(std::lround(100.0 * rate), std::lround(100.0 * exact)) << line;
    if (printed != rate) {
      ++cut_off;
      EXPECT_EQ(std::lround(100.0 * printed), std::lround(std::floor(100.0 * exact))) << line;
    }
    ++rows;
  }
  EXPECT_EQ(rows, 7);
  EXPECT_EQ(cut_off, 2);
}

TEST_F(FixtureCommand, PointsSayTheDatums) {
  // z = 0.02 + 0.001 x − 0.0005 y; y = −0.01; x = 0.03 + 0.002 y.
  std::string xy = "x[mm],y[mm],z[um]\n", zx = "# probed\nz[mm],x[mm],y[mm]\n",
              yz = "x[mm],y[mm],z[mm]\n";
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      char row[100];
      const double a = 25.0 * i, b = 20.0 * j;
      std::snprintf(row, sizeof row, "%g,%g,%.12g\n", a, b, 20.0 + a - 0.5 * b);
      xy += row;
      std::snprintf(row, sizeof row, "%g,%g,-0.01\n", a, b);
      zx += row;
      std::snprintf(row, sizeof row, "%.12g,%g,%g\n", 0.03 + 0.002 * a, a, b);
      yz += row;
    }
  }
  file("xy.csv", xy), file("zx.csv", zx), file("yz.csv", yz);
  file("d.toml",
       "[xy]\npoints = \"xy.csv\"\n[zx]\npoints = \"zx.csv\"\n[yz]\npoints = \"yz.csv\"\n");
  const CommandStreams done = command("setup datums d.toml --json d.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json json = result("d.json"), datums = json.at("datums");
  const auto value = [&](const char* name) { return datums.at(name).at("value").get<double>(); };
  // A plane z = c + p x + q y has the normal (−p, −q, 1)/√…: turned by atan √(p² + q²) about (q,
  // −p).
  const double p = 0.001, q = -0.0005, tilt = std::hypot(p, q);
  EXPECT_NEAR(value("Ezz"), 0.02, 1e-9);
  EXPECT_NEAR(value("Ezx"), q * std::atan(tilt) / tilt / rad_per_deg, 1e-9);
  EXPECT_NEAR(value("Ezy"), -p * std::atan(tilt) / tilt / rad_per_deg, 1e-9);
  // ZX is y = a + s z + t x with a normal (-t, 1, -s) square to that of XY: s = p t - q, so that
  // y + q z = a + t (x + p z) by least squares; z = 0 … 75, x = 0 … 60.
  const double var_z = 781.25, var_x = 500.0, t = p * q * var_z / (var_x + p * p * var_z),
               s = p * t - q, lean = std::hypot(s, t);
  EXPECT_NEAR(value("Eyy"), -0.01 + q * 37.5 - t * (30.0 + p * 37.5), 1e-9);
  EXPECT_NEAR(value("Eyx"), -s * std::atan(lean) / lean / rad_per_deg, 1e-9);
  // YZ has the normal of ZX × that of XY, and passes through the mean of its points.
  const double x = 1.0 - s * q, y = s * p + t, z = t * q + p, turn = std::hypot(y, z) / x;
  EXPECT_NEAR(value("Exx"), 0.03 + 0.002 * 37.5 + (y * 37.5 + z * 30.0) / x, 1e-9);
  EXPECT_NEAR(value("Exz"), y / x * std::atan(turn) / turn / rad_per_deg, 1e-9);
  EXPECT_EQ(json.at("inputs").size(), 4U);
  EXPECT_TRUE(json.at("setup").at("X0W").at("u").is_number());
  expect_input_error("setup datums d.toml --json xy.csv", "xy.csv: is an input of this command");
}

/// Six locators of a part of 105 x 68 mm that lies as `placed` says.
std::string locators_file(const std::function<Vector3(Vector3)>& placed) {
  constexpr Vector3 ideal[] = {{15, 12, 0}, {105, 12, 0}, {60, 68, 0},
                               {20, 0, 12}, {100, 0, 12}, {0, 40, 12}};
  std::string text;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector3 &a = ideal[i], b = placed(a);
    const auto list = [](const Vector3& p) {
      return "[" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " +
             std::to_string(p[2]) + "]";
    };
    text += std::string("[[locator]]\nname = \"") + "ABCDEF"[i] + "\"\nideal_mm = " + list(a) +
            "\nmeasured_mm = " + list(b) + "\nu_um = 1\n";
  }
  return text;
}

// Shifted by (0.2, -0.1, 0.15) mm and turned by 2 mrad about Z, then written wrongly.
TEST_F(FixtureCommand, LocatorsWrittenWronglyAreRefused) {
  const auto written = [](const std::function<void(Vector3&)>& wrongly) {
    return locators_file([&](Vector3 p) {
      Vector3 q{p[0] - 2e-3 * p[1] + 0.2, p[1] + 2e-3 * p[0] - 0.1, p[2] + 0.15};
      wrongly(q);
      return q;
    });
  };
  const auto refused = [&](const std::function<void(Vector3&)>& wrongly, const char* words) {
    file("l.toml", written(wrongly));
    const CommandStreams done = command("setup locators l.toml -o e.toml");
    EXPECT_EQ(done.exit_code, 3) << words;
    EXPECT_TRUE(contains(done.err, words)) << words << '\n' << done.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "e.toml"));
  };
  refused([](Vector3& p) { std::swap(p[0], p[1]); }, "X and Y of the measured tips are exchanged");
  for (const int k : {0, 1, 2})
    refused([k](Vector3& p) { p[static_cast<std::size_t>(k)] *= -1.0; },
            (std::string(1, "XYZ"[k]) + " of the measured tips has the wrong sign").c_str());
  refused([](Vector3& p) { p[0] += 100.0, p[1] += 50.0; }, "X0W = 100.2 mm");
  refused([](Vector3& p) { p = {-p[0], -p[1], p[2]}; }, "a tip was measured 2");
  file("l.toml", written([](Vector3& p) { p[0] += 100.0; }));
  EXPECT_EQ(command("setup locators l.toml -o e.toml --large-errors").exit_code, 0);
  EXPECT_TRUE(contains(read_text(folder_ / "e.toml"), "large_errors = true"));
}

TEST_F(FixtureCommand, DatumsFarOffOrExchangedAreRefused) {
  file("far.toml", "[xy]\nEzz_mm = 110\n");
  const CommandStreams far = command("setup datums far.toml");
  EXPECT_EQ(far.exit_code, 3);
  EXPECT_TRUE(contains(far.err, "Z0W = -110 mm")) << far.err;
  std::string xy = "x[mm],y[mm],z[mm]\n", zx = xy, yz = xy;
  for (const char* const a : {"10", "50", "90"})
    for (const char* const b : {"5", "20"}) {
      xy += std::string(a) + "," + b + ",0.001\n";
      zx += std::string(a) + ",0.002," + b + "\n";
      yz += std::string("0.003,") + a + "," + b + "\n";
    }
  file("xy.csv", xy), file("zx.csv", zx), file("yz.csv", yz);
  file("d.toml",
       "[xy]\npoints = \"xy.csv\"\n[zx]\npoints = \"yz.csv\"\n[yz]\npoints = \"zx.csv\"\n");
  const CommandStreams done = command("setup datums d.toml");
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(contains(done.err, "the points lie along the plane YZ, not ZX")) << done.err;
  EXPECT_TRUE(contains(done.err, "files of YZ and ZX, or two columns, are exchanged"));
}

}  // namespace
}  // namespace trueaxis::testing
