// SPDX-License-Identifier: Apache-2.0
// What computes longer than two seconds says on a terminal what it is at, and nowhere else.
#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/terminal.hpp"

namespace trueaxis::testing {
namespace {

class ProgressLine : public CommandTest {
 protected:
  /// A stream of 100 000 readings, whose diagnosis takes a third of a second of a fast machine.
  void long_stream() {
    file("long.toml",
         "seed = 3\n[part]\nsurface = \"cylinder\"\nx0_um = 80\nradius_mm = 25\n[noise]\n"
         "sigma_um = 2\nrho = 0.5\n[[pass]]\nz_start_mm = 0\nz_end_mm = 60\n"
         "feed_mm_per_rev = 0.03\nreadings_per_revolution = 50.3\n"
         "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 4\n"
         "[[effect]]\nid = \"environment.vibration\"\nfrequency_hz = 7.3\namplitude_um = 3\n");
    ASSERT_EQ(command("simulate long.toml -o long.csv").exit_code, 0);
  }
  /// It is made to take more than two seconds by standing still on the way.
  static std::string standing_still(const std::string& diagnosis) {
    return diagnosis + " & P=$!; sleep 0.15; kill -STOP $P; sleep 2.3; kill -CONT $P; wait $P";
  }
};

TEST_F(ProgressLine, SaysWhatADiagnosisIsAtAndGoes) {
  long_stream();
  const TerminalRun run = on_terminal(
      folder_, "{ " + standing_still("$T diagnose long.csv --surface cylinder") + "; }");
  EXPECT_EQ(run.exit_code, 0) << run.shown;
  const std::size_t line = run.shown.find("\r\x1b[Kdiagnosis of long.csv, ");
  ASSERT_NE(line, std::string::npos) << "was it done within 2 s? " << run.shown;
  const std::size_t gone = run.shown.find("\r\x1b[K", run.shown.rfind("diagnosis of long.csv, "));
  ASSERT_NE(gone, std::string::npos) << run.shown;
  EXPECT_GT(run.shown.find("EFFECTS"), gone) << run.shown;  // the result is on a clean line
}

TEST_F(ProgressLine, IsNotInAPipe) {
  long_stream();
  const auto done =
      shell("cd " + shell_word(folder_) + "; " +
            standing_still(shell_word(places::command()) +
                           " diagnose long.csv --surface cylinder > out.txt 2> err.txt"));
  const std::string out = read_text(folder_ / "out.txt");
  EXPECT_EQ(done.exit_code, 0) << done.output;
  EXPECT_EQ(read_text(folder_ / "err.txt"), "");
  EXPECT_TRUE(contains(out, "EFFECTS")) << out;
  EXPECT_EQ(out.find('\r'), std::string::npos);
  EXPECT_EQ(out.find('\x1b'), std::string::npos);
}

TEST_F(ProgressLine, IsNotThereForWhatIsQuick) {
  const TerminalRun run =
      on_terminal(folder_, "trueaxis fit '" + places::source() +
                               "/data/streams/shaft_cylinder_seat.csv' --surface cylinder");
  EXPECT_EQ(run.exit_code, 0) << run.shown;
  EXPECT_EQ(run.shown.find("fit of "), std::string::npos) << run.shown;
}

}  // namespace
}  // namespace trueaxis::testing
