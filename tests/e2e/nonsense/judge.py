#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Streams of nonsense with known truth, made and judged without a line of the program.

    judge.py COMMAND [NAME…] [--part K/N]    runs fit, run and form on every stream (of every N-th
                                             from the K-th) and prints a table; diagnose, whose
                                             search run has too, on every fourth, and on those named

Of each answer the axis at both ends of the data is judged: refused (none is printed), right (within
1.5 U, which is 3 u), unseen (no reading of the stream shows it, and the answer says so) or WRONG. Of
form the roundness is judged in the same way, of 100 trials: its u is known to 7 %. An ordinary stream
that is refused is WRONG too.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import broken  # noqa: F401  fills CASES
import columns  # noqa: F401
import known  # noqa: F401
from lathe import CASES


AXIS = re.compile(r"^(?:axis  | {6}) x (-?[\d.e+-]+) µm, y (-?[\d.e+-]+) µm, U ([\d.e+-]+) µm"
                  r"(?: at Z (-?[\d.]+) mm)?$", re.M)
# What fit alone does not see and diagnose and run do.
FOR_DIAGNOSIS = {"smoothed_over_9", "play_of_10_um"}
SECTION_MM = 8.0  # of a stream without a length


def judge(truth, unseen, out, code):
    """(verdict, words)"""
    axes = [tuple(float(number or SECTION_MM) for number in found) for found in AXIS.findall(out)]
    reason = next((line for line in out.splitlines() if re.search("refus|NOT PROVEN|NO-GO|implaus|: error|rank", line)), "")
    if not axes:
        return ("refused" if code else "none"), reason or out.strip().splitlines()[0] if out.strip() else ""
    if truth is None:
        return ("WRONG" if code == 0 else "shown"), f"axis {axes[0]}"
    worst, words = 0.0, ""
    for x, y, U, z in axes[-2:]:
        tx, ty = truth.centre(z)
        off = max(abs(x - 1e3 * tx), abs(y - 1e3 * ty))
        if off / U > worst:
            worst, words = off / U, f"off {off:.3g} µm, U {U:.3g}"
    if worst <= 1.5:
        return "right", words
    if re.search("^note .*angles repeat in every revolution", out, re.M):
        return "unseen", words
    if unseen and re.search("^hidden .*" + re.escape(unseen.replace(".", " ")), out, re.M):
        return "unseen", words
    return ("WRONG" if code == 0 else "shown"), words


def run(command, folder, line):
    done = subprocess.run([command, *line], cwd=folder, capture_output=True, text=True, timeout=120)
    return done.stdout + done.stderr, done.returncode


def judge_form(out, code, path, round_mm):
    if not os.path.exists(path):
        return ("refused" if code else "none"), out.strip().splitlines()[0] if out.strip() else ""
    with open(path) as file:
        sections = json.load(file)["sections"]
    values = [v for s in sections for v in s["values"] if v["name"] == "RONt" and v.get("value") is not None]
    if not values:
        return "none", "no RONt"
    worst = max(values, key=lambda v: v["value"])
    if round_mm is None:
        return "n/a", f"RONt {1e3 * worst['value']:.3g}"
    U = 2 * worst.get("u", 0.0)
    off = abs(worst["value"] - round_mm)
    word = f"RONt {1e3 * worst['value']:.3g} ± {1e3 * U:.2g}, truth {1e3 * round_mm:.3g}"
    return ("right" if off <= 1.5 * U + 0.004 else "WRONG"), word


def try_one(command, entry, with_diagnose):
    name, make, surface, ordinary, truth, round_mm, unseen = entry
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "part.csv"), "w") as file:
            file.write(make().text())
        row = {}
        lines = {"fit": ["fit", "part.csv", "--surface", surface],
                 "diagnose": ["diagnose", "part.csv", "--surface", surface],
                 "run": ["run", "part.csv", "-o", "out"]}
        if not with_diagnose:
            del lines["diagnose"]
        for what, line in lines.items():
            out, code = run(command, folder, line)
            verdict, words = judge(truth, "" if what == "fit" else unseen, out, code)
            if what == "fit" and unseen and verdict == "WRONG":
                verdict = "unseen"  # the command that it proposes says so
            if verdict == "WRONG" and what == "fit" and name in FOR_DIAGNOSIS:
                verdict = "left"
            if ordinary and verdict != "right":
                verdict = "WRONG " + verdict
            row[what] = (verdict, code, words)
        out, code = run(command, folder, ["form", "part.csv", "--upr", "1-4", "--trials", "100", "--json", "f.json"])
        verdict, words = judge_form(out, code, os.path.join(folder, "f.json"), round_mm)
        row["form"] = (verdict, code, words)
    return name, row


def main():
    words = sys.argv[2:]
    begin, stride = 0, 1
    if "--part" in words:
        at = words.index("--part")
        begin, stride = map(int, words[at + 1].split("/"))
        del words[at:at + 2]
    command = os.path.abspath(sys.argv[1])
    wanted = [case for case in CASES if not words or any(word in case[0] for word in words)]
    wrong = 0
    with ThreadPoolExecutor(2) as pool:
        asked = wanted[begin::stride]
        for name, row in pool.map(lambda k: try_one(command, asked[k], words or k % 4 == 0), range(len(asked))):
            print(f"{name:34}", *(f"{what}: {row[what][0]:8}({row[what][1]})" for what in row))
            for what, (verdict, _, why) in row.items():
                wrong += "WRONG" in verdict
                if "WRONG" in verdict or words:
                    print(f"      {what:9}{why[:240]}")
    print(wrong, "wrong")
    return wrong != 0


if __name__ == "__main__":
    sys.exit(main())
