#include "mesh_report.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "rigid/body_shape.hpp"
#include "rigid/hydrostatics.hpp"
#include "rigid/mass_properties.hpp"
#include "rigid/mesh_query.hpp"
#include "rigid/mesh_union.hpp"

namespace pelagos {

namespace {

std::string text_of(const Eigen::Vector3d& given) {
  constexpr double kNothing = 1e-12;  // of the largest: what rounding leaves
  const double least = kNothing * std::max(1.0, given.cwiseAbs().maxCoeff());
  const Eigen::Vector3d v = (given.array().abs() < least).select(0.0, given);
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

/// One line of the report.
void line(std::ostream& out, const char* name, const std::string& value) { fmt::print(out, "{:<22}{}\n", name, value); }

MeshFile load(const std::string& file, const MeshOptions& options) {
  if (const auto primitive = parse_primitive(file)) return {make_mesh(*primitive), {}};
  if (file.starts_with("primitive:"))
    return {{},
            {{file,
              "is no shape; allowed: primitive:box:LENGTHxBREADTHxHEIGHT, primitive:sphere:RADIUS, "
              "primitive:cylinder:RADIUSxLENGTH, primitive:capsule:RADIUSxLENGTH, in metres, above 0"}}};
  return read_mesh(file, options);
}

Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

bool report_faults(const Refusals& faults, std::ostream& out) {
  if (faults.empty()) return false;
  line(out, "faults", fmt::format("{}", faults.size()));
  for (const Refusal& fault : faults) fmt::print(out, "  {}\n", to_string(fault));
  return true;
}

std::string count_parts(const std::vector<MeshPart>& parts) {
  const auto count = [&](PartRole role) {
    return std::count_if(parts.begin(), parts.end(), [&](const MeshPart& part) { return part.role == role; });
  };
  if (parts.size() == 1) return "1";
  return fmt::format("{}: solid {}, cavity {}, without effect {}", parts.size(), count(PartRole::kSolid),
                     count(PartRole::kCavity), count(PartRole::kSwallowed));
}

void report_cuts(const MeshFile& file, std::span<const std::uint32_t> part, std::ostream& out) {
  const SelfIntersections cuts = MeshQuery(file.mesh).find_self_intersections(part);
  line(out, "cuts itself",
       cuts.pairs == 0 ? (cuts.all ? "no" : "not known: too many triangles lie near each other to look at all")
                       : fmt::format("{}{} pairs of triangles, the first {} and {}; where a part overlaps itself its "
                                     "volume counts twice, and water may leak through",
                                     cuts.all ? "" : "at least ", cuts.pairs, file.origin.describe(cuts.first[0]),
                                     file.origin.describe(cuts.first[1])));
}

void report_size(const TriangleMesh& mesh, std::ostream& out) {
  const Eigen::AlignedBox3d box = bounds_of(mesh);
  line(out, "triangles", fmt::format("{}, {} vertices", mesh.triangles.size(), mesh.vertices.size()));
  line(out, "bounds", text_of(box.min()) + " to " + text_of(box.max()) + " m");
  line(out, "length, beam, height", text_of(box.sizes()) + " m");
}

void report_area(const TriangleMesh& mesh, std::ostream& out) {
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

/// Of a closed mesh without faults. @return whether it can be a body
bool report_solid(const std::string& name, const MeshFile& file, const MeshQuestions& questions, std::ostream& out) {
  MeshUnion united = unite_parts(file.mesh, file.origin);
  for (Refusal& fault : united.faults) fault = put_behind(name, ": ", fault);  // as the server does
  if (report_faults(united.faults, out)) return false;
  line(out, "watertight", "yes, no faults");
  line(out, "parts", count_parts(united.parts));
  for (const std::string& note : united.notes) fmt::print(out, "  {}\n", note);
  report_cuts(file, united.part, out);
  report_area(united.outside(), out);
  report_volume(united.mesh, out);
  if (united.outer) line(out, "  cavities filled", fmt::format("{:.5g} m^3", mesh_volume(*united.outer)));
  if (questions.waterline || questions.draft) report_water(united.outside(), questions, out);
  return true;
}

/// @return whether the mesh can be sampled
bool report_samples(const MeshFile& file, const MeshQuestions& questions, std::ostream& out) {
  const BodyShape shape =
      make_body_shape(file.mesh, questions.spacing, questions.inset, questions.options.kind, file.origin);
  for (const Refusal& fault : shape.faults) line(out, "cannot be sampled", to_string(fault));
  if (!shape.faults.empty()) return false;
  line(out, "samples",
       fmt::format("{} at a spacing of {:g} m, {:g} spacings inside", shape.samples.size(), questions.spacing,
                   shape.inset));
  return true;
}

}  // namespace

bool report_mesh(const std::string& name, const MeshQuestions& questions, std::ostream& out) {
  const MeshFile file = load(name, questions.options);
  const bool finite = std::all_of(file.mesh.vertices.begin(), file.mesh.vertices.end(),
                                  [](const Eigen::Vector3d& v) { return v.allFinite(); });
  line(out, "mesh", name);
  if (!file.mesh.triangles.empty() && finite) report_size(file.mesh, out);
  if (report_faults(file.faults, out)) return false;
  for (const std::string& note : file.notes) line(out, "note", note);
  if (questions.options.kind == MeshKind::kClosed) {
    if (!report_solid(name, file, questions, out)) return false;
  } else {
    line(out, "open, one-sided", "yes, no faults");
    report_cuts(file, {}, out);
    report_area(file.mesh, out);
  }
  return questions.spacing <= 0.0 || report_samples(file, questions, out);
}

}  // namespace pelagos
