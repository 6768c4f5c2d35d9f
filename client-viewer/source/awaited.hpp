#pragma once

#include <cstdint>
#include <string>

#include "source/frame_source.hpp"

namespace pelagos {

/// What a viewer that has nothing to draw waits for, in words: a server, a scene, the first frame.
[[nodiscard]] std::string awaited(FrameSource& source, std::uint32_t domain);

}  // namespace pelagos
