#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pelagos {

// A type declares its fields once, and saving, loading, hashing and comparing follow from that:
//
//   struct Buoy {
//     double mass = 0.0;
//     std::vector<Line> lines;
//     template <class Self, class Visitor>
//     static void visit_fields(Self& self, Visitor& visit) {
//       visit("mass", self.mass);
//       visit("lines", self.lines);
//     }
//   };
//
// `Self` is the type or its const. A field is a number, a flag, an enumeration, a text, a fixed-size matrix, a
// quaternion, another type with fields, or an array, vector, map, set, optional or variant of these. Types with fields
// can be made without arguments.

/// How a type lies in memory as `count` scalars of one type. Specialise it for a record of equal scalars.
template <class T>
struct ScalarLayout {
  static constexpr std::size_t count = 0;  ///< no such layout
};
template <class T>
requires((std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)) struct ScalarLayout<T> {
  using Scalar = T;
  static constexpr std::size_t count = 1;
};
template <class S, int Rows, int Columns, int Options>
requires(Rows > 0 && Columns > 0) struct ScalarLayout<Eigen::Matrix<S, Rows, Columns, Options>> {
  using Scalar = S;
  static constexpr std::size_t count = static_cast<std::size_t>(Rows) * static_cast<std::size_t>(Columns);
};
template <class S, int Options>
struct ScalarLayout<Eigen::Quaternion<S, Options>> {
  using Scalar = S;
  static constexpr std::size_t count = 4;
};

template <class T>
concept IsScalars = ScalarLayout<T>::count >
0;

template <class T>
[[nodiscard]] auto scalars_of(T& value) {
  using Scalar = typename ScalarLayout<std::remove_const_t<T>>::Scalar;
  using Element = std::conditional_t<std::is_const_v<T>, const Scalar, Scalar>;
  static_assert(sizeof(T) == sizeof(Scalar) * ScalarLayout<std::remove_const_t<T>>::count);
  return std::span<Element>(reinterpret_cast<Element*>(&value), ScalarLayout<std::remove_const_t<T>>::count);
}

/// The first `count` entries of a vector whose others are padding that can be made again: `padded` entries in all.
/// `count` has been visited before.
template <class Vector>
struct PaddedRows {
  Vector& values;
  std::size_t count = 0, padded = 0;
  typename std::remove_const_t<Vector>::value_type padding{};
};
template <class Vector>
PaddedRows(Vector&, std::size_t, std::size_t, typename Vector::value_type) -> PaddedRows<Vector>;

namespace fields_detail {

template <class T, template <class...> class Template>
struct Is : std::false_type {};
template <template <class...> class Template, class... Arguments>
struct Is<Template<Arguments...>, Template> : std::true_type {};
template <class T, template <class...> class Template>
concept IsA = Is<T, Template>::value;

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

}  // namespace fields_detail

/// Goes through the fields of a value, in their order, and tells a sink:
///   enter(name) / enter(index), leave()   where the walk is
///   scalars(span, each)                    numbers, in the order of memory, `each` of them in an element (default: 1)
///   size(n)                                how many elements follow; 0 or 1 of an optional, the type of a variant
///   text(string)
template <class Sink>
class FieldWalk {
 public:
  explicit FieldWalk(Sink& sink) : sink_(sink) {}

  template <class T>
  void operator()(const char* name, const T& value) {
    sink_.enter(name);
    walk(value);
    sink_.leave();
  }

  template <class T>
  void walk(const T& value) {
    using namespace fields_detail;
    if constexpr (std::is_same_v<T, bool>) {
      const std::uint8_t flag = value ? 1 : 0;
      sink_.scalars(std::span(&flag, 1));
    } else if constexpr (std::is_enum_v<T>) {
      const auto number = static_cast<std::underlying_type_t<T>>(value);
      sink_.scalars(std::span(&number, 1));
    } else if constexpr (IsScalars<T>) {
      sink_.scalars(scalars_of(value), ScalarLayout<T>::count);
    } else if constexpr (std::is_same_v<T, std::string>) {
      sink_.text(value);
    } else if constexpr (IsA<T, PaddedRows>) {
      rows(std::span(value.values).first(value.count));
    } else if constexpr (IsA<T, std::optional>) {
      sink_.size(value ? 1 : 0);
      if (value) walk(*value);
    } else if constexpr (IsA<T, std::variant>) {
      sink_.size(value.index());
      std::visit([this](const auto& held) { walk(held); }, value);
    } else if constexpr (IsA<T, std::pair>) {
      walk(value.first);
      walk(value.second);
    } else if constexpr (IsA<T, std::map> || IsA<T, std::set>) {
      sink_.size(value.size());
      elements(value);
    } else if constexpr (IsA<T, std::vector>) {
      sink_.size(value.size());
      rows(std::span(value));
    } else if constexpr (IsArray<T>::value) {
      rows(std::span(value));
    } else {
      T::visit_fields(value, *this);
    }
  }

 private:
  template <class T>
  void rows(std::span<const T> values) {
    if constexpr (IsScalars<T>) {
      if (values.empty()) return;
      const auto first = scalars_of(values.front());
      sink_.scalars(std::span(first.data(), first.size() * values.size()), first.size());
    } else {
      elements(values);
    }
  }
  template <class T, std::size_t N>
  void rows(std::span<const T, N> values) {
    rows(std::span<const T>(values));
  }
  template <class Range>
  void elements(const Range& values) {
    std::size_t index = 0;
    for (const auto& value : values) {
      sink_.enter(index++);
      walk(value);
      sink_.leave();
    }
  }

  Sink& sink_;
};

template <class Sink, class T>
void walk_fields(const T& value, Sink& sink) {
  FieldWalk<Sink>(sink).walk(value);
}

}  // namespace pelagos
