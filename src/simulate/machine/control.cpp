// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "simulate/machine/tool_in_part.hpp"

namespace trueaxis::virtual_machine {
namespace {

constexpr double rapid_per_min = 10000.0;  // mm or degrees
constexpr char letters[] = "XYZABC";

Vector3 linear_part(const AxisPositions& axes) { return {axes[0], axes[1], axes[2]}; }

class Control {
 public:
  Control(const Machine& machine, const std::string& file, std::vector<Diagnostic>& wrong)
      : machine_(machine), file_(file), wrong_(wrong) {
    for (const MachineAxis& axis : machine.axes) {
      const std::size_t k = index_of(axis.name);
      if (machine.start[k]) stands_[k] = *machine.start[k] + zero(k);
    }
    if (machine.mode != ProgramMode::tip || machine.linear_count() < 3) return;
    bool tip_said = true;
    Vector3 tip{};
    for (std::size_t k = 0; k < 3; ++k) {
      tip_said = tip_said && machine.start[k];
      tip[k] = machine.start[k].value_or(0.0);
    }
    if (tip_said) stands_ = axes_of_tip(machine, tip, stands_, setting());
  }

  /// Whether the program goes on.
  bool carry_out(const BlockWords& block) {
    const std::size_t before = wrong_.size();
    check(block);
    put_in_force(block);
    if (wrong_.size() > before) {
      // What it does is not known.
    } else if (block.has_g(4.0)) {
      for (const char letter : {'P', 'X'})
        if (block.has(letter)) clock_s_ += block.of_letter.at(letter);
    } else if (block.has_g(28.0) || block.has_g(30.0)) {
      go_home(block);
    } else if (cycle_ > 80.0 && !block.has_g(53.0)) {
      drill(block);
    } else if (has_axis_word(block) || (is_arc() && has_centre(block))) {
      go(block);
    }
    return !block.has_m(2.0) && !block.has_m(30.0) && !block.has_m(99.0);
  }

  std::vector<ControlMove> moves;

 private:
  void complain(const BlockWords& block, const std::string& why) {
    wrong_.push_back({file_, block.line, 0, why});
  }

  static bool has_axis_word(const BlockWords& block) {
    return std::any_of(letters, letters + axis_count,
                       [&](char letter) { return block.has(letter); });
  }

  bool is_arc() const { return motion_ == 2 || motion_ == 3; }
  static bool has_centre(const BlockWords& block) {
    return block.has('I') || block.has('J') || block.has('K');
  }

  void check(const BlockWords& block) {
    static const std::set<double> known{0,  2,  3,    1,  4,  17, 18, 19, 20, 21, 28, 30,
                                        40, 43, 43.4, 49, 53, 54, 55, 56, 57, 58, 59, 61,
                                        64, 80, 81,   82, 83, 90, 91, 93, 94, 95, 98, 99};
    for (const double code : block.g)
      if (!known.contains(code)) complain(block, fmt::format("this control has no G{:g}", code));
    for (const auto& [letter, value] : block.of_letter)
      if (std::string_view("EUVW").find(letter) != std::string_view::npos)
        complain(block, std::string("this control knows no ") + letter);
    for (std::size_t k = 0; k < axis_count; ++k)
      if (block.has(letters[k]) && !block.has_g(4.0) && !machine_.find(static_cast<AxisName>(k)))
        complain(block, std::string("the machine has no axis ") + letters[k]);
  }

  void put_in_force(const BlockWords& block) {
    const double cycle_before = cycle_;
    for (const double code : block.g) {
      if (code <= 3.0) motion_ = static_cast<int>(code);
      if (code <= 3.0 || code == 80.0) cycle_ = 80.0;
      if (code >= 81.0 && code <= 83.0) cycle_ = code;
      if (code == 98.0 || code == 99.0) back_to_r_ = code == 99.0;
      if (code >= 17.0 && code <= 19.0) plane_ = static_cast<int>(code);
      if (code == 20.0 || code == 21.0) unit_mm_ = code == 20.0 ? mm_per_inch : 1.0;
      if (code == 43.0 || code == 43.4 || code == 49.0) length_ = code;
      if (code >= 54.0 && code <= 59.0) offset_ = static_cast<std::size_t>(code - 54.0);
      if (code == 90.0 || code == 91.0) incremental_ = code == 91.0;
      if (code >= 93.0 && code <= 95.0) feed_mode_ = code;
    }
    if (cycle_before == 80.0 && cycle_ != 80.0) from_level_mm_ = lead()[2];
    if (block.has('F')) feed_ = block.of_letter.at('F');
    if (block.has('S')) speed_rpm_ = block.of_letter.at('S');
    if (block.has('T')) selected_ = static_cast<int>(block.of_letter.at('T'));
    anew_ = anew_ || block.has('O');  // a program that begins
    if (!block.has_m(6.0)) return;
    anew_ = anew_ || tool_ != selected_;
    tool_ = selected_;
  }

  double zero(std::size_t k) const {
    return machine_.work_offsets[offset_] ? machine_.work_offsets[offset_]->zero[k] : 0.0;
  }

  Setting setting() const {
    Setting out;
    if (machine_.work_offsets[offset_])
      out.bed_from_program = machine_.work_offsets[offset_]->bed_from_program;
    const auto length = machine_.tool_lengths_mm.find(tool_);
    out.tool_length_mm =
        length == machine_.tool_lengths_mm.end() ? machine_.tool.length_mm : length->second;
    return out;
  }

  bool along_tip() const { return machine_.mode == ProgramMode::tip || length_ == 43.4; }

  double value_of(const BlockWords& block, std::size_t k) const {
    return block.of_letter.at(letters[k]) * (k < 3 ? unit_mm_ : rad_per_deg);
  }

  /// With G43 the tip is where, without a tool, the gauge point would be.
  double length_on(std::size_t k) const {
    if (length_ != 43.0) return 0.0;
    const Vector3 &way = machine_.find(static_cast<AxisName>(k))->direction,
                  &tool = machine_.tool.direction;
    const double cosine = way[0] * tool[0] + way[1] * tool[1] + way[2] * tool[2];
    const double length_mm = setting().tool_length_mm;
    return cosine > 1.0 - 1e-9 ? length_mm : cosine < -1.0 + 1e-9 ? -length_mm : 0.0;
  }

  void go(const BlockWords& block) {
    const bool machine_zero = block.has_g(53.0);
    if (motion_ < 0 && !machine_zero)
      return complain(block, "axis words before G0 or G1: say how to move");
    if (machine_zero && incremental_) return complain(block, "G53 under G91: write it under G90");
    const bool tip_goes = along_tip() && !machine_zero;
    AxisPositions to = stands_;
    Vector3 tip{};
    if (tip_goes) tip = tool_in_part(machine_, {}, stands_, setting()).tip_mm;
    for (std::size_t k = 0; k < axis_count; ++k) {
      if (!block.has(letters[k]) || !machine_.find(static_cast<AxisName>(k))) continue;
      const double value = value_of(block, k);
      if (tip_goes && k < 3)
        tip[k] = incremental_ ? tip[k] + value : value;
      else if (incremental_)
        to[k] += value;
      else
        to[k] = machine_zero ? value : value + zero(k) + (k < 3 ? length_on(k) : 0.0);
    }
    std::optional<ArcWay> arc;
    if (is_arc() && !machine_zero) {
      const Vector3 from =
          tip_goes ? tool_in_part(machine_, {}, stands_, setting()).tip_mm : linear_part(stands_);
      arc = arc_of(block, unit_mm_, plane_, motion_ == 2, from, tip_goes ? tip : linear_part(to));
      if (!arc) return complain(block, "the arc has no centre: give I J K in its plane, or R");
    }
    if (tip_goes) to = axes_of_tip(machine_, tip, to, setting());
    move(block, to, tip_goes, machine_zero, arc);
  }

  /// X Y Z of the words for the machine's position: the tip, or the words of the axes.
  Vector3 lead() const {
    if (along_tip()) return tool_in_part(machine_, {}, stands_, setting()).tip_mm;
    Vector3 out = linear_part(stands_);
    for (std::size_t k = 0; k < 3; ++k)
      if (machine_.find(static_cast<AxisName>(k)) != nullptr) out[k] -= zero(k) + length_on(k);
    return out;
  }

  /// A straight move of a cycle, as a block of its own words would make it.
  void step(const BlockWords& block, const Vector3& to, double code) {
    BlockWords words = block;
    words.g = {code};
    for (const char letter : {'A', 'B', 'C', 'I', 'J', 'K', 'L', 'P', 'Q', 'R'})
      words.of_letter.erase(letter);
    for (std::size_t k = 0; k < 3; ++k) words.of_letter[letters[k]] = to[k] / unit_mm_;
    const bool incremental = std::exchange(incremental_, false);
    motion_ = static_cast<int>(code);
    go(words);
    incremental_ = incremental;
  }

  /// G81, G82, G83: above the hole, to R, down, back; below R first up to it.
  void drill(const BlockWords& block) {
    const auto mm = [&](char letter) { return unit_mm_ * block.of_letter.at(letter); };
    if (block.has('R')) r_word_mm_ = mm('R');
    if (block.has('Z')) z_word_mm_ = mm('Z');
    const double r_mm = r_word_mm_ + (incremental_ ? from_level_mm_ : 0.0),
                 bottom_mm = z_word_mm_ + (incremental_ ? r_mm : 0.0);
    if (block.has('Q')) peck_mm_ = mm('Q');
    if (block.has('P')) dwell_s_ = block.of_letter.at('P');
    if (!block.has('X') && !block.has('Y') && !block.has('Z') && !block.has('R')) return;
    if (plane_ != 17 || !(bottom_mm < r_mm) || (cycle_ == 83.0 && !(peck_mm_ > 0.0)))
      return complain(block, "a cycle in G18 or G19, with Z above R, or G83 without Q");
    Vector3 at = lead();
    const auto to_level = [&](double level_mm, double code) {
      if (std::fabs(at[2] - level_mm) < 1e-12) return;
      at[2] = level_mm;
      step(block, at, code);
    };
    const double repeats = block.has('K')   ? block.of_letter.at('K')
                           : block.has('L') ? block.of_letter.at('L')
                                            : 1.0;
    if (at[2] < r_mm) to_level(r_mm, 0.0);
    for (int hole = 0; hole < static_cast<int>(repeats); ++hole) {
      const Vector3 last = at;
      for (std::size_t k = 0; k < 2; ++k)
        if (block.has(letters[k])) at[k] = mm(letters[k]) + (incremental_ ? at[k] : 0.0);
      if (hole == 0 || at != last) step(block, at, 0.0);
      to_level(r_mm, 0.0);
      double depth = r_mm;
      while (depth > bottom_mm) {
        if (depth < r_mm) {
          constexpr double clearance_mm = 0.254;
          to_level(r_mm, 0.0);
          to_level(std::fmin(depth + clearance_mm, r_mm), 0.0);
        }
        depth = cycle_ == 83.0 ? std::fmax(depth - peck_mm_, bottom_mm) : bottom_mm;
        to_level(depth, 1.0);
      }
      if (cycle_ == 82.0) clock_s_ += dwell_s_;
      to_level(back_to_r_ ? r_mm : std::fmax(from_level_mm_, r_mm), 0.0);
    }
  }

  void go_home(const BlockWords& block) {
    AxisPositions to = stands_;
    for (std::size_t k = 0; k < axis_count; ++k)
      if (block.has(letters[k]) || !has_axis_word(block)) to[k] = 0.0;
    move(block, to, false, true, {});
  }

  void move(const BlockWords& block, const AxisPositions& to, bool tip_goes, bool leaves,
            const std::optional<ArcWay>& arc) {
    ControlMove made{block.line, motion_ <= 0 || leaves,
                     leaves,     anew_,
                     tip_goes,   stands_,
                     to,         setting(),
                     clock_s_,   0.0,
                     arc,        block};
    made.duration_s = duration_s(block, made);
    clock_s_ += made.duration_s;
    stands_ = to;
    anew_ = leaves;
    moves.push_back(std::move(made));
  }

  double duration_s(const BlockWords& block, const ControlMove& made) {
    double way = distance_mm(tool_in_part(machine_, {}, made.from, made.setting).tip_mm,
                             tool_in_part(machine_, {}, made.to, made.setting).tip_mm);
    double unit = unit_mm_;
    if (made.arc)
      way = made.arc->length_mm(made.along_tip
                                    ? tool_in_part(machine_, {}, made.from, made.setting).tip_mm
                                    : linear_part(made.from));
    if (way < 1e-9) {
      unit = 1.0;
      for (std::size_t k = 3; k < axis_count; ++k)
        way = std::fmax(way, std::fabs(made.to[k] - made.from[k]) / rad_per_deg);
    }
    if (made.rapid) return 60.0 * way / rapid_per_min;
    if (way == 0.0) return 0.0;
    const double feed = feed_mode_ == 95.0 ? feed_ * speed_rpm_ : feed_;
    if (!(feed > 0.0)) {
      complain(block, "a G1 without feed: give F, under G95 S as well");
      return 0.0;
    }
    return feed_mode_ == 93.0 ? 60.0 / feed : 60.0 * way / (feed * unit);
  }

  const Machine& machine_;
  const std::string& file_;
  std::vector<Diagnostic>& wrong_;
  AxisPositions stands_{};
  bool incremental_ = false, anew_ = true;
  int motion_ = -1, plane_ = 17;  ///< -1: no G0 … G3 yet
  double unit_mm_ = 1.0, length_ = 49.0, feed_mode_ = 94.0, feed_ = 0.0, speed_rpm_ = 0.0;
  double cycle_ = 80.0, from_level_mm_ = 0.0, r_word_mm_ = 0.0, z_word_mm_ = 0.0, peck_mm_ = 0.0,
         dwell_s_ = 0.0;  ///< of canned cycles
  bool back_to_r_ = false;
  std::size_t offset_ = 0;
  int tool_ = 0, selected_ = 0;
  double clock_s_ = 0.0;
};

}  // namespace

std::vector<ControlMove> moves_of_program(const Machine& machine, std::string_view program,
                                          const std::string& file) {
  std::vector<Diagnostic> wrong;
  Control control(machine, file, wrong);
  for (const BlockWords& block : words_of_blocks(program, file, wrong))
    if (!control.carry_out(block)) break;
  if (!wrong.empty()) {
    std::ranges::stable_sort(wrong, {}, &Diagnostic::line);
    throw InputError(std::move(wrong));
  }
  return std::move(control.moves);
}

AxisPositions axes_on_way(const Machine& machine, const ControlMove& move, double share) {
  AxisPositions axes;
  for (std::size_t k = 0; k < axis_count; ++k) axes[k] = std::lerp(move.from[k], move.to[k], share);
  if (!move.along_tip && !move.arc) return axes;
  const auto of = [&](const AxisPositions& at) {
    return move.along_tip ? tool_in_part(machine, {}, at, move.setting).tip_mm : linear_part(at);
  };
  const Vector3 from = of(move.from), to = of(move.to);
  Vector3 there;
  for (std::size_t i = 0; i < 3; ++i) there[i] = std::lerp(from[i], to[i], share);
  if (move.arc) there = move.arc->put_on_arc(there, from, to, share);
  if (move.along_tip) return axes_of_tip(machine, there, axes, move.setting);
  std::ranges::copy(there, axes.begin());
  return axes;
}

}  // namespace trueaxis::virtual_machine
