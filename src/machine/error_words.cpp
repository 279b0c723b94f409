// SPDX-License-Identifier: Apache-2.0
#include "machine/error_words.hpp"

namespace trueaxis {

std::string in_words(const ErrorName& name) {
  constexpr const char* directions[] = {"along X", "along Y", "along Z",
                                        "about X", "about Y", "about Z"};
  const std::string letter(1, "XYZABCSW"[name.body]), direction = directions[name.direction];
  const std::string of = name.body == spindle_body     ? "the spindle"
                         : name.body == workpiece_body ? "the workpiece"
                                                       : "axis " + letter;
  const bool own = name.direction == name.body;
  if (name.component) return own ? "position of " + of : direction + ", as " + letter + " moves";
  if (own) return "zero of " + of;
  return (name.angular() ? "direction of " : "place of ") + of + ' ' + direction;
}

}  // namespace trueaxis
