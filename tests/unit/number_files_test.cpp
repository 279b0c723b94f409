// SPDX-License-Identifier: Apache-2.0
// Files of tests/data/numbers: made by numpy, scipy, h5py and zipfile (make_number_files.py), whose
// formulas are repeated here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "associate/files/association_files.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "interchange/formats.hpp"
#include "interchange/number_file.hpp"
#include "recording/import.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t count = 24;
// cos and sin of two libraries are within an ulp or two of 1, times 20 mm.
constexpr double rounding_mm = 20.0 * 4.0 * 2.3e-16;

std::string made(const std::string& name) {
  return (fs::path(places::source()) / "tests/data/numbers" / name).string();
}

double turn(std::size_t i) {
  return 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
}

Point3 point(std::size_t i) {
  return {1.0 + 20.0 * std::cos(turn(i)), -2.0 + 20.0 * std::sin(turn(i)), 3.0};
}

/// Everything that a call says is wrong.
template <class Reading>
std::string refusal(Reading&& reading) {
  try {
    reading();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

struct Cloud {
  const char *name, *unit, *array;
  double tolerance_mm = rounding_mm;
};

class NumberFilesPoints : public ::testing::TestWithParam<Cloud> {};

TEST_P(NumberFilesPoints, AreThoseOfTheFormula) {
  const auto& [name, unit, array, tolerance_mm] = GetParam();
  const PointText got = read_points(made(name), unit, array);
  ASSERT_EQ(got.points_mm.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(got.lines[i], i + 1);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(got.points_mm[i][k], point(i)[k], tolerance_mm) << name << " point " << i + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, NumberFilesPoints,
    ::testing::Values(Cloud{"points.npy", "mm", ""}, Cloud{"points_fortran.npy", "mm", ""},
                      Cloud{"points_big_endian.npy", "mm", ""},
                      Cloud{"points_um_int32.npy", "um", "", 0.5e-3 * 1.0001},  // whole micrometres
                      Cloud{"points_records.npy", "mm", ""},
                      Cloud{"points_records.npy", "mm", "x,y,z"}, Cloud{"stream.mat", "mm", ""},
                      Cloud{"stream_packed.mat", "mm", "points"}, Cloud{"points.h5", "", ""},
                      Cloud{"points.h5", "um", "cloud"}, Cloud{"two_clouds.h5", "mm", "second"},
                      Cloud{"points.x3p", "", ""}, Cloud{"points.x3p", "m", ""},
                      Cloud{"points_in_xml.x3p", "", ""}));

TEST(NumberFiles, AnX3pSurfaceHasSteppedAxesARotationAnOffsetAndInvalidPoints) {
  const PointText got = read_points(made("surface.x3p"), "");
  ASSERT_EQ(got.points_mm.size(), 18U);  // bits 2 and 19 of 20 are 0
  EXPECT_EQ(got.lines.front(), 1U);
  EXPECT_EQ(got.lines[2], 4U);  // the third is not used
  ASSERT_EQ(got.notes.size(), 1U);
  EXPECT_NE(got.notes[0].find("2 of 20 points are marked invalid"), std::string::npos);
  for (std::size_t i = 0; i < got.points_mm.size(); ++i) {
    const std::size_t at = got.lines[i] - 1;
    const double x = 1e-2 * static_cast<double>(at % 5), y = 2e-2 * static_cast<double>(at / 5);
    const double z = 1e-6 * std::rint(1e3 * std::cos(static_cast<double>(at)));
    // Q = R P + T with R a quarter turn, T = 1 mm along x; each number is rounded a few times.
    EXPECT_NEAR(got.points_mm[i][0], 1.0 - y, 1e-15);
    EXPECT_NEAR(got.points_mm[i][1], x, 1e-16);
    EXPECT_NEAR(got.points_mm[i][2], z, 1e-18);
  }
}

TEST(NumberFiles, AnX3pThatIsWrittenAgainHoldsTheSameBytesOfNumbers) {
  const PointText first = read_points(made("points.x3p"), "");
  const fs::path folder = fs::path(places::scratch()) / "number_files";
  fs::create_directories(folder);
  const std::string written = x3p_of_points(metres_of(first), "0");
  std::ofstream(folder / "again.x3p", std::ios::binary) << written;
  const PointText again = read_points((folder / "again.x3p").string(), "");
  EXPECT_EQ(again.metres, first.metres);  // every bit, and not only nearly
  EXPECT_EQ(again.points_mm, first.points_mm);
  EXPECT_TRUE(again.notes.empty());  // its sums are there and agree
  EXPECT_EQ(written, x3p_of_points(metres_of(again), "0"));
  EXPECT_EQ(schema_in(std::string_view(written).substr(0, 512)), "trueaxis.cloud");
}

struct Readings {
  const char *name, *columns;
};
class NumberFilesStreams : public ::testing::TestWithParam<Readings> {};

TEST_P(NumberFilesStreams, AreThoseOfTheFormula) {
  RecordingOptions options;
  options.columns = GetParam().columns;
  options.read.diameter = false;
  const ImportedRecording got = import_recording(made(GetParam().name), options);
  ASSERT_EQ(got.stream.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(got.stream.reading_mm[i], 20.0 + 0.05 * std::cos(turn(i)), rounding_mm);
    EXPECT_NEAR(got.stream.c_rad[i], turn(i), 4.0 * 2.3e-16 * 7.0);
    EXPECT_EQ(got.stream.position_mm[i], -10.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, NumberFilesStreams,
    ::testing::Values(Readings{"stream.npz", "X=1[mm],C=2[deg],Z=3[mm]"},
                      Readings{"stream.h5", ""},  // X in m, C in rad, Z in mm by its attributes
                      Readings{"stream.mat", "X=1[mm],C=2[deg],Z=3[mm]"},
                      Readings{"stream_73.mat", "X=2[mm],C=1[deg],Z=3[mm]"},
                      Readings{"stream_packed.mat", "X=1[mm],C=2[deg],Z=3[mm]"}));

TEST(NumberFiles, AUnitThatNobodySaysIsAskedForWithWhatWouldReadIt) {
  const std::string cloud = refusal([] { read_points(made("points.npy"), ""); });
  EXPECT_NE(cloud.find("does not state the unit"), std::string::npos) << cloud;
  EXPECT_NE(cloud.find("--unit mm"), std::string::npos) << cloud;
  RecordingOptions options;
  options.read.diameter = false;
  const std::string stream = refusal([&] { import_recording(made("stream.npz"), options); });
  EXPECT_NE(stream.find("column 2 (C) (C) has no unit"), std::string::npos) << stream;
  EXPECT_NE(stream.find("--columns 'X=1[mm],C=2[deg],Z=3[mm]'"), std::string::npos) << stream;
}

// 0.1 µm of a packed number, rounded.
TEST(NumberFiles, WhatNetCdfPacksIsUnpackedAndWhatIsMissingIsNoReading) {
  RecordingOptions options;
  options.read.diameter = false;
  const std::string missing = refusal([&] { import_recording(made("packed.h5"), options); });
  EXPECT_NE(missing.find("1 row has no value"), std::string::npos) << missing;
  options.read.drop_invalid = true;
  const ProbeStream stream = import_recording(made("packed.h5"), options).stream;
  ASSERT_EQ(stream.size(), count - 1);
  for (std::size_t k = 0; k < stream.size(); ++k) {
    const std::size_t i = k < 5 ? k : k + 1;
    EXPECT_NEAR(stream.reading_mm[k], 20.0 + 0.05 * std::cos(turn(i)), 0.5e-4 + rounding_mm) << i;
  }
}

TEST(NumberFiles, APassInAShorterGroupIsNotDropped) {
  RecordingOptions options;
  options.read.diameter = false;
  const std::string said = refusal([&] { import_recording(made("passes.h5"), options); });
  EXPECT_NE(said.find("pass1/C (10 rows) and pass2/C (14 rows) could both be C"), std::string::npos)
      << said;
}

struct Wrong {
  const char *name, *says;
  const char *unit = "mm", *array = "";
};
class NumberFilesRefused : public ::testing::TestWithParam<Wrong> {};

TEST_P(NumberFilesRefused, WithItsReason) {
  const auto& [name, says, unit, array] = GetParam();
  const std::string said = refusal([&] { read_points(made(name), unit, array); });
  EXPECT_NE(said.find(says), std::string::npos) << name << ": " << said;
  EXPECT_NE(said.find(name), std::string::npos) << said;  // the file is named
}

INSTANTIATE_TEST_SUITE_P(
    Broken, NumberFilesRefused,
    ::testing::Values(
        Wrong{"complex.npy", "complex numbers"}, Wrong{"cube.npy", "3 dimensions"},
        Wrong{"objects.npy", "Python objects"}, Wrong{"cut.npy", "truncated"},
        Wrong{"huge.npy", "more than TrueAxis reads from one file"},
        Wrong{"sparse.h5", "with the arrays before it"},
        Wrong{"points_lying.npy", "a point is a row"},
        Wrong{"points_nan.npy", ":4:2: y is not a finite number"},
        Wrong{"points.npy", "names no array", "mm", "P"},
        Wrong{"cut.npz", "is not a complete zip archive"}, Wrong{"changed.npz", "is broken"},
        Wrong{"bomb.npz", "npy"}, Wrong{"cut.mat", "incomplete"},
        Wrong{"only_complex.h5", "complex numbers or records", ""},
        Wrong{"cut.h5", "is not a complete HDF5 file", ""},
        Wrong{"changed.h5", "cannot be read", ""}, Wrong{"elsewhere.h5", "stored in another file"},
        Wrong{"two_clouds.h5", "is not clear"}, Wrong{"no_units.h5", "does not state the unit", ""},
        Wrong{"points.h5", "remove --unit"}, Wrong{"points.x3p", "remove --unit"},
        Wrong{"cut.x3p", "is not a complete zip archive", ""},
        Wrong{"other_data.x3p", "the MD5 sum of bindata/data.bin", ""},
        Wrong{"other_xml.x3p", "the MD5 sum of main.xml", ""},
        Wrong{"too_many.x3p", "main.xml says 25 points", ""},
        Wrong{"endless.x3p", "is not a valid count of points", ""}));

/// A NumPy file of a header alone.
std::string npy_of_shape(const std::string& shape) {
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header;
}

TEST(NumberFiles, AnArrayWithoutANumberIsNoTableHoweverLongItSaysItIs) {
  for (const char* shape : {"(1000000000000000000, 0)", "(0, 1000000000000000000)", "(0, 3)"}) {
    const std::string said = refusal([&] { read_number_file("empty.npy", npy_of_shape(shape)); });
    EXPECT_NE(said.find("(no numbers)"), std::string::npos) << shape << ": " << said;
  }
}

TEST(NumberFiles, WhatAFileMayHoldIsSharedByItsArrays) {
  const std::string path = "many";
  NumberBudget budget(path);
  EXPECT_EQ(budget.take("a", most_numbers / 2, 1), most_numbers / 2);
  EXPECT_EQ(budget.take("b", 0, ~std::size_t{0}), 0U);
  EXPECT_EQ(budget.take("c", 1, most_numbers / 2 - 1), most_numbers / 2 - 1);
  EXPECT_THROW(budget.take("d", 1, 2), InputError);
  EXPECT_EQ(budget.take("e", 1, 1), 1U);
}

TEST(NumberFiles, AMatlabFileIsReadFromTheBytesThatWereHashed) {
  const std::string bytes = read_file(made("stream.mat"));
  // By another name, such as that of standard input, or of a file that was changed since.
  for (const std::string& path : {std::string("-"), made("points.npy")}) {
    const NumberFile file = read_number_file(path, bytes);
    const auto x = std::ranges::find(file.arrays, "X", &NumberArray::name);
    ASSERT_NE(x, file.arrays.end()) << path;
    ASSERT_EQ(x->rows, count);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(x->values[i], 20.0 + 0.05 * std::cos(turn(i)), rounding_mm);
  }
}

TEST(NumberFiles, AMatlabFileOfVersion4IsNamed) {
  const std::string head("\0\0\0\0\3\0\0\0\1\0\0\0\0\0\0\0\2\0\0\0X\0", 22);
  const std::string bytes = head + std::string(24, '\0');
  ASSERT_TRUE(is_number_file(bytes));
  EXPECT_TRUE(may_be_number_file(bytes));
  const std::string said = refusal([&] { read_number_file("m4.mat", bytes); });
  EXPECT_NE(said.find("version 4: save it anew"), std::string::npos) << said;
}

TEST(NumberFiles, AColumnThatIsAnElementShortIsNamedWithItsLength) {
  RecordingOptions options;
  options.read.diameter = false;
  options.columns = "X=X[mm],C=rate[deg],Z=Z[mm]";
  const std::string said = refusal([&] { import_recording(made("stream.npz"), options); });
  EXPECT_NE(said.find("the array rate (1 rows) cannot be a column, as the longest has"),
            std::string::npos)
      << said;
}

TEST(NumberFiles, AFileThatCannotBeReadOnIsNoShortFile) {
  const std::string said = refusal([] { read_file("/proc/self/mem"); });  // address 0
  EXPECT_NE(said.find("cannot be read (Input/output error)"), std::string::npos) << said;
}

TEST(NumberFiles, APackedFileThatIsNoneOfThemIsLeftToOthers) {
  EXPECT_FALSE(is_number_file("PK\x03\x04 a workbook"));
  EXPECT_FALSE(is_number_file("1 2 3\n"));
  EXPECT_TRUE(is_number_file(read_file(made("points.x3p"))));
}

}  // namespace
}  // namespace trueaxis
