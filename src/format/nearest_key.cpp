// SPDX-License-Identifier: Apache-2.0
#include "format/nearest_key.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "format/units.hpp"

namespace trueaxis {
namespace {

/// Other words for a key, without their units: earlier names, and those of other files and fields.
struct OtherName {
  std::string_view other, here;
};
constexpr OtherName other_names[] = {
    {"sigma", "noise"},
    {"noise", "sigma"},
    {"kind", "surface"},
    {"surface", "kind"},
    {"bore", "feature"},
    {"feature", "bore"},
    {"diameter", "x_convention"},
    {"diameter", "radius"},
    {"length", "z_end"},
    {"z_length", "z_end"},
    {"bandwidth", "natural_frequency"},
    {"nose", "nose_radius"},
    {"x_start", "radius_start"},
    {"x_end", "radius_end"},
    {"z_face", "z"},
    {"file", "stream"},
};

bool ends_behind_a_mark(std::string_view whole, std::string_view end) {
  if (end.size() < 3 || whole.size() <= end.size() || !whole.ends_with(end)) return false;
  const char before = whole[whole.size() - end.size() - 1];
  return before == '_' || before == '.';
}

/// Smaller is nearer; 0 is the same but for its unit.
std::size_t distance(std::string_view word, std::string_view candidate) {
  if (candidate.starts_with(std::string(word) + '_')) return 0;
  const KeyParts said = parts_of_key(word), known = parts_of_key(candidate);
  const std::size_t letters = 2 * edit_distance(word, candidate);
  const bool unit_fits = said.unit.empty() || said.unit == known.unit;
  const bool other = std::ranges::any_of(other_names, [&](const OtherName& name) {
    return name.other == said.stem && name.here == known.stem;
  });
  const bool fits = other ? unit_fits || known.unit.empty()
                          : unit_fits && ends_behind_a_mark(known.stem, said.stem);
  return fits ? std::min<std::size_t>(letters, 3) : letters;
}

}  // namespace

std::string nearest_key(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = 2 * std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t found = distance(word, candidate);
    if (found < best_distance) {
      best_distance = found;
      best = candidate;
    }
  }
  return best;
}

}  // namespace trueaxis
