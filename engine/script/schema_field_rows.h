#pragma once
/// The attributes of force fields.

#include "engine/script/schema_rows.h"

namespace stadion::schema_table {

inline constexpr std::string_view kDeviceAxes[] = {"0", "1", "2", "3", "4", "5", "6", "7"};
inline constexpr std::string_view kForceUnits[] = {"g", "m/s2", "N"};
inline constexpr std::string_view kFieldModes[] = {"attract", "repel"};
inline constexpr std::string_view kFalloffs[] = {"none", "linear", "square"};

inline constexpr AttributeSpec kFieldDuration{
    .attr = Attr::Duration,
    .kind = Number,
    .help = "longest time that one activation lasts; without it, until disabled",
    .unit = "s",
    .range = kTime};
inline constexpr AttributeSpec kFieldUnit{
    .attr = Attr::Unit,
    .kind = Choice,
    .help = "what the strength is counted in: standard gravity, acceleration or force",
    .standard = "g",
    .choices = kForceUnits};
inline constexpr AttributeSpec kFieldAxis{
    .attr = Attr::StrengthAxis,
    .kind = Choice,
    .help = "axis of the device that the strength (of a medium, the wind) is multiplied by; without it, 1",
    .choices = kDeviceAxes};
inline constexpr AttributeSpec kFieldTracker{
    .attr = Attr::Tracker,
    .kind = Tracker,
    .help = "the device of strengthaxis; while it is lost its axes are 0",
    .standard = "wand"};

inline constexpr AttributeSpec kForceLinearRows[] = {
    {.attr = Attr::Direction,
     .kind = Vector,
     .help = "direction and strength, in the node's coordinates; \"0, 0, -1\" is gravity",
     .unit = "the field's unit",
     .range = kForce,
     .required = true},
    kFieldUnit,
    kInitOn,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};

inline constexpr AttributeSpec kForceSphericalRows[] = {
    {.attr = Attr::Radius,
     .kind = Number,
     .help = "how far it reaches",
     .unit = "m",
     .range = kLength,
     .required = true},
    {.attr = Attr::Strength,
     .kind = Number,
     .help = "at the centre; `falloff` says how it falls from there",
     .standard = "1",
     .unit = "the field's unit",
     .range = {0, kFar}},
    {.attr = Attr::Mode,
     .kind = Choice,
     .help = "towards the centre or away from it",
     .standard = "attract",
     .choices = kFieldModes},
    {.attr = Attr::Falloff,
     .kind = Choice,
     .help = "how the strength falls with the distance",
     .standard = "none",
     .choices = kFalloffs},
    kFieldUnit,
    kInitOn,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};

inline constexpr AttributeSpec kFieldStrength{.attr = Attr::Strength,
                                              .kind = Number,
                                              .help = "strength at 1 m from the centre",
                                              .standard = "1",
                                              .unit = "the field's unit",
                                              .range = {0, kFar}};
inline constexpr AttributeSpec kFieldMode{.attr = Attr::Mode,
                                          .kind = Choice,
                                          .help = "towards the centre or away from it",
                                          .standard = "attract",
                                          .choices = kFieldModes};

inline constexpr AttributeSpec kForcePointRows[] = {
    kFieldStrength,
    kFieldMode,
    {.attr = Attr::Softening,
     .kind = Number,
     .help = "nearer than about this the force stops growing",
     .standard = "0.1",
     .unit = "m",
     .range = kLength},
    kFieldUnit,
    kInitOn,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};

inline constexpr AttributeSpec kForceVortexRows[] = {
    {.attr = Attr::Strength,
     .kind = Number,
     .help = "strength at the core's edge; negative turns the other way",
     .standard = "1",
     .unit = "the field's unit",
     .range = kForce},
    {.attr = Attr::Core,
     .kind = Number,
     .help = "radius up to which it grows; beyond, it falls with the distance",
     .standard = "1",
     .unit = "m",
     .range = kLength},
    {.attr = Attr::Radius,
     .kind = Number,
     .help = "how far it reaches; without it, everywhere",
     .unit = "m",
     .range = kLength},
    {.attr = Attr::Inward,
     .kind = Number,
     .help = "pull towards the axis, in multiples of the whirl",
     .standard = "0",
     .range = kForce},
    kFieldUnit,
    kInitOn,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};

inline constexpr AttributeSpec kMediumRows[] = {
    {.attr = Attr::Density,
     .kind = Number,
     .help = "relative to water; air has 0.001225",
     .standard = "0.001225",
     .range = {0, 1000}},
    {.attr = Attr::Wind,
     .kind = Vector,
     .help = "how it flows, in the node's coordinates",
     .standard = "0, 0, 0",
     .unit = "m/s",
     .range = kForce},
    {.attr = Attr::Viscosity,
     .kind = Number,
     .help = "rate at which it takes away speed, besides the drag that grows with the square",
     .standard = "0",
     .unit = "1/s",
     .range = {0, 1000}},
    {.attr = Attr::Sphere,
     .kind = ValueKind::Sphere,
     .help = "where it is: centre and radius, in the node's coordinates; without it or a box, everywhere",
     .unit = "m",
     .range = kLength},
    {.attr = Attr::Box,
     .kind = ValueKind::Box,
     .help = "where it is: centre and edges, in the node's coordinates",
     .unit = "m",
     .range = kLength},
    kInitOn,
    kFieldDuration,
    kFieldAxis,
    kFieldTracker,
    kAttachRow,
};

}  // namespace stadion::schema_table
