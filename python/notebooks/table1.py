# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # How long must a cone be probed?
#
# A cone is probed along a helix, 10 readings per revolution, 0.2 mm per revolution, σ = 10 µm (Table 1 of Constantin et al.).
# Each fit is compared with `scipy.optimize.least_squares` on the same arrays, and its u with the Cramér-Rao bound in NumPy.

# %%
import numpy as np
from scipy.optimize import least_squares

import trueaxis as ta

NAMES = ("x0", "y0", "l", "m", "k", "half_angle")
TRUTH = np.array([0.05, 0.1, 0.0002, 0.0009, 402.0, np.radians(15.5)])
SIGMA_MM = 0.010


def plan(length_mm):
    """C (rad) and Z (mm) of the helix."""
    readings = np.arange(int(length_mm / 0.2 * 10) + 1)
    return 2.0 * np.pi * readings / 10.0, 0.02 * readings


# %% [markdown]
# The probe line meets a cone with apex a, axis d and half angle α where ((p − a)·d)² = cos²α |p − a|², a quadratic in X.

# %%
def reading(parameters, c, z):
    """X in front (mm): the larger root."""
    x0, y0, l, m, k, half_angle = parameters
    d = np.array([l, m, np.sqrt(1.0 - l * l - m * m)])
    apex = np.array([x0, y0, 0.0]) + k * d
    e = np.stack([np.cos(c), np.sin(c), 0 * c], axis=1)  # the probe line in the part frame: p = X e + (0, 0, Z)
    o = np.stack([0 * c, 0 * c, z], axis=1) - apex
    cos2 = np.cos(half_angle) ** 2
    a = (e @ d) ** 2 - cos2
    b = 2.0 * ((e @ d) * (o @ d) - cos2 * np.sum(e * o, axis=1))
    q = (o @ d) ** 2 - cos2 * np.sum(o * o, axis=1)
    return (-b - np.sqrt(b * b - 4.0 * a * q)) / (2.0 * a)  # a < 0: this is the larger one


def jacobian(parameters, c, z):
    """By central differences, columns scaled to their sizes."""
    columns = []
    for i, step in enumerate((1e-4, 1e-4, 1e-6, 1e-6, 1e-3, 1e-6)):
        up, down = parameters.copy(), parameters.copy()
        up[i] += step
        down[i] -= step
        columns.append((reading(up, c, z) - reading(down, c, z)) / (2.0 * step))
    return np.stack(columns, axis=1)


def bound(c, z):
    """Cramér-Rao: least standard deviation of an unbiased estimate."""
    j = jacobian(TRUTH, c, z)
    scale = np.linalg.norm(j, axis=0)
    return SIGMA_MM * np.sqrt(np.diag(np.linalg.inv((j / scale).T @ (j / scale)))) / scale


# %% [markdown]
# One stream of each length: TrueAxis and SciPy minimise the same sum of squares, so they must agree far within u.

# %%
rng = np.random.default_rng(20261121)
print("length  u(x0) µm  u(half angle) °  |TrueAxis − SciPy| / u")
for length_mm in (10, 20, 30, 40, 50):
    c, z = plan(length_mm)
    x = reading(TRUTH, c, z) + rng.normal(0.0, SIGMA_MM, len(c))
    fit = ta.fit(x, c, z, surface="cone", x_unit="mm radius", c_unit="rad", z_unit="mm", noise_um=1e3 * SIGMA_MM)
    mine = np.array([getattr(fit, name).value for name in NAMES])
    mine[-1] = np.radians(mine[-1])
    peer = least_squares(lambda p: reading(p, c, z) - x, TRUTH, jac=lambda p: jacobian(p, c, z), x_scale="jac",
                         xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    u = bound(c, z)
    apart = np.max(np.abs(mine - peer) / u)
    print(f"{length_mm:4d} mm {1e3 * u[0]:8.2f} {np.degrees(u[-1]):16.5f} {apart:18.1e}")
    # The cost is flat to rounding over √(1e-16 · n) standard deviations about its minimum: 1e-6 for these n.
    assert apart < 1e-4, apart
    stated = np.array([getattr(fit, name).u for name in NAMES])
    stated[-1] = np.radians(stated[-1])
    # TrueAxis takes the σ of the residuals if that is larger than the stated one: by 4.5 / √(2n) at most. A hundredth is left
    # for u at the fitted instead of the true parameters.
    assert np.all(stated > 0.99 * u) and np.all(stated < (1.01 + 4.5 / np.sqrt(2 * len(c))) * u), stated / u

# %% [markdown]
# 300 streams of 20 mm: the scatter of the estimates is the bound.

# %%
c, z = plan(20)
clean = reading(TRUTH, c, z)
found = []
for _ in range(300):
    x = clean + rng.normal(0.0, SIGMA_MM, len(c))
    fit = ta.fit(x, c, z, surface="cone", x_unit="mm radius", c_unit="rad", z_unit="mm")
    found.append([getattr(fit, name).value for name in NAMES])
ratio = np.std(found, axis=0, ddof=1) / (bound(c, z) * np.array([1, 1, 1, 1, 1, np.degrees(1.0)]))
for name, one in zip(NAMES, ratio):
    print(f"{name:10s} scatter / bound {one:.3f}")
assert np.all(np.abs(ratio - 1.0) < 4.5 / np.sqrt(2 * 300)), ratio  # 4.5 standard deviations of a standard deviation

# %%
fit.plot()
