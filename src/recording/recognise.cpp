// SPDX-License-Identifier: Apache-2.0
#include "format/csv_text.hpp"
#include "recording/recording.hpp"

namespace trueaxis {

Recording recognise_recording(const RecordedText& text, const std::string& path, std::size_t skip,
                              std::optional<char> decimal) {
  for (const auto read : {&read_twincat_scope, &read_camonitor, &read_words}) {
    Recording recording;
    if (skip == 0 && !decimal && read(text, recording)) return recording;
  }
  Recording recording;
  if (read_table(text, skip, decimal, recording)) return recording;
  const char* said = !decimal          ? ""
                     : *decimal == ',' ? " with decimal commas"
                                       : " with decimal points";
  throw InputError(path, std::string("holds no table of numbers") + said +
                             ": two rows of two numbers are the least");
}

std::string columns_listed(const Recording& recording) {
  std::string text;
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    const std::string& whole = recording.columns[k].whole;
    text += (k == 0 ? "" : ", ") + std::to_string(k + 1) + " " +
            (whole.empty() ? csv_quoted(recording.of_numbers ? recording.written(0, k)
                                                             : recording.cell(0, k)) +
                                 " …"
                           : whole);
  }
  return text;
}

}  // namespace trueaxis
