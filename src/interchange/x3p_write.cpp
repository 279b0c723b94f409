// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <md5.h>

#include <array>
#include <cstring>

#include "interchange/number_file.hpp"
#include "interchange/x3p.hpp"
#include "interchange/zip_archive.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

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
