#pragma once
/// The fields of an object by name, with values as text.
///
/// Other builds may have other fields. By name, their states can still be compared.
///
/// Threads  one at a time.

#include "engine/core/state_fields.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

/// Lists them.
class NamedState final : public StateFields {
public:
  struct Field {
    std::string name;
    std::string value;       ///< a few numbers or texts, else a hash of all
    std::uint32_t part = 0;  ///< part of the node that the field belongs to; 0 = the node itself
  };
  /// Without fields that are zero or empty.
  std::vector<Field> take();

private:
  struct Gathered {
    Field field;
    StateHash hash;
    std::size_t values = 0;
    bool isZero = true;
  };

  void number(std::uint64_t& bits, Form form) override;
  void text(std::string& words) override;
  Gathered& gathered();
  void show(Gathered& g, const std::string& value);

  std::vector<Gathered> fields_;
  std::map<std::pair<std::uint32_t, std::string>, std::size_t> places_;  ///< by part and name
};

}  // namespace stadion
