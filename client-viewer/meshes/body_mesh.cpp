#include "meshes/body_mesh.hpp"

#include <array>
#include <cstdio>

#include "shapes/file_digest.hpp"
#include "text/printable.hpp"

namespace pelagos {

namespace {

namespace fs = std::filesystem;

std::string size_text(const Eigen::Vector3d& size) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.4g x %.4g x %.4g m", size.x(), size.y(), size.z());
  return text.data();
}

/// The server's own surface, or the box around it.
MeshData draw_surface(const BodySurface& surface) {
  if (surface.triangles.empty()) return draw_box(surface.low, surface.high);
  TriangleMesh mesh;
  for (const Eigen::Vector3f& vertex : surface.vertices) mesh.vertices.push_back(vertex.cast<double>());
  mesh.triangles = surface.triangles;
  const Colour grey{0.5F, 0.5F, 0.5F};
  return shade(mesh, std::span(&grey, 1));
}

std::string what_is_drawn(const BodySurface& surface) {
  return surface.triangles.empty() ? "a box of its size is drawn, since its " + std::to_string(surface.triangle_count) +
                                         " triangles are too many to be sent"
                                   : "the server's shape is drawn, without colours";
}

/// Why the file that was found is not the server's.
std::string difference(const fs::path& file, const BodyInfo& body, MeshAxes axes) {
  std::string text = printable(file.string()) + " is not the server's file of that name";
  try {
    const MeshData own = load_mesh(file, body.mesh_scale, axes);
    text += ": it is " + size_text((own.high - own.low).cast<double>()) + ", the server's " +
            size_text(body.surface->high - body.surface->low);
  } catch (const MeshError& error) {
    text += std::string(" and cannot be read (") + error.what() + ")";
  }
  return text;
}

BodyMesh draw_what_was_sent(const BodyInfo& body, const std::string& why) {
  return {draw_surface(*body.surface), why + "; " + what_is_drawn(*body.surface) +
                                           ". To have colours, give the viewer the server's file in --assets/meshes"};
}

}  // namespace

fs::path find_mesh_file(const fs::path& folder, const std::string& name) try {
  const fs::path last = fs::path(name).filename();
  if (last.empty() || last == "." || last == "..") return {};
  std::error_code error;
  const fs::path file = folder / last;
  if (!fs::is_regular_file(file, error) || error) return {};
  const fs::path real = fs::canonical(file, error), home = error ? fs::path() : fs::canonical(folder, error);
  return !error && real.parent_path() == home ? file : fs::path();
} catch (const std::exception&) {
  return {};
}

fs::path outfitted_file(const fs::path& file) {
  constexpr std::string_view kHull = "_hull";
  const std::string stem = file.stem().string();
  if (!stem.ends_with(kHull)) return file;
  const fs::path outfitted =
      find_mesh_file(file.parent_path(), stem.substr(0, stem.size() - kHull.size()) + file.extension().string());
  return outfitted.empty() ? file : outfitted;
}

BodyMesh load_body_mesh(const fs::path& folder, const BodyInfo& body) {
  const MeshName name = parse_wire_name(body.mesh_file);
  if (name.primitive) return {draw_primitive(*name.primitive), ""};
  const fs::path file = find_mesh_file(folder, name.file);
  const std::string missing = "there is no mesh " + printable(name.file) + " in " + printable(folder.string());
  if (file.empty() && !body.surface)
    throw MeshError(missing +
                    " and the server sends no shape; it is not drawn (--assets names the folder that holds "
                    "meshes/)");
  if (file.empty()) return draw_what_was_sent(body, missing);
  if (!body.surface)
    return {
        load_mesh(outfitted_file(file), body.mesh_scale, name.axes),
        "no shape came with the scene: " + printable(outfitted_file(file).string()) + " is drawn by its name alone"};
  const BodySurface& surface = *body.surface;
  if (surface.file_digest == 0 || file_digest(file) != surface.file_digest)
    return draw_what_was_sent(body, difference(file, body, name.axes));
  try {
    return {load_mesh(outfitted_file(file), body.mesh_scale, name.axes), ""};
  } catch (const MeshError& error) {
    return draw_what_was_sent(body, error.what());
  }
}

}  // namespace pelagos
