#include "describe_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "values/sea_request.hpp"

namespace pelagos {

namespace {

struct OilDescriber {
  std::string operator()(const ReleaseOil& c) const {
    const bool line = (c.to - c.from).norm() > 0.0;
    std::string text = fmt::format("source \"{}\": {:g} m^3/h at {}", c.name, c.rate, place(c.from));
    if (line) text += " to " + place(c.to);
    if (c.body != 0) text += fmt::format(" of body {}", c.body);
    return text + (std::isfinite(c.duration) ? fmt::format(" for {:g} s", c.duration) : " until it is stopped");
  }
  std::string operator()(const StopRelease& c) const { return "source \"" + c.name + "\" stopped"; }
  std::string operator()(const SpillOil& c) const {
    return fmt::format("{:g} m^3 of oil at ({:g}, {:g}) m, radius {:g} m", c.volume, c.position.x(), c.position.y(),
                       c.radius);
  }
  std::string operator()(const SetBoom& c) const {
    return fmt::format("boom \"{}\" of {} points, draft {:g} m, leaks above {:g} m/s", c.name, c.line.size(), c.draft,
                       c.critical_speed);
  }
  std::string operator()(const RemoveBoom& c) const { return "boom \"" + c.name + "\" removed"; }
  std::string operator()(const SetSkimmer& c) const {
    return fmt::format("skimmer \"{}\" at ({:g}, {:g}) m, radius {:g} m, {:g} m^3/h", c.name, c.position.x(),
                       c.position.y(), c.radius, c.rate);
  }
  std::string operator()(const RemoveSkimmer& c) const { return "skimmer \"" + c.name + "\" removed"; }

  static std::string place(const Eigen::Vector3d& p) {
    return fmt::format("({:g}, {:g}, {:g}) m", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);  // no -0
  }
};

struct Describer {
  CommandNews operator()(const SetWind& c) const {
    WindSettings wind;
    const bool whole = c.wind.velocity && c.wind.amplitude && c.wind.length && c.wind.roughness && c.wind.law;
    if (!whole || merge_wind(c.wind, std::nullopt, wind)) return {"wind", change(c)};
    return {"wind",
            fmt::format("wind {:.1f} m/s from {:.0f} deg, gusts {:.1f} m/s, over {:.1f} s, roughness {:g} m{}{}",
                        wind.velocity.head<2>().norm(), wind_from_deg(wind.velocity), wind.amplitude, c.ramp_seconds,
                        wind.roughness, pulse(wind), law(wind))};
  }
  CommandNews operator()(const ClearWind&) const { return {"wind", "no wind"}; }
  CommandNews operator()(const SetCurrent& c) const {
    return {"current", fmt::format("current {:.2f} m/s to {:.0f} deg{}, over {:.1f} s", c.current.velocity.norm(),
                                   current_to_deg(c.current.velocity), shear(c.current), c.ramp_seconds)};
  }
  CommandNews operator()(const ClearCurrent&) const { return {"current", "no current"}; }
  CommandNews operator()(const SetWaves& c) const { return {"waves", waves(c)}; }
  CommandNews operator()(const SetSea& c) const {
    return {"waves", fmt::format("sea: {}, over {:.1f} s", describe_sea(c.sea), c.blend_seconds)};
  }
  CommandNews operator()(const PauseSimulation&) const { return {"pause", "paused"}; }
  CommandNews operator()(const ResumeSimulation&) const { return {"resume", "resumed"}; }
  CommandNews operator()(const StepSimulation& c) const { return {"step", fmt::format("single steps: {}", c.steps)}; }
  CommandNews operator()(const SetEffort& c) const {
    const Effort& e = c.effort;
    return {"governor", fmt::format("{}: steps up to {:.4g} ms, tolerances {:.3g} and {:.3g}", c.reason,
                                    e.max_step * 1e3, e.density_tolerance, e.divergence_tolerance)};
  }

  CommandNews operator()(const SetProbe& c) const {
    const ProbeSettings& p = c.probe;
    return {"probe", fmt::format("probe {} \"{}\" at {}{}{}", p.id, p.name, OilDescriber::place(p.position),
                                 p.body == 0 ? "" : fmt::format(" of body {}", p.body),
                                 p.at_surface ? ", velocity at the surface" : "")};
  }
  CommandNews operator()(const RemoveProbe& c) const { return {"probe", fmt::format("probe {} removed", c.id)}; }

  CommandNews operator()(const OilCommand& c) const { return {"oil", std::visit(OilDescriber{}, c)}; }

  /// What a wind that leaves something out says.
  static std::string change(const SetWind& c) {
    const WindChange& w = c.wind;
    std::string text = "wind:";
    if (w.velocity)
      text += fmt::format(" {:.1f} m/s from {:.0f} deg,", w.velocity->head<2>().norm(), wind_from_deg(*w.velocity));
    if (w.speed) text += fmt::format(" {:.1f} m/s,", *w.speed);
    if (w.from_deg) text += fmt::format(" from {:.0f} deg,", *w.from_deg);
    if (w.amplitude) text += fmt::format(" gusts {:.1f} m/s,", *w.amplitude);
    if (w.length) text += fmt::format(" eddies {:g} m,", *w.length);
    if (w.beta) text += fmt::format(" beta {:g},", *w.beta);
    if (w.roughness) text += fmt::format(" roughness {:g} m,", *w.roughness);
    if (w.pulse) text += fmt::format(" pulse {:g} of every {:g},", w.pulse->width, w.pulse->period);
    if (w.clear_pulse) text += " no pulse,";
    if (w.law)
      text += fmt::format(" law {},", *w.law == WindLaw::kGust     ? "gust"
                                      : *w.law == WindLaw::kStress ? "stress"
                                                                   : "paper");
    return text + fmt::format(" over {:.1f} s, the rest as it is", c.ramp_seconds);
  }
  static std::string pulse(const WindSettings& wind) {
    if (!wind.pulse) return "";
    const char* unit = wind.law == WindLaw::kPaper ? "steps" : "s";
    return fmt::format(", blowing {:g} {} of every {:g} {}", wind.pulse->width, unit, wind.pulse->period, unit) +
           (never_closes(*wind.pulse) ? " (never stops)" : "");
  }
  static std::string law(const WindSettings& wind) {
    if (wind.law == WindLaw::kStress) return ", law stress";
    return wind.law == WindLaw::kPaper ? ", law paper (its push depends on the time step)" : "";
  }
  static std::string waves(const SetWaves& c) {
    const std::string over = fmt::format(", over {:.1f} s", c.blend_seconds);
    if (c.waves.empty()) return "waves: flat sea" + over;
    const auto lower = [](const WaveSettings& a, const WaveSettings& b) { return a.amplitude < b.amplitude; };
    const WaveSettings& main = *std::max_element(c.waves.begin(), c.waves.end(), lower);
    const std::string size =
        main.length > 0.0 ? fmt::format("{:g} m long", main.length) : fmt::format("of {:g} s", main.period);
    return fmt::format("waves: {} of them, significant height {:.2f} m, the highest {} to {:.0f} deg", c.waves.size(),
                       significant_height(c.waves), size, main.to_deg) +
           over;
  }
  static std::string shear(const CurrentSettings& current) {
    switch (current.shear) {
      case CurrentShear::kLinear:
        return fmt::format(", falling linearly to nothing {:g} m down", current.depth);
      case CurrentShear::kSeventhPower:
        return fmt::format(", falling by a 1/7 power to nothing {:g} m down", current.depth);
      case CurrentShear::kNone:
        break;
    }
    return "";
  }
};

}  // namespace

CommandNews describe_command(const Command& command) { return std::visit(Describer{}, command); }

}  // namespace pelagos
