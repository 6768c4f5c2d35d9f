#pragma once

#include <cstring>
#include <sstream>

#include "fields/field_bytes.hpp"

namespace pelagos {

/// The first field in which two values differ.
struct FieldDifference {
  std::string field;       ///< as in water.particles.position[17].x
  std::string one, other;  ///< the values there
};

/// A sink of FieldWalk that compares what it is told with the bytes of another value.
class FieldCompare {
 public:
  explicit FieldCompare(std::span<const std::byte> other) : other_(other) {}

  void enter(const char* name) { path_.push_back(name); }
  void enter(std::size_t index) { path_.push_back("[" + std::to_string(index) + "]"); }
  void leave() { path_.pop_back(); }
  template <class S>
  void scalars(std::span<const S> values, std::size_t each = 1) {
    if (difference_) return;
    const std::size_t bytes = std::min(values.size_bytes(), other_.size());
    if (bytes == values.size_bytes() && (bytes == 0 || std::memcmp(values.data(), other_.data(), bytes) == 0)) {
      other_ = other_.subspan(bytes);
      return;
    }
    find_scalar(values, each);
  }
  void size(std::size_t n) {
    const std::uint64_t number = n;
    enter("size");
    scalars(std::span(&number, 1));
    leave();
  }
  void text(const std::string& value);

  [[nodiscard]] const std::optional<FieldDifference>& difference() const { return difference_; }

 private:
  template <class S>
  void find_scalar(std::span<const S> values, std::size_t each) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      S there{};
      if (other_.size() < (k + 1) * sizeof(S)) return note(place(k, values.size(), each), number(values[k]), "nothing");
      std::memcpy(&there, other_.data() + k * sizeof(S), sizeof(S));
      if (std::memcmp(&there, &values[k], sizeof(S)) != 0)
        return note(place(k, values.size(), each), number(values[k]), number(there));
    }
  }
  template <class S>
  static std::string number(S value) {
    std::ostringstream text;
    text.precision(sizeof(S) > 4 ? 17 : 9);
    if constexpr (sizeof(S) == 1)
      text << static_cast<int>(value);
    else
      text << value;
    return text.str();
  }
  static std::string place(std::size_t scalar, std::size_t count, std::size_t each);
  void note(const std::string& place, const std::string& one, const std::string& other);

  std::span<const std::byte> other_;
  std::vector<std::string> path_;
  std::optional<FieldDifference> difference_;
};

/// Nothing where all bits are equal.
template <class T>
[[nodiscard]] std::optional<FieldDifference> find_difference(const T& one, const T& other) {
  const std::vector<std::byte> bytes = to_bytes(other);
  FieldCompare compare(bytes);
  walk_fields(one, compare);
  return compare.difference();
}

}  // namespace pelagos
