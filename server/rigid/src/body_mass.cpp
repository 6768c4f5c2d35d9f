#include "rigid/body_mass.hpp"

namespace pelagos {

BodyMass body_mass(const MassSettings& settings, const MassProperties& solid) {
  BodyMass body;
  body.mass = settings.mass > 0.0 ? settings.mass : settings.density * solid.volume;
  body.centre = settings.centre.value_or(solid.centre);
  if (settings.gyration)
    body.inertia = body.mass * settings.gyration->cwiseAbs2().asDiagonal().toDenseMatrix();
  else if (solid.volume > 0.0)
    body.inertia = body.mass / solid.volume * solid.inertia;
  return body;
}

}  // namespace pelagos
