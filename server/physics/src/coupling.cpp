#include "physics/coupling.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "fluid_stages.hpp"
#include "physics/kernel.hpp"
#include "solid_planes.hpp"

namespace pelagos {

namespace {

/// Collects the contacts of one particle, body by body.
class ContactCollector {
 public:
  ContactCollector(const FluidState& state, bool corrected, std::vector<BodyContact>& out)
      : state_(state), kernel_(state.parameters.support_radius), corrected_(corrected), out_(out) {}

  void collect(std::size_t i) {
    const std::size_t before = out_.size();
    for_each_neighbor(state_.wall_list, i, [&](std::size_t b) {
      if (b < state_.static_walls) return;
      const BodySample& sample = state_.coupling.samples[b - state_.static_walls];
      if (sample.body >= 0) add(i, b, sample, before);
    });
  }
  /// Of the solids near particle i: their part of its gradient acts at the foot of the particle on their surface.
  void collect_solids(std::size_t i) {
    const std::size_t before = out_.size();
    const SolidPlanes& planes = state_.solid_planes;
    for (std::size_t slot = 0; slot < SolidPlanes::kSlots; ++slot) {
      const std::int32_t body = body_in_slot(state_, slot, i);
      if (body < 0) continue;
      const Float4 &wall = state_.gradients.solid_wall[slot][i], &plane = planes.plane[slot][i];
      const Eigen::Vector3f x = vector_of(planes.position[i]), normal = vector_of(plane), gradient = vector_of(wall);
      const Eigen::Vector3f foot = x - (normal.dot(x) - plane.w) * normal;
      BodyContact& contact = contact_with(i, static_cast<std::uint32_t>(body), before);
      contact.gradient += gradient;
      contact.moment +=
          (foot - state_.coupling.bodies[static_cast<std::size_t>(body)].centre.cast<float>()).cross(gradient);
    }
  }
  /// What particle i has met counts with its share.
  void fade(std::size_t i) {
    const Float4& x = state_.particles.position[i];
    const float share = state_.coupling.fade.share(x.x, x.y);
    if (share == 1.0F) return;
    while (!out_.empty() && out_.back().particle == i && share == 0.0F) out_.pop_back();
    for (auto contact = out_.rbegin(); contact != out_.rend() && contact->particle == i; ++contact) {
      contact->gradient *= share;
      contact->moment *= share;
    }
  }

 private:
  /// What moves an image moves its source by the reflected way.
  void add(std::size_t i, std::size_t b, const BodySample& sample, std::size_t before) {
    const Float4 &x = state_.particles.position[i], &s = state_.walls.position[b];
    const Eigen::Vector3f apart(x.x - s.x, x.y - s.y, x.z - s.z);
    const float distance = apart.norm();
    if (!(distance > 0.0F) || distance >= kernel_.support_radius) return;
    Eigen::Vector3f a = apart * (s.w * kernel_.derivative(distance) / distance);
    if (corrected_) a = correct(i, a);
    a = a.cwiseProduct(vector_of(sample.sign));
    const auto body = static_cast<std::uint32_t>(sample.body);
    const Eigen::Vector3f arm =
        vector_of(state_.moving_position[sample.source]) - state_.coupling.bodies[body].centre.cast<float>();
    BodyContact& contact = contact_with(i, body, before);
    contact.gradient += a;
    contact.moment += arm.cross(a);
  }

  /// B_i a
  [[nodiscard]] Eigen::Vector3f correct(std::size_t i, const Eigen::Vector3f& a) const {
    const Float4 &m = state_.corrections.first[i], &n = state_.corrections.second[i];
    return {m.x * a.x() + m.y * a.y() + m.z * a.z(), m.y * a.x() + m.w * a.y() + n.x * a.z(),
            m.z * a.x() + n.x * a.y() + n.y * a.z()};
  }

  BodyContact& contact_with(std::size_t i, std::uint32_t body, std::size_t before) {
    for (std::size_t k = before; k < out_.size(); ++k)
      if (out_[k].body == body) return out_[k];
    out_.emplace_back();
    out_.back().particle = static_cast<std::uint32_t>(i);
    out_.back().body = body;
    return out_.back();
  }

  const FluidState& state_;
  CubicSpline kernel_;
  bool corrected_;
  std::vector<BodyContact>& out_;
};

/// |J_i| of a contact's two parts, weighed by what the body answers: G along the axes that are free, H through I^-1.
struct RowLengths {
  double way = 0.0, turn = 0.0;
};
RowLengths row_lengths(const CoupledBody& body, const BodyContact& contact) {
  const Eigen::Vector3d g = contact.gradient.cast<double>(), h = contact.moment.cast<double>();
  return {std::sqrt(g.cwiseProduct(g).dot(body.inverse_mass)),
          std::sqrt(std::max(0.0, h.dot(body.inverse_inertia * h)))};
}

void find_contacts(TaskPool& pool, FluidState& state) {
  BodyCoupling& coupling = state.coupling;
  const std::size_t count = state.particles.count;
  std::vector<std::vector<BodyContact>> parts((count + kPointBlock - 1) / kPointBlock);
  pool.for_each_range(count, kPointBlock, [&](std::size_t begin, std::size_t end) {
    ContactCollector collector(state, state.gradients.corrected, parts[begin / kPointBlock]);
    for (std::size_t i = begin; i < end; ++i) {
      if (state.wall_list.pair_count[i] > 0) collector.collect(i);
      if (!state.solids.empty() && state.solid_planes.group[i / kLanes] != 0) collector.collect_solids(i);
      if (coupling.fade.acts()) collector.fade(i);
    }
  });
  for (const std::vector<BodyContact>& part : parts)
    coupling.contacts.insert(coupling.contacts.end(), part.begin(), part.end());
}

void soften_alpha(FluidState& state) {
  const BodyCoupling& coupling = state.coupling;
  std::vector<RowLengths> totals(coupling.bodies.size());
  for (const BodyContact& contact : coupling.contacts) {
    const RowLengths lengths = row_lengths(coupling.bodies[contact.body], contact);
    totals[contact.body].way += lengths.way;
    totals[contact.body].turn += lengths.turn;
  }
  const double mass = state.parameters.rest_density * state.parameters.volume();
  for (const BodyContact& contact : coupling.contacts) {
    const RowLengths lengths = row_lengths(coupling.bodies[contact.body], contact);
    const RowLengths& total = totals[contact.body];
    const double row = 0.5 * mass * (lengths.way * total.way + lengths.turn * total.turn);
    float& alpha = state.gradients.alpha[contact.particle];
    alpha /= static_cast<float>(1.0 + static_cast<double>(alpha) * row);
  }
}

/// Moves the bodies' samples beyond where they were placed, in the walls' order and in the bodies' own.
void move_samples(FluidState& state, std::span<const BodyMotion> motions) {
  const BodyCoupling& coupling = state.coupling;
  const auto way_of = [&](std::size_t k, const Float4& x) -> Eigen::Vector3f {
    const Eigen::Vector3d arm = Eigen::Vector3d(x.x, x.y, x.z) - coupling.bodies[k].centre;
    return (motions[k].way + motions[k].turn.cross(arm)).cast<float>();
  };
  const auto move = [](const Eigen::Vector3f& way, Float4& x) { x.x += way.x(), x.y += way.y(), x.z += way.z(); };
  for (std::size_t n = 0; n < coupling.samples.size(); ++n) {
    const BodySample& sample = coupling.samples[n];
    if (sample.body < 0) continue;
    const Eigen::Vector3f way = way_of(static_cast<std::size_t>(sample.body), state.moving_position[sample.source]);
    move(way.cwiseProduct(vector_of(sample.sign)), state.walls.position[state.static_walls + n]);
  }
  for (std::size_t k = 0; k < coupling.bodies.size(); ++k) {
    const CoupledBody& body = coupling.bodies[k];
    for (std::size_t n = 0; n < body.sample_count; ++n) {
      Float4& x = state.moving_position[body.first_sample + n];
      move(way_of(k, x), x);
    }
  }
}

}  // namespace

void meet_bodies(TaskPool& pool, FluidState& state) {
  state.coupling.contacts.clear();
  if (state.coupling.empty()) return;
  find_contacts(pool, state);
  soften_alpha(state);
}

void sum_pressure(const BodyCoupling& coupling, std::span<const float> pressure, std::vector<BodyMotion>& sums) {
  sums.assign(coupling.bodies.size(), {});
  for (const BodyContact& contact : coupling.contacts) {
    const float p = pressure[contact.particle];
    sums[contact.body].way += (p * contact.gradient).cast<double>();
    sums[contact.body].turn += (p * contact.moment).cast<double>();
  }
}

void answer_pressure(const BodyCoupling& coupling, std::span<const float> pressure, double particle_mass,
                     std::vector<BodyMotion>& motions) {
  sum_pressure(coupling, pressure, motions);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const CoupledBody& body = coupling.bodies[k];
    motions[k].way = particle_mass * body.inverse_mass.cwiseProduct(motions[k].way);
    motions[k].turn = particle_mass * (body.inverse_inertia * motions[k].turn);
  }
}

void add_body_rates(const BodyCoupling& coupling, std::span<const BodyMotion> motions, std::span<float> rate) {
  for (const BodyContact& contact : coupling.contacts) {
    const BodyMotion& motion = motions[contact.body];
    rate[contact.particle] -= static_cast<float>(motion.way.dot(contact.gradient.cast<double>()) +
                                                 motion.turn.dot(contact.moment.cast<double>()));
  }
}

void add_body_velocities(const BodyCoupling& coupling, std::span<float> rate) {
  if (coupling.contacts.empty()) return;
  std::vector<BodyMotion> motions;
  motions.reserve(coupling.bodies.size());
  for (const CoupledBody& body : coupling.bodies) motions.push_back({body.velocity, body.angular_velocity});
  add_body_rates(coupling, motions, rate);
}

void push_bodies(FluidState& state, double dt, const CorrectionTargets& targets) {
  BodyCoupling& coupling = state.coupling;
  if (coupling.contacts.empty()) return;
  const double mass = state.parameters.rest_density * state.parameters.volume();
  std::vector<BodyMotion> pushes;
  sum_pressure(coupling, state.work.pressure, pushes);
  for (std::size_t k = 0; k < pushes.size(); ++k) {
    CoupledBody& body = coupling.bodies[k];
    const Eigen::Vector3d push = mass * pushes[k].way, moment = mass * pushes[k].turn;  // kg m, kg m^2
    body.impulse += push / dt;
    body.angular_impulse += moment / dt;
    const Eigen::Vector3d way = body.inverse_mass.cwiseProduct(push), turn = body.inverse_inertia * moment;
    if (targets.span > 0.0) {
      body.velocity += way / targets.span;
      body.angular_velocity += turn / targets.span;
    }
    if (targets.positions) {
      body.displacement += way;
      body.turn += turn;
    }
    pushes[k] = {way, turn};
  }
  if (targets.positions) move_samples(state, pushes);
}

}  // namespace pelagos
