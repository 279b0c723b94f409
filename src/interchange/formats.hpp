// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interchange/number_file.hpp"

namespace trueaxis {

/// What is read at once of one file, numbers of 8 bytes: 2 GiB. A file that says it holds more is
/// refused before anything is allocated.
inline constexpr std::size_t most_numbers = std::size_t{1} << 28U;
inline constexpr std::size_t most_bytes = 8 * most_numbers;

/// rows x columns where that is no more than `most_numbers`. @throws InputError
std::size_t number_count(const std::string& path, const std::string& name, std::size_t rows,
                         std::size_t columns);

// Each reads its format; is_… has seen to it that the bytes begin as one.
NumberArray read_npy(const std::string& path, const std::string& name, std::string_view bytes);
NumberFile read_npz(const std::string& path, const std::string& bytes);
NumberFile read_hdf5(const std::string& path, const std::string& bytes);
NumberFile read_matlab(const std::string& path, const std::string& bytes);
NumberFile read_x3p(const std::string& path, const std::string& bytes);

}  // namespace trueaxis
