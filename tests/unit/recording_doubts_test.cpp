// SPDX-License-Identifier: Apache-2.0
// What may be meant in two ways is asked, with a command that reads the file; what cannot be meant
// otherwise is read. Numbers are written so that the double nearest to them is the expected one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "recording/import.hpp"
#include "support/command.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::testing {
namespace {

class RecordingDoubts : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    path_ = (fresh_folder("recording_doubts/" + test) / "export.txt").string();
  }
  ProbeStream read(const std::string& text, const std::string& columns = "",
                   std::optional<bool> diameter = std::nullopt) const {
    write_text(path_, text);
    RecordingOptions options;
    options.columns = columns;
    options.read.diameter = diameter;
    return read_recording(path_, options);
  }
  std::string refusal(const std::string& text, const std::string& columns = "",
                      std::optional<bool> diameter = std::nullopt) const {
    try {
      read(text, columns, diameter);
    } catch (const InputError& error) {
      return error.what();
    }
    return "was read";
  }
  void expect_said(const std::string& refusal, const std::string& what) const {
    EXPECT_NE(refusal.find(what), std::string::npos) << refusal;
  }
  std::string path_;
};

using Readings = std::vector<double>;

TEST_F(RecordingDoubts, PointsThatMayPartThousandsAreAsked) {
  const std::string text = "Winkel;Radius;Z\n0;20.100;1\n90;20.200;2\n180;20.300;3\n";
  const std::string said = refusal(text);
  expect_said(said,
              "every point in its numbers comes before three digits and may separate thousands");
  expect_said(said, "--columns X=2,C=1,Z=3,decimal=point");
  // The command that it prints reads the file; so does the one word that was missing.
  EXPECT_EQ(read(text, "X=2,C=1,Z=3,decimal=point").reading_mm, (Readings{20.1, 20.2, 20.3}));
  EXPECT_EQ(read(text, "decimal=point").reading_mm, (Readings{20.1, 20.2, 20.3}));
  expect_said(refusal(text, "decimal=comma"), "save numbers without a separator of thousands");
  expect_said(refusal(text, "decimal=komma"), "it is decimal=point or decimal=comma");
}

TEST_F(RecordingDoubts, CommasThatMayPartThousandsAreAsked) {
  const std::string text = "Angle\tRadius\tZ\n0\t20,100\t1\n90\t20,200\t2\n";
  expect_said(refusal(text), "decimal=comma");
  EXPECT_EQ(read(text, "decimal=comma").reading_mm, (Readings{20.1, 20.2}));
  expect_said(refusal("Nr;C;Radius;Z;\n1;0,5;20,1;1,5;\n2;1,5;20,2;2,5;\n", "decimal=point"),
              "holds no table of numbers with decimal points");
}

TEST_F(RecordingDoubts, AUnitThatIsTypedIsRepeated) {
  const std::string rows = "20.1,0,1\n20.2,1,2\n20.3,2,3\n";
  const ProbeStream stream = read("Dia,Angle,Pos[mm]\n" + rows, "X=Dia[um],C=Angle[rad],Z=Pos");
  EXPECT_EQ(stream.c_rad, (Readings{0.0, 1.0, 2.0}));
  expect_said(stream.read_as.front(),
              "X = column 1 (Dia) in um, a diameter, C = column 2 (Angle) in rad, Z = column 3 "
              "(Pos[mm])");
}

TEST_F(RecordingDoubts, TheProposalHasEveryColumnThatTheHeaderNames) {
  const std::string rows = "0,20.1,5,1,1\n0.5,20.2,95,2,1\n1,20.1,185,3,2\n";
  const std::string text = "t_s,reading,C,Z,pass\n" + rows;
  expect_said(refusal(text), "--columns X=…,C=3,Z=4,t=1,pass=5 ");
  const ProbeStream stream = read(text, "X=2,C=3,Z=4,t=1,pass=5", false);
  EXPECT_EQ(stream.time_s, (Readings{0.0, 0.5, 1.0}));
  EXPECT_EQ(stream.pass, (std::vector<int>{1, 1, 2}));
  for (const std::string& note : stream.read_as)
    EXPECT_EQ(note.find("not used"), std::string::npos) << note;
  // Neither a column that no word of the header names, nor one that is not there.
  expect_said(refusal("foo,reading,C,Z,bar\n" + rows), "--columns X=…,C=3,Z=4 ");
  write_text(path_, "time [ms],Z_M[mm],Angle,X[mm],load\n" + rows);
  try {
    import_recording(path_, {});
    FAIL() << "X of a face may be a diameter";
  } catch (const InputError& error) {
    expect_said(error.what(), "--columns Z_M=2,C=3,X=4,t=1 ");
  }
}

TEST_F(RecordingDoubts, OneNumberThatCannotBeThousandsTells) {
  for (const char* angle : {"0.512", "12.5", "1234.567"})
    EXPECT_EQ(read(fmt::format("C;Radius;Z\n{};20.100;1\n90;20.200;2\n", angle)).reading_mm,
              (Readings{20.1, 20.2}))
        << angle;
}

TEST_F(RecordingDoubts, AnIndexWithoutANameIsNoCutNumber) {
  EXPECT_EQ(read(",Radius,C,Z\n0,20.5,0,1\n1,20.25,90,2\n").reading_mm, (Readings{20.5, 20.25}));
  const std::string cut = refusal("Radius,C,Z\n40,5,0,1,1,5\n40,25,90,1,2,5\n");
  expect_said(cut, "the rows have 6 numbers and the header 3 names");
  EXPECT_EQ(cut.find("the command that would read it"), std::string::npos) << cut;
}

TEST_F(RecordingDoubts, TheCommandThatIsPrintedSaysWhatWasSaid) {
  const std::string log =
      "40.500000 0.000000 1.000000 0.000000 0.000000 0.000000 0.000000 0.000000 0.000000 \n"
      "40.250000 0.000000 2.000000 0.000000 0.000000 90.000000 0.000000 0.000000 0.000000 \n";
  for (const auto& radius : {std::optional<bool>(), std::optional<bool>(false)})
    expect_said(refusal(log, "", radius), "--columns 'X=1[mm],C=6[deg],Z=3[mm]' --radius -o");
  EXPECT_EQ(read(log, "X=1[mm],C=6[deg],Z=3[mm]", false).reading_mm, (Readings{40.5, 40.25}));
}

TEST_F(RecordingDoubts, ScopeExportsWithEachSeparator) {
  for (const char separator : {';', '\t', ','}) {
    std::string text =
        "Name;Lathe\nStarttime of export;1;x;y\n\nName;X;C;Z\nUnit;mm;°;mm\nScaleFactor;0.5;1;1\n"
        "10000000;81.5;0;1\n20000000;80.5;90;2\n30000000;80.75;180;3\n";
    std::ranges::replace(text, ';', separator);
    const ProbeStream stream = read(text, "", false);
    EXPECT_EQ(stream.reading_mm, (Readings{40.75, 40.25, 40.375})) << separator;
    EXPECT_EQ(stream.time_s, (Readings{0.0, 1.0, 2.0})) << separator;
  }
  expect_said(refusal("Name,Lathe\nStarttime of export,1,x,y\n\nName,X,C,Z\n10000000,81,5,0,1\n",
                      "", false),
              ":5: has more fields than there are names: where commas are both decimal marks");
}

TEST_F(RecordingDoubts, WordsWithAnEqualsSign) {
  EXPECT_EQ(read("X= 40.5 C=0 Z=1\nX=40.25 C = 90 Z=2\n", "", false).reading_mm,
            (Readings{40.5, 40.25}));
}

// The letter O in a number is not a unit.
TEST_F(RecordingDoubts, ALetterWithinANumberIsNoUnit) {
  expect_said(refusal("C;Radius;Z\n0;20,1O5;1\n90;20,2;2\n10,5;20,2;2\n"),
              ":2:3: X: '20,1O5' is not a number: correct it, or remove the row");
}

// Points have no spindle angle to ask for: the message has the commands that read points.
TEST_F(RecordingDoubts, PointsWithoutAnAngleAreToldWhoReadsThem) {
  for (const char* const head : {"x,y,z\n", "X [mm],Y [mm],Z [mm]\n", ""}) {
    std::string text = head;
    for (int i = 0; i < 6; ++i) text += fmt::format("{},{}.25,{}.5\n", 20 + i, i, i);
    expect_said(refusal(text), "trueaxis fit --points FILE --element cylinder");
  }
  EXPECT_EQ(refusal("X,Z,t\n20.5,1,1\n20.25,2,2\n").find("associate"), std::string::npos);
}

// A thousand rows with every mistake again and again: a message a kind, all in one go, each with
// its count, in the lines of the file.
TEST_F(RecordingDoubts, AMessageForEachKindOfMistake) {
  std::string text = "A title\nZeit;Winkel;Radius;Z;Bemerkung\n";
  for (int i = 0; i < 1000; ++i) {
    const std::string t = i % 10 == 6 ? "0,5" : fmt::format("{}", i + 1);
    const std::string radius = i % 10 == 1   ? "n/a"
                               : i % 10 == 3 ? "1.040,5"
                               : i % 10 == 5 ? "40,5 mm"
                                             : "40,5";
    text += fmt::format("{};{};{};1;{}\n", t, i % 10 == 2 ? "" : "90", radius,
                        i % 10 == 4 ? "Span;2" : "");
  }
  const std::string said = refusal(text);
  EXPECT_EQ(std::ranges::count(said, '\n'), 6) << said;
  for (const char* kind :
       {":4:6: X: 'n/a' is not a number: correct it, or remove the row (so too in 99 further "
        "places, in lines 14, 24",
        ":5:3: C is empty: write a number or remove the row (so too in 99 further places",
        ":6:6: X: '1.040,5' is not a number: save numbers without a separator of thousands "
        "(so too in 99",
        ":7:18: the row has 6 fields, the table 5 columns: write one field per column (so too in "
        "99",
        ":8:6: X: '40,5 mm' is not a number alone: write its unit into the header (so too in 99",
        ":9: t falls from 5 to 0.5: sort the rows by time (so too in 99 further places, in lines "
        "19, 29"})
    expect_said(said, kind);
}

TEST_F(RecordingDoubts, InchesBehindAnUnderscoreOrABlank) {
  const std::string rows = "1.5,0,0.5\n1.25,90,1\n1.75,180,1.5\n";
  for (const char* header : {"X_in,C_deg,Z_in", "X in,C deg,Z in", "X IN,C DEG,Z IN"}) {
    const ProbeStream stream = read(std::string(header) + "\n" + rows, "", false);
    EXPECT_EQ(stream.reading_mm, (Readings{1.5 * 25.4, 1.25 * 25.4, 1.75 * 25.4})) << header;
    EXPECT_EQ(stream.position_mm, (Readings{0.5 * 25.4, 25.4, 1.5 * 25.4})) << header;
  }
}

TEST_F(RecordingDoubts, MetresBehindAnUnderscoreAreNoXM) {
  const ProbeStream stream =
      read("X_m,C_rad,Z_m\n0.03,0,0.5\n0.03125,1,0.75\n0.0325,2,1\n", "", false);
  EXPECT_EQ(stream.kind, StreamKind::lateral);
  EXPECT_EQ(stream.reading_mm, (Readings{30.0, 31.25, 32.5}));
  EXPECT_EQ(stream.position_mm, (Readings{500.0, 750.0, 1000.0}));
  EXPECT_EQ(read("x_m,c,z\n30,0,1\n31,90,2\n").reading_mm, (Readings{30.0, 31.0}));
}

/// A log of two channels, C and the slide, read four times as often as the gauge.
std::string camonitor_log(const char* gauge, const char* slide) {
  std::string text;
  for (int i = 0; i <= 12; ++i) {
    text += fmt::format("A:C 2026-02-22 12:00:{:02}.0 {}\n", i, 40 * i % 360);
    text += fmt::format("{} 2026-02-22 12:00:{:02}.0 {}\n", slide, i, 10 + i);
    if (i % 4 == 0) text += fmt::format("{} 2026-02-22 12:00:{:02}.0 {}\n", gauge, i, 40 + i);
  }
  return text;
}

// What lies between two readings is not known; between two positions of a slide it is.
TEST_F(RecordingDoubts, TheInstantsOfCamonitorAreThoseOfTheReadings) {
  const ProbeStream shaft =
      read(camonitor_log("A:GAUGE_ABS", "A:X"), "X=A:GAUGE_ABS,C=A:C,Z=A:X", false);
  EXPECT_EQ(shaft.reading_mm, (Readings{40.0, 44.0, 48.0, 52.0}));
  EXPECT_EQ(shaft.position_mm, (Readings{10.0, 14.0, 18.0, 22.0}));
  const ProbeStream face = read(camonitor_log("A:Z_M", "A:X"), "", false);
  EXPECT_EQ(face.kind, StreamKind::face);
  EXPECT_EQ(face.reading_mm, (Readings{40.0, 44.0, 48.0, 52.0}));
}

// EPICS sends what changes: a section has one sample of Z, and a slide that stops has no more. A
// channel that was disconnected may have ended.
TEST_F(RecordingDoubts, AChannelOfCamonitorThatSendsNothingIsAtRest) {
  std::string log, z = "A:Z 2026-03-01 12:00:00.0 5\n";
  for (int i = 0; i < 8; ++i)
    for (const char* one : {"X", "C"})
      log += fmt::format("A:{} 2026-03-01 12:00:0{}.0 {}\n", one, i, one[0] == 'X' ? 40 : 45 * i);
  const ProbeStream section = read(log + z, "", false);
  EXPECT_EQ(section.position_mm, Readings(8, 5.0));
  expect_said(section.read_as[1] + section.read_as[2],
              "A:Z sends nothing for the last 7 s: read as at rest at 5");
  z += "A:Z 2026-03-01 12:00:02.0 9\n";
  EXPECT_EQ(read(log + z, "", false).position_mm,
            (Readings{5.0, 7.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0}));
  z += "A:Z 2026-03-01 12:00:03.0 *** disconnected\n";
  EXPECT_EQ(read(log + z, "", false).position_mm, (Readings{5.0, 7.0, 9.0}));
}

TEST_F(RecordingDoubts, ACapitalTIsNoTime) {
  EXPECT_TRUE(read("X 40.5 C 0 Z 1 T 5\nX 40.25 C 90 Z 2 T 5\n", "", false).time_s.empty());
  EXPECT_TRUE(read("T;Radius;C;Z\n20,5;40,5;0;1\n20,25;40,25;90;2\n").time_s.empty());
  EXPECT_EQ(read("T;Radius;C;Z\n0;40,5;0;1\n1,5;40,25;90;2\n", "X=2,C=3,Z=4,t=T").time_s,
            (Readings{0.0, 1.5}));
}

TEST_F(RecordingDoubts, AHeaderThatIsThereAgainIsNoRowWithoutAValue) {
  const std::string header = "Radius;C;Z\n", rows = "40,5;0;1\n40,25;90;2\n";
  const ProbeStream stream = read(header + rows + header + "40,75;180;3\n");
  EXPECT_EQ(stream.reading_mm, (Readings{40.5, 40.25, 40.75}));
  expect_said(stream.read_as.back() + stream.read_as[1], "the header is there again 1 time");
  expect_said(refusal(header + rows + "Durchmesser;C;Z\n81;180;3\n"),
              ":4:1: is another header than that of the table: cut the file here");
}

TEST_F(RecordingDoubts, InstantsInUtcAndPastMidnight) {
  const std::string utc =
      "time,Radius,C,Z\n2026-02-22T12:00:00.5Z,40,0,1\n2026-02-22T12:00:02Z,41,9,1\n";
  EXPECT_EQ(read(utc).time_s, (Readings{0.0, 1.5}));
  EXPECT_EQ(read("time,Radius,C,Z\n23:59:59.5,40,0,1\n00:00:01,41,9,1\n").time_s,
            (Readings{0.0, 1.5}));
}

}  // namespace
}  // namespace trueaxis::testing
