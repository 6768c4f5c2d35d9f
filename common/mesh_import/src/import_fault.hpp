#pragma once

#include <stdexcept>
#include <string>

#include "text/refusal.hpp"

namespace pelagos {

/// Why a mesh file is refused, in words for its author. Ends the reading; import_mesh catches it.
class ImportFault : public std::runtime_error {
 public:
  explicit ImportFault(const std::string& what) : ImportFault(Refusal{"", what}) {}
  ImportFault(std::size_t line, const std::string& what) : ImportFault(Refusal{"line " + std::to_string(line), what}) {}

  [[nodiscard]] const Refusal& refusal() const { return refusal_; }

 private:
  explicit ImportFault(Refusal refusal) : std::runtime_error(to_string(refusal)), refusal_(std::move(refusal)) {}

  Refusal refusal_;
};

}  // namespace pelagos
