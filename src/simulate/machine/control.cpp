// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "simulate/machine/tool_in_part.hpp"

namespace trueaxis::virtual_machine {
namespace {

constexpr double rapid_per_min = 10000.0;  // mm or degrees
constexpr char letters[] = "XYZABC";

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
    check(block);
    put_in_force(block);
    if (block.has_g(4.0)) {
      for (const char letter : {'P', 'X'})
        if (block.has(letter)) clock_s_ += block.of_letter.at(letter);
    } else if (block.has_g(28.0) || block.has_g(30.0)) {
      go_home(block);
    } else if (has_axis_word(block)) {
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

  void check(const BlockWords& block) {
    static const std::set<double> known{0,  1,  4,    17, 18, 19, 20, 21, 28, 30,
                                        40, 43, 43.4, 49, 53, 54, 55, 56, 57, 58,
                                        59, 61, 64,   80, 90, 91, 93, 94, 95};
    for (const double code : block.g)
      if (!known.contains(code))
        complain(block,
                 fmt::format("this control has no G{:g}: give straight moves, arcs as chords "
                             "(compensate --arcs)",
                             code));
    for (const auto& [letter, value] : block.of_letter)
      if (std::string_view("EUVW").find(letter) != std::string_view::npos)
        complain(block, std::string("this control knows no ") + letter);
    for (std::size_t k = 0; k < axis_count; ++k)
      if (block.has(letters[k]) && !block.has_g(4.0) && !machine_.find(static_cast<AxisName>(k)))
        complain(block, std::string("the machine has no axis ") + letters[k]);
  }

  void put_in_force(const BlockWords& block) {
    for (const double code : block.g) {
      if (code <= 1.0) rapid_ = code == 0.0, motion_said_ = true;
      if (code == 20.0 || code == 21.0) unit_mm_ = code == 20.0 ? mm_per_inch : 1.0;
      if (code == 43.0 || code == 43.4 || code == 49.0) length_ = code;
      if (code >= 54.0 && code <= 59.0) offset_ = static_cast<std::size_t>(code - 54.0);
      if (code == 90.0 || code == 91.0) incremental_ = code == 91.0;
      if (code >= 93.0 && code <= 95.0) feed_mode_ = code;
    }
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

  /// With G43 the tip stands where, without a tool, the gauge point would.
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
    if (!motion_said_ && !machine_zero)
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
    if (tip_goes) to = axes_of_tip(machine_, tip, to, setting());
    move(block, to, tip_goes, machine_zero);
  }

  void go_home(const BlockWords& block) {
    AxisPositions to = stands_;
    for (std::size_t k = 0; k < axis_count; ++k)
      if (block.has(letters[k]) || !has_axis_word(block)) to[k] = 0.0;
    move(block, to, false, true);
  }

  void move(const BlockWords& block, const AxisPositions& to, bool tip_goes, bool leaves) {
    ControlMove made{block.line, rapid_ || leaves, leaves,   anew_, tip_goes, stands_,
                     to,         setting(),        clock_s_, 0.0,   block};
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
  bool rapid_ = false, motion_said_ = false, incremental_ = false, anew_ = true;
  double unit_mm_ = 1.0, length_ = 49.0, feed_mode_ = 94.0, feed_ = 0.0, speed_rpm_ = 0.0;
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
  if (!move.along_tip) return axes;
  const Vector3 from = tool_in_part(machine, {}, move.from, move.setting).tip_mm,
                to = tool_in_part(machine, {}, move.to, move.setting).tip_mm;
  Vector3 tip;
  for (std::size_t i = 0; i < 3; ++i) tip[i] = std::lerp(from[i], to[i], share);
  return axes_of_tip(machine, tip, axes, move.setting);
}

}  // namespace trueaxis::virtual_machine
