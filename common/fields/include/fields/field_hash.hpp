#pragma once

#include <memory>
#include <string_view>
#include <typeinfo>

#include "fields/field_bytes.hpp"

namespace pelagos {

/// XXH3 with 64 bits (Collet 2019), fed piece by piece. Equal bytes in equal pieces or others give the same value.
class ByteHash {
 public:
  ByteHash();
  ~ByteHash();
  ByteHash(const ByteHash&) = delete;
  ByteHash& operator=(const ByteHash&) = delete;
  void add(const void* data, std::size_t bytes);
  [[nodiscard]] std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Hashes fields: the hash of the bytes that FieldWriter writes.
class FieldHash : public FieldEncoder<ByteHash> {
 public:
  [[nodiscard]] std::uint64_t value() const { return target().value(); }
};

template <class T>
[[nodiscard]] std::uint64_t hash_fields(const T& value) {
  FieldHash hash;
  walk_fields(value, hash);
  return hash.value();
}

/// Names and types of the fields of a type, whatever a value holds: `name:type` in their order. Two builds whose texts
/// are equal read each other's bytes.
class FieldLayout {
 public:
  template <class T>
  void operator()(const char* name, const T& value) {
    text_ += name;
    text_ += ':';
    add(value);
    text_ += ';';
  }
  template <class T>
  void add(const T& value) {
    using namespace fields_detail;
    if constexpr (std::is_same_v<T, bool>) {
      text_ += "flag";
    } else if constexpr (std::is_enum_v<T>) {
      text_ += "enum" + std::to_string(sizeof(T));
    } else if constexpr (IsScalars<T>) {
      using Scalar = typename ScalarLayout<T>::Scalar;
      text_ += std::is_floating_point_v<Scalar> ? 'f' : std::is_signed_v<Scalar> ? 'i' : 'u';
      text_ += std::to_string(sizeof(Scalar)) + 'x' + std::to_string(ScalarLayout<T>::count);
    } else if constexpr (std::is_same_v<T, std::string>) {
      text_ += "text";
    } else if constexpr (IsA<T, PaddedRows>) {
      element<std::remove_cvref_t<decltype(value.padding)>>("rows");
    } else if constexpr (IsA<T, std::optional>) {
      element<typename T::value_type>("optional");
    } else if constexpr (IsA<T, std::variant>) {
      variant(value);
    } else if constexpr (IsA<T, std::pair>) {
      element<typename T::first_type>("pair");
      element<typename T::second_type>("");
    } else if constexpr (IsA<T, std::map>) {
      element<typename T::key_type>("map");
      element<typename T::mapped_type>("");
    } else if constexpr (IsA<T, std::set>) {
      element<typename T::key_type>("set");
    } else if constexpr (IsA<T, std::vector>) {
      element<typename T::value_type>("vector");
    } else if constexpr (IsArray<T>::value) {
      element<typename T::value_type>("array" + std::to_string(value.size()));
    } else {
      text_ += '{';
      T::visit_fields(value, *this);
      text_ += '}';
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <class T>
  void element(const std::string& kind) {
    text_ += kind + '(';
    const T prototype{};
    add(prototype);
    text_ += ')';
  }
  template <class... Types>
  void variant(const std::variant<Types...>&) {
    text_ += "variant";
    (element<Types>(""), ...);
  }

  std::string text_;
};

template <class T>
[[nodiscard]] std::uint64_t layout_hash() {
  FieldLayout layout;
  const T prototype{};
  layout.add(prototype);
  ByteHash hash;
  hash.add(layout.text().data(), layout.text().size());
  return hash.value();
}

}  // namespace pelagos
