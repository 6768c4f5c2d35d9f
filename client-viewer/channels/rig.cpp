#include "channels/rig.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "text/printable.hpp"

namespace pelagos {
namespace {

using nlohmann::json;

constexpr std::size_t kLargestFile = 1 << 20;  // bytes
constexpr std::size_t kMostChannels = 64;
constexpr int kDeepest = 8;                // brackets inside each other; a rig needs four
constexpr std::size_t kMostFaults = 20;    // that are told
constexpr std::size_t kLongestQuote = 60;  // bytes, of a value in a message

/// A value as the file has it, not too much of it.
std::string quote(const json& value) {
  return printable(value.dump(-1, ' ', false, json::error_handler_t::replace), kLongestQuote);
}

/// JSON of bounded depth: what works on the values is recursive. Comments are allowed.
json parse_shallow(const std::string& text) {
  std::vector<std::string> place;  // keys on the way to where the parser is
  const auto refuse_deep = [&](int depth, json::parse_event_t event, const json& value) {
    if (event == json::parse_event_t::key) {
      place.resize(static_cast<std::size_t>(depth));
      place.back() = value.get<std::string>();
    }
    const bool opens = event == json::parse_event_t::object_start || event == json::parse_event_t::array_start;
    if (opens && depth >= kDeepest)
      throw std::runtime_error((place.empty() ? "" : printable(place.front(), kLongestQuote) + ": ") +
                               "has brackets more than " + std::to_string(kDeepest) + " deep inside each other");
    return true;
  };
  return json::parse(text, refuse_deep, true, true);
}

/// Reads fields of one object, collects faults and remembers what was read, to name unknown fields.
class Fields {
 public:
  Fields(const json& object, std::string place, Refusals& faults)
      : object_(object), place_(std::move(place)), faults_(faults) {}

  [[nodiscard]] const json* find(const char* key) {
    known_.insert(key);
    const auto it = object_.find(key);
    return it == object_.end() ? nullptr : &*it;
  }
  void fault(const std::string& key, const std::string& text) {
    faults_.push_back({(place_.empty() ? "" : place_ + ".") + printable(key, kLongestQuote), text});
  }
  void number(const char* key, double low, double high, double& value) {
    const json* field = find(key);
    if (field == nullptr) return;
    const std::string allowed = "allowed: a number from " + short_text(low) + " to " + short_text(high);
    if (!field->is_number()) return fault(key, "is " + quote(*field) + "; " + allowed);
    const double read = field->get<double>();
    if (!(read >= low && read <= high)) return fault(key, "is " + quote(*field) + "; " + allowed);
    value = read;
  }
  void whole_number(const char* key, int low, int high, int& value) {
    const json* field = find(key);
    if (field == nullptr) return;
    const std::string allowed = "allowed: a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    if (!field->is_number_integer()) return fault(key, "is " + quote(*field) + "; " + allowed);
    const bool too_large = field->is_number_unsigned() && field->get<std::uint64_t>() > 0x7fffffffu;
    if (too_large || field->get<std::int64_t>() < low || field->get<std::int64_t>() > high)
      return fault(key, "is " + quote(*field) + "; " + allowed);
    value = field->get<int>();
  }
  void text(const char* key, bool required, std::string& value) {
    const json* field = find(key);
    if (field == nullptr) {
      if (required) fault(key, "is missing; allowed: a name of 1 to 64 letters, digits, '-' or '_'");
      return;
    }
    const bool good = field->is_string() && is_name(field->get_ref<const std::string&>());
    if (!good) return fault(key, "is " + quote(*field) + "; allowed: a name of 1 to 64 letters, digits, '-' or '_'");
    value = field->get<std::string>();
  }
  void point(const char* key, double limit, Eigen::Vector3d& value) {
    const json* field = find(key);
    if (field == nullptr) return;
    bool good = field->is_array() && field->size() == 3;
    for (int i = 0; good && i < 3; ++i) {
      const json& part = (*field)[static_cast<std::size_t>(i)];
      good = part.is_number() && std::abs(part.get<double>()) <= limit;
      if (good) value[i] = part.get<double>();
    }
    if (!good)
      fault(key,
            "is " + quote(*field) + "; allowed: three numbers from " + short_text(-limit) + " to " + short_text(limit));
  }
  void refuse_unknown() {
    for (const auto& [key, value] : object_.items()) {
      if (known_.contains(key)) continue;
      std::string names;
      for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
      fault(key, "is not a field here; allowed: " + names);
    }
  }
  static std::string short_text(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
  }
  static bool is_name(const std::string& name) {
    if (name.empty() || name.size() > 64) return false;
    for (const char c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') return false;
    return true;
  }

 private:
  const json& object_;
  std::string place_;
  Refusals& faults_;
  std::set<std::string> known_;
};

Mount read_mount(const json& object, const std::string& place, Refusals& faults) {
  Mount mount;
  if (!object.is_object()) {
    faults.push_back(
        {place, "is " + quote(object) + "; allowed: an object with body, eye, attitude, heading_deg, tilt_deg"});
    return mount;
  }
  Fields fields(object, place, faults);
  int body = 0;
  fields.whole_number("body", 0, 1'000'000, body);
  mount.body = static_cast<std::uint32_t>(body);
  fields.point("eye", 1e5, mount.eye);
  fields.number("heading_deg", -360.0, 360.0, mount.heading_deg);
  fields.number("tilt_deg", -90.0, 90.0, mount.tilt_deg);
  if (const json* attitude = fields.find("attitude")) {
    if (*attitude == "full")
      mount.attitude = MountAttitude::kFull;
    else if (*attitude == "heading")
      mount.attitude = MountAttitude::kHeading;
    else if (*attitude == "none")
      mount.attitude = MountAttitude::kNone;
    else
      fields.fault("attitude", "is " + quote(*attitude) + "; allowed: \"full\", \"heading\", \"none\"");
  }
  fields.refuse_unknown();
  return mount;
}

Channel read_channel(const json& object, const std::string& place, const Mount& rig_mount, Refusals& faults) {
  Channel channel;
  channel.mount = rig_mount;
  if (!object.is_object()) {
    faults.push_back({place, "is " + quote(object) + "; allowed: an object with name, yaw_deg, pitch_deg, ..."});
    return channel;
  }
  Fields fields(object, place, faults);
  fields.text("name", true, channel.name);
  fields.number("yaw_deg", -360.0, 360.0, channel.yaw_deg);
  fields.number("pitch_deg", -90.0, 90.0, channel.pitch_deg);
  fields.number("horizontal_fov_deg", 1.0, 120.0, channel.horizontal_fov_deg);
  fields.whole_number("guard_px", 0, 512, channel.guard_px);
  if (const json* mount = fields.find("mount")) channel.mount = read_mount(*mount, place + ".mount", faults);
  fields.refuse_unknown();
  return channel;
}

void read_channels(const json& list, const Mount& mount, Rig& rig, Refusals& faults) {
  if (!list.is_array() || list.empty() || list.size() > kMostChannels) {
    faults.push_back(
        {"channels", "is " + quote(list) + "; allowed: a list of 1 to " + std::to_string(kMostChannels) + " channels"});
    return;
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string place = "channels[" + std::to_string(i) + "]";
    rig.channels.push_back(read_channel(list[i], place, mount, faults));
    const std::string& name = rig.channels.back().name;
    if (!name.empty() && !names.insert(name).second)
      faults.push_back({place + ".name", "is \"" + name + "\", which an earlier channel has; allowed: each name once"});
  }
}

/// One line for each refusal.
std::string lines_of(const Refusals& refusals) {
  std::string text;
  for (const Refusal& refusal : refusals) text += (text.empty() ? "" : "\n") + to_string(refusal);
  return text;
}

}  // namespace

RigError::RigError(Refusals refusals) : std::runtime_error(lines_of(refusals)), refusals_(std::move(refusals)) {}

const Channel* Rig::find(const std::string& channel) const {
  for (const Channel& candidate : channels)
    if (candidate.name == channel) return &candidate;
  return nullptr;
}

std::string Rig::channel_names() const {
  std::string names;
  for (const Channel& channel : channels) names += (names.empty() ? "" : ", ") + channel.name;
  return names;
}

namespace {

/// @param place  bytes up to where the reader stopped, 1 for the first
RigError syntax_error(const std::string& file_name, const std::string& text, std::size_t place) {
  const std::string allowed = "; allowed: JSON with mount and channels as docs/viewer.md shows them";
  const std::size_t at = std::min(place > 0 ? place - 1 : 0, text.size());
  const auto here = text.begin() + static_cast<std::ptrdiff_t>(at);
  const std::string place_in_file = file_name + ":" + std::to_string(1 + std::count(text.begin(), here, '\n'));
  if (at >= text.size()) return RigError({{place_in_file, "not JSON: the file ends too early" + allowed}});
  const std::size_t first = text.rfind('\n', at == 0 ? 0 : at - 1);
  const std::size_t begin = first == std::string::npos || at == 0 ? 0 : first + 1;
  std::string words = text.substr(begin, text.find('\n', at) - begin);
  words.erase(0, words.find_first_not_of(" \t"));
  return RigError({{place_in_file, "not JSON at \"" + printable(words, kLongestQuote) + "\"" + allowed}});
}

}  // namespace

Rig parse_rig(const std::string& text, const std::string& file_name) {
  json root;
  try {
    root = parse_shallow(text);
  } catch (const json::parse_error& error) {
    throw syntax_error(file_name, text, error.byte);
  } catch (const json::out_of_range&) {
    throw RigError({{file_name, "has a number that is too large; allowed: numbers up to 1e300"}});
  } catch (const std::runtime_error& error) {
    throw RigError(
        {{file_name, std::string(error.what()) + "; allowed: mount and channels as docs/viewer.md shows them"}});
  }
  if (!root.is_object())
    throw RigError({{file_name, "is " + quote(root) + "; allowed: one object with name, mount, channels"}});
  Refusals faults;
  Rig rig;
  Fields fields(root, "", faults);
  fields.text("name", false, rig.name);
  Mount mount;
  if (const json* object = fields.find("mount")) mount = read_mount(*object, "mount", faults);
  if (const json* list = fields.find("channels"))
    read_channels(*list, mount, rig, faults);
  else
    fields.fault("channels", "is missing; allowed: a list of 1 to " + std::to_string(kMostChannels) + " channels");
  fields.refuse_unknown();
  if (faults.empty()) return rig;
  if (faults.size() > kMostFaults) {
    const Refusal rest{"", "and " + std::to_string(faults.size() - kMostFaults) + " more faults"};
    faults.resize(kMostFaults);
    faults.push_back(rest);
  }
  for (Refusal& fault : faults) fault = put_behind(file_name, ": ", fault);
  throw RigError(std::move(faults));
}

Rig load_rig(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw RigError({{file.string(), error ? error.message() : "is no file"}});
  std::ifstream in(file, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  if (!in || !in.read(text.data(), static_cast<std::streamsize>(text.size())).eof() || in.bad()) {
    if (in) throw RigError({{file.string(), "larger than 1 MiB, which no rig needs"}});
    throw RigError({{file.string(), "cannot be read"}});
  }
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse_rig(text, file.string());
}

}  // namespace pelagos
