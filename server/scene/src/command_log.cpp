#include "scene/command_log.hpp"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>

#include "commands.pb.h"
#include "files/input_file.hpp"
#include "messages/commands.hpp"
#include "messages/describe_faults.hpp"
#include "messages/parse_text.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30;
constexpr std::size_t kMostCommands = 1'000'000, kMostPoses = 10'000'000, kMostChecks = 10'000'000;
constexpr std::size_t kHashDigits = 16;

std::string hex_text(std::uint64_t value) {
  std::array<char, kHashDigits + 1> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

// ---- reading

std::uint64_t read_hash(const FieldReader& reader, const char* field) {
  std::uint64_t value = 0;
  std::string hash;
  reader.require(field);
  if (!reader.read(field, kHashDigits, hash)) return value;
  const auto parsed = std::from_chars(hash.data(), hash.data() + hash.size(), value, 16);
  if (hash.size() != kHashDigits || parsed.ptr != hash.data() + hash.size())
    reader.fault(field, "\"" + hash + "\" is no hash; allowed: 16 hexadecimal digits");
  return value;
}

CommandLogHeader read_header(const FieldReader& reader) {
  CommandLogHeader header;
  for (const char* field : {"scene", "seed", "particles"}) reader.require(field);
  reader.read("version", 64, header.version);
  reader.read("instruction_set", 64, header.instruction_set);
  reader.read("scene", 64, header.scene);
  reader.read("seed", header.seed);
  reader.read("particles", header.particles);
  for (const FieldReader& part : reader.children("part")) {
    std::string name;
    part.require("name");
    if (part.read("name", 64, name)) header.parts[name] = read_hash(part, "hash");
  }
  return header;
}

LoggedCommand read_entry(const FieldReader& entry) {
  LoggedCommand logged;
  entry.require("before_step");
  entry.read("before_step", logged.before_step);
  entry.read("at", kCommandTimes, logged.time);
  entry.read("source", 200, logged.source);
  if (entry.which("command").empty()) {
    entry.fault("", "holds no command");
    return logged;
  }
  if (const auto command = read_command(entry, "command", CommandPlace::kLog)) logged.command = *command;
  return logged;
}

/// The pose's numbers are what a server has taken: any finite ones.
LoggedPose read_pose(const FieldReader& entry) {
  constexpr double kAny = std::numeric_limits<double>::max();
  constexpr Range kFinite{-kAny, kAny};
  LoggedPose logged;
  BodyPose& pose = logged.given.pose;
  for (const char* field : {"before_step", "body", "time", "position", "turn", "turn_w"}) entry.require(field);
  entry.read("before_step", logged.before_step);
  entry.read("source", 200, logged.given.source);
  entry.read("body", {0.0, 4294967295.0}, pose.body);
  entry.read("time", kFinite, pose.time);
  entry.read("position", kFinite, pose.position);
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  double w = 1.0;
  entry.read("turn", {-1.0, 1.0}, turn);
  entry.read("turn_w", {-1.0, 1.0}, w);
  pose.orientation = Eigen::Quaterniond(w, turn.x(), turn.y(), turn.z());
  entry.read("velocity", kFinite, pose.velocity);
  entry.read("angular_velocity", kFinite, pose.angular_velocity);
  return logged;
}

CommandLogCheck read_check(const FieldReader& entry) {
  CommandLogCheck check;
  entry.require("step");
  entry.read("step", check.step);
  entry.read("at", kCommandTimes, check.time);
  check.world_hash = read_hash(entry, "world_hash");
  return check;
}

std::uint64_t& step_of(LoggedCommand& logged) { return logged.before_step; }
std::uint64_t& step_of(LoggedPose& logged) { return logged.before_step; }
std::uint64_t& step_of(CommandLogCheck& logged) { return logged.step; }

/// Entries of one kind: no more than `most`, and steps in order.
template <class Entry>
void read_entries(const FieldReader& reader, const char* field, const char* step, std::size_t most,
                  Entry (*read)(const FieldReader&), std::vector<Entry>& entries) {
  for (const FieldReader& entry : reader.children(field)) {
    if (entries.size() == most)
      return reader.fault(
          field, "has more than " + format_count(static_cast<double>(most)) + " entries; allowed: at most so many");
    Entry logged = read(entry);
    if (!entries.empty() && step_of(logged) < step_of(entries.back()))
      entry.fault(step, std::to_string(step_of(logged)) + " comes after " + std::to_string(step_of(entries.back())) +
                            "; allowed: steps in order");
    entries.push_back(std::move(logged));
  }
}

/// Nothing can happen after the last step.
template <class Entry>
void refuse_after_end(const FieldReader& reader, const char* name, std::vector<Entry>& entries,
                      const CommandLogEnd& end) {
  if (entries.empty() || step_of(entries.back()) <= end.step) return;
  reader.fault(name, "stands at step " + std::to_string(step_of(entries.back())) +
                         ", after the end; allowed: up to step " + std::to_string(end.step));
}

CommandLogEnd read_end(const FieldReader& reader) {
  CommandLogEnd end;
  reader.require("step");
  reader.read("step", end.step);
  end.state_hash = read_hash(reader, "state_hash");
  return end;
}

/// Whether a line holds whole entries: each ends with its brace.
bool is_whole(std::string_view line) {
  const auto count = [line](char c) { return std::count(line.begin(), line.end(), c); };
  const std::size_t end = line.find_last_not_of(" \t\r");
  if (end == std::string_view::npos || line[line.find_first_not_of(" \t")] == '#') return true;
  return line[end] == '}' && count('{') == count('}');
}

/// A run that was killed may leave a part of a line at the end, without a line feed. @return what is left out
std::string leave_out_cut_line(std::string_view& text) {
  if (text.empty() || text.back() == '\n') return "";
  const std::size_t last = text.find_last_of('\n');
  if (last == std::string_view::npos || is_whole(text.substr(last + 1))) return "";
  const std::size_t line = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  const std::size_t bytes = text.size() - last - 1;
  text = text.substr(0, last + 1);
  return "line " + std::to_string(line) + " of the log, its last, is cut off after " + std::to_string(bytes) +
         " bytes and left out";
}

CommandLogResult refuse(const std::string& what, const std::string& source_name) {
  return {std::nullopt, describe_faults({{0, 0, "", what}}, source_name)};
}

// ---- writing

void write_vector(const Eigen::Vector3d& from, proto::v1::Vector& to) {
  to.set_x(from.x());
  to.set_y(from.y());
  to.set_z(from.z());
}

std::string on_one_line(const google::protobuf::Message& message) {
  google::protobuf::TextFormat::Printer printer;
  printer.SetSingleLineMode(true);
  std::string text;
  printer.PrintToString(message, &text);
  return text;
}

}  // namespace

CommandLogResult read_command_log_text(std::string_view text, const std::string& source_name) {
  if (text.size() > kLargestFile) {
    return refuse("is larger than a command log can be; allowed: at most " + std::to_string(kLargestFile) + " bytes",
                  source_name);
  }
  proto::v1::CommandLog message;
  ParsedText parsed;
  CommandLog log;
  log.cut_off = leave_out_cut_line(text);
  parse_text(text, message, parsed);
  TextRefusals faults = parsed.faults;
  if (parsed.readable) {
    const FieldReader reader(message, faults, "", &parsed.locations, 1);
    log.header = read_header(reader);
    read_entries(reader, "command", "before_step", kMostCommands, read_entry, log.commands);
    read_entries(reader, "pose", "before_step", kMostPoses, read_pose, log.poses);
    read_entries(reader, "check", "step", kMostChecks, read_check, log.checks);
    if (reader.has("end")) log.end = read_end(reader.child("end"));
    if (log.end) {
      refuse_after_end(reader, "command", log.commands, *log.end);
      refuse_after_end(reader, "pose", log.poses, *log.end);
      refuse_after_end(reader, "check", log.checks, *log.end);
    }
  }
  if (faults.empty()) return {std::move(log), {}};
  CommandLogResult refused{std::nullopt, describe_faults(std::move(faults), source_name)};
  if (!log.cut_off.empty()) refused.faults.push_back(source_name + ": " + log.cut_off);
  return refused;
}

CommandLogResult read_command_log_file(const std::filesystem::path& path) {
  const InputFile file = read_input_file(path, "command log", kLargestFile);
  if (!file.fault.empty()) return refuse(file.fault, path.string());
  return read_command_log_text(file.bytes, path.string());
}

void CommandLogWriter::write(const CommandLogHeader& header) {
  proto::v1::CommandLog message;
  message.set_version(header.version);
  message.set_instruction_set(header.instruction_set);
  message.set_scene(header.scene);
  message.set_seed(header.seed);
  message.set_particles(header.particles);
  for (const auto& [name, hash] : header.parts) {
    proto::v1::CommandLog::Part& part = *message.add_part();
    part.set_name(name);
    part.set_hash(hex_text(hash));
  }
  file_.append("# A command log of pelagos-server: what was applied before which step. Replay it with --replay.");
  file_.append(on_one_line(message));
}

void CommandLogWriter::write(const LoggedCommand& command) {
  proto::v1::CommandLog message;
  proto::v1::TimedCommand& entry = *message.add_command();
  entry.set_before_step(command.before_step);
  entry.set_at(command.time);
  entry.set_source(command.source);
  write_command(command.command, entry);
  file_.append(on_one_line(message));
}

void CommandLogWriter::write(const LoggedPose& logged) {
  const BodyPose& pose = logged.given.pose;
  proto::v1::CommandLog message;
  proto::v1::CommandLog::LoggedPose& entry = *message.add_pose();
  entry.set_before_step(logged.before_step);
  entry.set_source(logged.given.source);
  entry.set_body(pose.body);
  entry.set_time(pose.time);
  write_vector(pose.position, *entry.mutable_position());
  write_vector(pose.orientation.vec(), *entry.mutable_turn());
  entry.set_turn_w(pose.orientation.w());
  write_vector(pose.velocity, *entry.mutable_velocity());
  write_vector(pose.angular_velocity, *entry.mutable_angular_velocity());
  file_.append(on_one_line(message));
}

void CommandLogWriter::write(const CommandLogCheck& check) {
  proto::v1::CommandLog message;
  proto::v1::CommandLog::Check& entry = *message.add_check();
  entry.set_step(check.step);
  entry.set_at(check.time);
  entry.set_world_hash(hex_text(check.world_hash));
  file_.append(on_one_line(message));
}

void CommandLogWriter::write(const CommandLogEnd& end) {
  proto::v1::CommandLog message;
  message.mutable_end()->set_step(end.step);
  message.mutable_end()->set_state_hash(hex_text(end.state_hash));
  file_.append(on_one_line(message));
}

CommandLogState CommandLogWriter::state() const {
  return {file_.file().string(), file_.fault(), file_.waiting_lines(), file_.lost_lines()};
}

}  // namespace pelagos
