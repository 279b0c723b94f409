// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "nc/axes.hpp"
#include "nc/lexer.hpp"

namespace trueaxis::nc {

/// A complaint about a word of a block.
struct WordTrouble {
  const Word* word;
  std::string why;
};

/// The words of a block by what they are.
struct Block {
  std::vector<int> g_tenths;  ///< G codes that are read, in tenths
  std::vector<int> m;
  std::array<const Word*, 26> by_letter{};  ///< every other word by its letter; null: none
  AxisSet named = 0;
  bool refused = false;  ///< something of it is not read

  const Word* word(char letter) const { return by_letter[static_cast<std::size_t>(letter - 'A')]; }
  bool has_g(int tenths) const;
  bool has_m(int m_code) const;
  const Word* centre_word() const;      ///< the first of I J K; null: none
  const Word& first_axis_word() const;  ///< in the text; `named` is not empty
};

/// What a reader of one block must know: axes of the machine, whether arcs are allowed.
struct BlockRules {
  AxisSet axes = all_axes;
  bool arcs = false;
  int cycle = 0;  ///< canned cycle in force before the block: 81, 82, 83; 0: none
};

/// Sorts the words of a block; what is not read goes to `troubles`.
void sort_words(std::span<const Word> words, const BlockRules& rules, Block& block,
                std::vector<WordTrouble>& troubles);

/// "X Y Z": the axes of a set.
std::string names_of(AxisSet axes);

}  // namespace trueaxis::nc
