#pragma once
/// What `run` leaves behind: picture files, contact sheets, a video, pictures' hashes. Written by a thread of
/// its own, so that Draw only hands pictures over; it waits when the writer falls far behind, because every
/// picture asked for is written.

#include "pipeline/loop/show_stages.h"
#include "pipeline/picture/stereo.h"
#include "pipeline/record/video.h"
#include "show/output/output_folder.h"
#include "show/output/picture_hashes.h"

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace stadion {

/// The frames whose pictures are written.
struct PictureChoice {
  enum class Kind { None, Last, All, EveryNth } kind = Kind::Last;
  std::uint64_t n = 1;

  /// "last", "all", or a number N for every Nth.
  static std::optional<PictureChoice> parse(const std::string& text);
};

struct RunOutputOptions {
  OutputFolder& folder;
  PictureChoice pictures;
  bool sheets = false;  ///< a contact sheet beside each frame's pictures
  bool video = false;
  bool hashes = false;   ///< write hashes of every picture
  bool further = false;  ///< the run goes on with one that wrote into the folder
  double rate = 60;
  StereoLayout layout = StereoLayout::Pair;
  std::vector<std::string> wallNames;
  std::vector<double> wallAspects;  ///< width by height of each [1]
};

class RunOutput final : public PictureSink {
public:
  explicit RunOutput(RunOutputOptions options);
  ~RunOutput() override;

  bool wants(const TimeSignature& now) const override;
  Failure take(const TimeSignature& now, const std::vector<EyePictures>& walls) override;

  /// Writes the last frame's pictures and the contact sheet, waits for the writer, closes the video.
  /// Where the walls' pictures are of different frames (a frame was not finished), none of them is written.
  void finish(const std::vector<EyePictures>& walls);

  const std::vector<std::string>& files() const { return files_; }      ///< the ones worth naming
  const std::vector<std::string>& remarks() const { return remarks_; }  ///< things that did not work as asked
  /// Why pictures could not be written, if so. After finish().
  const Failure& failure() const { return failure_; }

private:
  struct Job {
    std::uint64_t frame;
    std::vector<EyePictures> walls;
    bool pictures;
    std::chrono::steady_clock::time_point shown{};
  };

  bool wantsPictures(std::uint64_t frame) const;
  void work();
  void write(const Job& job);
  void writePictures(const Job& job);
  void writeLast(const Job& last);
  void addToVideo(const Job& job);
  void writeFile(const std::string& name, const Picture& picture);
  void fail(Reason why);
  void failBy(const char* thrown) noexcept;
  template <class Work>
  void guard(const Work& work);
  Picture sheetOf(const Job& job, std::uint32_t cellWidth) const;

  RunOutputOptions options_;
  std::unique_ptr<VideoWriter> video_;
  std::optional<PictureHashes> hashes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool ending_ = false;
  std::atomic<bool> failed_ = false;
  std::atomic<bool> videoFailed_ = false;  ///< then no frame is drawn for its sake
  Failure failure_;                        ///< the first one
  std::vector<std::string> files_, remarks_;
  std::uint64_t lastWritten_ = ~std::uint64_t{0};
  std::thread writer_;
};

}  // namespace stadion
