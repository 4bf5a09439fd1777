/// Plugins that must be refused, by what they are compiled with.

#include "engine/build/plugin.h"

#ifndef STADION_LAYOUT
#define STADION_LAYOUT stadion::pluginLayout()
#endif
#ifndef STADION_TYPE
#define STADION_TYPE "unheard"
#endif
#ifndef STADION_NAME
#define STADION_NAME "faulty"
#endif

namespace {

using namespace stadion;

std::unique_ptr<Node> makeNothing(const NodeRequest&) {
  return nullptr;
}

constinit const NodeType kType{.name = STADION_TYPE, .help = "is never made", .make = makeNothing};

void addTypes(NodeRegistrar& types) {
  types.add(kType);
}

}  // namespace

extern "C" const Plugin* stadion_plugin() {
  static const Plugin kPlugin{
      .layout = STADION_LAYOUT, .name = STADION_NAME, .version = "2.0", .addTo = addTypes};
  return &kPlugin;
}
