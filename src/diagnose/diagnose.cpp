// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <thread>

#include "diagnose/noise.hpp"
#include "diagnose/search.hpp"
#include "trueaxis/diagnose/diagnosis.hpp"

namespace trueaxis {

using namespace diagnose_detail;

Diagnosis diagnose(const ProbeStream& stream, const DiagnoseOptions& options) {
  Diagnosis diagnosis;
  diagnosis.baseline = fit(stream, options.fit);
  diagnosis.extended = diagnosis.baseline;
  Clamping clamping;
  clamping.shape = diagnosis.baseline.shape;
  BaseKind base;
  base.tilts = options.fit.surface != "section";
  base.tapers = options.fit.surface == "cone";
  base.offset = stream.indication == Indication::relative;
  const Scene scene = make_scene(stream, {clamping}, base, options.fit.bore);
  Rows rows = make_rows(scene);
  const Resolution resolution = resolution_of(scene, rows);
  const auto masked = mask_outliers(scene, resolution, diagnosis.baseline.residual_mm, rows);
  const Problem problem{scene, rows, resolution, diagnosis.baseline.residual_mm, options.false_alarm,
                        1, 8};
  const Model model = search(problem);
  std::fprintf(stderr, "masked %zu phi %zu %g terms %zu tests %g bw %g thr %g\n", masked.size(),
               model.phi.size(), model.phi.empty() ? 0.0 : model.phi[0], model.terms.size(),
               model.family.single, model.family.bandwidth, model.family.threshold(0.01));
  for (std::size_t i = 0; i < model.terms.size(); ++i) {
    const Hypothesis& h = model.terms[i];
    std::fprintf(stderr, "  %s order %g keep %zu per %g f %g p %g\n", h.id().c_str(),
                 h.effect ? h.shape.order : h.pattern.order, h.keep.size(), h.shape.period_mm,
                 h.pattern.frequency, model.p_values[i]);
  }
  return diagnosis;
}

const char* to_string(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::ideal:
      return "ideal";
    case DiagnosisVerdict::effects:
      return "effects";
    case DiagnosisVerdict::unexplained:
      return "unexplained";
  }
  return "";
}

}  // namespace trueaxis
