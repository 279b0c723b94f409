#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the reference pairs of tests/reference/association: points and their associated elements to 30 digits.

make_association_pairs.py [FOLDER]     needs python3-mpmath and python3-scipy; the tests need neither

A set is NAME.ds, `x y z` a line, doubles written exactly. An answer is NAME.CRITERION.fit, one number a line: point,
direction, radius (torus: major), half angle in rad or minor radius, what an element has, then the zone. Nothing of the
engine is used. An element is described by six numbers of its own: the axis w0 + a e1 + b e2 through p0 + s e1 + t e2
(+ h w), not by a frame that goes along.

Gaussian: Gauss-Newton from the true element in 80 digits with derivatives by differences (1e-30), until the steps are
below 1e-45; the gradient of the sum of squares is then 0 to as many digits, whatever the Jacobian was.
By extremes: sequential linear programming in doubles (scipy) tells which points hold the element; in 80 digits it is
then solved from the conditions of the optimum: equal distances of those points and, where they are fewer than the
unknowns, balanced gradients (Newton). The answer is written only if every multiplier is positive and no other point
is beyond: both together are what an optimum is.
"""

import math
import random
import sys
from pathlib import Path

import numpy as np
from mpmath import mp, mpf
from scipy.optimize import linprog

mp.dps = 80
SIZES = {"line2": 0, "circle2": 1, "line": 0, "circle": 1, "plane": 0, "sphere": 1, "cylinder": 1, "cone": 2, "torus": 2}
MOVES = {"line2": "sa", "circle2": "st", "line": "stab", "circle": "sthab", "plane": "hab", "sphere": "sth",
         "cylinder": "stab", "cone": "stab", "torus": "sthab"}


def frame_of(w):
    w = np.array(w, float) / np.linalg.norm(w)
    e1 = np.cross(np.eye(3)[int(np.argmin(abs(w)))], w)
    e1 /= np.linalg.norm(e1)
    return e1, np.cross(w, e1), w


class Problem:
    """Points, the true element they were made of, distances for parameters about it."""

    def __init__(self, kind, points, p0, w0, sizes):
        self.kind, self.points = kind, points
        self.p0, self.sizes = p0, sizes
        self.axes = frame_of(w0) if kind != "line2" else (np.array([w0[1], -w0[0], 0.0]), np.array([0, 0, 1.0]), w0)
        self.count = len(MOVES[kind]) + SIZES[kind]

    def element(self, q, number=mpf):
        move = dict(zip(MOVES[self.kind], q))
        e1, e2, w = ([number(float(c)) for c in e] for e in self.axes)
        get = lambda name: move.get(name, number(0))
        p = [number(float(self.p0[i])) + get("s") * e1[i] + get("t") * e2[i] + get("h") * w[i] for i in range(3)]
        d = [w[i] + get("a") * e1[i] + get("b") * e2[i] for i in range(3)]
        root = mp.sqrt if number is mpf else math.sqrt
        n = root(sum(c * c for c in d))
        sizes = [number(float(s)) + v for s, v in zip(self.sizes, q[len(MOVES[self.kind]):])]
        return p, [c / n for c in d], sizes

    def distances(self, q, which=None, number=mpf, parts=False):
        p, w, sizes = self.element(q, number)
        root, cos, sin = (mp.sqrt, mp.cos, mp.sin) if number is mpf else (math.sqrt, math.cos, math.sin)
        out = []
        for i in which if which is not None else range(len(self.points)):
            a = [number(float(self.points[i][k])) - p[k] for k in range(3)]
            z = sum(a[k] * w[k] for k in range(3))
            if self.kind == "sphere":
                out.append(root(sum(c * c for c in a)) - sizes[0])
                continue
            if self.kind == "plane":
                out.append(z)
                continue
            if self.kind == "line2":
                out.append(a[0] * w[1] - a[1] * w[0])
                continue
            across = [a[k] - z * w[k] for k in range(3)]
            rho = root(sum(c * c for c in across))
            if self.kind == "line":
                out += across if parts else [rho]
            elif self.kind == "circle":
                out += [rho - sizes[0], z] if parts else [root((rho - sizes[0]) ** 2 + z * z)]
            elif self.kind == "cone":
                out.append((rho - sizes[0]) * cos(sizes[1]) - z * sin(sizes[1]))
            elif self.kind == "torus":
                out.append(root((rho - sizes[0]) ** 2 + z * z) - sizes[1])
            else:
                out.append(rho - sizes[0])
        return out

    def jacobian(self, q, which=None, number=mpf, parts=False):
        step = mpf(10) ** -30 if number is mpf else 1e-6
        columns = []
        for k in range(self.count):
            up, down = list(q), list(q)
            up[k] += step
            down[k] -= step
            high, low = (self.distances(v, which, number, parts) for v in (up, down))
            columns.append([(h - l) / (2 * step) for h, l in zip(high, low)])
        return columns


def gaussian(problem):
    q = [mpf(0)] * problem.count
    for _ in range(400):
        d = problem.distances(q, parts=True)
        columns = problem.jacobian(q, parts=True)
        h = mp.matrix(problem.count, problem.count)
        g = mp.matrix(problem.count, 1)
        for i, a in enumerate(columns):
            g[i] = -mp.fdot(a, d)
            for j, b in enumerate(columns):
                h[i, j] = mp.fdot(a, b)
        step = mp.lu_solve(h, g)
        q = [a + b for a, b in zip(q, step)]
        if mp.norm(step) < mpf(10) ** -45:
            return q
    raise SystemExit(f"{problem.kind}: Gauss-Newton does not converge")


def signs_of(problem, criterion):
    if criterion == "minimum_circumscribed":
        return [1]
    if criterion == "maximum_inscribed":
        return [-1]
    return [1] if problem.kind in ("line", "circle") else [1, -1]


def extreme(problem, criterion):
    """Unknowns of extremes: all, or without the last size, which follows."""
    follows = criterion.startswith(("minimum_c", "maximum"))
    free = problem.count - (1 if follows else 0)
    signs = signs_of(problem, criterion)
    q, reach = np.zeros(problem.count), 0.05
    value = lambda v: max(s * d for d in problem.distances(list(v), number=float) for s in signs)
    h = value(q)

    def program(reach):
        d = np.array(problem.distances(list(q), number=float))
        j = np.array(problem.jacobian(list(q), number=float)).T[:, :free]
        a = np.vstack([np.hstack([s * j, -np.ones((len(d), 1))]) for s in signs])
        b = np.concatenate([-s * d for s in signs])
        bounds = [(-reach, reach)] * free + [(None, None)]
        return linprog([0] * free + [1], A_ub=a, b_ub=b, bounds=bounds, method="highs-ds",
                       options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10})

    while reach > 1e-11:
        step = np.append(program(reach).x[:free], [0] * (problem.count - free))
        better = value(q + step)
        if better < h - 1e-14:
            q, h, reach = q + step, better, reach * 2
        else:
            reach /= 4
    held = [i for i, l in enumerate(-program(0.01).ineqlin.marginals) if l > 1e-7]
    n = len(problem.points)
    active = [(i % n, signs[i // n]) for i in held]
    return certified(problem, criterion, [mpf(float(v)) for v in q], active, free, signs)


def certified(problem, criterion, q, active, free, signs):
    which = [i for i, _ in active]
    sign = [s for _, s in active]
    k = len(active)

    def conditions(v):
        full = list(v[:free]) + q[free:]
        d = problem.distances(full, which)
        columns = problem.jacobian(full, which)
        h, weights = v[free], v[free + 1:]
        balance = [mp.fsum(w * s * c for w, s, c in zip(weights, sign, columns[m])) for m in range(free)]
        return balance + [mp.fsum(weights) - 1] + [s * x - h for s, x in zip(sign, d)]

    d = problem.distances(q, which)
    v = list(q[:free]) + [max(s * x for s, x in zip(sign, d))] + [mpf(1) / k] * k
    # The multipliers first, by least squares of the balance, then Newton on all.
    columns = problem.jacobian(q, which)
    rows = mp.matrix(free + 1, k)
    for m in range(free):
        for i in range(k):
            rows[m, i] = sign[i] * columns[m][i]
    for i in range(k):
        rows[free, i] = 1
    right = mp.matrix([0] * free + [1])
    normal = rows.T * rows
    v[free + 1:] = list(mp.lu_solve(normal, rows.T * right))
    for _ in range(20):
        f = conditions(v)
        size = len(v)
        jac = mp.matrix(size, size)
        step = mpf(10) ** -15
        for c in range(size):
            up, down = list(v), list(v)
            up[c] += step
            down[c] -= step
            for r, (hi, lo) in enumerate(zip(conditions(up), conditions(down))):
                jac[r, c] = (hi - lo) / (2 * step)
        move = mp.lu_solve(jac, mp.matrix([-x for x in f]))
        v = [a + b for a, b in zip(v, move)]
        if mp.norm(move) < mpf(10) ** -36:
            break
    else:
        raise SystemExit(f"{problem.kind} {criterion}: Newton does not converge: {mp.nstr(mp.norm(move), 5)}")
    full = list(v[:free]) + q[free:]
    top = max(s * x for x in problem.distances(full) for s in signs)
    least = min(v[free + 1:])
    if least <= 0 or top > v[free] + mpf(10) ** -30:
        raise SystemExit(f"{problem.kind} {criterion}: no optimum (multiplier {mp.nstr(least, 5)}, beyond {mp.nstr(top - v[free], 5)})")
    if free < problem.count:
        full[-1] += v[free] if signs == [1] else -v[free]
    return full


def write_answer(problem, q, criterion, path):
    p, w, sizes = problem.element(q)
    sizes = list(sizes)
    d = problem.distances(q)
    tube = problem.kind in ("line", "circle")
    zone = 2 * max(d) if tube else max(d) - min(d)
    numbers = list(p) + ([] if problem.kind == "sphere" else list(w)) + sizes + [zone]
    path.write_text("".join(mp.nstr(x, 32, min_fixed=-60, max_fixed=60, strip_zeros=False) + "\n" for x in numbers))


def surface_point(kind, sizes, t, u, out):
    """In the frame of the element, `out` away from it along its normal."""
    c, s = math.cos(t), math.sin(t)
    if kind in ("line2",):
        return out, 0.0, u
    if kind == "line":
        return out * c, out * s, u
    if kind == "circle":
        v = 7.0 * t
        r = sizes[0] + out * math.cos(v)
        return r * c, r * s, out * math.sin(v)
    if kind == "circle2":
        return (sizes[0] + out) * c, (sizes[0] + out) * s, 0.0
    if kind == "plane":
        return 30 * math.cos(t) * abs(u) / 20, 20 * math.sin(t), out
    if kind == "sphere":
        z = max(-1.0, min(1.0, u / 20))
        r = (sizes[0] + out)
        return r * math.sqrt(1 - z * z) * c, r * math.sqrt(1 - z * z) * s, r * z
    if kind == "cylinder":
        return (sizes[0] + out) * c, (sizes[0] + out) * s, u
    if kind == "cone":
        r = sizes[0] + u * math.tan(sizes[1]) + out * math.cos(sizes[1])
        return r * c, r * s, u - out * math.sin(sizes[1])
    r = sizes[0] + (sizes[1] + out) * math.cos(u)
    return r * c, r * s, (sizes[1] + out) * math.sin(u)


def problem_of(name, kind, n, sizes, noise, arc=2 * math.pi, length=20.0, place=(3.0, -5.0, 7.0), w=(0.36, -0.48, 0.8),
               twice=False):
    draw = random.Random(name)
    flat = kind.endswith("2")
    place = np.array((place[0], place[1], 0.0) if flat else place)
    w = np.array((0.6, 0.8, 0.0) if kind == "line2" else (0.0, 0.0, 1.0) if flat else w)
    problem = Problem(kind, [], place, w, sizes)
    for _ in range(n):
        t = arc * draw.random()
        u = 2 * math.pi * draw.random() if kind == "torus" else length * (2 * draw.random() - 1)
        x, y, z = surface_point(kind, sizes, t, u, noise * (2 * draw.random() - 1))
        point = place + x * problem.axes[0] + y * problem.axes[1] + z * problem.axes[2]
        if flat:
            point[2] = 0.0
        problem.points.append(point)
    if twice:
        problem.points += problem.points[: n // 2]
    return problem


EXTREMES = ("minimum_zone", "minimum_circumscribed", "maximum_inscribed")
SETS = [
    ("line_plane", ("line2", 30, [], 0.01), EXTREMES[:1]),
    ("circle_plane", ("circle2", 40, [10.0], 0.01), EXTREMES),
    ("line_space", ("line", 30, [], 0.01), EXTREMES[:1]),
    ("circle_space", ("circle", 40, [10.0], 0.01), EXTREMES[:1]),
    ("plane", ("plane", 40, [], 0.01), EXTREMES[:1]),
    ("sphere", ("sphere", 50, [10.0], 0.01), EXTREMES),
    ("cylinder", ("cylinder", 60, [10.0], 0.01), EXTREMES),
    ("cone", ("cone", 60, [10.0, 0.3], 0.01), EXTREMES[:1]),
    ("torus", ("torus", 80, [30.0, 5.0], 0.01), EXTREMES),
    ("circle_arc_20deg", ("circle2", 30, [10.0], 0.001, math.pi / 9), EXTREMES[:1]),
    ("cylinder_arc_20deg", ("cylinder", 60, [10.0], 0.001, math.pi / 9), EXTREMES[:1]),
    ("cylinder_long", ("cylinder", 60, [0.5], 0.001, 2 * math.pi, 250.0), EXTREMES),
    ("cylinder_far", ("cylinder", 60, [10.0], 0.01, 2 * math.pi, 20.0, (1e6, -1e6, 1e6)), EXTREMES),
    ("cone_ten_points", ("cone", 10, [10.0, 0.3], 0.01), EXTREMES[:1]),
    ("cone_tenth_of_a_degree", ("cone", 60, [10.0, math.radians(0.1)], 0.001), EXTREMES[:1]),
    ("cone_85deg", ("cone", 60, [40.0, math.radians(85.0)], 0.001, 2 * math.pi, 3.0), EXTREMES[:1]),
    ("sphere_duplicates", ("sphere", 30, [10.0], 0.01, 2 * math.pi, 20.0, (3.0, -5.0, 7.0), (0.36, -0.48, 0.8), True), ()),
    ("torus_far", ("torus", 80, [30.0, 5.0], 0.01, 2 * math.pi, 20.0, (1e6, 1e6, -1e6)), ()),
]


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent / "association"
    folder.mkdir(exist_ok=True)
    for name, arguments, criteria in SETS:
        problem = problem_of(name, *arguments)
        (folder / f"{name}.ds").write_text("".join("%r %r %r\n" % tuple(float(c) for c in p) for p in problem.points))
        write_answer(problem, gaussian(problem), "gaussian", folder / f"{name}.gaussian.fit")
        for criterion in criteria:
            write_answer(problem, extreme(problem, criterion), criterion, folder / f"{name}.{criterion}.fit")
        print(name, flush=True)


main()
