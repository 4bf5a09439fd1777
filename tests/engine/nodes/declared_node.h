#pragma once
/// A node as a script declares it, for tests of a node type that has no header.

#include "engine/build/node_request.h"
#include "engine/scene/loaded_scene.h"
#include "engine/script/script.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>

namespace stadion {

/// Adds the node of a script with this one declaration, which may refer to no other.
inline Node& addDeclared(LoadedScene& load, const std::string& name, const std::string& script) {
  Diagnostics findings;
  const Document document = parseScript(SourceText::make("a.evs", script).value(), testTypes(), findings);
  for (const Diagnostic& d : findings.all()) ADD_FAILURE() << format(d);
  const std::function<NodeRef(const NodeReference&)> resolve;
  const std::function<std::optional<PlacedModel>(const NodeReference&)> model;
  NodeServices services;
  const auto position = static_cast<std::uint32_t>(load.nodes.size());
  const NodeRequest request{
      document[0], {load.number, position}, name, {}, {}, nullptr, resolve, model, findings, services};
  load.nodes.push_back(request.type().make(request));
  load.enterOrder.push_back(position);
  load.names[name] = position;
  return *load.nodes.back();
}

}  // namespace stadion
