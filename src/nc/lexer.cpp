// SPDX-License-Identifier: Apache-2.0
#include "nc/lexer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/number.hpp"
#include "base/text.hpp"

namespace trueaxis::nc {
namespace {

constexpr double largest_number = 1e9;  // of any word that is read
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Reads the words of one line.
class LineReader {
 public:
  LineReader(std::string_view text, Line& line, std::vector<Word>& words)
      : text_(text), line_(line), words_(words), at_(line.begin) {}

  struct Trouble {
    std::uint32_t at;
    std::string why;
  };

  /// Everything that cannot be read; reading goes on after a value that is not a number.
  std::vector<Trouble> read() {
    line_.first_word = static_cast<std::uint32_t>(words_.size());
    skip_blanks();
    if (peek() == '/') {
      line_.skip = '/';
      ++at_;
      if (is_digit(peek())) line_.skip = text_[at_++];
    }
    while (!lost_) {
      skip_blanks();
      if (at_ == line_.end || peek() == ';') break;
      if (peek() == '(')
        read_comment();
      else
        read_word();
    }
    std::size_t count = words_.size() - line_.first_word;
    if (count > std::numeric_limits<std::uint16_t>::max()) {
      complain(line_.begin, "a block of more than 65535 words");
      count = 0;
    }
    line_.word_count = static_cast<std::uint16_t>(count);
    return std::move(troubles_);
  }

 private:
  char peek() const { return at_ < line_.end ? text_[at_] : '\0'; }
  void complain(std::uint32_t at, std::string why) { troubles_.push_back({at, std::move(why)}); }
  /// The rest of the line cannot be told apart.
  void give_up(std::string why) {
    complain(at_, std::move(why));
    lost_ = true;
  }

  void skip_blanks() {
    for (; at_ < line_.end && is_blank(text_[at_]); ++at_) line_.has_blanks = true;
  }

  void read_comment() {
    const std::size_t close = text_.substr(0, line_.end).find(')', at_);
    if (close == std::string_view::npos)
      return give_up("a comment that is not closed: end it with ')'");
    at_ = static_cast<std::uint32_t>(close) + 1;
  }

  void read_word() {
    const char c = peek();
    if (begins_value(c)) return give_up("a variable or an expression: give its value as a number");
    if (c == '/') return give_up("'/' is read at the start of a block only");
    if (is_digit(c) || c == '.' || c == '+' || c == '-')
      return give_up("a number without its letter");
    if (!is_letter(c))
      return give_up("a character that is not allowed in a program outside of comments");
    Word word;
    word.letter = upper_case(c);
    word.letter_at = at_++;
    skip_blanks();
    read_number(word);
  }

  void read_number(Word& word) {
    word.number_begin = at_;
    if (peek() == '+' || peek() == '-') ++at_;
    std::uint32_t digits = 0, decimals = 0;
    for (; is_digit(peek()); ++at_) ++digits;
    if (peek() == '.')
      for (++at_; is_digit(peek()); ++at_) ++decimals;
    if (digits + decimals == 0) return without_number(word);
    word.end = at_;
    word.decimals = static_cast<std::uint8_t>(std::min<std::uint32_t>(decimals, 255));
    const bool fits =
        parse_number(text_.substr(word.number_begin, word.end - word.number_begin), word.number);
    if (!fits || decimals > 255 || std::abs(word.number) > largest_number)
      complain(word.letter_at, name_of(word) + " has a number that is too large or too long");
    if (is_exponent()) {
      complain(word.letter_at, name_of(word) + " has an exponent: write the number without one");
      for (at_ += 2; is_digit(peek()); ++at_) {
      }
    }
    words_.push_back(word);
  }

  /// "e5", "E-3" right after a number.
  bool is_exponent() const {
    if (upper_case(peek()) != 'E' || at_ + 1 >= line_.end) return false;
    const char next = text_[at_ + 1];
    return is_digit(next) || next == '+' || next == '-';
  }

  void without_number(Word& word) {
    const char c = peek();
    if (!begins_value(c)) {
      at_ = word.letter_at;
      return give_up(name_of(word) + " has no number");
    }
    complain(word.letter_at,
             name_of(word) + (c == '[' ? " has an expression: give its value as a number"
                                       : " has a variable, whose value is not known here: give a "
                                         "number"));
    skip_value();
    word.end = at_;
    words_.push_back(word);
  }

  static bool begins_value(char c) { return c == '#' || c == '[' || c == '=' || c == '<'; }
  static std::string name_of(const Word& word) { return std::string(1, word.letter); }

  void skip_value() {
    int open = 0;
    for (; at_ < line_.end; ++at_) {
      const char c = peek();
      if (c == '[' || c == '<') ++open;
      if (c == ']' || c == '>') --open;
      if (open <= 0 && (is_letter(c) || is_blank(c) || c == '(' || c == ';')) break;
    }
  }

  std::string_view text_;
  Line& line_;
  std::vector<Word>& words_;
  std::uint32_t at_;
  std::vector<Trouble> troubles_;
  bool lost_ = false;
};

/// The lines of a text, a run of '\r' before '\n' being part of the line's end.
std::vector<Line> split(std::string_view text) {
  std::vector<Line> lines;
  lines.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
  std::size_t begin = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  while (begin < text.size()) {
    const std::size_t feed = std::min(text.find('\n', begin), text.size());
    std::size_t end = feed;
    while (end > begin && text[end - 1] == '\r') --end;
    Line line;
    line.begin = static_cast<std::uint32_t>(begin);
    line.end = static_cast<std::uint32_t>(end);
    lines.push_back(line);
    begin = feed + 1;
  }
  return lines;
}

bool is_tape_mark(std::string_view text, const Line& line) {
  std::uint32_t at = line.begin;
  while (at < line.end && is_blank(text[at])) ++at;
  return at < line.end && text[at] == '%';
}

bool has_words(std::string_view text, Line line) {
  std::vector<Word> words;
  LineReader(text, line, words).read();
  return !words.empty();
}

}  // namespace

Lexed lex(std::string_view text, const std::string& file, std::vector<Diagnostic>& wrong) {
  if (text.size() >= std::numeric_limits<std::uint32_t>::max())
    throw InputError(file, "is larger than 4 GB: give it in parts");
  Lexed out;
  out.lines = split(text);
  out.words.reserve(text.size() / 8);
  int tape_marks = 0;
  std::size_t after = 0;  // number of the first line that no control reads
  for (std::size_t i = 0; i < out.lines.size(); ++i) {
    Line& line = out.lines[i];
    line.first_word = static_cast<std::uint32_t>(out.words.size());
    if (is_tape_mark(text, line)) {
      ++tape_marks;
      continue;
    }
    if (tape_marks > 1) {
      if (after == 0 && has_words(text, line)) after = i + 1;
      continue;
    }
    LineReader reader(text, line, out.words);
    for (auto& [at, why] : reader.read())
      wrong.push_back({file, i + 1, column_of(text, line, at), std::move(why)});
  }
  if (after > 0)
    wrong.push_back({file, after, 1,
                     "is after the second '%', where a control stops: make this part a program of "
                     "its own, or remove it"});
  return out;
}

std::size_t column_of(std::string_view text, const Line& line, std::size_t at) {
  const std::string_view before = text.substr(line.begin, at - line.begin);
  const auto further = std::count_if(before.begin(), before.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
  });
  return before.size() - static_cast<std::size_t>(further) + 1;
}

}  // namespace trueaxis::nc
