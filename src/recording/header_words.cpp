// SPDX-License-Identifier: Apache-2.0
#include "recording/header_words.hpp"

#include <map>
#include <set>
#include <vector>

#include "format/csv_text.hpp"
#include "format/folded.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using enum HeaderMeaning;

struct HeaderWords {
  std::string_view language;  ///< ISO 639; empty: of all
  HeaderMeaning meaning;
  std::string_view words;  ///< between blanks, as people write them: case and accents do not count
};

/// What columns are called. To add a language, add its lines; two words may be written as one
/// (Spindelwinkel), so parts of such words are words of their own.
constexpr HeaderWords header_words[] = {
    {"", axis, "x y z c xm"},
    {"", face, "zm"},
    {"", radius, "r"},
    {"", diameter, "ø ⌀ ∅"},
    {"", angle, "θ theta"},
    {"", time, "t"},
    {"en", axis, "axial"},
    {"en", radius, "radius"},
    {"en", diameter, "diameter dia diam"},
    {"en", angle, "angle angular ang rotation"},
    {"en", time, "time timestamp elapsed seconds"},
    {"en", gauge, "indicator gauge gage runout"},
    {"en", pass, "pass"},
    {"en", setup, "setup"},
    {"en", position, "position pos length height depth"},
    {"en", filler, "axis act actual spindle measured value reading machine probe of the in at"},
    {"de", axis, "axial"},
    {"de", radius, "radius halbmesser"},
    {"de", diameter, "durchmesser"},
    {"de", angle, "winkel drehwinkel"},
    {"de", time, "zeit uhrzeit zeitstempel messzeit"},
    {"de", gauge, "messuhr rundlauf messtaster"},
    {"de", pass, "durchgang"},
    {"de", setup, "aufspannung"},
    {"de", position, "position pos lage stellung länge höhe tiefe"},
    {"de", filler, "achse ist istwert wert spindel gemessen mess messwert maschine der die des in"},
    {"fr", axis, "axial axiale"},
    {"fr", radius, "rayon"},
    {"fr", diameter, "diamètre"},
    {"fr", angle, "angle angulaire rotation"},
    {"fr", time, "temps heure horodatage"},
    {"fr", gauge, "comparateur"},
    {"fr", pass, "passe"},
    {"fr", position, "position longueur hauteur profondeur"},
    {"fr", filler, "axe valeur broche mesure mesuré mesurée réel réelle de du des la le en"},
    {"it", axis, "assiale"},
    {"it", radius, "raggio"},
    {"it", diameter, "diametro"},
    {"it", angle, "angolo angolare rotazione"},
    {"it", time, "tempo ora orario"},
    {"it", gauge, "comparatore"},
    {"it", pass, "passata"},
    {"it", position, "posizione pos lunghezza altezza profondità"},
    {"it", filler, "asse valore mandrino misura misurato misurata reale di del della il la in"},
    {"es", axis, "axial"},
    {"es", radius, "radio"},
    {"es", diameter, "diámetro"},
    {"es", angle, "ángulo angular rotación giro"},
    {"es", time, "tiempo hora"},
    {"es", gauge, "comparador"},
    {"es", pass, "pasada"},
    {"es", position, "posición pos longitud altura profundidad"},
    {"es", filler, "eje valor husillo medido medida real de del la el en"},
    {"pt", radius, "raio"},
    {"pt", diameter, "diâmetro"},
    {"pt", angle, "ângulo angular rotação"},
    {"pt", time, "tempo hora"},
    {"pt", position, "posição comprimento altura profundidade"},
    {"pt", filler, "eixo valor fuso medido medida real de do da em"},
    {"pl", radius, "promień"},
    {"pl", diameter, "średnica"},
    {"pl", angle, "kąt"},
    {"pl", time, "czas godzina"},
    {"pl", position, "pozycja położenie długość wysokość głębokość"},
    {"pl", filler, "oś osi wartość wrzeciona wrzeciono zmierzona zmierzony"},
    {"cs", radius, "poloměr"},
    {"cs", diameter, "průměr"},
    {"cs", angle, "úhel"},
    {"cs", time, "čas"},
    {"cs", position, "poloha pozice délka výška hloubka"},
    {"cs", filler, "osa osy hodnota vřetena vřeteno měřený měřená"},
    {"ja", radius, "半径"},
    {"ja", diameter, "直径"},
    {"ja", angle, "角度 回転角 回転角度"},
    {"ja", time, "時間 時刻"},
    {"ja", position, "位置 長さ 高さ 深さ"},
    {"ja", filler, "軸 主軸 測定 測定値 値 実際 の"},
};

struct Entry {
  HeaderMeaning meaning;
  std::set<std::string_view> languages;  ///< empty: all
};

/// The table, by folded word.
const std::map<std::string, Entry, std::less<>>& words_known() {
  static const auto known = [] {
    std::map<std::string, Entry, std::less<>> map;
    std::vector<std::string_view> words;
    for (const HeaderWords& line : header_words) {
      csv_split(line.words, ' ', words);
      for (const std::string_view word : words) {
        Entry& entry = map.try_emplace(folded(word), Entry{line.meaning, {}}).first->second;
        expects(entry.meaning == line.meaning, "a word of a header means one thing");
        if (!line.language.empty()) entry.languages.insert(line.language);
      }
    }
    return map;
  }();
  return known;
}

class NameReader {
 public:
  /// False where the word contradicts those before it.
  bool take(std::string_view word, const Entry& entry) {
    if (!entry.languages.empty()) {
      std::set<std::string_view> both;
      for (const std::string_view language : entry.languages)
        if (!any_language_ || languages_.contains(language)) both.insert(language);
      languages_ = both;
      any_language_ = true;
    }
    if (entry.meaning == filler) return true;
    if (entry.meaning == position) return name_.position = true;
    if (entry.meaning == axis) {
      const char letter = word.starts_with("axial") || word == "assiale" ? 'z' : word.front();
      const bool same = name_.axis == 0 || name_.axis == letter;
      name_.axis = letter;
      return same;
    }
    const bool same = !name_.meaning || *name_.meaning == entry.meaning;
    name_.meaning = entry.meaning;
    return same;
  }
  /// The words that a token is made of: the longest first, then the rest of it.
  bool take_parts(std::string_view token) {
    if (token.empty()) return true;
    if (const auto whole = words_known().find(token); whole != words_known().end())
      return take(token, whole->second);
    constexpr std::size_t least = 3;  // bytes of a part: "ist", one Japanese character
    for (std::size_t length = token.size() - 1; length > 0; --length) {
      const std::string_view part = token.substr(0, length), rest = token.substr(length);
      const auto found = words_known().find(part);
      const bool letter = length == 1 && found != words_known().end() &&
                          found->second.meaning == axis && (rest.size() >= least || rest == "ø");
      if (found == words_known().end() || (length < least && !letter && part != "ø")) continue;
      const bool last = (rest.size() == 1 && rest.find_first_of("xyzc") == 0) || rest == "ø";
      if (rest.size() < least && !last) continue;
      const NameReader before = *this;
      if (take(part, found->second) && take_parts(rest)) return true;
      *this = before;
    }
    return false;
  }
  HeaderName name() const {
    HeaderName out = name_;
    if (languages_.size() == 1) out.language = *languages_.begin();
    return out;
  }

 private:
  HeaderName name_;
  std::set<std::string_view> languages_;
  bool any_language_ = false;
};

bool is_separator(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80U && !(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9');
}

}  // namespace

std::optional<HeaderName> read_header_name(std::string_view name) {
  const std::string text = folded(name);
  std::string joined;
  std::vector<std::string> tokens(1);
  for (const char c : text) {
    if (c == '\'' && tokens.back().size() == 1) {  // l'axe, d'angle
      tokens.back().clear();
    } else if (!is_separator(c)) {
      joined += c;
      tokens.back() += c;
    } else if (!tokens.back().empty()) {
      tokens.emplace_back();
    }
  }
  if (joined.empty()) return {};
  NameReader reader;
  if (const auto whole = words_known().find(joined); whole != words_known().end()) {
    reader.take(joined, whole->second);
    return reader.name();
  }
  for (const std::string& token : tokens)
    if (!reader.take_parts(token)) return {};
  return reader.name();
}

}  // namespace trueaxis
