/* SPDX-License-Identifier: MIT */
#include "fts_table.h"

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FTS_MOST_ROWS 20000000L /* 320 MB */
#define FTS_LINE 1024

static uint64_t fnv1a(uint64_t hash, const char *text) {
  for (; *text; ++text) hash = (hash ^ (unsigned char)*text) * UINT64_C(1099511628211);
  return hash;
}

/* The text after `# key: `, or NULL. */
static const char *value_of(const char *line, const char *key) {
  const size_t length = strlen(key);
  if (strncmp(line, "# ", 2) != 0 || strncmp(line + 2, key, length) != 0) return NULL;
  return strncmp(line + 2 + length, ": ", 2) == 0 ? line + 4 + length : NULL;
}

/* A number in front of `text`, which is moved past it and past `after`; 0 if it is not there. */
static int take(const char **text, double *value, const char *after) {
  char *end;
  *value = strtod(*text, &end);
  if (end == *text || !isfinite(*value) || strncmp(end, after, strlen(after)) != 0) return 0;
  *text = end + strlen(after);
  return 1;
}

/* What the header says, as far as it was met. */
struct header {
  int schema, linear, sense, speed, limit, rows, range, axis, lateral;
};

static int take_axis(struct fts_table *t, const char *text) {
  if (strncmp(text, "x ", 2) != 0) return 0;
  text += 2;
  return take(&text, &t->axis_x_mm, " mm, y ") && take(&text, &t->axis_y_mm, " mm at Z ") &&
         take(&text, &t->axis_z_mm, " mm, dx/dz ") && take(&text, &t->axis_dx_dz, ", dy/dz ") &&
         take(&text, &t->axis_dy_dz, ",");
}

static void read_header_line(struct fts_table *t, struct header *met, const char *line) {
  const char *text;
  double value;
  if ((text = value_of(line, "schema"))) met->schema = strcmp(text, "trueaxis.correction/1\n") == 0;
  if ((text = value_of(line, "interpolation"))) met->linear = strcmp(text, "linear\n") == 0;
  if ((text = value_of(line, "c_sense")) && take(&text, &value, " while")) {
    met->sense = value == 1.0 || value == -1.0;
    t->sense = value < 0.0 ? -1 : 1;
  }
  if ((text = value_of(line, "speed"))) met->speed = take(&text, &t->speed_rpm, " rpm") && t->speed_rpm > 0.0;
  if ((text = value_of(line, "speed_limit")))
    met->limit = take(&text, &t->speed_limit_rpm, " rpm") && t->speed_limit_rpm >= t->speed_rpm;
  if ((text = value_of(line, "rows_per_revolution")) && take(&text, &value, ",")) {
    met->rows = value >= 8.0 && value <= 100000.0 && value == floor(value);
    t->per_revolution = met->rows ? (long)value : 8;
  }
  if ((text = value_of(line, "nose_centre")) && strncmp(text, "Z ", 2) == 0) {
    text += 2;
    met->range = take(&text, &t->z_start_mm, " to ") && take(&text, &t->z_end_mm, " mm");
  }
  if ((text = value_of(line, "target_axis"))) met->axis = take_axis(t, text);
  if (strcmp(line, "rev,Z[mm],C[deg],X_fts[mm],X_command[mm]\n") == 0) met->lateral = 1;
}

static const char *missing(const struct header *met) {
  if (!met->schema) return "is not a table of trueaxis run (trueaxis.correction/1)";
  if (!met->linear) return "is not judged for a control that joins its rows: state interpolation = \"linear\" in [cut]";
  if (!met->sense) return "does not say c_sense";
  if (!met->speed) return "does not say speed";
  if (!met->limit) return "does not say speed_limit, or less than speed";
  if (!met->rows) return "does not say rows_per_revolution";
  if (!met->range) return "does not say nose_centre along Z (a face cannot be cut with this component)";
  if (!met->axis) return "does not say target_axis";
  if (!met->lateral) return "does not have the columns rev, Z, C, X_fts, X_command";
  return NULL;
}

/* Row `i` is where the header has it. */
static int read_row(struct fts_table *t, long i, const char *line) {
  double rev, c, wanted;
  if (!take(&line, &rev, ",") || !take(&line, &t->z_mm[i], ",") || !take(&line, &c, ",") ||
      !take(&line, &wanted, ",") || !take(&line, &t->value_mm[i], "\n"))
    return 0;
  if (i == 0) t->c_start_deg = c;
  const double turned = (double)(i % t->per_revolution) / (double)t->per_revolution;
  const double off = (c - t->c_start_deg) / 360.0 - t->sense * turned;
  const double ahead = i == 0 ? 0.0 : (t->z_mm[i] - t->z_mm[i - 1]) * (t->z_end_mm - t->z_start_mm);
  if (i == 0 || t->value_mm[i] < t->least_mm) t->least_mm = t->value_mm[i];
  if (i == 0 || t->value_mm[i] > t->most_mm) t->most_mm = t->value_mm[i];
  return rev == (double)(i / t->per_revolution) && fabs(off - floor(off + 0.5)) < 1e-8 && ahead >= 0.0;
}

/* Every revolution feeds as far as the first, until the end of the path. */
static int is_helix(const struct fts_table *t) {
  const long m = t->per_revolution, rows = m * t->revolutions;
  const double feed = t->z_mm[m] - t->z_mm[0];
  if (t->z_mm[0] != t->z_start_mm || t->z_mm[rows - 1] != t->z_end_mm || feed == 0.0) return 0;
  for (long i = 0; i < rows; ++i) {
    const double z = t->z_start_mm + feed * (double)i / (double)m;
    const double along = (z - t->z_end_mm) * feed < 0.0 ? z : t->z_end_mm;
    if (fabs(t->z_mm[i] - along) > 2e-6 * (1.0 + (double)i / (double)m)) return 0;
    if (i >= rows - m && t->z_mm[i] != t->z_end_mm) return 0;
  }
  return 1;
}

static int grow(struct fts_table *t, long *room) {
  const long more = *room ? 2 * *room : 65536;
  double *z = realloc(t->z_mm, (size_t)more * sizeof *z);
  if (z) t->z_mm = z;
  double *value = realloc(t->value_mm, (size_t)more * sizeof *value);
  if (value) t->value_mm = value;
  if (!z || !value) return 0;
  *room = more;
  return 1;
}

static const char *read_lines(struct fts_table *t, FILE *file) {
  struct header met = {0};
  char line[FTS_LINE];
  uint64_t said = 0, hash = UINT64_C(14695981039346656037);
  int checked = 0;
  long rows = 0, room = 0;
  while (fgets(line, sizeof line, file)) {
    const char *text = value_of(line, "checksum");
    if (text && !checked) {
      if (sscanf(text, "fnv1a-64:%16" SCNx64, &said) != 1) return "has a checksum that is not one";
      checked = 1;
      continue;
    }
    if (checked) hash = fnv1a(hash, line);
    if (!met.lateral) {
      read_header_line(t, &met, line);
      if (met.lateral && missing(&met)) return missing(&met);
      continue;
    }
    if (rows == FTS_MOST_ROWS) return "has more rows than 20 million";
    if (rows == room && !grow(t, &room)) return "does not fit into the memory";
    if (!read_row(t, rows, line)) return "has a row that is not where the header has it";
    ++rows;
  }
  if (ferror(file)) return "cannot be read";
  if (missing(&met)) return missing(&met);
  if (!checked) return "does not have a checksum: write it again with this version of trueaxis";
  if (said != hash) return "has changed since it was written: its checksum does not fit";
  t->revolutions = rows / t->per_revolution;
  if (rows % t->per_revolution || t->revolutions < 2) return "does not have whole revolutions";
  return is_helix(t) ? NULL : "does not have rows along one helix";
}

int fts_table_read(struct fts_table *t, const char *path, char *why, size_t size) {
  memset(t, 0, sizeof *t);
  FILE *file = fopen(path, "r");
  const char *wrong = file ? read_lines(t, file) : "cannot be opened";
  if (file) fclose(file);
  if (!wrong) return 0;
  fts_table_free(t);
  snprintf(why, size, "%s %s", path, wrong);
  return -1;
}

void fts_table_free(struct fts_table *t) {
  free(t->z_mm);
  free(t->value_mm);
  memset(t, 0, sizeof *t);
}

double fts_table_turns(const struct fts_table *t, double c_deg) { return t->sense * (c_deg - t->c_start_deg) / 360.0; }

static double between(const double *values, long row, long next, double share) {
  return values[row] + share * (values[next] - values[row]);
}

double fts_table_at(const struct fts_table *t, double turns, double z_mm) {
  const long m = t->per_revolution;
  const double least = fmin(t->z_start_mm, t->z_end_mm), most = fmax(t->z_start_mm, t->z_end_mm);
  const double z = fmin(fmax(z_mm, least), most), feed = t->z_mm[m] - t->z_mm[0];
  double part = turns - floor(turns);
  if (part >= 1.0) part = 0.0; /* a turn less a rounding */
  const double at = part * (double)m;
  const long i = (long)at < m ? (long)at : m - 1;
  const double share = at - (double)i;
  /* The revolution before this Z at this angle; the guess is at most one off, because Z is rounded. */
  const double guess = floor((z - t->z_start_mm) / feed - part);
  long k = guess <= 0.0 ? 0 : guess >= (double)(t->revolutions - 2) ? t->revolutions - 2 : (long)guess;
  const long last = m * t->revolutions;
  for (int step = 0;; ++step) {
    const long row = k * m + i, above = row + m, next = above + 1 < last ? above + 1 : last - m;
    const double from = between(t->z_mm, row, row + 1, share), to = between(t->z_mm, above, next, share);
    if (step == 0 && (z - to) * feed > 0.0 && k < t->revolutions - 2) {
      ++k;
    } else if (step == 0 && (z - from) * feed < 0.0 && k > 0) {
      --k;
    } else {
      const double along = to != from ? fmin(fmax((z - from) / (to - from), -1.0), 1.0) : 0.0;
      const double a = between(t->value_mm, row, row + 1, share), b = between(t->value_mm, above, next, share);
      return a + along * (b - a);
    }
  }
}
