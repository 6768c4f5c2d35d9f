#pragma once

#include <span>
#include <string>
#include <vector>

#include "gltf_document.hpp"

namespace pelagos {

/// The elements of a glTF accessor (specification 2.0, section 5.1), those of its sparse part in place of the others.
/// Everything is checked against the bytes that are there when it is made.
class GltfAccessor {
 public:
  /// @param type  that it must have: "SCALAR" or "VEC3"
  /// @throws ImportFault naming the accessor and what is wrong
  GltfAccessor(GltfDocument& document, std::size_t index, const std::string& type);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double number(std::size_t element, std::size_t component) const;
  [[nodiscard]] std::uint32_t whole(std::size_t element) const;
  [[nodiscard]] bool is_whole() const { return component_ != kFloat && !normalized_; }

 private:
  enum Component : std::size_t { kByte = 5120, kUByte, kShort, kUShort, kUInt = 5125, kFloat };
  struct View {
    std::span<const char> bytes;
    std::size_t stride = 0;
    std::size_t component = kFloat;
  };

  /// `count` elements of `size` bytes that an object (accessor or sparse part) describes.
  static View view_of(GltfDocument& document, const nlohmann::json& object, const std::string& where, std::size_t count,
                      std::size_t components, std::size_t component);
  static std::size_t size_of(std::size_t component, const std::string& where);
  static double number_at(const View& view, std::size_t element, std::size_t part, bool normalized);

  void read_sparse(GltfDocument& document, const nlohmann::json& sparse, const std::string& where);
  /// The view that holds an element, and its number there; a view without bytes means zeros.
  [[nodiscard]] std::pair<const View*, std::size_t> place(std::size_t element) const;

  std::size_t count_ = 0, components_ = 1, component_ = kFloat;
  bool normalized_ = false;
  View base_, replaced_;
  std::vector<std::uint32_t> replaced_elements_;  ///< rising
};

}  // namespace pelagos
