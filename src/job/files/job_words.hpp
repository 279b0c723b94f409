// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "format/reason_words.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

std::string words_of(const Reason& reason, const IdentifiedJob& job);
std::string words_of(const Reasons& reasons, std::string_view between, const IdentifiedJob& job);
Json reasons_array(const Reasons& reasons, const IdentifiedJob& job);
/// A sentence each.
std::vector<std::string> sentences_of(const Reasons& reasons, const IdentifiedJob& job);

/// "GO with reservations: " and the reasons.
std::string decision_line(Decision decision, const Reasons& reasons, const IdentifiedJob& job = {});

/// The first line of a result: decision, reasons, and what a reader of it must know as well.
std::string verdict_line(const JobResult& result);
/// The same where the reservations are listed below it.
std::string verdict_line_alone(const JobResult& result);

/// How far lines between rows are off, where that is more than allowed; empty: it is not.
std::string coarse_rows_words(const PlannedJob& job);
/// Each of them as a line of a screen.
std::string coarse_rows_lines(const PlannedJob& job, std::string_view label);

/// How the datum follows from the references.
std::string datum_words(const IdentifiedJob& job);

/// Writes into the fits why an axis is withheld.
void word_unknown_axes(JobResult& result);

}  // namespace trueaxis
