#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "dam_break.hpp"
#include "physics/pressure.hpp"

namespace pelagos::validation {

namespace {

// Lobovsky et al. 2014: a column 0.3 m high and 0.6 m long in a tank of 1.61 m; sensors in the far wall.
// Times in sqrt(H/g), fronts in H from the gate, pressures in rho g H.
constexpr double kHeight = 0.3, kLength = 0.6, kTank = 1.61;  // m
constexpr double kEnd = 7.1, kSample = 0.01;
constexpr double kWallReach = (kTank - kLength) / kHeight;
constexpr double kPlateauBegin = 3.2, kPlateauEnd = 5.5;  // between the impact and the wave that falls back
/// Peaks are compared after a mean over this long: the sensors' own bandwidth is finer, a run's steps are coarser.
constexpr double kPeakWindow = 0.05;

struct Sensor {
  const char* name;
  double height;  ///< m
  const char* file;
};
constexpr std::array<Sensor, 4> kSensors = {{{"sensor 1", 0.003, "dambreak_pressure_lobovsky_2014_sensor1_z3mm.csv"},
                                             {"sensor 2", 0.015, "dambreak_pressure_lobovsky_2014_sensor2_z15mm.csv"},
                                             {"sensor 3", 0.030, "dambreak_pressure_lobovsky_2014_sensor3_z30mm.csv"},
                                             {"sensor 4", 0.080, "dambreak_pressure_lobovsky_2014_sensor4_z80mm.csv"}}};

struct Records {
  Curve front;
  std::array<Curve, kSensors.size()> pressure;
};

Records run_column(Session& session, const DamBreak& dam, const Subject& subject) {
  WaterRun run = start_dam_break(session.options().threads, dam, {subject.solver});
  const FluidParameters& q = run.state().parameters;
  const double scale = std::sqrt(kHeight / q.gravity), unit = q.rest_density * q.gravity * kHeight;
  Records records;
  Series series = session.series(subject, "wall", "t,front,p1,p2,p3,p4");
  std::vector<float> pressure(run.state().particles.count);
  for (int k = 0; k * kSample <= kEnd; ++k) {
    const double t = k * kSample;
    std::array<double, kSensors.size()> sum{};
    int steps = 0;
    run.advance_to(t * scale, [&] {
      compute_pressure(run.state(), pressure);
      ++steps;
      for (std::size_t s = 0; s < kSensors.size(); ++s)
        sum[s] += probe_pressure(run.state(), pressure, kTank, kSensors[s].height, DamBreak::kSlice * q.spacing) / unit;
    });
    for (double& p : sum) p /= std::max(steps, 1);
    for (std::size_t s = 0; s < kSensors.size(); ++s) records.pressure[s].add(t, sum[s]);
    records.front.add(t, std::min((front_position(run.state()) - kLength) / kHeight, kWallReach));
    series.add({t, records.front.value.back(), sum[0], sum[1], sum[2], sum[3]});
    session.progress(subject, t / kEnd);
  }
  session.add_cost(subject, run.cost());
  return records;
}

/// Largest mean over kPeakWindow.
double smoothed_peak(const Curve& pressure) {
  const auto window = static_cast<std::size_t>(std::lround(kPeakWindow / kSample));
  double largest = 0.0;
  for (std::size_t k = 0; k + window <= pressure.value.size(); ++k) {
    double sum = 0.0;
    for (std::size_t m = 0; m < window; ++m) sum += pressure.value[k + m];
    largest = std::max(largest, sum / static_cast<double>(window));
  }
  return largest;
}

double largest_of(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

void compare_pressure(Session& session, const Subject& subject, std::size_t s, const Curve& pressure, bool judged) {
  const auto columns = read_columns(data_file(kSensors[s].file));
  const std::string name = kSensors[s].name;
  const double low = largest_of(columns.at(2)), high = largest_of(columns.at(3)), peak = smoothed_peak(pressure);
  char band[64];
  std::snprintf(band, sizeof band, "%.2f (%.2f to %.2f)", largest_of(columns.at(1)), low, high);
  session.add(subject, {name + " peak", peak, "rho g H", band});
  // 0 inside the band. Peaks of the few particles beside a sensor are noisy: bound two band widths.
  const double outside = std::max({0.0, low - peak, peak - high}) / (high - low);
  session.add(subject,
              {name + " peak outside the band", outside, "band widths", "0", judged ? at_most(0.0, 2.0) : Goal{}});
  double squares = 0.0;
  int points = 0;
  for (std::size_t k = 0; k < columns[0].size(); ++k) {
    if (columns[0][k] < kPlateauBegin || columns[0][k] > kPlateauEnd) continue;
    const double error = pressure.at(columns[0][k]) - columns[1][k];
    squares += error * error;
    ++points;
  }
  session.add(subject, {name + " plateau rms error", std::sqrt(squares / points), "rho g H", "median of 100 runs",
                        judged ? at_most(0.19, 0.5) : Goal{}});
}

void compare_front(Session& session, const Subject& subject, const Curve& front) {
  const auto columns = read_columns(data_file("dambreak_front_lobovsky_2014_fig12.csv"), "Lobovsky2014_H300");
  Curve measured;
  double squares = 0.0;
  int points = 0;
  for (std::size_t k = 0; k < columns.at(0).size(); ++k) {
    measured.add(columns[0][k], columns[1][k]);
    const double error = front.at(columns[0][k]) - columns[1][k];
    squares += error * error;
    ++points;
  }
  session.add(subject, {"front rms error", std::sqrt(squares / points), "H", "Lobovsky et al. 2014; peers 0.16 H",
                        at_most(0.16, 0.32)});
  // The wall is reached where a spacing is left.
  const double level = kWallReach - subject.spacing / kHeight;
  session.add(subject, {"arrival at the wall error", 100.0 * (front.reaches(level) / measured.reaches(level) - 1.0),
                        "%", "Lobovsky et al. 2014; peers -6.3 %", at_most(6.3, 15.0)});
}

}  // namespace

void run_dam_break_pressure(Session& session) {
  const std::vector<int> resolutions = session.quick() ? std::vector<int>{20} : std::vector<int>{20, 40, 80};
  std::vector<std::string> own{"corrected"};
  if (!session.quick()) own = {"corrected", "hybrid", "dfsph", "pbf"};
  for (const std::string& solver : session.solvers(own))
    for (const int layers : resolutions) {
      if (solver != kDefaultSolver && layers > 40) continue;
      const DamBreak dam{kHeight, kLength, kTank, layers};
      const Subject subject{"dam_break_pressure", "H/d " + std::to_string(layers), solver, dam.spacing()};
      session.attempt(subject, [&] {
        const Records records = run_column(session, dam, subject);
        compare_front(session, subject, records.front);
        for (std::size_t s = 0; s < kSensors.size(); ++s)
          compare_pressure(session, subject, s, records.pressure[s], layers >= 40 || session.quick());
      });
    }
}

}  // namespace pelagos::validation
