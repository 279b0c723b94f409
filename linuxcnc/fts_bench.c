/* SPDX-License-Identifier: MIT
 *
 * How long a period takes: fts_bench TABLE.csv [CALLS]. C moves as in a cut, and Z jumps to a random place every 64th call,
 * so that the rows are not in the cache. Every call is timed; the calls are repeated, and the least time of each counts,
 * because the bench is interrupted like any program. Built by scripts/bench_servo.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fts_servo.h"

static double now_ns(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static int in_order(const void *a, const void *b) { return (*(const float *)a > *(const float *)b) - (*(const float *)a < *(const float *)b); }

/* The least of the passes so far, for each call: what a call costs without what interrupts it. */
static double pass(const struct fts_table *table, long calls, int number, float *least) {
  const double low = fmin(table->z_start_mm, table->z_end_mm), high = fmax(table->z_start_mm, table->z_end_mm);
  const struct fts_limits limits = {10.0, low, high, 1e9, 1e9, 0.05, 0.1, 0.0, 1e9};
  struct fts_servo servo = {0};
  struct fts_input in = {0.0, table->z_start_mm, 0.0, 0.0, 0.0, 0, 1, 1};
  const double period_s = 1e-4, step_deg = table->sense * 6.0 * table->speed_rpm * period_s;
  double total = 0.0, sum = 0.0;
  srand(1);
  for (long i = 0; i < calls; ++i) {
    in.c_deg = fmod(in.c_deg + step_deg + 360.0, 360.0);
    if (i % 64 == 0) in.z_mm = low + (high - low) * rand() / RAND_MAX;
    in.check = i <= 4000; /* a revolution or more */
    in.enable = !in.check;
    const double before = now_ns();
    fts_servo_period(&servo, table, &limits, &in, period_s);
    const double took = now_ns() - before;
    total += took;
    sum += servo.out.position_mm;
    if (number == 0 || took < least[i]) least[i] = (float)took;
  }
  if (!servo.out.active) printf("not active: %s\n", fts_fault_name(servo.out.fault));
  return total / (double)calls + 0.0 * sum;
}

int main(int argc, char **argv) {
  struct fts_table table;
  char why[1200];
  if (argc < 2 || fts_table_read(&table, argv[1], why, sizeof why) != 0) {
    fprintf(stderr, "%s\n", argc < 2 ? "fts_bench TABLE.csv [CALLS]" : why);
    return 1;
  }
  const long calls = argc > 2 ? atol(argv[2]) : 10000000;
  enum { PASSES = 5 };
  float *least = malloc((size_t)calls * sizeof *least);
  if (!least) return 1;
  double mean = 0.0;
  for (int i = 0; i < PASSES; ++i) mean += pass(&table, calls, i, least) / PASSES;
  qsort(least, (size_t)calls, sizeof *least, in_order);
  printf("%ld calls, the clock included: mean %.0f ns; each call's least of %d: 99.9 %% below %.0f ns, worst %.0f ns\n", calls,
         mean, PASSES, (double)least[calls - 1 - calls / 1000], (double)least[calls - 1]);
  free(least);
  fts_table_free(&table);
  return 0;
}
