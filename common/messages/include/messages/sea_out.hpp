#pragma once

#include "waves.pb.h"
#include "waves/wave_system.hpp"

namespace pelagos {

/// The system as read_sea reads it.
void write_wave_system(const WaveSystem& system, proto::v1::WaveSystem& out);

}  // namespace pelagos
