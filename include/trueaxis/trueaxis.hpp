// SPDX-License-Identifier: Apache-2.0
#pragma once

// Everything that trueaxis::core offers, from arrays to arrays. Inside mm, rad and s; X is a
// radius; results for people (FitParameter) are in mm, deg and 1, each with its unit. Files and the
// report belong to the command.

#include "trueaxis/association.hpp"        // an element through Cartesian points
#include "trueaxis/calibration.hpp"        // errors of a machine from measurements on it
#include "trueaxis/compensation.hpp"       // a program rewritten for a machine with errors
#include "trueaxis/control_table.hpp"      // a correction in the forms that controls read
#include "trueaxis/correction.hpp"         // target axis, correction table, actuator
#include "trueaxis/covariance.hpp"         // uncertainties that go together, by name
#include "trueaxis/datum_axis.hpp"         // the axis of a datum by another association
#include "trueaxis/diagnosis.hpp"          // what the ideal fit misses
#include "trueaxis/effect.hpp"             // the catalogue of effects
#include "trueaxis/effect_term.hpp"        // the terms that it knows, and columns of them
#include "trueaxis/error.hpp"              // InputError, ContractViolation
#include "trueaxis/fit.hpp"                // association of a surface
#include "trueaxis/fixture.hpp"            // a part on six locators, on its datums
#include "trueaxis/form.hpp"               // roundness, cylindricity, run-out with U
#include "trueaxis/job.hpp"                // streams in, verdict and table out
#include "trueaxis/machine.hpp"            // a machine of several axes, its errors, compensation
#include "trueaxis/machine_diagnosis.hpp"  // what the model of a machine gets wrong
#include "trueaxis/machine_job.hpp"        // measurements in, errors, verdict and program out
#include "trueaxis/machine_loop.hpp"       // what cuts told of the machine, for the next part
#include "trueaxis/part_form.hpp"          // form without what is not of the part
#include "trueaxis/probe_stream.hpp"       // the readings
#include "trueaxis/program_harm.hpp"       // what a diagnosis of a machine means on a program
#include "trueaxis/reason.hpp"             // why something is decided and what mends it, as data
#include "trueaxis/resimulation.hpp"       // the diagnosed part measured again
#include "trueaxis/spindle.hpp"            // part and spindle separated
#include "trueaxis/study.hpp"              // repeats against the Cramér-Rao bound
#include "trueaxis/surface.hpp"            // axis, cone and cylinder, a surface of one's own
#include "trueaxis/units.hpp"              // mm_per_um, rad_per_deg; a value with its uncertainty
#include "trueaxis/virtual_lathe.hpp"      // simulated streams with known truth
