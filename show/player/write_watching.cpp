#include "show/player/write_watching.h"

#include "pipeline/loop/frame_loop.h"
#include "profiling/record/node_names.h"

#include <fmt/format.h>

namespace stadion {

std::unique_ptr<WriteWatch> watchWrites(bool asked, const ShowParts& parts, FrameLoopOptions& options) {
  if (!asked) return nullptr;
  auto watch = std::make_unique<WriteWatch>(parts.state, parts.walls.size());
  options.watch = watch.get();
  return watch;
}

void nameNode(Failure& failure, const Scene& scene) {
  if (!failure || !failure->node.valid()) return;
  NodeNames names;
  names.see(scene);
  if (const auto node = names.find(failure->node))
    failure->message += fmt::format(", of {} ({}:{})", node->path, node->file, node->line);
}

}  // namespace stadion
