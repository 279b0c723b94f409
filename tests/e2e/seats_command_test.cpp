// SPDX-License-Identifier: Apache-2.0
// Several seats in one stream and in one job without a target: found, answered each, compared. The
// shaft is written here: every section a circle about a point that moves along Z.
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <regex>
#include <set>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

struct Point {
  double x_mm, y_mm;
};

constexpr double shoulder_mm = 25.0;
Point axis_a(double z) { return {0.08 + 1e-4 * z, -0.02}; }
Point axis_b(double z) { return {0.10, -0.05 + 2e-4 * (z - shoulder_mm)}; }

/// A helix of 0.5 mm from Z 0 to 50 mm with 1 µm of noise.
std::string helix(const std::function<double(double z_mm)>& radius_mm,
                  const std::function<Point(double z_mm)>& axis) {
  std::mt19937_64 random(27);
  std::normal_distribution<double> noise(0.0, 1e-3);
  std::vector<PartReading> readings;
  constexpr int per_turn = 72, turns = 100;
  for (int i = 0; i <= turns * per_turn; ++i) {
    const double z = 0.5 * i / per_turn, c_deg = 360.0 * i / per_turn;
    const double c = c_deg * std::numbers::pi / 180.0, r = radius_mm(z);
    const auto [x, y] = axis(z);
    const double across = y * std::cos(c) - x * std::sin(c);
    readings.push_back(
        {x * std::cos(c) + y * std::sin(c) + std::sqrt(r * r - across * across) + noise(random),
         c_deg, z});
  }
  return "# x_convention: radius\n" + csv(readings);
}

std::string two_diameters() {
  return helix([](double z) { return z < shoulder_mm ? 20.0 : 22.5; },
               [](double z) { return z < shoulder_mm ? axis_a(z) : axis_b(z); });
}

double apart_mm(double z) {
  const Point a = axis_a(z), b = axis_b(z);
  return std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm);
}

/// 3 u: of some ten values none is beyond it in 97 of 100; the seed is fixed.
void expect_holds(const json& estimate, double truth, const std::string& what) {
  const double u = estimate.at("u");
  EXPECT_GT(u, 0.0) << what;
  EXPECT_NEAR(estimate.at("value").get<double>(), truth, 3 * u) << what;
}

class SeatsCommand : public CommandTest {
 protected:
  void expect_distance(const json& found) {
    ASSERT_EQ(found.at("seats_apart").size(), 1u);
    const json& pair = found.at("seats_apart")[0];
    const double angle_deg = std::hypot(-1e-4, 2e-4) * 180 / std::numbers::pi;
    expect_holds(pair.at("angle"), angle_deg, "angle");
    for (const json& at : pair.at("at")) {
      const json& middle = at.at("in_its_middle");
      expect_holds(middle.at("offset"), apart_mm(middle.at("z").at("value")), "offset");
      const bool first = at.at("reference") == "A";
      const double low = first ? 0.0 : shoulder_mm, high = first ? shoulder_mm : 50.0;
      expect_holds(at.at("coaxiality_about_the_other"), 2 * std::max(apart_mm(low), apart_mm(high)),
                   "coaxiality");
    }
    for (const json& reference : found.at("references"))
      for (const json& end : reference.at("axis").at("ends")) {
        const double z = end.at("z").at("value");
        const Point truth = reference.at("name") == "A" ? axis_a(z) : axis_b(z);
        expect_holds(end.at("offset"), std::hypot(truth.x_mm, truth.y_mm), "eccentricity");
      }
  }
};

TEST_F(SeatsCommand, RunTakesEverySeatOfAStream) {
  file("shaft.csv", two_diameters());
  const CommandStreams done = command("run shaft.csv -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json found = result("out/result.json");
  ASSERT_EQ(found.at("references").size(), 2u);
  EXPECT_EQ(found.at("references")[0].at("fit").at("surface"), "cylinder");
  expect_distance(found);
  for (const char* said : {"seat   A, a cylinder", "seat   B, a cylinder", "tap    A runs out",
                           "offset ", "apart  B from A: ", " coaxiality ", "a shoulder"})
    EXPECT_TRUE(contains(done.out, said)) << said << '\n' << done.out;
  EXPECT_TRUE(contains(read_text(folder_ / "out/report.html"), "\"seats_apart\""));
  // The first line has the number.
  std::smatch first;
  const std::string line = done.out.substr(0, done.out.find('\n'));
  ASSERT_TRUE(std::regex_search(
      line, first,
      std::regex("; ([0-9.]+) ± ([0-9.]+) µm between the axes of A and B at Z ([0-9.]+) mm")))
      << line;
  EXPECT_NEAR(std::stod(first[1]), 1000.0 * apart_mm(std::stod(first[3])), std::stod(first[2]))
      << line;
}

/// Two diameters on one axis, of a part that slips by 25 µm at a Z, with a time of every reading.
std::string slipped_at(double slip_z_mm) {
  std::istringstream lines(helix([](double z) { return z < shoulder_mm ? 20.0 : 22.5; },
                                 [&](double z) {
                                   const double by = z < slip_z_mm ? 0.0 : 0.025;
                                   return Point{0.08 + 1e-4 * z + by, -0.02};
                                 }));
  std::string out;
  int reading = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_reading = std::isdigit(static_cast<unsigned char>(line.front())) != 0;
    out += line +
           (line[0] == '#' ? "" : "," + (is_reading ? std::to_string(0.01 * reading++) : "t")) +
           '\n';
  }
  return out;
}

// A slip between two seats is an offset of one from the other, which no reading tells apart.
TEST_F(SeatsCommand, ASlipBetweenTwoSeatsLooksLikeAnOffset) {
  file("between.csv", slipped_at(shoulder_mm));
  const CommandStreams done = command("run between.csv -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const json apart = result("out/result.json").at("seats_apart").at(0);
  EXPECT_EQ(apart.at("slip_looks_alike"), true);
  EXPECT_TRUE(contains(done.out, "the part slipped between A and B")) << done.out;
}

// Where the first seat was is not known after a slip during the second: no axis, no distance. A
// seat that the times put after the slip is where it was probed.
TEST_F(SeatsCommand, ASeatFromBeforeASlipIsNotKnown) {
  file("late.csv", slipped_at(37.0));
  const CommandStreams late = command("run late.csv -o late");
  EXPECT_EQ(late.exit_code, 1) << late.out;
  EXPECT_TRUE(late.out.starts_with("NOT PROVEN: the part slipped while B was probed")) << late.out;
  const json found = result("late/result.json");
  EXPECT_EQ(found.value("seats_apart", json::array()).size(), 0u);
  EXPECT_FALSE(contains(late.out, "tap    A")) << late.out;
  EXPECT_FALSE(contains(late.out, "apart  ")) << late.out;

  file("early.csv", slipped_at(12.0));
  const CommandStreams early = command("run early.csv -o early");
  ASSERT_EQ(early.exit_code, 0) << early.out << early.err;
  // Nor is the first seat drawn on the page after the late slip: an ellipse of U at either end.
  const auto ellipses = [&](const char* name) {
    const std::string page = read_text(folder_ / name);
    const std::regex ellipse("\"ellipse\"");
    return std::distance(std::sregex_iterator(page.begin(), page.end(), ellipse), {});
  };
  EXPECT_EQ(ellipses("late/report.html"), ellipses("early/report.html") - 2);
  const json apart = result("early/result.json").at("seats_apart").at(0);
  EXPECT_EQ(apart.at("slip_looks_alike"), false);
  for (const json& at : apart.at("at"))
    expect_holds(at.at("in_its_middle").at("offset"), 0.0, "offset");
}

// 2e-4 and 1e-4 of slope are some hundredths of a degree, to the digits of the screen.
TEST_F(SeatsCommand, TheScreenHasTheTiltInDegrees) {
  file("shaft.csv", two_diameters());
  const CommandStreams done = command("run shaft.csv -o out");
  const std::regex tilt("tilt ([0-9.]+) ± ([0-9.]+) °");
  std::vector<double> seen;
  for (std::sregex_iterator at(done.out.begin(), done.out.end(), tilt), end; at != end; ++at) {
    const double size_deg = (seen.empty() ? 1e-4 : 2e-4) * 180 / std::numbers::pi;
    EXPECT_NEAR(std::stod((*at)[1]), size_deg, std::stod((*at)[2])) << done.out;
    seen.push_back(size_deg);
  }
  EXPECT_EQ(seen.size(), 2u) << done.out;
}

TEST_F(SeatsCommand, AJobTakesRangesOfOneFileOrTwoFiles) {
  file("shaft.csv", two_diameters());
  const std::string
      a = "[[reference]]\nname = \"A\"\nstream = \"shaft.csv\"\nsurface = \"cylinder\"\n",
      b = "[[reference]]\nname = \"B\"\nstream = \"shaft.csv\"\nsurface = \"cylinder\"\n";
  file("ranges.toml", a + "z_to_mm = 24.9\n" + b + "z_from_mm = 25.1\n");
  const CommandStreams done = command("run ranges.toml -o ranges");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  expect_distance(result("ranges/result.json"));
  // 72 readings a turn of 0.5 mm, the first at Z 0: those up to 24.9 mm stay.
  const int kept = static_cast<int>(24.9 / 0.5 * 72) + 1;
  EXPECT_EQ(result("ranges/result.json").at("references")[0].at("fit").at("points"), kept);
  EXPECT_TRUE(contains(done.out, std::to_string(7201 - kept) + " of 7201 readings are excluded"))
      << done.out;

  file("a.csv", helix([](double) { return 20.0; }, axis_a));
  file("b.csv", helix([](double) { return 22.5; }, axis_b));
  file("two.toml", std::regex_replace(a, std::regex("shaft"), "a") + "z_to_mm = 25\n" +
                       std::regex_replace(b, std::regex("shaft"), "b") + "z_from_mm = 25\n");
  ASSERT_EQ(command("run two.toml -o two").exit_code, 0);
  expect_distance(result("two/result.json"));

  file("twice.toml", a + b + "z_from_mm = 25.1\n");
  expect_input_error("run twice.toml -o out", "z_from_mm, z_to_mm");
  file("turned.toml", a + "z_from_mm = 20\nz_to_mm = 10\n");
  expect_input_error("run turned.toml -o out", "is not above z_from_mm");
  file("empty.toml", a + "z_from_mm = 70\n");
  expect_input_error("run empty.toml -o out", "has no reading at Z from 70 mm");
}

// Neither stream was fitted as the other feature before the two were compared.
TEST_F(SeatsCommand, AShaftAndABoreThatSaySo) {
  file("cone.csv", "# feature: shaft\n" + helix([](double z) { return 20.0 + 0.1 * z; }, axis_a));
  file("bore.csv", "# feature: bore\n" + helix([](double) { return 15.0; }, axis_b));
  file("job.toml",
       "[[reference]]\nname = \"A\"\nstream = \"cone.csv\"\nsurface = \"cone\"\n"
       "[[reference]]\nname = \"B\"\nstream = \"bore.csv\"\nsurface = \"cylinder\"\n"
       "feature = \"bore\"\n");
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(result("out/result.json").at("seats_apart").size(), 1u);
}

TEST_F(SeatsCommand, OneSurfaceOverAShoulderIsRefusedWithItsRanges) {
  file("shaft.csv", two_diameters());
  file("job.toml", "[[reference]]\nstream = \"shaft.csv\"\nsurface = \"cylinder\"\n");
  const std::string why =
      "shaft.csv: is not one cylinder: the radius steps by +2.5 mm at Z 25 mm, a shoulder. A jump "
      "at the same C and another Z is the shape of the part, not a slip";
  for (const char* asked :
       {"fit shaft.csv --surface cylinder", "diagnose shaft.csv --surface cylinder --json d.json",
        "run shaft.csv --surface cylinder -o out", "run job.toml -o out", "form shaft.csv",
        "fit shaft.csv --surface cylinder --criterion minimum_zone"})
    expect_input_error(asked, why);
  expect_input_error("fit shaft.csv --surface cylinder", "--z-from-mm 0 --z-to-mm 24.99");
  expect_input_error("run job.toml -o out", "z_from_mm = 25, z_to_mm = 50");
  const CommandStreams one =
      command("fit shaft.csv --surface cylinder --z-from-mm 25 --json f.json");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  expect_holds(result("f.json").at("parameters").at("radius"), 22.5, "radius");
}

TEST_F(SeatsCommand, AConeBehindACylinderIsASeatOfItsOwn) {
  constexpr double taper = 7.0 / 48;
  file("spindle.csv", helix([](double z) { return 20 + taper * std::max(0.0, z - 25); }, axis_a));
  const CommandStreams done = command("run spindle.csv -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json found = result("out/result.json").at("references");
  ASSERT_EQ(found.size(), 2u) << done.out;
  EXPECT_EQ(found[0].at("fit").at("surface"), "cylinder");
  EXPECT_EQ(found[1].at("fit").at("surface"), "cone");
  expect_holds(found[1].at("fit").at("parameters").at("half_angle"),
               std::atan(taper) * 180 / std::numbers::pi, "half angle");
  expect_input_error("fit spindle.csv --surface cone", "the taper changes by 8.3° at Z 25 mm");
}

TEST_F(SeatsCommand, ImportBeginsAJobOfEverySeat) {
  file("shaft.csv", two_diameters());
  const CommandStreams done = command("import shaft.csv -o imported.csv");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  ASSERT_EQ(command("run imported.toml -o out").exit_code, 0);
  expect_distance(result("out/result.json"));
}

/// Every number of a text with the half of its last digit.
std::set<double> numbers_of(const std::string& text) {
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
  std::set<double> out;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at)
    out.insert(std::stod(at->str()));
  return out;
}

/// Quantities {value, u} of a result that are nowhere among the numbers of a page: rounded to two
/// digits of u (at most u/10 off), without u to six.
void expect_all_there(const json& part, const std::set<double>& shown, std::size_t& count) {
  if (part.is_object() && part.contains("value") && part["value"].is_number()) {
    const double value = part["value"];
    const double u = part.contains("u") && part["u"].is_number() ? part["u"].get<double>() : 0.0;
    const double off = std::max({6e-6 * std::abs(value), u / 10, 1e-300});
    const auto found = shown.lower_bound(value - off);
    EXPECT_TRUE(found != shown.end() && *found <= value + off) << part.dump();
    ++count;
  } else if (part.is_structured()) {
    for (const json& one : part) expect_all_there(one, shown, count);
  }
}

TEST_F(SeatsCommand, TheReportHasAllNumbersWithoutAScript) {
  file("shaft.csv", two_diameters());
  ASSERT_EQ(command("run shaft.csv -o out").exit_code, 0);
  const std::string page = read_text(folder_ / "out/report.html");
  const std::string main =
      page.substr(page.find("<main"), page.find("</main>") - page.find("<main"));
  EXPECT_EQ(main.find("<script"), std::string::npos);
  const json found = result("out/result.json");
  EXPECT_TRUE(contains(main, found.at("verdict").at("line").get<std::string>()));
  std::size_t count = 0;
  expect_all_there(found, numbers_of(main), count);
  EXPECT_GT(count, 100u);
  EXPECT_LT(main.size(), 200'000u);  // of a page of 1.6 MB
}

}  // namespace
}  // namespace trueaxis::testing
