#include "union_words.hpp"

#include <cmath>
#include <cstdio>
#include <numeric>

namespace pelagos {

namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string name_of(const MeshOrigin& origin, const MeshPart& part) {
  return "the part of " + std::to_string(part.triangles) + " triangles that begins with " +
         origin.describe(part.first_triangle);
}

}  // namespace

void FaultList::append_to(Refusals& faults) const {
  faults.insert(faults.end(), shown_.begin(), shown_.end());
  if (count_ > kShown)
    faults.push_back({kind_, std::to_string(count_ - kShown) + " more, " + std::to_string(count_) + " in all"});
}

void FaultList::append_to(std::vector<std::string>& notes) const {
  Refusals lines;
  append_to(lines);
  for (const Refusal& line : lines) notes.push_back(to_string(line));
}

std::string words_of_flat_part(const MeshOrigin& origin, const MeshPart& part) {
  return name_of(origin, part) +
         " encloses nothing, as a sheet does that has two sides; remove it or give it thickness";
}

std::string words_of_inward_part(const MeshOrigin& origin, const MeshPart& part, bool partly) {
  return name_of(origin, part) + " encloses " + digits(part.volume) + " m^3 and " +
         (partly ? "reaches out of the parts around it; if it is a solid, reverse the order of its triangles' corners; "
                   "if it is a cavity, keep it inside the solid"
                 : "lies in no part that it could be a cavity of; reverse the order of its triangles' corners");
}

Refusal words_of_turned_file(double volume) {
  return {"shell facing inwards", "the whole mesh is inside out, it encloses " + digits(volume) +
                                      " m^3; reverse the order of the corners of all its triangles"};
}

Refusal words_of_too_much_work(std::size_t parts) {
  return {"", "its " + std::to_string(parts) +
                  " parts cross each other in too many places to be united; allowed: as many as can be cut within "
                  "about a second, some hundred thousand triangles that cross a few others each. Unite the parts in a "
                  "modelling program, or give them fewer triangles"};
}

std::vector<std::string> union_notes(const TriangleMesh& mesh, const MeshOrigin& origin, const MeshUnion& united) {
  std::vector<std::string> notes;
  FaultList cavities("cavity"), swallowed("part without effect");
  for (const MeshPart& part : united.parts) {
    if (part.role == PartRole::kCavity)
      cavities.add(name_of(origin, part) + " faces inwards and takes " + digits(-part.volume) +
                   " m^3 out of the solid around it; " +
                   (part.sealed ? "it is closed and stays dry" : "it is open to the water outside"));
    if (part.role == PartRole::kSwallowed)
      swallowed.add(name_of(origin, part) + " encloses " + digits(part.volume) +
                    " m^3 that are solid by other parts already; if it is a cavity, reverse the order of its "
                    "triangles' corners");
  }
  cavities.append_to(notes);
  swallowed.append_to(notes);
  const double apart = mesh_volume(mesh), together = mesh_volume(united.mesh);
  constexpr double kSame = 1e-6;  // of the volume: what merging of vertices may change
  if (std::abs(apart - together) > kSame * std::abs(together))
    notes.push_back("overlap: the " + std::to_string(united.parts.size()) + " parts enclose " + digits(apart) +
                    " m^3 one by one and " + digits(together) + " m^3 together, which counts");
  return notes;
}

}  // namespace pelagos
