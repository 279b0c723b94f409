// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "form/bounded.hpp"
#include "form/closing.hpp"
#include "form/face.hpp"
#include "form/notes.hpp"
#include "form/part.hpp"
#include "form/sampling.hpp"
#include "form/swallowed.hpp"
#include "form/uncertainty.hpp"
#include "form/whole_model.hpp"
#include "measure/feature.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis {
namespace form {
namespace {

constexpr const char* eccentricity = "eccentricity";

WholeModel whole_of(const std::vector<SectionModel>& sections, const FormOptions& options) {
  const Criterion criteria[] = {Criterion::gaussian, options.datum};
  return {sections, criteria, options.all_references};
}

/// How the axis of a datum leans.
Lean lean_of(const ProbeStream& datum, const FormOptions& options) {
  const Part part = part_of(datum, options);
  const std::vector<SectionModel>& sections = part.model.sections;
  if (sections.size() < 2 || !part.sections.radius_known)
    throw InputError(datum.source,
                     "does not show the direction of an axis, which axial run-out is about: probe "
                     "the datum along Z, and state the radius of a gauge");
  const WholeModel whole = whole_of(sections, options);
  const auto spread = spreads(part.model, {}, options, [&](const Profiles& near) {
    const AxisLine axis = whole.axis_near(near.part_mm, options.datum);
    return std::vector<NamedValue>{{"", "l", "", axis.l}, {"", "m", "", axis.m}};
  });
  const AxisLine axis = whole.axis(options.datum);
  return {{axis.l, axis.m}, {spread[0].u, spread[1].u}};
}

/// A face about the axis of a datum. What was subtracted from the datum leans its axis.
void assess_face_about(const ProbeStream& face, const ProbeStream& datum,
                       std::span<const TakenOff> taken_off, FormResult& result) {
  const FormOptions& options = result.options;
  const Lean lean = lean_of(datum, options);
  std::vector<std::vector<std::vector<double>>> of_datum;
  of_datum.reserve(taken_off.size());
  std::vector<TakenOff> of_face;
  for (TakenOff one : taken_off) {
    if (one.of_datum) {
      auto& columns_mm = of_datum.emplace_back();
      for (std::size_t k = 0; k < one.columns_mm.size(); ++k) {
        ProbeStream moved = datum;
        moved.reading_mm = added(datum.reading_mm, one, k);
        const Part part = part_of(moved, options);
        const AxisLine axis = whole_of(part.model.sections, options).axis(options.datum);
        columns_mm.push_back(leaning(face, {axis.l - lean.slope[0], axis.m - lean.slope[1]}));
      }
      one.columns_mm = columns_mm;
    }
    of_face.push_back(one);
  }
  assess_face(face, lean, of_face, result);
}

/// One section against an axis: its run-out and concentricity.
std::vector<NamedValue> section_against(const AxisLine& datum, const SectionModel& section,
                                        std::span<const double> filtered_mm) {
  const auto [x0, y0] = datum.at(section.z_mm().value_or(0.0));
  const double x = section.x_mm() - x0, y = section.y_mm() - y0;
  const AxisOffset centre = section.centre(filtered_mm);
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < filtered_mm.size(); ++i) {
    const double c = std::cos(section.raw().at[i]), s = std::sin(section.raw().at[i]);
    const double r = section.radius_mm() + filtered_mm[i];
    const double distance =
        section.radius_known() ? std::hypot(x + r * c, y + r * s) : filtered_mm[i] + x * c + y * s;
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
  return {{"datum", "runout_circular", "", high - low},
          {"datum", "concentricity", "", 2.0 * std::hypot(centre.x_mm - x0, centre.y_mm - y0)}};
}

/// All values of a part, of whose datum there may be sections too.
class Assessment {
 public:
  Assessment(const std::vector<SectionModel>& part, const std::vector<SectionModel>& datum,
             const FormOptions& options)
      : part_(part), datum_(datum), options_(options) {
    const Criterion of_datum[] = {Criterion::gaussian, options.datum};
    if (part.size() > 1 && part.front().radius_known())
      whole_.emplace(part, criteria_of(options.all_references), options.all_references);
    if (datum.size() > 1) whole_datum_.emplace(datum, of_datum, options.all_references);
  }

  double taper() const { return whole_ ? whole_->taper() : 0.0; }

  std::vector<NamedValue> measured(const Profiles& profiles) const {
    std::vector<NamedValue> values;
    for (const SectionModel& section : part_) append(section.measured(), values);
    if (whole_) append(whole_->measured(), values);
    append(against(whole_datum_ ? whole_datum_->axis(options_.datum) : section_axis(profiles),
                   profiles),
           values);
    return values;
  }

  std::vector<NamedValue> near(const Profiles& profiles) const {
    std::vector<NamedValue> values;
    for (std::size_t s = 0; s < part_.size(); ++s)
      append(part_[s].near(profiles.part_mm[s]), values);
    if (whole_) append(whole_->near(profiles.part_mm), values);
    append(against(whole_datum_ ? whole_datum_->axis_near(profiles.datum_mm, options_.datum)
                                : section_axis(profiles),
                   profiles),
           values);
    return values;
  }

  /// The remarks about the cylinders.
  std::vector<std::string> notes() const {
    std::vector<std::string> out;
    const auto add = [&](std::string note, const char* of) {
      if (!note.empty()) out.push_back(of + std::move(note));
    };
    if (whole_datum_) add(whole_datum_->rocking(options_.datum), "Datum: ");
    for (const Criterion criterion :
         {Criterion::minimum_circumscribed, Criterion::maximum_inscribed})
      if (whole_ && options_.all_references) add(whole_->rocking(criterion), "");
    return out;
  }

 private:
  static void append(const std::vector<NamedValue>& more, std::vector<NamedValue>& values) {
    values.insert(values.end(), more.begin(), more.end());
  }
  std::vector<NamedValue> against(const AxisLine& datum, const Profiles& profiles) const {
    if (whole_) return whole_->against(datum, profiles.part_mm);
    if (part_.size() != 1) return {};
    return section_against(datum, part_.front(), profiles.part_mm.front());
  }
  /// Parallel to Z, of a datum that is one section; else the spindle's.
  AxisLine section_axis(const Profiles& profiles) const {
    if (datum_.empty()) return {};
    const SectionModel& section = datum_.front();
    const AssociatedCircle circle = associate_circle(
        section.raw().at, profiles.datum_mm.front(),
        section.radius_known() ? section.radius_mm() : 0.0, options_.datum, section.shares());
    return {section.x_mm() + circle.x_mm, section.y_mm() + circle.y_mm, 0.0, 0.0};
  }

  const std::vector<SectionModel>&part_, &datum_;
  const FormOptions& options_;
  std::optional<WholeModel> whole_, whole_datum_;
};

FormGroup& group_named(FormResult& result, const std::string& name) {
  for (FormGroup& group : result.groups)
    if (group.name == name) return group;
  return result.groups.emplace_back(FormGroup{name, {}});
}

/// In σ/√N: a bend of the axis that the readings of a surface do not show. Its coefficient of P₂
/// has u = σ √(10/N), and straightness 1.5 times that. The chain finds 3 u, thus 95 % of 4.65 u.
constexpr double unseen_bend = 4.65 * 1.5 * 3.17;

/// What may be there of a value although no draw of the surface has it, mm.
double unseen_mm(const FormResult& result, const NamedValue& value) {
  if (!value.name.starts_with("STR")) return 0.0;
  return unseen_bend * result.surface->noise_mm /
         std::sqrt(static_cast<double>(result.surface->readings));
}

/// A section by itself has the value that any other program gives it, with the bias by noise.
void hand_out(FormResult& result, const std::vector<NamedValue>& values,
              const std::vector<Spread>& spread) {
  const Bounded bounded(values, spread, result.options.coverage_factor);
  const std::size_t of_sections = std::ranges::count(values, "section", &NamedValue::group);
  const std::size_t each = result.sections.empty() ? 0 : of_sections / result.sections.size();
  for (std::size_t v = 0; v < values.size(); ++v) {
    const NamedValue& one = values[v];
    auto& list = one.group == "section" ? result.sections[v / each].values
                                        : group_named(result, one.group).values;
    list.push_back(result.surface ? bounded(one, spread[v], unseen_mm(result, one))
                                  : as_measured(one, spread[v]));
  }
}

/// A surface's draws contain what was subtracted from its readings; the rest is of sections.
std::vector<TakenOff> hand_to_surfaces(std::span<const TakenOff> taken_off, PartModel& part,
                                       PartModel& datum) {
  std::vector<TakenOff> out;
  for (const TakenOff& one : taken_off) {
    std::optional<SurfaceModel>& surface = one.of_datum ? datum.surface : part.surface;
    if (surface)
      surface->add_taken_off(one.columns_mm, one.correlation);
    else
      out.push_back(one);
  }
  return out;
}

Profiles measured_profiles(const std::vector<SectionModel>& part,
                           const std::vector<SectionModel>& datum) {
  Profiles out;
  for (const SectionModel& one : part) out.part_mm.push_back(one.profile_mm());
  for (const SectionModel& one : datum) out.datum_mm.push_back(one.profile_mm());
  return out;
}

}  // namespace
}  // namespace form

FormResult assess_form(const ProbeStream& stream, const FormOptions& given,
                       const ProbeStream* datum, std::span<const TakenOff> taken_off) {
  using namespace form;
  FormResult result;
  FormOptions& options = result.options = given;
  result.source = stream.source;
  result.input_hash = stream.input_hash;
  expect_options(options);
  expect_feature(stream, options.bore);
  if (!(options.ball_radius_mm > 0.0)) options.ball_radius_mm = stream.ball_radius_mm.value_or(0.0);
  if (!options.noise_mm) options.noise_mm = stream.sensor_noise_mm;
  if (datum) {
    result.datum_source = datum->source;
    if (datum->kind == StreamKind::face)
      throw InputError(datum->source, "is a face: give the readings of a shaft or a bore as datum");
  }
  if (stream.kind == StreamKind::face) {
    datum ? assess_face_about(stream, *datum, taken_off, result)
          : assess_face(stream, {}, taken_off, result);
    return result;
  }
  Part part = part_of(stream, options);
  Part of_datum;
  if (datum) {
    FormOptions other = options;
    ++other.seed;  // its draws are its own
    of_datum = part_of(*datum, other);
    if (!of_datum.sections.radius_known || !part.sections.radius_known)
      throw InputError(datum->source,
                       "part and datum need radii, which a relative gauge without nominal_radius "
                       "does not give: `# nominal_radius: R mm` in both streams");
  }
  const std::vector<TakenOff> of_sections = hand_to_surfaces(taken_off, part.model, of_datum.model);
  const std::vector<SectionModel>& sections = part.model.sections;
  const Assessment assessment(sections, of_datum.model.sections, options);
  const Profiles measured = measured_profiles(sections, of_datum.model.sections);
  const auto values = assessment.measured(measured);
  const auto near_with_centres = [&](const Profiles& profiles) {
    std::vector<NamedValue> all = assessment.near(profiles);
    for (std::size_t s = 0; s < sections.size(); ++s) {
      const AxisOffset centre = sections[s].centre(profiles.part_mm[s]);
      all.push_back({"section", eccentricity, "LSCI", std::hypot(centre.x_mm, centre.y_mm)});
    }
    return all;
  };
  const Assess near = [&](const Profiles& profiles) { return assessment.near(profiles); };
  auto spread = spreads(part.model, of_datum.model, options,
                        part.model.surface ? Assess(near_with_centres) : near);
  spread.resize(values.size() + sections.size());
  if (!of_sections.empty())
    add_taken_off(of_sections, near_with_centres(measured), spread,
                  [&](const TakenOff& one, std::size_t k) {
                    const bool other = datum && one.of_datum;
                    Profiles moved = measured;
                    ProbeStream readings = other ? *datum : stream;
                    readings.reading_mm = added(readings.reading_mm, one, k);
                    const Sections changed = sections_of(readings, options);
                    const auto& models = other ? of_datum.model.sections : sections;
                    auto& profiles = other ? moved.datum_mm : moved.part_mm;
                    for (std::size_t s = 0; s < models.size(); ++s)
                      profiles[s] = models[s].changed(changed.list[s]);
                    return near_with_centres(moved);
                  });
  const Unclosed unclosed(part.sections, options.high_upr);
  unclosed.add_to(spread, sections, measured.part_mm, [&](const auto& part_mm) {
    return near_with_centres({part_mm, measured.datum_mm});
  });
  const Unclosed datum_unclosed(of_datum.sections, options.high_upr);
  datum_unclosed.add_to(spread, of_datum.model.sections, measured.datum_mm,
                        [&](const auto& datum_mm) {
                          return near_with_centres({measured.part_mm, datum_mm});
                        });
  for (std::size_t s = 0; s < sections.size(); ++s) {
    result.sections.push_back(sections[s].form(assessment.taper()));
    const double u = spread[values.size() + s].u;
    for (FormValue& one : result.sections.back().values) {
      if (one.name == eccentricity)
        one.estimate.u = part.model.surface ? u : std::hypot(one.estimate.u, u);
      if (one.name == "radius")
        one.estimate.u = std::hypot(one.estimate.u, unclosed.u_of_radius(s));
    }
  }
  result.radius_known = part.sections.radius_known;
  if (part.model.surface) result.surface = part.model.surface->form();
  hand_out(result, values, spread);
  result.swallowed =
      part.model.surface ? part.model.surface->swallowed() : swallowed_lobes(sections, options);
  withhold_swallowed(result);
  unclosed.note_in(part.sections.notes, "");
  datum_unclosed.note_in(part.sections.notes, "Datum: ");
  add_notes(stream, part.sections, result);
  for (std::string& note : assessment.notes()) result.notes.push_back(std::move(note));
  return result;
}

int carried_upr(const ProbeStream& stream, const FormOptions& options) {
  using namespace form;
  const int together = upr_of_surface(stream, options).by_gaps_too;
  int carried = 500;
  for (const SectionReadings& one : sections_of(stream, options).list) {
    const SectionTrace section(one, true, options.high_upr);
    carried = std::min(carried, section.trouble().empty() ? highest_order(section.trace()) : 0);
  }
  return std::max(carried, together);
}

}  // namespace trueaxis
