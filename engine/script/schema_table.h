#pragma once
/// The rows behind schema.h.

#include "engine/script/schema.h"

#include <array>

namespace stadion::schema_table {

extern const std::span<const AttributeSpec> kCommon;
extern const std::span<const AttributeSpec> kPlaced;
extern const std::array<NodeSpec, kNodeKindCount> kNodes;    // in the order of NodeKind
extern const std::array<CommandSpec, kVerbCount> kCommands;  // in the order of Verb
extern const std::array<EventSpec, kEventCount> kEvents;     // in the order of Event
extern const KindSet kPlacedKinds;
extern const KindSet kFieldKinds;
extern const KindSet kPacedKinds;

}  // namespace stadion::schema_table
