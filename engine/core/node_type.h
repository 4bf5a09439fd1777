#pragma once
/// The descriptor of a node type: a constant beside the node's code. The parser, the checker, the language
/// reference, the editor files and the profiler know a type by its descriptor alone.
///
///     constexpr AttributeSpec kPeriod[] = {
///         {.name = "period", .kind = ValueKind::Number, .help = "...", .unit = "s"}};
///     constexpr EventSpec kEvents[] = {{"timesup", "the timer's period is over"}};
///     constexpr NodeType kTimerType{.name = "timer",
///                                   .help = "posts an event after a time",
///                                   .attributes = kPeriod,
///                                   .events = kEvents,
///                                   .traits = {Trait::Switched},
///                                   .make = makeTimer};
///
/// Threads   constant data; may be read from anywhere.
/// Ownership a descriptor and all that it points to live as long as the program.

#include "engine/core/command_id.h"
#include "engine/core/event.h"
#include "engine/core/word.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace stadion {

class Declaration;
class DeclarationCheck;
class LintScope;
class Node;
struct NodeRequest;

/// The properties of a type that other parts of the engine must know.
enum class Trait : std::uint8_t {
  Placed,    ///< has a place in the world: takes parent, position, orientation, scale; attach, detach, show,
             ///< hide
  Switched,  ///< takes enable, disable and toggle
  Single,    ///< at most one in a file
  Parent,    ///< others may be placed below it
  Level,     ///< an lod node may choose it
  Moves,     ///< moves in the world, or moves what is below it
  Drawn,     ///< is drawn although it has no place in the world
  Model,     ///< has a model file, which is drawn and collides
  Figure,    ///< has a model file with bones and clips, which is drawn
  Field,     ///< a force field: may be hooked to a body
  Collides,  ///< tests colliders against collidees
  OwnsBodies,    ///< moves its collidees
  Degradable,    ///< may run its cycle less often to save time
  Encloses,      ///< loads a file of its own
  Sound,         ///< has a sound file
  Surroundings,  ///< may have a picture of surroundings, which give light
};

class TraitSet {
public:
  constexpr TraitSet() = default;
  constexpr TraitSet(std::initializer_list<Trait> traits) {
    for (const Trait trait : traits) bits_ |= 1U << static_cast<unsigned>(trait);
  }
  constexpr bool has(Trait trait) const { return (bits_ >> static_cast<unsigned>(trait) & 1U) != 0; }
  constexpr bool meets(TraitSet other) const { return (bits_ & other.bits_) != 0; }

private:
  std::uint32_t bits_ = 0;
};

/// The kinds of attribute values, and thereby how they are written.
enum class ValueKind : std::uint8_t {
  Number,
  Whole,         ///< a number without a fraction
  Vector,        ///< "x, y, z"
  Direction,     ///< "x, y, z", not all zero
  Colour,        ///< "r, g, b"
  Moments,       ///< moments of inertia about a body's three principal axes, from its longest to its shortest
  Scale,         ///< one number or three
  Sphere,        ///< "x, y, z, radius"
  Box,           ///< "x, y, z, sx, sy, sz": the centre and the full lengths of the edges
  Key,           ///< "t, x, y, z, rx, ry, rz" or "t, x, y, z": a time, a position, an orientation
  Flag,          ///< on, off, true, false, 1, 0
  Choice,        ///< one word of a few
  Choices,       ///< some words of a few, each once, in the order that counts
  Distances,     ///< up to seven numbers, each greater than the one before
  NewName,       ///< the name that this node gets
  Tracker,       ///< the name of a tracker
  Reference,     ///< the name of another node
  File,          ///< a path below the show's asset roots
  Coefficients,  ///< up to seven numbers, or one word
  Words,         ///< any text; \n ends a line
  EventMessage,
};

/// The numbers that are allowed.
struct NumberRange {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above = false;  ///< `least` itself is not allowed
};

struct NodeType;

/// The node types that have one of these traits or one of these names.
struct NodeFilter {
  TraitSet traits = {};
  std::array<NodeKind, 2> kinds = {};

  constexpr bool matches(const NodeType& type) const;
};

struct AttributeSpec {
  std::string_view name;
  ValueKind kind;
  std::string_view help;           ///< one line
  std::string_view standard = {};  ///< the value if it is not stated, as a script would write it
  std::string_view unit = {};      ///< unit of the numbers
  NumberRange range = {};          ///< range of the numbers; for Sphere and Box, of radius and edges
  bool required = false;           ///< must be stated
  bool repeatable = false;         ///< may be stated several times, which accumulates
  NodeFilter targets = {};         ///< Reference: the node types that it may name
  bool acts = false;               ///< Reference: it moves or touches what it names, or is moved by it
  std::span<const std::string_view> choices{};  ///< Choice, Choices: the words
  Attr attr = Attr::of(name);                   ///< follows from the name
};

struct EventSpec {
  Event event;
  std::string_view help;       ///< one line
  std::string_view word = {};  ///< what stands after the name: `NAME` for `marker NAME`; empty: nothing
};

/// The arguments that a command takes.
enum class ArgumentKind : std::uint8_t {
  None,
  PartAndTracker,  ///< all|position|orientation [tracker]
  Tracker,         ///< [tracker]
  Field,           ///< the name of a force field
  Words,           ///< the rest of the command, any text without commas
  Colour,          ///< R G B, each from 0 to 1 (sRGB)
  Share,           ///< a number from 0 to 1
  Faded,           ///< a number, and `fade` with a time if it is reached slowly
};

struct CommandSpec {
  std::string_view name;
  ArgumentKind argument;
  std::string_view form;              ///< `attach all|position|orientation [TRACKER]`
  std::string_view help;              ///< one line
  CommandId id = commandNamed(name);  ///< follows from the name
};

struct NodeType {
  std::string_view name;                           ///< small letters
  std::string_view help;                           ///< one line
  std::span<const AttributeSpec> attributes = {};  ///< beside those of every node and of its traits
  std::span<const EventSpec> events = {};
  std::span<const CommandSpec> commands = {};  ///< beside `reset` and those of its traits
  TraitSet traits = {};
  /// Makes a node, or says in the findings of the request why it cannot. On the loader's thread.
  std::unique_ptr<Node> (*make)(const NodeRequest&) = nullptr;
  /// Finds errors that concern several attributes of one declaration; null: there are none.
  void (*check)(DeclarationCheck&) = nullptr;
  /// Warns of a declaration that is correct and hardly means what it says; null: never.
  void (*lint)(const Declaration&, LintScope&) = nullptr;
  NodeKind kind = NodeKind::of(name);  ///< follows from the name
};

constexpr bool NodeFilter::matches(const NodeType& type) const {
  return traits.meets(type.traits) || kinds[0] == type.kind || kinds[1] == type.kind;
}

}  // namespace stadion
