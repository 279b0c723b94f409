// SPDX-License-Identifier: Apache-2.0
#include "compensate/files/compensation_files.hpp"
#include "format/json.hpp"
#include "format/reason_words.hpp"

namespace trueaxis {
namespace {

Json largest_json(const LargestInProgram& largest, bool angle) {
  return at_line(angle ? deg_json(largest.value) : mm_json(largest.value), largest.line);
}

Json tool_json(const LargestToolError& largest) {
  return {{"position", largest_json(largest.position, false)},
          {"direction", largest_json(largest.direction, true)}};
}

Json axes_json(const std::array<LargestInProgram, axis_count>& axes) {
  Json json = Json::object();
  for (std::size_t k = 0; k < axis_count; ++k)
    if (axes[k].line != 0)
      json[std::string(1, "XYZABC"[k])] =
          largest_json(axes[k], is_rotary(static_cast<AxisName>(k)));
  return json;
}

Json singular_json(const SingularBlock& one) {
  return {{"line", one.line}, {"direction_left", deg_json(one.direction_left_rad)}};
}

Json unreachable_json(const UnreachableBlock& one) {
  return {{"line", one.line}, {"why", one.why}};
}

Json by_error_json(const ErrorAlone& one) {
  return at_line({{"name", one.name}, {"tip", mm_json(one.tip.value)}}, one.tip.line);
}

}  // namespace

std::string compensation_json(const ProgramCompensation& result, const CompensationOptions& options,
                              const std::vector<CompensationInput>& inputs,
                              const std::vector<std::string>& remarks) {
  Json json{{"schema", "trueaxis.compensation/1"},
            {"version", TRUEAXIS_VERSION},
            {"inputs", files_json(inputs)},
            {"method", options.method == CompensationMethod::exact ? "exact" : "differential"},
            {"rotary", options.rotary == RotaryUse::moved ? "moved" : "all"},
            {"decimals", options.decimals},
            {"angle_decimals", options.angle_decimals},
            {"blocks",
             {{"read", result.blocks_read},
              {"moved", result.blocks_moved},
              {"rewritten", result.blocks_rewritten},
              {"inserted", result.blocks_inserted}}}};
  if (options.tolerance_mm) json["tolerance"] = with_unit(*options.tolerance_mm, "mm");
  if (options.arc_tolerance_mm) json["arc_tolerance"] = with_unit(*options.arc_tolerance_mm, "mm");
  json["largest_change"] = axes_json(result.largest_change);
  json["error_before"] = tool_json(result.before);
  json["error_after"] = tool_json(result.after);
  json["whole_path"] = {{"before", largest_json(result.off_before(), false)},
                        {"after", largest_json(result.off_after(), false)}};
  json["between_blocks"] = {{"before", largest_json(result.between_before, false)},
                            {"after", largest_json(result.between_after, false)}};
  json["about_tool_axis"] = largest_json(result.about_tool_axis, true);
  json["worse"] = result.worse;
  json["comes_out_worse"] = result.comes_out_worse();
  json["singular"] = list_of(result.singular, singular_json);
  json["unreachable"] = list_of(result.unreachable, unreachable_json);
  json["exact_minus_differential"] = axes_json(result.exact_minus_differential);
  json["rounding"] = tool_json(result.rounding);
  json["by_error"] = list_of(result.by_error, by_error_json);
  json["reserved"] = reasons_array(result.reservations, Spoken{});
  json["remarks"] = remarks;
  if (result.u_tip) {
    LargestInProgram expanded = *result.u_tip;
    expanded.value *= options.coverage_factor;
    json["U"] = largest_json(expanded, false);
    json["U"]["coverage_factor"] = options.coverage_factor;
  }
  return json_text(json);
}

}  // namespace trueaxis
