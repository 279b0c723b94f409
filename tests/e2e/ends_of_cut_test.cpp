// SPDX-License-Identifier: Apache-2.0
// No row, block or line of a cut lies beyond its target, or the run-in and overrun that were asked
// for; the last revolution is cut at the end. The rows are read here (support/control_readers.hpp).
#include <cmath>

#include "support/command_fixture.hpp"
#include "support/control_readers.hpp"

namespace trueaxis::testing {
namespace {

struct Cut {
  const char* name;
  const char* target;  ///< lines of [target]
  double start, end;   ///< of the path, Z or for a face X
  const char* sense;
  double feed_mm = 2.0;
  int rows = 36;
  bool bore = false;
};

class EndsOfCut : public CommandTest {
 protected:
  void probed(bool bore) {
    file("seat.toml",
         std::string("seed = 3\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n") +
             (bore ? "bore = true\n" : "") +
             "l = 0.0002\n[noise]\nsigma_um = 0.5\n[[pass]]\nz_start_mm = 0\nz_end_mm = 40\n"
             "feed_mm_per_rev = 1\nreadings_per_revolution = 36.7\n");
    ASSERT_EQ(command("simulate seat.toml -o seat.csv --force").exit_code, 0);
  }

  static std::string job(const Cut& cut) {
    char text[500];
    std::snprintf(text, sizeof text,
                  "[[reference]]\nname = \"seat\"\nstream = \"seat.csv\"\nsurface = "
                  "\"cylinder\"\n%s[target]\n%s[cut]\nspeed_rpm = 60\nsense = \"%s\"\n"
                  "feed_mm_per_rev = %g\nrows_per_revolution = %d\nc_start_deg = 20\n",
                  cut.bore ? "feature = \"bore\"\n" : "", cut.target, cut.sense, cut.feed_mm,
                  cut.rows);
    return text;
  }
};

const char* const servo =
    "[[output]]\nformat = \"servo_nc\"\nx = \"radius\"\n"
    "f = \"minutes_per_block\"\n";

/// "# key: X 1.5 to 2.5 mm…": the two numbers of a line of the header.
std::vector<double> range_of(const std::string& table, const std::string& key) {
  for (const std::string& line : lines_in(table))
    if (line.rfind("# " + key + ":", 0) == 0) return numbers_in(line);
  return {};
}

/// Both ends, both senses, shaft, bore, cone and face; feeds that end within a revolution.
const Cut cuts[] = {
    {"down", "surface = \"cylinder\"\nradius_mm = 25\nz_start_mm = 75\nz_end_mm = 50.7\n", 75, 50.7,
     "+c"},
    {"up", "surface = \"cylinder\"\nradius_mm = 25\nz_start_mm = -75\nz_end_mm = -50.7\n", -75,
     -50.7, "-c"},
    {"whole_revolutions",
     "surface = \"cylinder\"\nradius_mm = 25\nz_start_mm = 75\nz_end_mm = 55\n", 75, 55, "+c"},
    {"bore",
     "surface = \"cylinder\"\nfeature = \"bore\"\nradius_mm = 35\nz_start_mm = 70\n"
     "z_end_mm = 45.5\n",
     70, 45.5, "-c", 0.7, 90, true},
    {"run_in_and_overrun",
     "surface = \"cylinder\"\nradius_mm = 25\nz_start_mm = 75\nz_end_mm = 50\nrun_in_mm = 3\n"
     "overrun_mm = 1.5\nshoulder_z_mm = 48\n",
     78, 48.5, "+c"},
    {"face", "surface = \"face\"\nz_mm = 80\nradius_start_mm = 25\nradius_end_mm = 3.3\n", 25, 3.3,
     "+c", 0.9},
    {"cone",
     "surface = \"cone\"\nradius_mm = 25\nhalf_angle_deg = 10\nopens = \"+z\"\nz_start_mm = 75\n"
     "z_end_mm = 50.7\n",
     75, 50.7, "+c"},
};

TEST_F(EndsOfCut, NoRowLiesBeyond) {
  for (const Cut& cut : cuts) {
    SCOPED_TRACE(cut.name);
    probed(cut.bore);
    file("job.toml", job(cut) + servo);
    const CommandStreams done = command("run job.toml -o out --force");
    ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
    const std::string table = read_text(folder_ / "out/table.csv");
    const bool face = std::string(cut.name) == "face";
    const auto rows = read_rows(table);
    const auto blocks = read_blocks(read_text(folder_ / "out/servo.nc"), false);
    ASSERT_EQ(blocks.size(), rows.size());
    const auto along = [&](std::size_t i) { return face ? blocks[i].x_mm : blocks[i].z_mm; };
    // Whole revolutions, all of the last at the end and no more than one before.
    const double turns = std::abs(cut.end - cut.start) / cut.feed_mm;
    const auto per_rev = static_cast<std::size_t>(cut.rows);
    EXPECT_EQ(rows.size(), per_rev * static_cast<std::size_t>(std::ceil(turns - 1e-9) + 1.0));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double turn = static_cast<double>(i) / cut.rows;
      const double z = turn >= turns ? cut.end : cut.start + (cut.end - cut.start) * turn / turns;
      // Six decimals.
      ASSERT_NEAR(rows[i].z_mm, z, 0.51e-6) << i;
      ASSERT_NEAR(along(i), z, 0.51e-6) << i;
      ASSERT_GE(rows[i].z_mm, std::min(cut.start, cut.end));
      ASSERT_LE(rows[i].z_mm, std::max(cut.start, cut.end));
    }
    const std::vector<double> range = range_of(table, "nose_centre");
    ASSERT_GE(range.size(), 2U);
    EXPECT_EQ(range[0], rows.front().z_mm);
    EXPECT_EQ(range[1], rows.back().z_mm);
  }
}

/// The lines of a program that move or set how the feed counts, in order.
std::vector<std::string> orders_of(const std::string& program) {
  std::vector<std::string> orders;
  for (const std::string& line : lines_in(program))
    if (line[0] == 'G' || line[0] == 'C') orders.push_back(line);
  return orders;
}

// Under inverse time the first block would go from wherever the machine is to the start of the
// cut within a block's time.
TEST_F(EndsOfCut, AServoProgramFeedsFromWhereItSaysTheMachineMustStand) {
  probed(false);
  file("job.toml", job(cuts[0]) + servo);
  ASSERT_EQ(command("run job.toml -o out").exit_code, 0);
  const std::string program = read_text(folder_ / "out/servo.nc");
  const std::vector<std::string> orders = orders_of(program);
  ASSERT_GT(orders.size(), 5U);
  EXPECT_EQ(orders[0], "G21 G90");
  EXPECT_EQ(orders[1], "G94");
  const auto first = numbers_in(orders[2].substr(3));
  ASSERT_EQ(orders[2].rfind("G1 C20.000000 X", 0), 0U) << orders[2];
  EXPECT_NEAR(first[3], 60.0 * 2.0, 1e-6);  // mm a minute: speed × feed
  EXPECT_EQ(orders[3], "G93");
  EXPECT_EQ(orders[4][0], 'C');
  const std::string place = orders[2].substr(3, orders[2].find(" F") - 3);
  EXPECT_TRUE(contains(program, "MUST BE AT " + place + " )")) << program.substr(0, 600);
  EXPECT_FALSE(contains(program, "G0"));
}

TEST_F(EndsOfCut, CorrectEndsWhereRunDoes) {
  probed(false);
  ASSERT_EQ(command("diagnose seat.csv --surface cylinder --json d.json").exit_code, 0);
  for (const Cut& cut : {cuts[0], cuts[4]}) {
    file("job.toml", job(cut));
    ASSERT_EQ(command("run job.toml -o out --force").exit_code, 0);
    const CommandStreams done = command("table d.json --target job.toml -o t.csv --force");
    ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
    const auto of_run = read_rows(read_text(folder_ / "out/table.csv")),
               rows = read_rows(read_text(folder_ / "t.csv"));
    ASSERT_EQ(rows.size(), of_run.size());
    EXPECT_EQ(rows.back().z_mm, cut.end);
    EXPECT_EQ(rows.back().x_mm, of_run.back().x_mm);
  }
}

/// What a shoulder forbids: the nose's circle, of 0.8 mm, past it at either end.
TEST_F(EndsOfCut, AShoulderIsNotRunInto) {
  struct Forbidden {
    const char* lines;
    const char* says;
  };
  const Forbidden forbidden[] = {
      {"z_start_mm = 75\nz_end_mm = 50\nshoulder_z_mm = 50\n",
       "reaches Z = 49.2 mm, 0.8 mm past the shoulder at 50 mm: end the target at 50.8 mm"},
      {"z_start_mm = 75\nz_end_mm = 50\noverrun_mm = 1\nshoulder_z_mm = 48.5\n",
       "0.3 mm past the shoulder at 48.5 mm: lower overrun_mm, or end the target at 50.3 mm"},
      {"z_start_mm = 50\nz_end_mm = 75\nrun_in_mm = 2\nshoulder_z_mm = 47.5\n",
       "0.3 mm past the shoulder at 47.5 mm: lower run_in_mm, or start the target at 50.3 mm"},
      {"z_start_mm = 50\nz_end_mm = 75\nshoulder_z_mm = 75.5\n", "end the target at 74.7 mm"},
      {"z_start_mm = 50\nz_end_mm = 75\nshoulder_z_mm = 60\n", "lies on the target"},
  };
  probed(false);
  ASSERT_EQ(command("diagnose seat.csv --surface cylinder --json d.json").exit_code, 0);
  for (const auto& [lines, says] : forbidden) {
    const std::string target = std::string("surface = \"cylinder\"\nradius_mm = 25\n") + lines;
    const Cut cut{"", target.c_str(), 0, 0, "+c"};
    file("job.toml", job(cut) + "nose_radius_mm = 0.8\n");
    const CommandStreams done = command("run job.toml -o out --force");
    EXPECT_EQ(done.exit_code, 1) << done.out;
    EXPECT_TRUE(contains(done.out, says)) << done.out;
    EXPECT_FALSE(there("out/table.csv"));
    const CommandStreams corrected = command("table d.json --target job.toml -o t.csv");
    EXPECT_EQ(corrected.exit_code, 1);
    EXPECT_TRUE(contains(corrected.err, says)) << corrected.err;
    EXPECT_FALSE(there("t.csv"));
  }
  // A face that is overrun past the axis is a mistake of the job.
  file("job.toml", job({"",
                        "surface = \"face\"\nz_mm = 80\nradius_start_mm = 25\n"
                        "radius_end_mm = 1\noverrun_mm = 2\n",
                        0, 0, "+c"}));
  expect_input_error("run job.toml -o face", "moves the tool 1 mm past the spindle axis");
}

}  // namespace
}  // namespace trueaxis::testing
