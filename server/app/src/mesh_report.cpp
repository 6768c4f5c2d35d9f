#include "mesh_report.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "rigid/body_shape.hpp"
#include "rigid/hydrostatics.hpp"
#include "rigid/mass_properties.hpp"
#include "rigid/mesh_query.hpp"

namespace pelagos {

namespace {

std::string text_of(const Eigen::Vector3d& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z()); }

/// One line of the report.
void line(std::ostream& out, const char* name, const std::string& value) { fmt::print(out, "{:<22}{}\n", name, value); }

MeshFile load(const std::string& file, const MeshOptions& options) {
  if (const auto primitive = parse_primitive(file)) return {make_mesh(*primitive), {}};
  return read_mesh(file, options);
}

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

void report_soundness(const MeshFile& file, MeshKind kind, std::ostream& out) {
  if (!file.faults.empty()) {
    line(out, "faults", fmt::format("{}", file.faults.size()));
    for (const std::string& fault : file.faults) fmt::print(out, "  {}\n", fault);
    return;
  }
  line(out, kind == MeshKind::kClosed ? "watertight" : "open, one-sided", "yes, no faults");
  std::array<std::uint32_t, 2> first{};
  const std::size_t pairs = MeshQuery(file.mesh).count_self_intersections(&first);
  line(out, "cuts itself",
       pairs == 0 ? "no"
                  : fmt::format("{} pairs of triangles, the first {} and {}; water sees the union, but volumes count "
                                "overlap twice",
                                pairs, first[0] + 1, first[1] + 1));
}

void report_size(const TriangleMesh& mesh, std::ostream& out) {
  const Eigen::AlignedBox3d box = bounds_of(mesh);
  line(out, "triangles", fmt::format("{}, {} vertices", mesh.triangles.size(), mesh.vertices.size()));
  line(out, "bounds", text_of(box.min()) + " to " + text_of(box.max()) + " m");
  line(out, "length, beam, height", text_of(box.sizes()) + " m");
  line(out, "area", fmt::format("{:.5g} m^2", mesh_area(mesh)));
}

void report_volume(const TriangleMesh& mesh, std::ostream& out) {
  const MassProperties solid = mass_properties(mesh);
  line(out, "volume", fmt::format("{:.5g} m^3", solid.volume));
  line(out, "centre of volume", text_of(solid.centre) + " m");
  const Eigen::Vector3d radii = (solid.inertia.diagonal() / solid.volume).cwiseSqrt();
  line(out, "radii of gyration", text_of(radii) + " m about x, y, z, if of one density");
}

void report_water(const TriangleMesh& mesh, const MeshQuestions& questions, std::ostream& out) {
  const double low = bounds_of(mesh).min().z();
  const double level = questions.waterline ? *questions.waterline : low + *questions.draft;
  const Hydrostatics h = hydrostatics(mesh, {Eigen::Vector3d::UnitZ(), level});
  line(out, "water at z", fmt::format("{:.4g} m, draft {:.4g} m", level, level - low));
  line(out, "  displacement", fmt::format("{:.5g} m^3, {:.5g} t", h.volume, 1e-3 * questions.density * h.volume));
  line(out, "  centre of buoyancy", text_of(h.centre_of_buoyancy) + " m");
  line(out, "  waterplane", fmt::format("{:.5g} m^2", h.waterplane_area));
  line(out, "  centre of flotation", text_of(h.centre_of_flotation) + " m");
  if (h.volume > 0.0)
    line(out, "  metacentric radius",
         fmt::format("{:.4g} m across, {:.4g} m along", h.waterplane_moments(1, 1) / h.volume,
                     h.waterplane_moments(0, 0) / h.volume));
  line(out, "  wetted area", fmt::format("{:.5g} m^2", h.wetted_area));
}

/// @return whether the mesh can be sampled
bool report_samples(const TriangleMesh& mesh, const MeshQuestions& questions, std::ostream& out) {
  const BodyShape shape = make_body_shape(mesh, questions.spacing, questions.inset, questions.options.kind);
  for (const std::string& fault : shape.faults) line(out, "cannot be sampled", fault);
  if (!shape.faults.empty()) return false;
  line(out, "samples",
       fmt::format("{} at a spacing of {:g} m, {:g} spacings inside", shape.samples.size(), questions.spacing,
                   questions.inset));
  return true;
}

}  // namespace

bool report_mesh(const std::string& name, const MeshQuestions& questions, std::ostream& out) {
  const MeshFile file = load(name, questions.options);
  const bool closed = questions.options.kind == MeshKind::kClosed;
  const bool finite = std::all_of(file.mesh.vertices.begin(), file.mesh.vertices.end(),
                                  [](const Eigen::Vector3d& v) { return v.allFinite(); });
  line(out, "mesh", name);
  if (!file.mesh.triangles.empty() && finite) report_size(file.mesh, out);
  report_soundness(file, questions.options.kind, out);
  if (!file.faults.empty()) return false;
  if (closed) report_volume(file.mesh, out);
  if (closed && (questions.waterline || questions.draft)) report_water(file.mesh, questions, out);
  return questions.spacing <= 0.0 || report_samples(file.mesh, questions, out);
}

}  // namespace pelagos
