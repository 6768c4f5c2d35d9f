#pragma once

#include <stdexcept>
#include <string>

namespace pelagos {

/// Why a mesh file is refused, in words for its author. Ends the reading; import_mesh catches it.
class ImportFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ImportFault(std::size_t line, const std::string& what) : ImportFault("line " + std::to_string(line) + ": " + what) {}
};

}  // namespace pelagos
