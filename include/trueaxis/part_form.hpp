// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/form.hpp"
#include "trueaxis/probe_stream.hpp"

/// The form of a diagnosed part (ISO 12181, 12180, 1101): as it was probed, and without what the
/// diagnosis found that is not of the part (form.md; theory.md §33).
namespace trueaxis {

/// What is asked of the form of a reference, and how it is filtered.
struct FormTask {
  ProfileFilter filter = ProfileFilter::gaussian;
  /// Pass band, undulations per revolution. None: where a tolerance is stated 1-50, else the widest
  /// of 1-500, 1-150, 1-50, 1-15 that the readings carry, or as far as they do.
  std::optional<std::array<double, 2>> band_upr{};
  std::optional<double> roundness_tolerance_mm{}, cylindricity_tolerance_mm{},
      runout_tolerance_mm{};
  std::string runout_datum{};  ///< name of a reference, or `spindle_axis`

  bool judges() const {
    return roundness_tolerance_mm || cylindricity_tolerance_mm || runout_tolerance_mm;
  }
};

inline constexpr const char* spindle_axis = "spindle axis";

/// ISO 14253-1; the last where the readings do not carry the value at all.
enum class Conformity { met, not_met, not_proven, not_judged };
const char* to_string(Conformity conformity);

/// A tolerance of form compared with what the readings show of the part.
struct FormJudgement {
  std::string what;       ///< "roundness", "cylindricity", "run-out"
  std::string parameter;  ///< "RONt" …
  double tolerance_mm = 0.0;
  Conformity conformity = Conformity::not_judged;
  FormValue low, high;  ///< of the worst section; apart where the readings leave it open
  std::optional<double> z_mm{};
  std::string why{};  ///< of not_judged
};

/// The form of one reference. Between `with_open` and `without_open` lies that of the part.
struct PartForm {
  FormResult probed;                        ///< of the readings as they are
  std::vector<std::string> motion;          ///< ids of causes that are not of the part: subtracted
  std::vector<std::string> open;            ///< of which the readings do not tell whether they are
  std::optional<FormResult> less_motion{};  ///< none: there is no `motion`
  std::optional<FormResult> less_open{};    ///< less both; none: there is no `open`
  std::size_t left_out = 0;                 ///< readings that the diagnosis excluded
  /// Largest sum of the local forms that the diagnosis found. No surface holds them: RONt, CYLt and
  /// what else rests on them are then bounds, as with FormResult::swallowed.
  double local_mm = 0.0;
  int carried_upr = 0;    ///< by 7 readings a wave
  std::string why_not{};  ///< why there is no value at all; else empty
  std::vector<FormJudgement> judgements{};

  /// Were all that is open form of the part.
  const FormResult& with_open() const { return less_motion ? *less_motion : probed; }
  /// Were none of it.
  const FormResult& without_open() const { return less_open ? *less_open : with_open(); }
  bool met() const;  ///< every tolerance; true without any
};

/// A stream with its diagnosis.
struct DiagnosedStream {
  const ProbeStream& stream;
  const Diagnosis* diagnosis = nullptr;  ///< none: readings are taken as they are
};

/// The form of the part. U holds noise as the diagnosis has it, the ball, and the uncertainty of
/// the subtracted terms (Eqs. 290, 291). A value that is not possible has its reason; nothing is
/// thrown. @param datum of run-out; none: about the spindle axis
PartForm part_form(const DiagnosedStream& part, const FitOptions& fit, const FormTask& task,
                   const DiagnosedStream* datum = nullptr);

/// Largest of the sections; of a value of the whole that itself. nullptr: there is none.
/// @param section where it was found; may be nullptr
const FormValue* worst_value(const FormResult& form, const std::string& name,
                             const std::string& reference, const SectionForm** section = nullptr);

}  // namespace trueaxis
