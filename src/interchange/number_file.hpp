// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trueaxis {

/// One array of numbers of a binary file. One dimension is a column, two are rows and columns, a
/// MATLAB row vector is a column too.
struct NumberArray {
  std::string name;  ///< variable, path of the data set; empty where the format has none
  std::string unit;  ///< as the file says it; empty where it says none
  std::size_t rows = 0, columns = 1;
  std::vector<double> values{};        ///< row by row, rows x columns
  std::vector<std::string> names{};    ///< of the columns, where the file has them
  std::vector<std::size_t> numbers{};  ///< of the rows in the file, from 1, if some are excluded
  std::string unusable{};              ///< why it is not a table of real numbers, else empty
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// What a binary file holds. Nothing is converted: numbers and units are those of the file.
struct NumberFile {
  std::string kind;  ///< "a NumPy array", "an X3P file (metres)"
  std::vector<NumberArray> arrays;
  std::vector<std::string> notes{};  ///< what was passed over, in sentences
};

/// Whether the bytes are of a file that read_number_file() reads: NumPy .npy and .npz, MATLAB .mat
/// (5, 7.3), HDF5, X3P (ISO 25178-72). Of a packed file its members tell.
bool is_number_file(std::string_view bytes);

/// Whether the first bytes can be those of such a file: a cheap look before it is read.
bool may_be_number_file(std::string_view head);

/// @throws InputError with what is broken: cut off, no sums, sizes that no file of that length
/// holds, check sums that do not agree.
NumberFile read_number_file(const std::string& path, const std::string& bytes);

/// The columns of all arrays, each of `rows` numbers, as pairs of array and column.
struct NumberColumn {
  const NumberArray* array = nullptr;
  std::size_t column = 0;
  std::string name;  ///< "X", "run/X", "P.2"; empty where nothing names it
};
std::vector<NumberColumn> number_columns(const NumberFile& file);

/// "X (400 numbers), P (400 x 3), label (text)": what there is to choose from.
std::string listed(const NumberFile& file);

/// The points as X3P (ISO 25178-72, ISO 5436-2): a point cloud of absolute double axes in metres,
/// with its MD5 sums. The same bytes for the same values.
/// @param xyz_m  x, y, z in turn, in metres
std::string x3p_of_points(const std::vector<double>& xyz_m, const std::string& version);

}  // namespace trueaxis
