#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "harness.hpp"
#include "rigid/hydrostatics.hpp"
#include "solver_names.hpp"
#include "world_run.hpp"

namespace pelagos::validation {

namespace {

// A patch between mirrors, so that its floor area and the water's volume are exact and the level follows from them.
const Eigen::Vector3d kPatch{3.2, 3.2, 3.2};  // m
constexpr double kDepth = 1.6, kDeep = 2.4;   // m, the latter for what starts under water
constexpr double kDraftEnd = 6.0;             // s
constexpr double kGravity = 9.81, kWater = 1000.0;

Scene small_patch(const Subject& subject, double depth = kDepth) {
  Scene scene;
  scene.name = subject.setup;
  scene.particle_spacing = subject.spacing;
  scene.patch = {Eigen::Vector3d::Zero(), kPatch};
  scene.patch_edges = {PatchEdge::kMirror, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks = {{Eigen::Vector3d::Zero(), {kPatch.x(), kPatch.y(), depth}}};
  scene.water.settle_steps = 200;
  if (!choose_solver(subject.solver, scene.solver)) throw std::invalid_argument("no solver " + subject.solver);
  return scene;
}

BodySettings body_of(const Primitive& shape, const Eigen::Vector3d& position, double density) {
  BodySettings body;
  body.id = 1;
  body.name = "body";
  body.primitive = shape;
  body.position = position;
  body.drive = BodyDrive::kFree;
  body.mass.density = density;
  return body;
}

/// One body in the patch, advanced, with the means over a span of time.
class FloatingRun {
 public:
  FloatingRun(Session& session, const Subject& subject, const Scene& scene, double end)
      : session_(session),
        subject_(subject),
        end_(end),
        mesh_(make_mesh(*scene.bodies[0].primitive)),
        run_(session.options().threads, scene) {}
  ~FloatingRun() { session_.add_cost(subject_, run_.cost()); }
  FloatingRun(const FloatingRun&) = delete;
  FloatingRun& operator=(const FloatingRun&) = delete;

  [[nodiscard]] BodyState state() { return run_.world().bodies().states()[0]; }

  template <class Each>
  void advance_to(double time, Each&& each) {
    run_.advance_to(time, [&](const StepReport& report) {
      each(report);
      session_.progress(subject_, run_.world().time() / end_);
    });
  }
  void advance_to(double time) {
    advance_to(time, [](const StepReport&) {});
  }

  /// Volume of the water, m^3.
  [[nodiscard]] double water() {
    const FluidState& fluid = run_.world().fluid();
    return static_cast<double>(fluid.particles.count) * fluid.parameters.volume();
  }

  /// The body up to a level, m above the floor, as it stands now.
  [[nodiscard]] Hydrostatics up_to(double level) {
    const BodyState now = state();
    return hydrostatics(mesh_, {now.orientation.conjugate() * Eigen::Vector3d::UnitZ(), level - now.position.z()});
  }

  /// Where the water stands around the body: what it and the body fill up to there is what there is of both.
  [[nodiscard]] double level() {
    double low = 0.0, high = kPatch.z();
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (kPatch.x() * kPatch.y() * middle - up_to(middle).volume < water() ? low : high) = middle;
    }
    return low;
  }

  /// Mean force and moment of the water on the body in a step, world axes, about its centre of mass or origin.
  [[nodiscard]] Eigen::Vector3d impulse() { return run_.world().fluid().coupling.bodies[0].impulse; }
  [[nodiscard]] Eigen::Vector3d angular_impulse() { return run_.world().fluid().coupling.bodies[0].angular_impulse; }
  [[nodiscard]] double time() { return run_.world().time(); }

  void add(const Metric& metric) { session_.add(subject_, metric); }
  [[nodiscard]] Series series(const char* name, const char* columns) {
    return session_.series(subject_, name, columns);
  }

 private:
  Session& session_;
  const Subject& subject_;
  double end_;
  TriangleMesh mesh_;
  WorldRun run_;
};

const BoxShape kBox{{1.2, 1.2, 0.8}};  // m; so flat that it floats upright at any density

/// A box afloat: its draft, and how far it drifts without anything that drives it.
void run_draft(Session& session, const Subject& subject, double ratio) {
  Scene scene = small_patch(subject);
  const double height = kBox.size.z();
  scene.bodies = {body_of(kBox, {1.6, 1.6, kDepth + height * (0.5 - ratio)}, ratio * kWater)};
  FloatingRun run(session, subject, scene, kDraftEnd);
  Series series = run.series("draft", "t,draft");
  const double displaced = ratio * kBox.size.prod();
  const double level = (run.water() + displaced) / (kPatch.x() * kPatch.y());
  double sum = 0.0, time = 0.0;
  run.advance_to(kDraftEnd, [&](const StepReport& step) {
    const double draft = level - (run.state().position.z() - 0.5 * height);
    series.add({run.time(), draft / (ratio * height)});
    if (run.time() < 0.5 * kDraftEnd) return;
    sum += step.dt * draft;
    time += step.dt;
  });
  const double draft = sum / time;
  const Eigen::Vector2d way = (run.state().position - scene.bodies[0].position).head<2>();
  run.add(
      {"draft error", 100.0 * (draft / (ratio * height) - 1.0), "%", "mass over density and area", at_most(0.5, 10.0)});
  run.add({"drift in 6 s", 100.0 * way.norm() / kBox.size.x(), "% of L", "0", at_most(0.5, 20.0)});
}

struct HeldLoads {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  ///< N, N m, world axes
};

/// Means from 2 to 4 s.
HeldLoads held_loads(FloatingRun& run) {
  HeldLoads sum;
  run.advance_to(2.0);
  const double begin = run.time();
  run.advance_to(4.0, [&](const StepReport&) {
    sum.force += run.impulse();
    sum.moment += run.angular_impulse();
  });
  const double time = run.time() - begin;
  return {sum.force / time, sum.moment / time};
}

/// A sphere held half-sunk: how deep inside a curved surface its samples have to lie.
void run_held_sphere(Session& session, const Subject& subject) {
  Scene scene = small_patch(subject);
  scene.bodies = {body_of(SphereShape{0.8}, {1.6, 1.6, kDepth}, kWater)};
  scene.bodies[0].drive = BodyDrive::kPose;
  FloatingRun run(session, subject, scene, 4.0);
  const double force = held_loads(run).force.z();
  const double weight = kWater * kGravity * run.up_to(run.level()).volume;
  run.add({"force error", 100.0 * (force / weight - 1.0), "%", "Archimedes", at_most(1.0, 10.0)});
}

/// A hull that is held, upright or heeled: the mean force and moment of still water.
void run_held(Session& session, const Subject& subject, double heel_deg) {
  Scene scene = small_patch(subject);
  const BoxShape barge{{1.2, 1.2, 1.6}};
  scene.bodies = {body_of(barge, {1.6, 1.6, kDepth - 0.2}, kWater)};
  scene.bodies[0].drive = BodyDrive::kPose;
  scene.bodies[0].orientation = Eigen::AngleAxisd(heel_deg * M_PI / 180.0, Eigen::Vector3d::UnitX());
  FloatingRun run(session, subject, scene, 4.0);
  const HeldLoads loads = held_loads(run);
  const Hydrostatics still = run.up_to(run.level());
  const double weight = kWater * kGravity * still.volume;
  run.add({"force error", 100.0 * (loads.force.z() / weight - 1.0), "%", "Archimedes", at_most(1.0, 10.0)});
  if (heel_deg == 0.0) {
    run.add({"draft in spacings", still.volume / (1.2 * 1.2) / subject.spacing, "d", "-"});
    return;
  }
  const double righting = (run.state().orientation * still.centre_of_buoyancy).cross(Eigen::Vector3d(0, 0, weight)).x();
  run.add({"righting moment error", 100.0 * (loads.moment.x() / righting - 1.0), "%",
           "moment of the displaced water about the barge's middle", at_most(5.0, 40.0)});
}

/// A sphere under water let go after two seconds.
FloatingRun& let_go(FloatingRun& run, double seconds) {
  run.advance_to(2.0);
  run.advance_to(2.0 + seconds);
  return run;
}

Scene sunken_sphere(const Subject& subject, double ratio) {
  Scene scene = small_patch(subject, kDeep);
  scene.bodies = {body_of(SphereShape{0.5}, {1.6, 1.6, 0.5 * kDeep}, ratio * kWater)};
  scene.bodies[0].free_from = 2.0;
  return scene;
}

void run_first_acceleration(Session& session, const Subject& subject) {
  FloatingRun run(session, subject, sunken_sphere(subject, 0.5), 2.05);
  let_go(run, 0.05);
  run.add({"first acceleration error", 100.0 * (run.state().velocity.z() / (run.time() - 2.0) / 4.905 - 1.0), "%",
           "added mass of half the displaced water (Lamb 1932, art. 92)", at_most(10.0, 40.0)});
}

/// Which density neither rises nor sinks, between 0.98 and 1.02.
void run_neutral(Session& session, const Subject& subject) {
  double way[2] = {0.0, 0.0};
  const double ratios[2] = {0.98, 1.02};
  for (int k = 0; k < 2; ++k) {
    const Scene scene = sunken_sphere(subject, ratios[k]);
    FloatingRun run(session, subject, scene, 3.5);
    way[k] = let_go(run, 1.5).state().position.z() - scene.bodies[0].position.z();
    if (k == 0) continue;
    const double neutral = ratios[0] + (ratios[1] - ratios[0]) * way[0] / (way[0] - way[1]);
    run.add({"rise at 0.98", way[0] / 0.5, "R in 1.5 s", "more than 0", at_least(0.02, 0.0)});
    run.add({"neutral density ratio, off by", neutral - 1.0, "", "1", at_most(0.02, 0.05)});
  }
}

/// Half-sunk sphere, let go 0.2 R below where it floats: the first whole oscillation, before walls answer.
void run_heave(Session& session, const Subject& subject) {
  constexpr double kRadius = 0.5, kDrop = 0.2;
  Scene scene = small_patch(subject);
  scene.bodies = {body_of(SphereShape{kRadius}, {1.6, 1.6, kDepth - kDrop * kRadius}, 0.5 * kWater)};
  scene.bodies[0].free_from = 2.0;
  FloatingRun run(session, subject, scene, 4.0);
  Series series = run.series("heave", "t,z");
  run.advance_to(2.0);
  const double level = (run.water() + 0.5 * 4.0 / 3.0 * M_PI * std::pow(kRadius, 3)) / (kPatch.x() * kPatch.y());
  std::optional<double> crossings[2];
  double before = -1.0, before_time = 2.0, highest = 0.0, lowest_after = 0.0;
  run.advance_to(4.0, [&](const StepReport&) {
    const double z = run.state().position.z() - level, now = run.time();
    series.add({now - 2.0, z / kRadius});
    if ((z > 0.0) != (before > 0.0) && now > 2.05)
      for (std::optional<double>& crossing : crossings)
        if (!crossing) {
          crossing = before_time + (now - before_time) * before / (before - z);
          break;
        }
    highest = std::max(highest, z);
    if (crossings[1]) lowest_after = std::min(lowest_after, z);
    before = z;
    before_time = now;
  });
  const double expected = 6.15 * std::sqrt(kRadius / kGravity);
  const double period = crossings[1] ? 2.0 * (*crossings[1] - *crossings[0]) : NAN;
  run.add({"heave period error", 100.0 * (period / expected - 1.0), "%",
           "measured: 0.76 s for 0.3 m of diameter (Kramer et al. 2021)", at_most(5.0, 30.0)});
  run.add({"first swing up over the drop", highest / (kDrop * kRadius), "", "-"});
  run.add({"second swing down over the drop", -lowest_after / (kDrop * kRadius), "", "-"});
}

/// A hull held in a current: what drags on it, stated and not claimed. The channel is narrow: the barge takes a fifth
/// of its cross section.
void run_current(Session& session, const Subject& subject) {
  constexpr double kSpeed = 0.5;  // m/s
  Scene scene = small_patch(subject);
  scene.patch.max = {6.4, 4.0, 2.4};
  scene.patch_edges = {PatchEdge::kPeriodic, PatchEdge::kMirror, PatchEdge::kMirror};
  scene.water.blocks[0].max = {6.4, 4.0, kDepth};
  scene.current.emplace();
  scene.current->velocity = {kSpeed, 0.0, 0.0};
  scene.current->relaxation = 1.0;
  const BoxShape barge{{1.6, 1.2, 1.6}};
  scene.bodies = {body_of(barge, {3.2, 2.0, kDepth - 0.2}, kWater)};
  scene.bodies[0].drive = BodyDrive::kPose;
  FloatingRun run(session, subject, scene, 8.0);
  run.advance_to(4.0);
  double force = 0.0;
  const double begin = run.time();
  run.advance_to(8.0, [&](const StepReport&) { force += run.impulse().x(); });
  const double area = 1.2 * 1.0;  // m^2, wetted front
  const double coefficient = force / (run.time() - begin) / (0.5 * kWater * kSpeed * kSpeed * area);
  run.add({"drag coefficient on the wetted front", coefficient, "", "stated, not claimed"});
}

struct Setup {
  const char* name;
  void (*run)(Session&, const Subject&);
  bool quick;
  bool fine = true;  ///< also at half the spacing: a run there costs about ten times as much
};
const Setup kSetups[] = {
    {"box 0.2", [](Session& s, const Subject& subject) { run_draft(s, subject, 0.2); }, false},
    {"box 0.5", [](Session& s, const Subject& subject) { run_draft(s, subject, 0.5); }, true},
    {"box 0.8", [](Session& s, const Subject& subject) { run_draft(s, subject, 0.8); }, false},
    {"barge held", [](Session& s, const Subject& subject) { run_held(s, subject, 0.0); }, true},
    {"barge heeled 10 deg", [](Session& s, const Subject& subject) { run_held(s, subject, 10.0); }, false},
    {"sphere held", run_held_sphere, false},
    {"barge in a current", run_current, false, false},
    {"sphere let go", run_first_acceleration, true},
    {"sphere neutral", run_neutral, false, false},
    {"sphere heaving", run_heave, false},
};

}  // namespace

void run_floating(Session& session) {
  for (const Setup& setup : kSetups) {
    if (session.quick() && !setup.quick) continue;
    for (const std::string& solver : session.solvers({"corrected"}))
      for (const double spacing : {0.1, 0.05}) {
        if (spacing < 0.1 && (session.quick() || !setup.fine)) continue;
        const Subject subject{"floating", fmt::format("{}, d {:g}", setup.name, spacing), solver, spacing};
        session.attempt(subject, [&] { setup.run(session, subject); });
      }
  }
}

}  // namespace pelagos::validation
