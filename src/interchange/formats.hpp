// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interchange/number_file.hpp"

namespace trueaxis {

/// What is read at once of one file, numbers of 8 bytes: 2 GiB. A file that says it holds more is
/// refused before anything is allocated.
inline constexpr std::size_t most_numbers = std::size_t{1} << 28U;
inline constexpr std::size_t most_bytes = 8 * most_numbers;

/// The rest of `most_numbers` for the arrays of one file.
class NumberBudget {
 public:
  explicit NumberBudget(const std::string& path) : path_(path) {}
  /// rows x columns, subtracted from the rest. @throws InputError if it is more
  std::size_t take(const std::string& name, std::size_t rows, std::size_t columns);

 private:
  const std::string& path_;
  std::size_t left_ = most_numbers;
};

/// The number of `size` bytes at `at`: a floating-point number of kind 'f', a whole one of 'i' or,
/// without a sign, 'u'.
double binary_number(const char* at, char kind, std::size_t size);

// Each reads its format; is_… has seen to it that the bytes begin as one.
NumberArray read_npy(const std::string& path, const std::string& name, std::string_view bytes,
                     NumberBudget& budget);
NumberFile read_npz(const std::string& path, const std::string& bytes);
NumberFile read_hdf5(const std::string& path, const std::string& bytes);
NumberFile read_matlab(const std::string& path, const std::string& bytes);
NumberFile read_x3p(const std::string& path, const std::string& bytes);

}  // namespace trueaxis
