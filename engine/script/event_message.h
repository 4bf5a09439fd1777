#pragma once
/// "event, target, command [arguments] [, delay] [, latency=seconds]": the command that a node sends to
/// another node at one of its events.
///
/// Times    the command is due at the event's exact time + delay + latency. It takes effect then, or in the
///          frame after the event's frame if that is later. If the latency is at least one frame's step, the
///          command always takes effect when it is due. Then its time is the same at every frame rate with
///          such steps.

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"
#include "engine/core/command_id.h"
#include "engine/core/event.h"

#include <string_view>

namespace stadion {

/// A node named in a script, and which one is meant.
///
/// A name is looked up in its own file, then in the files around it, nearest first. "arena/ball" is the node
/// `ball` in the file of the scene node `arena`; as that file comes and goes, only `arena` is resolved. "hall/roof"
/// is the part `roof` of the object `hall`, a declaration of its own (script_parts.h).
struct NodeReference {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::string_view name;    ///< as written
  std::uint32_t level = 0;  ///< 0: declared in this file; n: in the nth file around it
  /// Declaration of the name's first part, or of the whole name, in that file; kNone if unresolved.
  std::uint32_t declaration = kNone;
  std::uint32_t where = 0;  ///< offset in the source text
  bool whole = false;       ///< the declaration is that of the whole name

  bool resolved() const { return declaration != kNone; }
  /// Returns the part of the name after the first "/"; empty if the node is not inside a scene.
  std::string_view inner() const {
    const std::size_t slash = name.find('/');
    return whole || slash == name.npos ? std::string_view{} : name.substr(slash + 1);
  }
};

struct EventMessage {
  Event event{};
  NodeReference target;
  CommandId commandId{};
  AttachPart part = AttachPart::All;  ///< attach
  NodeReference field;                ///< hook, unhook; else unresolved
  std::string_view tracker;           ///< attach, grab; empty: the default
  std::string_view words;             ///< say
  Nanoseconds delay = 0;              ///< from the event to the command [ns]
  Nanoseconds latency = 0;            ///< on top of the delay; 0: none is stated [ns]
  std::uint32_t where = 0;            ///< offset in the source text
  std::uint32_t command = 0;          ///< offset of the command in the source text
};

}  // namespace stadion
