#pragma once
/// Appends values, as they lie in memory, to bytes for a ValueReader.

#include <cstdint>
#include <type_traits>
#include <vector>

namespace stadion {

class ValueWriter {
public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(&value, sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(values.data(), values.size() * sizeof(T));
  }
  void raw(const void* data, std::size_t size) {
    const auto* from = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }

  std::vector<std::uint8_t> bytes;
};

}  // namespace stadion
