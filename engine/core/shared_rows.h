#pragma once
/// What the descriptors of several node types have in common: ranges, attributes and commands.

#include "engine/core/node_type.h"

namespace stadion {

inline constexpr double kFar = 1e6;   ///< no length or distance in a show is greater [m]
inline constexpr double kLong = 1e6;  ///< no time in a show is longer [s]

inline constexpr NumberRange kPlaceRange{-kFar, kFar};
inline constexpr NumberRange kLengthRange{0, kFar, true};
inline constexpr NumberRange kDistanceRange{0, kFar};
inline constexpr NumberRange kTimeRange{0, kLong, true};
inline constexpr NumberRange kUnitInterval{0, 1};
inline constexpr NumberRange kColourRange{0, 1};
inline constexpr NumberRange kTurnRange{-36000, 36000};
inline constexpr NumberRange kForceRange{-kFar, kFar};

/// Types of nodes that a path, a sway or a force field may move or follow.
inline constexpr NodeFilter kPlacedOrRig{{Trait::Placed}, {"rig"}};
inline constexpr NodeFilter kModelTypes{{Trait::Model}};
inline constexpr NodeFilter kFieldTypes{{Trait::Field}};
/// Types of nodes that may run less often or have such nodes below them.
inline constexpr NodeFilter kPacedTypes{{Trait::Degradable, Trait::Encloses}};

inline constexpr std::string_view kDegradationWords[] = {"lod", "half", "rest", "hide"};

/// Attributes of every node.
inline constexpr AttributeSpec kCommonRows[] = {
    {.name = "name", .kind = ValueKind::NewName, .help = "how other nodes call this one; unique in its file"},
    {.name = "eventmessage",
     .kind = ValueKind::EventMessage,
     .help = "what to tell another node when an event happens here",
     .repeatable = true},
    {.name = "budget",
     .kind = ValueKind::Number,
     .help = "what it, with all below it, may cost in a frame: App, and Cull and Draw of all walls; more is "
             "told",
     .unit = "ms",
     .range = {0, 10000, true}},
    {.name = "onoverrun",
     .kind = ValueKind::Choices,
     .help = "what a live show may take from it, in this order, while it costs more than its budget: lod "
             "(detail), half (runs in every second frame, then every fourth), rest (stands still), hide (is "
             "not drawn)",
     .choices = kDegradationWords},
    {.name = "priority",
     .kind = ValueKind::Number,
     .help = "when the whole frame takes too long, the node with the lowest is degraded first",
     .standard = "1",
     .range = {0, 1000}},
};

/// Attributes of every node with Trait::Placed, beside the common ones.
inline constexpr AttributeSpec kPlacedRows[] = {
    {.name = "parent",
     .kind = ValueKind::Reference,
     .help = "the node whose coordinates this one is placed in; the world if there is none",
     .targets = {{Trait::Parent}}},
    {.name = "position",
     .kind = ValueKind::Vector,
     .help = "the origin in the parent's coordinates",
     .standard = "0, 0, 0",
     .unit = "m",
     .range = kPlaceRange},
    {.name = "orientation",
     .kind = ValueKind::Vector,
     .help = "rotations about the parent's X axis, then Y, then Z",
     .standard = "0, 0, 0",
     .unit = "degrees",
     .range = kTurnRange},
    {.name = "scale",
     .kind = ValueKind::Scale,
     .help = "size relative to the original, one factor or one for each axis",
     .standard = "1",
     .range = {0, kFar, true}},
};

/// Attributes of every node with a model (kPaintedTraits), beside the common ones.
inline constexpr AttributeSpec kPaintRows[] = {
    {.name = "tint",
     .kind = ValueKind::Colour,
     .help = "what the model's colours are multiplied with: red, green, blue (sRGB)",
     .standard = "1, 1, 1",
     .range = kColourRange},
    {.name = "emit",
     .kind = ValueKind::Colour,
     .help = "what the model glows with beside its own glow: red, green, blue (sRGB)",
     .standard = "0, 0, 0",
     .range = kColourRange},
    {.name = "opacity",
     .kind = ValueKind::Number,
     .help = "what the model's alpha is multiplied with; below 1 it is seen through, at 0 it is not drawn",
     .standard = "1",
     .range = kUnitInterval},
};
inline constexpr TraitSet kPaintedTraits{Trait::Model, Trait::Figure};

/// Most types with Trait::Switched take it.
inline constexpr AttributeSpec kInitStateRow{.name = "initstate",
                                             .kind = ValueKind::Flag,
                                             .help = "whether it is enabled at the start",
                                             .standard = "on"};

/// Commands of types with Trait::Switched.
inline constexpr CommandSpec kSwitchCommands[] = {
    {"enable", ArgumentKind::None, "enable",
     "begins to act; restarts a field's duration, an ended path, and every sound"},
    {"disable", ArgumentKind::None, "disable", "stops acting"},
    {"toggle", ArgumentKind::None, "toggle", "enables if disabled, disables if enabled"},
};
/// Commands of types with Trait::Placed.
inline constexpr CommandSpec kPlacedCommands[] = {
    {"attach", ArgumentKind::PartAndTracker, "attach all|position|orientation [TRACKER]",
     "follows a tracker (foot, else wand, if none is named)"},
    {"detach", ArgumentKind::None, "detach",
     "follows no tracker any more; its parent carries it again, from where it is"},
    {"show", ArgumentKind::None, "show", "becomes visible, with all below it"},
    {"hide", ArgumentKind::None, "hide", "becomes invisible, with all below it"},
};
/// Commands of types with kPaintedTraits.
inline constexpr CommandSpec kPaintCommands[] = {
    {"tint", ArgumentKind::Colour, "tint R G B",
     "multiplies the model's colours with this one (sRGB); 1 1 1 leaves them as they are"},
    {"emit", ArgumentKind::Colour, "emit R G B",
     "adds this colour (sRGB) to the model's own glow; 0 0 0 leaves it as it is"},
    {"opacity", ArgumentKind::Share, "opacity SHARE",
     "multiplies the model's alpha; below 1 it is seen through, at 0 it is not drawn"},
};
/// Commands of every node.
inline constexpr CommandSpec kCommonCommands[] = {
    {"reset", ArgumentKind::None, "reset", "returns to the state it was declared in"},
};

}  // namespace stadion
