#include "pipeline/cluster/scene_transfer.h"

#include "pipeline/cluster/orders.h"

#include <algorithm>
#include <utility>

namespace stadion::cluster {
namespace {

constexpr std::size_t kPart = 32 * 1024;          ///< [byte]
constexpr std::uint64_t kMostState = 4ULL << 30;  ///< [byte]

}  // namespace

void send(Bus& bus, const SceneTransfer& parcel) {
  bus.waitForReaders();
  StatePart part{};
  part.to = parcel.to, part.session = parcel.session, part.serial = parcel.serial;
  part.frame = parcel.frame, part.time = parcel.time;
  part.still = static_cast<std::uint8_t>(parcel.still), part.shown = written(parcel.shown);
  const std::vector<std::uint8_t>& bytes = parcel.scene.bytes;
  part.files = parcel.scene.files, part.size = bytes.size();
  do {
    const std::size_t size = std::min(kPart, bytes.size() - part.offset);
    // The sequence borrows the bytes and only reads them.
    part.bytes._buffer = const_cast<std::uint8_t*>(bytes.data()) + part.offset;
    part.bytes._release = false;
    part.bytes._length = part.bytes._maximum = static_cast<std::uint32_t>(size);
    if (!bus.tell(part)) return;
    part.offset += size;
  } while (part.offset < bytes.size());
}

void IncomingScene::add(const StatePart& part) {
  const std::uint64_t length = part.bytes._length;
  if (part.size > kMostState) return;
  // A complete scene that was never taken is replaced by a newer one.
  if (complete_ && part.session == parcel_.session && part.serial == parcel_.serial) return;
  if (complete_ && part.offset != 0) return;
  if (part.offset == 0) {
    complete_ = false;
    parcel_ = {};
    parcel_.to = part.to, parcel_.session = part.session, parcel_.serial = part.serial;
    parcel_.frame = part.frame, parcel_.time = part.time, parcel_.scene.files = part.files;
    parcel_.still = readStandstill(part.still).value_or(Standstill::None);
    parcel_.shown = read(part.shown).value_or(Presentation{});
    size_ = part.size, received_ = 0;
  }
  if (part.serial != parcel_.serial || part.session != parcel_.session || part.size != size_) return;
  if (part.frame != parcel_.frame || part.time != parcel_.time || part.to != parcel_.to) return;
  if (part.offset != received_ || length > part.size - part.offset) return;
  // Grows with each part: the announced size may be wrong.
  parcel_.scene.bytes.insert(parcel_.scene.bytes.end(), part.bytes._buffer, part.bytes._buffer + length);
  received_ += length;
  complete_ = received_ == part.size;
}

SceneTransfer IncomingScene::take() {
  complete_ = false, received_ = 0;
  return std::exchange(parcel_, {});
}

}  // namespace stadion::cluster
