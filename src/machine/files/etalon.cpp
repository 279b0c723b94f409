// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "machine/files/error_sizes.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/number_table.hpp"
#include "machine/files/toml_parts.hpp"
#include "machine/sampled_errors.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// Reads line by line; what a block is of is known from its heading.
class EtalonReader {
 public:
  EtalonReader(const std::string& path, const Machine& machine, bool large_errors,
               ErrorModel& errors)
      : path_(path), machine_(machine), large_errors_(large_errors), errors_(errors) {}

  void line(std::string_view text, std::size_t number) {
    number_ = number;
    text = trimmed(text.substr(0, text.find("//")));
    if (text.empty()) return;
    if (in_grid_)
      grid_row(text);
    else if (text.front() == '[')
      heading(text);
    else
      entry(text);
  }
  void finish() {
    if (in_grid_) complain("a block of Gridpoints is not closed: end it with }");
    close_block();
    if (errors_.terms.empty() && wrong_.empty())
      wrong_.push_back({path_, 0, 0, "has no error: give a block such as [EXX] and its rows"});
    if (!wrong_.empty()) throw InputError(std::move(wrong_));
  }

 private:
  void complain(std::string message) { wrong_.push_back({path_, number_, 0, std::move(message)}); }

  void close_block() {
    if (block_open_ && !filled_)
      wrong_.push_back({path_, heading_line_, 0, "a block without VALUE or Gridpoints"});
    block_open_ = filled_ = false;
  }

  void heading(std::string_view text) {
    close_block();
    const std::string name(trimmed(text.substr(1, text.find(']') - 1)));
    const std::string trouble =
        text.ends_with(']') ? error_name_trouble(name, machine_) : "is not closed by ]";
    if (!trouble.empty()) complain("the block " + std::string(text) + ' ' + trouble);
    name_ = trouble.empty() ? parse_error_name(name) : std::nullopt;
    heading_line_ = number_;
    block_open_ = true;
    size_said_ = false;
  }

  void entry(std::string_view text) {
    const std::size_t equals = text.find('=');
    const std::string_view key = trimmed(text.substr(0, equals));
    const std::string_view value =
        equals == std::string_view::npos ? "" : trimmed(text.substr(equals + 1));
    double constant = 0.0;
    if (!block_open_ || filled_) {
      complain("is outside a block, or repeated in one: begin a block with [NAME]");
    } else if (key == "VALUE" && parse_number(value, constant)) {
      check_size(constant);
      add(ConstantError{constant});
    } else if (key == "Gridpoints" && value == "{") {
      in_grid_ = true;
      grid_ = {};
      if (name_ && !name_->component) complain(to_string(*name_) + " has a VALUE, no Gridpoints");
    } else {
      complain('"' + std::string(text) + "\" is neither VALUE = number nor Gridpoints = {");
    }
    filled_ = filled_ || block_open_;
  }

  void grid_row(std::string_view text) {
    const bool last = text.ends_with('}');
    if (last) text = trimmed(text.substr(0, text.size() - 1));
    const auto fields = fields_of(text);
    double at = 0.0, value = 0.0;
    if (!text.empty()) {
      if (fields.size() != 2 || !parse_number(fields[0], at) || !parse_number(fields[1], value)) {
        complain('"' + std::string(text) + "\" is not a row `argument value`");
      } else if (name_) {
        at *= edge_unit(static_cast<AxisName>(name_->body % axis_count));
        if (!grid_.at.empty() && at <= grid_.at.back()) complain("arguments must ascend");
        check_size(value);
        grid_.at.push_back(at);
        grid_.values.push_back(value);
      }
    }
    if (!last) return;
    in_grid_ = false;
    if (name_ && grid_.at.size() < 2) complain("Gridpoints need two rows or more");
    if (!name_) return;
    const auto axis = static_cast<AxisName>(name_->body % axis_count);
    if (std::string trouble = turn_trouble(axis, grid_); !trouble.empty())
      complain(std::move(trouble));
    add(table_of_turns(axis, grid_));
  }

  /// The first of a block's numbers that is not a size of its error.
  void check_size(double value) {
    const std::string trouble = name_ && !large_errors_ ? size_trouble(*name_, value) : "";
    if (!trouble.empty() && !std::exchange(size_said_, true)) complain("(mm and rad) " + trouble);
  }

  void add(ErrorFunction function) {
    if (!name_) return;
    if (without_effect(*name_) && value_at(function, 0.0) != 0.0)
      complain(to_string(*name_) + " has no effect: it must be 0");
    errors_.terms.push_back({*name_, std::move(function)});
  }

  const std::string& path_;
  const Machine& machine_;
  bool large_errors_;
  ErrorModel& errors_;
  std::vector<Diagnostic> wrong_;
  std::optional<ErrorName> name_;
  TableError grid_;
  std::size_t number_ = 0, heading_line_ = 0;
  bool block_open_ = false, filled_ = false, in_grid_ = false, size_said_ = false;
};

}  // namespace

ErrorModel read_etalon(std::string_view content, const std::string& path, const Machine& machine,
                       ErrorSign sign, bool large_errors) {
  ErrorModel errors;
  errors.sign = sign;
  EtalonReader reader(path, machine, large_errors, errors);
  for_each_line(content, [&](auto line, std::size_t number) { reader.line(line, number); });
  reader.finish();
  return errors;
}

std::string etalon_text(const ErrorModel& errors, const Machine& machine, ErrorSign sign,
                        int points) {
  std::string text = "// schema: trueaxis.etalon/1\n// mm, rad; arguments of rotary axes in deg\n";
  for (std::size_t body = 0; body < body_count; ++body) {
    for (std::size_t direction = 0; direction < 6; ++direction) {
      const ErrorName name{false, direction, body};
      if (const double value = location_value(errors, name); value != 0.0)
        text += fmt::format("[{}]\nVALUE = {}\n", to_string(name), value);
    }
  }
  for (const SampledErrors& axis : sample_components(machine, errors, sign, points)) {
    for (std::size_t direction = 0; direction < 6; ++direction) {
      if (axis.values[direction].empty()) continue;
      const std::string name = to_string(ErrorName{true, direction, index_of(axis.axis)});
      text += "[" + name + "]\nGridpoints = {\n";
      for (std::size_t i = 0; i < axis.positions.size(); ++i)
        text += fmt::format("  {} {}\n", axis.positions[i] / edge_unit(axis.axis),
                            axis.values[direction][i]);
      text += "}  // end of " + name + '\n';
    }
  }
  return text;
}

}  // namespace trueaxis
