#pragma once
/// Reads the text of an eventmessage.

#include "engine/core/node_registry.h"
#include "engine/script/event_message.h"
#include "engine/script/value.h"

namespace stadion {

/// An eventmessage whose names are still text.
struct ReadMessage {
  Event event{};
  Piece target;
  Piece command;                      ///< with its arguments
  const CommandSpec* spec = nullptr;  ///< null: not understood
  AttachPart part = AttachPart::All;
  Piece field;
  Piece tracker;
  Piece words;
  Nanoseconds delay = 0, latency = 0;
};

/// "event, target, command [arguments] [, delay]" posted by a node of the type `sender`. After the command
/// come, in any order, the delay as a bare number and options of the form `word=value`: `delay` and
/// `latency`. What is wrong with each part; nothing if the message is whole.
std::vector<ValueError> readEventMessage(std::string_view text, const RegisteredType& sender,
                                         const NodeRegistry& types, ReadMessage& message);

/// Returns the fault of a word that shall be a name, with its place in the word. The text ends a sentence
/// that begins with the word.
std::optional<ValueError> faultOfName(std::string_view name);
/// Returns the fault of a name that may lead into sub-scenes: parts separated by "/".
std::optional<ValueError> faultOfReference(std::string_view name);

}  // namespace stadion
