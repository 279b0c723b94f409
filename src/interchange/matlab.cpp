// SPDX-License-Identifier: Apache-2.0
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>

#include "interchange/formats.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// The elements of a file of version 5 are each headed by their length: all of them must be there,
/// which the library does not look at.
void expect_whole(const std::string& path, const std::string& bytes) {
  constexpr std::size_t head = 128;
  const bool little = bytes.size() > head && bytes[126] == 'I' && bytes[127] == 'M';
  for (std::size_t at = head; at < bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4 && at + 8 <= bytes.size(); ++i)
      length |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + 4 + i]))
                << 8U * (little ? i : 3 - i);
    if (at + 8 > bytes.size() || length > bytes.size() - at - 8)
      throw InputError(path, "is an incomplete MATLAB file: copy it again");
    at += 8 + length;
  }
}

/// Row by row, where MATLAB's order is column by column.
void copy_numbers(const matvar_t& of, NumberArray& to) {
  const auto size = static_cast<std::size_t>(of.data_size);
  const bool real = of.class_type == MAT_C_DOUBLE || of.class_type == MAT_C_SINGLE;
  // Classes of whole numbers alternate: int8, uint8, int16 …
  const char kind = real ? 'f' : (of.class_type - MAT_C_INT8) % 2 == 0 ? 'i' : 'u';
  static_assert(MAT_C_UINT8 == MAT_C_INT8 + 1 && MAT_C_UINT64 == MAT_C_INT8 + 7);
  for (std::size_t row = 0; row < to.rows; ++row)
    for (std::size_t column = 0; column < to.columns; ++column)
      to.values.push_back(binary_number(
          static_cast<const char*>(of.data) + (column * to.rows + row) * size, kind, size));
}

/// A file of these bytes in memory: the library reads files only, and what was hashed is read.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("matlab", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written <= 0) break;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    if (!bytes.empty()) throw std::runtime_error("no memory for a copy of a MATLAB file");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

NumberArray variable(const std::string& path, mat_t* file, matvar_t& of, NumberBudget& budget) {
  NumberArray array;
  array.name = of.name == nullptr ? "" : of.name;
  const bool numbers = of.class_type >= MAT_C_DOUBLE && of.class_type <= MAT_C_UINT64;
  if (!numbers)
    array.unusable = of.class_type == MAT_C_CHAR     ? "text"
                     : of.class_type == MAT_C_STRUCT ? "a structure"
                                                     : "no numbers";
  else if (of.isComplex != 0)
    array.unusable = "complex numbers";
  else if (of.rank != 2)
    array.unusable = std::to_string(of.rank) + " dimensions";
  if (!array.unusable.empty()) return array;
  array.rows = of.dims[0];
  array.columns = of.dims[1];
  const std::size_t count = budget.take(array.name, array.rows, array.columns);
  if (count > 0 && (Mat_VarReadDataAll(file, &of) != 0 || of.data == nullptr ||
                    of.nbytes != count * static_cast<std::size_t>(of.data_size)))
    throw InputError(path, "its variable " + array.name + " cannot be read: copy the file again");
  array.values.reserve(count);
  if (count > 0) copy_numbers(of, array);
  if (array.rows == 1) std::swap(array.rows, array.columns);  // a row vector is a column
  return array;
}

/// Version 7.3 is HDF5 whose rows are MATLAB's columns.
NumberFile read_matlab_hdf5(const std::string& path, const std::string& bytes) {
  NumberFile file = read_hdf5(path, bytes);
  file.kind = "a MATLAB file";
  for (NumberArray& array : file.arrays) {
    if (!array.unusable.empty() || array.values.empty()) continue;
    NumberArray turned = array;
    std::swap(turned.rows, turned.columns);
    turned.values.clear();
    for (std::size_t row = 0; row < turned.rows; ++row)
      for (std::size_t column = 0; column < turned.columns; ++column)
        turned.values.push_back(array.at(column, row));
    if (turned.rows == 1) std::swap(turned.rows, turned.columns);
    array = std::move(turned);
  }
  return file;
}

}  // namespace

NumberFile read_matlab(const std::string& path, const std::string& bytes) {
  if (bytes.compare(0, 10, "MATLAB 7.3") == 0) return read_matlab_hdf5(path, bytes);
  if (bytes.compare(0, 10, "MATLAB 5.0") == 0) expect_whole(path, bytes);
  Mat_LogInitFunc("", [](int, char*) {});  // this project reports what is wrong
  const MemoryFile copy(bytes);
  const std::unique_ptr<mat_t, int (*)(mat_t*)> file(Mat_Open(copy.path().c_str(), MAT_ACC_RDONLY),
                                                     &Mat_Close);
  if (!file) throw InputError(path, "is not a complete MATLAB file: copy it again");
  NumberFile out{.kind = "a MATLAB file", .arrays = {}};
  NumberBudget budget(path);
  using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;
  for (Variable next(Mat_VarReadNextInfo(file.get()), &Mat_VarFree); next;
       next.reset(Mat_VarReadNextInfo(file.get())))
    out.arrays.push_back(variable(path, file.get(), *next, budget));
  return out;
}

}  // namespace trueaxis
