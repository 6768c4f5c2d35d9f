#pragma once

#include "waves.pb.h"
#include "waves/wave_system.hpp"

namespace pelagos {

/// The system as read_sea reads it.
void write_wave_system(const WaveSystem& system, proto::v1::WaveSystem& out);
void write_wind_sea(const WindSeaSettings& sea, proto::v1::WindSea& out);

}  // namespace pelagos
