// SPDX-License-Identifier: Apache-2.0
#include "machine/files/errors_files.hpp"

namespace trueaxis {

std::string error_name_trouble(const std::string& text, const Machine& machine) {
  const auto name = parse_error_name(text);
  if (!name)
    return "is \"" + text +
           "\", which is not an error: component errors are EXX … ECC, location errors X0X … C0C, "
           "those of the spindle X0S … C0S, of the workpiece X0W … C0W";
  if (name->body < axis_count && machine.find(static_cast<AxisName>(name->body)) == nullptr)
    return "is \"" + text + "\", of an axis this machine does not have";
  return "";
}

}  // namespace trueaxis
