#include "scene/command_log.hpp"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>

#include "commands.pb.h"
#include "messages/commands.hpp"
#include "messages/parse_text.hpp"
#include "text_file.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kLargestFile = std::size_t{64} << 20;
constexpr std::size_t kMostCommands = 1'000'000;
constexpr std::size_t kHashDigits = 16;

std::string hex_text(std::uint64_t value) {
  std::array<char, kHashDigits + 1> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

// ---- reading

CommandLogHeader read_header(const FieldReader& reader) {
  CommandLogHeader header;
  for (const char* field : {"scene", "seed", "particles"}) reader.require(field);
  reader.read("version", 64, header.version);
  reader.read("instruction_set", 64, header.instruction_set);
  reader.read("scene", 64, header.scene);
  reader.read("seed", header.seed);
  reader.read("particles", header.particles);
  return header;
}

LoggedCommand read_entry(const FieldReader& entry, const CommandBasis& last) {
  LoggedCommand logged;
  entry.require("before_step");
  entry.read("before_step", logged.before_step);
  entry.read("at", kCommandTimes, logged.time);
  entry.read("source", 200, logged.source);
  if (entry.which("command").empty()) {
    entry.fault("", "holds no command");
    return logged;
  }
  if (const auto command = read_command(entry, "command", CommandPlace::kLog, last)) logged.command = *command;
  return logged;
}

std::vector<LoggedCommand> read_entries(const FieldReader& reader) {
  const std::vector<FieldReader> entries = reader.children("command");
  if (entries.size() > kMostCommands) {
    reader.fault("command", "has " + format_count(static_cast<double>(entries.size())) + " entries; allowed: at most " +
                                format_count(kMostCommands));
    return {};
  }
  std::vector<LoggedCommand> commands;
  CommandBasis last;
  for (const FieldReader& entry : entries) {
    LoggedCommand logged = read_entry(entry, last);
    if (!commands.empty() && logged.before_step < commands.back().before_step)
      entry.fault("before_step", std::to_string(logged.before_step) + " comes after " +
                                     std::to_string(commands.back().before_step) + "; allowed: steps in order");
    if (const auto* set = std::get_if<SetWind>(&logged.command)) last.wind = set->wind;
    commands.push_back(std::move(logged));
  }
  return commands;
}

CommandLogEnd read_end(const FieldReader& reader) {
  CommandLogEnd end;
  reader.require("step");
  reader.require("state_hash");
  reader.read("step", end.step);
  std::string hash;
  if (!reader.read("state_hash", kHashDigits, hash)) return end;
  const auto parsed = std::from_chars(hash.data(), hash.data() + hash.size(), end.state_hash, 16);
  if (hash.size() != kHashDigits || parsed.ptr != hash.data() + hash.size())
    reader.fault("state_hash", "\"" + hash + "\" is no hash; allowed: 16 hexadecimal digits");
  return end;
}

/// A run that was killed may leave a part of a line at the end, without a line feed.
void advise_on_broken_end(std::string_view text, FieldFaults& faults) {
  const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  if (!text.empty() && text.back() != '\n' && !faults.empty() && faults.front().line > lines)
    faults.front().what += "; the last line is cut off: take it out to replay the rest";
}

CommandLogResult refuse(const std::string& what, const std::string& source_name) {
  return {std::nullopt, describe_faults({{0, 0, "", what}}, source_name)};
}

// ---- writing

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
  parse_text(text, message, parsed);
  FieldFaults faults = parsed.faults;
  CommandLog log;
  if (!parsed.readable) advise_on_broken_end(text, faults);
  if (parsed.readable) {
    const FieldReader reader(message, faults, "", &parsed.locations, 1);
    log.header = read_header(reader);
    log.commands = read_entries(reader);
    if (reader.has("end")) log.end = read_end(reader.child("end"));
  }
  if (!faults.empty()) return {std::nullopt, describe_faults(std::move(faults), source_name)};
  return {std::move(log), {}};
}

CommandLogResult read_command_log_file(const std::filesystem::path& path) {
  const TextFile file = read_text_file(path, "command log", kLargestFile);
  if (!file.fault.empty()) return refuse(file.fault, path.string());
  return read_command_log_text(file.text, path.string());
}

CommandLogWriter::CommandLogWriter(const std::string& file, const CommandLogHeader& header) : file_(file) {
  if (failed()) return;
  proto::v1::CommandLog message;
  message.set_version(header.version);
  message.set_instruction_set(header.instruction_set);
  message.set_scene(header.scene);
  message.set_seed(header.seed);
  message.set_particles(header.particles);
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
