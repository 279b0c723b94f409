# SPDX-License-Identifier: Apache-2.0
"""Table 1 as a Monte Carlo study with numpy and scipy, on as many processes as there are cores.

sweep_scipy.py REPEATS LENGTH_MM...: the plan, noise and part of scripts/bench_sweep; what does not depend on the
repeat (clean readings, sin C, cos C) is computed once a length. Start, tolerances and Jacobian are those of
peers_scipy.py. Prints a JSON line: seconds from the first draw to the last RMSE, and the RMSE of each parameter.
"""

import json
import multiprocessing
import os
import sys
import time

import numpy as np
from peers_scipy import COST_TOLERANCE, NOMINAL, PARAMETER_TOLERANCE, jacobian, root
from scipy.optimize import least_squares

TRUTH = np.array([0.05, 0.1, 0.0002, 0.0009, 402.0, np.deg2rad(15.5)])
SIGMA_MM = 0.01
SHARE = 50  # repeats handed out together


def plan(length_mm):
    i = np.arange(int(np.floor(length_mm / 0.02 + 1e-9)) + 1)
    return 2.0 * np.pi * i / 10.0, -40.0 + 0.02 * i


def processor_seconds(pool):
    """Of this process and those of the pool so far."""
    ticks = 0
    for process in pool._pool:
        fields = open(f"/proc/{process.pid}/stat", encoding="utf-8").read().rsplit(")", 1)[1].split()
        ticks += int(fields[11]) + int(fields[12])
    return time.process_time() + ticks / os.sysconf("SC_CLK_TCK")


def errors(task):
    length_mm, seed, repeats = task
    c, z = plan(length_mm)
    cos_c, sin_c = np.cos(c), np.sin(c)
    clean = root(TRUTH, cos_c, sin_c, z)[0]
    random = np.random.default_rng(seed)
    out = np.empty((repeats, 6))
    for repeat in range(repeats):
        x = clean + SIGMA_MM * random.standard_normal(clean.size)
        result = least_squares(lambda p: root(p, cos_c, sin_c, z)[0] - x, NOMINAL,
                               jac=lambda p: jacobian(p, cos_c, sin_c, z), method="lm", x_scale="jac",
                               ftol=COST_TOLERANCE, xtol=PARAMETER_TOLERANCE, gtol=np.finfo(float).eps)
        out[repeat] = result.x - TRUTH
    return out


def main(repeats, lengths):
    tasks = [(length, [number, first], min(SHARE, repeats - first))
             for number, length in enumerate(lengths) for first in range(0, repeats, SHARE)]
    with multiprocessing.Pool(os.cpu_count()) as pool:
        pool.map(errors, [(lengths[0], [0, 0], 1)] * os.cpu_count())  # every process has its imports
        begun, spent = time.perf_counter(), processor_seconds(pool)
        parts = pool.map(errors, tasks, chunksize=1)
        rows = np.concatenate(parts).reshape(len(lengths), repeats, 6)
        rmse = np.sqrt(np.mean(rows**2, axis=1))
        seconds = time.perf_counter() - begun
        spent = processor_seconds(pool) - spent
    rmse[:, 5] = np.rad2deg(rmse[:, 5])
    print(json.dumps({"seconds": seconds, "processor_seconds": spent, "streams": repeats * len(lengths), "rmse": rmse.tolist()}))


if __name__ == "__main__":
    main(int(sys.argv[1]), [float(text) for text in sys.argv[2:]])
