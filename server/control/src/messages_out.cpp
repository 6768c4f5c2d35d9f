#include "messages_out.hpp"

#include <cmath>

#include "messages/commands.hpp"
#include "messages/enums_out.hpp"
#include "messages/sea_out.hpp"
#include "values/oil_limits.hpp"

namespace pelagos {
namespace {

void fill(const Eigen::Vector3d& from, proto::v1::Vector& to) {
  to.set_x(from.x());
  to.set_y(from.y());
  to.set_z(from.z());
}

proto::v1::ReleaseReport::Wait wait_of(SourceWait wait) {
  switch (wait) {
    case SourceWait::kNoWater:
      return proto::v1::ReleaseReport::NO_WATER;
    case SourceWait::kFull:
      return proto::v1::ReleaseReport::FULL;
    case SourceWait::kOutside:
      return proto::v1::ReleaseReport::OUTSIDE;
    case SourceWait::kNone:
      break;
  }
  return proto::v1::ReleaseReport::FLOWS;
}

void fill(const OilBudget& from, proto::v1::OilStatus& to) {
  to.set_released(to_kilograms(from.ledger.released));
  to.set_afloat(to_kilograms(from.ledger.afloat));
  to.set_contained(to_kilograms(from.ledger.contained));
  to.set_submerged(to_kilograms(from.ledger.submerged));
  to.set_recovered(to_kilograms(from.ledger.recovered));
  to.set_evaporated(to_kilograms(from.ledger.evaporated));
  to.set_left_patch(to_kilograms(from.ledger.left_patch));
  to.set_particles(from.particles);
  to.set_elements(from.elements);
  to.set_area(from.area);
  to.set_mean_thickness(from.mean_thickness);
  to.set_largest_thickness(from.largest_thickness);
  to.set_emulsion_water(from.emulsion_water);
  to.set_displaced_water(from.displaced_water);
  to.set_held_back(from.held_back);
  to.set_booms(static_cast<std::uint32_t>(from.booms.size()));
  to.set_most_booms(static_cast<std::uint32_t>(kMostBooms));
  to.set_most_boom_points(static_cast<std::uint32_t>(kMostBoomPoints));
  to.set_most_skimmers(static_cast<std::uint32_t>(kMostSkimmers));
  to.set_most_releases(static_cast<std::uint32_t>(kMostReleases));
  for (const SourceStatus& source : from.sources) {
    proto::v1::ReleaseReport& out = *to.add_release();
    out.set_name(source.name);
    out.set_wait(wait_of(source.wait));
    out.set_waiting(source.waiting);
    out.set_pending(source.pending);
  }
  for (const SkimmerStatus& skimmer : from.skimmers) {
    proto::v1::SkimmerReport& out = *to.add_skimmer();
    out.set_name(skimmer.name);
    out.set_recovered(to_kilograms(skimmer.recovered));
    out.set_present_rate(skimmer.present_rate);
    out.set_dry(skimmer.dry);
  }
}

void fill(const WindSettings& from, proto::v1::WindStatus& to) {
  to.set_speed(from.velocity.head<2>().norm());
  to.set_from_deg(wind_from_deg(from.velocity));
  fill(from.velocity, *to.mutable_velocity());
  to.set_amplitude(from.amplitude);
  to.set_length(from.length);
  to.set_beta(from.beta);
  if (from.pulse) {
    to.mutable_pulse()->set_period(from.pulse->period);
    to.mutable_pulse()->set_width(from.pulse->width);
  }
  to.set_law(law_of(from.law));
  to.set_roughness(from.roughness);
}

void fill_current(const ServerStatus& status, proto::v1::CurrentStatus& to) {
  const CurrentSettings& current = *status.current;
  to.set_speed(current.velocity.norm());
  to.set_to_deg(current_to_deg(current.velocity));
  fill(current.velocity, *to.mutable_velocity());
  to.set_moves_water_x(status.moves_water[0]);
  to.set_moves_water_y(status.moves_water[1]);
  to.set_shear(shear_of(current.shear));
  if (current.shear != CurrentShear::kNone) to.set_depth(current.depth);
}

void fill(const SeaRequest& from, proto::v1::SeaStatus& to) {
  for (const WaveSystem& system : from.settings.systems) write_wave_system(system, *to.add_system());
  if (from.settings.seed) to.set_seed(*from.settings.seed);
  if (from.left_out > 0.0) to.set_left_out_height(from.left_out);
  if (from.settings.wind_sea) write_wind_sea(*from.settings.wind_sea, *to.mutable_wind_sea());
  to.set_words(describe_sea(from.settings));
}

void fill(const SeaStatus& from, proto::v1::SeaStatus& to) {
  constexpr double kTurn = 6.283185307179586;
  to.set_significant_height(from.significant_height);
  to.set_waves(from.waves);
  if (from.highest) {
    to.set_highest_period(kTurn / static_cast<double>(from.highest->omega));
    to.set_highest_length(kTurn / static_cast<double>(from.highest->wavenumber));
    const double direction = from.highest->direction;
    to.set_mean_to_deg(current_to_deg({std::cos(from.mean_direction), std::sin(from.mean_direction), 0.0}));
    to.set_highest_to_deg(current_to_deg({std::cos(direction), std::sin(direction), 0.0}));
  }
  if (from.request) fill(*from.request, to);
  if (from.earlier == 0) return;
  to.set_share(from.share);
  to.set_blend_left(from.blend_left);
  to.set_earlier(from.earlier);
}

proto::v1::BodyStatus::Health to_health(PoseHealth health) {
  switch (health) {
    case PoseHealth::kFresh:
      return proto::v1::BodyStatus::FRESH;
    case PoseHealth::kCoasting:
      return proto::v1::BodyStatus::COASTING;
    case PoseHealth::kHolding:
      return proto::v1::BodyStatus::HOLDING;
    case PoseHealth::kNone:
      break;
  }
  return proto::v1::BodyStatus::NONE;
}

void fill(const BodyState& from, proto::v1::BodyStatus& to) {
  to.set_id(from.body);
  fill(from.position, *to.mutable_position());
  const Eigen::Vector3d forward = from.orientation * Eigen::Vector3d::UnitX();
  to.set_heading_deg(wind_from_deg(-forward));  // the bearing of a vector: atan2(east, north)
  to.set_speed(from.velocity.norm());
  to.set_health(to_health(from.health));
  if (from.pose_age >= 0.0) to.set_pose_age(from.pose_age);
}

void fill(const EdgeQuality& from, proto::v1::EdgeStatus& to) {
  to.set_level(from.level);
  if (from.height_ratio) to.set_height_ratio(*from.height_ratio);
  to.set_significant_height(from.significant_height);
  to.set_mismatch(from.mismatch);
  to.set_created(from.created);
  to.set_deleted(from.deleted);
}

void fill(const CommandLogState& from, proto::v1::CommandLogStatus& to) {
  to.set_file(printable(from.file, 1000));
  if (!from.fault.empty()) to.set_fault(printable(from.fault));
  to.set_waiting(from.waiting);
  to.set_lost(from.lost);
}

}  // namespace

proto::v1::Status to_message(const ServerStatus& status, std::size_t stations) {
  proto::v1::Status message;
  message.set_scene(printable(status.scene));
  message.set_step(status.step);
  message.set_frame(status.frame);
  message.set_simulation_time(status.simulation_time);
  message.set_starting(status.starting);
  if (status.starting) message.set_settled(status.settled);
  message.set_paused(status.paused);
  message.set_real_time_factor(status.real_time_factor);
  message.set_achievable_real_time_factor(status.achievable_real_time_factor);
  message.set_step_ms(status.step_ms);
  message.set_time_step(status.time_step);
  message.set_particles(status.particles);
  message.set_boundary_particles(status.boundary_particles);
  message.set_published_particles(status.published_particles);
  message.set_density_error(status.density_error);
  message.set_largest_density(status.largest_density);
  message.set_density_iterations(status.density_iterations);
  message.set_divergence_iterations(status.divergence_iterations);
  message.set_kinetic_energy(status.kinetic_energy);
  message.set_largest_speed(status.largest_speed);
  message.set_frames_published(status.frames_published);
  message.set_frames_dropped(status.frames_dropped);
  message.set_poses_accepted(status.poses_accepted);
  message.set_poses_refused(status.poses_refused);
  message.set_poses_corrected(status.poses_corrected);
  for (const PoseRefusals& refusals : status.pose_refusals) {
    proto::v1::PoseRefusals& out = *message.add_pose_refusals();
    out.set_reason(std::string(refusals.reason));
    out.set_count(refusals.count);
  }
  for (const OpenLink& open : status.open_links) {
    proto::v1::OpenLink& out = *message.add_open_link();
    out.set_link(printable(open.link));
    out.set_reach(printable(open.reach, 1000));
  }
  message.set_unconverged_steps(status.unconverged_steps);
  message.set_recoveries(status.recoveries);
  for (const std::string& note : status.start_notes) message.add_start_note(printable(note, 600));
  message.set_governed(status.governed);
  message.set_max_step(status.effort.max_step);
  message.set_density_tolerance(status.effort.density_tolerance);
  message.set_divergence_tolerance(status.effort.divergence_tolerance);
  message.set_over_budget(status.over_budget);
  if (status.oil) fill(*status.oil, *message.mutable_oil());
  if (status.wind) fill(*status.wind, *message.mutable_wind());
  if (status.current) fill_current(status, *message.mutable_current());
  fill(status.sea, *message.mutable_sea());
  if (status.edges) fill(*status.edges, *message.mutable_edges());
  message.set_scheduled(status.scheduled);
  message.set_commands_refused(status.commands_refused);
  message.mutable_surface_queries()->set_answered(status.surface_queries.answered);
  message.mutable_surface_queries()->set_refused(status.surface_queries.refused);
  if (!status.last_refusal.empty()) message.set_last_refusal(printable(status.last_refusal, 1000));
  for (const BodyState& body : status.bodies) fill(body, *message.add_body());
  if (status.command_log) fill(*status.command_log, *message.mutable_command_log());
  for (const HoldReading& hold : status.holds)
    for (proto::v1::BodyStatus& body : *message.mutable_body())
      if (body.id() == hold.body) body.set_hold_volume(hold.volume), body.set_water_in_hold(hold.water);
  message.set_stations(static_cast<std::uint32_t>(stations));
  return message;
}

proto::v1::ServerMessage to_message(const Event& event) {
  proto::v1::ServerMessage message;
  proto::v1::Event& out = *message.mutable_event();
  out.set_sequence(event.sequence);
  out.set_step(event.step);
  out.set_simulation_time(event.simulation_time);
  out.set_kind(printable(event.kind));
  out.set_source(printable(event.source));
  out.set_text(printable(event.text, 1000));
  return message;
}

void fill(const ScheduledCommand& from, proto::v1::ScheduledCommand& to) {
  to.set_id(from.id);
  to.mutable_command()->set_at(from.at);
  to.mutable_command()->set_source(printable(from.source));
  write_command(from.command, *to.mutable_command());
}

proto::v1::WindReading to_message(const AirReading& reading) {
  proto::v1::WindReading message;
  message.set_simulation_time(reading.simulation_time);
  for (const Eigen::Vector3d& velocity : reading.velocity) {
    proto::v1::WindAtPlace& place = *message.add_place();
    const double speed = velocity.head<2>().norm();
    fill(velocity, *place.mutable_velocity());
    place.set_speed(speed);
    if (speed > 0.0) place.set_from_deg(wind_from_deg(velocity));
  }
  return message;
}

namespace {

proto::v1::SurfaceAtPlace::Source to_message(SurfaceSource source) {
  switch (source) {
    case SurfaceSource::kParticles:
      return proto::v1::SurfaceAtPlace::PARTICLES;
    case SurfaceSource::kBlended:
      return proto::v1::SurfaceAtPlace::BLENDED;
    case SurfaceSource::kWaveField:
      return proto::v1::SurfaceAtPlace::WAVE_FIELD;
    case SurfaceSource::kNoWater:
      break;
  }
  return proto::v1::SurfaceAtPlace::NO_WATER;
}

}  // namespace

proto::v1::SurfaceAnswer to_message(const SurfaceAnswer& answer) {
  proto::v1::SurfaceAnswer message;
  message.set_simulation_time(answer.simulation_time);
  for (const SurfaceAtPlace& at : answer.places) {
    proto::v1::SurfaceAtPlace& place = *message.add_place();
    place.set_source(to_message(at.source));
    if (at.source == SurfaceSource::kNoWater) continue;
    place.set_height(at.height);
    fill(at.normal, *place.mutable_normal());
    fill(at.velocity, *place.mutable_velocity());
  }
  return message;
}

proto::v1::ServerMessage error_message(std::uint64_t id, proto::v1::Error::Code code, std::string text,
                                       const std::string& field) {
  proto::v1::ServerMessage message;
  message.mutable_response()->set_id(id);
  proto::v1::Error& error = *message.mutable_response()->mutable_error();
  error.set_code(code);
  error.set_message(printable(text, 1000));
  if (!field.empty()) error.set_field(field);
  return message;
}

std::string frame_message(const google::protobuf::MessageLite& message) {
  const std::string body = message.SerializeAsString();
  const auto size = static_cast<std::uint32_t>(body.size());
  std::string framed;
  framed.reserve(body.size() + 4);
  for (int shift = 24; shift >= 0; shift -= 8) framed.push_back(static_cast<char>((size >> shift) & 0xffu));
  return framed + body;
}

std::string printable(const std::string& text, std::size_t max_length) {
  std::string out = text.size() > max_length ? text.substr(0, max_length) + "..." : text;
  for (char& c : out) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte > 0x7e) c = '?';  // ASCII only, so that it is valid UTF-8 wherever it was cut
  }
  return out;
}

}  // namespace pelagos
