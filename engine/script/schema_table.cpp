#include "engine/script/schema_table.h"

#include "engine/script/schema_field_rows.h"

namespace stadion::schema_table {

namespace {

constexpr std::string_view kLightTypes[] = {"directional", "point", "spot"};
constexpr std::string_view kShapes[] = {"auto",  "sphere",  "box",      "mesh",
                                        "plane", "capsule", "cylinder", "convex"};
constexpr std::string_view kAxes[] = {"x", "y", "z"};
constexpr std::string_view kThrows[] = {"hand", "field", "both"};
constexpr std::string_view kOrigins[] = {"line", "point"};
constexpr std::string_view kAligns[] = {"left", "centre", "right"};
constexpr std::string_view kFlights[] = {"point", "ballistic", "bias", "rod", "plate", "ball", "table"};
constexpr std::string_view kBiases[] = {"flow", "paper", "covariance"};
constexpr std::string_view kAxesFrom[] = {"area", "vertices"};
constexpr std::string_view kNavigatorModes[] = {"walk", "fly"};

constexpr AttributeSpec kObjectFile{.attr = Attr::File,
                                    .kind = File,
                                    .help = "the model: .obj, .3ds, .gltf, .glb, .dae or .stl",
                                    .required = true};
constexpr AttributeSpec kObjectDraw{.attr = Attr::Draw,
                                    .kind = Flag,
                                    .help = "whether it is visible; it collides either way",
                                    .standard = "on"};
constexpr AttributeSpec kObjectUnit{.attr = Attr::Unit,
                                    .kind = Number,
                                    .help = "length of the file's unit; the file format's own if not stated",
                                    .unit = "m",
                                    .range = {0, 1e6, true}};
constexpr AttributeSpec kObjectUp{.attr = Attr::Up,
                                  .kind = Choice,
                                  .help =
                                      "the file's axis that points up; the file format's own if not stated",
                                  .choices = kAxes};
constexpr AttributeSpec kObjectShape{
    .attr = Attr::Shape,
    .kind = Choice,
    .help = "what stands for it in collisions; auto takes the simplest that is near enough",
    .standard = "auto",
    .choices = kShapes};
constexpr AttributeSpec kObjectTolerance{
    .attr = Attr::Tolerance,
    .kind = Number,
    .help = "how far auto's shape may be from the model, relative to its size",
    .standard = "0.02",
    .range = kUnitInterval};

constexpr AttributeSpec kObjectLevels{
    .attr = Attr::Levels,
    .kind = Number,
    .help = "simplified levels made of the model when it is loaded, at most so many; the coarsest "
            "one is drawn whose error would be less than a pixel",
    .standard = "0",
    .range = {0, 8}};

constexpr AttributeSpec kObjectRows[] = {kObjectFile,  kObjectDraw,      kObjectUnit,  kObjectUp,
                                         kObjectShape, kObjectTolerance, kObjectLevels};

constexpr AttributeSpec kDynObjectRows[] = {
    kObjectFile,
    kObjectDraw,
    kObjectUnit,
    kObjectUp,
    kObjectShape,
    kObjectTolerance,
    kObjectLevels,
    {.attr = Attr::Density,
     .kind = Number,
     .help = "relative to water; with the mesh's volume it gives the mass",
     .standard = "1",
     .range = {1e-6, 1000}},
    {.attr = Attr::Mass, .kind = Number, .help = "overrides density", .unit = "kg", .range = {1e-9, 1e9}},
    {.attr = Attr::Centre,
     .kind = Vector,
     .help = "the centre of mass in the model's coordinates, inside the model; if not stated, as of matter "
             "that fills it evenly",
     .unit = "m",
     .range = kPlace},
    {.attr = Attr::Inertia,
     .kind = Moments,
     .help = "moments about the longest, the middle and the shortest principal axis through the centre of "
             "mass; if not stated, as of matter that fills it evenly",
     .unit = "kg*m2",
     .range = {1e-15, 1e15}},
    {.attr = Attr::Friction,
     .kind = Number,
     .help = "Coulomb coefficient; a pair takes the root of the product",
     .standard = "0.5",
     .range = {0, 10}},
    {.attr = Attr::Restitution,
     .kind = Number,
     .help = "part of the closing speed that comes back from an impact; a pair takes the larger",
     .standard = "0.5",
     .range = kUnitInterval},
    {.attr = Attr::Rolling,
     .kind = Number,
     .help = "rolling resistance coefficient of balls, rods and discs; a pair takes the larger",
     .standard = "0.01",
     .range = kUnitInterval},
    {.attr = Attr::Damping,
     .kind = Number,
     .help = "rate at which the medium takes away speed",
     .standard = "0",
     .unit = "1/s",
     .range = {0, 1000}},
    {.attr = Attr::DragArea,
     .kind = Number,
     .help = "drag coefficient times cross section, for media; if not stated, 0.47 of a ball's or the mean "
             "of others'",
     .unit = "m2",
     .range = {0, 1e6}},
    {.attr = Attr::Hook,
     .kind = Reference,
     .help = "a force field that acts on it from the start",
     .repeatable = true,
     .targets = kFields},
    {.attr = Attr::Velocity,
     .kind = Vector,
     .help = "at the start and after reset, along the parent's axes",
     .standard = "0, 0, 0",
     .unit = "m/s",
     .range = kPlace},
    {.attr = Attr::AngularVelocity,
     .kind = Vector,
     .help = "at the start and after reset, about the parent's axes",
     .standard = "0, 0, 0",
     .unit = "degrees/s",
     .range = kTurn},
    {.attr = Attr::Throw,
     .kind = Choice,
     .help = "what it takes along when a hand lets go: the hand's velocity, the pushes of the linear fields "
             "that the hand carries, or both",
     .standard = "both",
     .choices = kThrows},
    {.attr = Attr::Spin,
     .kind = Number,
     .help = "what a hand that lets go adds to its turning, about the axis of symmetry",
     .standard = "0",
     .unit = "degrees/s",
     .range = kTurn},
    {.attr = Attr::Nose,
     .kind = Direction,
     .help = "the way its tip points, in the model's coordinates; if not stated, along its longest axis to "
             "the heavier end",
     .range = kPlace},
    {.attr = Attr::Sticks,
     .kind = Number,
     .help = "it sticks fast in a collider that its tip meets first, within this angle of straight on; "
             "without it, never",
     .unit = "degrees",
     .range = {0, 90, true}},
    {.attr = Attr::Depth,
     .kind = Number,
     .help = "how far its tip goes in where it sticks, the way it comes",
     .standard = "0.08",
     .unit = "m",
     .range = {0, 100}},
    {.attr = Attr::Flight,
     .kind = Choice,
     .help = "how air acts on it: as on a point with drag, not at all, by the paper's bias, as on a rod, a "
             "plate or a ball, or by a table",
     .standard = "point",
     .choices = kFlights},
    {.attr = Attr::Coefficients,
     .kind = ValueKind::Coefficients,
     .help = "of flight=rod, plate or ball, in the order of docs/flight.md; or javelin, discus or football; "
             "if not stated, from the model's form"},
    {.attr = Attr::FlightTable,
     .kind = File,
     .help = "of flight=table: coefficients by the angle of attack (.csv)"},
    {.attr = Attr::Bias,
     .kind = Choice,
     .help = "of flight=bias: its angle to the velocity decays evenly, or by a share in every frame as in "
             "the paper, or by the form's covariance; flow if not stated",
     .choices = kBiases},
    {.attr = Attr::BiasRate,
     .kind = Number,
     .help = "of flight=bias: per second (flow), share of the angle in a frame (paper), per metre "
             "(covariance); if not stated 1.8, 0.03, 0.07",
     .range = {0, 1000}},
    {.attr = Attr::Axes,
     .kind = Choice,
     .help = "of flight=bias: its axes from the surface's area, or from random vertices as in the paper; "
             "area if not stated",
     .choices = kAxesFrom},
};

constexpr AttributeSpec kLodRows[] = {
    {.attr = Attr::Ranges,
     .kind = Distances,
     .help = "how far away its first child is drawn, then its second, ...; beyond the last one the next "
             "child, if there is one more, or nothing. From the visitor's head to the node's place",
     .unit = "m",
     .range = kLength,
     .required = true},
};

constexpr AttributeSpec kLightRows[] = {
    {.attr = Attr::Type,
     .kind = Choice,
     .help = "parallel rays, rays from the position, or a cone from the position",
     .standard = "directional",
     .choices = kLightTypes},
    {.attr = Attr::Colour,
     .kind = Colour,
     .help = "red, green, blue (sRGB)",
     .standard = "1, 1, 1",
     .range = kColourRange},
    {.attr = Attr::Intensity,
     .kind = Number,
     .help = "brightness; 1 lights a white surface fully, at 1 m for point and spot",
     .standard = "1",
     .range = {0, 1e6}},
    {.attr = Attr::Direction,
     .kind = Direction,
     .help = "where the rays go, in the node's coordinates",
     .standard = "0, 0, -1",
     .range = kPlace},
    {.attr = Attr::Range,
     .kind = Number,
     .help = "point and spot: how far the light reaches",
     .standard = "100",
     .unit = "m",
     .range = kLength},
    {.attr = Attr::Angle,
     .kind = Number,
     .help = "spot: full opening angle of the cone",
     .standard = "45",
     .unit = "degrees",
     .range = {0, 180, true}},
    {.attr = Attr::Shadows,
     .kind = Flag,
     .help = "directional: whether things cast shadows; of several such lights, the first that is on",
     .standard = "on"},
    kInitOn,
};

constexpr AttributeSpec kSkyRows[] = {
    {.attr = Attr::Zenith,
     .kind = Colour,
     .help = "colour straight up (sRGB)",
     .standard = "0.25, 0.45, 0.8",
     .range = kColourRange},
    {.attr = Attr::Horizon,
     .kind = Colour,
     .help = "colour at eye level, and of the haze (sRGB)",
     .standard = "0.75, 0.85, 0.95",
     .range = kColourRange},
    {.attr = Attr::Ground,
     .kind = Colour,
     .help = "colour straight down (sRGB)",
     .standard = "0.35, 0.32, 0.28",
     .range = kColourRange},
    {.attr = Attr::Ambient,
     .kind = Colour,
     .help = "light that reaches every surface (sRGB)",
     .standard = "0.4, 0.42, 0.45",
     .range = kColourRange},
    {.attr = Attr::Haze,
     .kind = Number,
     .help = "distance over which two thirds of the contrast are lost; 0 is clear air",
     .standard = "0",
     .unit = "m",
     .range = kDistance},
};

constexpr AttributeSpec kTextRows[] = {
    {.attr = Attr::Text, .kind = Words, .help = "what it says at the start"},
    {.attr = Attr::Size,
     .kind = Number,
     .help = "height of a capital",
     .standard = "0.5",
     .unit = "m",
     .range = {0, 1000, true}},
    {.attr = Attr::Colour,
     .kind = Colour,
     .help = "red, green, blue (sRGB)",
     .standard = "1, 1, 1",
     .range = kColourRange},
    {.attr = Attr::Lit,
     .kind = Flag,
     .help = "whether light falls on it as on any surface; if not, it shows its colour in any light",
     .standard = "off"},
    {.attr = Attr::Align,
     .kind = Choice,
     .help = "what of each line is at the node's place: its beginning, its middle or its end",
     .standard = "centre",
     .choices = kAligns},
    {.attr = Attr::Depth,
     .kind = Number,
     .help = "how thick the letters are; 0 is flat",
     .standard = "0",
     .unit = "m",
     .range = {0, 1000}},
    {.attr = Attr::Background,
     .kind = Colour,
     .help = "colour of a board behind the letters (sRGB); no board if not stated",
     .range = kColourRange},
};

constexpr AttributeSpec kTriggerSphere{.attr = Attr::Sphere,
                                       .kind = ValueKind::Sphere,
                                       .help =
                                           "the space watched: centre and radius, in the node's coordinates",
                                       .unit = "m",
                                       .range = kLength};
constexpr AttributeSpec kTriggerBox{.attr = Attr::Box,
                                    .kind = ValueKind::Box,
                                    .help = "the space watched: centre and edges, in the node's coordinates",
                                    .unit = "m",
                                    .range = kLength};

constexpr AttributeSpec kUserTriggerRows[] = {kTriggerSphere, kTriggerBox, kInitOn};

constexpr AttributeSpec kWandTriggerRows[] = {
    kTriggerSphere,
    kTriggerBox,
    kInitOn,
    {.attr = Attr::Tracker, .kind = Tracker, .help = "the device that is watched", .standard = "wand"},
};

constexpr AttributeSpec kTimerRows[] = {
    {.attr = Attr::Period,
     .kind = Number,
     .help = "time from being enabled to the event",
     .unit = "s",
     .range = {1e-3, kLong},
     .required = true},
    {.attr = Attr::Repeat,
     .kind = Flag,
     .help = "whether it starts again after the event",
     .standard = "off"},
    kInitOn,
};

constexpr AttributeSpec kSceneRows[] = {
    {.attr = Attr::File, .kind = File, .help = "the script of the sub-scene (.evs)", .required = true},
    {.attr = Attr::InitState, .kind = Flag, .help = "whether it is loaded at the start", .standard = "on"},
    {.attr = Attr::Ready,
     .kind = Number,
     .help = "show time from the request to the moment the scene appears or goes",
     .standard = "1",
     .unit = "s",
     .range = {0, 3600}},
};

constexpr AttributeSpec kPathRows[] = {
    {.attr = Attr::Target,
     .kind = Reference,
     .help = "the node to move; without it, the path moves the nodes that have it as parent",
     .targets = kMovable | KindSet{Rig}},
    {.attr = Attr::Key,
     .kind = Key,
     .help = "time, position, orientation; times must increase",
     .unit = "s, m, degrees",
     .range = kPlace,
     .required = true,
     .repeatable = true},
    {.attr = Attr::Loop, .kind = Flag, .help = "whether it starts again at its end", .standard = "off"},
    {.attr = Attr::Smooth,
     .kind = Flag,
     .help = "whether it passes the keys in a curve rather than in straight lines",
     .standard = "off"},
    kInitOn,
};

constexpr AttributeSpec kSoundRows[] = {
    {.attr = Attr::File,
     .kind = File,
     .help = "what is heard: .wav, .aiff, .flac or .ogg (Vorbis)",
     .required = true},
    {.attr = Attr::Gain,
     .kind = Number,
     .help = "how loud it is: 1 as the file has it",
     .standard = "1",
     .range = kUnitInterval},
    {.attr = Attr::Range,
     .kind = Number,
     .help = "how far from its place it is heard; without it, it is heard everywhere alike",
     .unit = "m",
     .range = kLength},
    {.attr = Attr::Loop, .kind = Flag, .help = "whether it starts again at its end", .standard = "off"},
    kInitOn,
};

constexpr AttributeSpec kCollider{.attr = Attr::Collider,
                                  .kind = Reference,
                                  .help = "takes part, and is not moved",
                                  .repeatable = true,
                                  .targets = kSolid};
constexpr AttributeSpec kReleaseDistance{.attr = Attr::ReleaseDistance,
                                         .kind = Number,
                                         .help = "how far the surfaces of a pair must be apart for onrelease",
                                         .standard = "0.5",
                                         .unit = "m",
                                         .range = kLength};

constexpr AttributeSpec kCollisionRows[] = {
    kCollider,
    {.attr = Attr::Collidee,
     .kind = Reference,
     .help = "is tested against every collider",
     .repeatable = true,
     .targets = kSolid},
    kReleaseDistance,
    kInitOn,
};

constexpr AttributeSpec kDynamicsRows[] = {
    kCollider,
    {.attr = Attr::Collidee,
     .kind = Reference,
     .help = "a body that this node moves; a body belongs to one dynamics node",
     .repeatable = true,
     .targets = {DynObject}},
    kReleaseDistance,
    {.attr = Attr::SelfCollide,
     .kind = Flag,
     .help = "whether the bodies of this node collide with each other",
     .standard = "on"},
    kInitOn,
};

constexpr AttributeSpec kMeasureRows[] = {
    {.attr = Attr::Body,
     .kind = Reference,
     .help = "what is thrown; its first impact after \"start\" counts",
     .required = true,
     .targets = {DynObject}},
    {.attr = Attr::Ground,
     .kind = Reference,
     .help = "only an impact with this counts; any, if not stated",
     .targets = kSolid},
    {.attr = Attr::From,
     .kind = Choice,
     .help = "square from the node's X axis, or from its place",
     .standard = "line",
     .choices = kOrigins},
    {.attr = Attr::Sector,
     .kind = Number,
     .help = "full angle about the node's +Y, outside which a throw is a foul; if not stated, only one that "
             "lands behind the line is",
     .unit = "degrees",
     .range = {0, 180, true}},
    {.attr = Attr::Duration,
     .kind = Number,
     .help = "a throw that has not touched anything so long after its start is a foul",
     .standard = "60",
     .unit = "s",
     .range = {0, 1e6, true}},
    {.attr = Attr::Label, .kind = Words, .help = "what the result is called; the node's name if not stated"},
    {.attr = Attr::Text,
     .kind = Reference,
     .help = "a text node that shows the result",
     .targets = {NodeKind::Text}},
    {.attr = Attr::Against,
     .kind = Reference,
     .help = "the measure to compare with, once both have a result",
     .targets = {Measure}},
};

constexpr AttributeSpec kNavigatorRows[] = {
    {.attr = Attr::Speed,
     .kind = Number,
     .help = "of the rig at full deflection of the joypad",
     .standard = "1.5",
     .unit = "m/s",
     .range = {0, 1000}},
    {.attr = Attr::TurnRate,
     .kind = Number,
     .help = "of the rig at full deflection of the joypad",
     .standard = "45",
     .unit = "degrees/s",
     .range = {0, 3600}},
    {.attr = Attr::Tracker, .kind = Tracker, .help = "the device that points the way", .standard = "wand"},
    {.attr = Attr::Mode,
     .kind = Choice,
     .help = "keep the height, or follow the device up and down",
     .standard = "walk",
     .choices = kNavigatorModes},
    kInitOn,
};

constexpr AttributeSpec kRigRows[] = {
    {.attr = Attr::Position,
     .kind = Vector,
     .help = "the middle of the floor of the display, in the world",
     .standard = "0, 0, 0",
     .unit = "m",
     .range = kPlace},
    {.attr = Attr::Orientation,
     .kind = Vector,
     .help = "rotations about the world's X axis, then Y, then Z",
     .standard = "0, 0, 0",
     .unit = "degrees",
     .range = kTurn},
    {.attr = Attr::EyeHeight,
     .kind = Number,
     .help = "of the head above the floor while no tracker says where it is",
     .standard = "1.7",
     .unit = "m",
     .range = {0, 10}},
};

constexpr Event kUserTriggerEvents[] = {Event::Enter, Event::Exit};
constexpr Event kWandTriggerEvents[] = {Event::Enter,     Event::Exit,     Event::Button1,   Event::Button2,
                                        Event::Button3,   Event::Button4,  Event::Button1Up, Event::Button2Up,
                                        Event::Button3Up, Event::Button4Up};
constexpr Event kTimerEvents[] = {Event::TimesUp};
constexpr Event kSceneEvents[] = {Event::Loaded, Event::Unloaded};
constexpr Event kPathEvents[] = {Event::Finished};
constexpr Event kSoundEvents[] = {Event::Finished};
constexpr Event kContactEvents[] = {Event::OnImpact, Event::OnRelease};
constexpr Event kMeasureEvents[] = {Event::Measured, Event::Foul, Event::Won, Event::Lost, Event::Drawn};
constexpr Event kBodyEvents[] = {Event::OnQuarantine};

}  // namespace

constinit const std::span<const AttributeSpec> kCommon = kCommonRows;
constinit const std::span<const AttributeSpec> kPlaced = kPlacedRows;
constinit const KindSet kPlacedKinds = kMovable;
constinit const KindSet kFieldKinds = kFields;
constinit const KindSet kPacedKinds = kPaced;

constinit const std::array<NodeSpec, kNodeKindCount> kNodes = {{
    {Group, "gathers nodes under one name and place", {}, {}, true},
    {Transform, "places its children; made to be moved by messages and paths", {}, {}, true},
    {NodeKind::Lod, "draws one of its children, by how far away it is", kLodRows, {}, true},
    {Object, "a model from a file, drawn and solid but not moved by dynamics", kObjectRows, {}, true},
    {DynObject, "a body: a model with mass that a dynamics node moves", kDynObjectRows, kBodyEvents, true},
    {Light, "lights the scene", kLightRows, {}, true},
    {Sky,
     "what is seen behind everything, and the light that comes from all sides",
     kSkyRows,
     {},
     false,
     true},
    {Text, "words in the scene, read by who looks along +Y", kTextRows, {}, true},
    {ForceLinear,
     "a force field with the same force everywhere, such as gravity or a kick",
     kForceLinearRows,
     {},
     true},
    {ForceSpherical, "a force field around a centre", kForceSphericalRows, {}, true},
    {ForcePoint, "attraction or repulsion by the inverse square of the distance", kForcePointRows, {}, true},
    {ForceVortex, "a whirl about the node's Z axis", kForceVortexRows, {}, true},
    {Medium, "air or water that bodies fly through, and its wind", kMediumRows, {}, true},
    {UserTrigger, "notices the user's head in a part of space", kUserTriggerRows, kUserTriggerEvents, true},
    {WandTrigger, "notices a hand-held device and its buttons in a part of space", kWandTriggerRows,
     kWandTriggerEvents, true},
    {Timer, "posts an event after a time", kTimerRows, kTimerEvents},
    {Scene, "another script, loaded into this one and unloaded by message", kSceneRows, kSceneEvents, true},
    {Path, "moves a node along keys given in advance", kPathRows, kPathEvents, true},
    {Sound, "something that is heard, from its place or from everywhere", kSoundRows, kSoundEvents, true},
    {Collision, "notices contact between objects and leaves them where they are", kCollisionRows,
     kContactEvents},
    {Dynamics, "moves its bodies by forces and collisions", kDynamicsRows, kContactEvents},
    {Measure, "takes the distance of a throw where the body first touches, from its X axis towards +Y",
     kMeasureRows, kMeasureEvents, true},
    {Navigator, "lets the user move the rig with joypad and wand", kNavigatorRows, {}},
    {Rig,
     "the platform that carries walls, trackers and viewers through the world",
     kRigRows,
     {},
     false,
     true},
}};

constinit const std::array<CommandSpec, kVerbCount> kCommands = {{
    {Verb::Enable, ArgumentKind::None, kSwitched, "enable",
     "begins to act; a field's duration starts anew, a path that has ended too, and every sound"},
    {Verb::Disable, ArgumentKind::None, kSwitched, "disable", "stops acting"},
    {Verb::Toggle, ArgumentKind::None, kSwitched, "toggle", "enables if disabled, disables if enabled"},
    {Verb::Attach, ArgumentKind::PartAndTracker, kMovable, "attach all|position|orientation [TRACKER]",
     "follows a tracker (foot, else wand, if none is named)"},
    {Verb::Detach, ArgumentKind::None, kMovable, "detach",
     "stays where it is and follows no tracker any more"},
    {Verb::Show, ArgumentKind::None, kMovable, "show", "becomes visible, with all below it"},
    {Verb::Hide, ArgumentKind::None, kMovable, "hide", "becomes invisible, with all below it"},
    {Verb::Reset, ArgumentKind::None, KindSet::all(), "reset", "returns to the state it was declared in"},
    {Verb::Hook, ArgumentKind::Field, {DynObject}, "hook FIELD", "the field acts on the body from now on"},
    {Verb::Unhook, ArgumentKind::Field, {DynObject}, "unhook FIELD", "the field acts on the body no more"},
    {Verb::Grab,
     ArgumentKind::Tracker,
     {DynObject},
     "grab [TRACKER]",
     "the body is held by a tracker (wand if none is named) at the place where it was taken"},
    {Verb::Release,
     ArgumentKind::None,
     {DynObject},
     "release",
     "the body flies on with the velocity it was held with"},
    {Verb::Load, ArgumentKind::None, {Scene}, "load", "the scene appears after its `ready` time"},
    {Verb::Unload, ArgumentKind::None, {Scene}, "unload", "the scene goes after its `ready` time"},
    {Verb::Say,
     ArgumentKind::Words,
     {Text},
     "say [WORDS]",
     "shows these words; \\n ends a line, \\, is a comma"},
    {Verb::Start, ArgumentKind::None, {Measure}, "start", "the body's next impact is measured"},
}};

constinit const std::array<EventSpec, kEventCount> kEvents = {{
    {Event::Enter, "the tracked thing has come into the trigger's space; also if it is there at the start"},
    {Event::Exit, "the tracked thing has left the trigger's space"},
    {Event::Button1, "button 1 was pressed inside the trigger's space"},
    {Event::Button2, "button 2 was pressed inside the trigger's space"},
    {Event::Button3, "button 3 was pressed inside the trigger's space"},
    {Event::Button4, "button 4 was pressed inside the trigger's space"},
    {Event::TimesUp, "the timer's period is over"},
    {Event::Loaded, "the sub-scene has appeared"},
    {Event::Unloaded, "the sub-scene has gone"},
    {Event::Finished,
     "the path has reached its last key, the sound its end; told at the end of each pass if it loops"},
    {Event::OnImpact, "a pair that was apart has touched"},
    {Event::OnRelease, "a pair that posted onimpact is farther apart than releasedistance"},
    {Event::OnQuarantine,
     "its state would have become infinite or undefined; it stands still until its reset"},
    {Event::Measured, "the throw has been measured"},
    {Event::Foul, "the throw has landed behind the line or outside the sector"},
    {Event::Won, "both throws have a result, and this one is farther, by a centimetre at least"},
    {Event::Lost, "both throws have a result, and the other is farther"},
    {Event::Drawn, "both throws have a result, and neither is farther"},
    {Event::Button1Up, "button 1, of whose press the trigger told, was let go, wherever the device is then"},
    {Event::Button2Up, "button 2, of whose press the trigger told, was let go, wherever the device is then"},
    {Event::Button3Up, "button 3, of whose press the trigger told, was let go, wherever the device is then"},
    {Event::Button4Up, "button 4, of whose press the trigger told, was let go, wherever the device is then"},
}};

}  // namespace stadion::schema_table
