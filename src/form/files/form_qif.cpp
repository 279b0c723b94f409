// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "form/files/form_files.hpp"
#include "interchange/qif.hpp"

namespace trueaxis {
namespace {

/// What QIF calls a value, and the shape of its zone.
struct Characteristic {
  const char *name, *kind, *zone;
};
constexpr Characteristic known[] = {{"RONt", "Circularity", ""},
                                    {"CYLt", "Cylindricity", ""},
                                    {"CONt", "Conicity", ""},
                                    {"FLTt", "Flatness", ""},
                                    {"STRt", "Straightness", "NonDiametricalZone"},
                                    {"STRsg", "Straightness", "NonDiametricalZone"},
                                    {"STRsa", "Straightness", "DiametricalZone"},
                                    {"runout_circular", "CircularRunout", ""},
                                    {"runout_total", "TotalRunout", ""},
                                    {"axial_runout_circular", "CircularRunout", ""},
                                    {"axial_runout_total", "TotalRunout", ""},
                                    {"coaxiality", "Coaxiality", "DiametricalZone"},
                                    {"concentricity", "Concentricity", "DiametricalZone"},
                                    {"parallelism", "Parallelism", "DiametricalZone"}};

/// The features of which a value is the form.
const std::map<std::string, QifFeatureKind> form_of{{"CYLt", QifFeatureKind::cylinder},
                                                    {"CONt", QifFeatureKind::cone},
                                                    {"FLTt", QifFeatureKind::plane},
                                                    {"STRt", QifFeatureKind::line}};

bool about_minimum_zone(const FormValue& one) {
  return one.reference.empty() || one.reference.starts_with("MZ");
}

/// Bounds are not a measured value.
bool is_measured(const FormValue& one) { return !one.estimate.interval; }

QifValue value_of(const FormValue& one) {
  return {one.estimate.value, one.estimate.u, one.bias_mm};
}

/// A value with the feature that it is of.
struct Placed {
  const FormValue* value;
  std::optional<std::size_t> feature{};
};

QifFeature circle_of(const SectionForm& section, std::size_t number, bool radius_known,
                     bool in_part_frame) {
  QifFeature out{.kind = QifFeatureKind::circle,
                 .name = fmt::format("section {}", number),
                 .algorithm = "MINMAX"};
  for (const FormCircle& circle : section.circles) {
    if (circle.criterion != Criterion::minimum_zone || !circle.why_not.empty()) continue;
    if (in_part_frame) {
      out.point_mm = QifVector{.value = {circle.x_mm, circle.y_mm, section.z_mm.value_or(0.0)},
                               .has_z = section.z_mm.has_value()};
      out.direction = QifVector{.value = {0.0, 0.0, 1.0}};
    }
    if (radius_known) out.diameter_mm = QifValue{2.0 * circle.radius_mm};
  }
  return out;
}

/// Every feature, and every value about the minimum zone.
std::vector<Placed> add_features(const FormResult& result, bool in_part_frame, QifResults& qif) {
  std::vector<Placed> values;
  for (const SectionForm& section : result.sections) {
    const std::size_t at = qif.features.size();
    qif.features.push_back(circle_of(section, at + 1, result.radius_known, in_part_frame));
    for (const FormValue& one : section.values)
      if (about_minimum_zone(one) && is_measured(one)) {
        if (one.name == "RONt") qif.features.back().form_mm = value_of(one);
        values.push_back({&one, at});
      }
  }
  for (const FormGroup& group : result.groups)
    for (const FormValue& one : group.values) {
      if (!about_minimum_zone(one)) continue;
      const auto kind = form_of.find(one.name);
      std::optional<std::size_t> feature;
      if (kind != form_of.end()) {
        feature = qif.features.size();
        qif.features.push_back({.kind = kind->second, .name = one.name, .algorithm = "MINMAX"});
        if (is_measured(one)) qif.features.back().form_mm = value_of(one);
      }
      if (is_measured(one)) values.push_back({&one, feature});
    }
  return values;
}

QifStatus judged(const FormValue& value, double coverage_factor, double limit_mm) {
  if (most_of(value, coverage_factor) <= limit_mm) return QifStatus::pass;
  return least_of(value, coverage_factor) > limit_mm ? QifStatus::fail : QifStatus::indeterminate;
}

/// The straightness of a line in space is the diameter of a cylinder, which is all that it has.
bool in_space(const FormResult& result, const std::string& name) {
  return name == "STRt" && std::ranges::any_of(result.groups, [](const FormGroup& group) {
           return group.name == "straightness" && group.values.size() == 1;
         });
}

/// The bounds of the whole, which QIF has no place for: " Bounds in place of a value: FLTt below
/// …".
std::string bounds_text(const FormResult& result) {
  std::string text;
  for (const FormGroup& group : result.groups)
    for (const FormValue& one : group.values)
      if (one.unresolved && about_minimum_zone(one))
        text += fmt::format(
            "{}{} {}", text.empty() ? " Bounds in place of a value: " : ", ", one.name,
            form_value_text(one, result.options.coverage_factor, 1.0 / mm_per_um, "µm"));
  return text.empty() ? text : text + '.';
}

std::string description(const FormResult& result) {
  const FormOptions& options = result.options;
  std::string filter = to_string(options.filter);
  if (options.filter != ProfileFilter::none)
    filter += fmt::format(" {:g}-{:g} UPR", options.low_upr, options.high_upr);
  std::string datum = "spindle axis";
  if (!result.datum_source.empty())
    datum = fmt::format("{}, {}", result.datum_source, name_of(options.datum));
  return fmt::format(
      "Form of {} ({}) about the minimum zone. Filter: {}. Datum: {}. combinedUncertainty is the "
      "standard uncertainty u, meanError what noise adds on average, which is included in u and "
      "not subtracted. Status by ISO 14253-1 with U = {:g} u.{}",
      result.source, result.input_hash, filter, datum, options.coverage_factor,
      bounds_text(result));
}

}  // namespace

std::string form_qif(const FormResult& result, const std::vector<FormTolerance>& tolerances,
                     bool in_part_frame) {
  QifResults qif{.description = description(result)};
  const std::vector<Placed> values = add_features(result, in_part_frame, qif);
  for (const FormTolerance& tolerance : tolerances) {
    const auto* kind = std::ranges::find(known, tolerance.name, &Characteristic::name);
    if (kind == std::end(known)) continue;
    QifCharacteristic one{.kind = kind->kind,
                          .name = tolerance.name,
                          .zone = in_space(result, tolerance.name) ? "DiametricalZone" : kind->zone,
                          .tolerance_mm = tolerance.limit_mm};
    for (const auto& [value, feature] : values)
      if (value->name == tolerance.name)
        one.measurements.push_back(
            {value_of(*value), judged(*value, result.options.coverage_factor, tolerance.limit_mm),
             feature});
    if (!one.measurements.empty()) qif.characteristics.push_back(std::move(one));
  }
  return qif_document(qif, TRUEAXIS_VERSION);
}

}  // namespace trueaxis
