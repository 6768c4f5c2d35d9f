#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "harness.hpp"
#include "monotonic_clock.hpp"
#include "simulation/world.hpp"
#include "solver_names.hpp"
#include "surface_watch.hpp"

namespace pelagos::validation {

namespace {

// The paper's section VI.B with L = 1 m, turned z-up: figures 8 to 11. Its wind for all of them, as printed.
WindSettings paper_wind() {
  WindSettings wind;
  wind.law = WindLaw::kPaper;
  wind.roughness = default_roughness(wind.law);
  wind.velocity = {-18.0, -0.5, 0.0};
  wind.amplitude = 3.0;
  wind.beta = 1.5;
  wind.length = 1.0;  // m; the paper gives none
  wind.pulse = WindPulse{10.0, 100.0};
  return wind;
}

struct Setting {
  const char* name;
  Eigen::Vector3d tank, block;  ///< m
  int steps;
  double paper_step_ms;  ///< its CPU time over its steps
  bool tower;
};
const Setting kSettings[] = {{"figure 9", {5, 2, 3}, {5, 2, 0.5}, 6000, 1.94 * 3.6e6 / 6000, false},
                             {"figure 10", {5, 3, 5}, {3, 2, 0.8}, 6000, 1.17 * 3.6e6 / 6000, true},
                             {"figure 11", {6, 3, 5}, {5, 3, 0.6}, 3000, 1.18 * 3.6e6 / 3000, false}};

// The paper does not say where its lighthouse stands, nor how wide it is.
const Eigen::Vector2d kTower{3.75, 1.5};
constexpr double kTowerRadius = 0.25, kTowerHeight = 2.5;  // m

/// A prism of 24 sides about the origin, from z = 0 up.
std::string write_tower(const std::filesystem::path& file) {
  constexpr int kSides = 24;
  std::ofstream out(file);
  for (const double z : {0.0, kTowerHeight}) {
    for (int n = 0; n < kSides; ++n) {
      const double angle = 2.0 * M_PI * n / kSides;
      out << "v " << kTowerRadius * std::cos(angle) << ' ' << kTowerRadius * std::sin(angle) << ' ' << z << '\n';
    }
  }
  out << "v 0 0 0\nv 0 0 " << kTowerHeight << '\n';
  for (int n = 0; n < kSides; ++n) {
    const int a = n + 1, b = (n + 1) % kSides + 1, foot = 2 * kSides + 1, top = 2 * kSides + 2;
    out << "f " << a << ' ' << b << ' ' << b + kSides << "\nf " << a << ' ' << b + kSides << ' ' << a + kSides << "\nf "
        << foot << ' ' << b << ' ' << a << "\nf " << top << ' ' << a + kSides << ' ' << b + kSides << '\n';
  }
  return std::filesystem::absolute(file).string();
}

Scene make_scene(const Setting& setting, const Subject& subject, const std::filesystem::path& folder) {
  Scene scene;
  scene.name = setting.name;
  scene.particle_spacing = subject.spacing;
  scene.patch = {Eigen::Vector3d::Zero(), setting.tank};
  scene.water.blocks = {{Eigen::Vector3d::Zero(), setting.block}};
  scene.water.settle_steps = 50;
  if (!choose_solver(subject.solver, scene.solver)) throw std::invalid_argument("no solver " + subject.solver);
  scene.wind = paper_wind();
  if (!setting.tower) return scene;
  BodySettings tower;
  tower.id = 1;
  tower.name = "lighthouse";
  tower.mesh_file = write_tower(folder / "tower.obj");
  tower.drive = BodyDrive::kStatic;
  tower.position = {kTower.x(), kTower.y(), 0.0};
  scene.bodies = {tower};
  return scene;
}

/// A slice of the water at one instant, m in the tank's frame.
struct Snapshot {
  double time = 0.0;
  std::vector<std::array<double, 3>> points;  ///< x, z, speed
};

Snapshot take_snapshot(const World& world, double y) {
  Snapshot snapshot{world.time(), {}};
  const FluidParticles& p = world.fluid().particles;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Float4 &x = p.position[i], &v = p.velocity[i];
    if (std::abs(static_cast<double>(x.y) + world.patch().origin.y() - y) > 1.5 * world.scene().particle_spacing)
      continue;
    snapshot.points.push_back({static_cast<double>(x.x) + world.patch().origin.x(), static_cast<double>(x.z),
                               static_cast<double>(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z))});
  }
  return snapshot;
}

/// Height of the water that touches the tower, m above the tank's floor; single drops left out.
double run_up(const World& world) {
  const double reach = kTowerRadius + 2.0 * world.scene().particle_spacing;
  const FluidParticles& p = world.fluid().particles;
  std::vector<float> heights;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Eigen::Vector2d place(static_cast<double>(p.position[i].x) + world.patch().origin.x(),
                                static_cast<double>(p.position[i].y) + world.patch().origin.y());
    if ((place - kTower).norm() < reach) heights.push_back(p.position[i].z);
  }
  if (heights.size() < 10) return 0.0;
  std::nth_element(heights.begin(), heights.end() - 10, heights.end());
  return static_cast<double>(heights[heights.size() - 10]);
}

/// The best views of what the paper's figures show, gathered frame by frame.
class Watch {
 public:
  Watch(Session& session, const Subject& subject, const Setting& setting, const World& world)
      : setting_(setting),
        grid_(plan_grid(-world.patch().origin.x(), -world.patch().origin.y(), setting.tank.x(), setting.tank.y(),
                        world.scene().particle_spacing)),
        surface_(session.series(subject, "surface", "t,x,height")) {}

  void look(const World& world) {
    const FluidParticles& p = world.fluid().particles;
    const std::span<const Float4> position(p.position.data(), p.count), velocity(p.velocity.data(), p.count);
    const SurfaceProfile profile = surface_profile(grid_, position, velocity);
    if (world.frame() % 3 == 0)
      for (std::size_t i = 0; i < profile.height.size(); ++i)
        surface_.add({world.time(), (static_cast<double>(i) + 0.5) * profile.bin, profile.height[i]});
    if (const double depth = find_meeting(profile).depth; depth > meeting) {
      meeting = depth;
      at_meeting = take_snapshot(world, 0.5 * setting_.tank.y());
    }
    if (const Overhang found = find_overhang(grid_, position); found.cells > overhang) {
      overhang = found.cells;
      at_overhang = take_snapshot(world, found.y + world.patch().origin.y());
    }
    if (!setting_.tower) return;
    if (const double height = run_up(world); height > tower) {
      tower = height;
      at_tower = take_snapshot(world, kTower.y());
    }
  }

  double meeting = 0.0, tower = 0.0;
  int overhang = 0;
  Snapshot at_meeting, at_overhang, at_tower;

 private:
  const Setting& setting_;
  PlanGrid grid_;
  Series surface_;
};

void write(const Snapshot& snapshot, Series series) {
  for (const auto& [x, z, speed] : snapshot.points) series.add({x, z, speed, snapshot.time});
}

void add_results(Session& session, const Subject& subject, const Setting& setting, const Watch& watch,
                 const RunCost& cost) {
  session.add(subject, {"crests that meet: deepest trough between them", watch.meeting, "m", "figure 9a shows two"});
  session.add(subject,
              {"overturning: most columns with water over a gap", static_cast<double>(watch.overhang), "", "-"});
  if (setting.tower) session.add(subject, {"highest water at the tower", watch.tower, "m above the floor", "-"});
  session.add(subject, {"wall time of a step", 1e3 * cost.wall_s / static_cast<double>(cost.steps), "ms",
                        "paper " + std::to_string(std::lround(setting.paper_step_ms)) + " ms of CPU time"});
}

void run_one(Session& session, const Setting& setting, int steps, const Subject& subject) {
  World world(make_scene(setting, subject, session.options().out), {session.options().threads, nullptr, {}});
  Watch watch(session, subject, setting, world);
  write(take_snapshot(world, 0.5 * setting.block.y()), session.series(subject, "start", "x,z,speed,t"));
  StepSums sums;
  double wall_s = 0.0;
  while (sums.steps < static_cast<std::uint64_t>(steps)) {
    const std::int64_t begin = monotonic_ns();
    const WorldStep step = world.advance();
    wall_s += 1e-9 * static_cast<double>(monotonic_ns() - begin);
    if (step.report.not_finite > 0)
      throw std::runtime_error("values are not finite at " + std::to_string(world.time()));
    sums.add(step.report);
    if (step.frame_reached) watch.look(world);
    session.progress(subject, static_cast<double>(sums.steps) / steps);
  }
  const RunCost cost = run_cost(sums, world.fluid().particles.count, wall_s);
  write(watch.at_meeting, session.series(subject, "meeting", "x,z,speed,t"));
  write(watch.at_overhang, session.series(subject, "overhang", "x,z,speed,t"));
  if (setting.tower) write(watch.at_tower, session.series(subject, "tower", "x,z,speed,t"));
  add_results(session, subject, setting, watch, cost);
  session.add_cost(subject, cost);
}

}  // namespace

void run_paper_wind(Session& session) {
  for (const Setting& setting : kSettings)
    for (const std::string& solver : session.solvers({"hybrid"})) {
      const Subject subject{"paper_wind", setting.name, solver, session.quick() ? 0.1 : 0.05};
      session.attempt(subject, [&] { run_one(session, setting, session.quick() ? 600 : setting.steps, subject); });
    }
}

}  // namespace pelagos::validation
