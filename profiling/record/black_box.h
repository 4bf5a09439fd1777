#pragma once
/// The last 600 frames of a run, written to a file while it plays. They survive a crash of the program. Each
/// late frame gets its cause.
///
/// Threads    SpanReader's; late() and verdicts() from any.
/// Ownership  The file stays if a frame was late, if the program crashed, or after stay(). Otherwise it is
///            removed if this object made it. It is locked meanwhile: another run cannot keep its frames
///            there. A file that is neither empty nor a black box is never changed.

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
  double rate = 60;                                ///< [1/s]; 0 = frames are not paced: none is late
  std::vector<std::string> walls{};                ///< names
  std::function<void(const std::string&)> tell{};  ///< receives a late frame, in words; on the log's thread
  std::function<void(const FrameFacts&)> late{};   ///< receives a late frame; on the log's thread
  /// Returns the node that overran its budget in a frame; null: there are no budgets.
  std::function<std::optional<Overrun>(std::uint64_t frame)> overrun{};
  bool sequential = false;  ///< the stages' times add up
  bool wanted = true;       ///< the user asked for it: the show does not run without it
};

class BlackBox final : public SpanReader {
public:
  static constexpr std::size_t kFrames = 600;

  /// Fails, and leaves the file as it is, if frames cannot be written there.
  static Result<std::unique_ptr<BlackBox>> create(BlackBoxOptions options, const NodeNames& names);
  ~BlackBox() override;

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override { judge_.take(track, record); }
  void take(const CountRecord& count) override { judge_.take(count); }
  void take(const SharedSpan& shared) override { judge_.take(shared); }

  /// Late frames by cause.
  std::map<Cause, std::uint64_t> verdicts() const;
  std::uint64_t late() const;
  /// Reports that the run has failed: the file is kept even without late frames.
  void stay() { stays_ = true; }
  bool stays() const { return stays_ || late() > 0; }
  const std::string& file() const { return options_.file; }

  /// The content of a black box, the oldest frame first. Reading fails with the error if the file is damaged.
  struct Content {
    std::vector<std::string> walls;
    std::vector<FrameFacts> frames;
  };
  static Result<Content> read(const std::string& file);
  /// Returns true if a run writes its frames there at the moment.
  static bool isWritten(const std::string& file);
  /// Removes a black box of any version, but none that a run is writing, and no other file.
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
