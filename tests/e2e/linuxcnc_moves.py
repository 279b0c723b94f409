# SPDX-License-Identifier: Apache-2.0
"""Writes the end points of a program's straight moves as LinuxCNC's interpreter reads them.

    linuxcnc_moves.py PROGRAM PARAMETERS MOVES

X Y Z in mm, A B C in degrees, a line a move, with all digits of a double.
"""
import sys

import gcode


class Canon:
    def __init__(self, parameters):
        self.parameter_file = parameters

    def __getattr__(self, name):
        return lambda *arguments: None

    def straight_feed(self, *ends):
        self.show(ends)

    def straight_traverse(self, *ends):
        self.show(ends)

    @staticmethod
    def show(ends):
        print(*(repr(25.4 * end if k < 3 else end) for k, end in enumerate(ends[:6])), file=moves)

    def get_axis_mask(self):
        return 63

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_block_delete(self):
        return False

    def check_abort(self):
        return False

    def get_tool(self, pocket):
        return (-1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0)

    def next_line(self, state):
        pass


moves = open(sys.argv[3], "w", buffering=1)
result, line = gcode.parse(sys.argv[1], Canon(sys.argv[2]), "G21", "")
if result > gcode.MIN_ERROR:
    sys.exit(f"{sys.argv[1]}:{line}: {gcode.strerror(result)}")
