// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/nominal_path.hpp"

#include <numeric>
#include <string_view>

#include "simulate/machine/tool_in_part.hpp"

namespace trueaxis::virtual_machine {
namespace {

/// Tips, and directions at 100 mm, where the machine without errors ends its moves: a compensation
/// moves them by the errors only, the axes at a pole by much more.
double apart_mm(const ToolInPart& a, const ToolInPart& b) {
  constexpr double lever_mm = 100.0;
  return distance_mm(a.tip_mm, b.tip_mm) + lever_mm * distance_mm(a.direction, b.direction);
}

/// Whether a block may be the other with other positions: what is no axis word (and no F, of which
/// pieces under G93 have their own) is the same.
bool same_but_for_axes(const BlockWords& a, const BlockWords& b) {
  const auto others = [](const BlockWords& block) {
    auto words = block.of_letter;
    std::erase_if(words, [](const auto& word) {
      return std::string_view("XYZABCF").find(word.first) != std::string_view::npos;
    });
    return words;
  };
  return a.g == b.g && a.m == b.m && others(a) == others(b);
}

/// Takes the blocks of the nominal program one after the other.
class Pairing {
 public:
  Pairing(const Machine& machine, std::span<const ControlMove> moves,
          std::span<const ControlMove> nominal)
      : moves_(moves), nominal_(nominal) {
    for (const ControlMove& move : moves)
      ends_.push_back(tool_in_part(machine, {}, move.to, move.setting));
    for (const ControlMove& move : nominal)
      nominal_ends_.push_back(tool_in_part(machine, {}, move.to, move.setting));
  }

  /// How many blocks were met.
  std::size_t pair(std::vector<std::size_t>& out) const {
    std::size_t j = 0;
    for (std::size_t i = 0; i < moves_.size() && j < nominal_.size(); ++i) {
      out[i] = j;
      if (ends(i, j)) ++j;
    }
    return j;
  }

 private:
  bool may_end(std::size_t i, std::size_t j) const {
    return same_but_for_axes(moves_[i].words, nominal_[j].words);
  }

  bool ends(std::size_t i, std::size_t j) const {
    if (moves_.size() - i == nominal_.size() - j || i + 1 == moves_.size()) return true;
    if (!may_end(i, j) || j + 1 == nominal_.size()) return false;
    for (std::size_t next = i + 1; next < moves_.size(); ++next) {
      if (may_end(next, j))
        return apart_mm(ends_[i], nominal_ends_[j]) <= apart_mm(ends_[next], nominal_ends_[j]);
      if (may_end(next, j + 1)) return true;
    }
    return true;
  }

  std::span<const ControlMove> moves_, nominal_;
  std::vector<ToolInPart> ends_, nominal_ends_;
};

}  // namespace

std::vector<std::size_t> nominal_moves_of(const Machine& machine,
                                          std::span<const ControlMove> moves,
                                          std::span<const ControlMove> nominal,
                                          const std::string& file) {
  std::vector<std::size_t> out(moves.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  if (moves.size() == nominal.size()) return out;
  const std::size_t met =
      moves.size() < nominal.size() ? moves.size() : Pairing(machine, moves, nominal).pair(out);
  if (met != nominal.size())
    throw InputError(file, "is no other form of the nominal program: of its " +
                               std::to_string(nominal.size()) + " moves " + std::to_string(met) +
                               " are met");
  return out;
}

}  // namespace trueaxis::virtual_machine
