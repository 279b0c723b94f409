// SPDX-License-Identifier: Apache-2.0
#include "interchange/number_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "interchange/formats.hpp"
#include "interchange/zip_archive.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

enum class Kind { none, npy, npz, hdf5, matlab, matlab_4, x3p };

constexpr std::string_view packed = "PK\x03\x04", hdf5_magic = "\x89HDF\r\n\x1a\n",
                           npy_magic = "\x93NUMPY", matlab_magic = "MATLAB ";

/// Version 4 has no magic: five numbers of 4 bytes head a variable (type, rows, columns, imaginary,
/// length of its name), then its name with a zero.
bool is_matlab_4(std::string_view bytes) {
  constexpr std::size_t head = 20, longest_name = 64;
  if (bytes.size() < head) return false;
  std::array<std::int32_t, 5> of;
  std::memcpy(of.data(), bytes.data(), head);
  const auto length = static_cast<std::size_t>(of[4]);
  return of[0] >= 0 && of[0] < 60 && of[1] > 0 && of[2] > 0 && (of[3] == 0 || of[3] == 1) &&
         of[4] > 1 && length <= longest_name && bytes.size() >= head + length &&
         std::isalpha(static_cast<unsigned char>(bytes[head])) != 0 &&
         bytes[head + length - 1] == '\0';
}

Kind kind_of(std::string_view bytes) {
  if (bytes.starts_with(npy_magic)) return Kind::npy;
  if (bytes.starts_with(hdf5_magic)) return Kind::hdf5;
  if (bytes.starts_with(matlab_magic) && bytes.substr(0, 128).find("MAT-file") != bytes.npos)
    return Kind::matlab;
  if (is_matlab_4(bytes)) return Kind::matlab_4;
  if (!bytes.starts_with(packed)) return Kind::none;
  // The directory of an archive is at its end, where a broken one has none: the first member.
  const std::string_view head = bytes.substr(0, 200);
  const auto names_first = [&](std::string_view name) { return head.find(name) != head.npos; };
  try {
    const ZipArchive archive("", bytes);
    if (archive.has("main.xml")) return Kind::x3p;
    const auto names = archive.names();
    if (std::ranges::any_of(names, [](const auto& name) { return name.ends_with(".npy"); }))
      return Kind::npz;
  } catch (const InputError&) {
    if (names_first("main.xml") || names_first("bindata/")) return Kind::x3p;
    if (names_first(".npy")) return Kind::npz;
  }
  return Kind::none;
}

}  // namespace

bool is_number_file(std::string_view bytes) { return kind_of(bytes) != Kind::none; }

bool may_be_number_file(std::string_view head) {
  return head.starts_with(packed) || head.starts_with(npy_magic) || head.starts_with(hdf5_magic) ||
         head.starts_with(matlab_magic) || is_matlab_4(head);
}

std::size_t NumberBudget::take(const std::string& name, std::size_t rows, std::size_t columns) {
  if (rows == 0 || columns == 0) return 0;
  if (rows > left_ / columns)
    throw InputError(path_, (name.empty() ? "it" : "its array " + name) + " would be " +
                                std::to_string(rows) + " x " + std::to_string(columns) +
                                " numbers, more than TrueAxis reads from one file (2 GiB)" +
                                (left_ < most_numbers ? " with the arrays before it" : ""));
  left_ -= rows * columns;
  return rows * columns;
}

double binary_number(const char* at, char kind, std::size_t size) {
  const auto as = [at]<class T>(T value) {
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  };
  if (kind == 'f') return size == 4 ? as(float{}) : as(double{});
  const bool sign = kind == 'i';
  switch (size) {
    case 1:
      return sign ? as(std::int8_t{}) : as(std::uint8_t{});
    case 2:
      return sign ? as(std::int16_t{}) : as(std::uint16_t{});
    case 4:
      return sign ? as(std::int32_t{}) : as(std::uint32_t{});
    default:
      return sign ? as(std::int64_t{}) : as(std::uint64_t{});
  }
}

NumberFile read_number_file(const std::string& path, const std::string& bytes) {
  const Kind kind = kind_of(bytes);
  expects(kind != Kind::none, "a file that is_number_file() knows");
  if (kind == Kind::matlab_4)
    throw InputError(path, "is a MATLAB file of version 4: save it anew, save(…, '-v7')");
  NumberBudget budget(path);
  NumberFile file = kind == Kind::npz      ? read_npz(path, bytes)
                    : kind == Kind::hdf5   ? read_hdf5(path, bytes)
                    : kind == Kind::matlab ? read_matlab(path, bytes)
                    : kind == Kind::x3p    ? read_x3p(path, bytes)
                                           : NumberFile{"a NumPy array", {}, {}};
  if (kind == Kind::npy) file.arrays.push_back(read_npy(path, "", bytes, budget));
  for (NumberArray& array : file.arrays)
    if (array.unusable.empty() && array.values.empty()) array.unusable = "no numbers";
  if (std::ranges::none_of(file.arrays, [](const auto& a) { return a.unusable.empty(); }))
    throw InputError(path,
                     file.arrays.empty()
                         ? "is " + file.kind + " that holds no array"
                         : "is " + file.kind + " without a table of real numbers: " + listed(file));
  return file;
}

std::vector<NumberColumn> number_columns(const NumberFile& file) {
  std::vector<NumberColumn> columns;
  for (const NumberArray& array : file.arrays) {
    if (!array.unusable.empty()) continue;
    for (std::size_t k = 0; k < array.columns; ++k) {
      std::string name = array.name;
      if (!array.names.empty())
        name = array.names[k % array.names.size()];
      else if (array.columns > 1 && !name.empty())
        name += "." + std::to_string(k + 1);
      columns.push_back({&array, k, std::move(name)});
    }
  }
  return columns;
}

std::string listed(const NumberFile& file) {
  std::string text;
  for (const NumberArray& array : file.arrays) {
    text += (text.empty() ? "" : ", ") + (array.name.empty() ? "the array" : array.name) + " (";
    if (!array.unusable.empty())
      text += array.unusable;
    else if (array.columns == 1)
      text += std::to_string(array.rows) + " numbers";
    else
      text += std::to_string(array.rows) + " x " + std::to_string(array.columns);
    for (const std::string& name : array.names) text += " " + name;
    text += ")";
  }
  return text;
}

}  // namespace trueaxis
