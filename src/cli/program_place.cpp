// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "cli/guarded.hpp"
#include "format/file.hpp"
#include "nc/mark.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

bool is_earlier_result(const std::string& there, const std::string& program) {
  return there == program ||
         (nc::marked_line(there) && nc::differ_in_axis_words_only(there, program));
}

}  // namespace

void expect_no_other_program(const std::string& path, const std::string& program, bool force) {
  std::error_code error;
  if (force || is_standard_output(path) || !std::filesystem::is_regular_file(path, error) ||
      std::filesystem::file_size(path, error) == 0 || is_earlier_result(read_file(path), program))
    return;
  throw InputError(path,
                   "is there and is another program: name another place for the result, or let it "
                   "be replaced with --force");
}

}  // namespace trueaxis::cli
