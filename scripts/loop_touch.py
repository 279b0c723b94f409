# SPDX-License-Identifier: Apache-2.0
"""What scripts/loop does with a trigger: programs of touch points for a shaft, a bore and a face, on the control."""
import json
import subprocess
import time
from pathlib import Path

# What a trigger touches: the shaft from both sides, a bore from inside, the face across its centre.
BORE = 12.0
TOUCH = """[limits]
x_mm = [-60, 120]
z_mm = [-80, 160]
speed_rpm = 600
[part]
reach_mm = 31
front_mm = 5.1
bore_radius_mm = 11.7
bore_bottom_mm = -60
[probe]
kind = "touch"
ball_radius_mm = 1
stylus_radius_mm = 0.6
stylus_length_mm = 60
feed_mm_per_min = 300
clearance_mm = 2
search_mm = 1
"""
TOUCHED = {
    "shaft": ("cylinder", 'surface = "cylinder"\nradius_mm = 30\n', "z", (-40, -10), True),
    "bore": ("cylinder", f'surface = "cylinder"\nfeature = "bore"\nradius_mm = {BORE}\n', "z", (-40, -10), True),
    "face": ("plane", 'surface = "face"\nd_mm = 5\n', "x", (28, 16), False),
}
REAR = "setup = 2\n[[setup]]\nnumber = 2\nside = \"rear\"\n"


def positions(samples):
    """Of the slide, |X| and Z in mm: one list per stretch without a gap. Where a busy computer loses samples, halsampler
    writes "overrun". The sampler holds positions from before: a program begins where the probe is clear."""
    ways = [[]]
    for row in map(str.split, samples.splitlines()):
        if len(row) != 4:
            ways.append([])
            continue
        x, z = abs(float(row[0])), float(row[2])
        if any(ways) or x > 33.999 or z > 8.099:
            ways[-1].append((x, z))
    return ways


def touch(loop, name):
    """A program of touch points, with a probe that triggers, and the way that the control took."""
    surface, part, axis, (start, end), both = TOUCHED[name]
    one = "[[pass]]\n{0}_start_mm = {1}\n{0}_end_mm = {2}\nfeed_mm_per_rev = 10\nreadings_per_revolution = 5\n"
    Path(f"{name}.toml").write_text(f"[part]\n{part}[noise]\nsigma_um = 1\n" + one.format(axis, start, end)
                                    + (one.format(axis, end, start) + REAR if both else ""))
    loop.trueaxis("study", "plan", f"{name}.toml", "--goal-um", 20, "--repeats", 100, "--control", "linuxcnc",
                  "--limits", "touch.toml", "-o", f"{name}.ngc")
    with open(f"{name}.samples", "w") as samples:
        sampler = subprocess.Popen(["halsampler"], stdout=samples)
        loop.control.run(f"{name}.ngc")
        time.sleep(0.1)
        sampler.terminate()
        sampler.wait()
    ways = positions(Path(f"{name}.samples").read_text())
    # Where the ball is not clear, it moves along one axis only, but for what an encoder rounds.
    clear = {"shaft": lambda x, z: x > 33.999 or z > 8.099, "bore": lambda x, z: x < 8.701 or z > 8.099,
             "face": lambda x, z: z > 8.099}[name]
    other = 0 if name == "face" else 1
    moved = sum(abs(b[other] - a[other]) > 2e-4 for way in ways for a, b in zip(way, way[1:]) if not clear(*a) and not clear(*b))
    loop.expect(moved == 0, f"{name}: {sum(map(len, ways))} positions of the slide, {moved} of them off its way")
    loop.trueaxis("fit", f"{name}.log", "--surface", surface, "--json", f"{name}.json")
    return json.loads(Path(f"{name}.json").read_text())


def touched(loop, hal, part, period_s, sure):
    """Every surface is as it is. The control stops up to two periods late, which is off in a radius and in no axis."""
    Path("touch.toml").write_text(TOUCH)
    hal("setp", "virtual-part.trigger", 1)
    hal("setp", "virtual-part.bore", BORE)
    hal("unlinkp", "sum2.0.in1")  # the samples are of the slide alone
    hal("setp", "sum2.0.in1", 0)
    late = 2.0 * period_s * 300.0 / 60.0
    for name in TOUCHED:
        parameters = touch(loop, name)["parameters"]
        true = {"l": part["slope-x"], "m": part["slope-y"]}
        if name == "face":
            true["d"] = part["front"] + (part["centre-x"] * part["slope-x"] + part["centre-y"] * part["slope-y"])
        else:
            true.update(x0=part["centre-x"], y0=part["centre-y"], radius=part["radius"] if name == "shaft" else BORE)
        for key, value in true.items():
            found = parameters[key]
            slack = late if key in ("d", "radius") else 0.0
            off, U = abs(found["value"] - value), 2.0 * found["u"]
            unit = "e-3" if key in "lm" else " µm"
            loop.expect(off <= sure * U + slack, f"  {key}: {1e3 * off:.3f}{unit} off the true one, U {1e3 * U:.3f}{unit}")
    hal("setp", "virtual-part.trigger", 0)
    hal("setp", "virtual-part.bore", 0)
    hal("net", "gauge", "sum2.0.in1")
