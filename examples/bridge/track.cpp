#include "track.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "text/characters.hpp"
#include "text/decimal.hpp"
#include "text/nearest_name.hpp"

namespace pelagos::example {
namespace {

using std::numbers::pi;
constexpr double kRadians = pi / 180.0;
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

/// How a file separates its columns, and how its numbers are written: comma and point, or, as spreadsheets of many
/// countries write them, semicolon or tab, and a decimal comma.
struct Dialect {
  char separator = ',';
  bool decimal_comma = false;
};

/// By the line that names the columns.
Dialect dialect_of(const std::string& line) {
  if (line.find(';') != std::string::npos) return {';', true};
  const bool tabs = line.find('\t') != std::string::npos && line.find(',') == std::string::npos;
  return tabs ? Dialect{'\t', true} : Dialect{};
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  const auto last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Fields between separators, which quotes may enclose.
std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

/// Without empty fields at the end, as spreadsheets leave them, as long as more than `wanted` are there.
void drop_empty_end(std::vector<std::string>& fields, std::size_t wanted) {
  while (fields.size() > wanted && fields.back().empty()) fields.pop_back();
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Reads a number in the file's dialect. @return why it is none; empty if it is one
std::string parse_number(std::string text, const Dialect& dialect, double& value) {
  if (dialect.decimal_comma && std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos)
    std::replace(text.begin(), text.end(), ',', '.');
  const std::string fault = fault_of_number(text, NumberKind::kReal);
  value = read_decimal(text).value_or(std::numeric_limits<double>::infinity());
  return fault;
}

/// For each column of the file the known column that it is, or null. @return what is wrong; empty if nothing
std::string match_columns(std::vector<std::string> names, std::vector<const Column*>& columns) {
  for (std::string& name : names) name = lower_case(name);
  columns.assign(names.size(), nullptr);
  std::vector<std::string> strangers = names, missing;
  for (const Column& column : kColumns) {
    const auto found = std::find(names.begin(), names.end(), column.name);
    if (found == names.end()) {
      missing.emplace_back(column.name);
      continue;
    }
    if (std::count(names.begin(), names.end(), column.name) > 1)
      return std::string("column '") + column.name + "' is named twice";
    columns[static_cast<std::size_t>(found - names.begin())] = &column;
    strangers.erase(std::find(strangers.begin(), strangers.end(), column.name));
  }
  constexpr const char* kKnown = "; needed: time, east, north, heading_deg; possible: up, pitch_deg, roll_deg";
  for (const std::string& stranger : strangers)
    if (const std::string meant = nearest_name(stranger, missing); stranger.size() >= 4 && !meant.empty())
      return "column '" + stranger + "' is not known; did you mean '" + meant + "'?" + kKnown;
  for (const Column& column : kColumns)
    if (!column.optional && std::find(missing.begin(), missing.end(), column.name) != missing.end())
      return std::string("column '") + column.name + "' is missing; this line names " + listed(names) + kKnown;
  return "";
}

std::string read_point(std::vector<std::string> fields, const std::vector<const Column*>& columns,
                       const Dialect& dialect, ShipState& point) {
  drop_empty_end(fields, columns.size());
  if (fields.size() != columns.size()) {
    return std::to_string(fields.size()) + " fields; the line of names has " + std::to_string(columns.size()) +
           (dialect.separator == ',' ? "; are there decimal commas? Write points, or separate the columns by semicolons"
                                     : "");
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (columns[i] == nullptr) continue;
    double& value = point.*(columns[i]->member);
    const std::string fault = parse_number(fields[i], dialect, value);
    if (fault.empty() && std::abs(value) <= columns[i]->largest) continue;
    std::ostringstream message;
    message << columns[i]->name << " is '" << fields[i] << "'" << (fault.empty() ? "" : " (" + fault + ")")
            << "; allowed: a number within +-" << columns[i]->largest;
    return message.str();
  }
  return "";
}

/// s at full speed that lead as far as `time` does with the way that the ship has lost at the start.
double time_at_full_speed(double speed_up, double time) {
  if (time >= speed_up) return time - 0.5 * speed_up;
  return time > 0.0 ? 0.5 * time * time / speed_up : time;
}

ShipState oval_state(const OvalTrack& oval, double time) {
  // Ramanujan's approximation of an ellipse's circumference gives the mean speed asked for.
  const double a = oval.radius_east;
  const double b = oval.radius_north;
  const double circumference = pi * (3.0 * (a + b) - std::sqrt((3.0 * a + b) * (a + 3.0 * b)));
  const double angle = 2.0 * pi * oval.speed / circumference * time_at_full_speed(oval.speed_up, time);
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
  Dialect dialect;
  for (std::string line; std::getline(input, line);) {
    if (++line_number == 1) {
      if (const auto encoding = foreign_encoding(line); !encoding.empty())
        return fail("the file is encoded as " + encoding + "; save it as CSV in UTF-8");
      line = without_byte_order_mark(line);
    }
    if (const auto lone = line.find('\r'); lone != std::string::npos && line.find_first_not_of('\r', lone) != line.npos)
      return fail("a carriage return stands in the line; save the file with line feeds (LF or CR LF)");
    if (line.starts_with('#') || lower_case(line).starts_with("sep=")) continue;  // the latter is for spreadsheets
    if (columns.empty()) dialect = dialect_of(line);
    auto fields = split(line, dialect.separator);
    if (std::all_of(fields.begin(), fields.end(), [](auto& field) { return field.empty(); })) continue;
    if (columns.empty()) {
      drop_empty_end(fields, 0);
      if (const auto what = match_columns(fields, columns); !what.empty()) return fail(what);
      continue;
    }
    ShipState point;
    if (const auto what = read_point(fields, columns, dialect, point); !what.empty()) return fail(what);
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
  state.up += track.sea.heave * std::sin(2.0 * pi * time / 6.3);
  state.pitch_deg += track.sea.pitch_deg * std::sin(2.0 * pi * time / 5.1);
  state.roll_deg += track.sea.roll_deg * std::sin(2.0 * pi * time / 7.7);
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
