// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/program_harm.hpp"

namespace trueaxis {

/// `program` of trueaxis.machine_diagnosis: the file, every effect's largest displacement of the
/// tip with its line, U of the tip now and after every plan; mm and degrees.
Json harm_object(const ProgramHarm& harm);

/// For a terminal: µm.
std::string harm_text(const ProgramHarm& harm);

/// Two lines of it for a screen: what does most, and the tip's U.
std::string harm_screen(const ProgramHarm& harm);

}  // namespace trueaxis
