// SPDX-License-Identifier: Apache-2.0
// A shipped stream as other programs write it, imported: the axis is that of the stream.
//
// Tolerance: a column written with d decimals moves no reading by more than r = 10^-d/2 (a diameter
// r/2). The mean of N readings times 2 cos C, which x0 at mid length is, moves by at most
// 4/π r < 2 r; so does the radius. An angle rounded by δ moves a reading by no more than 2 δ times
// the eccentricity, which is added.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "recording/import.hpp"
#include "recording/recording.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

constexpr double deg_per_rad = 180.0 / std::numbers::pi;

ProbeStream seat() {
  return read_stream_csv(places::source() + "/data/streams/shaft_cylinder_seat.csv");
}

FitResult fitted(const ProbeStream& stream) {
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  return fit(stream, options);
}

/// A producer: what comes before the rows, a row, and what the user says.
struct Producer {
  std::string name, head;
  std::function<std::string(const ProbeStream&, std::size_t)> row;
  RecordingOptions options;
  double rounding_mm = 0.5e-6, rounding_rad = 0.5e-6 / deg_per_rad;
  std::string tail{};
};

std::string with_commas(std::string text) {
  for (char& c : text)
    if (c == '.') c = ',';
  return text;
}

/// Degrees within a turn, as a control shows them.
double shown_deg(const ProbeStream& s, std::size_t i) {
  return std::fmod(s.c_rad[i] * deg_per_rad, 360.0);
}

RecordingOptions said(const std::string& columns, std::optional<bool> diameter = std::nullopt) {
  RecordingOptions options;
  options.columns = columns;
  options.read.diameter = diameter;
  return options;
}

std::vector<Producer> producers() {
  std::vector<Producer> all;
  all.push_back(
      {"german_spreadsheet",
       "Messung Welle "
       "4711;;;;;\r\n;;;;;\r\nNr.;Winkel;Durchmesser;Z;Bemerkung;\r\n;[°];[mm];[mm];;\r\n",
       [](const ProbeStream& s, std::size_t i) {
         return with_commas(fmt::format("{};{:.6f};{:.6f};{:.6f};{};\r\n", i + 1, shown_deg(s, i),
                                        2.0 * s.reading_mm[i], s.position_mm[i],
                                        i == 7 ? "Span" : ""));
       },
       {}});
  all.push_back({"quoted_headers", "\"Time (s)\",\"C (deg)\",\"X (mm)\",\"Z (mm)\"\n",
                 [](const ProbeStream& s, std::size_t i) {
                   return fmt::format("{:.4f},{:.6f},{:.6f},{:.6f}\n", s.time_s[i], shown_deg(s, i),
                                      s.reading_mm[i], s.position_mm[i]);
                 },
                 said("", false)});
  all.push_back({"names_said", "Export\nPoint\tDiameter\tAngle(°)\tWhere\n",
                 [](const ProbeStream& s, std::size_t i) {
                   return fmt::format("{}\t{:.6f}\t{:.6f}\t{:.6f}\n", i, 2.0 * s.reading_mm[i],
                                      shown_deg(s, i), s.position_mm[i]);
                 },
                 said("X=Diameter,C=Angle(°),Z=4[mm]")});
  all.push_back({"units_said_of_names", "Dia,Angle,Where\n",
                 [](const ProbeStream& s, std::size_t i) {
                   return fmt::format("{:.3f},{:.6f},{:.6f}\n", 2000.0 * s.reading_mm[i],
                                      std::fmod(s.c_rad[i], 2.0 * std::numbers::pi),
                                      s.position_mm[i]);
                 },
                 said("X=Dia[um],C=Angle[rad],Z=Where[mm]"), 0.5e-6, 0.5e-6});
  // As LinuxCNC 2.9 wrote one: nine numbers, no header, whatever axes there are.
  all.push_back({"linuxcnc_probeopen", "",
                 [](const ProbeStream& s, std::size_t i) {
                   return fmt::format("{:f} {:f} {:f} {:f} {:f} {:f} {:f} {:f} {:f}\n",
                                      s.reading_mm[i], 0.0, s.position_mm[i], 0.0, 0.0,
                                      s.c_rad[i] * deg_per_rad, 0.0, 0.0, 0.0);
                 },
                 said("X=1[mm],C=6[deg],Z=3[mm]", false)});
  all.push_back({"halsampler", "",
                 [](const ProbeStream& s, std::size_t i) {
                   return std::string(i == 40 ? "overrun\n" : "") +
                          fmt::format("{} {:f} {:f} {:f} \n", i, s.c_rad[i] * deg_per_rad,
                                      s.reading_mm[i], s.position_mm[i]);
                 },
                 said("X=3[mm],C=2[deg],Z=4[mm]", false)});
  // Haas: DPRNT[X#1[34]*C#2[44]*Z#3[44]]: blanks for leading zeros.
  all.push_back({"dprnt", "POINT   1\r\n",
                 [](const ProbeStream& s, std::size_t i) {
                   return fmt::format("X{:9.4f} C{:9.4f} Z{:9.4f}\r\n", 2.0 * s.reading_mm[i],
                                      shown_deg(s, i), s.position_mm[i]);
                 },
                 said("", true), 0.25e-4, 0.5e-4 / deg_per_rad, "END\r\n"});
  all.push_back({"epics_camonitor", "",
                 [](const ProbeStream& s, std::size_t i) {
                   const std::string at = fmt::format("2026-02-22 13:{:02d}:{:09.6f}",
                                                      static_cast<int>(s.time_s[i] / 60.0),
                                                      std::fmod(s.time_s[i], 60.0));
                   return fmt::format(
                       "LATHE:X {0} {1:.6f}\nLATHE:C {0} {2:.6f}\nLATHE:Z {0} {3:.6f}\n", at,
                       s.reading_mm[i], shown_deg(s, i), s.position_mm[i]);
                 },
                 said("", false)});
  all.push_back(
      {"twincat_scope",
       "Name;Lathe;\nFile;lathe.tcscopex;\nStarttime of export;133500000000000000;Monday, February "
       "22, 2026;13:55\n"
       "Endtime of export;133500000600000000;Monday, February 22, 2026;13:56\n\nTriggerGroup;0;\n\n"
       "Name;X;C;Z;\nSymbolComment;;;;\nData-Type;REAL64;REAL64;REAL64;\nSampleTime;10;10;10;\n"
       "Unit;mm;°;mm;\nScaleFactor;0,5;1;1;\nOffset;0;0;0;\n",
       [](const ProbeStream& s, std::size_t i) {
         return with_commas(fmt::format("{};{:.6f};{:.6f};{:.6f};\n",
                                        133500000000000000LL + std::llround(1e7 * s.time_s[i]),
                                        2.0 * s.reading_mm[i], shown_deg(s, i), s.position_mm[i]));
       },
       said("", false)});
  // A point off the probe line: (X, Y) at C is the reading hypot(X, Y) at C + atan(Y/X).
  all.push_back({"points_with_the_rotary_angle",
                 "X[mm],Y[mm],Z[mm],C[deg]\n",
                 [](const ProbeStream& s, std::size_t i) {
                   const double off_deg = 3.0 + static_cast<double>(i % 5);
                   return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}\n",
                                      s.reading_mm[i] * std::cos(off_deg / deg_per_rad),
                                      s.reading_mm[i] * std::sin(off_deg / deg_per_rad),
                                      s.position_mm[i], s.c_rad[i] * deg_per_rad - off_deg);
                 },
                 {},
                 1e-6});
  return all;
}

class RecordingFormats : public ::testing::TestWithParam<Producer> {
 protected:
  void SetUp() override {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::path(places::scratch()) / "recording" / fs::path(test).filename();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::string put(const std::string& text) const {
    const std::string path = (folder_ / "recording.txt").string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  fs::path folder_;
};

TEST_P(RecordingFormats, GivesTheAxisOfTheStream) {
  const ProbeStream stream = seat();
  std::string text = GetParam().head;
  for (std::size_t i = 0; i < stream.size(); ++i) text += GetParam().row(stream, i);
  const ImportedRecording imported =
      import_recording(put(text + GetParam().tail), GetParam().options);
  ASSERT_EQ(imported.stream.size(), stream.size());

  const FitResult expected = fitted(stream), found = fitted(imported.stream);
  ASSERT_EQ(found.status, FitStatus::converged) << found.message;
  const double z_mm = 0.5 * (expected.position_min_mm + expected.position_max_mm);
  const auto [x, y] = expected.axis.axis.at(z_mm);
  const double tolerance_mm =
      2.0 * GetParam().rounding_mm + 2.0 * GetParam().rounding_rad * std::hypot(x, y) + 1e-9;
  EXPECT_NEAR(found.axis.axis.at(z_mm)[0], x, tolerance_mm);
  EXPECT_NEAR(found.axis.axis.at(z_mm)[1], y, tolerance_mm);
  EXPECT_NEAR(found.parameter("radius").value, expected.parameter("radius").value, tolerance_mm);

  // What is written is a stream that says the same without any option.
  const std::string clean = (folder_ / "stream.csv").string();
  std::ofstream(clean, std::ios::binary) << imported.text;
  const ProbeStream again = read_stream_csv(clean);
  EXPECT_EQ(again.reading_mm, imported.stream.reading_mm);
  EXPECT_EQ(again.c_rad, imported.stream.c_rad);
  EXPECT_EQ(again.position_mm, imported.stream.position_mm);
  EXPECT_EQ(again.x_convention->said_by, SaidBy::stream);
}

INSTANTIATE_TEST_SUITE_P(Producers, RecordingFormats, ::testing::ValuesIn(producers()),
                         [](const auto& producer) { return producer.param.name; });

class RecordingText : public RecordingFormats {};

std::string what_is_said(const std::string& path, const RecordingOptions& options = {}) {
  try {
    read_recording(path, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(RecordingFormats, Utf16OfASpreadsheetIsRead) {
  const std::string text = "Radius\tC[°]\tZ\r\n40,5\t0\t1\r\n40,25\t90\t2\r\n40,75\t180\t3\r\n";
  std::string utf16 = "\xFF\xFE";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (static_cast<unsigned char>(text[i]) == 0xC2U)
      continue;  // of the two bytes of ° the second is its code
    utf16 += text[i];
    utf16 += '\0';
  }
  const ProbeStream stream = read_recording(put(utf16));
  EXPECT_EQ(stream.reading_mm, (std::vector<double>{40.5, 40.25, 40.75}));
}

TEST_F(RecordingFormats, ReadsTheSlowerChannelBetweenItsSamples) {
  std::string text;
  for (int i = 0; i <= 10; ++i) {
    text += fmt::format("A:C 2026-02-22 23:59:{:09.6f} {}\n", 50.0 + i, 30 * i);
    text += fmt::format("A:X 2026-02-22 23:59:{:09.6f} {}\n", 50.0 + i, 40);
    if (i % 5 == 0) text += fmt::format("A:Z 2026-02-22 23:59:{:09.6f} {}\n", 50.0 + i, i);
  }
  const ProbeStream stream = read_recording(put(text), said("", false));
  ASSERT_EQ(stream.size(), 11U);
  for (std::size_t i = 0; i < 11; ++i)
    EXPECT_DOUBLE_EQ(stream.position_mm[i], static_cast<double>(i));
}

TEST_F(RecordingFormats, RadiusOrDiameterIsAsked) {
  const std::string said_of_x = what_is_said(put("X (mm);C (°);Z\n40,5;0;1\n40,25;90;2\n"));
  EXPECT_NE(said_of_x.find("X may be a radius or a diameter"), std::string::npos) << said_of_x;
  EXPECT_NE(
      said_of_x.find("--columns X=1,C=2,Z=3 -o recording_stream.csv --diameter (or --radius)"),
      std::string::npos)
      << said_of_x;
}

TEST_F(RecordingFormats, ColumnsWithoutNamesAreAsked) {
  const std::string message = what_is_said(put("40.5 0 1\n40.25 90 2\n"));
  EXPECT_NE(message.find("1 '40.5' …, 2 '0' …, 3 '1' …"), std::string::npos) << message;
  EXPECT_NE(message.find("--columns X=…,C=…,Z=…"), std::string::npos) << message;
}

TEST_F(RecordingFormats, TwoColumnsForOneAreAsked) {
  const std::string message = what_is_said(put("Radius;Diameter;C;Z\n40;80;0;1\n41;82;90;2\n"));
  EXPECT_NE(message.find("column 1 (Radius) and column 2 (Diameter) could both be X"),
            std::string::npos)
      << message;
}

TEST_F(RecordingFormats, CommasThatAreBothAreRefused) {
  const std::string message = what_is_said(put("Radius,C,Z\n40,5,0,1,1,5\n40,25,90,1,2,5\n"));
  EXPECT_NE(message.find("the rows have 6 numbers and the header 3 names"), std::string::npos)
      << message;
}

TEST_F(RecordingFormats, GradIsNotGuessed) {
  const std::string message = what_is_said(put("Radius;C[Grad];Z\n40,5;0;1\n40,25;90;2\n"));
  EXPECT_NE(message.find("unit 'Grad', which is not one of deg, rad and rev"), std::string::npos)
      << message;
}

TEST_F(RecordingFormats, OneMessageAKindWithItsCount) {
  std::string text = "Radius;C;Z\n";
  for (int i = 0; i < 1000; ++i)
    text += i % 2 == 0 ? "40,5;90;1\n" : i % 4 == 1 ? "n/a;90;1\n" : "40,5;;1\n";
  const std::string message = what_is_said(put(text));
  EXPECT_EQ(std::ranges::count(message, '\n'), 1) << message;
  EXPECT_NE(message.find(":3:1: X: 'n/a' is not a number: correct it, or remove the row (so too in "
                         "249 further places, in lines 7"),
            std::string::npos)
      << message;
  EXPECT_NE(
      message.find("C is empty: write a number or remove the row (so too in 249 further places"),
      std::string::npos)
      << message;
}

TEST_F(RecordingFormats, ARowOfMoreFieldsIsNotCut) {
  const std::string message = what_is_said(put("Radius;C;Z\n40,5;0;1\n40,25;90;2;7\n"));
  EXPECT_NE(message.find(":3:12: the row has 4 fields, the table 3 columns"), std::string::npos)
      << message;
}

TEST_F(RecordingFormats, RowsOfErrorValuesAreNoComments) {
  const std::string message = what_is_said(put("Radius;C;Z\n40,5;0;1\n#DIV/0!;90;2\n40,5;180;2\n"));
  EXPECT_NE(message.find(":3:1: X: '#DIV/0!' is not a number"), std::string::npos) << message;
}

TEST_F(RecordingFormats, ATitleThatSaysInchIsNotPassedOver) {
  const std::string message = what_is_said(put("Units: inch\nRadius;C;Z\n40,5;0;1\n40,5;90;2\n"));
  EXPECT_NE(message.find("a line of the file says 'Units: inch'"), std::string::npos) << message;
}

TEST_F(RecordingFormats, AGaugeStaysAGaugeInTheStreamThatIsWritten) {
  RecordingOptions options = said("", false);
  options.read.indication = Indication::relative;
  options.read.nominal_radius_mm = 20.0;
  const ImportedRecording imported =
      import_recording(put("X;C;Z\n0,5;0;1\n0,4;90;2\n0,6;180;2\n"), options);
  const std::string clean = (folder_ / "stream.csv").string();
  std::ofstream(clean, std::ios::binary) << imported.text;
  const ProbeStream again = read_stream_csv(clean);
  EXPECT_EQ(again.indication, Indication::relative);
  EXPECT_EQ(again.nominal_radius_mm, 20.0);
}

// Samples that are whole numbers say nothing of the decimal mark of their scale.
TEST_F(RecordingFormats, AScaleWithADecimalCommaIsReadBesideWholeNumbers) {
  const ProbeStream stream = read_recording(
      put("Name;Lathe;\nStarttime of export;1;x;y\n\nName;X;C;Z;\nUnit;mm;°;mm;\n"
          "ScaleFactor;0,001;0,1;1;\nOffset;0;0;0;\n10000000;40500;0;1;\n20000000;40600;900;2;\n"
          "30000000;40700;1800;3;\n"),
      said("X=X,C=C,Z=Z,t=1", false));
  ASSERT_EQ(stream.size(), 3U);
  EXPECT_NEAR(stream.reading_mm[1], 40.6, 1e-12);
  EXPECT_NEAR(stream.c_rad[2] * deg_per_rad, 180.0, 1e-9);
}

// Ticks are whole numbers of 64 bits, and what a file says of them may be any.
TEST_F(RecordingFormats, TicksFarApartAreAsManySeconds) {
  const RecordedText text(
      "Name;Lathe;\nStarttime of export;1;x;y\n\nName;X;C;Z;\nUnit;mm;°;mm;\n"
      "-9000000000000000000;40;0;1;\n0;41;90;2;\n9000000000000000000;42;180;3;\n");
  Recording recording;
  ASSERT_TRUE(read_twincat_scope(text, recording));
  ASSERT_EQ(recording.rows(), 3U);
  double time_s = 0.0;
  for (const auto& [row, wanted_s] : {std::pair{1U, 9e11}, {2U, 18e11}}) {
    EXPECT_TRUE(recording.number(row, 0, time_s));
    EXPECT_DOUBLE_EQ(time_s, wanted_s);
  }
}

TEST_F(RecordingFormats, AStreamOfItsOwnKeepsItsMessages) {
  const std::string message = what_is_said(put("X_M[mm],C[deg],Z[mm]\n40,0,1\n41,abc,2\n"));
  EXPECT_NE(message.find(":3:4: C: 'abc' is not a number"), std::string::npos) << message;
}

TEST_F(RecordingFormats, LinesOfTheFileAreNamedBehindTitles) {
  const std::string message =
      what_is_said(put("A title\nt;Radius;C;Z\n0;40,5;0;1\n2;40,25;90;2\n1;40;180;2\n"));
  EXPECT_NE(message.find(":5: t falls from 2 to 1"), std::string::npos) << message;
}

}  // namespace
}  // namespace trueaxis::testing
