// SPDX-License-Identifier: Apache-2.0
#include "format/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis::layout {

std::size_t width(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  return count;
}

std::string padded(std::string_view text, std::size_t to) {
  std::string out(text);
  const std::size_t has = width(text);
  if (has < to) out.append(to - has, ' ');
  return out;
}

std::string wrapped(const std::string& head, std::string_view text, std::size_t to) {
  const std::size_t indent = width(head);
  std::string out = head;
  std::size_t at = indent;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    const std::size_t needs = width(word);
    if (at > indent && at + 1 + needs > to) {
      out += '\n' + std::string(indent, ' ');
      at = indent;
    }
    if (at > indent) {
      out += ' ';
      ++at;
    }
    out += word;
    at += needs;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out + '\n';
}

std::string um(double length_mm) {
  if (!std::isfinite(length_mm)) return "not determined";
  if (std::abs(length_mm) >= 0.9995) return fmt::format("{:.3g} mm", length_mm);
  if (std::abs(length_mm) < 1e-9) return "0 µm";  // rounding
  return fmt::format("{:.3g} µm", length_mm / mm_per_um);
}

std::string bound(double value, bool up) {
  const int decimals = decimals_of(value, 0);
  const double digits = value * std::pow(10.0, decimals), rounding = 1e-9 * std::abs(digits);
  const double whole = up ? std::ceil(digits - rounding) : std::floor(digits + rounding);
  return fmt::format("{:.{}f}", whole * std::pow(10.0, -decimals), decimals);
}

std::string plus_minus(const Estimate& estimate, double coverage_factor, double scale,
                       const std::string& unit) {
  const std::string behind = unit.empty() || unit == "1" ? "" : " " + unit;
  if (!estimate.determined() && estimate.interval)
    return "at most " + bound(scale * estimate.interval->back()) + behind;
  if (!estimate.determined())
    return estimate.why_not.empty() ? "not determined" : "not determined: " + estimate.why_not;
  const double U = scale * coverage_factor * estimate.u;
  if (!std::isfinite(U)) {
    const std::string why = estimate.why_not.empty() ? "" : " (" + estimate.why_not + ")";
    return fmt::format("{:.4g}", scale * estimate.value) + behind + why;
  }
  const int decimals = decimals_of(U, 0);
  const double value = scale * estimate.value;
  const bool zero = std::abs(value) * std::pow(10.0, decimals) <= 0.5;  // without a sign
  return fmt::format("{0:.{2}f} ± {1:.{2}f}{3}", zero ? 0.0 : value, U, decimals, behind);
}

std::string probability(double value) {
  if (!std::isfinite(value)) return "not determined";
  if (value < 0.001) return "< 0.001";
  if (value > 0.999 && value < 1.0) return "> 0.999";
  return fmt::format("{:.2g}", value);
}

std::string below(double value, const std::string& unit) {
  return fmt::format("below {} {} (95 % confidence)", bound(value), unit);
}

std::string size_plus_minus(const Estimate& estimate, double coverage_factor, double scale,
                            const std::string& unit) {
  const double within = bound_factor(coverage_factor) * estimate.u;
  if (!estimate.determined() || !std::isfinite(within) || estimate.value > within)
    return plus_minus(estimate, coverage_factor, scale, unit);
  return below(scale * (estimate.value + within), unit);
}

}  // namespace trueaxis::layout
