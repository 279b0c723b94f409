// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "form/files/form_files.hpp"
#include "format/file.hpp"
#include "format/json.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr double same_direction_deg = 1e-6;

std::vector<SpindleOrder> motion_from(const Json& json, const std::string& path) {
  if (json.value("schema", "").rfind("trueaxis.spindle/", 0) != 0)
    throw InputError(path, "is not a result of `trueaxis spindle --json`");
  if (!json.contains("radial"))
    throw InputError(path, "has no radial error motion: form needs that of radial sensors");
  const Json& radial = json.at("radial");
  const double direction = number_from(radial.at("sensitive_direction").at("value"));
  if (std::abs(std::remainder(direction, 360.0)) > same_direction_deg)
    throw InputError(path, "states the motion along " + std::to_string(direction) +
                               " deg, and the probe is along X: `trueaxis spindle "
                               "--sensitive-deg 0` states it there");
  std::vector<SpindleOrder> orders;
  for (const Json& one : radial.at("orders")) {
    const Json& motion = one.at("sensitive");
    const SpindleOrder order{one.at("order"), number_from(motion.at("cos")),
                             number_from(motion.at("sin")), number_from(motion.at("u"))};
    if (std::isfinite(order.cos_mm) && std::isfinite(order.sin_mm) && std::isfinite(order.u_mm))
      orders.push_back(order);
  }
  return orders;
}

}  // namespace

std::vector<SpindleOrder> read_spindle_motion(const std::string& path) {
  try {
    return motion_from(Json::parse(read_file(path)), path);
  } catch (const Json::exception& error) {
    throw InputError(path, std::string("cannot be read as a result of `trueaxis spindle` (") +
                               error.what() + ")");
  }
}

}  // namespace trueaxis
