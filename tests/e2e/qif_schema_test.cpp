// SPDX-License-Identifier: Apache-2.0
// QIF documents as another program reads them: xmllint takes every number that was written for an
// xs:decimal. The schema is a stub (tests/support/qif_written.xsd), not that of the standard.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numbers>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class QifSchema : public CommandTest {
 protected:
  /// What xmllint says of a document; empty where it is valid.
  std::string said_of(const std::string& name) {
    const std::string out = (folder_ / "xmllint.txt").string();
    const int code = std::system(("xmllint --noout --schema '" + places::source() +
                                  "/tests/support/qif_written.xsd' '" + (folder_ / name).string() +
                                  "' > '" + out + "' 2>&1")
                                     .c_str());
    return code == 0 ? "" : read_text(out);
  }
  void SetUp() override {
    CommandTest::SetUp();
    if (std::system("xmllint --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no xmllint";
  }
};

// Sections that are round to the digits of the file: forms of 1e-13 mm and uncertainties as small,
// which have 25 decimals and more.
TEST_F(QifSchema, AFormOfNextToNothingIsValid) {
  std::ofstream file(folder_ / "round.csv");
  file << "# x_convention: radius\nX_M[mm],C[deg],Z[mm]\n";
  char line[96];
  for (const double z_mm : {0.0, 10.0, 20.0})
    for (int i = 0; i < 360; ++i) {
      const double t = std::numbers::pi * i / 180.0;
      std::snprintf(line, sizeof line, "%.15f,%d,%g\n",
                    25.0 + 1e-10 * std::cos(3.0 * t) + 1e-11 * std::cos(50.0 * t * (1.0 + z_mm)), i,
                    z_mm);
      file << line;
    }
  file.close();
  const CommandStreams done = command(
      "form round.csv --upr 1-15 --tolerance-um RONt=3,runout_total=1,CYLt=1 --qif form.qif");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(said_of("form.qif"), "");
}

TEST_F(QifSchema, AnAssociationThroughPointsIsValid) {
  std::ofstream file(folder_ / "points.xyz");
  char line[120];
  for (int i = 0; i < 60; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 60.0;
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n",
                  25.0 * std::cos(t) * (1.0 + 1e-13 * std::cos(5.0 * t)), 25.0 * std::sin(t),
                  1e-3 * (i % 7));
    file << line;
  }
  file.close();
  for (const char* element : {"circle", "cylinder", "sphere", "plane"}) {
    const CommandStreams done =
        command(std::string("fit --points points.xyz --force --qif a.qif --element ") + element);
    if (done.exit_code != 0) continue;  // a sphere of a ring is refused
    EXPECT_EQ(said_of("a.qif"), "") << element;
  }
  ASSERT_TRUE(std::filesystem::exists(folder_ / "a.qif"));
}

// The stub is not so lax that it accepts text as a number.
TEST_F(QifSchema, TheStubRefusesWhatIsNoDecimal) {
  for (const char* form : {"1e-7", "0.0000000000000000000012345678", "1,5", ""}) {
    std::ofstream(folder_ / "bad.qif")
        << "<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\" idMax=\"1\" "
           "versionQIF=\"3.0.0\"><Results><A><Form>"
        << form << "</Form></A></Results></QIFDocument>\n";
    EXPECT_NE(said_of("bad.qif"), "") << form;
  }
}

}  // namespace
}  // namespace trueaxis::testing
