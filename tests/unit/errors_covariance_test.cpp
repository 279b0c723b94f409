// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "machine/files/errors_files.hpp"
#include "machine/uncertainty.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

class ErrorsCovariance : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(places::scratch()) / "errors_covariance" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    machine_.machine =
        read_machine_toml(places::source() + "/data/five_axis/trunnion_ac.toml").machine;
  }
  std::string written(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }
  ErrorModel read(const std::vector<std::string>& paths) const {
    return read_errors(paths, machine_);
  }
  /// All messages about a file with this after its head.
  std::string refused(const std::string& text) const {
    const std::string path = written("wrong.toml", head_ + text);
    try {
      read({path});
    } catch (const InputError& error) {
      return error.what();
    }
    return "not refused";
  }
  void expect_refused(const std::string& text, std::initializer_list<const char*> parts) const {
    const std::string said = refused(text);
    for (const char* part : parts)
      EXPECT_NE(said.find(part), std::string::npos) << part << "\nin\n" << said;
  }

  std::filesystem::path folder_;
  MachineFile machine_;
  std::string head_ =
      "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
      "[[error]]\nname = \"X0C\"\nvalue_um = 25\nu_um = 2\n"
      "[[error]]\nname = \"B0C\"\nvalue_urad = 60\n";
  std::string table_ =
      "[covariance]\nlength = \"um\"\nangle = \"urad\"\n"
      "amounts = [{name = \"X0C\"}, {name = \"B0C\"}]\n";
};

TEST_F(ErrorsCovariance, UpToTheDiagonalOrWhole) {
  for (const char* matrix : {"matrix = [4, -3, 9]\n", "matrix = [4, -3, -3, 9]\n"}) {
    const ErrorModel errors = read({written("e.toml", head_ + table_ + matrix)});
    ASSERT_EQ(errors.covariance.names().size(), 2U);
    EXPECT_DOUBLE_EQ(errors.covariance.data()[0], 4e-6);
    EXPECT_DOUBLE_EQ(errors.covariance.data()[1], -3e-9);
    EXPECT_DOUBLE_EQ(errors.covariance.data()[2], -3e-9);
    EXPECT_DOUBLE_EQ(errors.covariance.data()[3], 9e-12);
    EXPECT_EQ(errors.terms[0].u, 0.0);  // it is in the matrix
  }
}

TEST_F(ErrorsCovariance, IsWrittenAndReadBack) {
  const std::string amounts =
      "[covariance]\nlength = \"mm\"\nangle = \"deg\"\namounts = [{name = \"X0C\"}, "
      "{name = \"EYX\", degree = 3, range_mm = [-200, 300]}, {name = \"EAC\", sin = 2}, "
      "{name = \"EXX\", cos = 1, period_mm = 20}]\n"
      "matrix = [4e-6, 1e-6, 1e-6, 0, 1e-7, 1e-6, 0, 0, 0, 1e-8]\n";
  const ErrorModel once = read({written("e.toml", head_ + amounts)});
  ASSERT_EQ(once.covariance.names().size(), 4U);
  EXPECT_EQ(to_string(once.covariance.names()[1]), "EYX.poly3");
  EXPECT_EQ(to_string(once.covariance.names()[2]), "EAC.sin2");
  EXPECT_DOUBLE_EQ(once.covariance.names()[2].high, two_pi);
  const ErrorModel twice = read({written("f.toml", errors_toml(once, &machine_.machine))});
  ASSERT_EQ(twice.covariance.names(), once.covariance.names());
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_NEAR(twice.covariance.data()[i], once.covariance.data()[i],
                1e-8 * std::abs(once.covariance.data()[i]));
}

// Several files are block diagonal; squares add for an amount that both have, and for a separate u.
TEST_F(ErrorsCovariance, FilesAreIndependent) {
  const std::string a = written("a.toml", head_ + table_ + "matrix = [4, -3, 9]\n");
  const std::string b =
      written("b.toml",
              "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
              "[covariance]\nlength = \"um\"\nangle = \"urad\"\n"
              "amounts = [{name = \"A0W\"}, {name = \"X0C\"}]\nmatrix = [1, 2, 16]\n");
  const std::string c = written("c.toml",
                                "schema = \"trueaxis.errors/1\"\nsign = \"moving_part\"\n"
                                "[[error]]\nname = \"X0C\"\nvalue_um = 1\nu_um = 3\n");
  const ErrorModel all = read({a, b, c});
  const double* m = all.covariance.data();  // X0C, B0C, A0W
  ASSERT_EQ(all.covariance.names().size(), 3U);
  EXPECT_NEAR(m[0], (4.0 + 16.0 + 9.0) * 1e-6, 1e-18);
  EXPECT_DOUBLE_EQ(m[1], -3e-9);
  EXPECT_DOUBLE_EQ(m[2], 2e-9);
  EXPECT_DOUBLE_EQ(m[5], 0.0);
  for (const ErrorTerm& term : all.terms) EXPECT_EQ(term.u, 0.0);
}

TEST_F(ErrorsCovariance, Refuses) {
  expect_refused(table_ + "matrix = [4, -3, 3, 9]\n", {"not symmetric: see B0C and X0C", ":14:"});
  expect_refused(table_ + "matrix = [4, 7, 9]\n", {"B0C and X0C", "product of their u"});
  expect_refused(table_ + "matrix = [4, 1]\n", {"2 amounts", "4 numbers, or 3 up to"});
  expect_refused(table_ + "matrix = [9, 1, 9]\n", {"u = 3 um of X0C, whose entries say 2"});
  expect_refused(table_, {"matrix", "4 numbers"});
  expect_refused("[covariance]\nlength = \"um\"\nangle = \"urad\"\nmatrix = [1]\n",
                 {"amounts", "is needed"});
  expect_refused("[covariance]\nangle = \"urad\"\namounts = [{name = \"X0C\"}]\nmatrix = [4]\n",
                 {"length"});
  const auto amounts = [](const std::string& list, const std::string& matrix) {
    return "[covariance]\nlength = \"um\"\nangle = \"urad\"\namounts = [" + list + "]\nmatrix = [" +
           matrix + "]\n";
  };
  expect_refused(amounts("{name = \"X0Q\"}, {name = \"X0B\"}", "1, 0, 1"),
                 {"X0Q", "not an error", "X0B", "this machine does not have"});
  expect_refused(amounts("{name = \"X0C\"}, {name = \"X0C\"}", "4, 0, 4"), {"second time"});
  expect_refused(amounts("{name = \"X0C\", degree = 2, range_mm = [0, 1]}", "4"),
                 {"location error"});
  expect_refused(amounts("{name = \"EXX\", degree = 2}", "4"), {"range_mm", "is needed"});
  expect_refused(amounts("{name = \"EXX\", degree = 2, cos = 1}", "4"), {"remove the others"});
  expect_refused(amounts("{name = \"EXX\", order = 2}", "4"), {"order"});
  expect_refused(amounts("{name = \"Y0X\"}", "4"), {"no effect"});
  // mm² in place of µm².
  expect_refused(
      "[covariance]\nlength = \"mm\"\nangle = \"urad\"\namounts = [{name = \"Y0C\"}]\n"
      "matrix = [36]\n",
      {"as u makes Y0C 6 mm", "large_errors = true"});
  EXPECT_EQ(refused("[covariance]\nlength = \"mm\"\nangle = \"urad\"\namounts = [{name = "
                    "\"Y0C\"}]\nmatrix = [36]\n")
                .find("has no key"),
            std::string::npos);
  // Three that are each −0.9 of the others: no numbers are.
  expect_refused(
      amounts("{name = \"Y0C\"}, {name = \"Z0A\"}, {name = \"Y0A\"}", "1, -0.9, 1, -0.9, -0.9, 1"),
      {"negative variance", "-0.8"});
}

TEST_F(ErrorsCovariance, SaysOfWhichMachine) {
  const ErrorModel errors = read({written("e.toml", head_)});
  const std::string text = errors_toml(errors, &machine_.machine);
  read({written("same.toml", text)});
  // Work offsets, tools and limits do not count, and any point of a line is the line.
  MachineFile other = machine_;
  other.machine.tool.length_mm += 10.0;
  other.machine.work_offsets[0]->bed_from_program.origin_mm[0] += 5.0;
  other.machine.axes[0].low = -1.0;
  for (MachineAxis& axis : other.machine.axes)
    if (axis.name == AxisName::C) axis.point_mm[2] += 33.0;
  const std::string path = written("same.toml", text);
  EXPECT_NO_THROW(read_errors(std::vector{path}, other));
  const auto said = [&](const MachineFile& of) -> std::string {
    try {
      read_errors(std::vector{path}, of);
    } catch (const InputError& error) {
      return error.what();
    }
    return "not refused";
  };
  MachineFile moved = machine_;
  for (MachineAxis& axis : moved.machine.axes)
    if (axis.name == AxisName::C) axis.point_mm[0] += 0.01;
  EXPECT_NE(said(moved).find("\"C about 0 0 1 through 5 -10 0\", and this machine \"C about 0 0 1 "
                             "through 5.01 -10 0\""),
            std::string::npos)
      << said(moved);
  MachineFile turned = machine_;
  for (double& one : turned.machine.axes[1].direction) one = -one;
  EXPECT_NE(said(turned).find("\"A about 1 0 0"), std::string::npos) << said(turned);
  MachineFile renamed = machine_;
  renamed.machine.name = "another";
  EXPECT_NE(said(renamed).find("is \"trunnion AC\", and this machine is \"another\""),
            std::string::npos)
      << said(renamed);
}

}  // namespace
}  // namespace trueaxis
