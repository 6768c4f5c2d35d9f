#include "wire/convert.hpp"

#include <cmath>
#include <span>

#include "pelagos_dds/frames.hpp"
#include "text/printable.hpp"

namespace pelagos::wire {
namespace {

/// Position, orientation, velocity in world axes and the angular rate in body axes, as the wire has them.
struct Motion {
  Eigen::Vector3d position;
  Eigen::Quaterniond orientation;
  Eigen::Vector3d velocity;
  Eigen::Vector3d rate_body;
};

/// The other frame's numbers for the same motion.
Motion swap_frame(const Motion& motion) {
  return {swap_enu_ned(motion.position), swap_enu_ned(motion.orientation), swap_enu_ned(motion.velocity),
          swap_port_starboard(motion.rate_body)};
}

template <class Wire>
Motion read_motion(const Wire& wire) {
  const Motion motion{from_wire(wire.position),
                      {wire.orientation.w, wire.orientation.x, wire.orientation.y, wire.orientation.z},
                      from_wire(wire.velocity),
                      from_wire(wire.angular_rate_body)};
  return wire.frame == pelagos_FRAME_NED ? swap_frame(motion) : motion;
}

template <class Wire, class Value>
void write_motion(const Value& value, pelagos_WorldFrame frame, Wire& wire) {
  Motion motion{value.position, value.orientation, value.velocity,
                value.orientation.conjugate() * value.angular_velocity};
  if (frame == pelagos_FRAME_NED) motion = swap_frame(motion);
  wire.frame = frame;
  wire.position = to_wire(motion.position);
  const Eigen::Quaterniond& q = motion.orientation;
  wire.orientation = {q.x(), q.y(), q.z(), q.w()};
  wire.velocity = to_wire(motion.velocity);
  wire.angular_rate_body = to_wire(motion.rate_body);
}

template <class Value, class Wire>
void assign_motion(const Wire& wire, Value& value) {
  const Motion motion = read_motion(wire);
  value.position = motion.position;
  value.orientation = motion.orientation;
  value.velocity = motion.velocity;
  // A sender's quaternion may be off by a rounding error; turning a vector wants it exact.
  value.angular_velocity = motion.orientation.normalized() * motion.rate_body;
}

// The generated types are C: strings and buffers are not const there, but a writer only reads them.
char* c_string(const std::string& text) { return const_cast<char*>(text.c_str()); }
std::string to_string(const char* text) { return text != nullptr ? std::string(text) : std::string(); }
/// Text for people: whoever shows it need not ask what a stranger has put into it.
std::string to_words(const char* text) { return text != nullptr ? printable(text) : std::string(); }

template <class Sequence, class Item>
void lend(std::vector<Item>& items, Sequence& sequence) {
  sequence._maximum = sequence._length = static_cast<std::uint32_t>(items.size());
  sequence._buffer = items.data();
  sequence._release = false;
}

std::vector<pelagos_BodyStateV1> bodies_to_wire(const std::vector<BodyState>& bodies, pelagos_WorldFrame frame) {
  std::vector<pelagos_BodyStateV1> result;
  result.reserve(bodies.size());
  for (const BodyState& body : bodies) result.push_back(to_wire(body, frame));
  return result;
}

}  // namespace

pelagos_BodyStateV1 to_wire(const BodyState& state, pelagos_WorldFrame frame) {
  pelagos_BodyStateV1 wire{};
  wire.body = state.body;
  write_motion(state, frame, wire);
  wire.health = static_cast<pelagos_PoseHealth>(state.health);
  wire.pose_age = state.pose_age;
  return wire;
}

BodyState from_wire(const pelagos_BodyStateV1& wire) {
  BodyState state;
  state.body = wire.body;
  assign_motion(wire, state);
  state.health = static_cast<PoseHealth>(wire.health);
  state.pose_age = wire.pose_age;
  return state;
}

pelagos_PoseV1 to_wire(const BodyPose& pose, std::uint32_t sender, pelagos_WorldFrame frame) {
  pelagos_PoseV1 wire{};
  wire.body = pose.body;
  wire.sender = sender;
  wire.time = pose.time;
  write_motion(pose, frame, wire);
  return wire;
}

BodyPose from_wire(const pelagos_PoseV1& wire) {
  BodyPose pose;
  pose.body = wire.body;
  pose.time = wire.time;
  assign_motion(wire, pose);
  return pose;
}

GeodeticPose from_wire(const pelagos_GeodeticPoseV1& wire) {
  GeodeticPose pose;
  pose.body = wire.body;
  pose.time = wire.time;
  pose.latitude_deg = wire.latitude_deg;
  pose.longitude_deg = wire.longitude_deg;
  pose.height = wire.height;
  const pelagos_Quaternion& q = wire.orientation;
  pose.orientation = swap_enu_ned(Eigen::Quaterniond(q.w, q.x, q.y, q.z));
  pose.velocity = swap_enu_ned(from_wire(wire.velocity));
  pose.angular_velocity = pose.orientation.normalized() * swap_port_starboard(from_wire(wire.angular_rate_body));
  return pose;
}

pelagos_WindSettingsV1 to_wire(const std::optional<WindSettings>& wind) {
  pelagos_WindSettingsV1 wire{};
  if (!wind) return wire;
  wire.velocity_to = to_wire(wind->velocity);
  wire.wind_speed = wind->velocity.head<2>().norm();
  wire.wind_from_deg = wind_from_deg(wind->velocity);
  wire.amplitude = wind->amplitude;
  wire.length = wind->length;
  wire.beta = wind->beta;
  // The topic's pulse is in seconds, the paper's in steps.
  wire.has_pulse = wind->pulse.has_value() && wind->law != WindLaw::kPaper;
  if (wire.has_pulse) {
    wire.pulse_period = wind->pulse->period;
    wire.pulse_width = wind->pulse->width;
  }
  return wire;
}

WindSettings from_wire(const pelagos_WindSettingsV1& wire) {
  WindSettings wind;
  wind.velocity = from_wire(wire.velocity_to);
  wind.amplitude = wire.amplitude;
  wind.length = wire.length;
  wind.beta = wire.beta;
  if (wire.has_pulse) wind.pulse = WindPulse{wire.pulse_period, wire.pulse_width};
  return wind;
}

pelagos_EventV1 to_wire(const Event& event, std::uint64_t source) {
  pelagos_EventV1 wire{};
  wire.source = source;
  wire.sequence_number = event.sequence;
  wire.step = event.step;
  wire.simulation_time = event.simulation_time;
  wire.kind = c_string(event.kind);
  wire.caused_by = c_string(event.source);
  wire.text = c_string(event.text);
  return wire;
}

Event from_wire(const pelagos_EventV1& wire) {
  Event event;
  event.sequence = wire.sequence_number;
  event.step = wire.step;
  event.simulation_time = wire.simulation_time;
  event.kind = to_words(wire.kind);
  event.source = to_words(wire.caused_by);
  event.text = to_words(wire.text);
  return event;
}

namespace {

std::vector<pelagos_WaveComponentV1> waves_to_wire(std::span<const WaveComponent> waves) {
  std::vector<pelagos_WaveComponentV1> wire;
  wire.reserve(waves.size());
  for (const WaveComponent& wave : waves)
    wire.push_back({wave.amplitude, wave.wavenumber, wave.omega, wave.direction, wave.phase});
  return wire;
}

template <class Sequence>
std::vector<WaveComponent> waves_from_wire(const Sequence& wire) {
  std::vector<WaveComponent> waves;
  waves.reserve(wire._length);
  for (std::uint32_t i = 0; i < wire._length; ++i) {
    const pelagos_WaveComponentV1& wave = wire._buffer[i];
    waves.push_back({wave.amplitude, wave.wavenumber, wave.omega, wave.direction, wave.phase});
  }
  return waves;
}

}  // namespace

SeaSample::SeaSample(const WaveField& sea, std::uint64_t source) {
  waves_.reserve(sea.layers().size());  // lent below: they must not move
  for (const WaveLayer& layer : sea.layers()) {
    waves_.push_back(waves_to_wire(layer.components));
    layers_.push_back({layer.start, layer.seconds, {}});
    lend(waves_.back(), layers_.back().waves);
  }
  sample_.source = source;
  sample_.water_level = sea.level();
  sample_.depth = std::isfinite(sea.depth()) ? sea.depth() : 0.0;
  lend(layers_, sample_.layers);
}

WaveField from_wire(const pelagos_SeaV1& wire) {
  std::vector<WaveLayer> layers;
  for (std::uint32_t i = 0; i < wire.layers._length; ++i) {
    const pelagos_SeaLayerV1& layer = wire.layers._buffer[i];
    layers.push_back({waves_from_wire(layer.waves), layer.start, layer.seconds});
  }
  return WaveField::of_layers(std::move(layers), wire.water_level, wire.depth > 0.0 ? wire.depth : kInfiniteDepth);
}

SceneInfoSample::SceneInfoSample(const SceneInfo& info, std::uint64_t source)
    : waves_(waves_to_wire(info.sea.components())) {
  for (const BodyInfo& body : info.bodies) {
    bodies_.push_back({body.id, c_string(body.name), c_string(body.mesh_file), body.mesh_scale});
  }
  sample_.source = source;
  sample_.scene = c_string(info.scene);
  sample_.build = c_string(info.build);
  sample_.seed = info.seed;
  sample_.frame_interval = info.frame_interval;
  sample_.particle_spacing = info.particle_spacing;
  sample_.water_level = info.water_level;
  sample_.tank_min = to_wire(info.patch.min);
  sample_.tank_max = to_wire(info.patch.max);
  sample_.tank_walls_visible = info.tank_walls_visible;
  sample_.origin_latitude_deg = info.origin.latitude_deg;
  sample_.origin_longitude_deg = info.origin.longitude_deg;
  sample_.origin_height = info.origin.height;
  lend(waves_, sample_.far_sea);
  lend(bodies_, sample_.bodies);
}

SceneInfo from_wire(const pelagos_SceneInfoV1& wire) {
  SceneInfo info;
  info.scene = to_words(wire.scene);
  info.build = to_words(wire.build);
  info.seed = wire.seed;
  info.frame_interval = wire.frame_interval;
  info.particle_spacing = wire.particle_spacing;
  info.water_level = wire.water_level;
  info.patch = {from_wire(wire.tank_min), from_wire(wire.tank_max)};
  info.tank_walls_visible = wire.tank_walls_visible;
  info.origin = {wire.origin_latitude_deg, wire.origin_longitude_deg, wire.origin_height};
  info.sea = WaveField(waves_from_wire(wire.far_sea), wire.water_level);
  for (std::uint32_t i = 0; i < wire.bodies._length; ++i) {
    const pelagos_BodyInfoV1& body = wire.bodies._buffer[i];
    info.bodies.push_back({body.id, to_words(body.name), to_string(body.mesh_file), body.mesh_scale});
  }
  return info;
}

StatusSample::StatusSample(const ServerStatus& status, std::uint64_t source, pelagos_WorldFrame bodies_frame)
    : bodies_(bodies_to_wire(status.bodies, bodies_frame)) {
  sample_.source = source;
  sample_.scene = c_string(status.scene);
  sample_.step = status.step;
  sample_.frame = status.frame;
  sample_.simulation_time = status.simulation_time;
  sample_.paused = status.paused;
  sample_.real_time_factor = status.real_time_factor;
  sample_.achievable_real_time_factor = status.achievable_real_time_factor;
  sample_.step_ms = status.step_ms;
  sample_.time_step = status.time_step;
  sample_.particles = status.particles;
  sample_.boundary_particles = status.boundary_particles;
  sample_.published_particles = status.published_particles;
  sample_.density_error = status.density_error;
  sample_.largest_density = status.largest_density;
  sample_.density_iterations = status.density_iterations;
  sample_.divergence_iterations = status.divergence_iterations;
  sample_.kinetic_energy = status.kinetic_energy;
  sample_.largest_speed = status.largest_speed;
  sample_.frames_published = status.frames_published;
  sample_.frames_dropped = status.frames_dropped;
  sample_.poses_accepted = status.poses_accepted;
  sample_.poses_refused = status.poses_refused;
  sample_.has_wind = status.wind.has_value();
  sample_.wind = to_wire(status.wind);
  lend(bodies_, sample_.bodies);
  sample_.unconverged_steps = status.unconverged_steps;
  sample_.recoveries = status.recoveries;
  sample_.governed = status.governed;
  sample_.max_step = status.effort.max_step;
  sample_.density_tolerance = status.effort.density_tolerance;
  sample_.divergence_tolerance = status.effort.divergence_tolerance;
  sample_.over_budget = status.over_budget;
}

ServerStatus from_wire(const pelagos_StatusV2& wire) {
  ServerStatus status;
  status.scene = to_words(wire.scene);
  status.step = wire.step;
  status.frame = wire.frame;
  status.simulation_time = wire.simulation_time;
  status.paused = wire.paused;
  status.real_time_factor = wire.real_time_factor;
  status.achievable_real_time_factor = wire.achievable_real_time_factor;
  status.step_ms = wire.step_ms;
  status.time_step = wire.time_step;
  status.particles = wire.particles;
  status.boundary_particles = wire.boundary_particles;
  status.published_particles = wire.published_particles;
  status.density_error = wire.density_error;
  status.largest_density = wire.largest_density;
  status.density_iterations = wire.density_iterations;
  status.divergence_iterations = wire.divergence_iterations;
  status.kinetic_energy = wire.kinetic_energy;
  status.largest_speed = wire.largest_speed;
  status.frames_published = wire.frames_published;
  status.frames_dropped = wire.frames_dropped;
  status.poses_accepted = wire.poses_accepted;
  status.poses_refused = wire.poses_refused;
  status.unconverged_steps = wire.unconverged_steps;
  status.recoveries = wire.recoveries;
  status.governed = wire.governed;
  status.effort = {wire.max_step, wire.density_tolerance, wire.divergence_tolerance};
  status.over_budget = wire.over_budget;
  if (wire.has_wind) status.wind = from_wire(wire.wind);
  for (std::uint32_t i = 0; i < wire.bodies._length; ++i) status.bodies.push_back(from_wire(wire.bodies._buffer[i]));
  return status;
}

std::uint32_t OceanFrameSample::fill(const Snapshot& snapshot, double particle_spacing, std::uint64_t source,
                                     pelagos_WorldFrame bodies_frame) {
  const PackReport report = pack_particles(snapshot.particles, static_cast<float>(particle_spacing), payload_);
  bodies_ = bodies_to_wire(snapshot.bodies, bodies_frame);
  const Eigen::Vector3f& low = report.scales.box_min;
  const Eigen::Vector3f& size = report.scales.box_size;
  sample_.source = source;
  sample_.frame = snapshot.frame;
  sample_.simulation_time = snapshot.simulation_time;
  sample_.wall_time_ns = snapshot.wall_time_ns;
  sample_.origin = to_wire(snapshot.origin);
  sample_.box_min = {low.x(), low.y(), low.z()};
  sample_.box_size = {size.x(), size.y(), size.z()};
  sample_.largest_speed = report.scales.largest_speed;
  sample_.particle_spacing = report.scales.particle_spacing;
  sample_.total_particles = snapshot.total_particles;
  sample_.count = report.packed;
  sample_.record_bytes = kRecordBytes;
  lend(bodies_, sample_.bodies);
  lend(payload_, sample_.payload);
  return report.refused;
}

PackingScales scales_of(const pelagos_OceanFrameV1& frame) {
  PackingScales scales;
  scales.box_min = {frame.box_min.x, frame.box_min.y, frame.box_min.z};
  scales.box_size = {frame.box_size.x, frame.box_size.y, frame.box_size.z};
  scales.largest_speed = frame.largest_speed;
  scales.particle_spacing = frame.particle_spacing;
  return scales;
}

}  // namespace pelagos::wire
