#pragma once
/// Reads values, as they lie in memory, from the front of bytes that another process wrote and that may be
/// damaged.
///
/// Bounds   a count is compared with the remaining bytes before allocation: a false one costs nothing.
/// Errors   false once bytes are missing; the values read are then unspecified.
/// Bytes    of this machine's order and layout: between processes of one machine only.

#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace stadion {

class ValueReader {
public:
  explicit ValueReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  bool get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return raw(&value, sizeof value);
  }
  template <class T>
  bool get(std::vector<T>& values, std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > rest_.size() / sizeof(T)) return false;
    values.resize(count);
    return raw(values.data(), count * sizeof(T));
  }
  bool raw(void* to, std::size_t size) {
    if (size > rest_.size()) return false;
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_ = rest_.subspan(size);
    return true;
  }
  std::size_t left() const { return rest_.size(); }
  bool atEnd() const { return rest_.empty(); }

private:
  std::span<const std::byte> rest_;
};

}  // namespace stadion
