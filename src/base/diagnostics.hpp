// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

/// Does `work`; what is wrong with its input joins `wrong`, a vector or a document of TOML.
/// @returns whether nothing was
template <class Wrong, class Work>
bool gather(Wrong& wrong, const Work& work) {
  try {
    work();
    return true;
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.diagnostics()) {
      if constexpr (requires { wrong.push_back(one); })
        wrong.push_back(one);
      else
        wrong.add(one);
    }
    return false;
  }
}

/// What `read` gives of each. @throws InputError with what is wrong in all of them
template <class All, class Read>
auto read_each(const All& all, const Read& read) {
  std::vector<std::decay_t<decltype(read(*std::begin(all)))>> out;
  std::vector<Diagnostic> wrong;
  for (const auto& one : all) gather(wrong, [&] { out.push_back(read(one)); });
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return out;
}

/// What `work` gives on what was read of a file.
/// @throws InputError whose diagnostics name this file where they named `given_as`
template <class Work>
auto of_file(const std::string& path, const Work& work, const char* given_as = "") {
  try {
    return work();
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& one : diagnostics)
      if (one.file == given_as) one.file = path;
    throw InputError(std::move(diagnostics));
  }
}

}  // namespace trueaxis
