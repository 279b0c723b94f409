// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/diagnosis_objects.hpp"
#include "diagnose/files/diagnosis_text.hpp"

namespace trueaxis {

Json diagnosis_summary(const Diagnosis& d) {
  Json findings = Json::array(), unexplained = Json::array();
  for (const Finding& finding : d.findings) findings.push_back(finding_summary(finding));
  for (const Unexplained& u : d.unexplained) {
    unexplained.push_back({{"harmonic", u.harmonic},
                           {"dependence", u.dependence},
                           {"amplitude", estimate_object(u.amplitude)}});
  }
  return {{"schema", "trueaxis.diagnosis/1"}, {"verdict", to_string(d.verdict)},
          {"line", diagnosis_line(d)},        {"findings", findings},
          {"unexplained", unexplained},       {"axis_shift", estimate_object(d.gain.axis_shift)},
          {"next_measurement", d.next.plan}};
}

}  // namespace trueaxis
