/* SPDX-License-Identifier: MIT */
#include "fts_servo.h"

#include <math.h>

#define FTS_RAD_PER_DEG 0.017453292519943295
#define FTS_SPEED_S 0.05      /* over which the speed of C is averaged */
#define FTS_BACKLASH_DEG 1.0  /* that C may move back in a period */
#define FTS_STANDING_RPM 5.0  /* below it the sense is not known */

const char *fts_fault_name(int fault) {
  static const char *const names[FTS_FAULTS] = {
      "none",
      "C, Z, probe or feedback is not a number",
      "C is not homed",
      "the table leaves the stroke",
      "the program leaves the range of the table along Z",
      "following-limit is not set: mm, or 0 for an actuator without feedback",
      "the table is older than max-age",
      "C zero and clamping are not checked: turn the part under the probe with the pin check",
      "the spindle turns the other way than the table is for",
      "the spindle is faster than the speed limit of the table",
      "the spindle has another speed than the table is for",
      "C jumped",
      "the actuator does not follow",
      "the probe is wired inverted",
      "C zero is not that of the table: see check-c-off",
      "the part is not clamped as it was when the table was made"};
  return fault >= 0 && fault < FTS_FAULTS ? names[fault] : "unknown";
}

static double step_of(struct fts_servo *servo, double c_deg) {
  const double step = servo->started ? c_deg - servo->c_deg : 0.0;
  servo->c_deg = c_deg;
  servo->started = 1;
  return step - 360.0 * floor(step / 360.0 + 0.5); /* C may be wrapped */
}

static void start_check(struct fts_servo *servo) {
  servo->turned_deg = servo->n = servo->c = servo->s = servo->cc = servo->cs = servo->ss = 0.0;
  servo->y = servo->yc = servo->ys = 0.0;
  servo->out.checked = 0;
  servo->out.check_c_off_deg = 0.0;
}

static void add_reading(struct fts_servo *servo, const struct fts_input *in, double step_deg) {
  const double c = cos(in->c_deg * FTS_RAD_PER_DEG), s = sin(in->c_deg * FTS_RAD_PER_DEG);
  servo->turned_deg += step_deg;
  servo->n += 1.0, servo->c += c, servo->s += s, servo->cc += c * c, servo->cs += c * s, servo->ss += s * s;
  servo->y += in->probe_mm, servo->yc += in->probe_mm * c, servo->ys += in->probe_mm * s;
}

/* Least squares of reading = r + x cos C + y sin C over a revolution, compared with the axis of the table. */
static int end_check(struct fts_servo *servo, const struct fts_table *t, const struct fts_limits *limits, double z_mm) {
  const double cc = servo->cc - servo->c * servo->c / servo->n, cs = servo->cs - servo->c * servo->s / servo->n;
  const double ss = servo->ss - servo->s * servo->s / servo->n;
  const double yc = servo->yc - servo->y * servo->c / servo->n, ys = servo->ys - servo->y * servo->s / servo->n;
  const double det = cc * ss - cs * cs;
  const double x = (yc * ss - ys * cs) / det, y = (ys * cc - yc * cs) / det;
  const double axis_x = t->axis_x_mm + t->axis_dx_dz * (z_mm - t->axis_z_mm);
  const double axis_y = t->axis_y_mm + t->axis_dy_dz * (z_mm - t->axis_z_mm);
  const double tolerance = limits->check_tolerance_mm;
  if (hypot(x - axis_x, y - axis_y) <= tolerance) {
    servo->out.checked = 1;
    return FTS_NONE;
  }
  if (hypot(x + axis_x, y + axis_y) <= tolerance) return FTS_PROBE_INVERTED;
  if (!(fabs(hypot(x, y) - hypot(axis_x, axis_y)) <= tolerance)) return FTS_OTHER_CLAMPING;
  servo->out.check_c_off_deg = atan2(y * axis_x - x * axis_y, x * axis_x + y * axis_y) / FTS_RAD_PER_DEG;
  return FTS_C_ZERO;
}

/* Of table and machine, before the ramp: may this table be run here at all? In the cut no answer would stop the tool. */
static int doubt_of_table(const struct fts_servo *servo, const struct fts_table *t, const struct fts_limits *limits,
                          const struct fts_input *in) {
  if (!in->c_homed) return FTS_C_NOT_HOMED;
  if (servo->share > 0.0) return FTS_NONE;
  if (!(t->most_mm <= 0.5 * limits->stroke_mm && t->least_mm >= -0.5 * limits->stroke_mm)) return FTS_STROKE;
  if (!(limits->z_low_mm < limits->z_high_mm && limits->z_low_mm >= fmin(t->z_start_mm, t->z_end_mm) &&
        limits->z_high_mm <= fmax(t->z_start_mm, t->z_end_mm)))
    return FTS_RANGE;
  if (!(limits->following_limit_mm >= 0.0)) return FTS_LIMIT_NOT_STATED;
  if (!(in->age_s >= 0.0 && in->age_s <= limits->max_age_s)) return FTS_AGE;
  return servo->out.checked ? FTS_NONE : FTS_NOT_CHECKED;
}

static int doubt_of_motion(const struct fts_servo *servo, const struct fts_table *t, const struct fts_limits *limits,
                           double step_deg, double period_s) {
  const double ahead = t->sense * step_deg, speed = t->sense * servo->out.speed_rpm;
  if (speed < -FTS_STANDING_RPM) return FTS_SENSE;
  if (ahead < -FTS_BACKLASH_DEG || ahead > FTS_BACKLASH_DEG + 2.0 * 6.0 * t->speed_limit_rpm * period_s)
    return FTS_C_JUMPED;
  if (speed > t->speed_limit_rpm * (1.0 + limits->speed_tolerance)) return FTS_SPEED_LIMIT;
  if (limits->following_limit_mm > 0.0 && fabs(servo->out.following_error_mm) > limits->following_limit_mm)
    return FTS_FOLLOWING;
  if (servo->waited_s > limits->wait_s) return FTS_SPEED;
  if (servo->share > 0.0 && !(fabs(speed - t->speed_rpm) <= limits->speed_tolerance * t->speed_rpm)) return FTS_SPEED;
  return FTS_NONE;
}

static int at_speed(const struct fts_servo *servo, const struct fts_table *t, const struct fts_limits *limits) {
  return fabs(t->sense * servo->out.speed_rpm - t->speed_rpm) <= 0.5 * limits->speed_tolerance * t->speed_rpm;
}

void fts_servo_period(struct fts_servo *servo, const struct fts_table *table, const struct fts_limits *limits,
                      const struct fts_input *in, double period_s) {
  struct fts_output *out = &servo->out;
  if (!isfinite(in->c_deg) || !isfinite(in->z_mm) || !isfinite(in->feedback_mm) || !isfinite(in->probe_mm)) {
    out->fault = FTS_NO_NUMBER; /* and everything stays as it is */
    return;
  }
  const double step_deg = step_of(servo, in->c_deg);
  out->speed_rpm += (step_deg / (6.0 * period_s) - out->speed_rpm) * fmin(1.0, period_s / FTS_SPEED_S);
  out->following_error_mm = in->feedback_mm - out->position_mm;
  if (!in->c_homed) out->checked = 0;

  if (in->check && !servo->was_checking) start_check(servo);
  if (in->check && fabs(servo->turned_deg) < 360.0) {
    add_reading(servo, in, step_deg);
    if (fabs(servo->turned_deg) >= 360.0) out->fault = end_check(servo, table, limits, in->z_mm);
  }
  servo->was_checking = in->check;
  servo->waited_s = in->enable && servo->share == 0.0 ? servo->waited_s + period_s : 0.0;

  if (in->enable && (out->fault == FTS_NONE || out->fault == FTS_SPEED)) {
    int doubt = doubt_of_table(servo, table, limits, in);
    if (doubt == FTS_NONE) doubt = doubt_of_motion(servo, table, limits, step_deg, period_s);
    if (doubt != FTS_NONE) out->fault = doubt;
  }
  /* With another speed C and Z are right, and the lag is wrong by less than what is held would be: a feed hold that
   * stops C too goes on along the table. */
  if (out->fault == FTS_NONE || out->fault == FTS_SPEED)
    servo->value_mm = fts_table_at(table, fts_table_turns(table, in->c_deg), in->z_mm);
  /* A fault holds the position; without `enable` it is then left by the ramp, from where it is. */
  const double change = limits->ramp_s > period_s ? period_s / limits->ramp_s : 1.0;
  if (!in->enable)
    servo->share = fmax(0.0, servo->share - change);
  else if (out->fault == FTS_NONE && (servo->share > 0.0 || at_speed(servo, table, limits)))
    servo->share = fmin(1.0, servo->share + change);
  out->position_mm = servo->share * servo->share * (3.0 - 2.0 * servo->share) * servo->value_mm;
  out->active = servo->share == 1.0 && out->fault == FTS_NONE;
  if (!in->enable && !in->check && servo->share == 0.0) out->fault = FTS_NONE;
}
