// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "studies/published/published_toml.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::testing {

inline study::Sweep parse_sweep(const std::string& text) {
  return parse_published_sweep(text, "sweep.toml").sweep;
}

/// All messages about a wrong sweep.
inline std::string complaints_of_sweep(const std::string& text) {
  try {
    parse_sweep(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline void expect_complaint(const std::string& text, const std::string& expected) {
  const std::string said = complaints_of_sweep(text);
  EXPECT_NE(said.find(expected), std::string::npos)
      << "expected: " << expected << "\nsaid: " << said;
}

}  // namespace trueaxis::testing
