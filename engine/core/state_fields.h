#pragma once
/// Visits a state field by field, in a fixed order: to hash, save, restore or compare it.
///
/// A class with a state usually lists its fields once, for all four:
///
///     template <class Self, class Fields>
///     static void fields(Self& self, Fields& f) {
///       f("on", self.on_);
///       f("due", self.due_);
///       f.unhashed("handle", self.handle_);  // usually follows from other fields: saved, but not hashed
///     }
///
/// A node whose state other nodes hash in part has a hash() of its own: `dynamics` and `collision` nodes save
/// their whole world, and hash what their bodies, colliders and fields do not.
///
/// An enumeration in a state begins at 0. lastOf(), in its namespace, returns its last value:
///
///     constexpr HeldParts lastOf(HeldParts) { return HeldParts::All; }
///
/// Threads  one at a time.
/// Bits     numbers are saved by their bits, little end first. A restored value is the same to the bit.
/// Errors   saved bytes may be damaged or belong to another script. Reading them then ends in failed(), and
///          never reads out of bounds. Discard what was read before that.

#include "engine/core/message.h"
#include "engine/core/state_hash.h"
#include "engine/maths/maths.h"

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace stadion {

/// Visits numbers and texts by name. Derived classes save, restore and compare them.
class StateFields {
public:
  StateFields() = default;
  virtual ~StateFields() = default;
  StateFields(const StateFields&) = delete;
  StateFields& operator=(const StateFields&) = delete;

  template <class T>
  void operator()(std::string_view name, T& value) {
    name_ = name;
    visit(value);
  }
  /// A field that is not part of the hash.
  template <class T>
  void unhashed(std::string_view name, T& value) {
    (*this)(name, value);
  }
  /// A value that only the hash visits: another form of a saved field.
  template <class T>
  void hashed(const T&) {}
  /// The number of elements, which are visited one by one afterwards.
  std::size_t count(std::string_view name, std::size_t present) {
    name_ = name;
    std::uint64_t n = present;
    number(n, Form::Count);
    if (n > most()) fail();
    return failed() ? 0 : static_cast<std::size_t>(n);
  }

  /// The fields visited until the next call belong to this part of the node; 0 = to the node. See
  /// Node::nodeOf().
  void about(std::uint32_t part) { part_ = part; }

  /// Returns true if fields are set from saved bytes.
  virtual bool restores() const { return false; }
  /// Returns true if the bytes are no such state.
  virtual bool failed() const { return false; }
  /// Reports a value that cannot be: an unknown name, a place that does not exist.
  virtual void fail() {}

protected:
  /// How reports write a number's 64 bits.
  enum class Form : std::uint8_t { Whole, Signed, Real, Count };  ///< Count: the next fields depend on it
  virtual void number(std::uint64_t& bits, Form form) = 0;
  virtual void text(std::string& words) = 0;
  /// The most elements that a list may have: each takes a byte.
  virtual std::uint64_t most() const { return ~std::uint64_t{0}; }

  std::string_view name_;   ///< name of the visited field
  std::string_view outer_;  ///< name of the field that contains it; empty = none
  std::uint32_t part_ = 0;  ///< part of the node that the field belongs to; 0 = none

private:
  template <class T>
  void visit(T& value) {
    using U = std::remove_const_t<T>;
    if constexpr (std::is_const_v<T>)
      visit(const_cast<U&>(value));  // saving and comparing change nothing
    else if constexpr (std::is_same_v<U, double> || std::is_same_v<U, float>)
      real(value);
    else if constexpr (std::is_enum_v<U> || std::is_integral_v<U>)
      whole(value);
    else if constexpr (std::is_same_v<U, std::string>)
      text(value);
    else
      visitAll(value);
  }
  template <class T>
  void real(T& value) {
    auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(value));
    number(bits, Form::Real);
    value = static_cast<T>(std::bit_cast<double>(bits));
  }
  template <class T>
  void whole(T& value) {
    auto bits = static_cast<std::uint64_t>(value);
    number(bits, std::is_signed_v<T> ? Form::Signed : Form::Whole);
    if (!restores()) return;
    if constexpr (std::is_same_v<T, bool>)
      value = bits != 0;
    else
      value = static_cast<T>(bits);
    if (static_cast<std::uint64_t>(value) != bits) fail();
    if constexpr (std::is_enum_v<T>)
      if (value < T{} || value > lastOf(T{})) {
        value = T{};
        fail();
      }
  }

  void visitAll(Vec3& v) {
    for (int i = 0; i < 3; ++i) visit(v[i]);
  }
  void visitAll(Eigen::Vector4d& v) {
    for (int i = 0; i < 4; ++i) visit(v[i]);
  }
  void visitAll(Mat3& m) {
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) visit(m(r, c));
  }
  void visitAll(Quat& q) { visitAll(q.coeffs()); }
  void visitAll(Pose& X) {
    visitAll(X.p);
    visitAll(X.q);
  }
  void visitAll(Affine& X) {
    const std::string_view outer = std::exchange(outer_, name_);
    name_ = "axes";
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) visit(X.matrix()(r, c));
    name_ = "position";
    for (int r = 0; r < 3; ++r) visit(X.matrix()(r, 3));
    name_ = std::exchange(outer_, outer);
  }
  void visitAll(NodeRef& r) {
    visit(r.load);
    visit(r.position);
  }
  template <class A, class B>
  void visitAll(std::pair<A, B>& p) {
    visit(p.first);
    visit(p.second);
  }
  template <class T, std::size_t N>
  void visitAll(std::array<T, N>& list) {
    for (T& v : list) visit(v);
  }
  template <class T>
  void visitAll(std::optional<T>& o) {
    std::uint64_t there = o.has_value() ? 1 : 0;
    number(there, Form::Count);
    if (there > 1) fail();
    if (restores()) there == 1 ? void(o.emplace()) : o.reset();
    if (o) visit(*o);
  }
  template <class T>
  void visitAll(std::vector<T>& list) {
    const std::size_t n = count(name_, list.size());
    if (restores()) list.clear();
    for (std::size_t i = 0; i < n && !failed(); ++i) {
      if (restores()) list.emplace_back();
      if (i < list.size()) visit(list[i]);
    }
  }
  template <class T>
  void visitAll(std::deque<T>& d) {
    std::vector<T> list(d.begin(), d.end());
    visitAll(list);
    if (restores()) d = {list.begin(), list.end()};
  }
  template <class T>
  void visitAll(std::set<T>& s) {
    std::vector<T> list(s.begin(), s.end());
    visitAll(list);
    if (restores()) s = {list.begin(), list.end()};
  }
  template <class K, class V>
  void visitAll(std::map<K, V>& m) {
    std::vector<std::pair<K, V>> list(m.begin(), m.end());
    visitAll(list);
    if (restores()) m = {list.begin(), list.end()};
  }
  template <class K, class V>
  void visitAll(std::multimap<K, V>& m) {
    std::vector<std::pair<K, V>> list(m.begin(), m.end());
    visitAll(list);
    if (restores()) m = {list.begin(), list.end()};
  }
  /// A type with its own fields(), or with a function fieldsOf(value, f) beside it.
  template <class T>
  requires requires(T& v, StateFields& f) { T::fields(v, f); } || requires(T& v, StateFields& f) {
    fieldsOf(v, f);
  }
  void visitAll(T& value) {
    const std::string_view outer = std::exchange(outer_, name_);
    if constexpr (requires { T::fields(value, *this); })
      T::fields(value, *this);
    else
      fieldsOf(value, *this);
    name_ = std::exchange(outer_, outer);
  }
};

/// Adds the same fields to a hash. Of a list, only the elements are added.
class HashedFields {
public:
  explicit HashedFields(StateHash& hash) : hash_(hash) {}

  template <class T>
  void operator()(std::string_view, const T& value) {
    if constexpr (std::is_enum_v<T>)
      hash_.add(static_cast<std::uint32_t>(value));
    else if constexpr (requires { T::fields(value, *this); })
      T::fields(value, *this);
    else if constexpr (requires { value.has_value(); }) {
      if (value) (*this)({}, *value);
    } else if constexpr (requires { value.first, value.second; }) {
      (*this)({}, value.first);
      (*this)({}, value.second);
    } else if constexpr (requires { value.begin(); } && !std::is_same_v<T, std::string>)
      for (const auto& element : value) (*this)({}, element);
    else if constexpr (std::is_same_v<T, std::string>)
      hash_.add(std::string_view(value));
    else
      hash_.add(value);
  }
  template <class T>
  void unhashed(std::string_view, const T&) {}
  template <class T>
  void hashed(const T& value) {
    (*this)({}, value);
  }

private:
  StateHash& hash_;
};

/// The base class part of an object, const if the object is.
template <class Base, class Whole>
auto& partOf(Whole& whole) {
  if constexpr (std::is_const_v<Whole>)
    return static_cast<const Base&>(whole);
  else
    return static_cast<Base&>(whole);
}

/// Hashes an object that has fields().
template <class T>
void hashFields(const T& whole, StateHash& hash) {
  HashedFields f(hash);
  T::fields(whole, f);
}

/// Saves fields as bytes.
class SavedState final : public StateFields {
public:
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  std::vector<std::uint8_t> take() { return std::exchange(bytes_, {}); }

private:
  void number(std::uint64_t& bits, Form form) override;
  void text(std::string& words) override;

  std::vector<std::uint8_t> bytes_;
};

/// A hash of all that SavedState would write. Unlike the state hash it includes unhashed() fields. Numbers
/// are gathered and hashed many at a time, which takes half as long.
class StateDigest final : public StateFields {
public:
  std::uint64_t value();

private:
  void number(std::uint64_t& bits, Form) override {
    if (used_ == gathered_.size()) flush();
    gathered_[used_++] = bits;
  }
  void text(std::string& words) override;
  void flush();

  StateHash hash_;
  std::array<std::uint64_t, 512> gathered_;
  std::size_t used_ = 0;
};

/// Reads what SavedState wrote. The bytes must outlive it.
class StateBytes {
public:
  explicit StateBytes(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  std::uint64_t whole();
  std::uint64_t real();
  std::string text();
  bool failed() const { return failed_; }
  void fail() {
    failed_ = true;
    left_ = {};
  }
  std::size_t left() const { return left_.size(); }

private:
  std::span<const std::uint8_t> left_;
  bool failed_ = false;
};

/// Restores fields from bytes.
class RestoredState final : public StateFields {
public:
  explicit RestoredState(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool restores() const override { return true; }
  bool failed() const override { return bytes_.failed(); }
  void fail() override { bytes_.fail(); }
  /// Returns true if all bytes were read.
  bool complete() const { return !bytes_.failed() && bytes_.left() == 0; }

private:
  void number(std::uint64_t& bits, Form form) override;
  void text(std::string& words) override;
  std::uint64_t most() const override { return bytes_.left(); }

  StateBytes bytes_;
};

/// Compares fields with bytes that another process saved. Finds the first field that differs, and after
/// next() a further one. After lists of different length, no further one can be found.
class StateDifference final : public StateFields {
public:
  explicit StateDifference(std::span<const std::uint8_t> there) : there_(there) {}

  struct Field {
    std::string name;
    std::string here, there;  ///< as text
    std::uint32_t part;       ///< part of the node that the field belongs to; 0 = the node itself
  };
  const std::optional<Field>& first() const { return first_; }
  /// Looks for a further one in the fields visited from now on.
  void next() { first_.reset(); }

private:
  void number(std::uint64_t& bits, Form form) override;
  void text(std::string& words) override;
  void found(std::string here, std::string there);

  StateBytes there_;
  std::optional<Field> first_;
  bool apart_ = false;  ///< the next fields cannot be compared
};

}  // namespace stadion
