// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trueaxis {

/// A line "note …" for each remark, up to its first colon: what follows is for those who ask for
/// more.
inline std::string notes_screen(const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks)
    text += "note   " + remark.substr(0, remark.find(": ")) + '\n';
  return text;
}

/// The same in a screen, before its line "next".
inline std::string with_notes(std::string screen, const std::vector<std::string>& remarks) {
  const std::size_t next = screen.rfind("\nnext ");
  return screen.insert(next == std::string::npos ? screen.size() : next + 1, notes_screen(remarks));
}

}  // namespace trueaxis
