// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Measured features and characteristics as a QIF 3.0 results document (ANSI/DMSC QIF, ISO 23952):
/// form.md says what is where. Lengths in mm, angles in degrees, as the file says them.
namespace trueaxis {

/// A number with its standard uncertainty (`combinedUncertainty`) and mean error (`meanError`),
/// which QIF wants both or not at all: with u = NaN neither is written.
struct QifValue {
  double value = 0.0;
  double u = std::numeric_limits<double>::quiet_NaN();
  double mean_error = 0.0;
};

/// A point (mm) or a unit vector; u as above, of each component.
struct QifVector {
  std::array<double, 3> value{};
  std::array<double, 3> u{QifValue{}.u, QifValue{}.u, QifValue{}.u};
  bool has_z = true;  ///< false: the third coordinate does not count, QIF's MOOT
};

enum class QifFeatureKind { line, circle, plane, sphere, cylinder, cone, torus };

/// A feature as it was measured; what is not there is not written.
struct QifFeature {
  QifFeatureKind kind = QifFeatureKind::circle;
  std::string name;       ///< FeatureName
  std::string algorithm;  ///< of QIF's enumeration ("LEASTSQUARES"), else in words
  /// Where a line and a cylinder begin, a cone is located; the centre; a point of a plane.
  std::optional<QifVector> point_mm{};
  std::optional<QifVector> direction{};
  std::optional<QifValue> minor_diameter_mm{};  ///< of a torus, whose `diameter_mm` is the major
  std::optional<QifValue> diameter_mm{}, half_angle_deg{}, length_mm{};
  std::optional<QifValue> form_mm{};  ///< roundness of a circle, flatness of a plane …
};

enum class QifStatus { pass, fail, indeterminate };

/// What was measured against one tolerance, by QIF's name of the characteristic.
struct QifCharacteristic {
  struct Measurement {
    QifValue value_mm;
    QifStatus status = QifStatus::indeterminate;
    std::optional<std::size_t> feature{};  ///< its place in `QifResults::features`
  };
  std::string kind;  ///< "Circularity", "TotalRunout" …
  std::string name;  ///< "RONt" …
  std::string zone;  ///< "DiametricalZone", "NonDiametricalZone"; empty: the kind has no shape
  double tolerance_mm = 0.0;
  std::vector<Measurement> measurements{};
};

struct QifResults {
  std::string description;  ///< of the whole, sentences
  std::vector<QifFeature> features{};
  std::vector<QifCharacteristic> characteristics{};
};

/// The document. It holds no time: the same results of the same `version` of TrueAxis are the same
/// bytes. Its QPId is the UUID (version 3, RFC 9562) of all else that it holds.
std::string qif_document(const QifResults& results, const std::string& version);

/// xs:decimal, which has no exponent: the fewest digits that are read as the same number. They are
/// not more than the 18 that every XML Schema processor must take (a length in mm then to 1e-18
/// mm).
std::string qif_decimal(double value);

}  // namespace trueaxis
