#pragma once
/// Warnings about a script that is correct but hardly means what it says.

#include "engine/script/document.h"
#include "engine/script/finding_collector.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// How the other nodes of a file use one of its nodes.
struct NodeUse {
  bool hooked = false;      ///< by an attribute or a message
  bool simulated = false;   ///< collidee of a dynamics node
  bool switchedOn = false;  ///< target of enable or toggle
  bool isParent = false;
  bool isFollowed = false;  ///< another node moves or touches it, or is moved by it
  std::size_t levels = 0;   ///< children that an lod node chooses from
};

/// A file that NodeType::lint checks.
class LintScope {
public:
  /// Expects a document whose names are resolved, and that it and the findings outlive the scope.
  LintScope(const Document& document, bool alone, Diagnostics& findings);

  const Document& document() const { return document_; }
  /// No file loads this one and it loads none.
  bool alone() const { return alone_; }
  const NodeUse& useOf(const Declaration& node) const { return uses_[node.index()]; }
  /// Null if the node is in another file.
  const NodeUse* useOf(const NodeReference& reference) const;

  /// Counts on, and returns how many of this kind have been counted.
  std::size_t tally(NodeKind kind) { return ++tallies_[kind.id()]; }

  void warn(const Declaration& node, Attr attr, std::string message);
  void warnAt(std::uint32_t place, std::string message) { report_.warning(place, std::move(message)); }
  /// Letters that the show cannot write.
  void warnOfMissing(std::string_view words, std::uint32_t place);
  /// Warns if the node is off at the start and nothing switches it on.
  void warnNeverOn(const Declaration& node);
  /// A reference that is given twice.
  void warnRepeated(const Declaration& node, Attr attr);
  /// `the timer "clock"`, `this timer`.
  static std::string called(const Declaration& node);

private:
  void note(const Declaration& node);
  NodeUse* noted(const NodeReference& reference);

  const Document& document_;
  bool alone_;
  FindingCollector report_;
  std::vector<NodeUse> uses_;
  std::map<std::uint32_t, std::size_t> tallies_;
};

/// For types that do nothing but post events.
void lintSender(const Declaration& node, LintScope& scope);
/// For types that move their targets, or what has them as parent.
void lintTargets(const Declaration& node, LintScope& scope);

/// Expects a document whose names are resolved. Looks at this file only. Files inside and around it may use
/// what seems unused here. So a field or trigger is called unused only if it has no name, or if the file
/// stands alone (`alone`: no file loads it and it loads none).
void lint(const Document& document, bool alone, Diagnostics& findings);

/// Warns of messages whose stated latency is shorter than a frame: it fixes nothing then.
///
/// Units    `step` is the time of one frame [ns].
void lintLatencies(const Document& document, Nanoseconds step, Diagnostics& findings);

/// Warns of trackers that no device is called: `known` are those of the show's input log, `log` its name.
/// Without a log, of names that look like a slip of the usual ones.
void lintTrackers(const Document& document, const std::vector<std::string>& known, const std::string& log,
                  Diagnostics& findings);

}  // namespace stadion
