/* SPDX-License-Identifier: MIT
 *
 * The correction table of `trueaxis run` (table.csv, trueaxis.correction/1) for a servo thread. Plain C, without HAL and
 * without the TrueAxis library.
 */
#ifndef TRUEAXIS_FTS_TABLE_H
#define TRUEAXIS_FTS_TABLE_H

#include <stddef.h>

/* Rows along a helix: row i is at C = c_start + sense 360 i / per_revolution, and z_mm[i] is its Z. The last revolution is
 * at the end of the path and closes on itself. */
struct fts_table {
  long revolutions, per_revolution;
  int sense; /* of C while cutting: +1 or -1 */
  double c_start_deg;
  double speed_rpm, speed_limit_rpm; /* of which X_command is made; the highest that the actuator follows */
  double z_start_mm, z_end_mm;       /* where the path of the nose's centre starts and ends */
  double least_mm, most_mm;          /* of value_mm */
  double axis_x_mm, axis_y_mm, axis_z_mm, axis_dx_dz, axis_dy_dz; /* the target axis, in the frame of the part */
  double *z_mm, *value_mm;                                        /* X_command */
};

/* 0: read. Else `why` says what is wrong with the file, and the table is empty. */
int fts_table_read(struct fts_table *table, const char *path, char *why, size_t size);
void fts_table_free(struct fts_table *table);

/* Revolutions since the first row, in the sense of the cut. */
double fts_table_turns(const struct fts_table *table, double c_deg);

/* X_command there, mm: linear between the rows along C, and along Z between the revolutions. Before the first row and after
 * the last along Z the ends are held. */
double fts_table_at(const struct fts_table *table, double turns, double z_mm);

#endif
