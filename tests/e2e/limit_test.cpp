// SPDX-License-Identifier: Apache-2.0
// The line `limit` names what U would be without one cause. Stated exactly, that cause leaves this
// U: both have two digits, half of the last is 5 % at most, and a quantile is found to 1 %.
#include <regex>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

class LimitOfU : public CommandTest {
 protected:
  static double um(const std::string& text, const char* before) {
    std::smatch found;
    if (!std::regex_search(text, found, std::regex(before + std::string(" ([0-9.]+) µm"))))
      return NAN;
    return std::stod(found[1]);
  }
  double largest_U_um(const std::string& screen) {
    double largest = 0.0;
    const std::regex one("U ([0-9.]+) µm at Z");
    for (std::sregex_iterator at(screen.begin(), screen.end(), one), end; at != end; ++at)
      largest = std::max(largest, std::stod((*at)[1]));
    return largest;
  }
};

TEST_F(LimitOfU, IsWhatStatingTheCauseLeaves) {
  const std::map<std::string, std::string> key{{"probe.lag", "lag_ms"},
                                               {"probe.height", "height_mm"}};
  for (const char* surface : {"cone", "cylinder"}) {
    const std::string diagnose = "diagnose " + places::source() + "/data/streams/shaft_" + surface +
                                 "_seat.csv --surface " + surface;
    const CommandStreams open = command(diagnose);
    std::smatch cause;
    ASSERT_TRUE(
        std::regex_search(open.out, cause, std::regex("would be [0-9.]+ µm without (\\S+),")))
        << open.out;
    const CommandStreams stated = command(diagnose + " --known " + key.at(cause[1]) + "=0+-0");
    const double would_be_um = um(open.out, "would be");
    EXPECT_NEAR(largest_U_um(stated.out), would_be_um, 0.06 * would_be_um)
        << open.out << stated.out;
  }
}

}  // namespace
}  // namespace trueaxis::testing
