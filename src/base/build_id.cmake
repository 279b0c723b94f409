# SPDX-License-Identifier: Apache-2.0
# cmake -DFILES=<relative names> -DOUT=<file.cpp> -P build_id.cmake, in the source folder
# Writes what build_id.hpp declares; a file that would be the same is left alone.
cmake_minimum_required(VERSION 3.25)
foreach(file IN LISTS FILES)
  file(SHA256 "${file}" hash)
  string(APPEND all "${file} ${hash}\n")
endforeach()
string(SHA256 id "${all}")
string(SUBSTRING "${id}" 0 16 id)
file(CONFIGURE OUTPUT "${OUT}" @ONLY CONTENT "// SPDX-License-Identifier: Apache-2.0
#include \"base/build_id.hpp\"

const char* const trueaxis::build_id = \"@id@\";
")
