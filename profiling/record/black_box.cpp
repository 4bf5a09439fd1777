#include "profiling/record/black_box.h"

#include "engine/base/plain_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace stadion {
namespace {

constexpr char kMagic[16] = "stadion frames5";
constexpr std::string_view kAnyVersion = "stadion frames";
constexpr std::size_t kMostRecordedWalls = 1024;  ///< that a file holds
constexpr std::size_t kNameBytes = 32;

Diagnostic problem(const std::string& file, const std::string& what) {
  return {Severity::Error, {file, 0, 0}, what, {}};
}

Diagnostic cannotKeep(const std::string& file, int why) {
  return problem(file, std::string("the last frames cannot be kept here: ") + std::strerror(why));
}

constexpr const char* kFix = "; name a file that is not there yet, or one that such frames were kept in";

/// Returns true if the name still belongs to the opened file.
bool isStill(const std::string& name, int file) {
  struct stat named {
  }, opened{};
  return ::lstat(name.c_str(), &named) == 0 && ::fstat(file, &opened) == 0 && named.st_ino == opened.st_ino &&
         named.st_dev == opened.st_dev;
}

/// Returns true if the file begins with this text.
bool begins(int file, std::string_view with) {
  char magic[sizeof kMagic] = {};
  return ::pread(file, magic, sizeof magic, 0) == static_cast<ssize_t>(sizeof magic) &&
         std::string_view(magic, with.size()) == with;
}

/// Returns true if it may be overwritten: it is empty, or has frames of an earlier run.
bool mayBeReplaced(int file, off_t bytes) {
  return bytes == 0 || begins(file, {kMagic, sizeof kMagic});
}

/// Returns true if the text ends within its field and contains no control characters.
template <std::size_t N>
bool isText(const char (&field)[N]) {
  const char* end = static_cast<const char*>(std::memchr(field, 0, N));
  return end && std::all_of(field, end, [](char c) {
           const auto byte = static_cast<unsigned char>(c);
           return byte >= 0x20 && byte != 0x7f;
         });
}

bool isSound(const StageFacts& s) {
  return std::isfinite(s.ms) && std::isfinite(s.processor) && std::isfinite(s.turn) &&
         std::isfinite(s.loading) && std::isfinite(s.delayed) && std::isfinite(s.late) && std::isfinite(s.at);
}

/// Returns true if every field has a valid value.
bool isSound(const FrameFacts& f, std::uint32_t walls) {
  const bool place = f.walls <= walls && f.wall < std::max(1U, f.walls) && f.holder < std::max(1U, f.walls) &&
                     (isStage(f.stage));
  const bool figures = std::isfinite(f.period) && std::isfinite(f.budget) && std::isfinite(f.nodeMs) &&
                       std::isfinite(f.overMs) && std::isfinite(f.overBudget) && std::isfinite(f.tick) &&
                       std::isfinite(f.slot) && std::isfinite(f.sinceApp) && std::isfinite(f.waited);
  const auto sound = [](const StageFacts& s) { return isSound(s); };
  return place && figures && f.cause <= Cause::Unknown && isText(f.name) && isText(f.most) &&
         isText(f.over) && isSound(f.app) && isSound(f.swap) && std::ranges::all_of(f.cull, sound) &&
         std::ranges::all_of(f.draw, sound);
}

}  // namespace

/// The beginning of the file. The names of the walls follow, then the frames: for each a FrameRecord, and for
/// each wall the StageFacts of its Cull and its Draw.
struct BlackBox::Ring {
  char magic[16] = {};
  std::uint32_t recordBytes = 0, capacity = 0, walls = 0, reserved = 0;
  std::uint64_t written = 0;  ///< frames, ever

  using Name = char[kNameBytes];

  explicit Ring(std::size_t wallCount = 0)
      : recordBytes(sizeof(FrameRecord)), capacity(kFrames), walls(static_cast<std::uint32_t>(wallCount)) {
    std::memcpy(magic, kMagic, sizeof kMagic);
  }

  static std::size_t frameBytes(std::size_t walls) {
    return sizeof(FrameRecord) + 2 * walls * sizeof(StageFacts);
  }
  static std::size_t bytes(std::size_t walls) {
    return sizeof(Ring) + walls * kNameBytes + kFrames * frameBytes(walls);
  }
  std::byte* name(std::size_t wall) {
    return reinterpret_cast<std::byte*>(this) + sizeof(Ring) + wall * kNameBytes;
  }
  std::byte* frame(std::uint64_t number) { return name(walls) + number % kFrames * frameBytes(walls); }

  void put(const FrameFacts& facts) {
    std::byte* to = frame(written);
    const auto add = [&to](const void* from, std::size_t count) {
      std::memcpy(to, from, count);
      to += count;
    };
    FrameRecord record = facts;
    record.walls = std::min(facts.walls, walls);
    add(&record, sizeof record);
    for (std::size_t wall = 0; wall < walls; ++wall) {
      const bool known = wall < facts.walls;
      const StageFacts none, &cull = known ? facts.cull[wall] : none, &draw = known ? facts.draw[wall] : none;
      add(&cull, sizeof cull);
      add(&draw, sizeof draw);
    }
    ++written;
  }
  FrameFacts get(std::uint64_t number) {
    const std::byte* from = frame(number);
    const auto take = [&from](void* to, std::size_t count) {
      std::memcpy(to, from, count);
      from += count;
    };
    FrameFacts facts(walls);
    take(static_cast<FrameRecord*>(&facts), sizeof(FrameRecord));
    for (std::size_t wall = 0; wall < walls; ++wall) {
      take(&facts.cull[wall], sizeof(StageFacts));
      take(&facts.draw[wall], sizeof(StageFacts));
    }
    return facts;
  }
};

/// An open file that this run may write, with room for all data.
struct BlackBox::Place {
  FileDescriptor file;
  bool made = false;
  Ring* ring = nullptr;
};

Result<BlackBox::Place> BlackBox::open(const std::string& name, std::size_t walls) {
  constexpr int kHow = O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  Place place;
  place.file = FileDescriptor(::open(name.c_str(), kHow | O_CREAT | O_EXCL, 0600));
  place.made = static_cast<bool>(place.file);
  if (!place.made) {
    if (errno != EEXIST) return cannotKeep(name, errno);
    struct stat about {};
    if (::lstat(name.c_str(), &about) == 0 && !S_ISREG(about.st_mode))
      return problem(name, std::string("the last frames cannot be kept here: it is no plain file") + kFix);
    place.file = FileDescriptor(::open(name.c_str(), kHow));
    if (!place.file) return cannotKeep(name, errno);
  }
  const int file = place.file.get();
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 || !isStill(name, file))
    return problem(name, "another run keeps its last frames here; name another file");
  struct stat about {};
  if (::fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || !mayBeReplaced(file, about.st_size))
    return problem(name, "the last frames would be written over something else that is in this file" +
                             std::string(kFix));
  // The space is taken now: a full disk must not kill the show later.
  const std::size_t bytes = Ring::bytes(walls);
  int refused = posix_fallocate(file, 0, static_cast<off_t>(bytes));
  void* at = MAP_FAILED;
  if (refused == 0) {
    at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (at == MAP_FAILED) refused = errno;
  }
  const bool cut = refused == 0 && ::ftruncate(file, static_cast<off_t>(bytes)) == 0;
  if (refused == 0 && !cut) refused = errno;
  if (refused != 0) {
    if (at != MAP_FAILED) munmap(at, bytes);
    if (place.made) ::unlink(name.c_str());
    return cannotKeep(name, refused);
  }
  std::memset(at, 0, bytes);
  place.ring = new (at) Ring(walls);
  return place;
}

Result<std::unique_ptr<BlackBox>> BlackBox::create(BlackBoxOptions options, const NodeNames& names) {
  auto place = open(options.file, std::min(options.walls.size(), kMostRecordedWalls));
  if (!place) return place.error();
  Ring* ring = place.value().ring;
  for (std::size_t i = 0; i < ring->walls; ++i) {
    Ring::Name name = {};
    copyText(options.walls[i], name);
    std::memcpy(ring->name(i), name, sizeof name);
  }
  return std::unique_ptr<BlackBox>(new BlackBox(std::move(options), names, std::move(place.value())));
}

BlackBox::~BlackBox() {
  munmap(ring_, Ring::bytes(ring_->walls));
  const bool dying = std::uncaught_exceptions() > 0;
  if (!stays() && !dying && made_ && isStill(options_.file, file_.get())) ::unlink(options_.file.c_str());
}

BlackBox::BlackBox(BlackBoxOptions options, const NodeNames& names, Place place)
    : options_(std::move(options)), file_(std::move(place.file)), made_(place.made), ring_(place.ring),
      judge_(
          options_.rate, options_.walls.size(), names, [this](const FrameFacts& facts) { keep(facts); },
          options_.sequential) {}

void BlackBox::keep(FrameFacts facts) {
  if (const auto over = options_.overrun ? options_.overrun(facts.frame) : std::nullopt) {
    copyText(over->name, facts.over);
    facts.overMs = static_cast<float>(over->ms);
    facts.overBudget = static_cast<float>(over->budget);
  }
  ring_->put(facts);
  if (facts.cause == Cause::None) return;
  if (options_.late) options_.late(facts);
  {
    const std::lock_guard lock(mutex_);
    ++verdicts_[facts.cause];
  }
  if (options_.tell) options_.tell(toText(facts, options_.walls));
}

std::map<Cause, std::uint64_t> BlackBox::verdicts() const {
  const std::lock_guard lock(mutex_);
  return verdicts_;
}

std::uint64_t BlackBox::late() const {
  std::uint64_t late = 0;
  for (const auto& [cause, count] : verdicts()) late += count;
  return late;
}

Result<BlackBox::Content> BlackBox::read(const std::string& file) {
  auto bytes = readPlainFile(file, Ring::bytes(kMostRecordedWalls));
  if (!bytes) return bytes.error();
  const std::size_t size = bytes.value().size();
  const bool ours = size >= sizeof(Ring) && std::memcmp(bytes.value().data(), kMagic, sizeof kMagic) == 0;
  // The memory of a string of that length is aligned for any record.
  Ring* ring = ours ? reinterpret_cast<Ring*>(bytes.value().data()) : nullptr;
  if (!ring || ring->recordBytes != sizeof(FrameRecord) || ring->capacity != kFrames)
    return problem(file, "holds no frames that this version of stadion kept; run and view write such a file "
                         "while they play live");
  const auto damaged = [&] { return problem(file, "is damaged: what it holds cannot be frames of a show"); };
  if (ring->walls > kMostRecordedWalls || size != Ring::bytes(ring->walls)) return damaged();
  Content content;
  for (std::size_t i = 0; i < ring->walls; ++i) {
    Ring::Name name;
    std::memcpy(name, ring->name(i), sizeof name);
    if (!isText(name)) return damaged();
    content.walls.push_back(name);
  }
  const std::uint64_t count = std::min<std::uint64_t>(ring->written, kFrames);
  for (std::uint64_t i = ring->written - count; i != ring->written; ++i) {
    FrameFacts facts = ring->get(i);
    if (!isSound(facts, ring->walls)) return damaged();
    content.frames.push_back(std::move(facts));
  }
  // A crashed program may have begun to overwrite the oldest one.
  if (count > 1 && content.frames[0].frame >= content.frames[1].frame)
    content.frames.erase(content.frames.begin());
  return content;
}

bool BlackBox::isWritten(const std::string& name) {
  const FileDescriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  return file && ::flock(file.get(), LOCK_SH | LOCK_NB) != 0;
}

void BlackBox::remove(const std::string& name) {
  const FileDescriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (file && begins(file.get(), kAnyVersion) && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0 &&
      isStill(name, file.get()))
    ::unlink(name.c_str());
}

}  // namespace stadion
