#include <charconv>

#include "import_fault.hpp"
#include "readers.hpp"
#include "text_lines.hpp"

namespace pelagos {

namespace {

/// Wavefront OBJ: the statements v, f (and its old name fo), o, g, usemtl and mtllib; all others are passed over,
/// curves and surfaces too.
class ObjReader {
 public:
  ObjReader(MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh)
      : folder_(folder), with_materials_(options.materials), mesh_(mesh) {}

  void read() {
    OpenFile file(folder_, folder_.mesh_file());
    TextLines lines(file, true);
    while (lines.next()) read_line(lines.text(), lines.number());
    add_faces();
    if (with_materials_)
      for (const std::string& library : libraries_) add_library(library);
  }

 private:
  struct Face {
    std::size_t first, count;  ///< of its corners
    TriangleTags tags;
  };

  void read_line(std::string_view text, std::size_t line) {
    const std::string_view word = next_word(text);
    if (word == "v") {
      add_vertex(text, line);
    } else if (word == "f" || word == "fo") {
      add_face(text, line);
    } else if (word == "o" || word == "g") {
      (word == "o" ? object_ : group_) = std::string(trimmed(text));
      if (word == "o") group_.clear();
      part_is_known_ = false;
    } else if (word == "usemtl" && with_materials_) {
      material_ = mesh_.material(std::string(trimmed(text)));
    } else if (word == "mtllib" && with_materials_) {
      add_library_names(trimmed(text));
    } else if (word == "surf" || word == "curv" || word == "curv2") {
      if (first_free_form_ == 0) first_free_form_ = line;
    }
  }

  void add_vertex(std::string_view text, std::size_t line) {
    Eigen::Vector3d vertex;
    for (double& c : vertex) c = read_number(next_word(text), line);
    mesh_.add_vertex(vertex);  // what follows is a weight or a colour
  }

  /// A corner as "v", "v/t", "v//n" or "v/t/n"; the vertex counts from 1, or back from the last with a minus.
  [[nodiscard]] std::uint32_t vertex_of(std::string_view word, std::size_t line) const {
    const std::string_view digits = word.substr(0, word.find('/'));
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size())
      throw ImportFault(line, in_quotes(word) + " is no corner of a face; allowed are such as 7, 7/2, 7//3, 7/2/3, -1");
    const auto known = static_cast<std::int64_t>(mesh_.vertices());
    if (number < 0) number += known + 1;
    if (number < 1 || number > static_cast<std::int64_t>(MeshLimits::kVertices))
      throw ImportFault(line, "the face names vertex " + shown(digits) + ", but there are " + std::to_string(known) +
                                  " vertices before it; the first is 1, the last -1");
    return static_cast<std::uint32_t>(number - 1);
  }

  void add_face(std::string_view text, std::size_t line) {
    const std::size_t first = corners_.size();
    for (std::string_view word = next_word(text); !word.empty() && word[0] != '#'; word = next_word(text))
      corners_.push_back(vertex_of(word, line));
    const std::size_t count = corners_.size() - first;
    check_corners(count, name_of(line));
    if (count < 3) {  // a point or a line, which has no area
      corners_.resize(first);
      return;
    }
    triangles_ += count - 2;
    check_triangles(triangles_);
    faces_.push_back({first, count, {part(), static_cast<std::uint32_t>(line), material_}});
  }

  /// Once all vertices are known: a face may stand before its vertices.
  void add_faces() {
    if (faces_.empty() && first_free_form_ > 0)
      throw ImportFault(first_free_form_,
                        "has curves or surfaces, and there are no faces (lines that begin with f); "
                        "save the mesh as polygons");
    for (const Face& face : faces_) {
      const auto corners = std::span(corners_).subspan(face.first, face.count);
      for (const std::uint32_t corner : corners)
        if (corner >= mesh_.vertices())
          throw ImportFault(face.tags.place, "the face names vertex " + std::to_string(corner + 1) +
                                                 ", but the file has " + std::to_string(mesh_.vertices()));
      mesh_.add_polygon(corners, face.tags, face.count > 3 ? name_of(face.tags.place) : std::string());
    }
  }

  static std::string name_of(std::size_t line) { return "the face at line " + std::to_string(line); }

  [[nodiscard]] std::uint32_t part() {
    if (!part_is_known_) {
      std::string name = object_.empty() ? std::string() : "object " + in_quotes(object_);
      if (!group_.empty()) name += (name.empty() ? "group " : ", group ") + in_quotes(group_);
      part_ = mesh_.part(name, "the face at line");
      part_is_known_ = true;
    }
    return part_;
  }

  /// One name with blanks in it, or several names.
  void add_library_names(std::string_view names) {
    if (libraries_.size() >= 16) return;
    std::error_code error;
    if (std::filesystem::exists(folder_.mesh_file().parent_path() / std::string(names), error)) {
      libraries_.emplace_back(names);
      return;
    }
    for (std::string_view name = next_word(names); !name.empty(); name = next_word(names))
      libraries_.emplace_back(name);
  }

  void add_library(const std::string& library) {
    try {
      read_material_library(folder_, folder_.find(library), mesh_);
    } catch (const ImportFault& fault) {
      mesh_.add_note("the material library " + in_quotes(library) + " is not read: " + fault.what());
    }
  }

  MeshFolder& folder_;
  bool with_materials_;
  MeshBuilder& mesh_;
  std::string object_, group_;
  bool part_is_known_ = false;
  std::uint32_t part_ = 0, material_ = 0;
  std::vector<std::uint32_t> corners_;
  std::vector<Face> faces_;
  std::vector<std::string> libraries_;
  std::size_t triangles_ = 0, first_free_form_ = 0;
};

}  // namespace

void read_obj(MeshFolder& folder, const ImportOptions& options, MeshBuilder& mesh) {
  ObjReader(folder, options, mesh).read();
}

}  // namespace pelagos
