# SPDX-License-Identifier: Apache-2.0
"""Parts that are none of revolution, files put together, probes and encoders that fail."""
import math
import random

from lathe import CONE, HALF, TURN, Part, case, helix, turned


class Sphere(Part):
    def outside(self, px, py, z):
        return math.dist((px, py, z), (self.x, self.y, 22.0)) - 26.0


@case(truth=None)
def sphere():
    return helix(Sphere())


@case("cone", truth=None)
def sphere_flank():
    return helix(Sphere(), turns=10, z0=27.0)


def thread_skin(th, s):
    u = (s / 1.5 - th / TURN) % 1.0
    return -0.9 * abs(2 * u - 1)


@case(truth=Part(skin=thread_skin), round_mm=None)
def thread():
    return helix(Part(skin=thread_skin), pitch=0.37)


def flats(sides, apothem):
    def skin(th, s):
        return apothem / math.cos((th + 0.2) % (TURN / sides) - TURN / sides / 2) - 21.0
    return Part(skin=skin)


@case(truth=flats(6, 20.0), round_mm=None)
def hexagon():
    return helix(flats(6, 20.0))


@case(truth=flats(4, 17.0), round_mm=None)
def square():
    return helix(flats(4, 17.0))


@case(truth=flats(3, 12.0), round_mm=None)
def triangle():
    return helix(flats(3, 12.0))


ELLIPSE = Part(skin=lambda th, s: 0.5 * math.cos(2 * th + 0.3))


@case(truth=ELLIPSE, round_mm=1.0)
def ellipse():
    return helix(ELLIPSE)


SPLINE = Part(skin=lambda th, s: -0.3 if (th * 8 / TURN) % 1.0 < 0.3 else 0.0)


@case(truth=SPLINE, round_mm=None)
def spline_shaft():
    return helix(SPLINE)


@case()
def two_files_of_one_part():
    a, b = helix(), helix(seed=2)
    a.x, a.c, a.z = a.x + b.x, a.c + b.c, a.z + b.z
    return a


@case(truth=HALF)
def two_files_of_two_parts():
    a, b = helix(), helix(HALF, seed=2)
    a.x, a.c, a.z = a.x + b.x, a.c + b.c, a.z + b.z
    return a


SMALLER = Part(x=0.018, y=0.071, r=17.0)


@case(truth=SMALLER)
def two_parts_of_other_radius():
    a, b = helix(), helix(SMALLER, seed=2)
    a.x, a.c, a.z = a.x + b.x, a.c + b.c, a.z + b.z
    return a


@case()
def time_backwards():
    s = helix(t=1.0)
    s.t = s.t[::-1]
    return s


@case()
def time_backwards_in_half():
    s = helix(t=1.0)
    s.t[500:] = s.t[500:][::-1]
    return s


@case()
def probe_saturates():
    s = helix()
    limit = sorted(s.x)[int(0.7 * len(s.x))]
    s.x = [min(x, limit) for x in s.x]
    return s


@case()
def probe_saturates_both_ways():
    s = helix()
    ordered = sorted(s.x)
    low, high = ordered[int(0.3 * len(s.x))], ordered[int(0.7 * len(s.x))]
    s.x = [max(low, min(x, high)) for x in s.x]
    return s


@case()
def sign_of_half_of_x():
    s = helix()
    s.x[500:] = [-x for x in s.x[500:]]
    return s


@case()
def degrees_as_radians():
    s = helix()
    s.head = "X_M[mm],C[rad],Z[mm]"
    return s


@case()
def radians_as_degrees():
    s = helix()
    s.c = [math.radians(c) for c in s.c]
    return s


@case()
def sorted_by_c():
    s = helix()
    s.c = [c % 360.0 for c in s.c]
    return s.take(sorted(s.rows(), key=lambda row: row[1]))


@case()
def sorted_by_x():
    s = helix()
    s.c = [c % 360.0 for c in s.c]
    return s.take(sorted(s.rows()))


@case()
def x_sorted_alone():
    s = helix()
    s.x.sort()
    return s


@case()
def every_row_twice():
    s = helix()
    return s.take([row for row in s.rows() for _ in range(2)])


@case()
def sampled_and_held():
    s = helix()
    s.x = [s.x[i - i % 3] for i in range(len(s.x))]
    return s


@case(truth=None)
def c_counts_degrees():
    s = helix()
    s.c = [float(i) for i in range(len(s.c))]
    return s


for factor_ in (0.5, 2.0, 0.98, 1.37):
    def make_c(factor=factor_):
        s = helix()
        s.c = [factor * c for c in s.c]
        return s
    make_c.__name__ = f"c_times_{factor_}"
    case(truth=None)(make_c)


@case(truth=turned(0.44))
def encoder_lost_pulses():
    s = helix()
    s.c[500:] = [c + math.degrees(0.44) for c in s.c[500:]]
    return s


@case(truth=turned(10 / 36.7 * TURN))
def x_ten_rows_late_in_half():
    s = helix()
    s.x[500:] = s.x[490:-10]
    return s


@case()
def probe_lifted_at_the_end():
    s = helix()
    for i in range(900, len(s.x)):
        s.x[i] = 21.4 + 1e-4 * (i - 900)
    return s


@case()
def drift_of_100_um():
    s = helix()
    s.x = [x + 0.1 * i / len(s.x) for i, x in enumerate(s.x)]
    return s


@case()
def gross_noise():
    return helix(noise=0.08)


@case()
def one_in_ten_is_far_off():
    s = helix()
    rng = random.Random(8)
    s.x = [x + (rng.uniform(-0.5, 0.5) if rng.random() < 0.1 else 0.0) for x in s.x]
    return s


@case()
def rectified_gauge():
    s = helix()
    s.x = [abs(x - 21.0) for x in s.x]
    s.keys += ["reading: relative", "nominal_radius: 21 mm"]
    return s


@case()
def dial_wraps_at_100_um():
    s = helix()
    s.x = [(x - 20.9) % 0.1 for x in s.x]
    s.keys += ["reading: relative", "nominal_radius: 21 mm"]
    return s


@case()
def play_of_10_um():
    s = helix()
    held = s.x[0]
    for i, x in enumerate(s.x):
        held = min(max(held, x - 0.005), x + 0.005)
        s.x[i] = held
    return s


@case()
def smoothed_over_9():
    s = helix()
    s.x = [sum(s.x[max(0, i - 4):i + 5]) / len(s.x[max(0, i - 4):i + 5]) for i in range(len(s.x))]
    return s


@case()
def half_a_turn_missing():
    s = helix()
    return s.take([row for row in s.rows() if row[1] % 360.0 < 170.0])


@case()
def angles_in_steps_of_45():
    s = helix()
    s.c = [45.0 * round(c / 45.0) for c in s.c]
    return s


@case()
def columns_x_and_c_exchanged():
    s = helix()
    s.x, s.c = s.c, s.x
    return s


@case("cone", truth=CONE)
def cone_columns_x_and_z_exchanged():
    s = helix(CONE)
    s.x, s.z = s.z, s.x
    return s


# The readings are those of a spindle that moves to and fro every second revolution: about the mean.
@case(truth=Part(x=0.040, y=0.018, sx=0.5e-4, sy=3e-4))
def parts_in_turn_by_revolution():
    a, b = helix(), helix(HALF, seed=2)
    return a.take([p if int(i / 36.7) % 2 else q for i, (p, q) in enumerate(zip(a.rows(), b.rows()))])


@case()
def thousands_without_a_point():
    s = helix()
    s.x = [round(1e3 * x) for x in s.x]
    return s
