#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_files.hpp"

namespace pelagos {
namespace {

using test::first_fault;
using test::imported;
using test::replaced;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A box of 2 x 1 x 3, in quads.
const std::string kVertices = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 3\nv 2 0 3\nv 2 1 3\nv 0 1 3\n";
const std::string kFaces = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Dialect {
  const char* name;
  std::string text;
};
void PrintTo(const Dialect& dialect, std::ostream* out) { *out << dialect.name; }

class ObjDialect : public ::testing::TestWithParam<Dialect> {};

TEST_P(ObjDialect, IsTheSameBox) {
  const ImportedMesh mesh = imported("box.obj", GetParam().text);
  ASSERT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
  EXPECT_THAT(mesh.triangles, SizeIs(12));
  EXPECT_DOUBLE_EQ(test::volume_of(mesh), 6.0);
  EXPECT_TRUE(test::is_closed(mesh));
}

std::vector<Dialect> dialects() {
  const std::string plain = kVertices + kFaces;
  return {
      {"Plain", plain},
      {"NoEndOfLastLine", plain.substr(0, plain.size() - 1)},
      {"CarriageReturnAndLineFeed", replaced(plain, "\n", "\r\n")},
      {"CarriageReturn", replaced(plain, "\n", "\r")},
      {"ByteOrderMark", "\xEF\xBB\xBF" + plain},
      {"LeadingBlanksAndTabs", replaced(replaced("\n" + plain, "\n", "\n \t "), " 0", "\t 0 ")},
      {"FacesBeforeVertices", kFaces + kVertices},
      {"NegativeIndices", kVertices + "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"},
      {"LineContinuation", replaced(kVertices, "2 1 ", "2 \\\n1 ") + replaced(kFaces, "f 5 6 ", "f 5 6\\\r\n")},
      {"TexturesAndNormals",
       "vt 0 0\nvn 0 0 1\n" + kVertices +
           "f 4/1 3/1 2/1 1/1\nf 5//1 6//1 7//1 8//1\nf 1/1/1 2/1/1 6/1/1 5/1/1\nf 2 3 7 6\nf 3/-1 "
           "4/-1 8/-1 7/-1\nf 4 1 5 8\n"},
      {"WeightsAndColours",
       replaced(replaced(kVertices, "v 0 0 0", "v 0 0 0 1.0"), "v 2 1 3", "v 2 1 3 .5 .5 1") + kFaces},
      {"Numbers", replaced(replaced(replaced(kVertices, " 2 ", " +2. "), " 3", " 3.E+0"), " 1 ", " 1000e-3 ") + kFaces},
      {"Comments", "# 5, 6\n" + replaced(kVertices, "\n", " # a corner\n") + replaced(kFaces, "\n", " # 9 9\n")},
      {"OldFaces", kVertices + replaced(kFaces, "f ", "fo ")},
      {"PointsLinesAndFreeForms", kVertices +
                                      "p 1\nl 1 2 3\ncstype bezier\ndeg 3\ncurv 0 1 1 2\nparm u 0 1\nend\nf 1 2\n" +
                                      kFaces + "vp 0 1\nunheard of\n"},
      {"ObjectsGroupsMaterials", "mtllib none.mtl\no hull\ng\n" + kVertices + "usemtl red\ns 1\n" + kFaces},
      {"EdgesThereAndBack",
       replaced(replaced(replaced(kVertices + kFaces, "f 5 6 7 8", "f 5 6 7 1 7 8"), "f 1 2 6 5", "f 8 1 2 6 5 1"),
                "f 2 3 7 6", "f 8 2 3 7 6 2")},
      {"CornersTwice", replaced(replaced(kVertices + kFaces, "f 5 6 7 8", "f 5 6 6 7 8 8 5"), "f 4 3", "f 4 4 3")},
  };
}

INSTANTIATE_TEST_SUITE_P(Obj, ObjDialect, ::testing::ValuesIn(dialects()),
                         [](const auto& test) { return std::string(test.param.name); });

struct Refusal {
  const char* name;
  std::string text;
  std::vector<std::string> says;
};
void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

class ObjRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(ObjRefusal, NamesTheLine) {
  const ImportedMesh mesh = imported("box.obj", GetParam().text);
  ASSERT_THAT(mesh.faults, SizeIs(1));
  EXPECT_THAT(mesh.triangles, IsEmpty());
  for (const std::string& words : GetParam().says) EXPECT_THAT(first_fault(mesh), HasSubstr(words));
}

std::vector<Refusal> refusals() {
  return {
      {"DecimalComma", "v 0 0 0\nv 1,5 0 0\n", {"line 2", "\"1,5\" has a decimal comma", "1.5"}},
      {"CommasBetween", "v 0, 0, 0\n", {"line 1", "comma"}},
      {"NotANumber", "v 0 0 0\r\nv 0 nan 0\r\n", {"line 2", "\"nan\"", "finite"}},
      {"Infinite", "v 0 0 1e999\n", {"line 1", "\"1e999\""}},
      {"WordForNumber", "v one 0 0\n", {"line 1", "\"one\""}},
      {"TwoCoordinates", "\n\nv 1 2\n", {"line 3", "missing"}},
      {"BrokenCharacters", "v 0 0 \xFF\x1B[2J\xC2\x9B\xC3\xA9\n", {"line 1", "\"??[2J??\xC3\xA9\""}},
      {"VertexOfNone", kVertices + kFaces + "f 1 2 9\n", {"line 15", "vertex 9", "8"}},
      {"VertexZero", kVertices + "f 0 1 2\n", {"line 9", "vertex 0", "the first is 1"}},
      {"VertexBeforeTheFirst", kVertices + "f -1 -2 -9\n", {"line 9", "vertex -9"}},
      {"VertexBeyondNumbers", "f 1 2 99999999999999999999\n", {"line 1"}},
      {"CornerOfWords", kVertices + "f a b c\n", {"line 9", "\"a\"", "7//3"}},
      {"LineCountsContinued", "v 0 0 \\\n0\nv x 0 0\n", {"line 3"}},
      {"Utf16", std::string("\xFF\xFEv\0 \0", 6), {"UTF-16", "UTF-8"}},
      {"ZeroByte", std::string("v 0 0 0\nv 0\0 0 0\n", 17), {"line 2", "no text"}},
      {"Empty", "", {"no triangles"}},
      {"SurfacesOnly", "v 0 0 0\ncstype bspline\nsurf 0 1 0 1 1\n", {"line 3", "save the mesh as polygons"}},
      {"PolygonThatCrossesItself",
       "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 4 0\nv -1 2 0\n\nf 1 2 3 4 5\n",
       {"the face at line 7", "crosses itself"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Obj, ObjRefusal, ::testing::ValuesIn(refusals()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Obj, APolygonWithACornerInTheMiddleOfAnEdgeIsAPolygon) {
  // A slab with corners in the middle of its long sides, which the neighbours there have too.
  const std::string slab =
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 0 1 1\n"
      "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";
  const ImportedMesh mesh = imported("slab.obj", slab);
  ASSERT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
  EXPECT_TRUE(test::is_closed(mesh));
  EXPECT_NEAR(test::volume_of(mesh), 2.0, 1e-12);
  EXPECT_GT(test::least_area(mesh), 0.1);
}

TEST(Obj, TrianglesKnowTheirObjectGroupAndLine) {
  const ImportedMesh mesh = imported("parts.obj", kVertices +
                                                      "f 1 2 3\no hull\nf 4 3 2 1\ng keel\nf 5 6 7\no mast\x1B[31m\n"
                                                      "f 5 6 7\no hull\nf 1 2 3\n");
  ASSERT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
  std::vector<std::string> names;
  for (const ImportedPart& part : mesh.parts) names.push_back(part.name);
  EXPECT_THAT(names, ElementsAre("", "object \"hull\"", "object \"hull\", group \"keel\"", "object \"mast?[31m\""));
  std::vector<std::uint32_t> parts, lines;
  for (const ImportedTriangle& triangle : mesh.triangles) {
    parts.push_back(triangle.part);
    lines.push_back(triangle.place);
  }
  EXPECT_THAT(parts, ElementsAre(0, 1, 1, 2, 3, 1));
  EXPECT_THAT(lines, ElementsAre(9, 11, 11, 13, 15, 17)) << "both triangles of the quad stand in line 11";
  EXPECT_EQ(mesh.parts[1].place, "the face at line");
}

TEST(Obj, ColoursComeFromLibrariesInItsOwnFolderOnly) {
  const test::MeshFiles files;
  files.write("inner/a b.mtl", "newmtl red\nKd 1 0.25 0\nnewmtl other\nKd 0 0 1\n");
  files.write("stolen.mtl", "newmtl green\nKd 0 1 0\n");
  const std::string text = "mtllib a b.mtl\nmtllib ../stolen.mtl none.mtl\n" + kVertices +
                           "f 1 2 3\nusemtl red\nf 1 2 4\nusemtl green\nf 1 2 5\n";
  const auto path = files.write("inner/hull.obj", text);
  const ImportedMesh plain = import_mesh(path);
  EXPECT_THAT(plain.materials, SizeIs(1));
  EXPECT_THAT(plain.notes, IsEmpty()) << "nothing is opened that is not asked for";
  const ImportedMesh mesh = import_mesh(path, {.materials = true});
  ASSERT_THAT(mesh.faults, IsEmpty()) << first_fault(mesh);
  ASSERT_THAT(mesh.materials, SizeIs(3));
  EXPECT_THAT(mesh.materials[mesh.triangles[1].material].colour, ElementsAre(1.0F, 0.25F, 0.0F));
  EXPECT_THAT(mesh.materials[mesh.triangles[2].material].colour, ElementsAre(0.5F, 0.5F, 0.5F)) << "grey";
  EXPECT_THAT(mesh.notes,
              ElementsAre(AllOf(HasSubstr("../stolen.mtl"), HasSubstr("own folder or below")), HasSubstr("none.mtl")));
}

}  // namespace
}  // namespace pelagos
