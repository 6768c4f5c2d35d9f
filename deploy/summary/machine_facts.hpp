#pragma once

#include <nlohmann/json_fwd.hpp>

namespace pelagos {

/// What this machine is: processor, cores that this process may use, memory, system.
[[nodiscard]] nlohmann::ordered_json machine_facts();

}  // namespace pelagos
