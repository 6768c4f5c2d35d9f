#include "surface_command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "help_text.hpp"
#include "number_list.hpp"
#include "scales/angles.hpp"
#include "values/surface_query.hpp"

namespace pelagos {
namespace {

using Reading = proto::v1::SurfaceAtPlace;

const char* source_name(Reading::Source source) {
  switch (source) {
    case Reading::PARTICLES:
      return "particles";
    case Reading::BLENDED:
      return "blended";
    case Reading::WAVE_FIELD:
      return "wave field";
    default:
      return "no water";
  }
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/// Degrees clockwise from north of the way that the surface falls to; 0 where it is level.
double falls_to_deg(const proto::v1::Vector& normal) {
  const double degrees = std::atan2(normal.x(), normal.y()) * kDegreesPerRadian;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

}  // namespace

void SurfaceCommand::add_to(CLI::App& app) {
  surface = app.add_subcommand("surface", "Print the water's surface at places: height, slope and velocity");
  surface->add_option("--at", at, "X,Y of each place (up to 1000), m, world frame: x east, y north; --at=-3,4 for west")
      ->required();
  surface->add_option("--ahead", ahead,
                      help_with("So many seconds of simulated time from now, by the waves around alone",
                                Range{0.0, SurfaceQuery::kLongestAhead, "s"}, "0"));
}

std::string SurfaceCommand::fill(proto::v1::QuerySurface& out) const {
  for (const std::string& text : at) {
    const auto numbers = read_numbers(text);
    if (!numbers || numbers->size() != 2) return "surface: --at " + text + " is no place; allowed: X,Y, e.g. 120,-35.5";
    proto::v1::Place& place = *out.add_place();
    place.set_x(numbers->front());
    place.set_y(numbers->back());
  }
  if (surface->count("--ahead") > 0) out.set_ahead(ahead);
  return "";
}

std::string describe(const proto::v1::QuerySurface& query, const proto::v1::SurfaceAnswer& answer) {
  std::string text = format("at %.3f s", answer.simulation_time());
  if (query.ahead() > 0.0) text += format(", %g s ahead", query.ahead());
  text += "\n       x m        y m  height m  slope deg  falls to  east m/s  north m/s  up m/s  from\n";
  for (int k = 0; k < std::min(query.place_size(), answer.place_size()); ++k) {
    const Reading& at = answer.place(k);
    text += format("%10.2f %10.2f", query.place(k).x(), query.place(k).y());
    if (at.source() == Reading::NO_WATER) {
      text += format("  %60s%s\n", "", "no water");
      continue;
    }
    const double slope = std::acos(std::clamp(at.normal().z(), -1.0, 1.0)) * kDegreesPerRadian;
    const auto& v = at.velocity();
    text += format("  %8.3f  %9.1f  %8.0f  %8.2f  %9.2f  %6.2f  %s\n", at.height(), slope, falls_to_deg(at.normal()),
                   v.x(), v.y(), v.z(), source_name(at.source()));
  }
  return text;
}

}  // namespace pelagos
