#pragma once
/// The last 600 frames of a run, kept in a file while it plays: whatever becomes of the program, they are
/// there afterwards. Each late frame gets its cause.
///
/// Threads    SpanReader's; counts and latest() from any.
/// Ownership  the file stays if a frame was late, the program died, or it was to stay(); else it is removed
/// if this one made it.
///            It is locked meanwhile: another run cannot keep its frames there. A file that is neither empty
///            nor such a file is never touched.

#include "profiling/record/frame_judge.h"

#include "engine/base/diagnostic.h"
#include "engine/base/file_descriptor.h"

#include <atomic>
#include <functional>
#include <map>
#include <optional>

namespace stadion {

struct BlackBoxOptions {
  std::string file{};
  double rate = 60;                                ///< [1/s]; 0 = nobody waits for frames: none is late
  std::vector<std::string> walls{};                ///< names
  std::function<void(const std::string&)> tell{};  ///< a late frame, in words; on the log's thread
  /// Who overran its budget in a frame; null: nobody knows of budgets.
  std::function<std::optional<Overrun>(std::uint64_t frame)> overrun{};
  bool sequential = false;  ///< the stages' times add up
  bool wanted = true;       ///< somebody asked for it: a show does not go without
};

class BlackBox final : public SpanReader {
public:
  static constexpr std::size_t kFrames = 600;

  /// Fails, and leaves the file as it is, if frames cannot be kept there.
  static Result<std::unique_ptr<BlackBox>> create(BlackBoxOptions options, const NodeNames& names);
  ~BlackBox() override;

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override { judge_.take(track, record); }
  void take(const CountRecord& count) override { judge_.take(count); }
  void take(const SharedSpan& shared) override { judge_.take(shared); }

  /// Late frames by cause.
  std::map<Cause, std::uint64_t> verdicts() const;
  std::uint64_t late() const;
  /// The run has failed: the file is kept, late frames or none.
  void stay() { stays_ = true; }
  bool stays() const { return stays_ || late() > 0; }
  const std::string& file() const { return options_.file; }

  /// What such a file holds, the oldest frame first; fails with what is wrong with it, also if it is damaged.
  struct Content {
    std::vector<std::string> walls;
    std::vector<FrameFacts> frames;
  };
  static Result<Content> read(const std::string& file);
  /// Whether a run keeps its frames there at the moment.
  static bool isWritten(const std::string& file);
  /// Removes such a file, of whatever version; none that a run writes, and nothing else.
  static void remove(const std::string& file);

private:
  struct Ring;
  struct Place;
  static Result<Place> open(const std::string& file, std::size_t walls);
  BlackBox(BlackBoxOptions options, const NodeNames& names, Place place);
  void keep(FrameFacts facts);

  BlackBoxOptions options_;
  FileDescriptor file_;  ///< holds the lock
  bool made_;            ///< the file was not there before
  Ring* ring_;           ///< in the file
  FrameJudge judge_;
  std::atomic<bool> stays_ = false;
  mutable std::mutex mutex_;
  std::map<Cause, std::uint64_t> verdicts_;
};

}  // namespace stadion
