#pragma once
/// Messages to figures, as far as the file's own clips decide whether they can be carried out.

#include "engine/figure/skeleton.h"
#include "engine/script/event_message.h"

#include <string>

namespace stadion {

/// Why a figure with these clips cannot do what the message asks of it; empty if it can, or if the message
/// concerns no clip.
std::string faultOfClips(const EventMessage& message, const Skeleton& skeleton);

}  // namespace stadion
