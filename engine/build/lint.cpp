#include "engine/build/lint.h"

#include "engine/input/tracker_names.h"
#include "engine/plain_text/suggestion.h"
#include "engine/text/glyphs.h"
#include "engine/text/text_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stadion {

LintScope::LintScope(const Document& document, bool alone, Diagnostics& findings)
    : document_(document), alone_(alone), report_(document.source(), findings), uses_(document.size()) {
  for (const Declaration node : document_) note(node);
}

const NodeUse* LintScope::useOf(const NodeReference& reference) const {
  const bool here = reference.resolved() && reference.level == 0 && reference.inner().empty();
  return here ? &uses_[reference.declaration] : nullptr;
}

NodeUse* LintScope::noted(const NodeReference& reference) {
  return const_cast<NodeUse*>(std::as_const(*this).useOf(reference));
}

void LintScope::note(const Declaration& node) {
  for (const NodeReference& field : node.references("hook"))
    if (NodeUse* use = noted(field)) use->hooked = true;
  if (node.is(Trait::OwnsBodies))
    for (const NodeReference& body : node.references("collidee"))
      if (NodeUse* use = noted(body)) use->simulated = true;
  if (node.has("parent"))
    if (NodeUse* use = noted(*node.reference("parent"))) {
      use->isParent = true;
      use->levels += node.is(Trait::Level);
    }
  for (const AttributeSpec& attribute : node.type().attributes())
    if (attribute.kind == ValueKind::Reference && attribute.acts)
      for (const NodeReference& other : node.references(attribute.attr))
        if (NodeUse* use = noted(other)) use->isFollowed = true;
  for (const EventMessage& message : node.eventMessages()) {
    if (NodeUse* field = noted(message.field); field && message.commandId == CommandId::Hook)
      field->hooked = true;
    if (NodeUse* use = noted(message.target))
      use->switchedOn |= message.commandId == CommandId::Enable || message.commandId == CommandId::Toggle;
    warnOfMissing(message.words, message.command);
  }
}

void LintScope::warn(const Declaration& node, Attr attr, std::string message) {
  report_.warning(node.offset(attr), std::move(message));
}

void LintScope::warnOfMissing(std::string_view words, std::uint32_t place) {
  for (const char32_t c : missingFrom(unescaped(words)))
    report_.warning(place, fmt::format("the letters of the show have no U+{:04X}; a box stands for it",
                                       static_cast<std::uint32_t>(c)));
}

void LintScope::warnNeverOn(const Declaration& node) {
  if (node.flag("initstate")) return;
  if (node.name().empty() || (alone_ && !useOf(node).switchedOn))
    warn(node, "initstate", fmt::format("{} is off at the start and nothing enables it", called(node)));
}

void LintScope::warnRepeated(const Declaration& node, Attr attr) {
  std::unordered_set<std::string_view> names;
  for (const NodeReference& reference : node.references(attr))
    if (!names.insert(reference.name).second)
      warnAt(reference.where,
             fmt::format("{} \"{}\" is given twice", node.type().find(attr)->name, reference.name));
}

std::string LintScope::called(const Declaration& node) {
  return node.name().empty() ? fmt::format("this {}", node.type().name())
                             : fmt::format("the {} \"{}\"", node.type().name(), node.name());
}

void lintSender(const Declaration& node, LintScope& scope) {
  if (node.has("eventmessage")) return scope.warnNeverOn(node);
  scope.warn(node, "name", fmt::format("{} has no eventmessage and so no effect", LintScope::called(node)));
}

/// Another file may name it where this one is only a part of a show.
static bool isUnused(const NodeUse& use, const LintScope& scope) {
  return scope.alone() && !use.isParent && !use.isFollowed;
}

void lintTargets(const Declaration& node, LintScope& scope) {
  if (!node.has("target") && (node.name().empty() || isUnused(scope.useOf(node), scope)))
    scope.warn(node, "name",
               fmt::format("{} moves nothing: it has no target, and no node has it as parent",
                           LintScope::called(node)));
  for (const NodeReference& target : node.references("target")) {
    const NodeUse* use = scope.useOf(target);
    if (use && use->simulated)
      scope.warnAt(target.where,
                   fmt::format("\"{}\" is moved by a dynamics node, never by this {}; make it an object",
                               target.name, node.type().name()));
    if (use && scope.document()[target.declaration].has("root"))
      scope.warnAt(
          target.where,
          fmt::format("\"{}\" is moved by its root bone, too; move a node that is its parent", target.name));
  }
}

void lint(const Document& document, bool alone, Diagnostics& findings) {
  LintScope scope(document, alone, findings);
  for (const Declaration node : document)
    if (const auto look = node.type().type().lint) look(node, scope);
}

void lintLatencies(const Document& document, Nanoseconds step, Diagnostics& findings) {
  // Said of the first one alone: at a low rate it may be all of them.
  std::optional<EventMessage> first;
  std::size_t count = 0;
  for (const Declaration node : document)
    for (const EventMessage& m : node.eventMessages()) {
      if (m.latency == 0 || m.delay + m.latency >= step) continue;
      if (count++ == 0) first = m;
    }
  if (!first) return;
  const std::string others = count == 1 ? "" : fmt::format("; so are {} more in this file", count - 1);
  FindingCollector(document.source(), findings)
      .warning(first->where,
               fmt::format("the latency of {:g} s is shorter than a frame ({:.4f} s at {:g} Hz), so that "
                           "the command waits for the next frame; state {:.3f} or more{}",
                           toSeconds(first->latency), toSeconds(step), 1 / toSeconds(step),
                           std::ceil(1e3 * toSeconds(step - first->delay)) / 1e3, others));
}

void lintTrackers(const Document& document, const std::vector<std::string>& known, const std::string& log,
                  Diagnostics& findings) {
  static const std::vector<std::string> kUsual = {kHeadTracker, kWandTracker, kFootTracker};
  FindingCollector report(document.source(), findings);
  const auto among = [](const std::vector<std::string>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
  };
  const auto look = [&](std::string_view name, std::uint32_t where) {
    if (name.empty() || among(kUsual, name) || among(known, name)) return;
    std::vector<std::string> near = known;
    near.insert(near.end(), kUsual.begin(), kUsual.end());
    const std::string meant = didYouMean(name, near);
    if (!log.empty())
      report.warning(where,
                     fmt::format("no device is called \"{}\": {} has {}{}", name, log,
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")), meant));
    else if (!meant.empty())
      report.warning(where, fmt::format("\"{}\" is no usual name of a device{}", name, meant));
  };
  for (const Declaration node : document) {
    if (node.has("tracker")) look(node.text("tracker"), node.offset("tracker"));
    for (const EventMessage& m : node.eventMessages()) look(m.tracker, m.command);
  }
}

}  // namespace stadion
