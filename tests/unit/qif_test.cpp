// SPDX-License-Identifier: Apache-2.0
// What stands in a QIF document is what the result holds: numbers are written with the digits that
// are read as the same number, up to the 18th behind the point.
#include "interchange/qif.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <set>

#include "associate/files/association_files.hpp"
#include "form/files/form_files.hpp"
#include "format/outputs.hpp"
#include "support/qif_reader.hpp"

namespace trueaxis::testing {
namespace {

// Half of the 18th digit after the point, and as much for the double that is read.
constexpr double last_digit = 1e-18;

double number(pugi::xml_node node) { return std::strtod(node.text().get(), nullptr); }
double number(pugi::xml_attribute attribute) { return std::strtod(attribute.value(), nullptr); }

void expect_near(std::array<double, 3> found, std::array<double, 3> expected) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], last_digit) << i;
}

std::array<double, 3> vector(pugi::xml_node node) {
  std::array<double, 3> out{};
  EXPECT_EQ(std::sscanf(node.text().get(), "%lf %lf %lf", &out[0], &out[1], &out[2]), 3);
  return out;
}

void expect_value(pugi::xml_node node, const FormValue& one) {
  EXPECT_NEAR(number(node), one.estimate.value, last_digit);
  EXPECT_NEAR(number(node.attribute("combinedUncertainty")), one.estimate.u, last_digit);
  EXPECT_NEAR(number(node.attribute("meanError")), one.bias_mm, last_digit);
}

const FormValue& value(const std::vector<FormValue>& values, const std::string& name,
                       const std::string& reference = "") {
  for (const FormValue& one : values)
    if (one.name == name && one.reference == reference) return one;
  throw std::logic_error(name);
}

/// Three sections of a shaft of three lobes, off the spindle axis, with one reading in two 0.2 µm
/// up.
FormResult of_a_shaft() {
  ProbeStream stream;
  stream.source = "shaft.csv";
  for (const double z_mm : {-10.0, 0.0, 10.0})
    for (int i = 0; i < 720; ++i) {
      const double c_rad = 2.0 * std::numbers::pi * i / 720.0;
      stream.c_rad.push_back(c_rad);
      stream.position_mm.push_back(z_mm);
      stream.reading_mm.push_back(25.0 + 0.01 * std::cos(c_rad) + 2e-3 * std::cos(3.0 * c_rad) +
                                  2e-4 * (i % 2));
    }
  FormOptions options;
  options.trials = 20;
  return assess_form(stream, options);
}

TEST(Qif, SectionsAndTheWholeAreFeaturesWithTheirForm) {
  const FormResult result = of_a_shaft();
  const QifReader qif(form_qif(result, {}, true));
  qif.expect_structure();
  const auto features = qif.features();
  ASSERT_EQ(features.size(), 5U);  // three circles, a cylinder, a cone
  for (std::size_t s = 0; s < 3; ++s) {
    const SectionForm& section = result.sections[s];
    const FormCircle& circle = section.circles[1];
    ASSERT_EQ(circle.criterion, Criterion::minimum_zone);
    EXPECT_STREQ(features[s].name(), "CircleFeatureMeasurement");
    expect_near(vector(features[s].child("Location")),
                (std::array{circle.x_mm, circle.y_mm, *section.z_mm}));
    EXPECT_NEAR(number(features[s].child("Diameter")), 2.0 * circle.radius_mm, last_digit);
    expect_value(features[s].child("Form"), value(section.values, "RONt", "MZCI"));
  }
  const std::vector<FormValue>& whole = result.groups.front().values;
  expect_value(features[3].child("Form"), value(whole, "CYLt", "MZCY"));
  expect_value(features[4].child("Form"), value(whole, "CONt", "MZCO"));
  EXPECT_STREQ(qif.measured().child("InspectionStatus").child("InspectionStatusEnum").text().get(),
               "NOT_CALCULATED");  // nothing has a tolerance
  EXPECT_TRUE(qif.characteristics().empty());
}

TEST(Qif, EveryToleranceIsACharacteristicJudgedByIso14253) {
  const FormResult result = of_a_shaft();
  const std::vector<FormValue>& datum = result.groups.back().values;
  const Estimate& runout = value(datum, "runout_total").estimate;
  const std::vector<FormTolerance> tolerances{
      {"RONt", 0.01}, {"coaxiality", 0.001}, {"runout_total", runout.value},  // within U
      {"STRsa", 1.0}, {"parallelism", 1.0},  {"RONq", 1.0}};  // which QIF does not have
  const QifReader qif(form_qif(result, tolerances, true));
  qif.expect_structure();
  const auto measured = qif.characteristics();
  ASSERT_EQ(measured.size(), 7U);
  const auto features = qif.features();
  const auto status = [](pugi::xml_node one) {
    return std::string(one.child("Status").child("CharacteristicStatusEnum").text().get());
  };
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_STREQ(measured[s].name(), "CircularityCharacteristicMeasurement");
    expect_value(measured[s].child("Value"), value(result.sections[s].values, "RONt", "MZCI"));
    EXPECT_STREQ(measured[s].child("FeatureMeasurementIds").child("Id").text().get(),
                 features[s].attribute("id").value());
    EXPECT_EQ(status(measured[s]), "PASS");
  }
  expect_value(measured[3].child("Value"), value(datum, "coaxiality"));
  EXPECT_EQ(status(measured[3]), "FAIL");
  expect_value(measured[4].child("Value"), value(datum, "runout_total"));
  EXPECT_EQ(status(measured[4]), "INDETERMINATE");
  EXPECT_EQ(status(measured[5]), "PASS");
  EXPECT_STREQ(measured[6].name(), "ParallelismCharacteristicMeasurement");
  const pugi::xml_node definitions =
      qif.root().child("Characteristics").child("CharacteristicDefinitions");
  EXPECT_EQ(number(definitions.first_child().child("ToleranceValue")), 0.01);
  EXPECT_TRUE(definitions.child("StraightnessCharacteristicDefinition")
                  .child("ZoneShape")
                  .child("DiametricalZone"));
  EXPECT_STREQ(qif.measured().child("InspectionStatus").child("InspectionStatusEnum").text().get(),
               "FAIL");
}

TEST(Qif, PointsHaveNoPlaceInTheFrameAndALineOfSpaceIsStraightInACylinder) {
  std::vector<Point3> circle, line;
  for (int i = 0; i < 720; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 720.0;
    circle.push_back({7.0 + 5.0 * std::cos(t), 5.0 * std::sin(t), 1e-3 * std::cos(3.0 * t)});
    if (i < 40) line.push_back({0.01 * std::cos(i), 0.01 * std::sin(3.0 * i), 0.5 * i});
  }
  const QifReader ring(form_qif(assess_form(circle, Element::circle), {}, false));
  ring.expect_structure();
  ASSERT_EQ(ring.features().size(), 1U);
  EXPECT_FALSE(ring.features().front().child("Location"));
  const FormResult straight = assess_form(line, Element::line);
  const QifReader qif(form_qif(straight, {{"STRt", 1.0}}, false));
  qif.expect_structure();
  // Nobody told the noise of a point: no u, and then no mean error either.
  const pugi::xml_node measured = qif.characteristics().at(0).child("Value");
  EXPECT_NEAR(number(measured), straight.groups[0].values[0].estimate.value, last_digit);
  EXPECT_FALSE(measured.attribute("combinedUncertainty"));
  EXPECT_FALSE(measured.attribute("meanError"));
  EXPECT_TRUE(qif.root()
                  .child("Characteristics")
                  .child("CharacteristicDefinitions")
                  .first_child()
                  .child("ZoneShape")
                  .child("DiametricalZone"));
}

/// Points within 1 µm of an element about the direction (1, 2, 2) / 3, 60 mm off zero.
PointText points_near(Element element) {
  const std::array<double, 3> w{1.0 / 3, 2.0 / 3, 2.0 / 3}, u{2.0 / 3, 1.0 / 3, -2.0 / 3},
      v{2.0 / 3, -2.0 / 3, 1.0 / 3};
  PointText out;
  out.source = "points.txt";
  out.hash = "xxh3-64:0";
  for (int i = 0; i < 200; ++i) {
    const double t = 0.7 * i, s = std::sin(1.3 * i), off = 1e-3 * std::sin(3.1 * i * i);
    double r = 8.0 + off, h = 12.0 * s;
    if (element == Element::line) r = off;
    if (element == Element::circle) h = 0.0;
    if (element == Element::plane) r = 10.0 * s, h = off;
    if (element == Element::sphere) r = (8.0 + off) * std::sqrt(1.0 - s * s), h = (8.0 + off) * s;
    if (element == Element::cone) r += 0.2 * h;
    if (element == Element::torus)
      r = 20.0 + (3.0 + off) * std::cos(2.3 * i), h = (3.0 + off) * std::sin(2.3 * i);
    Point3 point{};
    for (std::size_t k = 0; k < 3; ++k)
      point[k] = 60.0 + r * (std::cos(t) * u[k] + std::sin(t) * v[k]) + h * w[k];
    out.points_mm.push_back(point);
    out.lines.push_back(out.lines.size() + 1);
  }
  return out;
}

/// What QIF 3.0 has of each element in addition to its place: the child that says its direction,
/// its sizes.
struct Written {
  Element element;
  std::string direction;
  std::set<std::string> sizes;
};
const Written written[] = {{Element::line, "Direction", {}},
                           {Element::circle, "Normal", {"Diameter"}},
                           {Element::plane, "Normal", {}},
                           {Element::sphere, "", {"Diameter"}},
                           {Element::cylinder, "Direction", {"Diameter"}},
                           {Element::cone, "Direction", {"Diameter", "HalfAngle"}},
                           {Element::torus, "AxisVector", {"MajorDiameter", "MinorDiameter"}}};

class QifElement : public ::testing::TestWithParam<Written> {};

TEST_P(QifElement, IsAMeasuredFeatureWithItsPlaceAndSize) {
  const Element element = GetParam().element;
  const PointText points = points_near(element);
  const AssociatedFeature of = associate(points.points_mm, element, Criterion::gaussian);
  ASSERT_EQ(of.status, AssociationStatus::converged) << of.why;
  const QifReader qif(association_qif(of, points));
  qif.expect_structure();
  ASSERT_EQ(qif.features().size(), 1U);
  const pugi::xml_node feature = qif.features().front();
  std::string kind = element_names[static_cast<std::size_t>(element)];
  kind.front() = static_cast<char>(std::toupper(kind.front()));
  EXPECT_EQ(feature.name(), kind + "FeatureMeasurement");
  const pugi::xml_node place = feature.child("Axis") ? feature.child("Axis") : feature;
  const pugi::xml_node at =
      place.child("AxisPoint") ? place.child("AxisPoint") : place.child("Location");
  const bool begins = element == Element::line || element == Element::cylinder;
  if (!begins) {
    expect_near(vector(at), of.feature.point_mm);
    EXPECT_NEAR(number(at.attribute("yCombinedUncertainty")), of.u.point_mm[1], last_digit);
  }
  for (const char* direction : {"Direction", "Normal", "AxisVector"}) {
    ASSERT_EQ(!place.child(direction).empty(), GetParam().direction == direction) << direction;
    if (place.child(direction)) {
      expect_near(vector(place.child(direction)), of.feature.direction);
    }
  }
  const auto expect = [&](const char* name, double value, double u) {
    ASSERT_EQ(!feature.child(name).empty(), GetParam().sizes.contains(name)) << name;
    if (!feature.child(name)) return;
    EXPECT_NEAR(number(feature.child(name)), value, last_digit) << name;
    EXPECT_NEAR(number(feature.child(name).attribute("combinedUncertainty")), u, last_digit)
        << name;
  };
  expect("Diameter", 2.0 * of.feature.radius_mm, 2.0 * of.u.radius_mm);
  expect("MajorDiameter", 2.0 * of.feature.radius_mm, 2.0 * of.u.radius_mm);
  expect("MinorDiameter", 2.0 * of.feature.minor_radius_mm, 2.0 * of.u.minor_radius_mm);
  EXPECT_EQ(!feature.child("Form"), element == Element::circle);  // a tube about it: no roundness
  if (feature.child("Form")) {
    EXPECT_NEAR(number(feature.child("Form")), of.zone_mm, last_digit);
  }
  EXPECT_EQ(!feature.child("HalfAngle").empty(), element == Element::cone);
  if (element == Element::cone) {  // degrees; 1 µm over 24 mm is 0.0024°
    EXPECT_NEAR(number(feature.child("HalfAngle")), std::atan(0.2) * 180.0 / std::numbers::pi,
                0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(All, QifElement, ::testing::ValuesIn(written), [](const auto& one) {
  return element_names[static_cast<std::size_t>(one.param.element)];
});

TEST(Qif, ACylinderBeginsAtItsFirstPointAndEndsAtItsLast) {
  const PointText points = points_near(Element::cylinder);
  const AssociatedFeature of =
      associate(points.points_mm, Element::cylinder, Criterion::minimum_zone);
  const QifReader qif(association_qif(of, points));
  const pugi::xml_node feature = qif.features().front();
  const auto start = vector(feature.child("Axis").child("AxisPoint"));
  const auto direction = vector(feature.child("Axis").child("Direction"));
  EXPECT_FALSE(feature.child("Diameter").attribute("combinedUncertainty"));  // by extremes: none
  double low = 1e9, high = -1e9;
  for (const Point3& point : points.points_mm) {
    double along = 0.0;
    for (std::size_t k = 0; k < 3; ++k) along += (point[k] - start[k]) * direction[k];
    low = std::min(low, along);
    high = std::max(high, along);
  }
  EXPECT_NEAR(low, 0.0, 1e-12);  // rounding of 100 mm
  EXPECT_NEAR(high, number(feature.child("Length")), 1e-12);
}

TEST(Qif, TheSameIsTheSameBytesAndAnythingElseHasAnotherId) {
  const FormResult result = of_a_shaft();
  const std::string text = form_qif(result, {}, true);
  EXPECT_EQ(text, form_qif(result, {}, true));
  EXPECT_EQ(schema_in(text.substr(0, 512)), "trueaxis.qif");
  const std::string id = QifReader(text).root().child("QPId").text().get();
  EXPECT_TRUE(std::regex_match(
      id, std::regex("[0-9a-f]{8}-[0-9a-f]{4}-3[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")))
      << id;
  FormResult other = result;
  other.input_hash = "xxh3-64:1";
  EXPECT_NE(id, QifReader(form_qif(other, {}, true)).root().child("QPId").text().get());
  EXPECT_EQ(text.find("Time"), std::string::npos);
}

TEST(Qif, DecimalsHaveNoExponent) {
  EXPECT_EQ(qif_decimal(1e-7), "0.0000001");
  EXPECT_EQ(qif_decimal(-0.0), "0");
  EXPECT_EQ(qif_decimal(1e22), "10000000000000000000000");
  EXPECT_EQ(qif_decimal(0.017453292519943295), "0.017453292519943295");
}

// An xs:decimal of more than 18 digits need not be read (XML Schema part 2, 3.2.3). 2⁻³⁰ has 30
// decimals: 9.31322574615478515625e-10; the last that is kept is rounded.
TEST(Qif, DecimalsHaveAtMost18Digits) {
  EXPECT_EQ(qif_decimal(std::ldexp(1.0, -30)), "0.000000000931322575");
  EXPECT_EQ(qif_decimal(-std::ldexp(1.0, -30)), "-0.000000000931322575");
  EXPECT_EQ(qif_decimal(5e-324), "0");
  EXPECT_EQ(qif_decimal(-5e-324), "0");
  EXPECT_EQ(qif_decimal(1.6e-18), "0.000000000000000002");
  EXPECT_EQ(std::strtod(qif_decimal(123456.78901234567).c_str(), nullptr), 123456.78901234567);
}

}  // namespace
}  // namespace trueaxis::testing
