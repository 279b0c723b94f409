// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "base/counted.hpp"
#include "fit/associate.hpp"
#include "fit/describe.hpp"
#include "fit/plausible.hpp"
#include "fit/uncertainty.hpp"
#include "measure/feature.hpp"
#include "surface/own_surface.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// What the caller says of the ball, or the stream; the two must not contradict each other.
double ball_radius(const ProbeStream& stream, const FitOptions& options) {
  const double said = stream.ball_radius_mm.value_or(0.0);
  if (said > 0.0 && options.ball_radius_mm > 0.0 && said != options.ball_radius_mm) {
    throw InputError(stream.source, "the stream gives ball_radius " + std::to_string(said) +
                                        " mm, the job or command " +
                                        std::to_string(options.ball_radius_mm) + " mm: keep one");
  }
  return std::max(said, options.ball_radius_mm);
}

void expect_kind(const ProbeStream& stream, const SurfaceInfo& info) {
  if (stream.kind != info.stream) {
    throw InputError(stream.source,
                     info.stream == StreamKind::face
                         ? "a plane is fitted to a face stream: columns Z_M,C,X"
                         : "the stream probes a face (Z_M,C,X): fit it with --surface plane");
  }
  if (info.needs_position && !stream.has_position()) {
    throw InputError(stream.source, info.stream == StreamKind::face
                                        ? "the stream has no X: a face is probed at (C, X)"
                                        : "the stream has no Z: fit one section with --surface "
                                          "section");
  }
}

/// What the frames of all set-ups have in common.
SurfaceFrame frame_of(const ProbeStream& stream, const FitOptions& options) {
  SurfaceFrame frame;
  frame.indication = stream.indication;
  const double ball_mm = ball_radius(stream, options);
  frame.ball_mm = options.bore ? -ball_mm : ball_mm;
  if (stream.indication == Indication::relative && stream.kind == StreamKind::lateral) {
    if (!stream.nominal_radius_mm) {
      throw InputError(stream.source,
                       "a relative gauge does not show the radius: state it, such as '# "
                       "nominal_radius: 14.5 mm'");
    }
    frame.nominal_radius_mm = *stream.nominal_radius_mm;
  }
  return frame;
}

std::string in_clampings(std::size_t clampings) {
  return clampings == 1 ? "" : " that was clamped " + std::to_string(clampings) + " times";
}

void validate(const FitOptions& options) {
  expects(options.coverage_factor > 0.0, "a coverage factor k > 0");
  expects(options.max_iterations > 0, "max_iterations > 0");
  expects(options.ball_radius_mm >= 0.0, "a ball radius of 0 mm or more");
  expects(!options.noise_mm || *options.noise_mm >= 0.0, "a noise of 0 mm or more");
}

FitResult empty_result(const ProbeStream& stream, const FitOptions& options,
                       const std::array<double, 2>& range_mm) {
  FitResult result;
  result.surface = options.profile ? SurfaceKind::own : options.surface;
  result.loss = options.loss;
  result.bore = options.bore;
  result.coverage_factor = options.coverage_factor;
  result.points = stream.size();
  result.input_hash = stream.input_hash;
  result.x_convention = stream.x_convention;
  result.source = stream.source;
  result.position_min_mm = range_mm[0];
  result.position_max_mm = range_mm[1];
  return result;
}

CatalogueEntry surface_entry(const FitOptions& options) {
  return options.profile ? own_entry(options.profile) : catalogue_entry(options.surface);
}

/// What may be fitted at all: @throws InputError if not.
void expect_fittable(const ProbeStream& stream, const FitOptions& options) {
  validate(options);
  expects(stream.size() > 0, "readings");
  if (!stream.sensor_angles_rad.empty())
    throw InputError(stream.source, "several sensors of one recording: use separate_spindle");
  expect_kind(stream, surface_entry(options).info);
  expect_feature(stream, options.bore);
  const bool ball = stream.ball_radius_mm.value_or(0.0) > 0.0 || options.ball_radius_mm > 0.0;
  if (!options.profile && !is_diagnosed(options.surface)) {
    if (stream.indication == Indication::relative)
      throw InputError(
          stream.source,
          fmt::format("a {} needs positions, not a gauge's deviations: give X_M itself",
                      to_string(options.surface)));
    if (list_set_ups(stream).size() > 1)
      throw InputError(stream.source, fmt::format("a {} needs one set-up: write a stream for each",
                                                  to_string(options.surface)));
  }
  if (options.profile && (ball || stream.indication == Indication::relative)) {
    throw InputError(stream.source,
                     "a profile of one's own is fitted to absolute readings of contact points");
  }
}

FitResult fit_model(const ProbeStream& stream, const std::vector<PlacedSetUp>& set_ups,
                    const JointModel& model, const FitOptions& options) {
  FitResult result = empty_result(stream, options, model.last_range_mm());
  result.input_notes = notes_on_input(stream, model.info());
  if (stream.size() < model.parameter_count()) {
    result.message = counted(stream.size(), "reading is", "readings are") + " fewer than the " +
                     std::to_string(model.parameter_count()) + " parameters of a " +
                     model.info().id + in_clampings(model.clampings());
    return result;
  }
  FitOptions known = options;
  if (!known.noise_mm) known.noise_mm = stream.sensor_noise_mm;

  Association association = associate(model, options.loss, options.max_iterations);
  result.iterations = association.minimum.iterations;
  if (!association.minimum.normal.valid) {
    result.status = FitStatus::max_iterations;
    result.message = "no surface of this kind meets all probe lines: is the stream a " +
                     std::string(model.info().id) + "?";
    return result;
  }
  const ReadingNoise noise = estimate_noise(model, association, known);
  result.status = association.minimum.converged ? FitStatus::converged : FitStatus::max_iterations;
  if (!association.minimum.converged) {
    result.message = "not converged after " + std::to_string(result.iterations) +
                     " passes: raise max_iterations";
  }
  describe(model, set_ups, association, noise, known, result);
  if (options.loss != Loss::plain) return result;
  if (const std::string gross = gross_readings(stream); !gross.empty()) {
    if (result.status == FitStatus::converged)
      result.input_notes.push_back(gross);
    else
      result.message = gross;
  }
  return result;
}

FitResult fit_as_read(const ProbeStream& stream, const FitOptions& options) {
  expect_fittable(stream, options);
  const std::vector<PlacedSetUp> set_ups = place_set_ups(stream);
  const JointModel model(stream, set_ups, surface_entry(options), frame_of(stream, options));
  return fit_model(stream, set_ups, model, options);
}

}  // namespace

FitResult fit(const ProbeStream& stream, const FitOptions& options) {
  FitResult result = fit_as_read(stream, options);
  const Refit refit = [&](const ProbeStream& other, SurfaceKind surface) {
    FitOptions as_other = options;
    as_other.surface = surface;
    try {
      return fit_as_read(other, as_other);
    } catch (const InputError&) {  // read so, it is not a stream of this surface at all
      return FitResult{};
    }
  };
  std::string why = implausible(stream, result, refit);
  if (why.empty() && result.status == FitStatus::converged) why = impossible_radius(result, true);
  if (!why.empty()) refuse(result, why);
  return result;
}

struct RepeatedFit::Impl {
  ProbeStream stream;
  FitOptions options;
  std::vector<PlacedSetUp> set_ups;
  std::unique_ptr<JointModel> model;
};

RepeatedFit::RepeatedFit(ProbeStream stream, FitOptions options)
    : impl_(std::make_unique<Impl>(Impl{std::move(stream), std::move(options), {}, {}})) {
  expect_fittable(impl_->stream, impl_->options);
}

RepeatedFit::~RepeatedFit() = default;
RepeatedFit::RepeatedFit(RepeatedFit&&) noexcept = default;
RepeatedFit& RepeatedFit::operator=(RepeatedFit&&) noexcept = default;

// The sign of the readings may tell the side they were taken from, so the set-ups are placed anew.
FitResult RepeatedFit::operator()(std::span<const double> reading_mm) {
  Impl& of = *impl_;
  expects(reading_mm.size() == of.stream.size(), "a reading for every C");
  std::copy(reading_mm.begin(), reading_mm.end(), of.stream.reading_mm.begin());
  std::vector<PlacedSetUp> set_ups = place_set_ups(of.stream);
  if (of.model && set_ups == of.set_ups) {
    of.model->reload_readings(of.stream);
  } else {
    of.set_ups = std::move(set_ups);
    of.model = std::make_unique<JointModel>(of.stream, of.set_ups, surface_entry(of.options),
                                            frame_of(of.stream, of.options));
  }
  return fit_model(of.stream, of.set_ups, *of.model, of.options);
}

const Estimate& find_parameter(std::span<const FitParameter> parameters, std::string_view name) {
  const auto found = std::ranges::find(parameters, name, &FitParameter::name);
  expects(found != parameters.end(), "a parameter that there is");
  return found->estimate;
}

const Estimate& FitResult::parameter(std::string_view name) const {
  const bool is_derived = std::ranges::find(derived, name, &FitParameter::name) != derived.end();
  return find_parameter(is_derived ? derived : parameters, name);
}

bool FitResult::axis_known() const {
  return status == FitStatus::converged &&
         std::ranges::none_of(parameters, [](const FitParameter& one) {
           const bool of_axis =
               one.name == "x0" || one.name == "y0" || one.name == "l" || one.name == "m";
           return of_axis && !one.estimate.determined();
         });
}

const char* to_string(FitStatus status) {
  static constexpr const char* words[] = {"converged", "max_iterations", "rank_deficient",
                                          "too_few", "implausible"};
  return words[static_cast<std::size_t>(status)];
}

const char* to_string(SigmaSource source) {
  static constexpr const char* words[] = {"", "residuals", "robust residuals",
                                          "residuals, whitened", "sensor"};
  return words[static_cast<std::size_t>(source)];
}

const char* to_string(Loss loss) {
  return loss == Loss::plain ? "plain" : loss == Loss::huber ? "huber" : "tukey";
}

}  // namespace trueaxis
