# SPDX-License-Identifier: Apache-2.0
"""Streams that are ordinary, and those that were once answered wrongly."""
import math
import random

from lathe import CONE, Part, case, helix


# --- ordinary streams: each must be measured ---------------------------------------------------

@case(ordinary=True)
def ordinary_cylinder():
    return helix()


@case("cone", ordinary=True, truth=CONE)
def ordinary_cone():
    return helix(CONE)


@case(ordinary=True)
def ordinary_wrapped():
    s = helix()
    s.c = [c % 360.0 for c in s.c]
    return s


@case(ordinary=True)
def ordinary_reversed():
    s = helix()
    return s.take(s.rows()[::-1])


LOBED = Part(skin=lambda th, s: 4e-3 * math.cos(3 * th + 0.7) + 1e-3 * math.cos(5 * th))


@case(ordinary=True, truth=LOBED, round_mm=9.4e-3)
def ordinary_lobes():
    return helix(LOBED)


@case(ordinary=True)
def ordinary_outliers():
    s = helix()
    for i in random.Random(4).sample(range(len(s.x)), 8):
        s.x[i] += 0.05
    return s


@case(ordinary=True)
def ordinary_coarse_sensor():
    s = helix(noise=0.0005)
    s.x = [round(x, 3) for x in s.x]
    return s


@case(ordinary=True)
def ordinary_rings():
    one = helix(turns=2, pitch=0.0, z0=10.0, seed=10)
    for k in range(1, 5):
        more = helix(turns=2, pitch=0.0, z0=10.0 + 5 * k, seed=10 + k)
        one.x += more.x
        one.c += [c + 720.0 * k for c in more.c]
        one.z += more.z
    return one


# --- known of old -------------------------------------------------------------------------------

def after(first, second, share=0.55):
    """The rows of the first stream, and from `share` on those of the second."""
    n = int(share * len(first.x))
    return first.take(first.rows()[:n] + second.rows()[n:])


MOVED = Part(x=0.082, y=-0.015, sx=3e-4, sy=2e-4)
TILTED = Part(x=0.070, y=-0.035, sx=6e-4, sy=-2e-4)


@case(truth=MOVED)
def slip_shift():
    return after(helix(), helix(MOVED, seed=2))


@case(truth=TILTED)
def slip_tilt():
    return after(helix(), helix(TILTED, seed=2))


@case(truth=Part(x=0.064, y=-0.033))
def slip_small():
    return after(helix(), helix(Part(x=0.064, y=-0.033), seed=2))


@case(truth=MOVED)
def slip_early():
    return after(helix(), helix(MOVED, seed=2), 0.2)


@case(truth=MOVED)
def slip_late():
    return after(helix(), helix(MOVED, seed=2), 0.9)


@case()
def gon_wrapped_at_400():
    s = helix()
    s.c = [(c / 0.9) % 400.0 for c in s.c]
    return s


@case()
def gon_running():
    s = helix()
    s.c = [c / 0.9 for c in s.c]
    return s


@case()
def c_falls_rpm_positive():
    s = helix(t=1.0)
    s.c = [-c for c in s.c]
    s.keys.append("spindle_rpm: 60")
    return s


@case(unseen="probe.latency")
def lag_of_50_ms():
    s = helix(t=1.0, lag=math.radians(18.0))
    s.keys.append("spindle_rpm: 60")
    return s


def gear(teeth, depth):
    return Part(skin=lambda th, s: depth * max(-1.0, min(1.0, 2.5 * math.cos(teeth * th + 1.0))))


for teeth_, depth_ in ((24, 1.0), (37, 1.0), (37, 0.02), (36, 0.05), (73, 0.1), (110, 0.01)):
    def make(teeth=teeth_, depth=depth_):
        return helix(gear(teeth, depth))
    make.__name__ = f"gear_{teeth_}_{1000 * depth_:.0f}um"
    case(truth=gear(teeth_, depth_), round_mm=None)(make)


def knurl_of_37_at_36():
    return helix(gear(37, 0.02), per_turn=36.0)


case(truth=gear(37, 0.02), round_mm=None, unseen="part.roundness")(knurl_of_37_at_36)


@case()
def c_noise_3_deg():
    return helix(wobble=math.radians(3.0))


@case()
def c_noise_3_deg_many():
    return helix(wobble=math.radians(3.0), turns=220, pitch=0.2, per_turn=107.3)


@case(truth=Part(x=0.9, y=-0.7))
def c_noise_3_deg_far_off():
    p = Part(x=0.9, y=-0.7)
    return helix(p, wobble=math.radians(3.0))


@case()
def stuck_in_the_middle():
    s = helix()
    s.x[400:600] = [s.x[400]] * 200
    return s


@case()
def stuck_at_the_end():
    s = helix()
    s.x[950:] = [s.x[950]] * len(s.x[950:])
    return s


LOBES3 = Part(skin=lambda th, s: 5e-3 * math.cos(3 * th + 0.4))


@case(truth=LOBES3, round_mm=1e-2)
def four_readings_on_three_lobes():
    return helix(LOBES3, per_turn=4.0, turns=60, pitch=0.5)


@case(truth=LOBES3, round_mm=1e-2)
def four_readings_nearly():
    return helix(LOBES3, per_turn=4.004, turns=60, pitch=0.5)


LOBES5 = Part(skin=lambda th, s: 5e-3 * math.cos(5 * th + 0.4))


@case(truth=LOBES5, round_mm=1e-2)
def six_readings_on_five_lobes():
    return helix(LOBES5, per_turn=6.0, turns=60, pitch=0.5)


LOBES11 = Part(skin=lambda th, s: 5e-3 * math.cos(11 * th + 0.4))


@case(truth=LOBES11, round_mm=1e-2, unseen="part.roundness")
def twelve_readings_on_eleven_lobes():
    return helix(LOBES11, per_turn=12.0)
