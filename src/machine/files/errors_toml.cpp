// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "format/file.hpp"
#include "format/units.hpp"
#include "machine/files/error_sizes.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/machine_identity.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

/// Keys of one entry, by what the error is (a length or an angle) and its axis.
struct Keys {
  explicit Keys(const ErrorName& name)
      : rotary(name.body >= 3 && name.body < axis_count),
        value(name.angular() ? "_rad" : "_mm"),
        position(rotary ? "_rad" : "_mm") {}
  bool rotary;
  std::string value, position;
};

PolynomialError read_polynomial(TomlTable& table, const Keys& keys) {
  PolynomialError error;
  const std::string coefficients = "coefficients" + keys.value;
  error.coefficients = table.numbers(coefficients);
  if (error.coefficients.empty())
    table.complain(coefficients, "is needed: the list c0, c1, … of Σ cᵢ sⁱ");
  error.origin = table.number("origin" + keys.position, 0.0);
  error.scale = table.number("scale" + keys.position, keys.rotary ? rad_per_deg : 1.0);
  if (error.scale == 0.0) table.complain("scale" + keys.position, "must not be 0");
  return error;
}

FourierError read_fourier(TomlTable& table, const Keys& keys) {
  FourierError error;
  const std::string terms = "terms" + keys.value, period = "period" + keys.position;
  for (const auto& row : table.rows(terms, 3, 1)) error.terms.push_back({row[0], row[1], row[2]});
  if (error.terms.empty())
    table.complain(terms, "is needed: rows [n, a, b] of a cos(2πnq/P) + b sin(2πnq/P)");
  error.period = keys.rotary ? table.number(period, two_pi, Range::positive())
                             : table.required_number(period, Range::positive());
  return error;
}

TableError read_table(TomlTable& table, const Keys& keys) {
  TableError error;
  const std::string at = "at" + keys.position, values = "values" + keys.value;
  error.at = table.numbers(at);
  error.values = table.numbers(values);
  error.periodic = table.flag("periodic", false);
  if (error.at.size() < 2) table.complain(at, "is needed: two positions or more");
  if (std::ranges::adjacent_find(error.at, std::ranges::greater_equal{}) != error.at.end())
    table.complain(at, "must ascend");
  if (const std::string trouble = turn_trouble(keys.rotary ? AxisName::C : AxisName::X, error);
      !trouble.empty())
    table.complain(at, trouble);
  if (error.values.size() != error.at.size())
    table.complain(values, "must hold as many numbers as there are positions");
  return error;
}

enum class Kind { constant, polynomial, fourier, table };

Kind read_kind(TomlTable& entry) {
  return entry.choice<Kind>("kind",
                            {{"constant", Kind::constant},
                             {"polynomial", Kind::polynomial},
                             {"fourier", Kind::fourier},
                             {"table", Kind::table}},
                            Kind::constant);
}

ErrorFunction read_function(TomlTable& table, Kind kind, const Keys& keys) {
  switch (kind) {
    case Kind::polynomial:
      return read_polynomial(table, keys);
    case Kind::fourier:
      return read_fourier(table, keys);
    case Kind::table:
      return read_table(table, keys);
    case Kind::constant:
      break;
  }
  return ConstantError{table.required_number("value" + keys.value)};
}

/// The key that holds the values of a kind, in the unit inside.
std::string values_key(Kind kind, const Keys& keys) {
  constexpr const char* words[] = {"value", "coefficients", "terms", "values"};
  return words[static_cast<std::size_t>(kind)] + keys.value;
}

void check_size(TomlTable& table, const ErrorTerm& term, Kind kind, const Machine& machine) {
  const Keys keys(term.name);
  const double size = size_of(term.function, range_of(term.function, term.name, machine));
  const std::string trouble = size_trouble(term.name, size);
  if (!trouble.empty()) table.complain(values_key(kind, keys), trouble);
  const std::string u = size_trouble(term.name, term.u);
  if (!u.empty()) table.complain("u" + keys.value, u);
}

void read_error(TomlTable table, const Machine& machine, bool large, ErrorModel& errors) {
  const std::string text = table.required_text("name");
  const auto name = parse_error_name(text);
  const std::string trouble = text.empty() ? "" : error_name_trouble(text, machine);
  if (!trouble.empty()) table.complain("name", trouble);
  if (!name) {
    table.ignore_rest();
    return;
  }
  const Kind kind = read_kind(table);
  if (!name->component && kind != Kind::constant)
    table.complain("kind", "must be \"constant\": " + text + " is not a function of a position");
  const Keys keys(*name);
  ErrorTerm term{*name, read_function(table, kind, keys)};
  term.u = table.number("u" + keys.value, 0.0, Range::non_negative());
  const std::string known = "known" + keys.position;
  if (const std::vector<double> range = table.numbers(known);
      range.size() == 2 && range[0] < range[1])
    term.known_over = {range[0], range[1]};
  else if (!range.empty())
    table.complain(known, "must be two positions that ascend: from where to where it was measured");
  if (!large) check_size(table, term, kind, machine);
  if (without_effect(*name) && value_at(term.function, 0.0) != 0.0)
    table.complain("value" + keys.value, "must be 0: " + text + " has no effect");
  errors.terms.push_back(std::move(term));
}

void read_reference(TomlTable& root, const Machine& machine, ErrorModel& errors) {
  const std::vector<std::string> keys = root.keys();
  for (const KeySpelling& spelling : key_spellings("reference_mm")) {
    if (std::ranges::find(keys, spelling.key) == keys.end()) continue;
    auto table = root.maybe_table(spelling.key);
    for (std::size_t i = 0; table && i < 3; ++i) {
      const std::string letter(1, "XYZ"[i]);
      Vector3& reference = errors.reference_mm[i];
      reference = read_vector(*table, letter);
      for (double& component : reference) component *= spelling.factor;
      if (table->has(letter) && machine.find(static_cast<AxisName>(i)) == nullptr)
        table->complain(letter, "is not an axis of the machine");
    }
    return;
  }
  root.has("reference_mm");
}

}  // namespace

ErrorModel read_errors_toml(const std::string& path, const Machine& machine, bool large_errors) {
  return parse_errors_toml(read_file(path), path, machine, large_errors);
}

ErrorModel parse_errors_toml(std::string_view content, const std::string& path,
                             const Machine& machine, bool large_errors) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  ErrorModel errors;
  root.required_choice<int>("schema", {{"trueaxis.errors/1", 1}});
  root.text("name");
  check_machine_identity(root, machine);
  errors.sign = root.required_choice<ErrorSign>(
      "sign", {{"moving_part", ErrorSign::moving_part},
               {"tool_minus_workpiece", ErrorSign::tool_minus_workpiece}});
  read_reference(root, machine, errors);
  const bool large = root.flag("large_errors", false) || large_errors;
  for (TomlTable table : root.tables("error")) read_error(table, machine, large, errors);
  read_covariance(root, machine, large, errors);
  document.finish();
  return errors;
}

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
