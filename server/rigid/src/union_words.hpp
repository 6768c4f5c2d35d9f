#pragma once

#include <concepts>
#include <string>
#include <vector>

#include "rigid/mesh_union.hpp"

namespace pelagos {

/// Collects faults or notes of one kind: the first few in words, the rest as a number.
class FaultList {
 public:
  explicit FaultList(std::string kind) : kind_(std::move(kind)) {}
  void add(const std::string& text) {
    add([&] { return text; });
  }
  /// @param words  makes the text; called only if it is shown
  template <std::invocable Words>
  void add(const Words& words) {
    if (++count_ <= kShown) shown_.push_back({kind_, words()});
  }
  void append_to(Refusals& faults) const;
  void append_to(std::vector<std::string>& notes) const;
  [[nodiscard]] bool empty() const { return count_ == 0; }

 private:
  static constexpr std::size_t kShown = 3;

  std::string kind_;
  Refusals shown_;
  std::size_t count_ = 0;
};

// What is said of the parts of a mesh.
[[nodiscard]] std::string words_of_flat_part(const MeshOrigin& origin, const MeshPart& part);
/// @param partly  some of it lies in a part that it could be a cavity of
[[nodiscard]] std::string words_of_inward_part(const MeshOrigin& origin, const MeshPart& part, bool partly);
[[nodiscard]] Refusal words_of_turned_file(double volume);
[[nodiscard]] Refusal words_of_too_much_work(std::size_t parts);

/// Cavities, parts that add nothing, and overlap.
[[nodiscard]] std::vector<std::string> union_notes(const TriangleMesh& mesh, const MeshOrigin& origin,
                                                   const MeshUnion& united);

}  // namespace pelagos
