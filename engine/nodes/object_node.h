#pragma once
/// `object`, and what a dynobject has in common with it: the attributes of a model.

#include "engine/core/node_type.h"
#include "engine/core/shared_rows.h"

namespace stadion {

extern const NodeType kObjectType;

inline constexpr std::string_view kShapeWords[] = {"auto",  "sphere",  "box",      "mesh",
                                                   "plane", "capsule", "cylinder", "convex"};
inline constexpr std::string_view kUpWords[] = {"x", "y", "z"};

inline constexpr AttributeSpec kObjectFile{.name = "file",
                                           .kind = ValueKind::File,
                                           .help =
                                               "the model: .obj, .3ds, .gltf, .glb, .dae, .fbx, .ply or .stl",
                                           .required = true};
inline constexpr AttributeSpec kObjectDraw{.name = "draw",
                                           .kind = ValueKind::Flag,
                                           .help = "whether it is visible; it collides either way",
                                           .standard = "on"};
inline constexpr AttributeSpec kObjectUnit{
    .name = "unit",
    .kind = ValueKind::Number,
    .help = "length of the file's unit; the file format's own if not stated",
    .unit = "m",
    .range = {0, 1e6, true}};
inline constexpr AttributeSpec kObjectUp{
    .name = "up",
    .kind = ValueKind::Choice,
    .help = "the file's axis that points up; the file format's own if not stated",
    .choices = kUpWords};
inline constexpr AttributeSpec kObjectShape{
    .name = "shape",
    .kind = ValueKind::Choice,
    .help = "what stands for it in collisions; auto takes the simplest that is near enough",
    .standard = "auto",
    .choices = kShapeWords};
inline constexpr AttributeSpec kObjectTolerance{
    .name = "tolerance",
    .kind = ValueKind::Number,
    .help = "how far auto's shape may be from the model, relative to its size",
    .standard = "0.02",
    .range = kUnitInterval};
inline constexpr AttributeSpec kObjectPart{.name = "part",
                                           .kind = ValueKind::Words,
                                           .help = "shows only this node of the file and what is below it; "
                                                   "it has the node's place in the file, moved by "
                                                   "position and turned by orientation"};
inline constexpr AttributeSpec kObjectLevels{
    .name = "levels",
    .kind = ValueKind::Whole,
    .help = "simplified levels made of the model when it is loaded, at most so many; the coarsest "
            "one is drawn whose error would be less than a pixel",
    .standard = "0",
    .range = {0, 8}};

/// Warns of a file that is in no format that is read.
void lintModel(const Declaration& node, LintScope& scope);

}  // namespace stadion
