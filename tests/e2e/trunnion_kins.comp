component trunnion_kins "The trunnion of docs/reference/machine.md with the errors of its worked example";
license "Apache-2.0";
pin in float errors = 1 "0: the machine without errors";
option period no;
function unused nofp;
;;
// SPDX-License-Identifier: Apache-2.0
// A kinematics module of LinuxCNC: joints X Y Z A C; world x y z is the tip in the part and u v w
// the direction of the tool. Written from the formulas of docs/reference/machine.md, body by body from the bed.
#include <rtapi_math.h>

#include "kinematics.h"

KINS_NOT_SWITCHABLE
EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

typedef struct {
  double m[4][4];
} Matrix;

static const double degree = 0.017453292519943295;

static Matrix times(Matrix a, Matrix b) {
  Matrix c = {{{0}}};
  int i, j, k;
  for (i = 0; i < 4; ++i)
    for (j = 0; j < 4; ++j)
      for (k = 0; k < 4; ++k) c.m[i][j] += a.m[i][k] * b.m[k][j];
  return c;
}

static Matrix shift(double x, double y, double z) {
  Matrix t = {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}};
  return t;
}

// Turns by `angle` about w (of any length but 0).
static Matrix turn(double x, double y, double z, double angle) {
  double n = sqrt(x * x + y * y + z * z), c = cos(angle), s = sin(angle), v = 1 - c;
  Matrix r;
  x /= n, y /= n, z /= n;
  r = (Matrix){{{c + v * x * x, v * x * y - s * z, v * x * z + s * y, 0},
                {v * x * y + s * z, c + v * y * y, v * y * z - s * x, 0},
                {v * x * z - s * y, v * y * z + s * x, c + v * z * z, 0},
                {0, 0, 0, 1}}};
  return r;
}

static Matrix inverse(Matrix a) {
  Matrix b = {{{0}}};
  int i, j;
  for (i = 0; i < 3; ++i)
    for (j = 0; j < 3; ++j) {
      b.m[i][j] = a.m[j][i];
      b.m[i][3] -= a.m[j][i] * a.m[j][3];
    }
  b.m[3][3] = 1;
  return b;
}

static double eaa(double a) {  // urad, a in degrees: linear between points, end values held
  if (a <= -90) return 12;
  if (a <= -45) return 12 + (a + 90) / 45 * -19;
  if (a <= 0) return -7 + (a + 45) / 45 * 7;
  return a < 45 ? a / 45 * 5 : 5;
}

int kinematicsForward(const double* joint, EmcPose* world, const KINEMATICS_FORWARD_FLAGS* fflags,
                      KINEMATICS_INVERSE_FLAGS* iflags) {
  struct __comp_state* __comp_inst = __comp_first_inst;
  double e = errors, u = 1e-6 * e;  // urad, and um in m
  double x = joint[0], y = joint[1], z = joint[2], a = joint[3] * degree, c = joint[4] * degree;
  Matrix on_y, on_a, on_c, part, on_x, spindle, tool;
  double line[3];
  int i;
  // Component errors of the part's bodies are those of the tool against the table: inverted.
  on_y = times(shift(y * sin(30 * u), -y * cos(30 * u), 0),
               inverse(turn(0, 1, 0, (5 - 20 * y / 200) * u)));
  on_a = times(shift(0, 15 - 0.018 * e, -40), inverse(turn(1, 0, 0, eaa(joint[3]) * u)));
  on_a = times(on_a, turn(cos(45 * u), -sin(45 * u), 0, -a));
  on_a = times(on_a, shift(0, -15 + 0.018 * e, 40));
  on_c = times(shift(0, (3 * cos(c) - 4 * sin(c) + cos(2 * c)) * 1e3 * u, 0),
               turn(1, 0, 0, (10 * cos(c) + 5 * sin(c)) * u));
  on_c = times(shift(5 + 0.025 * e, -10, 0), inverse(on_c));
  on_c = times(on_c, turn(sin(60 * u), 0, cos(60 * u), -(c + 35 * u)));
  on_c = times(on_c, shift(-5 - 0.025 * e, 10, 0));
  part = times(shift(12, -8, 20), times(shift(0.1 * e, 0, 0), turn(0, 0, 1, 0.05 * e * degree)));
  part = times(times(on_y, on_a), times(on_c, part));
  on_x = times(shift(x + 0.03 * e * x / 400, 0, 0), turn(0, 0, 1, 40 * u));  // its reference is on
  spindle = times(shift(0, 0, 150), turn(1, 0, 0, -20 * u));                 // the axis it turns about
  tool = times(times(on_x, shift(0, 0, z)), times(spindle, shift(0, 0, -120)));
  tool = times(inverse(part), tool);
  for (i = 0; i < 3; ++i) line[i] = tool.m[i][2];
  world->tran.x = tool.m[0][3], world->tran.y = tool.m[1][3], world->tran.z = tool.m[2][3];
  world->a = joint[3], world->b = 0, world->c = joint[4];
  world->u = line[0], world->v = line[1], world->w = line[2];
  return fflags == 0 && iflags == 0;
}

int kinematicsInverse(const EmcPose* world, double* joint, const KINEMATICS_INVERSE_FLAGS* iflags,
                      KINEMATICS_FORWARD_FLAGS* fflags) {
  // The control is given axis positions (mode axes): a joint is its axis.
  joint[0] = world->tran.x, joint[1] = world->tran.y, joint[2] = world->tran.z;
  joint[3] = world->a, joint[4] = world->c;
  return fflags == 0 && iflags == 0;
}

KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_INVERSE_ONLY; }

FUNCTION(unused) {}
