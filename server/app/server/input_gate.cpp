#include "input_gate.hpp"

#include "fields/field_hash.hpp"
#include "run_clock.hpp"

namespace pelagos {

namespace {

std::vector<std::uint32_t> driven_bodies(const Scene& scene) {
  std::vector<std::uint32_t> ids;
  for (const BodySettings& body : scene.bodies)
    if (is_led(body.drive)) ids.push_back(body.id);
  return ids;
}

std::set<std::uint32_t> probe_ids(const Scene& scene) {
  std::set<std::uint32_t> ids;
  for (const ProbeSettings& probe : scene.probes) ids.insert(probe.id);
  return ids;
}

std::string bridge_name(std::uint32_t sender) { return "bridge " + std::to_string(sender); }

}  // namespace

InputGate::InputGate(const Scene& scene, std::optional<Replay> replay)
    : driven_(driven_bodies(scene)),
      origin_(scene.origin),
      around_(command_surroundings(scene)),
      scene_probes_(probe_ids(scene)),
      commands_(replay ? std::vector<SceneEvent>{} : scene.events),
      replay_(std::move(replay)) {
  limits_.spacing = scene.particle_spacing;
}

void InputGate::open(const std::shared_ptr<DdsParticipant>& participant, const DdsLog& log) {
  poses_ = std::make_unique<PoseReceiver>(participant, driven_, origin_, log, limits_);
  probes_ = std::make_unique<ProbeReceiver>(participant);
}

std::optional<Refusal> InputGate::refuse_in_replay(const Command& command) const {
  if (!replay_ || steers_clock(command)) return std::nullopt;
  return Refusal{"", "a replay takes its commands from the log; allowed: pause, resume, step"};
}

std::optional<Refusal> InputGate::submit(const Command& command, const std::string& source, TakeAnswer answer) {
  if (auto refusal = refuse_in_replay(command)) return refusal;
  if (!started_.load()) return submit_before_start(command, source, std::move(answer));
  return commands_.submit(command, source, std::move(answer));
}

/// Before the first boundary there is what the scene puts there, and what waits for that boundary will.
std::optional<Refusal> InputGate::refuse_before_start(const Command& command) const {
  if (auto refusal = find_refusal(command, around_)) return refusal;
  GivenNames given;
  given.probes = scene_probes_;
  for (const ScheduledCommand& waiting : commands_.scheduled())
    if (waiting.at <= 0.0) given.follow(waiting.command);
  if (auto refusal = find_unknown_name(command, given)) return refusal;
  return find_no_room(command, given);
}

std::optional<Refusal> InputGate::submit_before_start(const Command& command, const std::string& source,
                                                      TakeAnswer answer) {
  CommandAnswer news{0, refuse_before_start(command), 0};
  if (!news.refusal) {
    const CommandQueue::Scheduled waiting = commands_.schedule(command, 0.0, source);
    if (waiting.past) return commands_.submit(command, source, std::move(answer));  // it has just started
    if (waiting.id == 0) return waiting.refusal;
    news.scheduled_id = waiting.id;
  }
  if (answer) answer(news);
  return std::nullopt;
}

ScheduleAnswer InputGate::schedule(const Command& command, double at, const std::string& source) {
  using Outcome = ScheduleAnswer::Outcome;
  if (replay_) return {Outcome::kRefused, 0, 0.0, {"", "a replay takes its commands from the log"}};
  const CommandQueue::Scheduled answer = commands_.schedule(command, at, source);
  if (answer.past) return {Outcome::kPast, 0, answer.present_time, {}};
  if (answer.id == 0) return {Outcome::kRefused, 0, answer.present_time, answer.refusal.value()};
  return {Outcome::kTaken, answer.id, answer.present_time, {}};
}

void InputGate::collect(std::uint64_t step, double time, Batch& batch) {
  started_ = true;
  batch.inputs.poses.clear();
  batch.inputs.commands.clear();
  batch.answers.clear();
  batch.refused.clear();
  commands_.take_changes(batch.schedule);
  take_requests(batch);
  commands_.take(time, taken_commands_);
  for (QueuedCommand& queued : taken_commands_) {
    batch.inputs.commands.push_back(std::move(queued.given));
    batch.answers.push_back(std::move(queued.answer));
  }
  take_poses(batch);
  if (!replay_) return;
  replay_->take(step, batch.inputs);
  batch.answers.resize(batch.inputs.commands.size());
}

/// Bridges ask for probes over DDS; from here on it is a command like any other.
void InputGate::take_requests(Batch& batch) {
  if (!probes_) return;
  probes_->take(taken_requests_);
  for (const ProbeRequest& request : taken_requests_) {
    const std::string source = bridge_name(request.sender);
    std::optional<Refusal> refusal = refuse_in_replay(request.command);
    if (!refusal) refusal = request.refusal;
    if (!refusal) refusal = commands_.submit(request.command, source);
    if (refusal) batch.refused.push_back({{request.command, source}, *refusal});
  }
}

/// In a replay the poses of the log move the bodies, and those that come are let go.
void InputGate::take_poses(Batch& batch) {
  if (!poses_) return;
  poses_->take_newest(taken_poses_);
  if (replay_) return;
  for (const ReceivedPose& received : taken_poses_)
    batch.inputs.poses.push_back({received.pose, bridge_name(received.sender)});
}

std::string InputGate::check_replay(const World& world) {
  if (!replay_ || !replay_->check_due(world.step())) return "";
  return replay_->check(world.step(), hash_fields(world.state()));
}

void InputGate::close() { commands_.close("the server is stopping"); }

}  // namespace pelagos
