#include "print.hpp"

#include <google/protobuf/text_format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

namespace pelagos {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json single_value(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_INT64:
      return reflection.GetInt64(message, &field);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(message, &field);
    case FieldDescriptor::CPPTYPE_UINT64:
      return reflection.GetUInt64(message, &field);
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return number(reflection.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return number(static_cast<double>(reflection.GetFloat(message, &field)));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field);
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.GetEnum(message, &field)->name();
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.GetString(message, &field);
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return to_json(reflection.GetMessage(message, &field));
  }
  return nullptr;
}

std::string format(const char* pattern, auto... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

/// kg in the unit that suits it.
std::string mass(double kilograms) {
  if (kilograms != 0.0 && kilograms < 1.0) return format("%.3g g", 1e3 * kilograms);
  return kilograms < 1e4 ? format("%.4g kg", kilograms) : format("%.5g t", 1e-3 * kilograms);
}

/// m in the unit that suits it.
std::string thickness(double metres) {
  return metres < 1e-3 ? format("%.3g um", 1e6 * metres) : format("%.3g mm", 1e3 * metres);
}

std::string describe_release(const proto::v1::ReleaseReport& release) {
  const std::string text = "release " + release.name();
  if (release.wait() == proto::v1::ReleaseReport::FLOWS) return text + ": flows";
  const char* why = release.wait() == proto::v1::ReleaseReport::NO_WATER ? "no water near it"
                    : release.wait() == proto::v1::ReleaseReport::FULL   ? "as many particles are oil as may be"
                                                                         : "carried out of the patch";
  return text + format(": waits for %.3g s, %s, ", release.waiting(), why) + mass(release.pending()) + " held back";
}

std::string describe_skimmer(const proto::v1::SkimmerReport& skimmer) {
  return "skimmer " + skimmer.name() + ": " + mass(skimmer.recovered()) +
         format(", now %.3g m^3/h%s", skimmer.present_rate(), skimmer.dry() ? ", dry" : "");
}

std::string describe_oil(const proto::v1::OilStatus& oil) {
  const std::string next = "\n           ";
  std::string text = mass(oil.released()) + " released: " + mass(oil.afloat()) + " afloat, " + mass(oil.contained()) +
                     " contained, " + mass(oil.submerged()) + " submerged, " + mass(oil.recovered()) + " recovered, " +
                     mass(oil.evaporated()) + " evaporated, " + mass(oil.left_patch()) + " left the patch";
  if (oil.elements() > 0)
    text += next + format("slick of %.4g m^2, ", oil.area()) + thickness(oil.mean_thickness()) +
            " thick in the mean, at most " + thickness(oil.largest_thickness()) +
            format(", %.3g m^3 of water in it", oil.emulsion_water());
  if (oil.held_back() > 0.0) text += next + mass(oil.held_back()) + " could not flow out";
  for (const auto& release : oil.release()) text += next + describe_release(release);
  for (const auto& skimmer : oil.skimmer()) text += next + describe_skimmer(skimmer);
  if (oil.booms() > 0 || oil.skimmer_size() > 0 || oil.release_size() > 0)
    text += next + format("%u of %u booms (%u points in all), %d of %u skimmers, %d of %u releases", oil.booms(),
                          oil.most_booms(), oil.most_boom_points(), oil.skimmer_size(), oil.most_skimmers(),
                          oil.release_size(), oil.most_releases());
  return text;
}

constexpr double kRounding = 1e-12;  ///< what is smaller is left over from rounding: the east part of a north wind

/// Rounds all numbers to seven significant digits, for people.
void round_numbers(Message& message) {
  const auto& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      if (!field->is_repeated()) round_numbers(*reflection.MutableMessage(&message, field));
      for (int k = 0; field->is_repeated() && k < reflection.FieldSize(message, field); ++k)
        round_numbers(*reflection.MutableRepeatedMessage(&message, field, k));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && !field->is_repeated()) {
      const double value = reflection.GetDouble(message, field);
      reflection.SetDouble(&message, field,
                           std::fabs(value) < kRounding ? 0.0 : std::strtod(format("%.7g", value).c_str(), nullptr));
    }
  }
}

std::string describe_wind(const proto::v1::Status& status) {
  if (!status.has_wind()) return "none";
  const auto& wind = status.wind();
  std::string text = format("%.1f m/s from %03.0f, gusts +-%.1f m/s over %.3g m, factor %.3g", wind.speed(),
                            wind.from_deg(), wind.amplitude(), wind.length(), wind.beta());
  const char* unit = wind.law() == proto::v1::Wind::PAPER ? "steps" : "s";
  if (wind.has_pulse())
    text += format(", blowing %.3g %s of every %.3g %s", wind.pulse().width(), unit, wind.pulse().period(), unit);
  if (wind.law() == proto::v1::Wind::STRESS) text += ", law stress";
  if (wind.law() == proto::v1::Wind::PAPER) text += ", law paper: its push depends on the time step";
  return text;
}

std::string describe_current(const proto::v1::Status& status) {
  if (!status.has_current()) return "none";
  const auto& current = status.current();
  std::string text = format("%.2f m/s to %03.0f", current.speed(), current.to_deg());
  if (current.shear() == proto::v1::Current::LINEAR) text += format(", linearly to 0 at %.3g m", current.depth());
  if (current.shear() == proto::v1::Current::SEVENTH_POWER)
    text += format(", 1/7 power to 0 at %.3g m", current.depth());
  std::string axes = current.moves_water_x() ? "x" : "";
  if (current.moves_water_y()) axes += axes.empty() ? "y" : " and y";
  return text + (axes.empty() ? ", carries only what drifts" : ", moves the water along " + axes);
}

std::string describe_edges(const proto::v1::EdgeStatus& edges) {
  using ull = unsigned long long;
  std::string text = format("level %+.2f m, ", edges.level());
  if (edges.has_height_ratio())
    text += format("waves inside %.2f of those around (%.2f m significant), ", edges.height_ratio(),
                   edges.significant_height());
  return text + format("zones absorb %.2f m/s, %llu particles created, %llu taken out", edges.mismatch(),
                       ull{edges.created()}, ull{edges.deleted()});
}

std::string describe_sea(const proto::v1::SeaStatus& sea) {
  std::string text = "flat";
  if (sea.waves() > 0)
    text = format("%u, significant height %.2f m, to %03.0f on average, the highest of %.1f s (%.4g m)", sea.waves(),
                  sea.significant_height(), sea.mean_to_deg(), sea.highest_period(), sea.highest_length());
  if (sea.has_words()) text += "; asked for: " + sea.words();
  if (sea.has_left_out_height()) text += format(", which leaves out %.2f m", sea.left_out_height());
  if (!sea.has_share()) return text;
  text += format("; change to it: %.0f %% done, %.1f s left", 100.0 * sea.share(), sea.blend_left());
  return sea.earlier() < 2 ? text : text + format("; %u seas before it still show", sea.earlier());
}

std::string describe_record(const proto::v1::CommandLogStatus& log) {
  if (!log.has_fault()) return log.file();
  std::string text = log.file() + ": NOT WRITTEN, " + log.fault();
  if (log.waiting() > 0) text += "; lines that wait for room: " + std::to_string(log.waiting());
  if (log.lost() > 0) text += "; lines lost: " + std::to_string(log.lost());
  return text;
}

std::string describe_body(const proto::v1::BodyStatus& body) {
  std::string pose = "without poses";
  switch (body.health()) {
    case proto::v1::BodyStatus::FRESH:
      pose = "pose fresh";
      break;
    case proto::v1::BodyStatus::COASTING:
      pose = "pose stale, coasting";
      break;
    case proto::v1::BodyStatus::HOLDING:
      pose = "pose stale, holding";
      break;
    default:
      break;
  }
  std::string text = format("%u at (%.1f, %.1f, %.1f) m, heading %03.0f, %.1f m/s, ", body.id(), body.position().x(),
                            body.position().y(), body.position().z(), body.heading_deg(), body.speed());
  text += pose;
  if (body.has_pose_age()) text += format(" (%.2f s old)", body.pose_age());
  if (body.has_hold_volume())
    text += format(", %.3g m^3 of water in its hold of %.3g m^3", body.water_in_hold(), body.hold_volume());
  return text;
}

std::string describe_poses(const proto::v1::Status& status) {
  using ull = unsigned long long;
  std::string text =
      format("poses      %llu accepted, %llu refused\n", ull{status.poses_accepted()}, ull{status.poses_refused()});
  const char* next = "           ";
  if (status.poses_corrected() > 0)
    text += next + format("%llu accepted with the velocity of their places: the one sent contradicts them\n",
                          ull{status.poses_corrected()});
  for (const auto& refusals : status.pose_refusals())
    text += next + format("%llu refused: ", ull{refusals.count()}) + refusals.reason() + "\n";
  return text;
}

std::string describe_open_links(const proto::v1::Status& status) {
  std::string text;
  for (const auto& open : status.open_link()) text += "OPEN       " + open.link() + ": " + open.reach() + "\n";
  return text;
}

std::string describe_start(const proto::v1::Status& s) {
  return s.particles() == 0 ? "placing the water" : format("settling the water, %.0f %% done", 100.0 * s.settled());
}

/// Time, speed, accuracy and traffic of the steps that were made.
std::string describe_run(const proto::v1::Status& s) {
  using ull = unsigned long long;
  std::string text = format("time       %.2f s simulated, step %llu, frame %llu\n", s.simulation_time(), ull{s.step()},
                            ull{s.frame()});
  text += format("speed      %.2f of real time (%.2f achievable), %.2f ms for a step of %.2f ms\n",
                 s.real_time_factor(), s.achievable_real_time_factor(), s.step_ms(), s.time_step() * 1e3);
  text += format("density    error %.4f %%, largest %.4f, iterations %.1f + %.1f\n", s.density_error() * 100.0,
                 s.largest_density(), s.density_iterations(), s.divergence_iterations());
  text += format("motion     %.4g J kinetic, fastest %.2f m/s\n", s.kinetic_energy(), s.largest_speed());
  text += format("frames     %llu published, %llu dropped\n", ull{s.frames_published()}, ull{s.frames_dropped()});
  return text + describe_poses(s);
}

}  // namespace

Json to_json(const Message& message) {
  const auto& descriptor = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  Json json = Json::object();
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const FieldDescriptor& field = *descriptor.field(i);
    if (field.is_repeated()) {  // all of ours hold messages or text
      Json list = Json::array();
      for (int k = 0; k < reflection.FieldSize(message, &field); ++k) {
        if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING)
          list.push_back(reflection.GetRepeatedString(message, &field, k));
        else
          list.push_back(to_json(reflection.GetRepeatedMessage(message, &field, k)));
      }
      json[field.name()] = std::move(list);
    } else if (reflection.HasField(message, &field)) {
      json[field.name()] = single_value(message, field);
    }
  }
  return json;
}

std::string describe(const proto::v1::Status& s) {
  using ull = unsigned long long;
  std::string text;
  text += "scene      " + s.scene() +
          (s.starting() ? ", starting: " + describe_start(s)
           : s.paused() ? ", paused"
                        : ", running") +
          "\n";
  if (!s.starting()) text += describe_run(s);
  if (s.particles() > 0)
    text += format("particles  %u of water, %u of boundaries, %u published\n", s.particles(), s.boundary_particles(),
                   s.published_particles());
  text += format("solver     tolerances %.3g + %.3g, steps up to %.2f ms, %u steps not converged, ",
                 s.density_tolerance(), s.divergence_tolerance(), s.max_step() * 1e3, s.unconverged_steps());
  text += s.over_budget() ? "governor at its bounds\n" : s.governed() ? "governed\n" : "no governor\n";
  if (s.recoveries() > 0) text += format("faults     %llu recovered from\n", ull{s.recoveries()});
  text += "wind       " + describe_wind(s) + "\n";
  if (s.has_oil()) text += "oil        " + describe_oil(s.oil()) + "\n";
  text += "current    " + describe_current(s) + "\n";
  text += "waves      " + describe_sea(s.sea()) + "\n";
  if (s.has_edges()) text += "edges      " + describe_edges(s.edges()) + "\n";
  if (s.scheduled() > 0)
    text += format("schedule   %u command%s\n", s.scheduled(), s.scheduled() == 1 ? " waits" : "s wait");
  if (s.commands_refused() > 0)
    text += format("refused    %llu, the last at ", ull{s.commands_refused()}) + s.last_refusal() + "\n";
  if (const auto& q = s.surface_queries(); q.answered() + q.refused() > 0)
    text += format("queries    %llu of the surface answered, %llu refused\n", ull{q.answered()}, ull{q.refused()});
  if (s.has_command_log()) text += "record     " + describe_record(s.command_log()) + "\n";
  for (const auto& body : s.body()) text += "body       " + describe_body(body) + "\n";
  text += format("stations   %u\n", s.stations());
  text += describe_open_links(s);
  for (const auto& note : s.start_note()) text += "start      " + note + "\n";
  return text;
}

std::string describe(const proto::v1::Schedule& schedule) {
  if (schedule.command_size() == 0) return "nothing is scheduled\n";
  google::protobuf::TextFormat::Printer printer;
  printer.SetSingleLineMode(true);
  std::string text;
  for (const auto& waiting : schedule.command()) {
    proto::v1::TimedCommand what = waiting.command();
    what.clear_at();
    what.clear_source();
    round_numbers(what);
    std::string words;
    printer.PrintToString(what, &words);
    text += format("%6llu  %9.3f s  ", static_cast<unsigned long long>(waiting.id()), waiting.command().at()) + words +
            "(" + waiting.command().source() + ")\n";
  }
  return text;
}

std::string describe(const proto::v1::WindReading& reading) {
  std::string text;
  for (const auto& place : reading.place()) {
    const auto& v = place.velocity();
    text += format("%.2f m/s", place.speed());
    if (place.has_from_deg()) text += format(" from %05.1f", place.from_deg());
    text += format(", towards (%.2f, %.2f, %.2f) m/s, at %.3f s\n", v.x(), v.y(), v.z(), reading.simulation_time());
  }
  return text;
}

std::string describe(const proto::v1::Event& event) {
  return format("%6llu  %9.3f s  step %-8llu ", static_cast<unsigned long long>(event.sequence()),
                event.simulation_time(), static_cast<unsigned long long>(event.step())) +
         event.kind() + ": " + event.text() + " (" + event.source() + ")";
}

}  // namespace pelagos
