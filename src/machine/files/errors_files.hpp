// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "machine/files/machine_toml.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// The remarks about errors files that do not state it.
struct ErrorsFiles {
  std::optional<ErrorSign> foreign_sign{};  ///< of component errors in ISG and Etalon files
  bool large_errors = false;  ///< they are larger than machines have (error_sizes.hpp), and meant
};

/// Whether a file is `trueaxis.errors/1`: by its name, `.toml`, or by what it says of itself.
bool is_errors_toml(const std::string& path);

struct ErrorsOfFiles {
  ErrorModel errors;
  std::vector<std::string> hashes;   ///< of each file, of the bytes that were read
  std::vector<std::string> remarks;  ///< what the files do not say, such as their machine
};

/// The errors of all files together, and those of a D-H machine's own parameters: entries of one
/// name add, and so do covariances, each file's being independent of the others'. is_errors_toml()
/// is `trueaxis.errors/1`, `.csv` the ISG table, any other name the Etalon exchange format; the
/// last two do not say their sign, `said` does.
/// @throws InputError with every diagnostic of every file; where component errors come from two, or
/// two are the same.
ErrorsOfFiles read_errors_files(std::span<const std::string> paths, const MachineFile& machine,
                                const ErrorsFiles& said = {});

/// The errors alone.
ErrorModel read_errors(std::span<const std::string> paths, const MachineFile& machine,
                       const ErrorsFiles& said = {});

/// Reads `trueaxis.errors/1` (machine.md) of a machine. Errors that state another machine are
/// refused. So are those of a size that machines do not have, unless the file or `large_errors`
/// says that they are so large. @throws InputError with every diagnostic: file, line, column, what
/// to do.
ErrorModel read_errors_toml(const std::string& path, const Machine& machine,
                            bool large_errors = false);
/// The same of what the file holds.
ErrorModel parse_errors_toml(std::string_view content, const std::string& path,
                             const Machine& machine, bool large_errors = false);

/// What `read_errors_toml` reads back. `of`: the machine that it will say the errors are of; errors
/// of a workpiece alone are of none.
std::string errors_toml(const ErrorModel& errors, const Machine* of = nullptr);

/// Reads, of what a file holds, the Etalon exchange format, variant "Vendor": `//` comments, a
/// block `[NAME]` with `VALUE = v` or `Gridpoints = {` rows `argument value` `}`; mm and rad,
/// arguments of rotary axes in degrees. It does not say its sign: `sign` does, and of pivots it
/// knows nothing (0). Numbers that are not sizes of errors in mm and rad are refused, unless
/// `large_errors`. @throws InputError with every diagnostic.
ErrorModel read_etalon(std::string_view content, const std::string& path, const Machine& machine,
                       ErrorSign sign, bool large_errors = false);

/// The same written, component errors as tables of `points` positions if they are not tables yet.
std::string etalon_text(const ErrorModel& errors, const Machine& machine, ErrorSign sign,
                        int points);

/// Reads, of what a file holds, the ISG table of a control's volumetric compensation: `//`
/// comments, blocks parted by a line `#`, each a header of an axis and its errors (`X EXX EYX …`)
/// or of location errors with one row; separated by blanks or tabs; mm and rad, arguments of rotary
/// axes in degrees. Errors as functions of several axes are refused, and so are numbers that are
/// not sizes of errors in mm and rad, unless `large_errors`. It does not say its sign: `sign` does.
/// @throws InputError with every diagnostic.
ErrorModel read_isg_csv(std::string_view content, const std::string& path, const Machine& machine,
                        ErrorSign sign, bool large_errors = false);

/// The same written, component errors at `points` positions if they are not tables yet.
std::string isg_csv_text(const ErrorModel& errors, const Machine& machine, ErrorSign sign,
                         int points);

/// Schema trueaxis.errors_at/1: every component error of every axis at a position, and the location
/// errors that keep the form of the inverse kinematics (of five axes 30 and 9, Bohez 2002); under
/// `further` the other ones that are given. mm and degrees; `remarks` of the files that were read.
std::string errors_json(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
                        const std::vector<std::string>& remarks);

/// The same for a terminal, µm and µrad, without zeros.
std::string errors_text(const Machine& machine, const ErrorModel& errors,
                        const AxisPositions& axes);

/// Why `text` names no error of this machine; empty: it names one.
std::string error_name_trouble(const std::string& text, const Machine& machine);

/// A table of a format that does not say whether it goes on beyond its ends: that of a rotary axis
/// over one turn that ends as it begins does, and of one that lacks a step of it, no larger than
/// its own.
TableError table_of_turns(AxisName axis, TableError table);

/// What is wrong with a table of a rotary axis whose positions are degrees; "" where nothing is.
std::string turn_trouble(AxisName axis, const TableError& table);

}  // namespace trueaxis
