// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/consequences.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace trueaxis {
namespace {

using Consequence = std::pair<std::string_view, std::string_view>;

constexpr Consequence lines[] = {
    {"part.chuck_lobing", "clamp with less force, or re-bore the soft jaws"},
    {"part.roundness", "no harm to the axis"},
    {"part.feed_marks", "the finish of the part: nothing to do for the axis"},
    {"part.bow", "straighten or support the part; its axis holds for the probed length"},
    {"part.slip", "clamp more firmly and probe again"},
    {"part.barrel", "no harm to the axis"},
    {"part.taper", "the part's own form: fit a cone if it is meant to be one"},
    {"part.waviness", "no harm to the axis"},
    {"part.face_saddle", "clamp with less force, or leave the face as it is: the axis is right"},
    {"part.face_lobes", "the face's own form: nothing to do for its direction"},
    {"part.face_cone", "the face's own form: nothing to do for its direction"},
    {"part.face_crown", "the face's own form: nothing to do for its direction"},
    {"part.face_spiral", "the finish of the face: nothing to do"},
    {"part.seat_slip", "seat the part against its stop and probe again"},
    {"spindle.radial_synchronous", "bearings: the tool meets it too, service if it grows"},
    {"spindle.tilt_synchronous",
     "spindle bearings: it grows with the overhang, have it serviced if it grows"},
    {"spindle.axial_synchronous", "thrust bearing of the spindle: have it serviced if it grows"},
    {"spindle.asynchronous", "bearing cage or balls: have the spindle serviced if it grows"},
    {"spindle.axial_fundamental", "thrust face or nut of the spindle not square: have it serviced"},
    {"spindle.axial_asynchronous", "thrust bearing of the spindle: have it serviced if it grows"},
    {"spindle.face_tilt", "spindle bearings: have the spindle serviced if it grows"},
    {"slide.z_straightness", "guideways of Z: every part cut there has it; compensate EXZ"},
    {"slide.xz_parallelism", "align the headstock: every part becomes a cone"},
    {"slide.leadscrew_periodic", "screw or scale of Z: compensate its pitch error"},
    {"slide.backlash", "set the play of Z, or probe in one direction"},
    {"slide.xz_squareness", "align the cross slide: every face becomes a cone"},
    {"slide.x_straightness", "guideways of X: compensate EZX"},
    {"probe.height", "set the probe to the height of the spindle axis"},
    {"probe.tilt", "align the probe"},
    {"probe.ball_radius", "state the ball's radius (--ball-radius)"},
    {"probe.pretravel", "calibrate the probe in the direction of measurement"},
    {"probe.gain", "calibrate the sensor's gain"},
    {"probe.nonlinearity", "calibrate the sensor over its range"},
    {"probe.cyclic", "scale or sensor: have its interpolation adjusted"},
    {"probe.latency", "correct the time stamps of C and Z"},
    {"probe.lag", "probe more slowly, or correct the filter's delay"},
    {"encoder.offset", "set the zero of C against the tool"},
    {"encoder.eccentricity", "centre the encoder of C, or compensate one line per turn"},
    {"thermal.drift", "let the machine warm up before probing"},
    {"environment.vibration", "find what shakes at this frequency, and probe when it is off"},
};

}  // namespace

std::string_view consequence_of(std::string_view effect) {
  const auto* found = std::ranges::find(lines, effect, &Consequence::first);
  return found == std::end(lines) ? std::string_view() : found->second;
}

}  // namespace trueaxis
