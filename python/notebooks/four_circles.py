# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Roundness by four circles
#
# A profile of 240 points is evaluated about the least-squares, minimum-zone, minimum circumscribed and maximum inscribed circle
# (ISO 12181-1). SciPy finds each as a constrained minimum of its own, and Gauss-Newton in NumPy finds the first.

# %%
import numpy as np
from scipy.optimize import linprog

import trueaxis as ta

rng = np.random.default_rng(12)
angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, 240))
radius = 15.0 + 0.004 * np.cos(3 * angle + 0.4) + 0.002 * np.cos(7 * angle) + rng.normal(0.0, 2e-4, angle.size)
points = np.stack([0.02 + radius * np.cos(angle), -0.01 + radius * np.sin(angle), 0 * angle], axis=1)


def distances(circle):
    """Distance of each point from the centre (x, y)."""
    return np.hypot(points[:, 0] - circle[0], points[:, 1] - circle[1])


# %% [markdown]
# Gauss-Newton for the least-squares circle.

# %%
def least_squares_circle():
    x, y, r = points[:, 0].mean(), points[:, 1].mean(), 15.0
    for _ in range(20):
        d = distances((x, y))
        j = np.stack([(points[:, 0] - x) / d, (points[:, 1] - y) / d, np.ones_like(d)], axis=1)
        step = np.linalg.lstsq(j, d - r, rcond=None)[0]
        x, y, r = x + step[0], y + step[1], r + step[2]
    return x, y, r


# %% [markdown]
# The other three by linear programs: distances are linear in the centre to first order, and each program starts from the
# centre of the one before. Unknowns are x, y, the inner and the outer radius.

# %%
x0, y0, r0 = least_squares_circle()


def extreme_circle(goal, inner, outer):
    """The centre with the least goal · (x, y, inner, outer), every point outside of the inner and inside of the outer circle."""
    x, y = x0, y0
    for _ in range(8):
        d = distances((x, y))
        sx, sy, one, none = (x - points[:, 0]) / d, (y - points[:, 1]) / d, np.ones_like(d), np.zeros_like(d)
        rows, limits = [], []
        if inner:  # inner <= d + sx dx + sy dy
            rows.append(np.stack([-sx, -sy, one, none], axis=1))
            limits.append(d)
        if outer:  # d + sx dx + sy dy <= outer
            rows.append(np.stack([sx, sy, none, -one], axis=1))
            limits.append(-d)
        found = linprog(goal, np.concatenate(rows), np.concatenate(limits),
                        bounds=[(-0.1, 0.1), (-0.1, 0.1), (0, 20), (0, 20)], method="highs",
                        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10})
        x, y = x + found.x[0], y + found.x[1]
    return x, y


centres = {
    "gaussian": (x0, y0),
    "minimum_zone": extreme_circle(np.array([0.0, 0.0, -1.0, 1.0]), True, True),
    "minimum_circumscribed": extreme_circle(np.array([0.0, 0.0, 0.0, 1.0]), False, True),
    "maximum_inscribed": extreme_circle(np.array([0.0, 0.0, -1.0, 0.0]), True, False),
}

# %%
print("criterion               roundness µm: TrueAxis   SciPy / NumPy")
for criterion, centre in centres.items():
    found = ta.associate(points, element="circle", criterion=criterion)
    zone_um = 1e3 * np.ptp(found.distance_mm)
    peer_um = 1e3 * np.ptp(distances(centre))
    print(f"{criterion:24s} {zone_um:18.5f} {peer_um:15.5f}")
    # The linear programs meet their bounds to 1e-10 mm, and the range follows the centre with a slope of 2 at most.
    assert abs(zone_um - peer_um) < 1e-5, criterion

# %% [markdown]
# The form evaluation has the same four values without a filter, each with its U.

# %%
form = ta.form(points, element="circle", filter="none")
print(form)

# %%
form.plot()
