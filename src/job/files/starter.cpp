// SPDX-License-Identifier: Apache-2.0
#include "job/files/starter.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view scenario =
    R"(# A shaft in a chuck, 0.1 mm off the spindle axis and a little tilted, as the virtual lathe probes it:
#   trueaxis simulate scenario.toml -o stream.csv
# Your own stream takes the place of stream.csv: trueaxis import EXPORT.csv -o stream.csv
seed = 1                    # of the noise: the same seed gives the same readings

[part]
surface = "cylinder"           # or cone, with half_angle_deg
radius_mm = 32
x0_mm = 0.08                # where its axis is at Z = 0, C = 0: +X
y0_mm = -0.06               # and +Y
l = 0.0003                  # direction cosines of its axis: 0.3 mm off in a metre
m = -0.0002

[noise]
sigma_um = 1                # standard deviation of one reading

[[pass]]                    # the probe moves along Z while the spindle turns
z_start_mm = 0
z_end_mm = 40
feed_mm_per_rev = 1
readings_per_revolution = 36.7   # not a whole number: every revolution reads other angles
speed_rpm = 60

[[effect]]                  # deviation from the ideal shaft: three lobes of 2 um
id = "part.roundness"       # trueaxis effects lists them all
order = 3
amplitude_um = 2
)";

constexpr std::string_view job =
    R"(# From the stream to the table that cuts true to the shaft's own axis:
#   trueaxis run job.toml -o result
name = "bearing seat next to a probed shaft"

[header]                    # appears at the head of the report; date = 2026-03-14 too
part = "shaft"
serial = ""
operator = ""
machine = ""
probe = ""

[sensor]
u_height_um = 20            # how well the probe is at the height of the spindle axis

[[reference]]               # as many as the cut is to be true to
name = "shaft"
stream = "stream.csv"
surface = "cylinder"        # cone, cylinder, plane (a face), section (one circle)
feature = "shaft"           # or bore
loss = "plain"              # tukey if chips or coolant leave spikes

[target]                    # what is to be cut, about the axis that is found
surface = "cylinder"
radius_mm = 30
z_start_mm = 60
z_end_mm = 45
coaxiality_tolerance_um = 10

[cut]
speed_rpm = 600
sense = "+c"                # the way that C counts while cutting
feed_mm_per_rev = 0.2
nose_radius_mm = 0.8
interpolation = "linear"    # the control joins the rows of the table by straight lines; none: holds

[actuator]                  # the fast tool servo
stroke_um = 600
natural_frequency_hz = 600
damping = 0.7
sampling_hz = 20000

# [[output]]                # the correction for a control, in addition to table.csv
# format = "grid"           # halstreamer, servo_nc, sinumerik_cec, beckhoff_crosscomp2
)";

constexpr std::string_view cut =
    R"(# The shaft of scenario.toml, cut with the table of the job and probed again without noise:
#   trueaxis simulate cut.toml --table result/table.csv -o after.csv
#   trueaxis fit after.csv --surface cylinder
# The axis that the fit then shows is that of the shaft, 0.1 mm off the spindle, if the table is right.
seed = 1

[part]
surface = "cylinder"
radius_mm = 32
x0_mm = 0.08
y0_mm = -0.06
l = 0.0003
m = -0.0002

[[pass]]
z_start_mm = 46
z_end_mm = 59
feed_mm_per_rev = 1
readings_per_revolution = 36.7

[cut]
use = "command"             # through the actuator; wanted: as if it followed at once; none: no table
[cut.target]
surface = "cylinder"
radius_mm = 30
z_start_mm = 60
z_end_mm = 45
[cut.tool]
nose_radius_mm = 0.8
speed_rpm = 600
feed_mm_per_rev = 0.2
[cut.actuator]
natural_frequency_hz = 600
damping = 0.7
sampling_hz = 20000
)";

constexpr std::string_view sweep =
    R"(# How good must the probe be, and how long the pass? A thousand simulated streams a cell against the
# limit that no method beats (Cramer and Rao):
#   trueaxis study sweep sweep.toml -o sweep
name = "noise of the probe and length of the pass"
seed = 1
repeats = 1000
methods = ["fit"]
scenario = "scenario.toml"

[[axis]]
key = "noise.sigma_um"
values = [0.5, 1, 2]

[[axis]]
key = "pass.length_mm"
values = [20, 40]
)";

constexpr StarterFile files[] = {
    {"scenario.toml", scenario}, {"job.toml", job}, {"cut.toml", cut}, {"sweep.toml", sweep}};

}  // namespace

std::span<const StarterFile> starter_files() { return files; }

}  // namespace trueaxis
