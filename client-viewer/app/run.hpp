#pragma once

#include <atomic>

#include "app/options.hpp"
#include "channels/rig.hpp"
#include "source/frame_source.hpp"

namespace pelagos {

/// Draws without a window, writes pictures and a report into options.out. Ends when the frames or seconds asked for are
/// done, or `stop` is set. Returns the exit code; throws GraphicsError, OutputError.
[[nodiscard]] int run_headless(const Options& options, const Channel& channel, FrameSource& source,
                               const std::atomic<bool>& stop);

/// Draws into a window with an overlay until it is closed or `stop` is set. Throws GraphicsError.
[[nodiscard]] int run_window(const Options& options, const Channel& channel, FrameSource& source,
                             const std::atomic<bool>& stop);

}  // namespace pelagos
