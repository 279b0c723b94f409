#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Has LinuxCNC itself run a program, without a display, and samples where its joints are commanded every ms.

    linuxcnc_control.py PROGRAM SAMPLES

Joints are the axes X Y Z A C. PROGRAM begins at 0 and is run under the control's own trajectory planner; a line of
SAMPLES is x y z a c, mm and degrees. LinuxCNC starts this file once more, in place of its display, to press the keys.
"""
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

AXES = "XYZAC"
INI = """[EMC]
VERSION = 1.1
MACHINE = trunnion
DEBUG = 0
[DISPLAY]
DISPLAY = {display}
[RS274NGC]
PARAMETER_FILE = x.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 1.0
SERVO_PERIOD = 1000000
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[HAL]
HALFILE = m.hal
[TRAJ]
COORDINATES = X Y Z A C
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 50
MAX_LINEAR_VELOCITY = 200
DEFAULT_LINEAR_ACCELERATION = 2000
MAX_LINEAR_ACCELERATION = 2000
[EMCIO]
EMCIO = io
TOOL_TABLE = tool.tbl
[KINS]
KINEMATICS = trivkins coordinates=xyzac
JOINTS = 5
"""
JOINT = """[AXIS_{letter}]
MIN_LIMIT = -1000
MAX_LIMIT = 1000
MAX_VELOCITY = 200
MAX_ACCELERATION = 2000
[JOINT_{number}]
TYPE = {kind}
HOME = 0
MIN_LIMIT = -1000
MAX_LIMIT = 1000
MAX_VELOCITY = 250
MAX_ACCELERATION = 2500
HOME_SEARCH_VEL = 0
HOME_LATCH_VEL = 0
HOME_SEQUENCE = 0
FERROR = 50
MIN_FERROR = 50
"""
HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
loadrt sampler depth=60000 cfg=fffff
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf sampler.0 servo-thread
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
loadusr halsampler {folder}/samples.txt
"""


def press_the_keys():
    import linuxcnc

    state, command = linuxcnc.stat(), linuxcnc.command()

    def wait_until(condition, seconds):
        end = time.time() + seconds
        while time.time() < end:
            state.poll()
            if condition():
                return
            time.sleep(0.01)
        raise SystemExit("LinuxCNC did not come so far in time")

    for wanted in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
        command.state(wanted)
        command.wait_complete()
    command.home(-1)
    wait_until(lambda: all(state.homed[: len(AXES)]), 20)
    command.mode(linuxcnc.MODE_AUTO)
    command.wait_complete()
    command.program_open(str(Path.cwd() / "p.ngc"))
    command.auto(linuxcnc.AUTO_RUN, 0)
    time.sleep(0.5)
    wait_until(lambda: state.interp_state == linuxcnc.INTERP_IDLE, 120)
    time.sleep(0.3)


def run(program, samples):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o777)
        ini = INI.format(display=Path(__file__).resolve())
        hal = HAL.format(folder=folder)
        for number, letter in enumerate(AXES):
            ini += JOINT.format(letter=letter, number=number, kind="ANGULAR" if letter in "ABC" else "LINEAR")
            hal += (f"net j{number} joint.{number}.motor-pos-cmd => joint.{number}.motor-pos-fb "
                    f"sampler.0.pin.{number}\n")
        (folder / "m.ini").write_text(ini)
        (folder / "m.hal").write_text(hal)
        (folder / "tool.tbl").write_text("T1 P1 Z120 D1\n")
        (folder / "x.var").touch()
        shutil.copyfile(program, folder / "p.ngc")
        environment = dict(os.environ, HOME=name)
        if os.getuid() == 0:  # it refuses to run as root
            environment.update(RTAPI_UID="65534", RTAPI_FIFO_PATH=str(folder / "fifo"))
        subprocess.run(["linuxcnc", "-r", "m.ini"], cwd=folder, env=environment, timeout=200, check=True)
        lines = (folder / "samples.txt").read_text().splitlines()
        if "overrun" in lines:
            raise SystemExit("samples were lost")
        rows = [line for line in lines if len(line.split()) == len(AXES)]  # the last one may be cut off
        Path(samples).write_text("\n".join(rows) + "\n")


if "-ini" in sys.argv:
    press_the_keys()
else:
    run(sys.argv[1], sys.argv[2])
