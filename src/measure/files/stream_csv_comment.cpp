// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <span>
#include <vector>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "measure/files/stream_csv_metadata.hpp"

namespace trueaxis {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::string_view conventions[] = {"radius", "diameter", "dia", "radial"};
constexpr std::string_view indications[] = {"absolute", "relative"};
constexpr std::string_view sides[] = {"front", "rear"};
constexpr std::string_view features[] = {"shaft", "bore"};

/// How much must be there before a text counts as a key.
enum class Looks {
  like_a_key,    ///< no prose begins so: its words are enough before ':' or '=', else with a value
  like_a_word,   ///< an ordinary word: ':' or '=', and a value of the key's kind
  like_reading,  ///< the key `reading` itself, which is an ordinary word as well
};

/// A folded key (small letters, nothing but letters and digits) and how it is written.
struct Known {
  std::string_view folded, key, example;
  Words values{};  ///< empty: a number
  Looks looks = Looks::like_a_key;
};

constexpr Known known_keys[] = {
    {"xconvention", "x_convention", "diameter", conventions},
    {"reading", "reading", "relative", indications, Looks::like_reading},
    {"nominalradius", "nominal_radius", "14.5 mm"},
    {"sensornoise", "sensor_noise", "2 um"},
    {"spindlerpm", "spindle_rpm", "60"},
    {"ballradius", "ball_radius", "1.5 mm"},
    {"sensorangles", "sensor_angles", "0, 99, 202 deg"},
    {"feature", "feature", "bore", features, Looks::like_a_word},
    {"setupreindex", "setup.2.reindex", "70 deg"},
    {"setupzshift", "setup.2.z_shift", "12 mm"},
    {"setupxjog", "setup.2.x_jog", "0.1 mm"},
    {"setupclampforceratio", "setup.2.clamp_force_ratio", "0.6"},
    {"setupside", "setup.2.side", "rear", sides},
    // What others call them.
    {"xmconvention", "x_convention", "diameter", conventions},
    {"convention", "x_convention", "diameter", conventions, Looks::like_a_word},
    {"nominaldiameter", "nominal_radius", "14.5 mm"},
    {"noise", "sensor_noise", "2 um", {}, Looks::like_a_word},
    {"noiselevel", "sensor_noise", "2 um"},
    {"noiseum", "sensor_noise", "2 um", {}, Looks::like_a_word},
    {"noisemm", "sensor_noise", "0.002 mm", {}, Looks::like_a_word},
    {"sigma", "sensor_noise", "2 um", {}, Looks::like_a_word},
    {"rpm", "spindle_rpm", "60", {}, Looks::like_a_word},
    {"spindlespeed", "spindle_rpm", "60"},
    {"balldiameter", "ball_radius", "1.5 mm"},
    {"tipradius", "ball_radius", "1.5 mm"},
    {"tipdiameter", "ball_radius", "1.5 mm"},
    {"stylusradius", "ball_radius", "1.5 mm"},
    {"stylusdiameter", "ball_radius", "1.5 mm"},
    {"proberadius", "ball_radius", "1.5 mm"},
    {"probediameter", "ball_radius", "1.5 mm"},
    {"probeballradius", "ball_radius", "1.5 mm"},
    {"sensoranglesdeg", "sensor_angles", "0, 99, 202 deg"},
    {"sensoranglesrad", "sensor_angles", "0, 1.728, 3.526 rad"},
    {"probeangles", "sensor_angles", "0, 99, 202 deg"},
    {"probeanglesdeg", "sensor_angles", "0, 99, 202 deg"},
    {"anglesdeg", "sensor_angles", "0, 99, 202 deg"},
    {"angles", "sensor_angles", "0, 99, 202 deg", {}, Looks::like_a_word},
    {"reindex", "setup.2.reindex", "70 deg", {}, Looks::like_a_word},
    {"zshift", "setup.2.z_shift", "12 mm", {}, Looks::like_a_word},
    {"xjog", "setup.2.x_jog", "0.1 mm", {}, Looks::like_a_word},
    {"clampforceratio", "setup.2.clamp_force_ratio", "0.6"},
    {"side", "setup.2.side", "rear", sides, Looks::like_a_word},
};

constexpr std::string_view convention_words[] = {"radius",      "radii",        "diameter",
                                                 "diameters",   "diametre",     "dia",
                                                 "durchmesser", "diametermode", "radiusmode"};
constexpr std::string_view unit_keys[] = {"unit",       "units",       "einheit",   "einheiten",
                                          "lengthunit", "lengthunits", "angleunit", "angleunits",
                                          "unitlength", "unitangle",   "uom"};
constexpr std::string_view fillers[] = {
    "all",    "in",      "is",     "are",    "a",     "the",        "and",     "as",
    "values", "lengths", "length", "angles", "angle", "dimensions", "xm",      "zm",
    "x",      "c",       "z",      "t",      "mode",  "readings",   "measured"};

bool one_of(Words words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

/// Small letters and digits only; bytes beyond ASCII stay.
std::string letters_of(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80U) out += c;
    if (byte < 0x80U && std::isalnum(byte) != 0) out += lower_case(c);
  }
  return out;
}

/// A word of a comment, and whether ':' or '=' follows it.
struct Word {
  std::string folded;
  bool assigned = false;
  std::string_view written;  ///< the text up to and with this word
};

std::vector<Word> words_of(std::string_view text) {
  constexpr std::string_view blanks = " \t\r,;", signs = ":=";
  std::vector<Word> words;
  text = trimmed(text);
  for (std::size_t at = 0; at < text.size();) {
    const bool sign = signs.find(text[at]) != std::string_view::npos;
    if (sign && !words.empty()) words.back().assigned = true;
    if (sign || blanks.find(text[at]) != std::string_view::npos) {
      ++at;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \t\r,;:=", at), text.size());
    std::string word = letters_of(text.substr(at, end - at));
    if (!word.empty()) words.push_back({std::move(word), false, text.substr(0, end)});
    at = end;
  }
  return words;
}

/// Whether words[at …] is a value of the key: a number, or one of its words.
bool is_value(const Known& known, std::span<const Word> words) {
  while (!words.empty() && (words[0].folded == "is" || words[0].folded == "a"))
    words = words.subspan(1);
  if (words.empty()) return false;
  if (!known.values.empty()) return one_of(known.values, words[0].folded);
  const std::string_view first = words[0].written;
  const std::size_t begin = first.find_last_of(" \t\r,;:=");
  return starts_number(first.substr(begin == std::string_view::npos ? 0 : begin + 1));
}

bool looks_like(const Known& known, const std::string& key, const Word& last,
                std::span<const Word> value) {
  const std::size_t distance = edit_distance(key, known.folded);
  const bool valued = is_value(known, value);
  switch (known.looks) {
    case Looks::like_a_key:
      return distance <= 2 && (last.assigned || valued);
    case Looks::like_a_word:
      return distance == 0 && last.assigned && valued;
    case Looks::like_reading:
      if (distance == 0 && last.assigned) return true;
      return distance <= 2 && valued && value.size() == 1;
  }
  return false;
}

/// The line as it should be, with the value that was written: another one in its place would be
/// copied.
std::string quoted_line(const Known& known, std::string_view value) {
  return std::string("'# ")
      .append(known.key)
      .append(": ")
      .append(value.empty() ? known.example : value)
      .append("'");
}

/// The word that was assigned at `n`; empty if nothing was, or a number, whose unit or meaning may
/// be that of another key.
std::string_view value_after(std::span<const Word> words, std::size_t n) {
  if (!words[n].assigned || n + 1 == words.size()) return {};
  const std::string_view rest = words.back().written.substr(words[n].written.size());
  const std::size_t begin = rest.find_first_not_of(" \t:=");
  if (begin == std::string_view::npos || rest.find_first_of("0123456789") != std::string_view::npos)
    return {};
  return rest.substr(begin);
}

/// The known key that the first words look like, and how they are written.
std::string misspelt(std::span<const Word> words) {
  constexpr std::size_t most_words = 5;
  std::string key;
  for (std::size_t n = 0; n < std::min(most_words, words.size()); ++n) {
    key += words[n].folded;
    std::string bare = key;  // "setup 2 reindex": of whichever set-up
    if (bare.starts_with("set"))
      std::erase_if(bare, [](unsigned char c) { return std::isdigit(c) != 0; });
    for (const Known& known : known_keys) {
      if (!looks_like(known, bare, words[n], words.subspan(n + 1))) continue;
      const std::string_view written = words[n].written;
      const std::string wrong = written == known.key
                                    ? csv_quoted(written) + " needs ':' after it: write "
                                    : csv_quoted(written) + " is not a key, did you mean " +
                                          csv_quoted(known.key) + "? Write ";
      return wrong + quoted_line(known, value_after(words, n)) + ", or '##' before free text";
    }
  }
  return "";
}

/// A length or an angle that no other word of a comment is: "in" and "meter" may be.
bool says_unit(const std::string& word) {
  constexpr std::string_view units[] = {"mm", "um", "in", "deg", "rad"};
  const auto unit = unit_of_word(word, "*");
  return unit && word != "in" && one_of(units, *unit);
}

constexpr const char* unit_place =
    " is not read from a comment: the unit of a column belongs in the header, as in X_M[in],C[deg]";
constexpr const char* convention_place =
    " is not read from a comment: write '# x_convention: radius' or '# x_convention: diameter' "
    "(or X_M[mm dia]); of a gauge '# nominal_radius: 14.5 mm'";

/// A unit or convention of the whole file: as a key, or a comment of nothing else.
std::string of_whole_file(std::span<const Word> words, std::string_view text) {
  const Word& first = words.front();
  const auto is_unit = [](const Word& word) { return says_unit(word.folded); };
  const auto is_convention = [](const Word& word) { return one_of(convention_words, word.folded); };
  const auto is_unit_key = [](const Word& word) { return one_of(unit_keys, word.folded); };
  const std::string free = "; write '##' before free text";
  if (first.assigned && (is_unit_key(first) || is_unit(first)))
    return csv_quoted(first.written) + unit_place + free;
  if (first.assigned && is_convention(first))
    return csv_quoted(first.written) + convention_place + free;
  const bool nothing_else = std::ranges::all_of(words, [&](const Word& word) {
    return is_unit(word) || is_convention(word) || is_unit_key(word) ||
           one_of(fillers, word.folded);
  });
  if (!nothing_else) return "";
  if (std::ranges::any_of(words, is_convention)) return csv_quoted(text) + convention_place + free;
  if (std::ranges::any_of(words, is_unit)) return csv_quoted(text) + unit_place + free;
  return "";
}

}  // namespace

std::string csv_comment_trouble(std::string_view bytes) {
  const std::string utf8 = csv_utf8(bytes);
  const std::string_view text = trimmed(utf8);
  if (text.starts_with('#')) return "";
  const std::vector<Word> words = words_of(text);
  if (words.empty()) return "";
  const std::string wrong = misspelt(words);
  return wrong.empty() ? of_whole_file(words, text) : wrong;
}

}  // namespace trueaxis
