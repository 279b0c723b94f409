// SPDX-License-Identifier: GPL-2.0-or-later
component trueaxis_fts "follows the correction table of trueaxis run with a fast tool servo";
description """
Sends a fast tool servo the value of a correction table at the present C and Z. The table is table.csv of
`trueaxis run`, read once when the component is loaded:

.B loadrt trueaxis_fts table=/path/to/table.csv

A file that is not a whole, unchanged table is refused then. Everything else is compared while
.B enable
is true. On any doubt the position is held, or follows C and Z on if only the speed is another one, and
.B fault
is true until
.B enable
is false and the ramp has ended. The log has the name of the fault.
""";
license "GPL";
author "the TrueAxis authors";
option singleton yes;
option no_convenience_defines yes;
option extra_setup yes;
include "fts_servo.h";

pin in float c "spindle angle, degrees, as the probe stream counts it; wrapped or running";
pin in float z "Z of the centre of the tool's nose, mm, as the probe stream counts it";
pin in bit enable "true: ramp in and follow; false: ramp out";
pin in bit c_homed "C has its index";
pin in bit check "true over at least one revolution: compares the probe with the table, at the present Z";
pin in float probe "reading of the probe during check, mm, positive away from the spindle axis";
pin in float feedback "measured position of the servo, mm";
pin out float position "command, mm, positive away from the spindle axis";
pin out float following_error "feedback less position, mm";
pin out float speed "of C, rpm, signed";
pin out float age "of the table, s";
pin out float check_c_off "C of the machine less that of the table, degrees, as the last check found it";
pin out bit checked "the probe finds the part where the table has it";
pin out bit active "follows, ramp complete";
pin out bit fault "holds the position";
pin out u32 fault_code "0: none; else as the log names it";
param rw float stroke "full travel of the servo, mm, used about its middle";
param rw float z_low "lowest Z that the program cuts at, mm";
param rw float z_high "highest Z that the program cuts at, mm";
param rw float max_age = 28800 "of the table, s";
param rw float check_tolerance = 0.005 "that the axis found by check may be off that of the table, mm";
param rw float speed_tolerance = 0.05 "share of the table's speed";
param rw float ramp_time = 0.5 "s";
param rw float following_limit = -1 "of following_error, mm; has to be set; 0: the servo has no feedback";
param rw float wait = 10 "that the spindle has to come to the speed of the table, s; then a fault, as it would cut uncorrected";
variable fts_servo_state servo;
variable double age_s;
function _ fp "reads C and Z, writes position";
;;
#include "fts_table.c"
#include "fts_servo.c"

#include <sys/stat.h>
#include <time.h>

static char *table = "";
RTAPI_MP_STRING(table, "correction table of trueaxis run (table.csv)");

static struct fts_table rows;

static int extra_setup(struct __comp_state *__comp_inst, char *prefix, long extra_arg) {
  (void)prefix, (void)extra_arg;
  char why[1200];
  struct stat file;
  if (fts_table_read(&rows, table, why, sizeof why) != 0) {
    rtapi_print_msg(RTAPI_MSG_ERR, "trueaxis_fts: refused: %s\n", why);
    return -1;
  }
  __comp_inst->age_s = stat(table, &file) == 0 ? difftime(time(NULL), file.st_mtime) : -1.0;
  return 0;
}

/* Only when the module is closed: until hal_exit, which halcompile calls after a cleanup, the thread may read the table. */
__attribute__((destructor)) static void free_rows(void) { fts_table_free(&rows); }

/* FUNCTION(_), written out: the macros of halcompile are names as short as those of fts_servo.c. */
static void _(struct __comp_state *hal, long period) {
  struct fts_servo *servo = &hal->servo;
  const int before = servo->out.fault;
  const double period_s = 1e-9 * (double)period;
  hal->age_s += period_s;
  *hal->age = hal->age_s;
  const struct fts_limits limits = {hal->stroke,          hal->z_low,           hal->z_high,
                                    hal->max_age,         hal->check_tolerance, hal->speed_tolerance,
                                    hal->ramp_time,       hal->following_limit, hal->wait};
  const struct fts_input in = {*hal->c,   *hal->z,      *hal->probe, *hal->feedback,
                               hal->age_s, *hal->enable, *hal->check, *hal->c_homed};
  fts_servo_period(servo, &rows, &limits, &in, period_s);
  *hal->position = servo->out.position_mm;
  *hal->following_error = servo->out.following_error_mm;
  *hal->speed = servo->out.speed_rpm;
  *hal->check_c_off = servo->out.check_c_off_deg;
  *hal->checked = servo->out.checked;
  *hal->active = servo->out.active;
  *hal->fault = servo->out.fault != FTS_NONE;
  *hal->fault_code = (hal_u32_t)servo->out.fault;
  if (servo->out.fault != FTS_NONE && servo->out.fault != before)
    rtapi_print_msg(RTAPI_MSG_ERR, "trueaxis_fts: %s: %s\n",
                    servo->out.fault == FTS_SPEED ? "follows on in doubt" : "position held", fts_fault_name(servo->out.fault));
}
