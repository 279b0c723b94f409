# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Find the hidden effect
#
# The virtual lathe probes a part with three lobes, which only its truth states. A diagnosis finds and names them. NumPy finds
# the same order and amplitude by a regression that is written out here.

# %%
import numpy as np

import trueaxis as ta

AMPLITUDE_MM, ORDER, SIGMA_MM = 0.004, 3, 0.001
made = ta.simulate({
    "part": {"surface": "cylinder", "radius_mm": 20.0, "x0_mm": 0.06, "y0_mm": -0.03},
    "noise": {"sigma_mm": SIGMA_MM},
    "pass": [{"z_start_mm": 0.0, "z_end_mm": -30.0, "feed_mm_per_rev": 1.03, "speed_rpm": 60,
              "readings_per_revolution": 48}],
    "effect": [{"id": "part.roundness", "order": ORDER, "amplitude_mm": AMPLITUDE_MM, "phase_deg": 20}],
}, seed=5)
stream = made.stream
diagnosis = ta.diagnose(stream, surface="cylinder")
print(diagnosis)

# %% [markdown]
# ## The same in NumPy
#
# The cylinder to first order (1, cos C, sin C, Z cos C, Z sin C) and a wave of each order from 2 to 12, by linear least squares.

# %%
c, z, x = stream.c_rad, stream.position_mm, stream.reading_mm
zm = (z - z.mean()) / np.ptp(z)
# To second order the circle off-centre adds −(x0 sin C − y0 cos C)² / 2R: a column of its own, of known size.
centre = np.linalg.lstsq(np.stack([np.ones_like(c), np.cos(c), np.sin(c)], 1), x, rcond=None)[0]
slant = -(centre[1] * np.sin(c) - centre[2] * np.cos(c)) ** 2 / (2.0 * centre[0])
surface = np.stack([np.ones_like(c), np.cos(c), np.sin(c), zm * np.cos(c), zm * np.sin(c)], 1)
rows = []
for n in range(2, 13):
    columns = np.column_stack([surface, np.cos(n * c), np.sin(n * c)])
    b, rest, _, _ = np.linalg.lstsq(columns, x - slant, rcond=None)
    u = np.sqrt(rest[0] / (len(x) - 7) * np.linalg.inv(columns.T @ columns)[5, 5])
    rows.append((n, np.hypot(b[5], b[6]), u))
order, amplitude, u_numpy = max(rows, key=lambda row: row[1])
print(f"NumPy: order {order}, amplitude {1e3 * amplitude:.3f} µm, u {1e3 * u_numpy:.3f} µm")

# %%
named = [one for one in diagnosis.findings if "part.roundness" in one["class"]]
assert len(named) == 1 and diagnosis.verdict == "effects"
stated = named[0].parameters
print(f"TrueAxis: order {stated.order.value:g}, amplitude {stated.amplitude}")
assert stated.order.value == order == ORDER
found_mm = stated.amplitude.value * {"mm": 1.0, "um": 1e-3}[stated.amplitude.unit]
# The same least squares to first order: what differs is of second order in the offset, 67 µm² / 20 mm, and far below u.
assert abs(found_mm - amplitude) < 0.2 * u_numpy, (found_mm, amplitude)
assert abs(found_mm - AMPLITUDE_MM) < 4.5 * u_numpy

# %%
diagnosis.plot()
