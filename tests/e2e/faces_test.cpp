// SPDX-License-Identifier: Apache-2.0
// Faces and sections through the command: diagnosed, played back, corrected with, advised on.
#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class Faces : public CommandTest {
 protected:
  void simulated(const std::string& name, const std::string& scenario) {
    file(name + ".toml", scenario);
    const CommandStreams done = command("simulate " + name + ".toml -o " + name + ".csv");
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
};

std::string face_with(const std::string& effect) {
  return "seed = 5\n[part]\nkind = \"face\"\nl = 4e-4\nm = -3e-4\nd_mm = 12\n[noise]\nsigma_um = "
         "1\n"
         "[[pass]]\nx_start_mm = 8\nx_end_mm = 40\nfeed_mm_per_rev = 0.64\n"
         "readings_per_revolution = 23.7\nspeed_rpm = 60\n" +
         effect;
}

const char* const seat =
    "seed = 6\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n[noise]\nsigma_um = 1\n"
    "[[pass]]\nz_start_mm = 20\nz_end_mm = 60\nfeed_mm_per_rev = 1\n"
    "readings_per_revolution = 23.7\nspeed_rpm = 60\n";

// 3 µm at σ = 1 µm: λ above 1000, found with certainty.
const char* const saddle =
    "[[effect]]\nid = \"part.face_saddle\"\namplitude_um = 3\nradius_mm = 40\n";

const char* const seat_and_face =
    "[[reference]]\nname = \"seat\"\nstream = \"seat.csv\"\nsurface = \"cylinder\"\n"
    "[[reference]]\nname = \"face\"\nstream = \"face.csv\"\nsurface = \"plane\"\n"
    "[target]\nsurface = \"cylinder\"\nradius_mm = 29\nz_start_mm = 60\nz_end_mm = 20\n"
    "stock_um = 2000\ncoaxiality_tolerance_um = 50\n[cut]\nspeed_rpm = 300\nsense = \"+c\"\n"
    "feed_mm_per_rev = 0.5\n";

bool in_class(const json& findings, const std::string& id) {
  for (const json& finding : findings)
    if (finding.dump().find('"' + id + '"') != std::string::npos) return true;
  return false;
}

TEST_F(Faces, AreDiagnosedBesideACylinder) {
  simulated("face", face_with(saddle));
  simulated("seat", seat);
  file("job.toml", seat_and_face);
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_FALSE(contains(done.out, "not diagnosed")) << done.out;
  EXPECT_TRUE(contains(done.out, "part.face_saddle")) << done.out;
  const json face = result("out/result.json").at("references")[1].at("diagnosis");
  EXPECT_EQ(face.at("verdict"), "effects");
  EXPECT_TRUE(in_class(face.at("findings"), "part.face_saddle"));
  EXPECT_EQ(face.at("axis_of_the_correction"), "extended model");
  // Played back by the lathe, of the variance what noise leaves and no more.
  EXPECT_LT(face.at("simulated_again").at("after").at("share_of_variance").get<double>(), 0.6);
  EXPECT_TRUE(there("out/" + face.at("file").get<std::string>()));
  EXPECT_TRUE(there("out/" + face.at("readings").get<std::string>()));
}

TEST_F(Faces, ThatAreSilentAndWhiteHaveNoReservation) {
  simulated("face", face_with(""));
  simulated("seat", seat);
  file("job.toml", seat_and_face);
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "GO: ")) << done.out;
  EXPECT_FALSE(contains(done.out, "reservation")) << done.out;
}

TEST_F(Faces, ArePlayedBackAndAdvisedOn) {
  simulated("face", face_with("[[effect]]\nid = \"part.face_cone\"\namplitude_um = 3\n"));
  ASSERT_EQ(command("diagnose face.csv --surface plane --json face.json").exit_code, 0);
  EXPECT_TRUE(in_class(result("face.json").at("findings"), "slide.xz_squareness"));
  // A face has a tilt for an axis, and its form comes last.
  const std::string screen = command("diagnose face.csv --surface plane").out;
  ASSERT_TRUE(contains(screen, "\nform ")) << screen;
  EXPECT_LT(screen.find("\ntilt "), screen.find("\nform ")) << screen;
  const CommandStreams again = command("simulate --from face.json --compare");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  // A cone and a slide out of square part beyond the axis, and nowhere else.
  const CommandStreams advice = command("advise face.csv --surface plane");
  EXPECT_EQ(advice.exit_code, 0) << advice.err;
  EXPECT_TRUE(contains(advice.out, "RE  probe the other side of the axis")) << advice.out;
}

// At one radius the fundamental motion is the tilt of the face: said as absorbed, not found.
TEST_F(Faces, AtOneRadiusTheFundamentalMotionIsAbsorbed) {
  simulated("face",
            "seed = 7\n[part]\nkind = \"face\"\nd_mm = 12\n[noise]\nsigma_um = 1\n[[pass]]\n"
            "x_start_mm = 30\nx_end_mm = 30\nfeed_mm_per_rev = 1\nrevolutions = 40\n"
            "readings_per_revolution = 23.7\n[[effect]]\nid = \"spindle.axial_fundamental\"\n"
            "amplitude_um = 5\n");
  ASSERT_EQ(command("diagnose face.csv --surface plane --json face.json").exit_code, 0);
  const json found = result("face.json");
  EXPECT_EQ(found.at("verdict"), "ideal");
  bool said = false;
  for (const json& hidden : found.at("not_observable")) {
    if (hidden.at("effect") != "spindle.axial_fundamental") continue;
    said = contains(hidden.at("why").get<std::string>(), "absorbed by the tilt of the face");
  }
  EXPECT_TRUE(said) << found.at("not_observable").dump(1);
}

// One Z: lobes of the part and motion of the spindle are one column, which re-indexing splits; what
// needs a length is listed as not observable. (In phase with the eccentricity, three lobes are a
// cubic sensor too.)
TEST_F(Faces, ASectionNamesBothAndTheMeasurementThatTells) {
  simulated("section",
            "seed = 8\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n[noise]\n"
            "sigma_um = 1\n[[pass]]\nz_start_mm = 20\nz_end_mm = 20\nfeed_mm_per_rev = 1\n"
            "revolutions = 40\nreadings_per_revolution = 36.7\n[[effect]]\n"
            "id = \"part.roundness\"\norder = 3\nphase_deg = 40\namplitude_um = 1\n");
  ASSERT_EQ(command("diagnose section.csv --surface section --json section.json").exit_code, 0);
  const json found = result("section.json");
  EXPECT_TRUE(in_class(found.at("findings"), "part.roundness"));
  EXPECT_TRUE(in_class(found.at("findings"), "spindle.radial_synchronous"));
  EXPECT_FALSE(in_class(found.at("findings"), "spindle.tilt_synchronous"));
  const std::string next = command("advise section.csv --surface section").out;
  EXPECT_TRUE(contains(next, "RC  turn the part by 70°")) << next;
  for (const char* id : {"part.bow", "part.taper", "part.barrel"}) {
    bool said = false;
    for (const json& hidden : found.at("not_observable"))
      said |= hidden.at("effect") == id && hidden.at("why") == "one section shows nothing along Z";
    EXPECT_TRUE(said) << id;
  }
}

}  // namespace
}  // namespace trueaxis::testing
