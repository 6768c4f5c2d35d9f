#include "track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace pelagos::example {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadians = kPi / 180.0;
constexpr std::size_t kMostPoints = 1000000;

// A column of the file: its name, where it goes, the largest magnitude allowed, and whether it may be left out.
struct Column {
  const char* name;
  double ShipState::*member;
  double largest;
  bool optional;
};
constexpr std::array kColumns = {
    Column{"time", &ShipState::time, 1e7, false},
    Column{"east", &ShipState::east, 1e5, false},
    Column{"north", &ShipState::north, 1e5, false},
    Column{"heading_deg", &ShipState::heading_deg, 1e6, false},
    Column{"up", &ShipState::up, 1e5, true},
    Column{"pitch_deg", &ShipState::pitch_deg, 90.0, true},
    Column{"roll_deg", &ShipState::roll_deg, 180.0, true},
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    const auto first = field.find_first_not_of(" \t\r");
    const auto last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

bool parse_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && end == text.c_str() + text.size() && std::isfinite(value);
}

/// For each column of the file the known column that it is, or null.
std::string match_columns(const std::vector<std::string>& names, std::vector<const Column*>& columns) {
  columns.assign(names.size(), nullptr);
  for (const Column& column : kColumns) {
    const auto found = std::find(names.begin(), names.end(), column.name);
    if (found != names.end()) {
      columns[static_cast<std::size_t>(found - names.begin())] = &column;
    } else if (!column.optional) {
      return std::string("column '") + column.name +
             "' is missing; the first line must name time, east, north, heading_deg";
    }
  }
  return "";
}

std::string read_point(const std::vector<std::string>& fields, const std::vector<const Column*>& columns,
                       ShipState& point) {
  if (fields.size() != columns.size()) {
    return std::to_string(fields.size()) + " fields; the first line names " + std::to_string(columns.size());
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (columns[i] == nullptr) continue;
    double& value = point.*(columns[i]->member);
    if (!parse_number(fields[i], value) || std::abs(value) > columns[i]->largest) {
      std::ostringstream message;
      message << columns[i]->name << " is '" << fields[i] << "'; allowed: a number within +-" << columns[i]->largest;
      return message.str();
    }
  }
  return "";
}

ShipState oval_state(const OvalTrack& oval, double time) {
  // Ramanujan's approximation of an ellipse's circumference gives the mean speed asked for.
  const double a = oval.radius_east;
  const double b = oval.radius_north;
  const double circumference = kPi * (3.0 * (a + b) - std::sqrt((3.0 * a + b) * (a + 3.0 * b)));
  const double angle = 2.0 * kPi * oval.speed / circumference * time;
  ShipState state;
  state.time = time;
  state.east = oval.east + a * std::sin(angle);
  state.north = oval.north + b * std::cos(angle);
  state.up = oval.up;
  state.heading_deg = std::atan2(a * std::cos(angle), -b * std::sin(angle)) / kRadians;
  return state;
}

ShipState file_state(const FileTrack& track, double time) {
  const auto& points = track.points;
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double t, const ShipState& point) { return t < point.time; });
  if (after == points.begin()) return points.front();
  if (after == points.end()) return points.back();
  const ShipState& p = *(after - 1);
  const ShipState& q = *after;
  const double s = (time - p.time) / (q.time - p.time);
  const auto between = [s](double from, double to) { return from + s * (to - from); };
  ShipState state;
  state.time = time;
  state.east = between(p.east, q.east);
  state.north = between(p.north, q.north);
  state.up = between(p.up, q.up);
  state.heading_deg = p.heading_deg + s * std::remainder(q.heading_deg - p.heading_deg, 360.0);  // the short way round
  state.pitch_deg = between(p.pitch_deg, q.pitch_deg);
  state.roll_deg = between(p.roll_deg, q.roll_deg);
  return state;
}

Eigen::Vector3d ned_position(const ShipState& state) { return {state.north, state.east, -state.up}; }

Eigen::Quaterniond ned_orientation(const ShipState& state) {
  using Eigen::AngleAxisd;
  return AngleAxisd(state.heading_deg * kRadians, Eigen::Vector3d::UnitZ()) *
         AngleAxisd(state.pitch_deg * kRadians, Eigen::Vector3d::UnitY()) *
         AngleAxisd(state.roll_deg * kRadians, Eigen::Vector3d::UnitX());
}

}  // namespace

std::optional<FileTrack> read_track(std::istream& input, const std::string& name, std::string& error) {
  FileTrack track;
  std::vector<const Column*> columns;
  std::size_t line_number = 0;
  const auto fail = [&](const std::string& what) {
    error = name + ":" + std::to_string(line_number) + ": " + what;
    return std::nullopt;
  };
  for (std::string line; std::getline(input, line);) {
    ++line_number;
    const auto fields = split(line);
    if (line.starts_with('#') || std::all_of(fields.begin(), fields.end(), [](auto& f) { return f.empty(); })) continue;
    if (columns.empty()) {
      if (const auto what = match_columns(fields, columns); !what.empty()) return fail(what);
      continue;
    }
    ShipState point;
    if (const auto what = read_point(fields, columns, point); !what.empty()) return fail(what);
    if (!track.points.empty() && point.time <= track.points.back().time)
      return fail("time must increase from line to line");
    if (track.points.size() >= kMostPoints) return fail("too many lines; allowed: 1000000");
    track.points.push_back(point);
  }
  if (track.points.empty()) return fail("no waypoints; at least one is needed below the line that names the columns");
  const double start = track.points.front().time;
  for (ShipState& point : track.points) point.time -= start;
  return track;
}

double end_of(const Track& track) {
  const auto* file = std::get_if<FileTrack>(&track.path);
  return file != nullptr ? file->points.back().time : std::numeric_limits<double>::infinity();
}

ShipState state_at(const Track& track, double time) {
  const auto* file = std::get_if<FileTrack>(&track.path);
  ShipState state = file != nullptr ? file_state(*file, time) : oval_state(std::get<OvalTrack>(track.path), time);
  // Periods of a small ship in a moderate sea, none a multiple of another.
  state.up += track.sea.heave * std::sin(2.0 * kPi * time / 6.3);
  state.pitch_deg += track.sea.pitch_deg * std::sin(2.0 * kPi * time / 5.1);
  state.roll_deg += track.sea.roll_deg * std::sin(2.0 * kPi * time / 7.7);
  return state;
}

NedMotion motion_at(const Track& track, double time) {
  constexpr double kStep = 1e-3;
  // On a file's track the difference does not reach beyond its ends, where the ship stands still.
  const double end = end_of(track);
  const bool under_way = time >= 0.0 && time <= end && end > 0.0;
  const bool has_start = std::holds_alternative<FileTrack>(track.path);
  const double first = under_way && has_start ? std::max(time - kStep, 0.0) : time - kStep;
  const double last = under_way ? std::min(time + kStep, end) : time + kStep;
  const ShipState before = state_at(track, first);
  const ShipState now = state_at(track, time);
  const ShipState after = state_at(track, last);
  const Eigen::AngleAxisd turn(ned_orientation(before).conjugate() * ned_orientation(after));
  return {ned_position(now), ned_orientation(now), (ned_position(after) - ned_position(before)) / (last - first),
          turn.axis() * turn.angle() / (last - first)};
}

}  // namespace pelagos::example
