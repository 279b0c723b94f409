// SPDX-License-Identifier: Apache-2.0
#include "associate/files/association_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

std::string written(const std::string& text) {
  const auto folder = std::filesystem::path(places::scratch()) / "association_files" /
                      ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::create_directories(folder);
  const std::string path = folder / "points.txt";
  std::ofstream(path) << text;
  return path;
}

std::vector<Point3> points_in(const std::string& text, const std::string& unit = "") {
  return read_points(written(text), unit).points_mm;
}

const std::vector<Point3> two = {{1.5, -2.0, 3.0}, {4.0, 5.0, 6e-3}};

TEST(AssociationFiles, BlanksTabsCommasCommentsAndAByteOrderMark) {
  EXPECT_EQ(points_in("1.5 -2 3\n4 5 6e-3\n"), two);
  EXPECT_EQ(points_in("\xEF\xBB\xBF# made by hand\n\n 1.5\t-2\t 3 # first\r\n4,5 , 0.006"), two);
  EXPECT_EQ(points_in("x y z\n1.5 -2 3\n4 5 6e-3\n"), two);
}

TEST(AssociationFiles, UnitsOfTheHeaderAndOfTheOption) {
  const std::vector<Point3> inches = {{25.4, 50.8, -25.4}};
  EXPECT_EQ(points_in("1 2 -1\n", "in"), inches);
  EXPECT_EQ(points_in("X [in], Y [in], Z [in]\n1,2,-1\n"), inches);
  // One rounding of the factor.
  EXPECT_DOUBLE_EQ(points_in("x[um] y[um] z[um]\n25400 50800 -25400\n", "um").front()[0], 25.4);
  EXPECT_THROW(points_in("x[um] y[um] z[um]\n1 2 3\n", "mm"), InputError);
  EXPECT_THROW(points_in("x y w\n1 2 3\n"), InputError);
}

TEST(AssociationFiles, ExactPointsOfACurveInSpaceAreTheirOwnProof) {
  std::string ring, line;
  for (const char* xy : {"1 0", "0 1", "-1 0", "0 -1", "0.6 0.8", "-0.8 0.6"})
    ring += std::string(xy) + " 3\n";
  for (int i = 0; i < 6; ++i) line += fmt::format("{0} {1} {1}\n", i, 2 * i);
  for (const auto& [element, points] :
       {std::pair{Element::circle, ring}, std::pair{Element::line, line}}) {
    const PointText text = read_points(written(points), "");
    const AssociatedFeature got = associate(text.points_mm, element, Criterion::minimum_zone);
    EXPECT_EQ(got.status, AssociationStatus::converged);
    EXPECT_LE(got.zone_mm, 1e-14);  // rounding of coordinates of 10 mm: 4e-16 · 10, a few times
    EXPECT_LE(got.certificate.gap_mm, 1e-14);
    if (got.certificate.contacts.empty()) {
      EXPECT_NE(association_text(got).find("so the zone cannot be narrower"), std::string::npos);
    }
    EXPECT_NE(association_certificate(got, text), "");
  }
}

TEST(AssociationFiles, LinesOfTheCertificateAreThoseOfTheFile) {
  const PointText text = read_points(written("# a ring\n1 0 0\n\n0 1 0\n-1 0 0\n0 -1.1 0\n"), "");
  EXPECT_EQ(text.lines, (std::vector<std::size_t>{2, 4, 5, 6}));
  const AssociatedFeature got =
      associate(text.points_mm, Element::circle, Criterion::minimum_circumscribed);
  // (0, 1) and (0, −1.1) are its ends; the two others are 1.0012 mm from the centre.
  EXPECT_NEAR(got.feature.point_mm[1], -0.05, 1e-15);
  EXPECT_NEAR(got.feature.radius_mm, 1.05, 1e-15);
  const auto json = nlohmann::json::parse(association_json(got, text));
  EXPECT_EQ(json["schema"], "trueaxis.association/1");
  EXPECT_EQ(json["radius"]["unit"], "mm");
  EXPECT_TRUE(json["radius"]["u"].is_null());
  EXPECT_FALSE(json["radius"]["why"].get<std::string>().empty());
  EXPECT_TRUE(json["certificate"]["global"]);
  std::vector<int> lines;
  for (const auto& contact : json["certificate"]["contacts"]) lines.push_back(contact["line"]);
  EXPECT_TRUE(lines == (std::vector<int>{4, 6}) || lines == (std::vector<int>{6, 4}));
  const std::string certificate = association_certificate(got, text);
  EXPECT_TRUE(certificate.starts_with("# schema: trueaxis.certificate/1\n"));
  EXPECT_NE(certificate.find("\n6,0,-1.1"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis
