#include "pipeline/supervision/shared_progress.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

constexpr std::uint64_t kMark = 0x3476'7065'6573'7453;  ///< identifies this layout
constexpr off_t kPageBytes = 4096;

/// A value that one process writes and another one reads as a whole; the newest one counts.
template <class T>
struct Newest {
  std::atomic<std::uint64_t> serial = 0;  ///< 0: no value yet
  std::array<T, 2> values{};

  const T* find() const {
    const std::uint64_t n = serial.load(std::memory_order_acquire);
    return n == 0 ? nullptr : &values[n % 2];
  }
  T& next() { return values[(serial.load(std::memory_order_relaxed) + 1) % 2]; }
  void publish() { serial.store(serial.load(std::memory_order_relaxed) + 1, std::memory_order_release); }
};

}  // namespace

struct SharedProgress::Page {
  std::uint64_t mark = kMark;
  std::atomic<Phase> phase = Phase::Opening;
  std::atomic<std::uint64_t> starts = 0, shown = 0;
  std::atomic<Nanoseconds> lastShown = 0, caughtUp = 0;
  Newest<Moment> moment;
  Newest<Kept> kept;
  Newest<OperatorState> operatorState;
};

Nanoseconds machineClock() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::unique_ptr<SharedProgress> SharedProgress::map(FileDescriptor file) {
  static_assert(sizeof(Page) <= kPageBytes);
  void* at = mmap(nullptr, kPageBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (at == MAP_FAILED) return nullptr;
  return std::unique_ptr<SharedProgress>(new SharedProgress(std::move(file), static_cast<Page*>(at)));
}

Result<std::unique_ptr<SharedProgress>> SharedProgress::create() {
  const auto none = [] {
    return Result<std::unique_ptr<SharedProgress>>::failure(
        std::string("no memory to share with the player: ") + std::strerror(errno));
  };
  FileDescriptor file(memfd_create("stadion-progress", 0));  // the player inherits it
  if (!file || ftruncate(file.get(), kPageBytes) != 0) return none();
  auto made = map(std::move(file));
  if (!made) return none();
  new (made->page_) Page;
  return made;
}

std::unique_ptr<SharedProgress> SharedProgress::attach(int descriptor) {
  struct stat info {};
  if (fstat(descriptor, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size < kPageBytes) return nullptr;
  fcntl(descriptor, F_SETFD, FD_CLOEXEC);  // not for the player's own children
  auto made = map(FileDescriptor(descriptor));
  return made && made->page_->mark == kMark ? std::move(made) : nullptr;
}

SharedProgress::~SharedProgress() {
  munmap(page_, kPageBytes);
}

void SharedProgress::enter(Phase phase) {
  page_->phase = phase;
}

SharedProgress::Phase SharedProgress::phase() const {
  return page_->phase;
}

void SharedProgress::simulated(const TimeSignature& now, Nanoseconds due) {
  page_->moment.next() = {now.frame, now.time, machineClock(), std::max(now.time, due)};
  page_->moment.publish();
}

void SharedProgress::shown() {
  page_->lastShown = machineClock();
  ++page_->shown;
}

int SharedProgress::keep(Kept kept, std::span<const std::uint8_t> scene) {
  const Kept before = this->kept().value_or(Kept{0, 0, 0, 0, kPageBytes});
  const bool fitsBefore = kPageBytes + scene.size() <= before.at;
  kept.at = fitsBefore ? kPageBytes : before.at + before.bytes;
  auto at = static_cast<off_t>(kept.at);
  for (std::span<const std::uint8_t> left = scene; !left.empty();) {
    const ssize_t written = pwrite(file_.get(), left.data(), left.size(), at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    left = left.subspan(static_cast<std::size_t>(written));
    at += written;
  }
  kept.bytes = scene.size();
  page_->kept.next() = kept;
  page_->kept.publish();
  return 0;
}

void SharedProgress::catchesUpUntil(Nanoseconds clock) {
  page_->caughtUp = clock;
}

void SharedProgress::forget() {
  page_->moment.serial = 0;
  page_->kept.serial = 0;
}

void SharedProgress::setOperatorState(const OperatorState& state) {
  Moment last = newest();
  if (last.clock > 0 && operatorState().still() && !state.still()) {  // the show stood still until now
    last.clock = machineClock();
    page_->moment.next() = last;
    page_->moment.publish();
  }
  page_->operatorState.next() = state;
  page_->operatorState.publish();
}

SharedProgress::Moment SharedProgress::newest() const {
  const Moment* m = page_->moment.find();
  return m ? *m : Moment{};
}

std::uint64_t SharedProgress::framesShown() const {
  return page_->shown;
}

Nanoseconds SharedProgress::lastShown() const {
  return page_->lastShown;
}

Nanoseconds SharedProgress::played() const {
  const Nanoseconds since = page_->caughtUp;
  return since == 0 ? 0 : std::max<Nanoseconds>(0, page_->lastShown - since);
}

std::optional<SharedProgress::Kept> SharedProgress::kept() const {
  const Kept* k = page_->kept.find();
  return k ? std::optional(*k) : std::nullopt;
}

std::vector<std::uint8_t> SharedProgress::scene() const {
  const auto about = kept();
  struct stat info {};
  if (!about || fstat(file_.get(), &info) != 0) return {};
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (about->bytes > size || about->at > size - about->bytes) return {};
  std::vector<std::uint8_t> bytes(about->bytes);
  auto at = static_cast<off_t>(about->at);
  for (std::size_t got = 0; got < bytes.size();) {
    const ssize_t n = pread(file_.get(), bytes.data() + got, bytes.size() - got, at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return {};
    got += static_cast<std::size_t>(n);
    at += n;
  }
  return bytes;
}

OperatorState SharedProgress::operatorState() const {
  const OperatorState* state = page_->operatorState.find();
  return state ? *state : OperatorState{};
}

Nanoseconds SharedProgress::timeNow() const {
  const Moment last = newest();
  if (last.clock == 0 || operatorState().still()) return last.due;
  return last.due + (machineClock() - last.clock);
}

std::uint64_t SharedProgress::starts() const {
  return page_->starts;
}

void SharedProgress::countStart() {
  ++page_->starts;
  page_->caughtUp = 0;
}

}  // namespace stadion
