/* SPDX-License-Identifier: MIT
 *
 * What a fast tool servo is sent, period by period: the value of the table at (C, Z), with ramps, and nothing on any doubt.
 * No allocation, no lock, no system call.
 */
#ifndef TRUEAXIS_FTS_SERVO_H
#define TRUEAXIS_FTS_SERVO_H

#include "fts_table.h"

enum fts_fault {
  FTS_NONE,
  FTS_NO_NUMBER,        /* C, Z, probe or feedback is not a number */
  FTS_C_NOT_HOMED,      /* C has no index */
  FTS_STROKE,           /* the table leaves the stroke about its middle */
  FTS_RANGE,            /* the program leaves the range of the table along Z */
  FTS_LIMIT_NOT_STATED, /* nobody says what the feedback may be off, or that there is none */
  FTS_AGE,              /* the table is older than allowed */
  FTS_NOT_CHECKED,      /* C zero and clamping were not checked with the probe */
  FTS_SENSE,            /* the spindle turns the other way */
  FTS_SPEED_LIMIT,      /* faster than the actuator follows */
  FTS_SPEED,            /* another speed than that of the table: the lag is not the one that it is for */
  FTS_C_JUMPED,         /* C moved farther in a period than the spindle can */
  FTS_FOLLOWING,        /* the feedback is off the command */
  FTS_PROBE_INVERTED,   /* the check reads the part the other way round */
  FTS_C_ZERO,           /* the check finds the eccentricity in another direction */
  FTS_OTHER_CLAMPING,   /* the check finds another eccentricity: another part or clamping */
  FTS_FAULTS
};

/* The name of a fault, as the log has it. */
const char *fts_fault_name(int fault);

struct fts_limits {
  double stroke_mm;                 /* full travel, used about its middle */
  double z_low_mm, z_high_mm;       /* that the program cuts between */
  double max_age_s;                 /* of the table */
  double check_tolerance_mm;        /* that the axis found by the check may be off the table's */
  double speed_tolerance;           /* share of the table's speed */
  double ramp_s;                    /* from nothing to the whole correction */
  double following_limit_mm;        /* 0: no feedback; less: not stated */
  double wait_s;                    /* that the spindle has to come to the speed of the table */
};

struct fts_input {
  double c_deg, z_mm, probe_mm, feedback_mm, age_s;
  int enable, check, c_homed;
};

struct fts_output {
  double position_mm, following_error_mm, speed_rpm, check_c_off_deg;
  int active, checked, fault;
};

struct fts_servo {
  struct fts_output out;
  double c_deg, value_mm, share, waited_s;
  int started, was_checking;
  double turned_deg, n, c, s, cc, cs, ss, y, yc, ys; /* of the check: C passed, and sums of 1, cos C, sin C, reading */
};

/* One word for a .comp file. */
typedef struct fts_servo fts_servo_state;

void fts_servo_period(struct fts_servo *servo, const struct fts_table *table, const struct fts_limits *limits,
                      const struct fts_input *in, double period_s);

#endif
