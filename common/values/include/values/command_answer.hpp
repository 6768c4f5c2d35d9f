#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "values/misfit.hpp"

namespace pelagos {

/// What became of a command at the step boundary where it was due.
struct CommandAnswer {
  std::uint64_t step = 0;         ///< steps made before it took effect
  std::optional<Misfit> refusal;  ///< then nothing has changed
};

/// Takes the answer to a command, on the thread that advances the world; returns at once.
using TakeAnswer = std::function<void(const CommandAnswer&)>;

}  // namespace pelagos
