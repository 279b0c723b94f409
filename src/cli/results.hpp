// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <deque>
#include <string>
#include <vector>

#include "format/outputs.hpp"

namespace trueaxis::cli {

/// The files that a command writes: for each an option that says where it goes ('-' prints it), and
/// `--force`.
class Results {
 public:
  bool force = false;

  /// Two results do not go to the same place.
  /// @param option "--json" or "-o,--output"
  /// @param schema as of Outputs::may_write
  CLI::Option* add(CLI::App& command, const std::string& option, const std::string& schema,
                   const std::string& help);

  /// Where the result of an option goes, by its last name ("--output"); empty: nobody asked for it.
  const std::string& operator[](const std::string& option) const;
  /// The schema of a result where other options decide it.
  void say(const std::string& option, const std::string& schema);
  bool asked(const std::string& option) const { return !(*this)[option].empty(); }
  /// One goes to standard output, which then holds nothing else.
  bool printed() const;
  /// "result j.json\n"; empty where it is not asked for.
  std::string line(const std::string& word, const std::string& option) const {
    return asked(option) ? word + (*this)[option] + '\n' : "";
  }
  /// Writes what `make` returns; nothing is made that nobody asked for.
  template <class Make>
  void write(Outputs& outputs, const std::string& option, const Make& make) const {
    if (asked(option)) outputs.write((*this)[option], make());
  }
  /// One that the user fills in afterwards: what is there is replaced only with `--force`.
  void is_filled_in(const std::string& option);
  /// Names what the command may write, and the files that it reads.
  void name_to(Outputs& outputs, const std::vector<std::string>& read = {}) const;

 private:
  struct Result {
    std::string option, schema, place;
    bool filled_in = false;
  };
  std::size_t at(const std::string& option) const;

  std::deque<Result> all_;  ///< CLI11 writes into them: they stay where they are
};

/// `--json` of a command.
void add_json(CLI::App& command, Results& results, const std::string& schema);

/// `--json`, `--residuals`, `--report` and `--force` of a command that fits a stream.
void add_stream_results(CLI::App& command, Results& results, const std::string& schema,
                        const std::string& residuals_hold);

}  // namespace trueaxis::cli
