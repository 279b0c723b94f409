// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "correct/precompensate.hpp"
#include "correct/spectrum.hpp"

namespace trueaxis {

/// What the actuator has to do for a profile at `speed_rpm` and what it has left, from its
/// frequency response; `max_speed_rpm` is left 0. The run is taken as steady: without the transient
/// of its start.
ActuatorMargin margin_at(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator,
                         double speed_rpm);

/// The same for a run that differs from the profile's in its rows per revolution too.
ActuatorMargin margin_at(const Spectrum& spectrum, const Motion& motion, const Actuator& actuator);

/// Whether precompensation is asked for and set-points come often enough for all orders that
/// matter: else what it asks of the actuator is without bound, and the wanted profile is what is
/// sent.
bool can_precompensate(const Spectrum& spectrum, const Motion& motion, const Actuator& actuator);

/// The highest speed at which margin_at follows; 0: at none. Never above the actuator's bandwidth
/// in revolutions.
double max_speed_rpm(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator);

/// The speed at which the highest order that matters comes at a third of the bandwidth (Eq. 117):
/// there an actuator of second order lags by 28° at a gain of 0.996; above, what is sent
/// ahead rests on the model of the actuator more than on the actuator.
/// @param at what margin_at() found at `speed_rpm`
double trusted_speed_rpm(const ActuatorMargin& at, double speed_rpm);

/// What would make a profile that breaks a limit follow: more rows per revolution if the
/// interpolation between them breaks it, faster set-points if the sampling does, else the speed.
/// Each was tried, alone.
Reason remedy(const Spectrum& spectrum, const Profile& profile, const Actuator& actuator,
              double max_speed_rpm);

}  // namespace trueaxis
