#include <cmath>
#include <map>
#include <vector>

#include "dam_break.hpp"

namespace pelagos::validation {

namespace {

// Martin and Moyce's column: twice as high as wide. T = t sqrt(2 g / a), Z = x / a with the width a = 1 m.
constexpr double kWidth = 1.0, kTank = 10.5;  // m
constexpr double kReach = 9.0;                // Z up to which fronts are compared
constexpr double kKoshizukaReach = 4.0;       // their tank ends there
/// The experiment's clock starts with the gate, which takes its time: T = T_run + 0.175, as the compared codes have it.
constexpr double kGateShift = 0.175;
constexpr double kLatest = 7.2;  // T at which the front has passed kReach

double time_scale(double gravity) { return std::sqrt(2.0 * gravity / kWidth); }

Curve run_front(Session& session, const DamBreak& dam, const Subject& subject) {
  WaterRun run = start_dam_break(session.options().threads, dam, {subject.solver});
  const double scale = time_scale(run.state().parameters.gravity);
  Curve front;
  Series series = session.series(subject, "front", "T,Z");
  constexpr int kSamples = 180;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = kLatest * k / kSamples;
    run.advance_to(t / scale);
    front.add(t, front_position(run.state()) / kWidth);
    series.add({front.time.back(), front.value.back()});
    session.progress(subject, t / kLatest);
    if (front.value.back() > kReach) break;
  }
  session.add_cost(subject, run.cost());
  return front;
}

struct Distance {
  double mean = 0, rms = 0;  ///< of (ours - theirs) / theirs, share
  int points = 0;
};

/// Of a curve from measured points, over those that both cover.
Distance distance_to(const Curve& front, const std::vector<double>& time, const std::vector<double>& reach,
                     double shift, double largest) {
  Distance distance;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double t = time[k] - shift;
    if (t < 0.0 || t > front.time.back() || reach[k] > largest) continue;
    const double error = front.at(t) / reach[k] - 1.0;
    distance.mean += std::abs(error);
    distance.rms += error * error;
    ++distance.points;
  }
  distance.mean /= distance.points;
  distance.rms = std::sqrt(distance.rms / distance.points);
  return distance;
}

void compare(Session& session, const Subject& subject, const Curve& front, const Goal& goal) {
  const auto against = [&](const char* file, const char* who, double shift, double largest, const Goal& held) {
    const auto columns = read_columns(data_file(file));
    const Distance d = distance_to(front, columns.at(0), columns.at(1), shift, largest);
    const std::string shifted = shift > 0.0 ? " (T + 0.175)" : "";
    session.add(subject, {std::string("mean front error, ") + who + shifted, 100.0 * d.mean, "%", who, held});
  };
  against("dambreak_front_martin_moyce_1952_a2.25in.csv", "Martin & Moyce 2.25 in", kGateShift, kReach, goal);
  against("dambreak_front_martin_moyce_1952_a2.25in.csv", "Martin & Moyce 2.25 in", 0.0, kReach, {});
  against("dambreak_front_martin_moyce_1952_a1.125in.csv", "Martin & Moyce 1.125 in", kGateShift, kReach, {});
  against("dambreak_front_koshizuka_oka_1996_pysph.csv", "Koshizuka & Oka", 0.0, kKoshizukaReach, {});
}

/// Mean distance of a run's front to the finest one's, over the finest one's reach.
double distance_to_finest(const Curve& front, const Curve& finest) {
  double sum = 0.0;
  int points = 0;
  for (std::size_t k = 0; k < finest.time.size(); ++k) {
    if (finest.time[k] > front.time.back()) break;
    sum += std::abs(front.at(finest.time[k]) / finest.value[k] - 1.0);
    ++points;
  }
  return sum / points;
}

}  // namespace

void run_dam_break_front(Session& session) {
  const std::vector<int> resolutions = session.quick() ? std::vector<int>{20, 40} : std::vector<int>{20, 40, 80, 160};
  std::vector<std::string> own{"corrected"};
  if (!session.quick()) own = {"corrected", "hybrid", "dfsph", "pbf"};
  for (const std::string& solver : session.solvers(own)) {
    std::map<int, std::pair<Subject, Curve>> fronts;
    for (const int layers : resolutions) {
      if (solver != kDefaultSolver && layers > 80) continue;
      const DamBreak dam{2.0 * kWidth, kWidth, kTank, layers};
      const Subject subject{"dam_break_front", "H/d " + std::to_string(layers), solver, dam.spacing()};
      session.attempt(subject, [&] {
        const Curve front = run_front(session, dam, subject);
        // Bound: four times the aim, which a front that never started would miss by far.
        compare(session, subject, front, layers >= 40 ? at_most(3.0, 12.0) : Goal{});
        fronts[layers] = {subject, front};
      });
    }
    if (fronts.size() < 2) continue;
    const Curve& finest = fronts.rbegin()->second.second;
    const std::string reference = fronts.rbegin()->second.first.setup;
    for (const auto& [layers, run] : fronts) {
      if (layers == fronts.rbegin()->first) continue;
      // Held at 40 layers against a run at least twice as fine.
      const Goal goal = layers == 40 ? at_most(5.0, 10.0) : Goal{};
      session.add(run.first, {"mean distance to the finest run's front", 100.0 * distance_to_finest(run.second, finest),
                              "%", reference, goal});
    }
  }
}

}  // namespace pelagos::validation
