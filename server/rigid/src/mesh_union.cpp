#include "rigid/mesh_union.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "box_tree.hpp"
#include "face_section.hpp"
#include "mesh_edges.hpp"
#include "union_words.hpp"

namespace pelagos {

namespace {

constexpr double kNear = 2e-6;   ///< of the size: faces nearer lie on one another (vertices are merged within 1e-6)
constexpr double kTiny = 1e-13;  ///< of the size: widths of pieces that are left out
constexpr double kSteep = 10.0;  ///< an outline may stand so many times the offset from where its plane cuts
constexpr double kMerge = 1e-9;  ///< of the size: corners of pieces nearer are one vertex
constexpr double kSome = 1e-5;   ///< of a part's surface: less is what touching leaves
constexpr double kWhole = 1e-9;  ///< of a face's area: less is none
constexpr std::size_t kMostWork = 250'000'000;  ///< steps, 4 ns each; for each triangle, but for the last of many,
constexpr std::size_t kMostWorkEach = 1000, kMostCounted = 250'000;  ///< there are so many more
constexpr std::size_t kVisit = 4;                                    ///< steps that a box of a tree or a triangle costs

/// The plane of a face, with axes in it.
struct FacePlane {
  Eigen::Vector3d origin, x, y, normal;

  FacePlane(const TriangleMesh& mesh, std::size_t t) : origin(mesh.corner(t, 0)) {
    x = (mesh.corner(t, 1) - origin).normalized();
    normal = mesh.area_vector(t).normalized();
    y = normal.cross(x);
  }
  [[nodiscard]] double height(const Eigen::Vector3d& point) const { return normal.dot(point - origin); }
  [[nodiscard]] Eigen::Vector2d flat(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d arm = point - origin;
    return {x.dot(arm), y.dot(arm)};
  }
  [[nodiscard]] Eigen::Vector3d lift(const Eigen::Vector2d& place) const {
    return origin + place.x() * x + place.y() * y;
  }
};

/// Where the boxes of triangles must reach to matter to a face: across its plane, and within its range of x or, towards
/// -y, anywhere.
struct FaceStrip {
  const FacePlane& plane;
  Eigen::AlignedBox2d range;
  double slack;

  [[nodiscard]] bool meets(const Eigen::AlignedBox3d& box) const {
    const Eigen::Vector3d centre = box.center() - plane.origin, half = 0.5 * box.sizes();
    const auto reach = [&](const Eigen::Vector3d& axis) { return half.dot(axis.cwiseAbs()) + slack; };
    if (std::abs(plane.normal.dot(centre)) > reach(plane.normal)) return false;
    const double at = plane.x.dot(centre), along = reach(plane.x);
    if (at - along > range.max().x() || at + along < range.min().x()) return false;
    return plane.y.dot(centre) - reach(plane.y) <= range.max().y();
  }
};

/// A corner of a triangle as a face's plane sees it.
struct SeenCorner {
  std::uint32_t vertex;
  double height;
  Eigen::Vector2d flat;
};

/// Where an edge crosses the plane raised by `offset`. An edge that goes through steeply enough counts as if it crossed
/// the plane itself, so that only what nearly lies in the plane depends on the offset. Both triangles at the edge get
/// the same bits.
Eigen::Vector2d crossing_of(const SeenCorner& a, const SeenCorner& b, double offset) {
  const SeenCorner &low = a.vertex < b.vertex ? a : b, &high = a.vertex < b.vertex ? b : a;
  const double rise = high.height - low.height;
  const double raised = (offset - low.height) / rise, level = std::clamp(-low.height / rise, 0.0, 1.0);
  const Eigen::Vector2d way = high.flat - low.flat;
  const bool steep = std::abs(raised - level) * way.norm() <= kSteep * std::abs(offset);
  return low.flat + (steep ? level : raised) * way;
}

/// The segment that a triangle adds to its shell's outline in the plane raised by `offset`, from where it goes down to
/// where it comes up: the shell's inside is on the left. False if it adds none.
bool section_of(const std::array<SeenCorner, 3>& corners, double offset, Eigen::Vector2d& down, Eigen::Vector2d& up) {
  bool crosses = false;
  for (std::size_t c = 0; c < 3; ++c) {
    const SeenCorner &from = corners[c], &to = corners[(c + 1) % 3];
    const bool from_above = from.height > offset, to_above = to.height > offset;
    if (from_above == to_above) continue;
    crosses = true;
    (from_above ? down : up) = crossing_of(from, to, offset);
  }
  return crosses;
}

class Uniter {
 public:
  Uniter(const TriangleMesh& mesh, const MeshOrigin& origin)
      : mesh_(mesh),
        origin_(origin),
        work_(kMostWork + kMostWorkEach * std::min(mesh.triangles.size(), kMostCounted)) {}

  MeshUnion run() {
    find_parts();
    if (!check_volumes()) return std::move(result_);
    find_meeting_parts();
    if (std::find(meets_.begin(), meets_.end(), true) != meets_.end()) decide_faces();
    if (work_ == 0) {
      result_.faults.push_back(words_of_too_much_work(result_.parts.size()));
      return std::move(result_);
    }
    assign_roles();
    if (!result_.faults.empty()) return std::move(result_);
    seal_cavities();
    assemble();
    fill_sealed_cavities();
    if (result_.faults.empty()) result_.notes = union_notes(mesh_, origin_, result_);
    return std::move(result_);
  }

 private:
  void find_parts() {
    const std::vector<EdgeUse> uses = collect_edges(mesh_);
    pairs_ = pair_triangles(mesh_, uses);
    shells_ = find_shells(mesh_.triangles.size(), pairs_);
    find_knots(uses);
    result_.part = shells_.of;
    boxes_.resize(shells_.first.size());
    areas_.resize(shells_.first.size());
    for (const std::uint32_t first : shells_.first) result_.parts.push_back({first, 0, 0.0, PartRole::kSolid});
    Eigen::AlignedBox3d all;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      MeshPart& part = result_.parts[shells_.of[t]];
      ++part.triangles;
      const Eigen::Vector3d area = mesh_.area_vector(t);
      part.volume += (mesh_.corner(t, 0) - mesh_.corner(part.first_triangle, 0)).dot(area) / 3.0;
      areas_[shells_.of[t]].surface += area.norm();
      for (std::size_t c = 0; c < 3; ++c) boxes_[shells_.of[t]].extend(mesh_.corner(t, c));
    }
    for (const Eigen::AlignedBox3d& box : boxes_) all.extend(box);
    size_ = all.sizes().maxCoeff();
    shell_tree_.emplace(boxes_);
  }

  /// Edges that more than two triangles have. A part touches itself there if they are its own; and if its triangles do
  /// not stand together in the mesh, it may be made up of pieces of several parts: both may overlap themselves.
  void find_knots(std::span<const EdgeUse> uses) {
    std::vector<std::uint32_t> last(shells_.first.size(), 0), count = last;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) last[shells_.of[t]] = t, ++count[shells_.of[t]];
    at_knot_.assign(mesh_.triangles.size(), false);
    knotted_.assign(shells_.first.size(), false);
    shares_edges_ = knotted_;
    for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
      if (edge.size() <= 2) return;
      for (const EdgeUse& use : edge) {
        const std::uint32_t shell = shells_.of[use.triangle];
        shares_edges_[shell] = true;
        const bool mixed = last[shell] - shells_.first[shell] + 1 != count[shell];
        const auto same = [&](const EdgeUse& other) { return shells_.of[other.triangle] == shell; };
        if (mixed || std::count_if(edge.begin(), edge.end(), same) > 2) at_knot_[use.triangle] = knotted_[shell] = true;
      }
    });
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::uint32_t shell = shells_.of[t];
      if (knotted_[shell] && last[shell] - shells_.first[shell] + 1 != count[shell]) at_knot_[t] = true;
    }
  }

  /// Parts without volume have no inside. Two triangles that lie on one another back to back where parts touch are no
  /// part: they add nothing.
  bool check_volumes() {
    constexpr double kFlat = 1e-12;  // of area^(3/2)
    FaultList flat("part without volume");
    for (std::size_t s = 0; s < result_.parts.size(); ++s) {
      MeshPart& part = result_.parts[s];
      if (std::abs(part.volume) > kFlat * std::pow(areas_[s].surface, 1.5)) continue;
      if (!shares_edges_[s]) flat.add(words_of_flat_part(origin_, part));
      part.volume = 0.0;
      knotted_[s] = true;
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (!(std::abs(result_.parts[shells_.of[t]].volume) > 0.0)) at_knot_[t] = true;
    flat.append_to(result_.faults);
    return result_.faults.empty();
  }

  /// Parts whose boxes meet another's, or that touch themselves; only these are looked at.
  void find_meeting_parts() {
    meets_.assign(boxes_.size(), false);
    for (std::uint32_t s = 0; s < boxes_.size() && work_ > 0; ++s)
      for_each_near_shell(
          boxes_[s], s, [&] { return !meets_[s]; }, [&](std::uint32_t) { meets_[s] = true; });
  }

  /// Calls visit(shell) for the shells other than `own` that a box comes near to, while go_on().
  template <class GoOn, class Visit>
  void for_each_near_shell(const Eigen::AlignedBox3d& box, std::uint32_t own, GoOn&& go_on, Visit&& visit) {
    const Eigen::AlignedBox3d wide = widened(box);
    shell_tree_->for_each(
        [&](const Eigen::AlignedBox3d& node) { return spend(kVisit) && go_on() && node.intersects(wide); },
        [&](std::uint32_t shell) {
          if (shell != own && boxes_[shell].intersects(wide) && go_on()) visit(shell);
        });
  }

  /// How far from a face another counts as near, m.
  [[nodiscard]] double slack() const { return 2.0 * kNear * size_; }
  [[nodiscard]] Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box) const {
    return {box.min().array() - slack(), box.max().array() + slack()};
  }
  [[nodiscard]] Eigen::AlignedBox3d box_of(std::uint32_t t) const {
    Eigen::AlignedBox3d box(mesh_.corner(t, 0));
    return box.extend(mesh_.corner(t, 1)).extend(mesh_.corner(t, 2));
  }

  [[nodiscard]] bool outward(std::uint32_t shell) const { return result_.parts[shell].volume >= 0.0; }
  [[nodiscard]] bool in_play(std::size_t t) const { return meets_[shells_.of[t]]; }
  /// Whether there is work left after so many steps.
  bool spend(std::size_t steps) {
    work_ -= std::min(work_, steps);
    return work_ > 0;
  }

  /// The triangles of each part that meets another, and a tree over them.
  void plant_trees() {
    trees_.assign(boxes_.size(), std::nullopt);
    members_.resize(boxes_.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (in_play(t)) members_[shells_.of[t]].push_back(t);
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::size_t s = 0; s < members_.size(); ++s) {
      if (members_[s].empty()) continue;
      boxes.clear();
      for (const std::uint32_t t : members_[s]) boxes.push_back(box_of(t));
      trees_[s].emplace(boxes);
    }
  }

  /// Decides for each face of parts that meet others what of it stays.
  void decide_faces() {
    plant_trees();
    fate_.assign(mesh_.triangles.size(), Fate::kStays);
    std::vector<bool> touched(mesh_.triangles.size(), false);
    for (std::uint32_t t = 0; t < mesh_.triangles.size() && work_ > 0; ++t) touched[t] = in_play(t) && is_touched(t);
    decide_connected_faces(touched);
    for (std::uint32_t t = 0; t < mesh_.triangles.size() && work_ > 0; ++t)
      if (touched[t]) decide_face(t);
  }

  void decide_face(std::uint32_t t) {
    FaceRemainder rest = cut(t);
    add_areas(shells_.of[t], rest.areas, mesh_.area_vector(t).norm());
    if (rest.areas.kept <= kWhole * rest.areas.all) {
      fate_[t] = Fate::kGoes;
    } else if (rest.areas.all - rest.areas.kept > kWhole * rest.areas.all) {
      fate_[t] = Fate::kIsCut;
      pieces_.emplace(t, std::move(rest.pieces));
    }
  }

  /// Whether a triangle of another part, or one of a part that touches itself, may come as near to a face as its
  /// thickness.
  bool is_touched(std::uint32_t t) {
    if (at_knot_[t]) return true;
    const std::uint32_t own = shells_.of[t];
    bool touched = knotted_[own] && is_touched_by(t, own);
    for_each_near_shell(
        box_of(t), own, [&] { return !touched; }, [&](std::uint32_t shell) { touched = is_touched_by(t, shell); });
    return touched;
  }

  bool is_touched_by(std::uint32_t t, std::uint32_t shell) {
    const FacePlane plane(mesh_, t);
    const Eigen::AlignedBox3d wide = widened(box_of(t));
    bool touched = false;
    trees_[shell]->for_each(
        [&](const Eigen::AlignedBox3d& node) { return spend(kVisit) && !touched && node.intersects(wide); },
        [&](std::uint32_t n) {
          const std::uint32_t other = members_[shell][n];
          if (touched || !box_of(other).intersects(wide) || share_corner(t, other)) return;
          spend(2 * kVisit);
          touched = !is_beside(plane, other) && !is_beside(FacePlane(mesh_, other), t);
        });
    return touched;
  }

  /// Neighbours in one part meet where they share a corner, which is no contact.
  [[nodiscard]] bool share_corner(std::uint32_t a, std::uint32_t b) const {
    if (shells_.of[a] != shells_.of[b]) return false;
    const auto &corners = mesh_.triangles[a], &others = mesh_.triangles[b];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
      return std::find(others.begin(), others.end(), vertex) != others.end();
    });
  }

  /// Whether a triangle lies on one side of a plane, away from it.
  [[nodiscard]] bool is_beside(const FacePlane& plane, std::size_t t) const {
    const double a = plane.height(mesh_.corner(t, 0)), b = plane.height(mesh_.corner(t, 1)),
                 c = plane.height(mesh_.corner(t, 2));
    return std::min({a, b, c}) > slack() || std::max({a, b, c}) < -slack();
  }

  /// Faces that no other part comes near to, as far as they are connected, are all decided by the largest of them.
  void decide_connected_faces(const std::vector<bool>& touched) {
    std::vector<EdgePair> joined;
    for (const EdgePair& pair : pairs_)
      if (in_play(pair.a) && !touched[pair.a] && !touched[pair.b]) joined.push_back(pair);
    const MeshShells patches = find_shells(mesh_.triangles.size(), joined);
    struct Patch {
      double area = 0.0, largest = -1.0;
      std::uint32_t face = 0;
      bool goes = false;
    };
    std::vector<Patch> patch(patches.first.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!in_play(t) || touched[t]) continue;
      Patch& own = patch[patches.of[t]];
      const double area = mesh_.area_vector(t).norm();
      own.area += area;
      if (area > own.largest) own.largest = area, own.face = t;
    }
    for (Patch& own : patch) {
      if (own.largest < 0.0) continue;
      if (work_ == 0) return;
      const FaceRemainder rest = cut(own.face);
      add_areas(shells_.of[own.face], rest.areas, own.area);
      own.goes = rest.areas.kept < 0.5 * rest.areas.all;
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (in_play(t) && !touched[t] && patch[patches.of[t]].goes) fate_[t] = Fate::kGoes;
  }

  FaceRemainder cut(std::uint32_t t) {
    const FacePlane plane(mesh_, t);
    const std::array<Eigen::Vector2d, 3> corners{plane.flat(mesh_.corner(t, 0)), plane.flat(mesh_.corner(t, 1)),
                                                 plane.flat(mesh_.corner(t, 2))};
    FaceStrip strip{plane, {}, slack()};
    for (const Eigen::Vector2d& corner : corners) strip.range.extend(corner);
    segments_.clear();
    shells_here_.clear();
    const std::uint32_t own = shells_.of[t];
    const auto add_shell = [&](std::uint32_t shell) {
      const SectionShell seen{outward(shell), shell < own && !knotted_[shell]};
      const auto here = static_cast<std::uint32_t>(shells_here_.size());
      const std::size_t before = segments_.size();
      trees_[shell]->for_each([&](const Eigen::AlignedBox3d& box) { return spend(kVisit) && strip.meets(box); },
                              [&](std::uint32_t n) {
                                const std::uint32_t other = members_[shell][n];
                                add_sections(plane, other, here);
                                if (knotted_[shell] && (shell == own ? other < t : shell < own))
                                  add_repeat(plane, other, here);
                              });
      if (segments_.size() > before) shells_here_.push_back(seen);
    };
    for_each_near_shell(
        box_of(t), own, [] { return true; }, add_shell);
    OwnWinding winding = outward(own) ? OwnWinding{0, 1} : OwnWinding{-1, 0};
    if (knotted_[own]) {  // counted as the others are
      add_shell(own);
      winding = {0, 0};
    }
    FaceRemainder rest = cut_face(corners, winding, segments_, shells_here_, kTiny * size_, work_);
    if (knotted_[own]) rest.areas.backed = rest.areas.buried = rest.areas.enclosed = rest.areas.joining = 0.0;
    return rest;
  }

  /// Of triangles that lie on one another and face the same way the first stands for all. Parts that may overlap
  /// themselves have to be asked triangle by triangle.
  void add_repeat(const FacePlane& plane, std::uint32_t t, std::uint32_t shell) {
    if (plane.normal.dot(mesh_.area_vector(t)) < 0.0) return;
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(plane.height(mesh_.corner(t, c))) > kNear * size_) return;
    for (std::size_t c = 0; c < 3; ++c) {
      const Eigen::Vector2d from = plane.flat(mesh_.corner(t, c)), to = plane.flat(mesh_.corner(t, (c + 1) % 3));
      if (from.x() <= to.x()) segments_.push_back({from, to, 0, 0, shell, 1});
      if (from.x() > to.x()) segments_.push_back({to, from, 0, 0, shell, -1});
    }
  }

  /// Adds what a triangle of another shell gives to the outlines just above and just below a face.
  void add_sections(const FacePlane& plane, std::uint32_t t, std::uint32_t shell) {
    spend(2 * kVisit);
    std::array<SeenCorner, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Eigen::Vector3d& point = mesh_.corner(t, c);
      corners[c] = {mesh_.triangles[t][c], plane.height(point), plane.flat(point)};
    }
    const double offset = kNear * size_;
    Eigen::Vector2d down_above, up_above, down_below, up_below;
    const bool above = section_of(corners, offset, down_above, up_above);
    const bool below = section_of(corners, -offset, down_below, up_below);
    if (!above && !below) return;
    if (above && below && down_above == down_below && up_above == up_below) {
      add_segment(down_above, up_above, 1, 1, shell);
    } else {
      if (above) add_segment(down_above, up_above, 1, 0, shell);
      if (below) add_segment(down_below, up_below, 0, 1, shell);
    }
  }

  void add_segment(const Eigen::Vector2d& down, const Eigen::Vector2d& up, int above, int below, std::uint32_t shell) {
    if (down.x() <= up.x()) segments_.push_back({down, up, above, below, shell});
    if (down.x() > up.x()) segments_.push_back({up, down, -above, -below, shell});
  }

  /// What is known of a shell's surface, m^2.
  struct ShellAreas {
    double surface = 0.0, kept = 0.0, buried = 0.0, backed = 0.0, bare = 0.0, joining = 0.0, opening = 0.0,
           enclosed = 0.0;
    bool decided = false;
  };
  void add_areas(std::uint32_t shell, const FaceAreas& face, double area) {
    ShellAreas& sums = areas_[shell];
    sums.decided = true;
    if (!(face.all > 0.0)) return;
    const double scale = area / face.all;
    sums.kept += scale * face.kept;
    sums.buried += scale * face.buried;
    sums.backed += scale * face.backed;
    sums.bare += scale * face.bare;
    sums.joining += scale * face.joining;
    sums.opening += scale * face.opening;
    sums.enclosed += scale * face.enclosed;
  }

  void assign_roles() {
    FaultList inwards("shell facing inwards");
    bool all_turned = true;  // of the parts that no other encloses
    for (std::uint32_t s = 0; s < areas_.size(); ++s) {
      const ShellAreas& areas = areas_[s];
      MeshPart& part = result_.parts[s];
      const double some = kSome * areas.surface;
      if (areas.enclosed < areas.surface - some && outward(s)) all_turned = false;
      if (!outward(s)) {
        part.role = PartRole::kCavity;
        if (!areas.decided || areas.bare > some)
          inwards.add(words_of_inward_part(origin_, part, areas.decided && areas.bare < areas.surface - some));
      } else if (areas.decided && areas.backed >= areas.surface - some && (areas.buried > some || areas.kept < some)) {
        part.role = PartRole::kSwallowed;
      }
    }
    if (!inwards.empty() && all_turned)
      result_.faults.push_back(words_of_turned_file(mesh_volume(mesh_)));
    else
      inwards.append_to(result_.faults);
  }

  /// Cavities are sealed unless they, or others that they go over into, open into the sea.
  void seal_cavities() {
    std::vector<EdgePair> joined;
    const auto joins = [&](std::uint32_t s) {
      return result_.parts[s].role == PartRole::kCavity && areas_[s].joining > kSome * areas_[s].surface;
    };
    for (std::uint32_t a = 0; a < boxes_.size(); ++a)
      for (std::uint32_t b = 0; joins(a) && b < a; ++b)
        if (joins(b) && boxes_[a].intersects(boxes_[b])) joined.push_back({a, b, true});
    const MeshShells rooms = find_shells(boxes_.size(), joined);
    std::vector<bool> open(rooms.first.size(), false);
    for (std::uint32_t s = 0; s < boxes_.size(); ++s)
      if (joins(s) && areas_[s].opening > kSome * areas_[s].surface) open[rooms.of[s]] = true;
    for (std::uint32_t s = 0; s < boxes_.size(); ++s)
      result_.parts[s].sealed = result_.parts[s].role == PartRole::kCavity && !open[rooms.of[s]] && !knotted_[s];
  }

  /// The outside is that of the other parts alone.
  void fill_sealed_cavities() {
    if (std::none_of(result_.parts.begin(), result_.parts.end(), [](const MeshPart& part) { return part.sealed; }))
      return;
    TriangleMesh others = mesh_;
    others.triangles.clear();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (!result_.parts[shells_.of[t]].sealed) others.triangles.push_back(mesh_.triangles[t]);
    drop_unused_vertices(others);
    MeshUnion outside = unite_parts(others);
    result_.outer = std::move(outside.mesh);
    result_.faults = std::move(outside.faults);
  }

  void assemble() {
    result_.mesh = mesh_;
    if (std::none_of(fate_.begin(), fate_.end(), [](Fate fate) { return fate != Fate::kStays; })) return;
    TriangleMesh& mesh = result_.mesh;
    mesh.triangles.clear();
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (fate_[t] == Fate::kStays) mesh.triangles.push_back(mesh_.triangles[t]);
      if (fate_[t] == Fate::kIsCut) add_pieces(t);
    }
    mesh = weld_vertices(mesh, kMerge * size_);
    std::erase_if(mesh.triangles, [&](const auto& triangle) {
      return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    });
    drop_unused_vertices(mesh);
  }

  void add_pieces(std::uint32_t t) {
    const FacePlane plane(mesh_, t);
    TriangleMesh& mesh = result_.mesh;
    for (const Trapezoid& piece : pieces_.at(t)) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Eigen::Vector2d& corner : piece) mesh.vertices.push_back(plane.lift(corner));
      const auto add = [&](std::uint32_t b, std::uint32_t c) {
        mesh.triangles.push_back({first, first + b, first + c});
        const double least = kTiny * size_ * kTiny * size_;
        if (!(mesh.area_vector(mesh.triangles.size() - 1).norm() > least)) mesh.triangles.pop_back();
      };
      add(1, 2);
      add(2, 3);
    }
  }

  static void drop_unused_vertices(TriangleMesh& mesh) {
    std::vector<std::uint32_t> renamed(mesh.vertices.size(), 0);
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle) renamed[vertex] = 1;
    std::uint32_t used = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (renamed[v] == 0) continue;
      renamed[v] = used;
      mesh.vertices[used++] = mesh.vertices[v];
    }
    mesh.vertices.resize(used);
    for (auto& triangle : mesh.triangles)
      for (std::uint32_t& vertex : triangle) vertex = renamed[vertex];
  }

  enum class Fate : std::uint8_t { kStays, kGoes, kIsCut };

  const TriangleMesh& mesh_;
  const MeshOrigin& origin_;
  MeshUnion result_;
  double size_ = 0.0;  ///< m, longest side of the mesh's box
  std::vector<EdgePair> pairs_;
  MeshShells shells_;
  std::vector<Eigen::AlignedBox3d> boxes_;           ///< [shells]
  std::vector<ShellAreas> areas_;                    ///< [shells]
  std::vector<bool> meets_;                          ///< [shells] whether its box meets another's
  std::vector<bool> shares_edges_;                   ///< [shells] whether edges of its have more than two triangles
  std::vector<bool> knotted_, at_knot_;              ///< [shells], [triangles] whether it may touch or overlap itself
  std::optional<BoxTree> shell_tree_;                ///< over boxes_
  std::vector<std::vector<std::uint32_t>> members_;  ///< [shells] triangles, of those that meet others
  std::vector<std::optional<BoxTree>> trees_;        ///< [shells] over members_
  std::vector<Fate> fate_;                           ///< [triangles]; empty: all stay
  std::map<std::uint32_t, std::vector<Trapezoid>> pieces_;
  std::size_t work_;
  // of the face at hand
  std::vector<OutlineSegment> segments_;
  std::vector<SectionShell> shells_here_;
};

}  // namespace

MeshUnion unite_parts(const TriangleMesh& mesh, const MeshOrigin& origin) { return Uniter(mesh, origin).run(); }

}  // namespace pelagos
