# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Plan a measurement, and check the plan by Monte Carlo
#
# How many readings per revolution does an axis with U = 1 µm need? TrueAxis plans with the Cramér-Rao bound and confirms by
# simulated fits. Here NumPy computes the bound of a cylinder and repeats the measurement.

# %%
import numpy as np

import trueaxis as ta

GOAL_UM, RADIUS_MM, LENGTH_MM, FEED_MM, SIGMA_UM = 1.0, 25.0, 30.0, 0.5, 3.0
plan = ta.plan(goal_um=GOAL_UM, surface="cylinder", radius_mm=RADIUS_MM, length_mm=LENGTH_MM, feed_mm=FEED_MM,
               sigma_um=SIGMA_UM, free={"readings_per_revolution": (4, 200)}, repeats=1000)
print(plan)

# %% [markdown]
# ## The bound in NumPy
#
# Near the spindle axis X = R + x(Z) cos C + y(Z) sin C with x and y linear in Z. U = 2 u at the end that is less
# certain, in the worse direction.


# %%
def design(per_revolution):
    count = int(np.floor(LENGTH_MM / FEED_MM * per_revolution + 1e-9)) + 1
    turn = np.arange(count) / per_revolution
    c, z = 2.0 * np.pi * turn, FEED_MM * turn
    s = z / LENGTH_MM
    ends = [(1.0 - s) * np.cos(c), (1.0 - s) * np.sin(c), s * np.cos(c), s * np.sin(c)]  # columns of the axis at both ends
    return np.stack([np.ones_like(c), *ends], axis=1)


def worst_u(covariance):
    return np.sqrt(max(np.linalg.eigvalsh(covariance[i:i + 2, i:i + 2])[-1] for i in (1, 3)))


def bound_um(per_revolution):
    j = design(per_revolution)
    return 2.0 * SIGMA_UM * worst_u(np.linalg.inv(j.T @ j))


chosen = plan.recommended[0].plan
per_revolution = chosen.readings_per_revolution.value
print(f"TrueAxis: {per_revolution:g} readings per revolution, U = {1e3 * chosen.U.value:.4f} µm")
print(f"NumPy:    U = {bound_um(per_revolution):.4f} µm there, {bound_um(per_revolution - 1):.4f} µm with one reading fewer")
# The first-order model is exact about the spindle axis; the two plans differ by one reading at the end at most.
assert abs(1e3 * chosen.U.value / bound_um(per_revolution) - 1.0) < 2.0 / len(design(per_revolution)) * 5
assert bound_um(per_revolution) <= GOAL_UM * 1.01

# %% [markdown]
# ## The measurement, 4000 times

# %%
j = design(per_revolution)
rng = np.random.default_rng(1)
errors_um = np.linalg.lstsq(j, rng.normal(0.0, SIGMA_UM, (len(j), 4000)), rcond=None)[0]
simulated_um = 2.0 * worst_u(np.cov(errors_um))
confirmed = plan.recommended[0].confirmed
print(f"U of 4000 repeats in NumPy {simulated_um:.3f} µm, of {confirmed.repeats} fits of TrueAxis {1e3 * confirmed.U.value:.3f} µm")
assert abs(simulated_um / bound_um(per_revolution) - 1.0) < 4.5 / np.sqrt(2 * 4000)
assert abs(1e3 * confirmed.U.value / simulated_um - 1.0) < 4.5 / np.sqrt(2 * confirmed.repeats)

# %%
from matplotlib.figure import Figure

figure = Figure(figsize=(5, 3.4), layout="constrained")
axes = figure.add_subplot()
many = np.arange(4, 61)
axes.plot(many, [bound_um(n) for n in many], label="Cramér-Rao bound, NumPy")
axes.plot(per_revolution, 1e3 * confirmed.U.value, "o", label="confirmed by TrueAxis")
axes.axhline(GOAL_UM, color="gray", lw=0.8)
axes.set(title="U of the axis", xlabel="readings per revolution", ylabel="U (k = 2), µm")
axes.legend(frameon=False)
figure
