#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Tables 1 and 2 of Constantin et al. against the bound, without the engine: where the expected
figures of tests/e2e/paper_tables_test.cpp come from. Needs numpy.

The larger root of the probe line on the cone, central differences of it, covariance
s² (JᵀJ)⁻¹ + (step of print)²/12, Gaussian log-likelihood of the printed errors."""

import numpy as np

NAMES = ["x0", "y0", "l", "m", "k", "half_angle"]
TRUE = {1: [0.05, 0.1, 0.0002, 0.0009, 402, 15.5], 2: [0.01, 0.01, 0.0026, 0.0026, 402, 15.5]}
TABLE_1 = {10: "0.0507 0.099 0.0002 0.0009 402.036 15.498", 20: "0.0518 0.1015 0.0002 0.0009 401.991 15.5006",
           30: "0.0501 0.1001 0.0002 0.0009 401.994 15.5004", 40: "0.0501 0.0998 0.0002 0.0009 401.998 15.5001",
           50: "0.0501 0.0998 0.0002 0.0009 401.998 15.5001"}
TABLE_2 = {2: "0.0101 0.0101 0.0026 0.0026 401.9953 15.5003", 10: "0.0095 0.0094 0.0026 0.0026 401.994 15.5004",
           0: "0.0099 0.0102 0.0026 0.0026 402.0039 15.4997", 50: "0.0107 0.0123 0.0026 0.0027 402.0326 15.4977"}


def reading(p, c, z):
    """X of the cone on the probe line (X cos C, X sin C, Z): |v·d|² = |v|² cos² of the half angle."""
    x0, y0, l, m, k, angle = p
    d = np.array([l, m, np.sqrt(1 - l * l - m * m)])
    along = np.stack([np.cos(c), np.sin(c), 0 * c], 1)
    start = np.stack([0 * c, 0 * c, z], 1) - (np.array([x0, y0, 0]) + k * d)
    cos2 = np.cos(np.radians(angle)) ** 2
    a = (along @ d) ** 2 - cos2
    b = 2 * ((along @ d) * (start @ d) - cos2 * (along * start).sum(1))
    root = np.sqrt(b * b - 4 * a * ((start @ d) ** 2 - cos2 * (start * start).sum(1)))
    return np.maximum((-b + root) / (2 * a), (-b - root) / (2 * a))


def unit_covariance(p, length, side):
    i = np.arange(round(length * 50) + 1)
    c, z = 0.2 * np.pi * i, side * 0.02 * i
    columns = []
    for j, h in enumerate([1e-3, 1e-3, 1e-5, 1e-5, 1e-2, 1e-3]):
        step = np.eye(6)[j] * h
        columns.append((reading(p + step, c, z) - reading(p - step, c, z)) / (2 * h))
    jacobian = np.array(columns).T
    scale = 1 / np.linalg.norm(jacobian, axis=0)
    return np.diag(scale) @ np.linalg.inv((jacobian * scale).T @ (jacobian * scale)) @ np.diag(scale)


class Run:
    def __init__(self, table, text, length, side, angle_factor):
        true, words = np.array(TRUE[table], float), text.split()
        self.per = np.array([1, 1, 1, 1, 1, angle_factor], float)
        self.error = (np.array([float(w) for w in words]) - true) / self.per
        self.step = np.array([10.0 ** -len(w.split(".")[1]) for w in words]) / self.per
        self.covariance = unit_covariance(true, length, side)

    def at(self, sigma_mm):
        v = self.covariance * sigma_mm**2 + np.diag(self.step**2 / 12)
        sd = np.sqrt(np.diag(v))
        correlation, e = v / np.outer(sd, sd), self.error / sd
        chi2 = e @ np.linalg.solve(correlation, e)
        log_det = np.linalg.slogdet(correlation)[1] + 2 * np.log(sd).sum()
        return chi2, -0.5 * (chi2 + log_det) - 3 * np.log(2 * np.pi) - np.log(self.per).sum()


def interval(x, log_likelihood):
    inside = x[log_likelihood > log_likelihood.max() - 1.9207]
    return x[log_likelihood.argmax()], inside[0], inside[-1]


if __name__ == "__main__":
    factors = np.geomspace(0.01, 10, 4001)
    for side, angle in [(1, 1), (-1, 1), (-1, 2)]:
        print(f"Z on the side {side:+d}, printed angle error × {angle}")
        runs = [(0.010, Run(1, text, length, side, angle)) for length, text in TABLE_1.items()]
        print("  table 1: χ²", [round(r.at(s)[0], 2) for s, r in runs], "ln L", round(sum(r.at(s)[1] for s, r in runs), 2))
        profile = np.array([sum(r.at(s * f)[1] for s, r in runs) for f in factors])
        print("  noise factor, 95 %:", *np.round(interval(factors, profile), 4), "ln L", round(profile.max(), 2))
        known = [(s * 1e-3, Run(2, text, 30, side, angle)) for s, text in TABLE_2.items() if s]
        print("  table 2: χ²", [round(r.at(s)[0], 2) for s, r in known], "ln L", round(sum(r.at(s)[1] for s, r in known), 2))
        lost = Run(2, TABLE_2[0], 30, side, angle)
        alone = np.array([lost.at(0.01 * f)[1] for f in factors])
        print("  lost level in µm, 95 %:", *np.round(10 * np.array(interval(factors, alone)), 2))
