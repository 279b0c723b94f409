// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis {

/// `trueaxis.form/1`.
std::string form_json(const FormResult& result);

/// Lobes that the cut-off takes part of, with what it lets through.
Json swallowed_json(const FormResult& result);

/// For a surface that was estimated as one: readings, orders, noise.
Json surface_json(const FormSurface& surface);

/// "2.1 ± 0.3 µm", or "below 4.1 µm (95 % confidence)". @param scale from inside to the unit
std::string form_value_text(const FormValue& one, double k, double scale, const std::string& unit);

/// The profiles of all sections, before and after the filter: `trueaxis.form_profile/1`.
std::string form_profile_csv(const FormResult& result);

/// The screen of a form: values with U, filter, circles, lobes, on 15 to 20 lines. `verbose`: every
/// section and its harmonics.
std::string form_text(const FormResult& result, bool verbose);

/// "3 lobes of 4.97 ± 0.15 µm (78 % pass 5 UPR)", of all that a cut-off takes part of.
std::string swallowed_words(const FormResult& result);

/// What a value of a name may be at most, mm: the tolerance of a drawing.
struct FormTolerance {
  std::string name;
  double limit_mm;
};

/// The form as a QIF results document (`trueaxis.qif/1`). Each section is a circle with its
/// roundness, the whole a cylinder, cone, plane or line with its form, all about the minimum zone.
/// Every tolerance has its characteristic, judged by ISO 14253-1. `in_part_frame` is false of
/// points, whose sections have no place in a frame of the user's.
std::string form_qif(const FormResult& result, const std::vector<FormTolerance>& tolerances,
                     bool in_part_frame);

/// The radial error motion along the probe that a result of `trueaxis spindle` (JSON) states;
/// orders that it suppressed are not in it.
/// @throws InputError if the file is not such a result, or its sensitive direction is not +X
std::vector<SpindleOrder> read_spindle_motion(const std::string& path);

}  // namespace trueaxis
