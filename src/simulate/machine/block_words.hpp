// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis::virtual_machine {

/// The words of a block as the control of the virtual machine takes them in.
struct BlockWords {
  std::size_t line = 0;              ///< 1-based
  std::vector<double> g, m;          ///< codes as they are written: 43.4
  std::map<char, double> of_letter;  ///< every other word, as it is written

  bool has(char letter) const { return of_letter.contains(letter); }
  bool has_g(double code) const;
  bool has_m(double code) const;
};

/// Takes a program of ISO 6983 words apart: comments `( )` and `;`, `/` and `%` as they are usual.
/// A block without words is dropped. What is not a word is added to `wrong`.
std::vector<BlockWords> words_of_blocks(std::string_view program, const std::string& file,
                                        std::vector<Diagnostic>& wrong);

}  // namespace trueaxis::virtual_machine
