#pragma once
/// What the machines of a cluster say, as it lies on the network, and a conversation of it as one input.
///
/// A conversation is steps: one byte says which, one or two how many bytes follow (little end first), then
/// these.
///
/// Threads  plain functions.

#include "pipeline/cluster/bus.h"
#include "tests/fuzz/targets.h"

#include <dds/ddsi/ddsi_cdrstream.h>
#include <vector>

namespace stadion::fuzz {

enum class Step : std::uint8_t {
  Session,
  Presence,
  Order,
  Drawn,
  Go,
  SceneHash,
  Difference,
  StatePart,
  Left,       ///< a node says good-bye
  Join,       ///< the follower asks to
  Next,       ///< it takes the next order
  Show,       ///< both have drawn
  Issue,      ///< the leader orders a frame
  Simulated,  ///< the leader has made one
  TakeOver,   ///< it looks for a show that the others play
  Begin,      ///< it begins, or goes on
  Count
};

constexpr std::uint32_t kEncoding = 1;  ///< XCDR1, as Cyclone writes these types

/// Cyclone's own reading: what it lets through is what listeners hear.
template <class T>
class Packet {
public:
  Packet(const dds_topic_descriptor_t& type, Bytes bytes) : ops_(type.m_ops) {
    std::vector<char> copy(bytes.begin(), bytes.end());
    if (copy.empty()) return;
    std::uint32_t used = 0;
    const auto size = static_cast<std::uint32_t>(copy.size());
    if (!dds_stream_normalize_data(copy.data(), &used, size, false, kEncoding, ops_)) return;
    dds_istream_t in;
    dds_istream_init(&in, size, copy.data(), kEncoding);
    dds_stream_read(&in, reinterpret_cast<char*>(&value_), ops_);
    read_ = true;
  }
  ~Packet() { dds_stream_free_sample(&value_, ops_); }
  Packet(const Packet&) = delete;
  Packet& operator=(const Packet&) = delete;

  explicit operator bool() const { return read_; }
  const T& operator*() const { return value_; }

private:
  const std::uint32_t* ops_;
  T value_{};
  bool read_ = false;
};

template <class T>
std::vector<std::uint8_t> written(const dds_topic_descriptor_t& type, const T& value) {
  dds_ostream_t out;
  dds_ostream_init(&out, 0, kEncoding);
  dds_stream_write(&out, reinterpret_cast<const char*>(&value), type.m_ops);
  std::vector<std::uint8_t> bytes(out.m_buffer, out.m_buffer + out.m_index);
  dds_ostream_fini(&out);
  return bytes;
}

}  // namespace stadion::fuzz
