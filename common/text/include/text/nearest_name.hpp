#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pelagos {

/// The name among `known` that `name` is most likely a misspelling of; empty if none is near.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace pelagos
