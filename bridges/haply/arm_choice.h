#pragma once

/// Which devices of the service a bridge uses, and whether they can be used.

#include <string>

#include "haply/service_message.h"

namespace glissade::bridges {

/// The arm with this id, or the only one if `id` is empty. Throws WireError, which lists the arms, if there is none or
/// more than one.
const HaplyArm& chosen_arm(const ServiceMessage& message, const std::string& id);

/// The VerseGrip with this id, or the only one if `id` is empty; null if there is none. Throws WireError if there are
/// more and `id` is empty.
const HaplyHandle* chosen_handle(const ServiceMessage& message, const std::string& id);

/// What keeps an arm from being used, and what helps; empty if nothing does.
std::string trouble_of(const HaplyArm& arm);

}  // namespace glissade::bridges
