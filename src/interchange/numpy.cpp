// SPDX-License-Identifier: Apache-2.0
// NumPy's own format: a magic, a Python dictionary with type, order and shape, the bytes.
#include <array>
#include <bit>
#include <optional>

#include "base/number.hpp"
#include "base/text.hpp"
#include "interchange/formats.hpp"
#include "interchange/zip_archive.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

struct Field {
  std::string name;
  char kind = 0;  ///< f, i, u, b; else no real number
  std::size_t size = 0;
  bool swapped = false;
};

/// "<f8": kind, size and order; nothing for what is not a real number.
std::optional<Field> field_of(std::string_view type) {
  Field field;
  if (type.size() < 3) return {};
  const char order = type[0];
  field.kind = type[1];
  field.swapped = order == '>';
  field.size = whole_number<std::size_t>(type.substr(2)).value_or(0);
  const bool real = (field.kind == 'f' && (field.size == 4 || field.size == 8)) ||
                    ((field.kind == 'i' || field.kind == 'u') &&
                     (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8)) ||
                    (field.kind == 'b' && field.size == 1);
  if (!real) return {};
  return field;
}

/// The text between the quotes that begin at `at`, which is moved after them.
std::string_view quoted(std::string_view text, std::size_t& at) {
  const std::size_t open = text.find_first_of("'\"", at);
  if (open == std::string_view::npos) return {};
  const std::size_t close = text.find(text[open], open + 1);
  if (close == std::string_view::npos) return {};
  at = close + 1;
  return text.substr(open + 1, close - open - 1);
}

/// The value of 'key': in the dictionary.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  const std::size_t colon = header.find(':', at + key.size());
  if (colon == std::string_view::npos) return {};
  return trimmed(header.substr(colon + 1));
}

double number_at(const char* bytes, const Field& field) {
  std::array<char, 8> raw{};
  for (std::size_t i = 0; i < field.size; ++i)
    raw[i] = bytes[field.swapped ? field.size - 1 - i : i];
  return binary_number(raw.data(), field.kind, field.size);
}

class Npy {
 public:
  Npy(const std::string& path, const std::string& name, std::string_view bytes,
      NumberBudget& budget)
      : path_(path),
        budget_(budget),
        whose_(name.empty() ? "" : "its array " + name + " "),
        bytes_(bytes) {}

  NumberArray read(const std::string& name) {
    NumberArray array;
    array.name = name;
    read_header();
    if (!read_type()) {
      array.unusable = unusable_;
      return array;
    }
    std::vector<std::size_t> shape = read_shape();
    if (shape.size() > 2 || (fields_.size() > 1 && shape.size() > 1)) {
      array.unusable = std::to_string(shape.size()) + " dimensions";
      return array;
    }
    array.rows = shape.empty() ? 1 : shape[0];
    const std::size_t across = shape.size() == 2 ? shape[1] : 1;
    array.columns = across * fields_.size();
    const std::size_t count = budget_.take(name, array.rows, array.columns);
    std::size_t row_bytes = 0;
    for (const Field& field : fields_) {
      row_bytes += field.size;
      if (fields_.size() > 1 || !field.name.empty()) array.names.push_back(field.name);
    }
    if (bytes_.size() != array.rows * across * row_bytes)
      fail("has " + std::to_string(bytes_.size()) + " bytes of numbers and its header says " +
           std::to_string(array.rows * across * row_bytes) + ": it was truncated or changed");
    if (count == 0) return array;  // of (10^18, 0) there is not a row to walk through
    array.values.reserve(count);
    const bool fortran = value_of(header_, "'fortran_order'").starts_with("True");
    for (std::size_t row = 0; row < array.rows; ++row)
      for (std::size_t column = 0; column < across; ++column) {
        const std::size_t place = fortran ? column * array.rows + row : row * across + column;
        const char* at = bytes_.data() + place * row_bytes;
        for (const Field& field : fields_) {
          array.values.push_back(number_at(at, field));
          at += field.size;
        }
      }
    return array;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw InputError(path_, whose_ + why); }

  void read_header() {
    const auto byte = [&](std::size_t at) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes_[at]));
    };
    if (bytes_.size() < 12 || !bytes_.starts_with("\x93NUMPY")) fail("is not a NumPy array");
    const bool wide = byte(6) >= 2;
    const std::size_t begin = wide ? 12 : 10;
    std::size_t length = byte(8) | byte(9) << 8U;
    if (wide) length |= byte(10) << 16U | byte(11) << 24U;
    if (length > bytes_.size() - begin) fail("ends within its header");
    header_ = bytes_.substr(begin, length);
    bytes_ = bytes_.substr(begin + length);
  }

  bool read_type() {
    const std::string_view type = value_of(header_, "'descr'");
    std::size_t at = 0;
    const auto add = [&](std::string_view name, std::string_view of) {
      const auto field = field_of(of);
      if (!field) {
        unusable_ = of.find('c') != std::string_view::npos   ? "complex numbers"
                    : of.find('O') != std::string_view::npos ? "Python objects"
                                                             : "the type " + std::string(of);
        return false;
      }
      fields_.push_back(*field);
      fields_.back().name = name;
      return true;
    };
    if (!type.starts_with('[')) return add("", quoted(type, at));
    const std::string_view list = type.substr(0, type.find(']'));
    while (list.find('(', at) != std::string_view::npos) {
      at = list.find('(', at);
      const std::string_view name = quoted(list, at);
      const std::string_view of = quoted(list, at);
      if (!add(name, of)) return false;
      at = list.find_first_of("()", at);
      if (at == std::string_view::npos || list[at] != ')') {
        unusable_ = "arrays in its fields";
        return false;
      }
    }
    if (fields_.empty()) fail("has a header without a type");
    return true;
  }

  std::vector<std::size_t> read_shape() const {
    std::string_view text = value_of(header_, "'shape'");
    std::vector<std::size_t> shape;
    if (!take_word(text, "(")) fail("has a header without a shape");
    while (!text.empty() && text.front() != ')') {
      if (take_word(text, " ") || take_word(text, ",")) continue;
      const auto value = take_number<std::size_t>(text);
      if (!value) fail("has a header with an invalid shape");
      shape.push_back(*value);
    }
    return shape;
  }

  const std::string& path_;
  NumberBudget& budget_;
  std::string whose_, unusable_;
  std::string_view bytes_, header_;
  std::vector<Field> fields_;
};

}  // namespace

NumberArray read_npy(const std::string& path, const std::string& name, std::string_view bytes,
                     NumberBudget& budget) {
  static_assert(std::endian::native == std::endian::little);
  return Npy(path, name, bytes, budget).read(name);
}

NumberFile read_npz(const std::string& path, const std::string& bytes) {
  ZipArchive archive(path, bytes);
  NumberFile file{.kind = "an archive of NumPy arrays", .arrays = {}};
  NumberBudget budget(path);
  for (const std::string& name : archive.names())
    if (name.ends_with(".npy"))
      file.arrays.push_back(
          read_npy(path, name.substr(0, name.size() - 4), archive.member(name), budget));
  return file;
}

}  // namespace trueaxis
