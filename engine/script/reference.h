#pragma once
/// What the schema says, written out: the language reference for readers, a grammar and a completion list for
/// editors. All are made from the table of schema.h and from nothing else.

#include "engine/core/node_kind.h"

#include <string>

namespace stadion {

/// The whole language: how a script is written, every node type, every event and command.
std::string languageReference();
/// One node type: its attributes with form, unit, range and standard value, its events, its commands.
std::string languageReference(NodeKind kind);

/// A TextMate grammar (JSON) that colours node types, attributes, values and comments.
std::string editorGrammar();
/// A list of snippets and words (JSON): per node type its help, a snippet, attributes, events, commands.
std::string editorCompletion();

}  // namespace stadion
