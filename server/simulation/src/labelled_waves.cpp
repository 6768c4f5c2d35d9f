#include "labelled_waves.hpp"

namespace pelagos {

void LabelBatch::displace(const WaveMoment& moment) {
  evaluate_displacement(moment, {x.data(), count}, {y.data(), count}, {z.data(), count}, {a.data(), count},
                        {b.data(), count}, {c.data(), count});
}

void LabelBatch::move(const WaveMoment& moment) {
  WaveMotionArrays out;
  out.velocity_x = {a.data(), count};
  out.velocity_y = {b.data(), count};
  out.velocity_z = {c.data(), count};
  evaluate_motion(moment, {x.data(), count}, {y.data(), count}, {z.data(), count}, Stretching::kNone, out);
}

}  // namespace pelagos
