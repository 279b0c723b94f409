# SPDX-License-Identifier: Apache-2.0
"""Columns of another unit, order or meaning."""
import math
import random

from lathe import CONE, HALF, Part, case, helix


@case()
def rows_shuffled():
    s = helix()
    rows = s.rows()
    random.Random(3).shuffle(rows)
    return s.take(rows)


@case()
def x_shuffled():
    s = helix()
    random.Random(3).shuffle(s.x)
    return s


@case()
def c_shuffled():
    s = helix()
    random.Random(3).shuffle(s.c)
    return s


@case()
def z_shuffled():
    s = helix()
    random.Random(3).shuffle(s.z)
    return s


NOTHING = Part(x=0.0, y=0.0, sx=0.0, sy=0.0)  # of a channel that does not turn with C


@case(truth=NOTHING)
def other_channel_temperature():
    s = helix()
    s.x = [21.0 + 0.4 * (1 - math.exp(-i / 300)) + 1e-3 * (i * 7919 % 97) / 97 for i in range(len(s.x))]
    return s


@case(truth=NOTHING, round_mm=None)
def other_channel_mains():
    s = helix()
    rng = random.Random(5)
    s.x = [21.0 + 0.3 * math.sin(0.9 * i) + rng.gauss(0, 1e-3) for i in range(len(s.x))]
    return s


@case(truth=NOTHING)
def other_channel_random_walk():
    s = helix()
    rng, x = random.Random(6), 21.0
    for i in range(len(s.x)):
        x += rng.gauss(0, 3e-3)
        s.x[i] = x
    return s


@case(truth=HALF)
def two_revolutions_glued():
    a, b = helix(turns=6, pitch=0.0), helix(HALF, turns=6, pitch=0.0, seed=2)
    a.x += b.x
    a.c += [c + 6 * 360.0 for c in b.c]
    a.z += b.z
    return a


@case()
def point_lost_in_half_of_x():
    s = helix()
    s.x[600:] = [10 * x for x in s.x[600:]]
    return s


@case()
def point_lost_in_half_of_z():
    s = helix()
    s.z[600:] = [0.1 * z for z in s.z[600:]]
    return s


@case()
def point_lost_in_some_c():
    s = helix()
    for i in range(30, len(s.c), 61):
        s.c[i] /= 10
    return s


@case()
def x_half_in_inch():
    s = helix()
    s.x[500:] = [x / 25.4 for x in s.x[500:]]
    return s


@case()
def z_half_in_inch():
    s = helix()
    s.z[500:] = [z / 25.4 for z in s.z[500:]]
    return s


@case("cone", truth=CONE)
def cone_z_half_in_inch():
    s = helix(CONE)
    s.z[500:] = [z / 25.4 for z in s.z[500:]]
    return s


@case()
def x_half_a_diameter():
    s = helix()
    s.x[500:] = [2 * x for x in s.x[500:]]
    return s


@case()
def c_half_in_radians():
    s = helix()
    s.c[500:] = [math.radians(c) for c in s.c[500:]]
    return s


@case()
def c_triangle():
    s = helix()
    s.c = [abs((c + 180.0) % 360.0 - 180.0) for c in s.c]
    return s


@case()
def c_triangle_of_360():
    s = helix()
    s.c = [abs((c + 360.0) % 720.0 - 360.0) for c in s.c]
    return s


@case(truth=None)
def c_constant():
    s = helix()
    s.c = [30.0] * len(s.c)
    return s


@case(truth=None)
def x_constant():
    s = helix()
    s.x = [21.0] * len(s.x)
    return s


@case(truth=None)
def z_constant():
    s = helix()
    s.z = [12.0] * len(s.z)
    return s
