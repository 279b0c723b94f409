// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/machine.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "machine/algebra.hpp"

namespace trueaxis {

Matrix3 rotation_zyx(const Vector3& angles_rad) {
  using Eigen::Vector3d;
  return rigid::rows(Eigen::Matrix3d(rigid::turn(Vector3d::UnitZ(), angles_rad[2]) *
                                     rigid::turn(Vector3d::UnitY(), angles_rad[1]) *
                                     rigid::turn(Vector3d::UnitX(), angles_rad[0])));
}

const MachineAxis* Machine::find(AxisName axis) const {
  const auto found = std::ranges::find(axes, axis, &MachineAxis::name);
  return found == axes.end() ? nullptr : &*found;
}

std::size_t Machine::rotary_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(axes, is_rotary, &MachineAxis::name));
}

std::size_t Machine::linear_count() const { return axes.size() - rotary_count(); }

Setting first_setting(const Machine& machine) {
  Setting setting;
  if (machine.work_offsets.front())
    setting.bed_from_program = machine.work_offsets.front()->bed_from_program;
  setting.tool_length_mm = machine.tool.length_mm;
  return setting;
}

namespace {

/// The unit quaternion of actual · nominalᵀ, with w ≥ 0.
Eigen::Quaterniond difference(const ToolPose& actual, const ToolPose& nominal) {
  Eigen::Quaterniond q(
      Eigen::Matrix3d(rigid::eigen(actual.rotation) * rigid::eigen(nominal.rotation).transpose()));
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

}  // namespace

ToolDisplacement displacement(const ToolPose& actual, const ToolPose& nominal) {
  const Eigen::Quaterniond q = difference(actual, nominal);
  const double sine = q.vec().norm();
  const double factor = sine > 0.0 ? 2.0 * std::atan2(sine, q.w()) / sine : 2.0;
  ToolDisplacement out;
  out.tip_mm =
      rigid::array(Eigen::Vector3d(rigid::eigen(actual.tip_mm) - rigid::eigen(nominal.tip_mm)));
  out.rotation_rad = rigid::array(Eigen::Vector3d(factor * q.vec()));
  return out;
}

double angle_between_rad(const Vector3& a, const Vector3& b) {
  const Eigen::Vector3d u = rigid::eigen(a), v = rigid::eigen(b);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

double about_tool_axis_rad(const ToolPose& actual, const ToolPose& nominal) {
  const Eigen::Quaterniond q = difference(actual, nominal);
  return 2.0 * std::atan2(q.vec().dot(rigid::eigen(nominal.direction)), q.w());
}

namespace {

/// A letter of a chain; the typographic primes of documents (U+2019, U+2032) count as '.
struct Link {
  char letter = 0;
  bool prime = false;
  std::size_t at = 0;
};

std::size_t prime_at(std::string_view text, std::size_t at) {
  for (const std::string_view prime : {"'", "\u2019", "\u2032"})
    if (text.substr(at).starts_with(prime)) return prime.size();
  return 0;
}

std::vector<Link> links_of(std::string_view text, std::vector<ChainTrouble>& troubles) {
  std::vector<Link> links;
  for (std::size_t at = 0; at < text.size();) {
    if (std::strchr(" \t[]", text[at]) != nullptr) {
      ++at;
    } else if (text[at] == '(') {
      const std::size_t end = text.find(')', at);
      if (end == std::string_view::npos)
        troubles.push_back({at, "has a ( that is not closed: write a spindle as (C1)"});
      at = end == std::string_view::npos ? text.size() : end + 1;
    } else if (const std::size_t prime = prime_at(text, at)) {
      if (links.empty() || links.back().prime)
        troubles.push_back({at, "has a prime that follows no axis"});
      else
        links.back().prime = true;
      at += prime;
    } else {
      links.push_back({text[at], false, at});
      ++at;
      while (at < text.size() && (text[at] & 0xC0) == 0x80) ++at;  // the rest of a UTF-8 character
    }
  }
  return links;
}

Vector3 direction_of(AxisName axis) {
  Vector3 direction{};
  direction[index_of(axis) % 3] = 1.0;
  return direction;
}

std::string quoted(const Link& link) {
  return std::string(1, link.letter) + (link.prime ? "'" : "");
}

/// `letter` once, without a prime, at the place where it belongs.
void check_end(const std::vector<Link>& links, char letter, bool first,
               std::vector<ChainTrouble>& troubles) {
  const auto count = std::ranges::count(links, letter, &Link::letter);
  const std::string what = letter == 'w' ? "the workpiece `w`" : "the tool `t`";
  if (count == 0) {
    troubles.push_back(
        {0, "does not have " + what + (first ? ": begin with it" : ": end with it")});
  } else if (count > 1 || (first ? links.front() : links.back()).letter != letter) {
    const auto last = std::ranges::find(links.rbegin(), links.rend(), letter, &Link::letter);
    troubles.push_back({last->at, "must have " + what + " once, as its " +
                                      (first ? "first letter" : "last letter")});
  }
}

}  // namespace

std::vector<MachineAxis> parse_chain(std::string_view chain, std::vector<ChainTrouble>& troubles) {
  const std::vector<Link> links = links_of(chain, troubles);
  check_end(links, 'w', true, troubles);
  check_end(links, 't', false, troubles);
  const auto bed = std::ranges::find(links, 'b', &Link::letter);
  if (bed == links.end()) troubles.push_back({0, "does not have the bed `b` between w and t"});
  std::vector<MachineAxis> axes;
  bool beyond_bed = false, bed_met = false;
  for (const Link& link : links) {
    if (std::strchr("wtb", link.letter) != nullptr) {
      if (link.prime) troubles.push_back({link.at, "has `" + quoted(link) + "`: no prime there"});
      if (link.letter != 'b') continue;
      if (bed_met) troubles.push_back({link.at, "has two beds `b`: one only"});
      bed_met = beyond_bed = true;
      continue;
    }
    const std::size_t number = std::string_view("XYZABC").find(link.letter);
    if (number == std::string_view::npos) {
      troubles.push_back(
          {link.at, "has `" + quoted(link) + "`: the axes are X Y Z A B C, the ends w b t"});
      continue;
    }
    const auto name = static_cast<AxisName>(number);
    if (std::ranges::find(axes, name, &MachineAxis::name) != axes.end())
      troubles.push_back({link.at, "has the axis " + std::string(1, link.letter) + " twice"});
    if (bed != links.end() && link.prime == beyond_bed)
      troubles.push_back(
          {link.at, "has `" + quoted(link) +
                        (link.prime ? "` after the bed: an axis of the tool does not have a prime"
                                    : "` before the bed: an axis of the workpiece has a prime '")});
    axes.push_back(
        {.name = name, .carries_workpiece = !beyond_bed, .direction = direction_of(name)});
  }
  if (axes.size() < 3)
    troubles.push_back({0, "has " + std::to_string(axes.size()) + " axes: three to six"});
  return axes;
}

}  // namespace trueaxis
