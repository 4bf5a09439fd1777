#include "profiling/black_box.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/mman.h>
#include <unistd.h>

namespace stadion {
namespace {

constexpr char kMagic[16] = "stadion frames2";

Diagnostic problem(const std::string& file, const std::string& what) {
  return {Severity::Error, {file, 0, 0}, what, {}};
}

}  // namespace

/// What lies in the file.
struct BlackBox::Ring {
  char magic[16] = {};
  std::uint32_t recordBytes = 0, capacity = 0, walls = 0, reserved = 0;
  std::uint64_t written = 0;  ///< frames, ever
  char names[FrameFacts::kMostWalls][32] = {};
  FrameFacts frames[kFrames];
};

Result<std::unique_ptr<BlackBox>> BlackBox::create(BlackBoxOptions options, const NodeNames& names) {
  const int file = ::open(options.file.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0)
    return problem(options.file, std::string("the last frames cannot be kept: ") + std::strerror(errno));
  // The space is taken now: a full disk must not kill the show later.
  const int refused = posix_fallocate(file, 0, sizeof(Ring));
  void* at =
      refused == 0 ? mmap(nullptr, sizeof(Ring), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  ::close(file);
  if (at == MAP_FAILED) {
    ::unlink(options.file.c_str());
    return problem(options.file, std::string("the last frames cannot be kept: ") +
                                     std::strerror(refused != 0 ? refused : errno));
  }
  Ring* ring = new (at) Ring();
  std::memcpy(ring->magic, kMagic, sizeof kMagic);
  ring->recordBytes = sizeof(FrameFacts), ring->capacity = kFrames;
  ring->walls = static_cast<std::uint32_t>(std::min(options.walls.size(), FrameFacts::kMostWalls));
  for (std::size_t i = 0; i < ring->walls; ++i) copyText(options.walls[i], ring->names[i]);
  return std::unique_ptr<BlackBox>(new BlackBox(std::move(options), names, ring));
}

BlackBox::~BlackBox() {
  munmap(ring_, sizeof(Ring));
  if (late() == 0) ::unlink(options_.file.c_str());
}

BlackBox::BlackBox(BlackBoxOptions options, const NodeNames& names, Ring* ring)
    : options_(std::move(options)), ring_(ring),
      judge_(options_.rate, options_.walls.size(), names, [this](const FrameFacts& facts) { keep(facts); }) {}

void BlackBox::keep(FrameFacts facts) {
  if (const auto over = options_.overrun ? options_.overrun(facts.frame) : std::nullopt) {
    copyText(over->name, facts.over);
    facts.overMs = static_cast<float>(over->ms), facts.overBudget = static_cast<float>(over->budget);
  }
  ring_->frames[ring_->written % kFrames] = facts;
  ++ring_->written;
  if (facts.cause == Cause::None) return;
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
  std::ifstream in(file, std::ios::binary);
  if (!in) return problem(file, "cannot be read");
  const auto ring = std::make_unique<Ring>();
  in.read(reinterpret_cast<char*>(ring.get()), sizeof(Ring));
  if (static_cast<std::size_t>(in.gcount()) != sizeof(Ring) ||
      std::memcmp(ring->magic, kMagic, sizeof kMagic) != 0 || ring->recordBytes != sizeof(FrameFacts) ||
      ring->capacity != kFrames || ring->walls > FrameFacts::kMostWalls)
    return problem(file, "holds no frames that this version of stadion kept");
  Content content;
  for (std::size_t i = 0; i < ring->walls; ++i) {
    ring->names[i][sizeof ring->names[i] - 1] = 0;
    content.walls.push_back(ring->names[i]);
  }
  const std::uint64_t first = ring->written > kFrames ? ring->written - kFrames : 0;
  for (std::uint64_t i = first; i < ring->written; ++i) {
    FrameFacts facts = ring->frames[i % kFrames];
    facts.name[sizeof facts.name - 1] = 0;
    facts.walls = std::min(facts.walls, ring->walls);
    facts.wall = std::min(facts.wall, std::max(1U, facts.walls) - 1);
    content.frames.push_back(facts);
  }
  return content;
}

}  // namespace stadion
