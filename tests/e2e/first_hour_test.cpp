// SPDX-License-Identifier: Apache-2.0
// A new user's first command: a spreadsheet's export with decimal commas to the report, and the
// same export made a stream. The export is a shipped stream, written with six decimals of a mm (of
// a diameter) and of a degree: no reading is off by more than r = 0.25e-6 mm, an angle by
// δ = 0.5e-6°. x0 and y0 at mid length and the radius are means of readings times 2 cos C at most:
// off by less than 2 r, and by 2 δ times the eccentricity.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "measure/files/stream_csv.hpp"
#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::testing {
namespace {

class FirstHour : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    const ProbeStream stream = read_stream_csv(seat_);
    std::string text =
        "Auftrag 4711;;;;\r\nPr\xFC"
        "fer: M\xFCller;;;;\r\n;;;;\r\n"  // Windows-1252
        "Nr;C[\xB0];X (mm);Z;Bemerkung\r\n;;;mm;\r\n";
    for (std::size_t i = 0; i < stream.size(); ++i)
      text += fmt::format("{};{:.6f};{:.6f};{:.6f};{};\r\n", i + 1,
                          std::fmod(stream.c_rad[i] * 180.0 / std::numbers::pi, 360.0),
                          2.0 * stream.reading_mm[i], stream.position_mm[i],
                          i == 7 ? "Span entfernt" : "");
    std::ranges::replace(text, '.', ',');
    file("export.csv", text);
    FitOptions options;
    options.surface = SurfaceKind::cylinder;
    expected_ = fit(stream, options);
  }
  /// The axis of a fit in JSON is that of the shipped stream.
  void expect_axis(const nlohmann::json& found) const {
    const auto at = [&](const char* of) {
      return found.at("axis").at(of).at("value").get<double>();
    };
    const double z_mm = at("z_ref");
    const auto [x_mm, y_mm] = expected_.axis.axis.at(z_mm);
    const double tolerance_mm =
        2.0 * 0.25e-6 + 2.0 * 0.5e-6 * std::numbers::pi / 180.0 * std::hypot(x_mm, y_mm) + 1e-9;
    EXPECT_NEAR(at("x"), x_mm, tolerance_mm);
    EXPECT_NEAR(at("y"), y_mm, tolerance_mm);
    EXPECT_NEAR(found.at("parameters").at("radius").at("value").get<double>(),
                expected_.parameter("radius").value, tolerance_mm);
    EXPECT_EQ(found.at("points").get<std::size_t>(), expected_.points);
  }

  const std::string seat_ = places::source() + "/data/streams/shaft_cylinder_seat.csv";
  FitResult expected_;
};

/// What the page draws, as it is in it.
nlohmann::json data_of(const std::string& page) {
  const std::string begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST_F(FirstHour, FromTheExportToTheReportInOneCommand) {
  const CommandStreams done = command("run export.csv --diameter -o result");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "surface assumed: cylinder")) << done.out;
  EXPECT_TRUE(contains(done.out, "report result/report.html")) << done.out;
  expect_axis(result("result/result.json").at("references").at(0).at("fit"));
  const std::string page = read_text(folder_ / "result/report.html");
  expect_axis(data_of(page).at("references").at(0));
  // It is complete: opening it fetches nothing.
  for (const char* fetched : {" src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_EQ(page.find(fetched), std::string::npos) << fetched;
}

TEST_F(FirstHour, TheSameImportTwiceAndThenTheJob) {
  ASSERT_EQ(command("import export.csv --diameter -o seat.csv").exit_code, 0);
  const std::string stream = read_text(folder_ / "seat.csv"),
                    job = read_text(folder_ / "seat.toml");
  ASSERT_EQ(command("import export.csv --diameter -o seat.csv").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "seat.csv"), stream);
  EXPECT_EQ(read_text(folder_ / "seat.toml"), job);
  ASSERT_EQ(command("run seat.toml -o result").exit_code, 0);
  expect_axis(result("result/result.json").at("references").at(0).at("fit"));
  // A job that was changed is the user's.
  file("seat.toml", job + "# mine\n");
  const CommandStreams again = command("import export.csv --diameter -o seat.csv");
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_TRUE(contains(again.err, "seat.toml: is there and may hold your changes")) << again.err;
  EXPECT_EQ(read_text(folder_ / "seat.toml"), job + "# mine\n");
}

// From standard input, a file or a pipe, it is read as from a file; a stream of our own as well,
// and what is unclear is asked for.
TEST_F(FirstHour, FromStandardInput) {
  const std::string fit_dash = "fit - --surface cylinder --json f.json --force";
  for (const std::string& from :
       {fit_dash + " --diameter < export.csv", fit_dash + " --diameter < <(cat export.csv)",
        std::string("fit <(cat export.csv) --surface cylinder --json f.json --force --diameter")}) {
    file("ask.sh", std::string(places::command() + " ") + from + "\n");
    const CommandResult done = shell("cd " + shell_word(folder_) + " && bash ask.sh 2>&1");
    ASSERT_EQ(done.exit_code, 0) << from << '\n' << done.output;
    expect_axis(result("f.json"));
  }
  ASSERT_EQ(command("import - --diameter -o seat.csv < export.csv").exit_code, 0);
  ASSERT_EQ(command(fit_dash + " < seat.csv").exit_code, 0);
  expect_axis(result("f.json"));
  const CommandStreams unclear = command("diagnose - --surface cylinder < export.csv");
  EXPECT_EQ(unclear.exit_code, 3);
  EXPECT_TRUE(contains(unclear.err, "radius or a diameter")) << unclear.err;
  EXPECT_TRUE(contains(unclear.err, "trueaxis diagnose - --surface cylinder --columns X=3,C=2,Z=4"))
      << unclear.err;
}

}  // namespace
}  // namespace trueaxis::testing
