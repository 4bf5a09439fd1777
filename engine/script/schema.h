#pragma once
/// What can be said in a show: one table of node types, their attributes, events and commands.
///
/// The checker, its error messages, the language reference and the editor files are all driven by this table,
/// so that they cannot disagree. Adding an attribute is one line in schema_table.cpp (and, for a new word,
/// one in attribute.h).
///
/// Threads  constant data; may be read from anywhere.

#include "engine/core/event.h"
#include "engine/core/node_kind.h"
#include "engine/core/verb.h"
#include "engine/script/attribute.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// What the value of an attribute is, and thereby how it is written.
enum class ValueKind : std::uint8_t {
  Number,
  Vector,        ///< "x, y, z"
  Direction,     ///< "x, y, z", not all zero
  Colour,        ///< "r, g, b"
  Moments,       ///< of inertia, about a body's three principal axes, from its longest to its shortest
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

struct AttributeSpec {
  Attr attr;
  ValueKind kind;
  std::string_view help;                        ///< one line
  std::string_view standard = {};               ///< the value if it is not stated, as a script would write it
  std::string_view unit = {};                   ///< of the numbers
  NumberRange range = {};                       ///< of the numbers; for Sphere and Box, of radius and edges
  bool required = false;                        ///< must be stated
  bool repeatable = false;                      ///< may be stated several times, which accumulates
  KindSet targets = {};                         ///< Reference: the kinds of node it may name
  std::span<const std::string_view> choices{};  ///< Choice, Choices: the words
};

struct NodeSpec {
  NodeKind kind;
  std::string_view help;  ///< one line
  std::span<const AttributeSpec> own;
  std::span<const Event> events;  ///< those it posts
  bool placed = false;            ///< has a place in the world: the attributes of placedAttributes() too
  bool single = false;            ///< at most one in a file
};

/// What may follow a command's word.
enum class ArgumentKind : std::uint8_t {
  None,
  PartAndTracker,  ///< all|position|orientation [tracker]
  Tracker,         ///< [tracker]
  Field,           ///< the name of a force field
  Words,           ///< the rest of the command, any text without commas
};

struct CommandSpec {
  Verb verb;
  ArgumentKind argument;
  KindSet receivers;  ///< the kinds of node that take it
  std::string_view form;
  std::string_view help;
};

struct EventSpec {
  Event event;
  std::string_view help;
};

/// The kinds that have a place in the world (position, orientation, scale, parent).
KindSet placedKinds();
/// The kinds that may be hooked to a body.
KindSet fieldKinds();
/// Those whose cycle may run more seldom, and those that may have such below them.
KindSet pacedKinds();
/// Those that an lod node chooses from.
KindSet lodLevelKinds();

std::span<const AttributeSpec> commonAttributes();  ///< of every kind
std::span<const AttributeSpec> placedAttributes();  ///< of every placed kind, beside the common ones

const NodeSpec& specOf(NodeKind kind);
/// The attribute as this kind of node has it, or nullptr if it has none of that name.
const AttributeSpec* specOf(NodeKind kind, Attr attr);
const CommandSpec& specOf(Verb verb);
const EventSpec& specOf(Event event);

/// All attributes of a kind: common, placed, own, in this order.
std::vector<const AttributeSpec*> attributesOf(NodeKind kind);

/// How a value of this attribute is written, for messages and the reference: `three numbers "x, y, z"`.
std::string formOf(const AttributeSpec& spec);
/// "at least 0", "greater than 0 m", "from 0 to 1"; empty if every number is allowed.
std::string describe(const NumberRange& range, std::string_view unit);
/// "a", "a or b", "a, b or c".
std::string joinWithOr(const std::vector<std::string>& words);
std::string describe(KindSet kinds);

}  // namespace stadion
