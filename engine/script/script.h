#pragma once
/// From the text of a script to a checked document, in two steps: what one file says by itself, then the
/// names that may lead into other files.
///
///   auto source = SourceText::read(path);                          // Result<SourceText>
///   Document document = parseScript(std::move(source.value()), types, findings);
///   resolveNames(document, {enclosing files, sub-scene files}, findings);
///   if (findings.hasErrors()) ...                                  // build nothing
///
/// Errors   every finding is added to `findings`, at most FindingCollector::kMost errors per step. The
///          document can always be read; it lacks what was wrong.
/// Threads  a document is used by one thread until its names are resolved, then constant.

#include "engine/script/document.h"

#include <functional>

namespace stadion {

/// Syntax, types and values of one file, and rules within one declaration.
/// The document borrows `types`, the node types that the file may use.
Document parseScript(SourceText source, const NodeRegistry& types, Diagnostics& findings);

/// The files around one file.
struct RelatedDocuments {
  /// The documents of the scene nodes that this file is loaded by, the nearest first.
  std::vector<const Document*> enclosing;
  /// The document of a scene node's file, or nullptr if it is not known; then names inside it are taken on
  /// trust.
  std::function<const Document*(Declaration scene)> subScene;
};

/// Finds the node that each reference means and checks that it may be used there; then what depends on
/// that: circles of parents, a body in two dynamics nodes. Expects that the enclosing documents have been
/// parsed.
void resolveNames(Document& document, const RelatedDocuments& surroundings, Diagnostics& findings);

/// Parses a script that stands alone and resolves its names. Findings are in the order of the lines.
Document checkScript(SourceText source, const NodeRegistry& types, Diagnostics& findings);

/// File by file in the order of their first finding, in each by line and column.
Diagnostics sorted(const Diagnostics& findings);

}  // namespace stadion
