#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "values/command_surroundings.hpp"

namespace pelagos {

/// By what names later commands may speak of what earlier ones have set. To `follow` a source runs until it is stopped.
struct GivenNames {
  std::set<std::string> sources, booms, skimmers;
  std::set<std::uint32_t> probes;
  std::map<std::string, std::size_t> boom_points;  ///< of each of the booms

  void follow(const Command& command);
};

/// @return why the command speaks of something that is not there, with the nearest name that is; nothing if it does not
[[nodiscard]] std::optional<Refusal> find_unknown_name(const Command& command, const GivenNames& given);

/// @return why what the command sets would be one too many (values/oil_limits.hpp, kMostProbes); nothing if there is
/// room.
///         How many sources run at a time is not foreseen: the world tells.
[[nodiscard]] std::optional<Refusal> find_no_room(const Command& command, const GivenNames& given);

}  // namespace pelagos
