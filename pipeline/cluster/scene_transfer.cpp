#include "pipeline/cluster/scene_transfer.h"

#include "pipeline/cluster/orders.h"

#include <algorithm>
#include <utility>

namespace stadion::cluster {
namespace {

constexpr std::size_t kPart = 32 * 1024;          ///< [byte]
constexpr std::uint64_t kMostState = 4ULL << 30;  ///< [byte]

}  // namespace

void send(Bus& bus, const SceneTransfer& transfer) {
  bus.waitForReaders();
  StatePart part{};
  part.to = transfer.to;
  part.session = transfer.session;
  part.serial = transfer.serial;
  part.frame = transfer.frame;
  part.time = transfer.time;
  part.still = static_cast<std::uint8_t>(transfer.still);
  part.shown = written(transfer.presentation);
  const std::vector<std::uint8_t>& bytes = transfer.scene.bytes;
  part.files = transfer.scene.files;
  part.size = bytes.size();
  do {
    const std::size_t size = std::min(kPart, bytes.size() - part.offset);
    // The sequence borrows the bytes and only reads them.
    part.bytes._buffer = const_cast<std::uint8_t*>(bytes.data()) + part.offset;
    part.bytes._release = false;
    part.bytes._length = part.bytes._maximum = static_cast<std::uint32_t>(size);
    if (!bus.send(part)) return;
    part.offset += size;
  } while (part.offset < bytes.size());
}

void IncomingScene::add(const StatePart& part) {
  const std::uint64_t length = part.bytes._length;
  if (part.size > kMostState) return;
  // A complete scene that was never taken is replaced by a newer one.
  if (complete_ && part.session == transfer_.session && part.serial == transfer_.serial) return;
  if (complete_ && part.offset != 0) return;
  if (part.offset == 0) {
    complete_ = false;
    transfer_ = {};
    transfer_.to = part.to;
    transfer_.session = part.session;
    transfer_.serial = part.serial;
    transfer_.frame = part.frame;
    transfer_.time = part.time;
    transfer_.scene.files = part.files;
    transfer_.still = readStandstill(part.still).value_or(Standstill::None);
    transfer_.presentation = read(part.shown).value_or(Presentation{});
    size_ = part.size;
    received_ = 0;
  }
  if (part.serial != transfer_.serial || part.session != transfer_.session || part.size != size_) return;
  if (part.frame != transfer_.frame || part.time != transfer_.time || part.to != transfer_.to) return;
  if (part.offset != received_ || length > part.size - part.offset) return;
  // Grows with each part: the announced size may be wrong.
  transfer_.scene.bytes.insert(transfer_.scene.bytes.end(), part.bytes._buffer, part.bytes._buffer + length);
  received_ += length;
  complete_ = received_ == part.size;
}

SceneTransfer IncomingScene::take() {
  complete_ = false;
  received_ = 0;
  return std::exchange(transfer_, {});
}

}  // namespace stadion::cluster
