# SPDX-License-Identifier: Apache-2.0
"""A probe and a part that share no line with the program, and the list of streams.

A part is a skin about a leaning axis; the contact of the probe is found by regula falsi on the signed
distance from it. Nothing here knows how the command checks its input.
"""
import math
import random

TURN = 2.0 * math.pi


class Part:
    """A skin r(theta, z) about a leaning axis. Slopes are tangents."""

    def __init__(self, x=0.062, y=-0.035, sx=3e-4, sy=2e-4, r=21.0, taper=0.0, skin=None):
        self.x, self.y, self.sx, self.sy, self.r, self.taper, self.skin = x, y, sx, sy, r, taper, skin

    def centre(self, z):
        return self.x + self.sx * z, self.y + self.sy * z

    def outside(self, px, py, z):
        """Distance from the axis less the skin's radius there."""
        # Foot of the perpendicular on the axis: minimise |P - A - s D|, D = (sx, sy, 1).
        s = (self.sx * (px - self.x) + self.sy * (py - self.y) + z) / (1 + self.sx**2 + self.sy**2)
        dx, dy, dz = px - self.x - s * self.sx, py - self.y - s * self.sy, z - s
        along = s * math.sqrt(1 + self.sx**2 + self.sy**2)
        skin = self.r + self.taper * along
        if self.skin:
            skin += self.skin(math.atan2(dy, dx), along)
        return math.sqrt(dx * dx + dy * dy + dz * dz) - skin

    def contact(self, c, z):
        """Where a probe along the machine's X meets the part that was turned by C."""
        low, high = 0.3 * self.r, 2.5 * self.r
        a, b = math.cos(c), math.sin(c)
        f_low, f_high = self.outside(low * a, low * b, z), self.outside(high * a, high * b, z)
        for _ in range(60):
            middle = low - f_low * (high - low) / (f_high - f_low)  # regula falsi, Illinois
            f = self.outside(middle * a, middle * b, z)
            if abs(f) < 1e-10:
                return middle
            if f * f_high < 0.0:
                low, f_low = high, f_high
            else:
                f_low *= 0.5
            high, f_high = middle, f
        return high


class Stream:
    def __init__(self, x, c, z, head="X_M[mm],C[deg],Z[mm]", keys=()):
        self.x, self.c, self.z, self.head = list(x), list(c), list(z), head
        self.keys = ["x_convention: radius", *keys]
        self.t = None

    def rows(self):
        columns = [self.x, self.c, self.z] + ([self.t] if self.t else [])
        return list(zip(*columns))

    def take(self, rows):
        columns = [list(column) for column in zip(*rows)]
        self.x, self.c, self.z = columns[:3]
        self.t = columns[3] if self.t else None
        return self

    def text(self):
        head = self.head + (",t[s]" if self.t else "")
        lines = ["# " + key for key in self.keys] + [head]
        lines += [",".join(f"{value:.7g}" if abs(value) >= 1e4 else f"{value:.6f}" for value in row)
                  for row in self.rows()]
        return "\n".join(lines) + "\n"


def helix(part=None, turns=30.0, per_turn=36.7, z0=8.0, pitch=1.0, noise=0.0015, seed=1, t=0.0,
          lag=0.0, wobble=0.0):
    """Angles in degrees. `t`: seconds a revolution; `lag`: of the probe behind C, radians; `wobble`:
    standard deviation of the recorded angle, radians."""
    part = part or Part()
    rng = random.Random(seed)
    x, c, z, time = [], [], [], []
    for i in range(int(turns * per_turn) + 1):
        u = i / per_turn
        true = TURN * u
        x.append(part.contact(true - lag, z0 + pitch * u) + rng.gauss(0.0, noise))
        c.append(math.degrees(true + rng.gauss(0.0, wobble)))
        z.append(z0 + pitch * u)
        time.append(u * t)
    out = Stream(x, c, z)
    if t:
        out.t = time
    return out


CASES = []


def case(surface="cylinder", ordinary=False, truth=Part(), round_mm=0.0, unseen=""):
    def add(make):
        CASES.append((make.__name__, make, surface, ordinary, truth, round_mm, unseen))
        return make
    return add


CONE = Part(taper=0.11, x=-0.041, y=0.052)
HALF = Part(x=0.018, y=0.071, sx=-2e-4, sy=4e-4)


def turned(angle):
    """The part as it is once C reads `angle` more at the same place."""
    a, b = math.cos(angle), math.sin(angle)
    p = Part()
    return Part(x=p.x * a - p.y * b, y=p.x * b + p.y * a, sx=p.sx * a - p.sy * b, sy=p.sx * b + p.sy * a)
