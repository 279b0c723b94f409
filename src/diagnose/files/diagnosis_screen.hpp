// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// A diagnosis in some ten lines for a person: verdict, what was seen and its causes, the axis,
/// what to do next. Lines are not broken (the command does). diagnosis_text() has the rest.
/// @param form lines of the form: before the axis, or last if a tilt is all of it
std::string diagnosis_screen(const Diagnosis& diagnosis, const std::string& form = {});

/// RMS of the residuals that screen and report give: those of the final model.
double rms_shown_mm(const Diagnosis& diagnosis);

/// The part of it about what was seen, at most `most` causes.
std::string findings_screen(const Diagnosis& diagnosis, std::size_t most);

/// "hidden 2.2 ms of probe latency … moves the axis by U, and …": what no size of is seen in
/// these readings, by how much of it moves the axis by as much as U; empty: nothing, or of a plane.
std::string unseen_screen(const Diagnosis& diagnosis);

/// "limit  U 0.66 µm would be 0.33 µm without probe.lag …": what limits U of the axis most, and
/// what to do about it; empty: an axis without U, or of a plane. limit_text: without the label.
std::string limit_text(const Diagnosis& diagnosis);
std::string limit_screen(const Diagnosis& diagnosis);

/// "no deviation from an ideal cone detected in 1463 of 1469 readings"; of all: without the count.
std::string ideal_words(const Diagnosis& diagnosis);

/// "check  100 readings at C 80-98° excluded …": which readings count nowhere, and why.
std::string excluded_screen(const Diagnosis& diagnosis);

}  // namespace trueaxis
