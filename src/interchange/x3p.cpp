// SPDX-License-Identifier: Apache-2.0
#include "interchange/x3p.hpp"

#include <fmt/format.h>
#include <md5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>

#include "base/number.hpp"
#include "base/text.hpp"
#include "interchange/formats.hpp"
#include "interchange/number_file.hpp"
#include "interchange/zip_archive.hpp"
#include "trueaxis/error.hpp"

// ISO 25178-72 (ISO 5436-2): a zip archive of main.xml, the points next to it, and MD5 sums.
namespace trueaxis {
namespace {

struct Axis {
  bool incremental = false;
  char type = 'D';  ///< I int16, L int32, F float32, D float64
  double increment = 1.0, offset = 0.0;
  std::size_t size() const { return type == 'I' ? 2 : type == 'D' ? 8 : 4; }
};

class X3p {
 public:
  X3p(const std::string& path, const std::string& bytes) : path_(path), archive_(path, bytes) {}

  NumberFile read() {
    const std::string xml = archive_.member("main.xml");
    check_sum_of_xml(xml);
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(xml.data(), xml.size());
    if (!parsed) fail(std::string("main.xml is not valid XML: ") + parsed.description());
    root_ = document.document_element();
    if (!std::string_view(root_.name()).ends_with("ISO5436_2"))
      fail(std::string("main.xml is not X3P: its root is ") + root_.name());
    read_axes();
    read_size();
    NumberArray points{.name = "points", .unit = "m", .rows = 0, .columns = 3};
    points.names = {"x", "y", "z"};
    const pugi::xml_node record = root_.child("Record3");
    if (const pugi::xml_node list = record.child("DataList"))
      read_list(list, points);
    else
      read_binary(record.child("DataLink"), points);
    points.rows = points.values.size() / 3;
    NumberFile file{.kind = "an X3P file (metres)", .arrays = {}, .notes = std::move(notes_)};
    if (invalid_ > 0)
      file.notes.push_back(std::to_string(invalid_) + " of " + std::to_string(count_) +
                           " points are marked invalid by the file and excluded");
    file.arrays.push_back(std::move(points));
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw InputError(path_, why); }

  void check_sum_of_xml(const std::string& xml) {
    constexpr const char* name = "md5checksum.hex";
    if (!archive_.has(name)) {
      notes_.emplace_back("the file has no check sum of its main.xml (md5checksum.hex)");
      return;
    }
    expect_sum("main.xml", xml, archive_.member(name).substr(0, 32));
  }

  void expect_sum(const std::string& name, std::string_view bytes, std::string said) const {
    said = lower_case(said);
    if (const std::string sum = md5_of(bytes); sum != said)
      fail("the MD5 sum of " + name + " is " + sum + ", the file says " + said +
           ": it was changed or damaged; copy it again from its source");
  }

  double real(const pugi::xml_node& node, double otherwise) const {
    if (!node) return otherwise;
    double value = 0.0;
    const char* text = node.text().get();
    if (!parse_number(trimmed(text, blanks_of_text), value))
      fail(std::string("main.xml: ") + node.name() + " '" + text + "' is not a finite number");
    return value;
  }

  void read_axes() {
    const pugi::xml_node axes = root_.child("Record1").child("Axes");
    constexpr std::array names{"CX", "CY", "CZ"};
    for (std::size_t i = 0; i < 3; ++i) {
      const pugi::xml_node node = axes.child(names[i]);
      const std::string kind = node.child("AxisType").text().get();
      Axis& axis = axes_[i];
      if (kind != "A" && kind != "I")
        fail(std::string("main.xml: the AxisType of ") + names[i] + " is '" + kind +
             "' must be A (absolute) or I (incremental)");
      axis.incremental = kind == "I";
      if (axis.incremental && i == 2) fail("main.xml: CZ must be absolute");
      const std::string type = node.child("DataType").text().get();
      if (!axis.incremental && type != "I" && type != "L" && type != "F" && type != "D")
        fail(std::string("main.xml: the DataType of ") + names[i] + " is '" + type +
             "' must be I, L, F or D");
      if (!axis.incremental) axis.type = type[0];
      axis.increment = real(node.child("Increment"), 1.0);
      axis.offset = real(node.child("Offset"), 0.0);
      const bool whole = axis.incremental || axis.type == 'I' || axis.type == 'L';
      if (whole && !node.child("Increment"))
        fail(std::string("main.xml: ") + names[i] + " counts steps and has no Increment");
      if (!whole && axis.increment != 1.0)
        fail(std::string("main.xml: ") + names[i] +
             " has floating-point numbers and an Increment other than 1, which the standard does "
             "not define");
    }
    if (const pugi::xml_node turn = axes.child("Rotation")) {
      turned_ = true;
      for (std::size_t i = 0; i < 9; ++i) {
        const char name[] = {'r', static_cast<char>('1' + i / 3), static_cast<char>('1' + i % 3),
                             0};
        turn_[i] = real(turn.child(name), std::nan(""));
        if (!std::isfinite(turn_[i])) fail(std::string("main.xml: Rotation has no ") + name);
      }
    }
  }

  std::size_t whole(const pugi::xml_node& node) const {
    const std::string_view text = node.text().get();
    std::size_t value = 0;
    for (const char c : text) {
      if (c < '0' || c > '9' || value > most_numbers)
        fail(std::string("main.xml: ") + node.name() + " '" + std::string(text) +
             "' is not a valid count of points for one file");
      value = 10 * value + static_cast<std::size_t>(c - '0');
    }
    if (text.empty()) fail("main.xml does not state the number of its points");
    return value;
  }

  void read_size() {
    const pugi::xml_node record = root_.child("Record3"), matrix = record.child("MatrixDimension");
    if (matrix) {
      size_ = {whole(matrix.child("SizeX")), whole(matrix.child("SizeY")),
               whole(matrix.child("SizeZ"))};
    } else {
      size_ = {whole(record.child("ListDimension")), 1, 1};
      if (axes_[0].incremental || axes_[1].incremental)
        fail("main.xml: a list of points has absolute axes, a matrix incremental ones");
    }
    NumberBudget budget(path_), of_layer(path_);
    count_ = budget.take("points", of_layer.take("points", size_[0], size_[1]), 3 * size_[2]) / 3;
  }

  /// One point of the numbers in the file.
  void add(std::size_t index, const std::array<double, 3>& stored, NumberArray& points) {
    if (std::ranges::any_of(stored, [](double value) { return std::isnan(value); })) {
      ++invalid_;
      return;
    }
    points.numbers.push_back(index + 1);
    const std::array<std::size_t, 2> steps{index % size_[0], index / size_[0] % size_[1]};
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Axis& axis = axes_[i];
      p[i] = axis.incremental ? static_cast<double>(steps[std::min<std::size_t>(i, 1)]) : stored[i];
      if (axis.increment != 1.0) p[i] *= axis.increment;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      double value =
          turned_ ? turn_[3 * i] * p[0] + turn_[3 * i + 1] * p[1] + turn_[3 * i + 2] * p[2] : p[i];
      if (axes_[i].offset != 0.0) value += axes_[i].offset;
      points.values.push_back(value);
    }
  }

  void read_list(const pugi::xml_node& list, NumberArray& points) {
    std::size_t index = 0;
    for (const pugi::xml_node datum : list.children("Datum")) {
      std::string_view text = datum.text().get();
      std::array<double, 3> stored{};
      const bool invalid = text.empty();  // the standard's mark
      if (invalid) stored[2] = std::nan("");
      for (std::size_t i = 0; i < 3 && !invalid; ++i) {
        if (axes_[i].incremental) continue;
        const std::size_t end = i == 2 ? text.size() : std::min(text.find(';'), text.size());
        const std::string_view part = trimmed(text.substr(0, end), blanks_of_text);
        if (part == "NaN")
          stored[i] = std::nan("");
        else if (!parse_number(part, stored[i]) || (i != 2 && end == text.size()))
          fail("main.xml: Datum " + std::to_string(index + 1) + " '" + datum.text().get() +
               "' is not a point of these axes");
        text.remove_prefix(std::min(end + 1, text.size()));
      }
      if (index < count_) add(index, stored, points);
      ++index;
    }
    if (index != count_)
      fail("main.xml has " + std::to_string(index) + " points and says " + std::to_string(count_));
  }

  void read_binary(const pugi::xml_node& link, NumberArray& points) {
    const std::string name = link.child("PointDataLink").text().get();
    if (name.empty()) fail("main.xml names no data: neither DataLink nor DataList");
    const std::string bytes = archive_.member(name);
    expect_sum(name, bytes, link.child("MD5ChecksumPointData").text().get());
    std::size_t width = 0;
    for (const Axis& axis : axes_) width += axis.incremental ? 0 : axis.size();
    if (bytes.size() != count_ * width)
      fail(name + " has " + std::to_string(bytes.size()) + " bytes, main.xml says " +
           std::to_string(count_) + " points of " + std::to_string(width));
    const std::string valid = valid_points(link);
    for (std::size_t index = 0; index < count_; ++index) {
      const char* at = bytes.data() + index * width;
      std::array<double, 3> stored{};
      for (std::size_t i = 0; i < 3; ++i) {
        if (axes_[i].incremental) continue;
        const bool whole = axes_[i].type == 'I' || axes_[i].type == 'L';
        stored[i] = binary_number(at, whole ? 'i' : 'f', axes_[i].size());
        at += axes_[i].size();
        if (std::isinf(stored[i]))
          fail(name + ": point " + std::to_string(index + 1) + " is not finite");
      }
      const bool told =
          valid.empty() || (static_cast<unsigned char>(valid[index / 8]) >> index % 8 & 1U) != 0;
      if (!told) stored[2] = std::nan("");
      add(index, stored, points);
    }
  }

  /// A bit a point, the lowest of a byte first; empty where the file marks none.
  std::string valid_points(const pugi::xml_node& link) {
    const std::string name = link.child("ValidPointsLink").text().get();
    if (name.empty()) return {};
    std::string bits = archive_.member(name);
    expect_sum(name, bits, link.child("MD5ChecksumValidPoints").text().get());
    if (bits.size() != (count_ + 7) / 8)
      fail(name + " has " + std::to_string(bits.size()) + " bytes for " + std::to_string(count_) +
           " points, one bit each");
    return bits;
  }

  const std::string& path_;
  ZipArchive archive_;
  pugi::xml_node root_;
  std::array<Axis, 3> axes_{};
  std::array<std::size_t, 3> size_{};
  std::array<double, 9> turn_{};
  bool turned_ = false;
  std::size_t count_ = 0, invalid_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace

NumberFile read_x3p(const std::string& path, const std::string& bytes) {
  return X3p(path, bytes).read();
}

std::string md5_of(std::string_view bytes) {
  MD5_CTX sum;
  MD5Init(&sum);
  MD5Update(&sum, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  std::array<std::uint8_t, MD5_DIGEST_LENGTH> digest{};
  MD5Final(digest.data(), &sum);
  std::string text;
  for (const std::uint8_t byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string x3p_of_points(const std::vector<double>& xyz_m, const std::string& version) {
  expects(xyz_m.size() % 3 == 0, "x, y, z in turn");
  std::string data(8 * xyz_m.size(), '\0');
  std::memcpy(data.data(), xyz_m.data(), data.size());
  std::string axes;
  for (const char* name : {"CX", "CY", "CZ"})
    axes += fmt::format(
        "      <{0}>\n        <AxisType>A</AxisType>\n        <DataType>D</DataType>\n"
        "      </{0}>\n",
        name);
  // Record2 asks for dates of measurement and calibration, which nobody told: it is optional.
  const std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- schema: trueaxis.cloud/1, TrueAxis {} -->\n"
      "<p:ISO5436_2 xmlns:p=\"{}\">\n"
      "  <Record1>\n    <Revision>ISO5436 - 2000</Revision>\n"
      "    <FeatureType>PCL</FeatureType>\n    <Axes>\n{}    </Axes>\n  </Record1>\n"
      "  <Record3>\n    <ListDimension>{}</ListDimension>\n    <DataLink>\n"
      "      <PointDataLink>bindata/data.bin</PointDataLink>\n"
      "      <MD5ChecksumPointData>{}</MD5ChecksumPointData>\n    </DataLink>\n  </Record3>\n"
      "  <Record4>\n    <ChecksumFile>md5checksum.hex</ChecksumFile>\n  </Record4>\n"
      "</p:ISO5436_2>\n",
      version, x3p_namespace, axes, xyz_m.size() / 3, md5_of(data));
  return zip_of({{"main.xml", xml},
                 {"md5checksum.hex", md5_of(xml) + " *main.xml\n"},
                 {"bindata/data.bin", std::move(data)}});
}

}  // namespace trueaxis
