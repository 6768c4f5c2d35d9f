// How the sea beyond open edges carries bodies.

#include "simulation/bodies.hpp"
#include "simulation/wetted_body.hpp"

namespace pelagos {

namespace {

constexpr double kIntoHold = 0.25;  ///< panel edges off a panel, where its hold would be

/// The sea around does not run into a hold: its panels are dry.
void leave_hold_out(const Hold& hold, SeaPanels& panels) {
  TriangleMesh& mesh = panels.mesh;
  std::vector<std::array<std::uint32_t, 3>> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
    if (!hold.contains(middle + kIntoHold * panels.edge * mesh.area_vector(t).normalized()))
      kept.push_back(mesh.triangles[t]);
  }
  mesh.triangles = kept;
}

/// @param change  of the velocity, along and about
void add_motion(const Vector6d& change, FreeBody& body) {
  body.take(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), body.velocity() + change.head<3>(),
            body.angular_velocity() + change.tail<3>());
}

}  // namespace

void Bodies::make_sea_bodies(double density) {
  for (Body& body : bodies_) {
    if (!body.moves() || body.shape.kind != MeshKind::kClosed) continue;
    body.sea_body = make_sea_body(body.shape.mesh, body.free ? body.free->mass().mass : 0.0, density);
    if (!body.hold.empty()) leave_hold_out(body.hold, body.sea_body->panels);
  }
}

bool Bodies::is_inside(const Body& body, const PatchFrame& frame, const CouplingFade& fade) {
  const Eigen::AlignedBox3d box = box_around(body.shape, body.state.position, body.state.orientation);
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector3f x =
        frame.to_local(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))).cast<float>();
    if (fade.share(x.x(), x.y()) != 1.0F) return false;
  }
  return true;
}

std::vector<Eigen::AlignedBox3d> Bodies::boxes_at_edges(const PatchFrame& frame, const CouplingFade& fade) const {
  std::vector<Eigen::AlignedBox3d> boxes;
  if (!fade.acts()) return boxes;
  for (const Body& body : bodies_)
    if (!is_inside(body, frame, fade))
      boxes.push_back(box_around(body.shape, body.state.position, body.state.orientation));
  return boxes;
}

SeaLoad Bodies::sea_load(const Body& body, const PatchFrame& frame, const CouplingFade& fade,
                         const CarryingSea& around) {
  const Eigen::Vector3d about = body.free ? body.free->centre() : body.state.position;
  return sea_loader_.load(body.sea_body->panels, body.state, about, around, [&](const Eigen::Vector2d& place) {
    const Eigen::Vector2f local = frame.to_local(place).cast<float>();
    return 1.0 - static_cast<double>(fade.share(local.x(), local.y()));
  });
}

void Bodies::feel_sea(double dt, const PatchFrame& frame, const CouplingFade& fade, const CarryingSea& around,
                      Body& body) {
  body.sea_impulse.setZero();
  if (!body.sea_body || is_inside(body, frame, fade)) return;
  const SeaLoad load = sea_load(body, frame, fade, around);
  body.sea_impulse = dt * load.force;
  if (!body.gives_way()) return;
  const Vector6d push = sea_push(*body.sea_body, *body.free, load, around, dt);
  body.sea_impulse = impulse_of(*body.free, push, body.sea_impulse);
  add_motion(push, *body.free);
  body.free->write_to(body.state);
}

void Bodies::start_at_sea(const PatchFrame& frame, const CouplingFade& fade, const CarryingSea& around) {
  for (Body& body : bodies_) {
    if (!body.sea_body || !body.drifts() || is_inside(body, frame, fade)) continue;
    const SeaLoad load = sea_load(body, frame, fade, around);
    add_motion(carried_share(*body.sea_body, load, around) * load.water, *body.free);
    body.free->write_to(body.state);
  }
}

}  // namespace pelagos
