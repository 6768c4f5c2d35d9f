#include "waves_command.hpp"

#include <optional>
#include <string_view>

#include "files/input_file.hpp"
#include "help_text.hpp"
#include "messages/describe_faults.hpp"
#include "messages/limits.hpp"
#include "messages/parse_text.hpp"
#include "text/decimal.hpp"

namespace pelagos {
namespace {

constexpr std::size_t kLargestFile = 65536;  // bytes, as of a request

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == ',' ? static_cast<void>(parts.emplace_back()) : parts.back().push_back(c);
  return parts;
}

/// A text of three or four numbers; the second may be a period, marked by an s.
bool read_wave(const std::string& text, proto::v1::Wave& wave) {
  std::vector<std::string> parts = split(text);
  if (parts.size() < 3 || parts.size() > 4) return false;
  const bool by_period = !parts[1].empty() && parts[1].back() == 's';
  if (by_period) parts[1].pop_back();
  std::vector<double> numbers;
  for (const std::string& part : parts) {
    const std::optional<double> number = read_decimal(part);
    if (!number) return false;
    numbers.push_back(*number);
  }
  wave.set_amplitude(numbers[0]);
  by_period ? wave.set_period(numbers[1]) : wave.set_length(numbers[1]);
  wave.set_to_deg(numbers[2]);
  if (numbers.size() == 4) wave.set_phase_deg(numbers[3]);
  return true;
}

std::string read_waves_file(const std::string& path, proto::v1::SetWaves& out) {
  const InputFile file = read_input_file(path, "waves", kLargestFile);
  if (!file.fault.empty()) return path + ": " + file.fault;
  if (file.bytes.size() > kLargestFile) return path + ": is too large; allowed: at most 65,536 bytes";
  ParsedText parsed;
  parse_text(file.bytes, out, parsed);
  return parsed.faults.empty() ? "" : describe_faults(parsed.faults, path).front();
}

}  // namespace

void WavesCommand::add_to(CLI::App& app) {
  waves = app.add_subcommand("waves", "Exchange the waves around the simulated water for others");
  CLI::Option* list = waves->add_option(
      "--wave", wave,
      "AMPLITUDE,LENGTH,TO[,PHASE] of each wave: m, m, degrees clockwise from north that it runs TOWARDS, degrees; 8s "
      "in place of the length is a period");
  CLI::Option* path = waves->add_option(
      "--file", file,
      "Waves from a file, as they stand in a scene: wave { amplitude: 1.2 length: 60 to_deg: 270 } ...");
  waves->add_option("--blend", blend, help_with("Change over so many seconds of simulated time", limits::kBlend, "0"));
  waves->add_flag("--off", off, "A flat sea")->excludes(list)->excludes(path);
  list->excludes(path);
}

std::string WavesCommand::usage_fault() const {
  if (!waves->parsed() || off || !wave.empty() || !file.empty()) return "";
  return "waves: say which, e.g. --wave 1.2,60,270 --blend 30, or --file FILE, or --off; see pelagos-ctl waves --help";
}

std::string WavesCommand::fill(proto::v1::SetWaves& out) const {
  if (!file.empty()) {
    if (std::string fault = read_waves_file(file, out); !fault.empty()) return fault;
  }
  for (const std::string& text : wave)
    if (!read_wave(text, *out.add_wave()))
      return "waves: --wave " + text +
             " is no wave; allowed: AMPLITUDE,LENGTH,TO[,PHASE], e.g. 1.2,60,270 or by its period 1.2,8s,270,90";
  if (off) out.set_flat(true);
  if (waves->count("--blend") > 0) out.set_blend(blend);
  return "";
}

}  // namespace pelagos
