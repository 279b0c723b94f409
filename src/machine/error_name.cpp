// SPDX-License-Identifier: Apache-2.0
#include "machine/error_name.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view directions = "XYZABC", bodies = "XYZABCSW";

}  // namespace

std::string to_string(const ErrorName& name) {
  const char direction = directions[name.direction], body = bodies[name.body];
  return name.component ? std::string{'E', direction, body} : std::string{direction, '0', body};
}

std::string words_of(const ErrorName& name) {
  const char direction = directions[name.direction], body = bodies[name.body];
  const std::string of = body == 'S'   ? "the spindle"
                         : body == 'W' ? "the workpiece"
                                       : std::string("axis ") + body;
  const bool own = direction == body;
  const std::string where =
      std::string(name.angular() ? "about " : "along ") + "XYZ"[name.direction % 3];
  if (name.component) return own ? "position of " + of : where + ", as " + body + " moves";
  if (own) return "zero of " + of;
  return (name.angular() ? "direction of " : "place of ") + of + ' ' + where;
}

std::optional<ErrorName> parse_error_name(std::string_view text) {
  if (text.size() != 3) return std::nullopt;
  const bool component = text[0] == 'E';
  if (!component && text[1] != '0') return std::nullopt;
  const std::size_t direction = directions.find(component ? text[1] : text[0]);
  const std::size_t body = bodies.find(text[2]);
  if (direction == std::string_view::npos || body == std::string_view::npos) return std::nullopt;
  if (component && body >= axis_count) return std::nullopt;
  return ErrorName{component, direction, body};
}

bool without_effect(const ErrorName& name) {
  if (name.component || name.body >= 3) return false;
  return name.angular() ? name.direction - 3 == name.body : name.direction != name.body;
}

}  // namespace trueaxis
