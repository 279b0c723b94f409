// SPDX-License-Identifier: Apache-2.0
// Tables as people write them, and as their programs leave them: headers of many languages, rows
// without a value, a lost decimal point, a keyway. Readings are formulas of this file, with a noise
// of ±0.3 µm, evenly distributed: σ = 0.3/√3 = 0.17 µm. The offset of the axis is then known to
// σ √(2/N), 0.009 µm for N = 720; tolerances are six times that.
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <regex>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

constexpr double x0_mm = 0.02, radius_mm = 25.0;
constexpr double sixfold_mm = 6.0 * 0.17e-3 * std::numbers::sqrt2 / 26.8;  // N = 720

/// An even noise of ±0.3 µm: SplitMix64 (Steele, Lea and Flood 2014).
double noise_mm(int i) {
  auto z = 0x9E3779B97F4A7C15ULL * static_cast<unsigned long long>(i + 1);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  z ^= z >> 31U;
  return 0.6e-3 * (static_cast<double>(z >> 11U) * 0x1p-53 - 0.5);
}

class RecordingCommand : public CommandTest {
 protected:
  using Row = std::function<std::string(int i, double x_mm, double c_deg, double z_mm)>;

  static double reading_mm(int i) {
    return radius_mm + x0_mm * std::cos(2.0 * std::numbers::pi * i / 72.0) + noise_mm(i);
  }
  static std::string plain(int, double x_mm, double c_deg, double z_mm) {
    char line[96];
    std::snprintf(line, sizeof line, "%.6f,%.1f,%.4f", x_mm, c_deg, z_mm);
    return line;
  }
  /// Ten turns of 72 readings each over 20 mm.
  void shaft(const std::string& name, const Row& row) {
    std::string text = "# x_convention: radius\nX_M[mm],C[deg],Z[mm]\n";
    for (int i = 0; i < 720; ++i) text += row(i, reading_mm(i), 5.0 * i, i / 36.0) + "\n";
    file(name, text);
  }
  /// Of the axis in the middle of its length.
  static double x_of(const nlohmann::json& fit) { return fit.at("axis").at("x").at("value"); }
  /// The last line of the output, without what comes before "trueaxis".
  static std::string command_in(const std::string& said) {
    const std::size_t at = said.rfind("trueaxis ");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + std::string("trueaxis ").size();
    return said.substr(begin, said.find('\n', begin) - begin);
  }
};

struct Header {
  const char *names, *order, *stream;
  const char* rows = nullptr;
};

// order: which of the columns are X, C, Z.
const Header headers[] = {
    {"Winkel C [°];Radius X (mm);Z-Position [mm]", "CXZ", "X_M[mm],C[deg],Z[mm]"},
    {"Spindelwinkel (Grad);Durchmesser [mm];Z-Achse / mm", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"Istwinkel;Halbmesser in Zoll;Z [Zoll]", "CXZ", "X_M[in],C[deg],Z[in]"},
    {"Position angulaire [°];Diamètre (mm);Position Z [mm]", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"Angle de l'axe C (\xB0);Diam\xE8tre (mm);Position Z", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"Rayon mesuré [\u00B5m];Angle broche [degrés];Z", "XCZ", "X_M[um],C[deg],Z[mm]"},
    {"Angolo [gradi];Diametro [mm];Posizione Z (mm)", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"Raggio (mm);Angolo mandrino [°];Posizione asse Z", "XCZ", "X_M[mm],C[deg],Z[mm]"},
    {"Ángulo [rad];Radio (mm);Posición Z", "CXZ", "X_M[mm],C[rad],Z[mm]"},
    {"DIÁMETRO;ANGULO HUSILLO;POSICION Z", "XCZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"角度[°];直径[mm];Z位置[mm]", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"主軸角度（°）;半径（mm）;Ｚ軸位置", "CXZ", "X_M[mm],C[deg],Z[mm]"},
    {"Kąt [°];Średnica [mm];Pozycja Z [mm]", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"Úhel [°];Poloměr [mm];Poloha Z [mm]", "CXZ", "X_M[mm],C[deg],Z[mm]"},
    {"Ângulo (graus);Raio (mm);Posição Z (mm)", "CXZ", "X_M[mm],C[deg],Z[mm]"},
    {"angle_deg;diameter_mm;z_mm", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"\xEF\xBB\xBF\"angle, deg\";\"radius, um\";\"axial position, mm\"", "CXZ",
     "X_M[um],C[deg],Z[mm]"},
    {"WINKEL °;Ø X;Z-Achse", "CXZ", "X_M[mm dia],C[deg],Z[mm]"},
    {"Angle (C);Position X (Radius) [µm];Z", "CXZ", "X_M[um],C[deg],Z[mm]"},
};

TEST_F(RecordingCommand, HeadersAsPeopleWriteThem) {
  const double values[][3] = {{50.125, 1.5, 3.25}, {50.0, 2.5, 3.5}, {49.875, 3.75, 4.25}};
  for (const Header& header : headers) {
    const std::string order = header.order;
    std::string text = std::string(header.names) + "\n", rows;
    for (const auto& [x, c, z] : values) {
      char line[96];
      for (std::size_t k = 0; k < 3; ++k) {
        std::snprintf(line, sizeof line, "%g", order[k] == 'X' ? x : order[k] == 'C' ? c : z);
        std::string cell = line;
        std::ranges::replace(cell, '.', ',');
        if (k > 0) text += ';';
        text += cell;
      }
      text += "\n";
      std::snprintf(line, sizeof line, "%g,%g,%g\n", x, c, z);
      rows += line;
    }
    file("table.csv", text);
    const CommandStreams done = command("import table.csv -o - --force");
    ASSERT_EQ(done.exit_code, 0) << header.names << '\n' << done.err;
    EXPECT_TRUE(done.out.ends_with(std::string(header.stream) + "\n" + rows))
        << header.names << '\n'
        << done.out;
  }
}

// Nothing of these is clear, so that it is asked for; no language is German alone in the first.
TEST_F(RecordingCommand, WhatMayBeTwoThingsIsAskedFor) {
  const std::pair<const char*, const char*> asked[] = {
      {"Radius;C [Grad];Z", "unit 'Grad', which is not one of deg, rad and rev"},
      {"Winkel;X;Z", "X may be a radius or a diameter"},
      {"Winkel;Radius;Position", "column 3 (Position) does not say of which axis it is"},
      {"Winkel;Radius;Länge [mm]", "column 3 (Länge [mm]) does not say of which axis it is"},
      {"Angle;Radius;Diameter", "could both be X"},
      {"Angle;X deviation;Z", "no column is called X"},
      {"Angle;Rx;Z", "no column is called X"},
      {"Winkel X;Radius;Z", "no column is called C"}};
  for (const auto& [names, why] : asked) {
    file("table.csv", std::string(names) + "\n0,5;50,1;3\n1,5;50,2;4\n2,5;50,3;5\n");
    expect_input_error("import table.csv -o out.csv", why);
  }
}

TEST_F(RecordingCommand, TheCommandThatWasTypedIsProposedAndRuns) {
  std::string text = "Winkel;X;Position [mm]\n";
  for (int i = 0; i < 720; ++i) {
    char line[96];
    std::snprintf(line, sizeof line, "%.1f;%.6f;%.4f\n", 5.0 * i, reading_mm(i), i / 36.0);
    text += line;
  }
  file("my part's.csv", text);
  const std::string typed = "fit \"my part's.csv\" --surface cylinder --noise-um 0.2 --json r.json";
  const CommandStreams asked = command(typed);
  ASSERT_EQ(asked.exit_code, 3);
  EXPECT_TRUE(contains(asked.err,
                       "trueaxis fit 'my part'\\''s.csv' --surface cylinder --noise-um 0.2 "
                       "--json r.json --columns X=2,C=1,Z=3 --diameter (or --radius)"))
      << asked.err;
  std::string proposed = command_in(asked.err);
  proposed = proposed.substr(0, proposed.find(" --diameter"));
  const CommandStreams done = command(proposed + " --radius");
  ASSERT_EQ(done.exit_code, 0) << proposed << '\n' << done.err;
  EXPECT_NEAR(x_of(result("r.json")), x0_mm, sixfold_mm);
  EXPECT_TRUE(contains(done.out + "\n", "trueaxis diagnose 'my part'")) << done.out;
}

// The lines of a job are asked for where a job was given.
TEST_F(RecordingCommand, AJobIsAskedForItsLines) {
  file("t.csv", "Winkel;X;Z\n0,5;50,1;3\n1,5;50,2;4\n2,5;50,3;5\n");
  file("job.toml", "[[reference]]\nstream = \"t.csv\"\nsurface = \"cylinder\"\n");
  expect_input_error("run job.toml -o out",
                     "columns = 'X=2,C=1,Z=3', x_convention = \"diameter\" (or \"radius\")");
}

std::string with_mistakes(int i, const std::string& good, const std::string& behind) {
  const std::map<int, std::string> wrong{{5, "NaN"},  {17, "#WERT!"},  {40, ""},
                                         {41, "n/a"}, {42, "#DIV/0!"}, {300, "#N/A"}};
  const auto at = wrong.find(i);
  return at == wrong.end() ? good : at->second + behind;
}

TEST_F(RecordingCommand, RowsWithoutAValueAreLeftOutWhenAsked) {
  shaft("own.csv", [](int i, double x, double c, double z) {
    const std::string good = plain(i, x, c, z);
    return with_mistakes(i, good, good.substr(good.find(',')));
  });
  std::string text = "Radius [mm];Winkel;Z\n";
  for (int i = 0; i < 720; ++i) {
    std::string row = plain(i, reading_mm(i), 5.0 * i, i / 36.0);
    std::ranges::replace(row, ',', ';');
    std::ranges::replace(row, '.', ',');
    text += with_mistakes(i, row, row.substr(row.find(';'))) + "\n";
  }
  file("table.csv", text);
  // Row i is in line i + 3 after a comment and the header, in line i + 2 after the header.
  const std::pair<const char*, const char*> files[] = {
      {"own.csv", "6 rows are excluded (--drop-invalid), in lines 8, 20, 43-45, 303"},
      {"table.csv", "6 rows are excluded (--drop-invalid), in lines 7, 19, 42-44, 302"}};
  for (const auto& [name, left] : files) {
    const CommandStreams refused =
        command(std::string("fit ") + name + " --surface cylinder --json r.json --force");
    EXPECT_EQ(refused.exit_code, 3);
    for (const char* word : {"'NaN'", "is empty", "6 rows have no value"})
      EXPECT_TRUE(contains(refused.err, word)) << name << word << refused.err;
    const std::string first = name;  // '#WERT!' at the beginning of a line is not a comment
    if (first == "own.csv") {
      EXPECT_TRUE(contains(refused.err, "own.csv:20:1: X_M: '#WERT!' is not a number"));
    }
    const CommandStreams done = command(command_in(refused.err));
    ASSERT_EQ(done.exit_code, 0) << command_in(refused.err) << done.err;
    // A line of the screen is broken where it ends.
    const std::string out = std::regex_replace(done.out, std::regex("\n +"), " ");
    EXPECT_TRUE(contains(out, left)) << out;
    EXPECT_TRUE(contains(out, "714 readings")) << out;
    EXPECT_NEAR(x_of(result("r.json")), x0_mm, sixfold_mm);
  }
}

// A job says it by a key of the reference; without it the job is refused.
TEST_F(RecordingCommand, AJobLeavesRowsWithoutAValueOutWhenAsked) {
  shaft("own.csv", [](int i, double x, double c, double z) {
    const std::string good = plain(i, x, c, z);
    return with_mistakes(i, good, good.substr(good.find(',')));
  });
  const std::string seat = "[[reference]]\nstream = \"own.csv\"\nsurface = \"cylinder\"\n";
  for (const char* const key : {"", "drop_invalid = false\n"}) {
    file("job.toml", seat + key);
    expect_input_error("run job.toml -o out", "6 rows have no value");
  }
  file("job.toml", seat + "drop_invalid = true\n");
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string out = std::regex_replace(done.out, std::regex("\n +"), " ");
  EXPECT_TRUE(contains(out, "in lines 8, 20, 43-45, 303")) << out;
  const nlohmann::json fit = result("out/result.json").at("references")[0].at("fit");
  EXPECT_EQ(fit.at("points"), 714);
  EXPECT_NEAR(x_of(fit), x0_mm, sixfold_mm);
}

// A sensor whose range ends half-way between the readings at 50 and 55 deg: 21 of 72 read its end.
TEST_F(RecordingCommand, ReadingsAtTheEndOfTheRangeAreExcludedWhenAsked) {
  const double end_mm = radius_mm + x0_mm * std::cos(52.5 * std::numbers::pi / 180.0);
  shaft("flat.csv",
        [&](int i, double x, double c, double z) { return plain(i, std::min(x, end_mm), c, z); });
  for (const std::string typed : {"fit flat.csv --surface cylinder --json r.json --force",
                                  "diagnose flat.csv --surface cylinder --json r.json --force",
                                  "run flat.csv -o out --force"}) {
    const CommandStreams refused = command(typed);
    EXPECT_EQ(refused.exit_code, 1) << typed << refused.out;
    EXPECT_TRUE(contains(refused.out + refused.err, "210 readings are at 25.012175 mm")) << typed;
  }
  double ones = 0.0, c1 = 0.0, c2 = 0.0;  // of radius and x0; y0 and the tilt are square to them
  for (int i = 11; i <= 61; ++i) {
    const double c = std::cos(2.0 * std::numbers::pi * i / 72.0);
    ones += 10.0, c1 += 10.0 * c, c2 += 10.0 * c * c;
  }
  const double sigma_mm = 0.6e-3 / std::sqrt(12.0);
  const double sixfold = 6.0 * sigma_mm * std::sqrt(ones / (ones * c2 - c1 * c1));
  const CommandStreams done =
      command("fit flat.csv --surface cylinder --drop-invalid --json r.json --force");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(result("r.json").at("points"), 510);
  EXPECT_NEAR(x_of(result("r.json")), x0_mm, sixfold);
  file("job.toml",
       "[[reference]]\nstream = \"flat.csv\"\nsurface = \"cylinder\"\ndrop_invalid = true\n");
  const CommandStreams job = command("run job.toml -o out --force");
  EXPECT_EQ(job.exit_code, 0) << job.out << job.err;
  EXPECT_NEAR(x_of(result("out/result.json").at("references")[0].at("fit")), x0_mm, sixfold);
}

// Half of the rows are not a slip of a spreadsheet, and a decimal comma is a value.
TEST_F(RecordingCommand, RowsAreNotLeftOutThatShouldNotBe) {
  shaft("half.csv", [](int i, double x, double c, double z) {
    const std::string good = plain(i, x, c, z);
    return i % 2 == 0 ? std::string("NaN").append(good.substr(good.find(','))) : good;
  });
  expect_input_error("fit half.csv --surface cylinder --drop-invalid", "too many to exclude them");
  // A name that is wrong is the mistake, not rows of which all others have values.
  file("name.csv", "X_M,Angle,Z\nnan,0,1\n25.2,90,2\n25.3,180,3\n25.2,270,4\n");
  const CommandStreams name = command("fit name.csv --surface cylinder --radius --drop-invalid");
  EXPECT_NE(name.err.find("unknown column 'Angle'"), std::string::npos) << name.err;
  EXPECT_EQ(name.err.find("too many"), std::string::npos) << name.err;
  file("comma.csv", "X_M[mm];C[deg];Z[mm]\n25.1;0;1\n25,2;90;2\n25.3;180;3\n25.2;270;4\n");
  expect_input_error("fit comma.csv --surface section --radius --drop-invalid", "25,2");
}

// The reading at 200°: 25 + 0.02 cos 200° = 24.981 mm.
TEST_F(RecordingCommand, ALostDecimalPointIsNamedByItsRow) {
  shaft("gross.csv", [](int i, double x, double c, double z) {
    return plain(i, i == 400 ? 100.0 * x : x, c, z);
  });
  for (const char* typed : {"fit gross.csv --surface cylinder", "run gross.csv -o out"}) {
    const CommandStreams done = command(typed);
    EXPECT_NE(done.exit_code, 0) << typed;
    EXPECT_TRUE(contains(done.out + done.err, "row 401 reads 2498")) << done.out << done.err;
    EXPECT_TRUE(contains(done.out + done.err, "--loss tukey")) << done.out << done.err;
    EXPECT_FALSE(contains(done.out + done.err, "probe more of the length")) << done.out;
  }
  const CommandStreams robust =
      command("fit gross.csv --surface cylinder --loss tukey --json r.json");
  ASSERT_EQ(robust.exit_code, 0) << robust.err;
  EXPECT_TRUE(contains(robust.out, "1 excluded as outliers (row 401")) << robust.out;
  EXPECT_NEAR(x_of(result("r.json")), x0_mm, 1.05 * sixfold_mm);  // Tukey's weights: 95 %
}

// 18° of the circumference, 4 readings of each of ten turns: 80, 85, 90 and 95°.
TEST_F(RecordingCommand, AKeywayIsSaidOnTheScreen) {
  shaft("key.csv", [](int i, double x, double c, double z) {
    const double at = std::fmod(c, 360.0);
    return plain(i, at >= 80.0 && at < 98.0 ? x - 3.0 : x, c, z);
  });
  for (const char* typed : {"diagnose key.csv --surface cylinder", "run key.csv -o out"}) {
    const CommandStreams done = command(typed);
    EXPECT_TRUE(contains(done.out, "40 readings at C 80-95° excluded")) << done.out;
  }
}

// Two short seats 100 mm apart know the axis between them better together than each alone.
TEST_F(RecordingCommand, ATargetBetweenTwoSeatsAsksForTheirDatumOnce) {
  for (const auto& [name, z_mm] : {std::pair("a.csv", 0.0), std::pair("b.csv", 100.0)})
    shaft(name, [z_mm = z_mm](int i, double x, double c, double z) {
      return plain(i, x, c, z_mm + 0.2 * z);
    });
  const std::string job =
      "[[reference]]\nname = \"A\"\nstream = \"a.csv\"\nsurface = \"cylinder\"\n[[reference]]\n"
      "name = \"B\"\nstream = \"b.csv\"\nsurface = \"cylinder\"\n[target]\nsurface = "
      "\"cylinder\"\nradius_mm = 28\nz_start_mm = 60\nz_end_mm = 50\n"
      "coaxiality_tolerance_um = 20\n";
  const std::string cut = "[cut]\nspeed_rpm = 600\nsense = \"+c\"\nfeed_mm_per_rev = 0.1\n";
  file("job.toml", job + cut);
  const std::string said = command("run job.toml -o out").out;
  const std::string first = said.substr(0, said.find('\n'));
  EXPECT_TRUE(contains(first, "datum = [\"A\", \"B\"] in [target]")) << said;
  EXPECT_FALSE(contains(first, "probe nearer")) << said;
  file("both.toml", job + "datum = [\"A\", \"B\"]\n" + cut);
  EXPECT_FALSE(contains(command("run both.toml -o both").out, "U is extrapolated"));
}

TEST_F(RecordingCommand, AFormAboutTheSpindleSpeaksOfNoDatum) {
  shaft("s.csv", plain);
  const std::string of_spindle = command("form s.csv --upr 1-5").out;
  EXPECT_TRUE(contains(of_spindle, "to the spindle")) << of_spindle;
  EXPECT_FALSE(contains(of_spindle, "to the datum")) << of_spindle;
  shaft("d.csv", [](int i, double x, double c, double z) { return plain(i, x, c, z + 30.0); });
  EXPECT_TRUE(contains(command("form s.csv --datum d.csv --upr 1-5").out, "to the datum"));
}

}  // namespace
}  // namespace trueaxis::testing
