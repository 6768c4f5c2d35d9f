#pragma once

#include <string>
#include <vector>

#include "messages/field_reader.hpp"

namespace pelagos {

/// Faults as lines for people, in the order of the text, none twice: "file:line:column: field: what".
[[nodiscard]] std::vector<std::string> describe_faults(TextRefusals faults, const std::string& source_name);

}  // namespace pelagos
