# SPDX-License-Identifier: Apache-2.0
"""LinuxCNC as scripts/loop works it, and what is said of it."""
import subprocess
import time
from pathlib import Path

SAYS = "loop| "  # before a line that is for the reader: LinuxCNC says much else
RACE, RACED = "Queue is not empty after probing", 75  # of LinuxCNC's own, with other work on the machine: all runs anew, once


class Failed(SystemExit):
    pass


def say(text):
    for line in str(text).splitlines():
        print(SAYS + line, flush=True)


class Control:
    """LinuxCNC, and the keys that an operator presses."""

    def __init__(self):
        import linuxcnc

        self.api, self.state, self.command = linuxcnc, linuxcnc.stat(), linuxcnc.command()
        self.errors = linuxcnc.error_channel()
        for wanted in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
            self.command.state(wanted)
            self.command.wait_complete()
        self.command.home(-1)
        self.wait(lambda: all(self.state.homed[:3]), 60)
        self.command.mode(linuxcnc.MODE_AUTO)
        self.command.wait_complete()

    def wait(self, reached, seconds):
        end = time.time() + seconds
        while time.time() < end:
            self.state.poll()
            said = self.errors.poll()
            if said and said[0] in (self.api.NML_ERROR, self.api.OPERATOR_ERROR):
                raise Failed(f"LinuxCNC says: {said[1]}")
            if reached():
                return
            time.sleep(0.005)
        raise Failed("LinuxCNC did not come so far in time")

    def run(self, program):
        self.command.program_open(str(Path(program).resolve()))
        self.command.auto(self.api.AUTO_RUN, 0)
        self.wait(lambda: self.state.interp_state != self.api.INTERP_IDLE, 60)
        self.wait(lambda: self.state.interp_state == self.api.INTERP_IDLE, 180)


def hal(*words):
    return subprocess.run(["halcmd", *map(str, words)], check=True, capture_output=True, text=True).stdout.strip()
