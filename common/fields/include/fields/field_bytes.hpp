#pragma once

#include <cstring>
#include <stdexcept>

#include "fields/fields.hpp"

namespace pelagos {

/// A sink of FieldWalk that hands values on as bytes: scalars in this machine's byte order, sizes and texts with their
/// length before them. `Target` has add(data, bytes).
template <class Target>
class FieldEncoder {
 public:
  void enter(const char*) {}
  void enter(std::size_t) {}
  void leave() {}
  template <class S>
  void scalars(std::span<const S> values, std::size_t = 1) {
    target_.add(values.data(), values.size_bytes());
  }
  void size(std::size_t n) {
    const std::uint64_t number = n;
    target_.add(&number, sizeof number);
  }
  void text(const std::string& value) {
    size(value.size());
    target_.add(value.data(), value.size());
  }
  [[nodiscard]] Target& target() { return target_; }
  [[nodiscard]] const Target& target() const { return target_; }

 private:
  Target target_;
};

/// Bytes that grow at their end.
class ByteList {
 public:
  void add(const void* data, std::size_t bytes) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + bytes);
  }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Writes fields as bytes.
class FieldWriter : public FieldEncoder<ByteList> {
 public:
  void reserve(std::size_t bytes) { target().reserve(bytes); }
  [[nodiscard]] std::vector<std::byte> take() { return target().take(); }
};

/// Bytes that are no value of the type that is read.
class DecodeFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a value from bytes that FieldWriter wrote. Throws DecodeFault, and std::bad_alloc never for what the bytes
/// hold: nothing is allocated for which the bytes that follow do not suffice.
class FieldDecoder {
 public:
  explicit FieldDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(const char* name, T&& value) {
    name_ = name;
    read(value);
  }

  template <class T>
  void read(T& value) {
    using namespace fields_detail;
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t flag = 0;
      scalars(std::span(&flag, 1));
      if (flag > 1) fail("is no flag");
      value = flag == 1;
    } else if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      scalars(std::span(&number, 1));
      value = static_cast<T>(number);
    } else if constexpr (IsScalars<T>) {
      scalars(scalars_of(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(size(1));
      scalars(std::span(value.data(), value.size()));
    } else if constexpr (IsA<T, PaddedRows>) {
      read_padded(value);
    } else if constexpr (IsA<T, std::optional>) {
      if (size(0, 1) == 0)
        value.reset();
      else
        read(value.emplace());
    } else if constexpr (IsA<T, std::variant>) {
      read_variant(value, size(0, std::variant_size_v<T> - 1), std::make_index_sequence<std::variant_size_v<T>>());
    } else if constexpr (IsA<T, std::map>) {
      read_map(value);
    } else if constexpr (IsA<T, std::set>) {
      read_set(value);
    } else if constexpr (IsA<T, std::vector>) {
      value.clear();
      value.resize(size(least_bytes<typename T::value_type>()));
      rows(std::span(value));
    } else if constexpr (IsArray<T>::value) {
      rows(std::span<typename T::value_type>(value));
    } else {
      T::visit_fields(value, *this);
    }
  }

  /// Throws unless all bytes have been read.
  void finish() const {
    if (!bytes_.empty()) throw DecodeFault(std::to_string(bytes_.size()) + " bytes are left over");
  }

 private:
  template <class T>
  static constexpr std::size_t least_bytes() {
    return IsScalars<T> ? sizeof(T) : 1;
  }
  [[noreturn]] void fail(const std::string& what) const { throw DecodeFault(std::string(name_) + " " + what); }
  void need(std::size_t count, std::size_t each) const {
    if (count > bytes_.size() / each) fail("goes on beyond the end");
  }
  template <class S>
  void scalars(std::span<S> values) {
    need(values.size(), sizeof(S));
    if (values.empty()) return;
    std::memcpy(values.data(), bytes_.data(), values.size_bytes());
    bytes_ = bytes_.subspan(values.size_bytes());
  }
  /// @param each  bytes that each of them takes at least, 0: none
  std::size_t size(std::size_t each, std::size_t most = SIZE_MAX) {
    std::uint64_t number = 0;
    scalars(std::span(&number, 1));
    if (number > most) fail("has the size " + std::to_string(number) + "; allowed: at most " + std::to_string(most));
    if (each > 0) need(number, each);
    return number;
  }
  template <class T>
  void rows(std::span<T> values) {
    if constexpr (IsScalars<T>) {
      if (values.empty()) return;
      const auto first = scalars_of(values.front());
      scalars(std::span(first.data(), first.size() * values.size()));
    } else {
      for (T& value : values) read(value);
    }
  }
  template <class Rows>
  void read_padded(Rows& rows_of) {
    using T = std::remove_cvref_t<decltype(rows_of.padding)>;
    need(rows_of.count, least_bytes<T>());
    rows_of.values.assign(rows_of.padded, rows_of.padding);
    rows(std::span(rows_of.values).first(rows_of.count));
  }
  template <class Map>
  void read_map(Map& value) {
    value.clear();
    for (std::size_t left = size(1); left > 0; --left) {
      typename Map::key_type key{};
      read(key);
      read(value[std::move(key)]);
    }
  }
  template <class Set>
  void read_set(Set& value) {
    value.clear();
    for (std::size_t left = size(1); left > 0; --left) {
      typename Set::value_type key{};
      read(key);
      value.insert(std::move(key));
    }
  }
  template <class Variant, std::size_t... Index>
  void read_variant(Variant& value, std::size_t chosen, std::index_sequence<Index...>) {
    const auto read_one = [&]<std::size_t I>() {
      if (I == chosen) read(value.template emplace<I>());
    };
    (read_one.template operator()<Index>(), ...);
  }

  std::span<const std::byte> bytes_;
  const char* name_ = "the value";
};

template <class T>
[[nodiscard]] std::vector<std::byte> to_bytes(const T& value, std::size_t expected = 0) {
  FieldWriter writer;
  writer.reserve(expected);
  walk_fields(value, writer);
  return writer.take();
}

/// Throws DecodeFault; `value` is then in an unknown state.
template <class T>
void from_bytes(std::span<const std::byte> bytes, T& value) {
  FieldDecoder reader(bytes);
  reader.read(value);
  reader.finish();
}

}  // namespace pelagos
