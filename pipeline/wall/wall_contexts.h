#pragma once
/// The walls' contexts, each with its renderer and what that holds: programs, meshes, shadows.
///
/// They may outlive a show. The next one of the same place and the same mesh store then need not compile and
/// upload anything again, which in software takes longer than its first picture.
///
/// Threads  a wall's context is entered, left and used on one thread at a time; a thread that draws one wall
///          enters once, a thread that draws all of them goes from one to the next. Destroyed by any thread
///          once all have been left.

#include "pipeline/draw_list/renderer.h"
#include "pipeline/shader/look.h"
#include "pipeline/target/target.h"
#include "pipeline/wall/wall_renderer.h"

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace stadion {

class WallContexts {
public:
  WallContexts() = default;
  ~WallContexts();
  WallContexts(const WallContexts&) = delete;
  WallContexts& operator=(const WallContexts&) = delete;

  /// There are so many walls. Before they are opened; those that were there before stay.
  void resize(std::size_t walls);

  /// Enters the wall's context, which is made if there is none for that picture.
  Failure open(std::size_t wall, GlProvider& provider, const MeshStore& meshes, const WallPicture& picture,
               RenderQuality quality = {});
  /// Leaves whatever else is current on this thread.
  Failure enter(std::size_t wall);
  void leave(std::size_t wall);
  /// Frees what the wall has. Expects that it has been entered here, or never.
  void close(std::size_t wall);

  bool hasContext(std::size_t wall) const { return contexts_[wall]->target != nullptr; }
  /// Expects that it has been opened.
  Renderer& renderer(std::size_t wall) { return *contexts_[wall]->renderer; }
  const Renderer& renderer(std::size_t wall) const { return *contexts_[wall]->renderer; }

private:
  struct Context {
    std::unique_ptr<Target> target;
    std::unique_ptr<Renderer> renderer;
    WallPicture picture;  ///< the picture for which the context was made
    RenderQuality quality;
    std::atomic<std::thread::id> currentOn;  ///< the thread on which it is current
  };
  std::vector<std::unique_ptr<Context>> contexts_;
};

}  // namespace stadion
