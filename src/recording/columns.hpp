// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recording/recording.hpp"

namespace trueaxis {

/// What a column of a recording becomes in a stream. `y` is the transverse coordinate of a point,
/// from which reading and angle follow together.
enum class RecordedRole { x, face, c, z, y, t, pass, setup };

/// A column and its role.
struct TakenColumn {
  RecordedRole role;
  std::size_t column = 0;
  std::string unit{};              ///< as a stream writes it: "mm", "um", "deg"; empty of a count
  bool unit_said = true;           ///< false: nobody states it; the default of a stream applies
  bool unit_typed = false;         ///< `--columns` states it, whatever the file does
  std::optional<bool> diameter{};  ///< of x: what its name or unit says, if anything
};

/// `--columns "X=Diameter,C=Angle(°),Z=3[mm]"`: a stream's column and, after '=', the name in the
/// file's header or the number of the column, each with a unit in brackets if the file states none.
/// `decimal=point` or `decimal=comma` may be there too.
struct ColumnsSaid {
  struct Item {
    std::string role, column;
    std::optional<std::string> unit;
  };
  std::vector<Item> items;
  std::optional<char> decimal;  ///< of `decimal=point` or `decimal=comma`
};

/// @throws InputError with what is wrong with the text and an example.
ColumnsSaid read_columns_said(const std::string& text);

/// The columns as `--columns` or their names give them. `unclear` gets one sentence for each thing
/// that is not clear; the columns are then not to be used.
std::vector<TakenColumn> take_columns(const Recording& recording, const ColumnsSaid& said,
                                      std::vector<std::string>& unclear);

/// The column that a name of the header or a number means.
std::optional<std::size_t> find_column(const Recording& recording, const std::string& name);

/// The column that holds the readings, as `--columns` or, without it, the names tell: Z_M of a
/// face, else X.
std::optional<std::size_t> column_of_readings(const Recording& recording, const ColumnsSaid& said);

/// LinuxCNC's (PROBEOPEN): nine numbers X Y Z A B C U V W of six decimals, no names; X is a radius.
bool is_probe_log(const Recording& recording);

/// "X=…,C=…,Z=…" as far as the columns are clear, dots elsewhere: for a message.
std::string columns_suggested(const Recording& recording);

}  // namespace trueaxis
