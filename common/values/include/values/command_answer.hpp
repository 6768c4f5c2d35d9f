#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "text/refusal.hpp"

namespace pelagos {

/// What became of a command at the step boundary where it was due, or that it waits for the start of the simulation.
struct CommandAnswer {
  std::uint64_t step = 0;          ///< steps made before it took effect
  std::optional<Refusal> refusal;  ///< then nothing has changed
  std::uint64_t scheduled_id = 0;  ///< > 0: it waits under this id for the first boundary
};

/// Takes the answer to a command, on the thread that advances the world or the one that gave it; returns at once.
using TakeAnswer = std::function<void(const CommandAnswer&)>;

}  // namespace pelagos
