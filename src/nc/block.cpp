// SPDX-License-Identifier: Apache-2.0
#include "nc/block.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nc/modal.hpp"

namespace trueaxis::nc {
namespace {

/// A number as a code in tenths (G43.4: 434); -1 if it is not a code.
int tenths_of(double number) {
  const double tenths = 10.0 * number;
  if (!(tenths >= 0.0 && tenths < 1e6)) return -1;
  const double whole = std::nearbyint(tenths);
  return std::abs(tenths - whole) < 1e-6 ? static_cast<int>(whole) : -1;
}

std::string code_text(const Word& word, int tenths) {
  if (tenths < 0) return std::string(1, word.letter) + " with this number";
  std::string text = word.letter + std::to_string(tenths / 10);
  if (tenths % 10 != 0) text += '.' + std::to_string(tenths % 10);
  return text;
}

class Sorter {
 public:
  Sorter(const BlockRules& rules, Block& block, std::vector<WordTrouble>& troubles)
      : rules_(rules), block_(block), troubles_(troubles) {}

  void sort(std::span<const Word> words) {
    block_.g_tenths.clear();
    block_.m.clear();
    block_.by_letter.fill(nullptr);
    block_.named = 0;
    block_.refused = false;
    for (const Word& word : words) {
      if (word.letter == 'G')
        take_g(word);
      else if (word.letter == 'M')
        take_m(word);
      else
        take(word);
    }
    for (const Word& word : words) check_use(word);
  }

 private:
  void complain(const Word& word, std::string why) {
    troubles_.push_back({&word, std::move(why)});
    block_.refused = true;
  }

  void take_g(const Word& word) {
    const int tenths = tenths_of(word.number);
    const Group group = group_of(tenths);
    const std::string name = code_text(word, tenths);
    const bool arc = tenths == 20 || tenths == 30;
    if (arc && !rules_.arcs)
      return complain(word,
                      name +
                          " is an arc: say how far chords may be from it (--arcs-mm; in a job "
                          "[program] arc_tolerance_um)");
    if (group == Group::none) {
      const std::string_view why = why_not_g(tenths);
      return complain(word, name + ' ' +
                                (why.empty() ? std::string("is not read: what it does is not known")
                                             : std::string(why)));
    }
    for (const int other : block_.g_tenths)
      if (group_of(other) == group || (is_cycle(other) && group == Group::motion) ||
          (is_cycle(tenths) && group_of(other) == Group::motion))
        return complain(word, name + " is in one block with another G code of its group: keep one");
    block_.g_tenths.push_back(tenths);
  }

  void take_m(const Word& word) {
    const int tenths = tenths_of(word.number);
    if (tenths < 0 || tenths % 10 != 0)
      return complain(word, code_text(word, tenths) + " is not an M code: M needs a whole number");
    if (const std::string_view why = why_not_m(tenths / 10); !why.empty())
      return complain(word, code_text(word, tenths) + ' ' + std::string(why));
    block_.m.push_back(tenths / 10);
  }

  void take(const Word& word) {
    const Word*& place = block_.by_letter[static_cast<std::size_t>(word.letter - 'A')];
    if (place != nullptr)
      return complain(word, std::string(1, word.letter) + " is twice in the block: keep one");
    place = &word;
    const std::size_t axis = axis_of(word.letter);
    const bool known = axis < axis_count && has(rules_.axes, axis);
    const bool dwell = word.letter == 'X' && block_.has_g(g_dwell);
    if ((axis < axis_count && !known && !dwell) ||
        std::string_view("UVW").find(word.letter) != std::string_view::npos)
      return complain(word, std::string(1, word.letter) +
                                " is not an axis of the machine, which has " +
                                names_of(rules_.axes));
    if (known) block_.named |= only(axis);
  }

  /// Letters that are parameters are next to their code.
  void check_use(const Word& word) {
    static constexpr std::string_view always = "NGMFSTHOXYZABCUVW";
    if (always.find(word.letter) != std::string_view::npos) return;
    const bool of_m = !block_.m.empty();
    if (word.letter == 'P' && block_.has_m(99))
      return complain(word, "P of M99 " + std::string(jump));
    const bool of_path = block_.has_g(640) || block_.has_g(610);
    const std::string_view letters = of_m                    ? "PQLRD"
                                     : of_path               ? "PQ"
                                     : block_.has_g(g_dwell) ? "P"
                                                             : "";
    const bool of_cycle = cycle_letters().find(word.letter) != std::string_view::npos;
    const bool of_arc =
        rules_.arcs && std::string_view("IJKR").find(word.letter) != std::string_view::npos;
    if (of_arc || of_cycle || letters.find(word.letter) != std::string_view::npos) return;
    if (block_.refused) return;  // a parameter of the code that was refused
    complain(word, word.letter == 'E'
                       ? std::string("E is an exponent or no word: write the number without one")
                       : std::string(1, word.letter) + " has no meaning that is known here");
  }

  /// Parameters of the canned cycle that the block carries out.
  std::string_view cycle_letters() const {
    int cycle = rules_.cycle;
    for (const int code : block_.g_tenths) {
      if (group_of(code) == Group::motion || code == 800) cycle = 0;
      if (is_cycle(code)) cycle = code / 10;
    }
    return cycle == 81 ? "RKL" : cycle == 82 ? "RPKL" : cycle == 83 ? "RQKL" : "";
  }

  const BlockRules& rules_;
  Block& block_;
  std::vector<WordTrouble>& troubles_;
};

}  // namespace

bool Block::has_g(int tenths) const {
  return std::ranges::find(g_tenths, tenths) != g_tenths.end();
}
bool Block::has_m(int m_code) const { return std::ranges::find(m, m_code) != m.end(); }

const Word* Block::centre_word() const {
  for (const char letter : {'I', 'J', 'K'})
    if (word(letter) != nullptr) return word(letter);
  return nullptr;
}

const Word& Block::first_axis_word() const {
  const Word* first = nullptr;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const Word* one = has(named, k) ? word(axis_letters[k]) : nullptr;
    if (one != nullptr && (first == nullptr || one < first)) first = one;
  }
  return *first;
}

void sort_words(std::span<const Word> words, const BlockRules& rules, Block& block,
                std::vector<WordTrouble>& troubles) {
  Sorter(rules, block, troubles).sort(words);
}

std::string names_of(AxisSet axes) {
  std::string text;
  for (std::size_t k = 0; k < axis_count; ++k) {
    if (!has(axes, k)) continue;
    if (!text.empty()) text += ' ';
    text += axis_letters[k];
  }
  return text;
}

}  // namespace trueaxis::nc
