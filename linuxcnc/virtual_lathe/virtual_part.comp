// SPDX-License-Identifier: GPL-2.0-or-later
component virtual_part "a shaft in the chuck of a simulated lathe, probed and cut where the machine really is";
description """
Stands in for part, probe, encoders and drives of a simulated lathe X Z C. The part is clamped off the
spindle axis, tilted, and has three lobes. The probe meets it numerically: a point of its line is taken to
the part's own axis by vectors, and moved until it is on the surface. A trigger also meets the bore about that
axis, and the face across it. What the tool leaves is kept as the
path on which it ran, a point per degree.

.B probe
runs before the motion controller and sees where the axes were commanded one servo period ago: this is the
latency of the control.
.B encode
runs after it and rounds the positions as encoders do.
.B cut
runs before the fast tool servo in the thread, and so moves the tool one period late, as a drive does; it
interpolates between the periods.
""";
license "GPL";
author "the TrueAxis authors";
option singleton yes;

pin in float slide_x "command of the slide, mm (a radius)";
pin in float slide_z "mm";
pin in float spindle_c "spindle angle, degrees, running";
pin in float servo "command of the fast tool servo, added to the slide, mm";
pin in bit cutting "the tool is at the part";
pin in bit trigger "the probe is a trigger; false: a gauge";
pin out bit touches "the ball is at the surface or inside it";
pin out float deflection "of the gauge: contact less slide, mm";
pin out float x_encoder;
pin out float z_encoder;
pin out float c_encoder;
param rw float radius = 30 "mm";
param rw float front = 0 "where the part ends, mm along its axis from Z = 0";
param rw float bore = 0 "radius of a bore, mm; 0: none";
param rw float centre_x = 0 "where the axis of the part meets Z = 0, mm";
param rw float centre_y = 0;
param rw float slope_x = 0 "direction cosines of the axis";
param rw float slope_y = 0;
param rw float lobes = 0 "amplitude of three lobes, mm";
param rw float lobes_at = 0 "their phase, rad";
param rw float ball = 0 "radius of the ball, mm";
param rw float sigma = 0 "standard deviation of a reading, mm";
param rw unsigned seed = 1;
param rw float linear_step = 0.0001 "of the encoders, mm";
param rw float angle_step = 0.001 "degrees";
param r unsigned lost "points of a cut that were not kept: the cut is then not to be used";
function probe fp;
function encode fp;
function cut fp;
;;
#include <rtapi_math.h>

/* The path of the tool over the turning part, where C is a whole number of degrees. */
#define MOST_POINTS 720000
static struct { double x, z; } path[MOST_POINTS];
static long first_degree, points;
static double last_c, last_x, last_z;
static int was_cutting;
static unsigned long long state;

static double uniform(void) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return ((double)(state >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) {
    return sqrt(-2.0 * log(uniform())) * cos(2.0 * M_PI * uniform());
}

/* The radius that the tool left at a whole degree of the turning part; the uncut one where it was not. */
static double left_at(long degree, double at_z, double uncut) {
    long turn = (degree - first_degree) % 360, low, high;
    if (turn < 0) turn += 360;
    if (points <= turn) return uncut;
    low = 0, high = (points - 1 - turn) / 360;
    #define POINT(k) path[turn + 360 * (k)]
    if (high < 1 || (at_z - POINT(0).z) * (at_z - POINT(high).z) > 0.0) return uncut;
    while (high - low > 1) {
        long middle = (low + high) / 2;
        if ((at_z - POINT(middle).z) * (at_z - POINT(low).z) > 0.0) low = middle;
        else high = middle;
    }
    double step = POINT(high).z - POINT(low).z;
    double share = step != 0.0 ? (at_z - POINT(low).z) / step : 0.0;
    double left = POINT(low).x + share * (POINT(high).x - POINT(low).x);
    #undef POINT
    return left < uncut ? left : uncut;
}

FUNCTION(probe) {
    double l = slope_x, m = slope_y;
    double turned = spindle_c * M_PI / 180.0, cosine = cos(turned), sine = sin(turned);
    double n = sqrt(1.0 - l * l - m * m);
    /* two directions across the axis, from which the lobes are counted */
    double length = sqrt(n * n + l * l), ux = n / length, uz = -l / length;
    double vx = m * uz, vy = n * ux - l * uz, vz = -m * ux;
    double inside = 0.0, outside = 2.0 * radius, met;
    int side = slide_x < 0.0 ? -1 : 1, k;
    for (k = 0; k < 60; ++k) {
        double X = 0.5 * (inside + outside) * side;
        double wx = X * cosine - centre_x, wy = X * sine - centre_y, wz = slide_z;
        double along = wx * l + wy * m + wz * n;
        double rx = wx - along * l, ry = wy - along * m, rz = wz - along * n;
        double across = sqrt(rx * rx + ry * ry + rz * rz);
        double angle = atan2(rx * vx + ry * vy + rz * vz, rx * ux + rz * uz);
        if (across > radius + lobes * cos(3.0 * angle - lobes_at)) outside = X * side;
        else inside = X * side;
    }
    met = outside;
    if (points > 360) {
        double degree = spindle_c - (side < 0 ? 180.0 : 0.0), low = floor(degree);
        double before = left_at((long)low, slide_z, met), after = left_at((long)low + 1, slide_z, met);
        met = before + (degree - low) * (after - before);
    }
    met = side * (met + ball);
    if (state == 0) state = seed * 2654435761ULL + 1;
    double noise = sigma * normal();
    met += noise;
    /* the centre of the ball, along the axis and across it */
    double wx = slide_x * cosine - centre_x, wy = slide_x * sine - centre_y;
    double along = wx * l + wy * m + slide_z * n;
    double across = sqrt(wx * wx + wy * wy + slide_z * slide_z - along * along);
    touches = trigger && along < front + ball + noise && side * (slide_x - met) <= 0.0 &&
              (bore == 0.0 || across > bore - ball + noise);
    deflection = met - slide_x;
}

FUNCTION(encode) {
    x_encoder = floor(slide_x / linear_step + 0.5) * linear_step;
    z_encoder = floor(slide_z / linear_step + 0.5) * linear_step;
    c_encoder = floor(spindle_c / angle_step + 0.5) * angle_step;
}

FUNCTION(cut) {
    double tool = slide_x + servo;
    if (cutting && !was_cutting) {
        points = 0;
        first_degree = (long)ceil(spindle_c);
    } else if (cutting && spindle_c > last_c) {
        long degree = (long)ceil(last_c);
        for (; (double)degree < spindle_c; ++degree) {
            double share = ((double)degree - last_c) / (spindle_c - last_c);
            if (degree != first_degree + points || points >= MOST_POINTS) {
                ++lost;
                continue;
            }
            path[points].x = last_x + share * (tool - last_x);
            path[points].z = last_z + share * (slide_z - last_z);
            ++points;
        }
    }
    was_cutting = cutting;
    last_c = spindle_c, last_x = tool, last_z = slide_z;
}
