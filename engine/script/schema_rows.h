#pragma once
/// What rows of several kinds of node have in common: ranges, sets of kinds, and attributes that many take.

#include "engine/script/schema.h"

namespace stadion::schema_table {

using enum NodeKind;
using enum ValueKind;

inline constexpr double kFar = 1e6;   // nothing in a show is farther away, or larger, than this [m]
inline constexpr double kLong = 1e6;  // nor lasts longer [s]

inline constexpr NumberRange kPlace{-kFar, kFar};
inline constexpr NumberRange kLength{0, kFar, true};
inline constexpr NumberRange kDistance{0, kFar};
inline constexpr NumberRange kTime{0, kLong, true};
inline constexpr NumberRange kUnitInterval{0, 1};
inline constexpr NumberRange kColourRange{0, 1};
inline constexpr NumberRange kTurn{-36000, 36000};
inline constexpr NumberRange kForce{-kFar, kFar};

inline constexpr KindSet kFields{ForceLinear, ForceSpherical, ForcePoint, ForceVortex, Medium};
inline constexpr KindSet kMovable =
    KindSet{Group, Transform, Lod,   Object,      DynObject,   Light, Text,
            Path,  Sway,      Sound, UserTrigger, WandTrigger, Scene, Measure} |
    kFields;
inline constexpr KindSet kParents{Group, Transform, Lod, Object, DynObject, Path, Sway, Scene, Rig};
inline constexpr KindSet kSolid{Object, DynObject};
inline constexpr KindSet kSwitched =
    KindSet{UserTrigger, WandTrigger, Timer, Light, Path, Sway, Sound, Navigator, Dynamics, Collision} |
    kFields;

/// Those whose cycle may run more seldom, and those that have such below them.
inline constexpr KindSet kPaced{Scene, Path, Sway, Collision, Dynamics};
inline constexpr std::string_view kConcessions[] = {"lod", "half", "rest", "hide"};

inline constexpr AttributeSpec kCommonRows[] = {
    {.attr = Attr::Name, .kind = NewName, .help = "how other nodes call this one; unique in its file"},
    {.attr = Attr::EventMessage,
     .kind = ValueKind::EventMessage,
     .help = "what to tell another node when an event happens here",
     .repeatable = true},
    {.attr = Attr::Budget,
     .kind = Number,
     .help = "what it, with all below it, may cost in a frame: App, and Cull and Draw of all walls; more is "
             "told",
     .unit = "ms",
     .range = {0, 10000, true}},
    {.attr = Attr::OnOverrun,
     .kind = Choices,
     .help = "what a live show may take from it, in this order, while it costs more than its budget: lod "
             "(detail), half (runs in every second frame, then every fourth), rest (stands still), hide (is "
             "not drawn)",
     .choices = kConcessions},
    {.attr = Attr::Priority,
     .kind = Number,
     .help = "when the whole frame takes too long, who has the lowest gives up first",
     .standard = "1",
     .range = {0, 1000}},
};

inline constexpr AttributeSpec kPlacedRows[] = {
    {.attr = Attr::Parent,
     .kind = Reference,
     .help = "the node whose coordinates this one is placed in; the world if there is none",
     .targets = kParents},
    {.attr = Attr::Position,
     .kind = Vector,
     .help = "the origin in the parent's coordinates",
     .standard = "0, 0, 0",
     .unit = "m",
     .range = kPlace},
    {.attr = Attr::Orientation,
     .kind = Vector,
     .help = "rotations about the parent's X axis, then Y, then Z",
     .standard = "0, 0, 0",
     .unit = "degrees",
     .range = kTurn},
    {.attr = Attr::Scale,
     .kind = Scale,
     .help = "size relative to the original, one factor or one for each axis",
     .standard = "1",
     .range = {0, kFar, true}},
};

inline constexpr AttributeSpec kAttachRow{.attr = Attr::Attach,
                                          .kind = Reference,
                                          .help = "the node that the field moves and turns with",
                                          .targets = kMovable | KindSet{Rig}};
inline constexpr AttributeSpec kInitOn{
    .attr = Attr::InitState, .kind = Flag, .help = "whether it is enabled at the start", .standard = "on"};

}  // namespace stadion::schema_table
