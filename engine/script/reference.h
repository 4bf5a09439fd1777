#pragma once
/// The language reference for readers, and a grammar and a completion list for editors. All are made from the
/// registered node types and from nothing else.

#include "engine/core/node_registry.h"

#include <string>

namespace stadion {

/// The whole language: how a script is written, every node type, every event and command.
std::string languageReference(const NodeRegistry& types);
/// Returns the reference of a node type: its attributes with form, unit, range and standard value, its
/// events, its commands.
std::string languageReference(const NodeRegistry& types, const RegisteredType& node);

/// A TextMate grammar (JSON) that colours node types, attributes, values and comments.
std::string editorGrammar(const NodeRegistry& types);
/// A list of snippets and words (JSON): per node type its help, a snippet, attributes, events, commands.
std::string editorCompletion(const NodeRegistry& types);

}  // namespace stadion
