#include "meshes/mesh_loader.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>

#include "meshes/body_mesh.hpp"

namespace pelagos {

namespace {

/// What makes two bodies have the same mesh.
using MeshKey = std::tuple<std::string, double, const BodySurface*>;
MeshKey key_of(const BodyInfo& body) { return {body.mesh_file, body.mesh_scale, body.surface.get()}; }

/// As MeshKey, for surfaces that came twice: the same file of the same size is the same mesh.
bool same_mesh(const BodyInfo& a, const BodyInfo& b) {
  if (a.mesh_file != b.mesh_file || a.mesh_scale != b.mesh_scale) return false;
  if (!a.surface || !b.surface) return a.surface == b.surface;
  return a.surface->file_digest == b.surface->file_digest && a.surface->low == b.surface->low &&
         a.surface->high == b.surface->high && a.surface->vertices == b.surface->vertices &&
         a.surface->triangles == b.surface->triangles;
}

/// What a mesh that is too much is drawn as; nothing if there is nothing to draw.
std::shared_ptr<const MeshData> box_around(const MeshData& data) {
  return std::make_shared<const MeshData>(draw_box(data.low.cast<double>(), data.high.cast<double>()));
}

}  // namespace

class MeshLoader::Implementation {
 public:
  explicit Implementation(std::filesystem::path folder) : folder_(std::move(folder)), thread_([this] { run(); }) {}

  ~Implementation() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
      wanted_.clear();
    }
    wake_.notify_all();
    thread_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void want(const std::vector<BodyInfo>& bodies) {
    const std::lock_guard lock(mutex_);
    std::vector<Mesh> kept;
    for (const BodyInfo& body : bodies) {
      if (find(kept, body) != nullptr) continue;
      Mesh* known = find(wanted_, body);
      kept.push_back(known != nullptr ? std::move(*known) : Mesh{body, false, nullptr});
    }
    wanted_ = std::move(kept);
    bodies_ = bodies;
    ++revision_;
    wake_.notify_all();
  }

  BodyMeshes meshes() {
    const std::lock_guard lock(mutex_);
    BodyMeshes result;
    std::size_t triangles = 0;
    for (const BodyInfo& body : bodies_) {
      const Mesh* mesh = find(wanted_, body);
      if (mesh == nullptr || !mesh->data) continue;
      const bool fits = triangles + mesh->data->triangle_count() <= kMostTriangles;
      triangles += fits ? mesh->data->triangle_count() : 0;
      result[body.id] = fits ? mesh->data : box_around(*mesh->data);
      if (!fits && std::exchange(told_too_many_, true) == false)
        notes_.push_back("the bodies have more than " + std::to_string(kMostTriangles) + " triangles together; body " +
                         std::to_string(body.id) + " and others are drawn as boxes");
    }
    return result;
  }

  std::uint64_t revision() const {
    const std::lock_guard lock(mutex_);
    return revision_;
  }
  bool done() const {
    const std::lock_guard lock(mutex_);
    return next() == nullptr;
  }
  std::vector<std::string> take_notes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notes_, {});
  }

 private:
  struct Mesh {
    BodyInfo body;  ///< the first that has it
    bool tried = false;
    std::shared_ptr<const MeshData> data;  ///< null: not read yet, or it cannot be
  };

  static Mesh* find(std::vector<Mesh>& meshes, const BodyInfo& body) {
    for (Mesh& mesh : meshes)
      if (key_of(mesh.body) == key_of(body) || same_mesh(mesh.body, body)) return &mesh;
    return nullptr;
  }
  [[nodiscard]] const Mesh* next() const {
    for (const Mesh& mesh : wanted_)
      if (!mesh.tried) return &mesh;
    return nullptr;
  }

  [[nodiscard]] std::size_t stored_triangles() const {
    std::size_t sum = 0;
    for (const Mesh& mesh : wanted_) sum += mesh.data ? mesh.data->triangle_count() : 0;
    return sum;
  }

  void run() {
    std::unique_lock lock(mutex_);
    while (!stop_) {
      const Mesh* mesh = next();
      if (mesh == nullptr) {
        wake_.wait(lock);
        continue;
      }
      const BodyInfo body = mesh->body;
      lock.unlock();
      auto [data, note] = load(body);
      lock.lock();
      Mesh* still_wanted = find(wanted_, body);
      if (still_wanted == nullptr) continue;
      still_wanted->tried = true;
      if (data && stored_triangles() + data->triangle_count() > kMostTriangles) {
        data = box_around(*data);
        note = "its mesh is too much beside the others, a box is drawn; all meshes together may have " +
               std::to_string(kMostTriangles) + " triangles";
      }
      still_wanted->data = std::move(data);
      if (!note.empty()) notes_.push_back("body " + std::to_string(body.id) + ": " + note);
      ++revision_;
    }
  }

  [[nodiscard]] std::pair<std::shared_ptr<const MeshData>, std::string> load(const BodyInfo& body) const {
    try {
      BodyMesh mesh = load_body_mesh(folder_, body);
      return {std::make_shared<const MeshData>(std::move(mesh.data)), std::move(mesh.note)};
    } catch (const std::exception& error) {  // out of memory too: this body is not drawn, others are
      return {nullptr, error.what()};
    }
  }

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::vector<BodyInfo> bodies_;
  std::vector<Mesh> wanted_;
  std::vector<std::string> notes_;
  bool told_too_many_ = false;
  std::uint64_t revision_ = 0;
  bool stop_ = false;

  std::thread thread_;
};

MeshLoader::MeshLoader(std::filesystem::path folder)
    : implementation_(std::make_unique<Implementation>(std::move(folder))) {}
MeshLoader::~MeshLoader() = default;
void MeshLoader::want(const std::vector<BodyInfo>& bodies) { implementation_->want(bodies); }
BodyMeshes MeshLoader::meshes() const { return implementation_->meshes(); }
std::uint64_t MeshLoader::revision() const { return implementation_->revision(); }
bool MeshLoader::done() const { return implementation_->done(); }
std::vector<std::string> MeshLoader::take_notes() { return implementation_->take_notes(); }

}  // namespace pelagos
