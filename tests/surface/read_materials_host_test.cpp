// Which material each triangle of a file is of: OBJ groups and usemtl, PLY face properties,
// whatever else stands there; and files that say nothing, or nonsense.
#include <cstring>

#include "formats.hpp"
#include "shapes.hpp"
#include "surface/read/read_surface.hpp"

namespace firmtouch::tools {
namespace {

Imported read(const std::string& bytes, const char* name,
              MaterialsAre materials = MaterialsAre::kRead) {
  return read_surface_bytes(bytes, name, 1, PointsAre::kRefused, materials);
}

const std::string kFiveVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";

bool is_of(const Imported& read, const std::vector<uint32_t>& of,
           const std::vector<std::string>& names) {
  const bool good =
      read.problem.empty() && read.materials.of == of && read.materials.names == names;
  if (!good) {
    std::printf("  %s\n ", read.problem.c_str());
    for (const uint32_t number : read.materials.of) std::printf(" %u", number);
    for (const std::string& name : read.materials.names) std::printf(" %s", name.c_str());
    std::printf("\n");
  }
  return good;
}

std::string ply(const std::string& type, const std::string& faces,
                const std::string& property = "material_index") {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
         "float z\nelement face 2\nproperty list uchar int vertex_indices\nproperty " +
         type + " " + property + "\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces;
}

bool refuses(const std::string& bytes, const char* name, const char* what) {
  const std::string problem = read(bytes, name).problem;
  if (!says(problem, what)) std::printf("  wanted `%s`, got: %s\n", what, problem.c_str());
  return says(problem, what);
}

}  // namespace

TEST(ObjMaterial_IsThatOfTheLastUsemtl_PolygonsInAllTheirTriangles) {
  CHECK(is_of(
      read(kFiveVertices + "f 1 2 3\nusemtl skin # soft\nf 1 2 3 4\nusemtl bone\nf 1 2 5\nusemtl "
                           "skin\nf 2 3 5\n",
           "a.obj"),
      {0, 1, 1, 2, 1}, {"skin", "bone"}));
  // Without mtllib, or with one that is not there, and beside groups.
  CHECK(
      is_of(read("mtllib none.mtl\ng lid\n" + kFiveVertices + "usemtl a\nf 1 2 3\ng box\nf 1 3 4\n",
                 "a.obj"),
            {1, 1}, {"a"}));
}

TEST(ObjWithoutUsemtl_HasTheMaterialsOfItsGroups) {
  CHECK(is_of(read(kFiveVertices + "g lid all\nf 1 2 3\ng\nf 1 3 4\ng lid\nf 1 2 5\n", "a.obj"),
              {1, 0, 1}, {"lid"}));
  CHECK(is_of(read(kFiveVertices + "# usemtl none\nf 1 2 3\n", "a.obj"), {0}, {}));
}

TEST(Obj_BlanksInANameOfAMaterial_AreUnderscores) {
  CHECK(is_of(read(kFiveVertices + "usemtl steel  brushed # 2\nf 1 2 3\nusemtl steel polished\n"
                                   "f 1 2 4\n",
                   "a.obj"),
              {1, 2}, {"steel_brushed", "steel_polished"}));
}

TEST(ObjOf300Materials_IsReadAsItIs) {
  std::string text = kFiveVertices;
  std::vector<uint32_t> of;
  std::vector<std::string> names;
  for (uint32_t i = 1; i <= 300; ++i) {
    names.push_back("m" + std::to_string(i));
    of.push_back(i);
    text += "usemtl " + names.back() + "\nf 1 2 3\n";
  }
  CHECK(is_of(read(text, "a.obj"), of, names));
}

TEST(PlyMaterial_IsAPropertyOfItsFaces) {
  const std::string faces = "3 0 1 2 7\n3 0 2 3 0\n";
  CHECK(is_of(read(ply("uchar", faces), "a.ply"), {7, 0}, {}));
  CHECK(is_of(read(ply("int", faces, "material"), "a.ply"), {7, 0}, {}));
  CHECK(is_of(read(ply("float", faces), "a.ply"), {7, 0}, {}));
  CHECK(is_of(read(ply("uchar", faces, "flags"), "a.ply"), {0, 0}, {}));
  // A polygon's number is that of all its triangles; binary.
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty uchar "
      "material_index\nproperty "
      "list uchar uchar vertex_index\nelement vertex 4\nproperty char x\nproperty char y\nproperty "
      "char z\nend_header\n";
  binary += std::string("\x05\x04\x00\x01\x02\x03", 6) +
            std::string("\x00\x00\x00\x01\x00\x00\x01\x01\x00\x00\x01\x00", 12);
  CHECK(is_of(read(binary, "a.ply"), {5, 5}, {}));
}

TEST(MaterialsThatAreNonsense_AreRefusedByPlace) {
  CHECK(refuses(ply("int", "3 0 1 2 -1\n3 0 2 3 0\n"), "a.ply", "a material that is not a whole"));
  CHECK(refuses(ply("int", "3 0 1 2 0\n3 0 2 3 256\n"), "a.ply", "16: face 1 (from 0)"));
  CHECK(refuses(ply("float", "3 0 1 2 1.5\n3 0 2 3 0\n"), "a.ply", "from 0 (none) to 255"));
  CHECK(refuses(ply("float", "3 0 1 2 nan\n3 0 2 3 0\n"), "a.ply", "(once)"));
  CHECK(refuses(ply("int", "3 0 1 2\n3 0 2 3\n"), "a.ply", "more values on the line"));
  CHECK(refuses(kFiveVertices + "usemtl\nf 1 2 3\n", "a.obj", "a.obj:6: usemtl without the name"));
}

// Whoever bakes without materials reads such files as ever.
TEST(MaterialsThatAreNotWanted_ArePassedOver) {
  const Imported odd =
      read(ply("int", "3 0 1 2 -1\n3 0 2 3 999\n"), "a.ply", MaterialsAre::kPassedOver);
  CHECK(odd.problem.empty() && odd.materials.of.empty());
  const Imported empty =
      read(kFiveVertices + "usemtl\nf 1 2 3\n", "a.obj", MaterialsAre::kPassedOver);
  CHECK(empty.problem.empty() && empty.materials.of.empty());
}

}  // namespace firmtouch::tools
