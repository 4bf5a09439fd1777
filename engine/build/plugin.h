#pragma once
/// What a plugin exports: one function, which names the plugin and adds its node types.
///
///     extern "C" const stadion::Plugin* stadion_plugin() {
///       static const stadion::Plugin kPlugin{.name = "spring", .version = "1.0", .addTo = addTypes};
///       return &kPlugin;
///     }
///
/// A plugin calls the program's own functions: it links none of Stadion's libraries, and is built with the
/// headers of the program that loads it. `layout` detects most plugins
/// that were built with other headers.

#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/scene/scene.h"

#include <cstdint>

namespace stadion {

/// Version of Plugin and of all that it may call; counted up by hand.
inline constexpr std::uint32_t kPluginFormat = 1;

/// Differs where the classes that plugins use are laid out otherwise, or another compiler has built them.
constexpr std::uint32_t pluginLayout() {
  std::uint32_t hash = 2166136261U;
  for (const std::size_t size :
       {sizeof(NodeType), sizeof(AttributeSpec), sizeof(CommandSpec), sizeof(EventSpec), sizeof(NodeRequest),
        sizeof(Declaration), sizeof(Node), sizeof(PlacedNode), sizeof(ObjectNode), sizeof(Scene),
        sizeof(Placements), sizeof(FrameContext), sizeof(Message), sizeof(StateHash), std::size_t{__GNUC__},
        std::size_t{_GLIBCXX_USE_CXX11_ABI}})
    hash = (hash ^ static_cast<std::uint32_t>(size)) * 16777619U;
  return hash;
}

struct Plugin {
  std::uint32_t format = kPluginFormat;  ///< the first two stay where they are in every format
  std::uint32_t layout = pluginLayout();
  const char* name = "";     ///< as messages, snapshots and clusters call it
  const char* version = "";  ///< likewise
  void (*addTo)(NodeRegistrar& types) = nullptr;
};

}  // namespace stadion

extern "C" __attribute__((visibility("default"))) const stadion::Plugin* stadion_plugin();
