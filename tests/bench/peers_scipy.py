# SPDX-License-Identifier: Apache-2.0
"""The cone fit with scipy.optimize.least_squares(method="lm"), vectorised over the readings.

peers_scipy.py scipy_analytic|scipy_numeric FILE SECONDS: the same file, start and tolerances as
peers.cpp; prints the same JSON line. Parameters: x0, y0, l, m, k, half angle (mm, rad).
"""

import json
import sys
import time

import numpy as np
from scipy.optimize import least_squares

NOMINAL = np.array([0.0, 0.0, 0.0, 0.0, 400.0, np.deg2rad(15.0)])
COST_TOLERANCE = 1e-15
PARAMETER_TOLERANCE = 1e-13
MOST_REPETITIONS = 2000


def root(p, cos_c, sin_c, z):
    """Larger root of A X² + 2 B X + C = 0 (Constantin et al. Eqs. 7-11), and what led to it."""
    x0, y0, l, m, k, half_angle = p
    n = np.sqrt(1.0 - l * l - m * m)
    cos2 = np.cos(half_angle) ** 2
    wx, wy, wz = -x0 - k * l, -y0 - k * m, z - k * n
    ed = l * cos_c + m * sin_c
    wd = wx * l + wy * m + wz * n
    a = cos2 - ed * ed
    b = cos2 * (wx * cos_c + wy * sin_c) - ed * wd
    c = cos2 * (wx * wx + wy * wy + wz * wz) - wd * wd
    half_slope = np.sqrt(b * b - a * c)
    return (half_slope - b) / a, half_slope, wx, wy, wz


def jacobian(p, cos_c, sin_c, z):
    """dX/dp = −F_p / F_X of F = cos²a |v|² − (v·d)²."""
    _, _, l, m, k, half_angle = p
    x, half_slope, wx, wy, wz = root(p, cos_c, sin_c, z)
    n = np.sqrt(1.0 - l * l - m * m)
    cos2 = np.cos(half_angle) ** 2
    vx, vy = x * cos_c + wx, x * sin_c + wy
    s = vx * l + vy * m + wz * n
    scale = -1.0 / half_slope
    turn = -scale * (k * cos2 + s)
    columns = np.empty((x.size, 6))
    columns[:, 0] = scale * (s * l - cos2 * vx)
    columns[:, 1] = scale * (s * m - cos2 * vy)
    columns[:, 2] = turn * (vx - wz * (l / n))
    columns[:, 3] = turn * (vy - wz * (m / n))
    columns[:, 4] = scale * s * (1.0 - cos2)
    columns[:, 5] = scale * (-0.5 * np.sin(2.0 * half_angle)) * (vx * vx + vy * vy + wz * wz)
    return columns


def fit(c, z, x, analytic):
    cos_c, sin_c = np.cos(c), np.sin(c)
    start = time.perf_counter()
    result = least_squares(
        lambda p: root(p, cos_c, sin_c, z)[0] - x, NOMINAL,
        jac=(lambda p: jacobian(p, cos_c, sin_c, z)) if analytic else "2-point",
        method="lm", x_scale="jac", ftol=COST_TOLERANCE, xtol=PARAMETER_TOLERANCE,
        gtol=np.finfo(float).eps)  # the least it takes: the test on the gradient is off
    return result, 1e3 * (time.perf_counter() - start)


def main(code, path, seconds):
    analytic = {"scipy_analytic": True, "scipy_numeric": False}[code]
    c, z, x = np.fromfile(path).reshape(3, -1)
    result, _ = fit(c, z, x, analytic)
    whole_ms, solver_ms = [], []
    begin = time.perf_counter()
    while not whole_ms or (time.perf_counter() - begin < seconds
                           and len(whole_ms) < MOST_REPETITIONS):
        start = time.perf_counter()
        result, solver = fit(c, z, x, analytic)
        whole_ms.append(1e3 * (time.perf_counter() - start))
        solver_ms.append(solver)
    peak_kib = next(int(line.split()[1]) for line in open("/proc/self/status")
                    if line.startswith("VmHWM"))  # ru_maxrss would count the parent's too
    print(json.dumps({
        "code": code, "readings": x.size, "ms": whole_ms, "solver_ms": solver_ms,
        "p": list(result.x), "iterations": int(result.njev or result.nfev // (NOMINAL.size + 1)),
        "converged": bool(result.success), "peak_mib": peak_kib / 1024.0}))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]))
