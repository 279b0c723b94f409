# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Form and spindle from three probes
#
# Three sensors read a round part in one recording: form of the part and motion of the spindle are in all of them. The weighted
# sum in which the motion cancels gives the form (Whitehouse 1976). It is written out in NumPy and compared with TrueAxis.

# %%
import numpy as np

import trueaxis as ta

ANGLES_DEG = np.array([0.0, 55.0, 113.2])
PER_TURN, TURNS, SIGMA_MM = 256, 20, 2e-5
rng = np.random.default_rng(7)
c = 2.0 * np.pi * np.arange(PER_TURN * TURNS) / PER_TURN
phi = np.radians(ANGLES_DEG)
FORM = {2: 8e-4 * np.exp(0.7j), 3: 5e-4, 5: 2e-4j}  # mm: Re F exp(i n ψ) at the angle ψ in the part
MOTION_X, MOTION_Y = {2: 4e-4, 4: 1e-4j}, {2: 3e-4j}


def wave(terms, angle):
    return sum(np.real(f * np.exp(1j * n * angle)) for n, f in terms.items())


# %% [markdown]
# A sensor at angle φ meets the part at ψ = C + φ, and feels the motion along its own direction.

# %%
x = np.stack([20.0 + 0.0002 * np.cos(c + one) + wave(FORM, c + one) + wave(MOTION_X, c) * np.cos(one)
              + wave(MOTION_Y, c) * np.sin(one) for one in phi], axis=1)
x += rng.normal(0.0, SIGMA_MM, x.shape)

# %%
stream = ta.stream(x, c, x_unit="mm radius", c_unit="rad", sensor_angles_deg=ANGLES_DEG)
found = ta.spindle(stream, order_max=15)
print(found)

# %% [markdown]
# ## The same in NumPy
#
# Weights a with a₁ = 1 and Σ a cos φ = Σ a sin φ = 0 cancel every motion; order n of the sum is then F_n Σ a exp(i n φ).

# %%
weights = np.concatenate([[1.0], np.linalg.solve([np.cos(phi[1:]), np.sin(phi[1:])], [-np.cos(phi[0]), -np.sin(phi[0])])])
combined = x @ weights
u_numpy = SIGMA_MM * np.linalg.norm(weights) * np.sqrt(2.0 / len(c))
print("order  TrueAxis µm   NumPy µm    apart µm     u µm")
for entry in found.radial.orders:
    n = entry.order
    if "suppressed" in entry:
        continue
    transfer = np.sum(weights * np.exp(1j * n * phi))
    mine = 2.0 * np.mean(combined * np.exp(-1j * n * c)) / transfer  # cos − i sin
    theirs = entry.form.cos - 1j * entry.form.sin
    apart, u = abs(mine - theirs), u_numpy / abs(transfer)
    print(f"{n:4d} {1e3 * abs(theirs):12.5f} {1e3 * abs(mine):11.5f} {1e3 * apart:11.5f} {1e3 * u:9.5f}")
    # Three sensors and three unknowns per order: both solve the same equations from the same Fourier sums. TrueAxis also counts
    # that an eccentricity e moves the contact around the part, which changes an order by up to n A e / R = 0.03 nm.
    assert apart < 0.2 * u, n
    assert abs(mine - FORM.get(n, 0.0)) < 4.5 * u, n

# %%
found.plot()
