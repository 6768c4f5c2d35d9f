#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "mesh_files.hpp"

namespace pelagos {
namespace {

using test::first_fault;
using test::imported;
using test::replaced;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Facet = std::array<std::array<float, 3>, 3>;

/// A tetrahedron of 8/6.
std::vector<Facet> tetrahedron() {
  const std::array<float, 3> o{0, 0, 0}, x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}
constexpr double kVolume = 8.0 / 6.0;

std::string bytes_of(std::uint32_t number) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &number, 4);  // on little-endian machines
  return bytes;
}

std::string binary_of(const std::string& header, const std::vector<Facet>& facets) {
  std::string bytes = header;
  bytes.resize(80, header.empty() ? '\0' : ' ');
  bytes += bytes_of(static_cast<std::uint32_t>(facets.size()));
  for (const Facet& facet : facets) {
    bytes += std::string(12, '\0');
    bytes.append(reinterpret_cast<const char*>(&facet), sizeof facet);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string text_of(const std::vector<Facet>& facets, const std::string& name = "part") {
  std::ostringstream text;
  text << "solid " << name << '\n';
  for (const Facet& facet : facets) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const auto& [x, y, z] : facet) text << "      vertex " << x << ' ' << y << ' ' << z << '\n';
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid " << name << '\n';
  return text.str();
}

void expect_tetrahedron(const std::string& what, const ImportedMesh& mesh) {
  ASSERT_THAT(mesh.faults, IsEmpty()) << what << ": " << first_fault(mesh);
  EXPECT_THAT(mesh.triangles, SizeIs(4)) << what;
  EXPECT_THAT(mesh.vertices, SizeIs(4)) << what;
  EXPECT_NEAR(test::volume_of(mesh), kVolume, 1e-12) << what;
}

TEST(Stl, BinaryWhateverTheHeaderSays) {
  for (const std::string header : {"", "made by hand", "solid of SomeCAD", "solid", "SOLID facet normal"}) {
    const ImportedMesh mesh = imported("part.stl", binary_of(header, tetrahedron()));
    expect_tetrahedron(header, mesh);
    EXPECT_THAT(mesh.notes, IsEmpty());
  }
}

TEST(Stl, BytesAfterTheLastFacetAreIgnoredAndNoted) {
  for (const std::size_t count : {1u, 2u, 49u, 50u, 1000u}) {
    const ImportedMesh mesh = imported("part.stl", binary_of("solid x", tetrahedron()) + std::string(count, 'z'));
    expect_tetrahedron(std::to_string(count), mesh);
    EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr(std::to_string(count) + " bytes after the last facet")));
  }
}

TEST(Stl, BinaryThatIsCutOffOrNotFinite) {
  const std::string whole = binary_of("solid x", tetrahedron());
  EXPECT_THAT(
      first_fault(imported("part.stl", whole.substr(0, whole.size() - 1))),
      ::testing::AllOf(HasSubstr("4 facets"), HasSubstr("284 bytes"), HasSubstr("has 283"), HasSubstr("cut off")));
  EXPECT_THAT(first_fault(imported("part.stl", binary_of("x", {}))), HasSubstr("no triangles"));
  EXPECT_THAT(first_fault(imported("part.stl", std::string(500, 'x'))), HasSubstr("no text that begins with"));
  EXPECT_THAT(first_fault(imported("part.stl", "x")), HasSubstr("neither text"));
  EXPECT_THAT(first_fault(imported("part.stl", "")), HasSubstr("neither text"));
  std::vector<Facet> facets = tetrahedron();
  facets[2][1][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(first_fault(imported("part.stl", binary_of("x", facets))), HasSubstr("facet 3 has a corner"));
}

TEST(Stl, TextDialects) {
  const std::string plain = text_of(tetrahedron());
  expect_tetrahedron("plain", imported("a.stl", plain));
  expect_tetrahedron("CR LF", imported("a.stl", replaced(plain, "\n", "\r\n")));
  expect_tetrahedron("BOM", imported("a.stl", "\xEF\xBB\xBF" + plain));
  expect_tetrahedron("leading blanks", imported("a.stl", "\n  \t" + plain));
  expect_tetrahedron("no name at the end", imported("a.stl", replaced(plain, "endsolid part", "endsolid")));
  expect_tetrahedron("no name", imported("a.stl", text_of(tetrahedron(), "")));
  expect_tetrahedron("name of keywords", imported("a.stl", text_of(tetrahedron(), "solid facet of a vertex")));
  expect_tetrahedron("no end of the last line", imported("a.stl", plain.substr(0, plain.size() - 1)));
  expect_tetrahedron("one line", imported("a.stl", replaced(plain, "\n", " ")));
  expect_tetrahedron("end solid", imported("a.stl", replaced(plain, "endsolid", "end solid")));
  expect_tetrahedron("exponents", imported("a.stl", replaced(plain, " 2", " +2.E+0")));
  expect_tetrahedron("exponents", imported("a.stl", replaced(plain, " 2", " 2000e-3")));
  expect_tetrahedron("normals of words",
                     imported("a.stl", replaced(plain, "normal 0 0 0", "normal nan nan -nan(ind)")));
  expect_tetrahedron("no normals", imported("a.stl", replaced(plain, " normal 0 0 0", "")));
  std::string upper = plain;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  expect_tetrahedron("upper case", imported("a.stl", upper));
}

TEST(Stl, SeveralSolidsAreParts) {
  std::vector<Facet> up = tetrahedron();
  for (Facet& facet : up)
    for (auto& point : facet) point[2] += 5.0F;
  const ImportedMesh mesh = imported("a.stl", text_of(tetrahedron(), "hull") + "\n" + text_of(up, ""));
  ASSERT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
  EXPECT_NEAR(test::volume_of(mesh), 2 * kVolume, 1e-6);
  ASSERT_THAT(mesh.parts, SizeIs(2));
  EXPECT_EQ(mesh.parts[0].name, "solid \"hull\"");
  EXPECT_EQ(mesh.parts[1].name, "solid 2");
  EXPECT_EQ(mesh.parts[0].place, "the facet at line");
  EXPECT_EQ(mesh.triangles[1].place, 9u) << "line of the second facet";
  const std::string on_one_line = replaced(text_of(tetrahedron(), "a solid hull") + text_of(up), "\n", " ");
  EXPECT_THAT(imported("a.stl", on_one_line).triangles, SizeIs(8));
}

TEST(Stl, TextThatIsWrongIsNamedByItsLine) {
  const std::string plain = text_of(tetrahedron());
  const auto fault = [](const std::string& text) { return first_fault(imported("a.stl", text)); };
  EXPECT_THAT(fault(replaced(plain, "vertex 2 0 0", "vertex 2,5 0 0")),
              ::testing::AllOf(HasSubstr("line 6"), HasSubstr("\"2,5\" has a decimal comma")));
  EXPECT_THAT(fault(replaced(plain, "vertex 0 0 2", "vertex 0 0")),
              HasSubstr("line 13: the vertex has fewer than three numbers"));
  EXPECT_THAT(fault(replaced(plain, "vertex 0 0 2", "vertex 0 0 inf")), HasSubstr("\"inf\" is not a finite number"));
  EXPECT_THAT(fault("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid\n"),
              ::testing::AllOf(HasSubstr("line 2"), HasSubstr("has 1 corners; allowed: 3 or more")));
  EXPECT_THAT(fault("solid x\nfacette\n"), HasSubstr("line 2: \"facette\" stands where \"endsolid\" should"));
  EXPECT_THAT(fault(plain.substr(0, plain.rfind("endsolid"))), HasSubstr("cut off"));
  EXPECT_THAT(fault(plain.substr(0, plain.rfind("vertex"))), HasSubstr("cut off"));
  EXPECT_THAT(fault("PK zip"), HasSubstr("neither text that begins with \"solid\" nor a whole binary STL"));
  EXPECT_THAT(fault(std::string("\xFF\xFEs\0o\0l\0i\0d\0", 12) + std::string(80, '\0')), HasSubstr("UTF-16"));
}

}  // namespace
}  // namespace pelagos
