#pragma once
/// A running process that draws a wall, and the messages to and from it (protocol.h).
///
/// Ownership  owns the process, the draw list's segment and the pictures' segment; borrows the meshes.
/// Errors     if the process crashes, hangs or sends nonsense, the calls return and report it. The next
///            start() starts a new process. No signal reaches the show.
/// Threads    one at a time.

#include "pipeline/platform/child_process.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/process/list_bytes.h"
#include "pipeline/process/protocol.h"
#include "pipeline/process/shared_meshes.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace stadion::wall_process {

struct WallProcessSetting {
  std::filesystem::path program;  ///< stadion-wall
  RendererKind renderer = RendererKind::OsMesa;
  std::uint32_t width = 0, height = 0;  ///< size of one view's picture [pixels]
  RenderQuality quality{};
  std::uint32_t rasteriserThreads = 0;  ///< 0: it rasterises on the thread that draws
  ProcessorSet processors{};            ///< processors that the process may use; empty: all
  std::optional<std::uint32_t> card{};  ///< graphics card that draws; none: the provider's choice
};

/// The state of a process, as the system reports it.
struct ProcessStatus {
  double processorSeconds = -1;  ///< used so far; negative: not known. It stands still while it hangs
  char state = '?';  ///< as in /proc: R runs, or would if there was a processor; T stopped, Z dead
  int end = 0;       ///< exit status of a dead process, as from waitpid()
};

/// `stadion-wall` of this copy of Stadion (helperProgram).
std::filesystem::path wallProgram();

class WallProcess {
public:
  WallProcess(WallProcessSetting setting, const MeshStore& meshes, SharedMeshes& shared);
  ~WallProcess() { stop(); }
  WallProcess(const WallProcess&) = delete;
  WallProcess& operator=(const WallProcess&) = delete;

  enum class State {
    Down,     ///< there is no process
    Opening,  ///< the process makes its context
    Idle,
    Busy,  ///< with a list, or with pictures
  };
  State state() const { return state_; }

  /// Starts the process and has it open its context, without waiting. Returns why it could not, or nothing.
  std::optional<std::string> start();
  /// Kills it, if it runs, without waiting for its end.
  void stop();

  // For an idle one:
  /// Draws the list. With `read` the process also sends the pictures.
  void draw(const DrawList& list, bool read);
  /// Draws the list as draw() does, but its totals do not count.
  void warmUp(const DrawList& list);
  void readPictures();

  /// Waits for its answer, for at most that time. Returns true if it has become idle; answer() is then new.
  /// If it has exited, its state is Down and end() tells how it ended. That is noticed when its socket ends,
  /// or at the end of the time. (A rasteriser's threads, of lowest priority, may keep the socket open for
  /// seconds.)
  bool receive(std::chrono::milliseconds atMost);

  const AnswerHead& answer() const { return answer_; }
  const std::string& text() const { return text_; }  ///< text of the answer
  const std::string& end() const { return end_; }    ///< "was killed by signal 9 (Killed)"
  std::span<const std::byte> picture(std::uint32_t view) const;
  /// Returns true if picture() shows the list that was drawn last, even if the process has ended.
  bool holdsPictures() const { return holdsPictures_; }

  /// The state of the process when receive() last waited in vain.
  const ProcessStatus& status() const { return status_; }
  int pid() const { return process_->pid(); }
  int started() const { return started_; }

private:
  struct Sent {
    SharedMeshPlace place;
    std::uint64_t hash = 0;
  };

  void draw(const DrawList& list, OrderHead head);
  void order(const OrderHead& head, std::span<const int> descriptors = {});
  ListNews newsFor(const DrawList& list);
  void add(MeshId id, ListNews& news);
  void forgetFreed(ListNews& news);
  void updateStatus();
  void noteEnd(const std::string& how);

  WallProcessSetting setting_;
  const MeshStore& meshes_;
  SharedMeshes& sharedMeshes_;
  std::unique_ptr<ChildProcess> process_ = std::make_unique<ChildProcess>();
  std::vector<std::unique_ptr<ChildProcess>> dying_;  ///< killed; no call waits for their end
  FileDescriptor socket_;
  SharedSegment listBytes_, pictures_;
  State state_ = State::Down;
  StillKeys known_;
  std::unordered_map<MeshId, Sent> sent_;
  std::uint64_t freedCount_ = 0;  ///< MeshStore's count of freed meshes at the last order
  ProcessStatus status_;
  AnswerHead answer_{};
  std::string text_, end_;
  int started_ = 0;
  bool reads_ = false, holdsPictures_ = false;  ///< the order gives pictures; the pictures have arrived
};

}  // namespace stadion::wall_process
