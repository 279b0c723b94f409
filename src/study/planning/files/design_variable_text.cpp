// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/nearest_key.hpp"
#include "format/units.hpp"
#include "study/planning/files/planning_files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

double number_of(std::string_view text, std::string_view whole) {
  std::string_view left = text;
  const auto value = take_number<double>(left);
  if (!value || !left.empty())
    throw InputError(std::string(whole), "\"" + std::string(text) + "\" is not a number");
  return *value;
}

void check_range(double low, double high, std::string_view whole) {
  const auto refuse = [&](const char* why) { throw InputError(std::string(whole), why); };
  if (!std::isfinite(low) || !std::isfinite(high)) refuse("LOW and HIGH must be finite numbers");
  if (!(low > 0.0)) refuse("LOW must be more than 0");
  if (!(low <= high)) refuse("LOW is more than HIGH: exchange them");
}

}  // namespace

study::DesignVariable parse_design_variable(std::string_view text) {
  const std::size_t equals = text.find('='), colon = text.find(':');
  if (equals == std::string_view::npos || colon == std::string_view::npos || colon < equals)
    throw InputError(std::string(text), "is not KEY=LOW:HIGH");
  const std::string_view key = text.substr(0, equals);
  std::string known;
  std::vector<std::string> names;
  for (const study::Choice choice : study::choices) {
    for (const KeySpelling& spelling : key_spellings(study::info_of(choice).path)) {
      const std::string_view whole = spelling.key, shorter = whole.substr(whole.find('.') + 1);
      if (key == whole || key == shorter) {
        const double low = number_of(text.substr(equals + 1, colon - equals - 1), text),
                     high = number_of(text.substr(colon + 1), text);
        check_range(low, high, text);
        return {choice, low * spelling.factor, high * spelling.factor};
      }
      names.emplace_back(shorter);
      if (spelling.key == key_spellings(study::info_of(choice).path).front().key)
        add_to_list(known, shorter);
    }
  }
  const std::string near = nearest_key(std::string(key), names);
  throw InputError(std::string(text), "\"" + std::string(key) + "\" cannot be chosen" +
                                          (near.empty() ? "." : ", did you mean " + near + "?") +
                                          " Choose from: " + known);
}

}  // namespace trueaxis
