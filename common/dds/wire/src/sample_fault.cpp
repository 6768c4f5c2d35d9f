#include "wire/sample_fault.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>

#include "wire/convert.hpp"

namespace pelagos::wire {
namespace {

constexpr double kFarthest = 1e7;     // m
constexpr double kFastest = 1e4;      // m/s, and rad/s
constexpr double kLongestTime = 1e9;  // s: thirty years

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// Where in a sample a struct stands: "bodies[3]."; nothing is made of it unless there is a fault.
struct Place {
  const char* list = nullptr;
  std::size_t index = 0;
  [[nodiscard]] std::string text() const {
    return list == nullptr ? "" : std::string(list) + "[" + std::to_string(index) + "].";
  }
};

/// Looks at one field after the other and keeps the first fault.
class Checks {
 public:
  void at(const char* list, std::size_t index) { place_ = {list, index}; }
  void at_top() { place_ = {}; }

  void within(const char* field, double value, double low, double high) {
    if (fault_ || (value >= low && value <= high)) return;  // false for NaN
    refuse(field, "is " + number(value) + "; allowed: " + number(low) + " to " + number(high));
  }
  void above_zero(const char* field, double value, double high) {
    if (fault_ || (value > 0.0 && value <= high)) return;
    refuse(field, "is " + number(value) + "; allowed: above 0 and at most " + number(high));
  }
  template <class Vector>
  void vector(const char* field, const Vector& v, double limit) {
    for (const double part : {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)})
      within(field, part, -limit, limit);
  }
  /// ns of a clock: a difference of two such numbers fits into 64 bits.
  void stamp(const char* field, std::int64_t value) {
    constexpr std::int64_t kMost = 4'000'000'000'000'000'000;
    if (!fault_ && (value > kMost || value < -kMost))
      refuse(field, "is " + std::to_string(value) + "; allowed: -4e18 to 4e18");
  }
  void name(const char* field, const char* text, std::size_t most) {
    if (fault_ || text == nullptr) return;
    if (strnlen(text, most + 1) <= most) return;
    refuse(field, "has " + std::to_string(std::strlen(text)) + " bytes; allowed: at most " + std::to_string(most));
  }
  void count(const char* field, std::uint64_t items, std::uint64_t most) {
    if (!fault_ && items > most)
      refuse(field, "has " + std::to_string(items) + " items; allowed: at most " + std::to_string(most));
  }
  void that(bool good, const char* field, const char* what) {
    if (!fault_ && !good) refuse(field, what);
  }

  [[nodiscard]] bool failed() const { return fault_.has_value(); }
  [[nodiscard]] std::optional<Refusal> result() && { return std::move(fault_); }

 private:
  void refuse(const char* field, const std::string& what) { fault_.emplace(Refusal{place_.text() + field, what}); }

  Place place_;
  std::optional<Refusal> fault_;
};

void check_body(Checks& checks, const pelagos_BodyStateV1& body) {
  const pelagos_Quaternion& q = body.orientation;
  const double squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  checks.that(body.frame == pelagos_FRAME_ENU || body.frame == pelagos_FRAME_NED, "frame",
              "is neither FRAME_ENU nor FRAME_NED");
  checks.vector("position", body.position, kFarthest);
  checks.that(squared > 0.98 && squared < 1.02, "orientation", "is not of length 1 within 1 %");
  checks.vector("velocity", body.velocity, kFastest);
  checks.vector("angular_rate_body", body.angular_rate_body, kFastest);
  checks.that(body.health <= pelagos_POSE_HOLDING, "health", "is none of the four values of PoseHealth");
  checks.within("pose_age", body.pose_age, -kLongestTime, kLongestTime);
}

/// States of bodies, each body once.
template <class Sequence>
void check_bodies(Checks& checks, const Sequence& bodies) {
  checks.count("bodies", bodies._length, kMostBodies);
  std::set<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < bodies._length && !checks.failed(); ++i) {
    checks.at("bodies", i);
    check_body(checks, bodies._buffer[i]);
    checks.that(ids.insert(bodies._buffer[i].body).second, "body", "is the id of an earlier body too");
  }
  checks.at_top();
}

void check_wave(Checks& checks, const pelagos_WaveComponentV1& wave) {
  checks.within("amplitude", static_cast<double>(wave.amplitude), -1e3, 1e3);
  checks.within("wavenumber", static_cast<double>(wave.wavenumber), 0.0, 1e4);
  checks.within("omega", static_cast<double>(wave.omega), -1e4, 1e4);
  checks.within("direction", static_cast<double>(wave.direction), -1e3, 1e3);
  checks.within("phase", static_cast<double>(wave.phase), -1e6, 1e6);
}

void check_shape(Checks& checks, const pelagos_BodyInfoV1& body) {
  checks.name("name", body.name, kLongestName);
  checks.name("mesh_file", body.mesh_file, kLongestMeshFile);
  checks.above_zero("mesh_scale", body.mesh_scale, 1e6);
}

void check_tank(Checks& checks, const pelagos_SceneInfoV1& info) {
  checks.vector("tank_min", info.tank_min, kFarthest);
  checks.vector("tank_max", info.tank_max, kFarthest);
  checks.that(
      info.tank_min.x < info.tank_max.x && info.tank_min.y < info.tank_max.y && info.tank_min.z < info.tank_max.z,
      "tank_max", "is not above tank_min");
}

}  // namespace

std::optional<Refusal> find_fault(const pelagos_OceanFrameV1& frame) {
  Checks checks;
  checks.that(frame.record_bytes == kRecordBytes, "record_bytes", "is not 20");
  checks.count("payload", frame.count, kMostParticles);
  checks.that(frame.payload._length == std::uint64_t{frame.count} * kRecordBytes, "payload",
              "is not count * 20 octets");
  checks.vector("origin", frame.origin, kFarthest);
  checks.within("simulation_time", frame.simulation_time, -kLongestTime, kLongestTime);
  checks.that(
      are_plausible(scales_of(frame)), "box_size",
      "or box_min, largest_speed or particle_spacing is out of range; allowed: finite, not negative, up to 1e6");
  check_bodies(checks, frame.bodies);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_ScheduleV1& schedule) {
  Checks checks;
  checks.stamp("clock_ns", schedule.clock_ns);
  checks.stamp("utc_ns", schedule.utc_ns);
  checks.within("time", schedule.time, -kLongestTime, kLongestTime);
  checks.within("rate", schedule.rate, 0.0, 1e6);
  checks.within("limit", schedule.limit, -kLongestTime, kLongestTime);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_ClockAnswerV1& answer) {
  Checks checks;
  checks.stamp("asked_ns", answer.asked_ns);
  checks.stamp("received_ns", answer.received_ns);
  checks.stamp("answered_ns", answer.answered_ns);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_ViewerStatusV1& status) {
  Checks checks;
  checks.within("simulation_time", status.simulation_time, -kLongestTime, kLongestTime);
  checks.within("delay", status.delay, 0.0, kLongestTime);
  checks.within("skew_median", status.skew_median, 0.0, 2.0 * kLongestTime);
  checks.within("skew_99", status.skew_99, 0.0, 2.0 * kLongestTime);
  checks.that(status.clock <= pelagos_CLOCK_HOST, "clock", "is none of the four values of ViewerClock");
  checks.within("clock_offset", status.clock_offset, -1e10, 1e10);
  checks.within("clock_error", status.clock_error, -1.0, 1e3);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_SceneInfoV1& info) {
  Checks checks;
  checks.name("scene", info.scene, kLongestName);
  checks.name("build", info.build, kLongestName);
  checks.count("far_sea", info.far_sea._length, kMostSeaWaves);
  checks.count("bodies", info.bodies._length, kMostBodies);
  checks.above_zero("particle_spacing", info.particle_spacing, 1e4);
  checks.above_zero("frame_interval", info.frame_interval, 3600.0);
  checks.within("water_level", info.water_level, -kFarthest, kFarthest);
  check_tank(checks, info);
  checks.within("origin_latitude_deg", info.origin_latitude_deg, -90.0, 90.0);
  checks.within("origin_longitude_deg", info.origin_longitude_deg, -360.0, 360.0);
  checks.within("origin_height", info.origin_height, -kFarthest, kFarthest);
  for (std::uint32_t i = 0; i < info.far_sea._length && !checks.failed(); ++i) {
    checks.at("far_sea", i);
    check_wave(checks, info.far_sea._buffer[i]);
  }
  std::set<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < info.bodies._length && !checks.failed(); ++i) {
    checks.at("bodies", i);
    check_shape(checks, info.bodies._buffer[i]);
    checks.that(ids.insert(info.bodies._buffer[i].id).second, "id", "is that of an earlier body too");
  }
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_SeaV1& sea) {
  constexpr double kLongestBlend = 3600.0;
  Checks checks;
  checks.within("water_level", sea.water_level, -kFarthest, kFarthest);
  checks.within("depth", sea.depth, 0.0, kFarthest);
  checks.that(sea.layers._length > 0, "layers", "is empty; allowed: 1 to 8 items");
  checks.count("layers", sea.layers._length, WaveField::kMostLayers);
  std::uint64_t waves = 0;
  for (std::uint32_t i = 0; i < sea.layers._length && !checks.failed(); ++i) {
    const pelagos_SeaLayerV1& layer = sea.layers._buffer[i];
    checks.at("layers", i);
    checks.within("start", layer.start, -kLongestTime, kLongestTime);
    checks.within("seconds", layer.seconds, 0.0, kLongestBlend);
    checks.count("waves", waves += layer.waves._length, kMostSeaWaves);
    for (std::uint32_t k = 0; k < layer.waves._length && !checks.failed(); ++k) {
      checks.at("layers.waves", k);
      check_wave(checks, layer.waves._buffer[k]);
    }
  }
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_SurfaceAnswerV1& answer) {
  Checks checks;
  checks.that(answer.frame == pelagos_FRAME_ENU || answer.frame == pelagos_FRAME_NED, "frame",
              "is neither FRAME_ENU nor FRAME_NED");
  checks.within("simulation_time", answer.simulation_time, -kLongestTime, kLongestTime);
  checks.count("places", answer.places._length, SurfaceQuery::kMostPlaces);
  for (std::uint32_t i = 0; i < answer.places._length && !checks.failed(); ++i) {
    const pelagos_SurfaceAtPlaceV1& at = answer.places._buffer[i];
    checks.at("places", i);
    checks.that(at.source <= pelagos_SURFACE_WAVE_FIELD, "source", "is none of the four values of SurfaceSource");
    checks.vector("surface", at.surface, kFarthest);
    checks.vector("normal", at.normal, 1.001);
    checks.vector("velocity", at.velocity, kFastest);
  }
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_BodyShapeV1& shape) {
  constexpr std::uint64_t kMostTriangles = BodySurface::kMostTriangles;
  const auto& vertices = shape.vertices;
  const auto& corners = shape.corners;
  Checks checks;
  checks.vector("box_min", shape.box_min, kFarthest);
  checks.vector("box_max", shape.box_max, kFarthest);
  checks.that(
      shape.box_min.x <= shape.box_max.x && shape.box_min.y <= shape.box_max.y && shape.box_min.z <= shape.box_max.z,
      "box_max", "is below box_min");
  checks.count("vertices", vertices._length, 9 * kMostTriangles);
  checks.count("corners", corners._length, 3 * kMostTriangles);
  checks.that(vertices._length % 3 == 0, "vertices", "is not three numbers a vertex");
  checks.that(corners._length % 3 == 0, "corners", "is not three vertices a triangle");
  checks.that(vertices._length > 0 || corners._length == 0, "corners", "are of no vertices");
  for (std::uint32_t i = 0; i < vertices._length && !checks.failed(); ++i)
    checks.within("vertices", static_cast<double>(vertices._buffer[i]), -kFarthest, kFarthest);
  for (std::uint32_t i = 0; i < corners._length && !checks.failed(); ++i)
    checks.that(corners._buffer[i] < vertices._length / 3, "corners", "name a vertex that is not there");
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_StatusV2& status) {
  Checks checks;
  checks.name("scene", status.scene, kLongestName);
  checks.within("simulation_time", status.simulation_time, -kLongestTime, kLongestTime);
  checks.within("real_time_factor", status.real_time_factor, 0.0, 1e6);
  check_bodies(checks, status.bodies);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_WindV1& wind) {
  if (!wind.has_wind) return std::nullopt;
  const pelagos_WindSettingsV1& w = wind.wind;
  Checks checks;
  checks.vector("velocity_to", w.velocity_to, 1e3);
  checks.within("amplitude", w.amplitude, -1e3, 1e3);
  checks.within("length", w.length, 0.0, 1e6);
  checks.within("beta", w.beta, 0.0, 1e6);
  checks.within("pulse_period", w.pulse_period, 0.0, kLongestTime);
  checks.within("pulse_width", w.pulse_width, 0.0, kLongestTime);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_EventV1& event) {
  Checks checks;
  checks.within("simulation_time", event.simulation_time, -kLongestTime, kLongestTime);
  return std::move(checks).result();
}

std::optional<Refusal> find_fault(const pelagos_SlickV1& slick) {
  // Sizes and places of a sea that a viewer can show.
  constexpr double kFarthestDisc = 1e6, kLargestRadius = 1e5, kThickest = 100.0, kMostMass = 1e12;
  Checks checks;
  checks.count("elements", slick.elements._length, kMostSlickElements);
  checks.vector("origin", slick.origin, kFarthest);
  checks.within("simulation_time", slick.simulation_time, -kLongestTime, kLongestTime);
  for (std::uint32_t i = 0; i < slick.elements._length && !checks.failed(); ++i) {
    const pelagos_SlickElementV1& element = slick.elements._buffer[i];
    checks.at("elements", i);
    checks.vector("position", element.position, kFarthestDisc);
    checks.above_zero("radius", static_cast<double>(element.radius), kLargestRadius);
    checks.within("thickness", static_cast<double>(element.thickness), 0.0, kThickest);
    checks.within("mass", static_cast<double>(element.mass), 0.0, kMostMass);
    checks.within("water", static_cast<double>(element.water), 0.0, 1.0);
    checks.that(element.appearance <= static_cast<std::uint8_t>(OilAppearance::kContinuousTrue), "appearance",
                "is not in 0 to 5");
  }
  return std::move(checks).result();
}

}  // namespace pelagos::wire
