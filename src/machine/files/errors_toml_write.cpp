// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "machine/files/error_sizes.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/machine_identity.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

using fmt::format;

/// Units of an entry as people read them, and the factors to them from inside.
struct Units {
  explicit Units(const ErrorName& name)
      : value(name.angular() ? "urad" : "um"), per_value(name.angular() ? 1e6 : 1e3) {
    if (name.body >= 3 && name.body < axis_count) {
      position = "deg";
      per_position = 1.0 / rad_per_deg;
    }
  }
  const char* value;
  double per_value;
  const char* position = "mm";
  double per_position = 1.0;

  std::string list(std::vector<double> numbers, double factor) const {
    for (double& one : numbers) one *= factor;
    return format("[{}]", fmt::join(numbers, ", "));
  }
};

std::string lines(const ConstantError& error, const Units& units) {
  return format("value_{} = {}\n", units.value, error.value * units.per_value);
}

std::string lines(const PolynomialError& error, const Units& units) {
  return format("kind = \"polynomial\"\ncoefficients_{} = {}\norigin_{} = {}\nscale_{} = {}\n",
                units.value, units.list(error.coefficients, units.per_value), units.position,
                error.origin * units.per_position, units.position,
                error.scale * units.per_position);
}

std::string lines(const FourierError& error, const Units& units) {
  std::string terms;
  for (const auto& [order, cosine, sine] : error.terms)
    terms += format("{}[{}, {}, {}]", terms.empty() ? "" : ", ", order, cosine * units.per_value,
                    sine * units.per_value);
  return format("kind = \"fourier\"\nterms_{} = [{}]\nperiod_{} = {}\n", units.value, terms,
                units.position, error.period * units.per_position);
}

std::string lines(const TableError& error, const Units& units) {
  return format("kind = \"table\"\nat_{} = {}\nvalues_{} = {}\n{}", units.position,
                units.list(error.at, units.per_position), units.value,
                units.list(error.values, units.per_value),
                error.periodic ? "periodic = true\n" : "");
}

/// u of an entry: its own, or in the last entry of its name that of the covariance.
double u_of(const ErrorModel& errors, std::size_t entry) {
  const ErrorName& name = errors.terms[entry].name;
  const auto at = errors.covariance.find(UncertainAmount{.name = name});
  if (!at) return errors.terms[entry].u;
  for (std::size_t later = entry + 1; later < errors.terms.size(); ++later)
    if (errors.terms[later].name == name) return 0.0;
  return errors.covariance.u(*at);
}

}  // namespace

std::string errors_toml(const ErrorModel& errors, const Machine* of) {
  std::string text =
      format("# schema: trueaxis.errors/1\nschema = \"trueaxis.errors/1\"\nsign = \"{}\"\n",
             errors.sign == ErrorSign::moving_part ? "moving_part" : "tool_minus_workpiece");
  if (has_large_errors(errors, of != nullptr ? *of : Machine{}))
    text += "large_errors = true # one of them is larger than machines have\n";
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [x, y, z] = errors.reference_mm[i];
    if (x != 0.0 || y != 0.0 || z != 0.0)
      text += format("reference_mm.{} = [{}, {}, {}]\n", "XYZ"[i], x, y, z);
  }
  if (of != nullptr) text += machine_identity_toml(*of);
  for (std::size_t i = 0; i < errors.terms.size(); ++i) {
    const ErrorTerm& term = errors.terms[i];
    const Units units(term.name);
    text += format("\n[[error]]\nname = \"{}\"\n", to_string(term.name));
    text += std::visit([&](const auto& kind) { return lines(kind, units); }, term.function);
    if (term.known_over)
      text +=
          format("known_{} = {}\n", units.position,
                 units.list({(*term.known_over)[0], (*term.known_over)[1]}, units.per_position));
    if (const double u = u_of(errors, i); u > 0.0)
      text += format("u_{} = {}\n", units.value, u * units.per_value);
  }
  return text + covariance_toml(errors.covariance);
}

}  // namespace trueaxis
