#include <algorithm>
#include <cctype>

#include "import_fault.hpp"
#include "readers.hpp"
#include "text_lines.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kHeader = 84;  ///< bytes: 80 of text, which may begin with "solid", and the number of facets
constexpr std::size_t kFacet = 50;   ///< bytes: normal, three corners, two bytes for whatever the writer wants

/// Whether the file is binary. A text has a number of facets in its bytes 80 to 83 that no file can hold.
bool is_binary(std::span<const char> start, std::size_t size) {
  if (start.size() < kHeader) return false;
  const std::size_t count = little_endian(start, 80);
  if (count > 0 && kHeader + kFacet * count <= size) return true;
  std::string_view text(start.data(), start.size());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return false;  // UTF-16, full of zero bytes
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  return !lower_case(text.substr(0, 5)).starts_with("solid") || text.find('\0') != text.npos;
}

void read_binary(OpenFile& file, std::size_t count, MeshBuilder& mesh) {
  mesh.expect(std::min(count / 2 + 16, MeshLimits::kVertices), count);
  const TriangleTags part{mesh.part("", "facet"), 0, 0};
  std::vector<char> block(kFacet * 4096);
  for (std::size_t done = 0; done < count;) {
    const std::size_t facets = std::min(count - done, block.size() / kFacet);
    const std::span<const char> bytes(block.data(), facets * kFacet);
    if (file.read(std::span(block.data(), bytes.size())) < bytes.size())
      throw ImportFault("the file became shorter while it was read");
    for (std::size_t f = 0; f < facets; ++f) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        Eigen::Vector3d point;
        for (std::size_t axis = 0; axis < 3; ++axis)
          point[static_cast<Eigen::Index>(axis)] =
              static_cast<double>(little_endian_float(bytes, f * kFacet + 12 * (c + 1) + 4 * axis));
        if (!point.allFinite())
          throw ImportFault("facet " + std::to_string(done + f + 1) + " has a corner that is not a finite number");
        corners[c] = mesh.shared_vertex(point);
      }
      mesh.add_triangle(corners, {part.part, static_cast<std::uint32_t>(done + f + 1), 0});
    }
    done += facets;
  }
}

void read_binary_file(OpenFile& file, std::size_t count, MeshBuilder& mesh) {
  const std::size_t wanted = kHeader + kFacet * count;
  if (wanted > file.size())
    throw ImportFault("is no text that begins with \"solid\", and as a binary STL its header says " +
                      std::to_string(count) + " facets, which take " + std::to_string(wanted) +
                      " bytes, but the file has " + std::to_string(file.size()) + ": it is cut off. Save it again");
  check_triangles(count);
  std::vector<char> header(kHeader);
  (void)file.read(header);
  read_binary(file, count, mesh);
  if (wanted < file.size())
    mesh.add_note(std::to_string(file.size() - wanted) + " bytes after the last facet, " + std::to_string(count) +
                  ", are ignored");
}

/// STL as text: words between blanks, in any case; a name goes to the end of its line.
class TextStl {
 public:
  TextStl(OpenFile& file, MeshBuilder& mesh) : lines_(file, false), mesh_(mesh) {}

  void read() {
    if (word() != "solid") throw ImportFault("is neither text that begins with \"solid\" nor a whole binary STL");
    do {
      read_solid();
    } while (word() == "solid");
    if (!word_.empty() && facets_ == 0) throw unexpected("facet");
    if (!word_.empty())
      mesh_.add_note("what follows the last solid, from line " + std::to_string(line()) + ", is ignored");
  }

 private:
  /// Goes on to the next word, in lower case; empty at the end of the file.
  const std::string& word() {
    std::string_view found = next_word(rest_);
    while (found.empty()) {
      if (!lines_.next()) {
        written_ = {};
        return word_ = "";
      }
      rest_ = lines_.text();
      found = next_word(rest_);
    }
    written_ = found;
    return word_ = lower_case(found);
  }

  [[nodiscard]] std::size_t line() const { return lines_.number(); }

  [[nodiscard]] ImportFault unexpected(const std::string& wanted) const {
    if (word_.empty())
      return {line(), "the file ends where \"" + wanted + "\" should follow: it is cut off. Save it again"};
    return {line(), in_quotes(written_) + " stands where \"" + wanted + "\" should"};
  }

  void expect(const std::string& wanted) {
    if (word() != wanted) throw unexpected(wanted);
  }

  /// Takes the rest of the line as a name, but for a facet that begins on it.
  std::string read_name() {
    std::string_view all = rest_, before = rest_;
    while (true) {
      std::string_view ahead = before;
      const std::string_view found = next_word(ahead);
      if (found.empty()) break;
      std::string_view after = ahead;
      if (lower_case(found) == "facet" && lower_case(next_word(after)) == "normal") break;
      before = ahead;
    }
    rest_ = before;
    return std::string(trimmed(all.substr(0, all.size() - before.size())));
  }

  /// Passes over the name after "endsolid", if it is there, up to a solid that begins on the same line.
  void pass_name() {
    constexpr int kAhead = 16;  // words
    while (!trimmed(rest_).empty()) {
      std::string_view ahead = rest_;
      if (lower_case(next_word(ahead)) == "solid") {
        std::string before;
        for (int n = 0; n < kAhead; ++n) {
          std::string next = lower_case(next_word(ahead));
          if (before == "facet" && next == "normal") return;
          before = std::move(next);
        }
      }
      (void)next_word(rest_);
    }
  }

  void read_solid() {
    ++solids_;
    const std::string name = read_name();
    part_is_known_ = false;
    part_name_ = name.empty() ? "solid " + std::to_string(solids_) : "solid " + in_quotes(name);
    while (word() == "facet") read_facet();
    if (word_ == "end") {
      expect("solid");
    } else if (word_ != "endsolid") {
      throw unexpected("endsolid");
    }
    pass_name();
  }

  void read_facet() {
    const std::size_t start = line();
    if (word() == "normal") {
      for (int n = 0; n < 3; ++n) (void)word();  // not needed: the order of the corners says it
      (void)word();
    }
    if (word_ != "outer") throw unexpected("outer");
    expect("loop");
    corners_.clear();
    while (word() == "vertex") {
      const std::size_t here = line();
      Eigen::Vector3d point;
      for (double& c : point) {
        if (word() == "vertex" || word_ == "endloop")
          throw ImportFault(here, "the vertex has fewer than three numbers");
        c = read_number(written_, line());
      }
      corners_.push_back(mesh_.shared_vertex(point));
      check_corners(corners_.size(), name_of(start));
    }
    if (word_ != "endloop") throw unexpected(corners_.size() < 3 ? "vertex" : "endloop");
    if (corners_.size() < 3)
      throw ImportFault(start, "the facet has " + std::to_string(corners_.size()) + " corners; allowed: 3 or more");
    expect("endfacet");
    ++facets_;
    if (!part_is_known_) part_ = mesh_.part(part_name_, "the facet at line");
    part_is_known_ = true;
    mesh_.add_polygon(corners_, {part_, static_cast<std::uint32_t>(start), 0},
                      corners_.size() > 3 ? name_of(start) : std::string());
  }

  static std::string name_of(std::size_t line) { return "the facet at line " + std::to_string(line); }

  TextLines lines_;
  MeshBuilder& mesh_;
  std::string_view rest_, written_;
  std::string word_, part_name_;
  bool part_is_known_ = false;
  std::uint32_t part_ = 0;
  std::size_t solids_ = 0, facets_ = 0;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

void read_stl(MeshFolder& folder, MeshBuilder& mesh) {
  OpenFile file(folder, folder.mesh_file());
  std::vector<char> start(kHeader);
  start.resize(file.read(start));
  file.rewind();
  if (is_binary(start, file.size()))
    read_binary_file(file, little_endian(start, 80), mesh);
  else
    TextStl(file, mesh).read();
}

}  // namespace pelagos
