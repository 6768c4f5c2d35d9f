#include "wind/wind.hpp"

namespace pelagos {

void Wind::act(TaskPool& pool, std::span<const Float4> position, std::size_t count, double time,
               std::span<Float4> acceleration, std::span<Float4> velocity) {
  const Air::Moment moment = air_.at(time);
  const bool still = moment.pulse == 0.0 || (moment.wind.velocity.isZero() && moment.wind.amplitude == 0.0);
  if (!still && moment.wind.law == WindLaw::kPaper)
    push_as_printed(pool, position.first(count), moment, velocity);
  else if (!still)
    push_surface(pool, position.first(count), moment, acceleration);
  air_.count_step();
}

}  // namespace pelagos
