// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/compensation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/counted.hpp"
#include "base/threads.hpp"
#include "compensate/between.hpp"
#include "compensate/block_end.hpp"
#include "compensate/largest_on_way.hpp"
#include "compensate/reservations.hpp"
#include "machine/held_axes.hpp"
#include "nc/mark.hpp"
#include "nc/timed_turns.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// Which rotary axes a move must not turn. A block that moves a rotary axis makes its change, which
/// stays until the next one that does. An axis that the program does not move therefore does not
/// move. Before the first block the axes are where [program] start has them, and else at the word
/// 0: what the program never moves from there is not changed at all.
class RotaryHold {
 public:
  explicit RotaryHold(const CompensationTask& task);

  /// Axes that move `i` of the program does not turn, with the change that they keep.
  HeldAxes of(std::size_t i) const;

 private:
  using Since = std::array<std::uint32_t, 3>;  ///< of A B C: the move that turned it last
  void find_turns(const CompensationTask& task);
  void make_changes(const CompensationTask& task);

  std::vector<Since> since_;
  std::unordered_map<std::uint32_t, AxisPositions> changes_;  ///< of moves that later ones keep
};

constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();
constexpr double same_rad = 1e-12;

RotaryHold::RotaryHold(const CompensationTask& task) {
  if (task.options.rotary == RotaryUse::all) return;
  find_turns(task);
  make_changes(task);
}

void RotaryHold::find_turns(const CompensationTask& task) {
  const auto& moves = task.program.moves;
  if (moves.empty()) return;
  AxisPositions last = task.axes.rotary_start(task.program, moves.front().modal);
  Since since;
  since.fill(never);
  since_.reserve(moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const AxisPositions now = task.axes.rotary_positions(moves[i].words, moves[i].modal);
    for (std::size_t k = 3; k < axis_count; ++k)
      if (std::abs(now[k] - last[k]) > same_rad) since[k - 3] = static_cast<std::uint32_t>(i);
    since_.push_back(since);
    last = now;
  }
}

/// In the order of the program, for what a move changes may go with what one before it has changed.
void RotaryHold::make_changes(const CompensationTask& task) {
  std::vector<bool> is_kept(since_.size());
  for (std::size_t i = 0; i < since_.size(); ++i)
    for (const std::uint32_t turned : since_[i])
      if (turned != never && turned != i) is_kept[turned] = true;
  for (std::size_t i = 0; i < since_.size(); ++i) {
    if (!is_kept[i]) continue;
    const nc::Move& move = task.program.moves[i];
    const auto commanded = task.axes.positions(move.words, move.modal);
    AxisPositions change{};
    if (commanded) {
      const auto position =
          compensate_position(task, *commanded, task.axes.setting(move.modal), of(i));
      for (std::size_t k = 3; k < axis_count; ++k) change[k] = position.axes[k] - (*commanded)[k];
    }
    changes_.emplace(static_cast<std::uint32_t>(i), change);
  }
}

HeldAxes RotaryHold::of(std::size_t i) const {
  HeldAxes held;
  if (since_.empty()) return held;
  for (std::size_t k = 3; k < axis_count; ++k) {
    const std::uint32_t turned = since_[i][k - 3];
    if (turned == i) continue;
    held.hold(k, turned == never ? 0.0 : changes_.at(turned)[k]);
  }
  return held;
}

constexpr std::size_t moves_a_run = 512;  // that a thread takes at a time

/// Runs of moves on all threads; what they add up to is the same on any number of them.
template <class OfRun>
Tally in_runs(std::size_t moves, int threads, const OfRun& of_run) {
  std::vector<Tally> tallies((moves + moves_a_run - 1) / moves_a_run);
  for_each_index(tallies.size(), threads, [&](std::size_t run) {
    const std::size_t end = std::min(moves, (run + 1) * moves_a_run);
    for (std::size_t i = run * moves_a_run; i < end; ++i) of_run(run, i, tallies[run]);
  });
  Tally sum;
  for (const Tally& tally : tallies) sum.add(tally);
  return sum;
}

void expect_length_axis(const nc::Program& program, const ProgramAxes& axes) {
  std::vector<Diagnostic> wrong;
  for (const nc::Move& move : program.moves)
    if (axes.length_without_axis(move.modal) && wrong.empty())
      wrong.push_back({program.file, move.line + std::size_t{1}, 1,
                       "G43 adds the tool's length along the tool, and no linear axis of the "
                       "machine lies along it: use G43.4 or mode = \"tip\""});
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

constexpr double model_mm = 1e-9;     // rounding of the model
constexpr double decimals_mm = 1e-4;  // of one block: what the last of four decimals does

bool is_worse(double after_mm, double before_mm) {
  return after_mm > stated_to * before_mm + decimals_mm;
}

/// Every move in the order of the program with its pieces before it.
class NewProgram {
 public:
  explicit NewProgram(const CompensationTask& task)
      : task_(task), moves_(task.program.moves), hold_(task), worse_(moves_.size()) {}

  ProgramCompensation make() {
    Tally tally = compensate();
    ProgramCompensation out = std::move(tally.sums);
    out.blocks_read = task_.program.blocks;
    out.blocks_moved =
        static_cast<std::size_t>(std::ranges::count(moves_, false, &nc::Move::inserted));
    rank(out, tally);
    state_skipped(out.remarks);
    list_worse(out.worse);
    out.reservations = reservations_of(task_.program, task_.options, out);
    if (task_.options.keep_ends) keep_ends(out);
    if (out.unreachable.empty()) write(out);
    return out;
  }

  /// Lines of blocks that turn rotary axes alone and that also move X Y Z in the new program: F is
  /// °/min before and mm/min then.
  const std::vector<std::uint32_t>& turns() const { return turns_; }

 private:
  Tally compensate() {
    std::ranges::fill(worse_, 0);
    Tally tally = compensate_ends();
    if (tally.sums.unreachable.empty()) tally.add(compensate_ways());
    return tally;
  }

  Tally compensate_ends() {
    ends_.resize(moves_.size());
    return in_runs(moves_.size(), task_.options.threads,
                   [&](std::size_t, std::size_t i, Tally& tally) {
                     ends_[i] = compensate_end(task_, moves_[i], hold_.of(i), tally);
                   });
  }

  Tally compensate_ways() {
    pieces_.assign((moves_.size() + moves_a_run - 1) / moves_a_run, {});
    return in_runs(moves_.size(), task_.options.threads,
                   [&](std::size_t run, std::size_t i, Tally& tally) {
                     take_way(i, pieces_[run], tally);
                     pieces_[run].push_back(
                         {static_cast<std::uint32_t>(i), moves_[i].inserted, ends_[i].words});
                   });
  }

  void take_way(std::size_t i, std::vector<nc::NewPosition>& pieces, Tally& tally) {
    const nc::Move& move = moves_[i];
    const BlockEnd& end = ends_[i];
    worse_[i] = is_worse(end.after_mm, end.before_mm);
    if (!move.continues || move.modal.motion == nc::Motion::rapid) return;
    const nc::ModalState& last = moves_[i - 1].modal;
    const bool same_setting =
        last.work_offset == move.modal.work_offset && last.tool == move.modal.tool;
    const BlockPath path(task_, move, ends_[i - 1], end, same_setting, hold_.of(i));
    const std::size_t line = task_.line_of(move);
    LargestInProgram &before = tally.sums.between_before, &after = tally.sums.between_after;
    double before_mm = path.deviation_before_mm(before.value);
    take(before, before_mm, line);
    const double of_interest_mm = std::min(after.value, std::max(before_mm, end.before_mm));
    const auto& tolerance_mm = task_.options.tolerance_mm;
    double deviation_mm = path.deviation_after_mm(
        tolerance_mm ? std::min(0.9 * *tolerance_mm, of_interest_mm) : of_interest_mm);
    if (tolerance_mm)
      for (const nc::AxisValues& words : path.split(*tolerance_mm, deviation_mm, tally))
        pieces.push_back({static_cast<std::uint32_t>(i), true, words});
    take(after, deviation_mm, line);
    if (!is_worse(deviation_mm, std::max(before_mm, end.before_mm))) return;
    // If the block's own way leaves the line further than the errors do, on a machine without
    // errors too, it is the program's and not the compensation's.
    if (path.deviation_nominal_mm() > std::max(ends_[i - 1].before_mm, end.before_mm)) return;
    before_mm = std::max(path.deviation_before_mm(0.0), end.before_mm);
    worse_[i] = worse_[i] != 0 || is_worse(deviation_mm, before_mm);
  }

  void list_worse(std::vector<std::size_t>& lines) const {
    for (std::size_t i = 0; i < moves_.size(); ++i)
      if (worse_[i] != 0 && (lines.empty() || lines.back() != task_.line_of(moves_[i])))
        lines.push_back(task_.line_of(moves_[i]));
  }

  void rank(ProgramCompensation& out, const Tally& tally) const {
    for (std::size_t i = 0; i < tally.by_error.size(); ++i)
      out.by_error.push_back({task_.by_error.names()[i], tally.by_error[i]});
    std::ranges::stable_sort(out.by_error, std::ranges::greater{},
                             [](const ErrorAlone& one) { return one.tip.value; });
    if (task_.uncertainty.stated()) out.u_tip = tally.u_tip;
  }

  void state_skipped(std::vector<std::string>& remarks) const {
    std::set<std::size_t> lines(task_.program.skippable_states.begin(),
                                task_.program.skippable_states.end());
    for (const nc::Move& move : moves_)
      if (task_.program.lines[move.line].skip != 0) lines.insert(move.line);
    if (lines.empty()) return;
    remarks.push_back(
        "run the new program with block skip off, as " +
        counted(lines.size(),
                "block that begins with '/' moves axes or changes what positions mean",
                "blocks that begin with '/' move axes or change what positions mean") +
        " (first in line " + std::to_string(*lines.begin() + 1) +
        "): TrueAxis assumes that the control carries them out");
  }

  void keep_ends(ProgramCompensation& out) const {
    out.ends.reserve(moves_.size());
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      if (!ends_[i].reached) continue;
      const nc::Move& move = moves_[i];
      const nc::ModalState& modal = move.modal;
      std::optional<AxisPositions> middle;
      if (move.arc != nc::Move::no_arc)
        middle = task_.axes.positions(task_.program.arcs[move.arc].after(move.chord + 0.5), modal);
      out.ends.push_back({task_.line_of(move), modal.motion == nc::Motion::rapid, move.continues,
                          task_.axes.mode(modal) == ProgramMode::tip, ends_[i].commanded,
                          ends_[i].written, middle, task_.axes.setting(modal)});
    }
  }

  void write(ProgramCompensation& out) {
    std::vector<nc::NewPosition> positions;
    positions.reserve(moves_.size());
    for (const auto& run : pieces_) positions.insert(positions.end(), run.begin(), run.end());
    find_turns(positions);
    if (!turns_.empty()) return;
    nc::Written written = nc::write_program(task_.program, positions, task_.write);
    const bool changed = written.rewritten + written.inserted > 0;
    out.text = changed ? nc::marked(std::move(written.text)) : std::move(written.text);
    out.blocks_rewritten = written.rewritten;
    out.blocks_inserted = written.inserted;
  }

  void find_turns(std::span<const nc::NewPosition> positions) {
    const auto written = [&](const nc::NewPosition& position) {
      return nc::as_written(moves_[position.move], position.words, task_.write);
    };
    for (std::size_t n = 1; n < positions.size(); ++n) {
      const std::size_t i = positions[n].move;
      const nc::ModalState& modal = moves_[i].modal;
      if (i == 0 || modal.motion != nc::Motion::feed || moves_[i].cycle ||
          modal.feed_mode == nc::FeedMode::inverse_time ||
          modal.work_offset != moves_[i - 1].modal.work_offset ||
          !turns_alone(moves_[i - 1].words, moves_[i].words) ||
          turns_alone(written(positions[n - 1]), written(positions[n])))
        continue;
      if (turns_.empty() || turns_.back() != moves_[i].line) turns_.push_back(moves_[i].line);
    }
  }

  const CompensationTask& task_;
  const std::vector<nc::Move>& moves_;
  RotaryHold hold_;
  std::vector<std::uint32_t> turns_;
  std::vector<char> worse_;  ///< by move: it came out worse
  std::vector<BlockEnd> ends_;
  std::vector<std::vector<nc::NewPosition>> pieces_;  ///< by run
};

}  // namespace

void CompensationOptions::validate() const {
  expects(!tolerance_mm || *tolerance_mm > 0.0, "a tolerance above 0");
  expects(!arc_tolerance_mm || *arc_tolerance_mm > 0.0, "a tolerance of arcs above 0");
  expects(decimals >= 0 && decimals <= 15 && angle_decimals >= 0 && angle_decimals <= 15,
          "0 to 15 decimals");
}

namespace {

/// The larger of both; of two alike that of the earlier line.
LargestInProgram larger(const LargestInProgram& a, const LargestInProgram& b) {
  if (a.line == 0 || b.line == 0) return a.line == 0 ? b : a;
  return b.value > a.value || (b.value == a.value && b.line < a.line) ? b : a;
}

std::string timed(const std::vector<std::uint32_t>& lines) {
  return "G93 has the time of " + counted(lines.size(), "block that turns", "blocks that turn") +
         " rotary axes alone (first in line " +
         std::to_string(*std::ranges::min_element(lines) + 1) +
         "): F is °/min there, and would be mm/min with X Y Z";
}

}  // namespace

LargestInProgram ProgramCompensation::off_before() const {
  return larger(before.position, between_before);
}
LargestInProgram ProgramCompensation::off_after() const {
  return larger(after.position, between_after);
}
bool ProgramCompensation::comes_out_worse() const {
  return !worse.empty() || off_after().value > stated_to * off_before().value + model_mm;
}
bool ProgramCompensation::direction_comes_out_worse() const {
  return after.direction.value > stated_to * before.direction.value + rounding.direction.value;
}

ProgramCompensation compensate_program(const MachineModel& model, std::string text,
                                       const std::string& file,
                                       const CompensationOptions& options) {
  options.validate();
  if (const auto line = nc::marked_line(text))
    throw InputError({Diagnostic{
        file, *line, 0,
        "the program was compensated already, and its errors would be "
        "subtracted twice: compensate the program that it was made from, by all errors together"}});
  const ProgramAxes axes(model.machine());
  const nc::ReadOptions read = axes.read_options(options.arc_tolerance_mm);
  nc::Program program = nc::read_program(std::move(text), file, read);
  expect_length_axis(program, axes);
  std::vector<std::uint32_t> turned;
  while (true) {
    const CompensationTask task(model, program, options, axes);
    NewProgram made(task);
    ProgramCompensation out = made.make();
    if (made.turns().empty()) {
      if (!turned.empty()) out.remarks.push_back(timed(turned));
      return out;
    }
    turned.insert(turned.end(), made.turns().begin(), made.turns().end());
    program = nc::read_program(nc::with_timed_turns(program, made.turns()), file, read);
  }
}

}  // namespace trueaxis
