#include "wind/wind.hpp"

namespace pelagos {

namespace {

bool is_still(const Air::Moment& moment) {
  return moment.pulse == 0.0 || (moment.wind.velocity.isZero() && moment.wind.amplitude == 0.0);
}

}  // namespace

bool Wind::asks_surface(double time) const {
  const Air::Moment moment = air_.at(time);
  return !is_still(moment) && moment.wind.law != WindLaw::kPaper;
}

void Wind::act(TaskPool& pool, const SurfaceGrid* surface, std::span<const Float4> position, std::size_t count,
               double time, std::span<Float4> acceleration, std::span<Float4> velocity) {
  const Air::Moment moment = air_.at(time);
  if (!is_still(moment) && moment.wind.law == WindLaw::kPaper)
    push_as_printed(pool, position.first(count), moment, velocity);
  else if (!is_still(moment))
    push_surface(pool, *surface, position.first(count), moment, acceleration);
  air_.count_step();
}

}  // namespace pelagos
