// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

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

struct Block {
  std::size_t header_line = 0;
  std::vector<std::string> header;
  std::vector<NumberTable::Row> rows;
};

std::vector<Block> blocks_of(std::string_view content, const std::string& path,
                             std::vector<Diagnostic>& wrong) {
  std::vector<Block> blocks(1);
  for_each_line(content, [&](std::string_view line, std::size_t number) {
    line = line.substr(0, line.find("//"));
    if (trimmed(line).empty()) return;
    const auto fields = fields_of(line);
    if (fields.front().starts_with('#')) {
      if (!blocks.back().header.empty()) blocks.emplace_back();
      return;
    }
    Block& block = blocks.back();
    if (block.header.empty()) {
      block.header.assign(fields.begin(), fields.end());
      block.header_line = number;
      return;
    }
    NumberTable::Row row{number, {}};
    double value = 0.0;
    for (const std::string_view field : fields)
      if (parse_number(field, value)) row.values.push_back(value);
    if (row.values.size() == block.header.size() && fields.size() == block.header.size())
      block.rows.push_back(std::move(row));
    else
      wrong.push_back({path, number, 0,
                       fmt::format("is not a row of {} numbers under its header (line {})",
                                   block.header.size(), block.header_line)});
  });
  if (blocks.back().header.empty()) blocks.pop_back();
  return blocks;
}

/// One block into `errors`; what is wrong by `complain(line, message)`.
class BlockReader {
 public:
  BlockReader(const Block& block, const Machine& machine, bool large_errors)
      : block_(block), machine_(machine), large_errors_(large_errors) {}

  template <class Complain>
  void read(ErrorModel& errors, const Complain& complain) const {
    const std::size_t line = block_.header_line;
    const auto argument = axis_of(block_.header.front());
    if (block_.rows.empty()) complain(line, "has a header and no rows");
    if (argument && machine_.find(*argument) == nullptr)
      complain(line, block_.header.front() + " is not an axis of the machine");
    if (argument && !block_.rows.empty()) {
      const double unit = edge_unit(*argument);
      const std::string trouble = turn_trouble(
          *argument,
          {{block_.rows.front().values.front() * unit, block_.rows.back().values.front() * unit},
           {}});
      if (!trouble.empty()) complain(line, trouble);
    }
    if (argument && block_.rows.size() == 1) complain(line, "needs two rows or more");
    if (!argument && block_.rows.size() > 1)
      complain(line, "has no axis as its first column: then one row of constants only");
    for (std::size_t i = 1; argument && i < block_.rows.size(); ++i)
      if (block_.rows[i].values.front() <= block_.rows[i - 1].values.front())
        complain(block_.rows[i].line, "the argument must ascend");
    for (std::size_t i = argument ? 1 : 0; i < block_.header.size(); ++i)
      column(i, argument, errors, [&](const std::string& message) { complain(line, message); });
    for (std::size_t i = argument ? 1 : 0; !large_errors_ && i < block_.header.size(); ++i)
      check_size(i, complain);
  }

 private:
  template <class Complain>
  void column(std::size_t i, std::optional<AxisName> argument, ErrorModel& errors,
              const Complain& complain) const {
    const std::string& text = block_.header[i];
    if (axis_of(text)) {
      complain(text + " is a second argument: TrueAxis does not read errors of several axes");
      return;
    }
    const std::string trouble = error_name_trouble(text, machine_);
    if (!trouble.empty()) {
      complain("a column " + trouble);
      return;
    }
    const ErrorName name = *parse_error_name(text);
    if (argument && (!name.component || name.body != index_of(*argument))) {
      complain(text + " is not a function of " + letter_of(*argument));
      return;
    }
    if (block_.rows.empty()) return;
    if (!argument) {
      const double value = block_.rows.front().values[i];
      if (without_effect(name) && value != 0.0) complain(text + " has no effect: it must be 0");
      errors.terms.push_back({name, ConstantError{value}});
      return;
    }
    TableError table;
    for (const NumberTable::Row& row : block_.rows) {
      table.at.push_back(row.values.front() * edge_unit(*argument));
      table.values.push_back(row.values[i]);
    }
    errors.terms.push_back({name, table_of_turns(*argument, std::move(table))});
  }

  /// At the first row whose number is not a size of the column's error.
  template <class Complain>
  void check_size(std::size_t i, const Complain& complain) const {
    const auto name = parse_error_name(block_.header[i]);
    for (std::size_t row = 0; name && row < block_.rows.size(); ++row) {
      const std::string trouble = size_trouble(*name, block_.rows[row].values[i]);
      if (trouble.empty()) continue;
      complain(block_.rows[row].line, "(mm and rad) " + trouble);
      return;
    }
  }

  const Block& block_;
  const Machine& machine_;
  bool large_errors_;
};

}  // namespace

ErrorModel read_isg_csv(std::string_view content, const std::string& path, const Machine& machine,
                        ErrorSign sign, bool large_errors) {
  std::vector<Diagnostic> wrong;
  ErrorModel errors;
  errors.sign = sign;
  const std::vector<Block> blocks = blocks_of(content, path, wrong);
  if (blocks.empty() && wrong.empty())
    wrong.push_back({path, 0, 0, "has no table: give a header such as `X EXX` and its rows"});
  for (const Block& block : blocks)
    BlockReader(block, machine, large_errors)
        .read(errors, [&](std::size_t line, const std::string& message) {
          wrong.push_back({path, line, 0, message});
        });
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return errors;
}

std::string isg_csv_text(const ErrorModel& errors, const Machine& machine, ErrorSign sign,
                         int points) {
  std::string names, values;
  for (std::size_t body = 0; body < body_count; ++body) {
    for (std::size_t direction = 0; direction < 6; ++direction) {
      const ErrorName name{false, direction, body};
      const double value = location_value(errors, name);
      if (value == 0.0) continue;
      if (!names.empty()) names += ' ';
      names += to_string(name);
      values += fmt::format("{}{}", values.empty() ? "" : " ", value);
    }
  }
  std::string text = "// schema: trueaxis.isg/1\n// mm, rad; arguments of rotary axes in deg\n";
  if (!names.empty()) text += names + '\n' + values + '\n';
  for (const SampledErrors& axis : sample_components(machine, errors, sign, points)) {
    if (!names.empty()) text += "#\n";
    names = letter_of(axis.axis);
    for (std::size_t direction = 0; direction < 6; ++direction)
      if (!axis.values[direction].empty())
        names += fmt::format(" {}", to_string(ErrorName{true, direction, index_of(axis.axis)}));
    text += names + '\n';
    for (std::size_t i = 0; i < axis.positions.size(); ++i) {
      text += fmt::format("{}", axis.positions[i] / edge_unit(axis.axis));
      for (const auto& column : axis.values)
        if (!column.empty()) text += fmt::format(" {}", column[i]);
      text += '\n';
    }
  }
  return text;
}

}  // namespace trueaxis
