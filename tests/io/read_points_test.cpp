// Points from files: what is kept, what is refused, and by which line.
#include <algorithm>
#include <array>
#include <cmath>

#include "plume/io/read_surface.h"
#include "plume/mesh/error.h"
#include "read_test_files.h"

namespace plume::test {
namespace {

class ReadPoints : public FileTest {
 protected:
  TriangleSurface surface(const std::string& name, const std::string& contents) {
    notices.clear();
    return read_surface(write(name, contents), {},
                        [&](const std::string& line) { notices.push_back(line); });
  }

  std::string refused(const std::string& name, const std::string& contents) {
    const auto file = write(name, contents);
    try {
      read_surface(file);
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.find(file.string()), 0u) << message;
      return message.substr(std::min(message.size(), file.string().size() + 2));
    }
    return "no error";
  }

  std::vector<std::string> notices;
};

const Field& field_of(const PointSet& points, const std::string& name) {
  for (const Field& field : points.fields)
    if (field.name == name) return field;
  ADD_FAILURE() << "no field " << name;
  return points.fields.at(0);
}

using Numbers = std::vector<double>;

TEST_F(ReadPoints, FromATableWithAHeader) {
  const PointSet points = surface("a.csv",
                                  "\xEF\xBB\xBF# a probe\n\n\"T\", z ,Y,x\r\n"
                                  "300,3,2,1\r\n+3.5e2,6,5,-4\n")
                              .vertices;
  EXPECT_EQ(values(points.points), (Numbers{1, 2, 3, -4, 5, 6}));
  ASSERT_EQ(points.fields.size(), 1u);
  EXPECT_EQ(values(field_of(points, "T").values), (Numbers{300, 350}));
}

TEST_F(ReadPoints, FromATableOfNumbersAlone) {
  for (const auto& [name, text] : {std::pair{"a.csv", "1,2,3,4,5\n6,7,8,9,nan"},
                                   {"b.csv", "1;2;3;4;5\n6;7;8;9;nan\n"},
                                   {"c.csv", "1\t2\t3\t4\t5\n6\t7\t8\t9\tnan\n"},
                                   {"d.xyz", " 1.0 2 3   4\t5 \n6 7 8 9 nan\n"}}) {
    SCOPED_TRACE(name);
    const PointSet points = surface(name, text).vertices;
    EXPECT_EQ(values(points.points), (Numbers{1, 2, 3, 6, 7, 8}));
    ASSERT_EQ(points.fields.size(), 2u);
    EXPECT_EQ(values(field_of(points, "value_1").values), (Numbers{4, 9}));
    EXPECT_TRUE(std::isnan(field_of(points, "value_2").values.at<double>(1)));
  }
  EXPECT_EQ(surface("e.xyz", "0 0 0 7\n").vertices.fields[0].name, "value");
  EXPECT_TRUE(surface("f.xyz", "0 0 0\n").vertices.fields.empty());
}

TEST_F(ReadPoints, FromParaViewsTables) {
  const PointSet points = surface("a.csv",
                                  "\"p\",\"velocity:0\",\"velocity:1\",\"velocity:2\",\"Points:0\","
                                  "\"Points:1\",\"Points:2\",\"velocity:9\"\n"
                                  "1,2,3,4,5,6,7,8\n")
                              .vertices;
  EXPECT_EQ(values(points.points), (Numbers{5, 6, 7}));
  EXPECT_EQ(field_of(points, "velocity").components, 3);
  EXPECT_EQ(values(field_of(points, "velocity").values), (Numbers{2, 3, 4}));
  EXPECT_EQ(values(field_of(points, "velocity:9").values), (Numbers{8}));
}

TEST_F(ReadPoints, NamesTheLineAndTheColumn) {
  EXPECT_EQ(refused("a.csv", "x,y,z,T\n1,2,3,4\n1,2,3,hot\n"),
            "line 3, column 4 (T): 'hot' is no number; write it with a point, the exponent with e");
  EXPECT_EQ(refused("b.csv", "x,y,z,T\n\n1,nan,3,4\n"),
            "line 3, column 2 (y): the coordinate is 'nan', and must be finite; remove or repair "
            "the point");
  EXPECT_EQ(refused("c.csv", "x,y,z,T\n1,2,3,\n"),
            "line 2, column 4 (T): is empty; write nan where there is no value");
  EXPECT_EQ(refused("d.csv", "x,y,z,T\n1,2,3,4\n1,2,3\n"), "line 3 has 3 columns instead of 4");
  EXPECT_EQ(
      refused("e.csv", "a,b,c\n1,2,3\n"),
      "line 1: no columns x, y and z among 'a, b, c'; name them, or leave out the header where "
      "they come first");
  EXPECT_EQ(refused("f.csv", "1,2\n"), "line 1 has 2 columns; a point needs x, y and z");
  EXPECT_EQ(refused("g.csv", "x,y,z\n"), "a header and no points");
  EXPECT_EQ(refused("h.csv", "# nothing\n"), "no points in it");
  EXPECT_NE(refused("i.csv", "0,0,0\n1,1e999,0\n").find("line 2, column 2 (y): '1e999'"),
            std::string::npos);
  EXPECT_NE(refused("j.xyz", "0.5 0 0\n1 1.0D0 0\n").find("line 2, column 2 (y): '1.0D0'"),
            std::string::npos);
  EXPECT_NE(refused("k.csv", "0;0;0,5\n").find("line 1"), std::string::npos);
}

TEST_F(ReadPoints, TellsPlot3dFromPoints) {
  const std::string grid = "2 2 2\n0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n0 0 0 0 1 1 1 1\n";
  EXPECT_EQ(read(write("grid.xyz", grid)).mesh.dimensions[0], 2);
  // Cut short it is no point cloud.
  const std::string cut = error_of(write("cut.xyz", "2 2 2\n0 1 0\n1 0 1\n"));
  EXPECT_NE(cut.find("truncated"), std::string::npos) << cut;
  EXPECT_NE(cut.find("x y z"), std::string::npos) << cut;
  EXPECT_EQ(surface("header.xyz", "x y z\n2 2 2\n0 1 0\n").vertices.point_count(), 2u);
  EXPECT_EQ(surface("zero.xyz", "0 0 0\n1 1 1\n").vertices.point_count(), 2u);
}

const std::string kPlyHeader =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty list uchar int neighbours\nproperty double T\n";

TEST_F(ReadPoints, FromTextPly) {
  const TriangleSurface whole =
      surface("a.ply",
              "ply\nformat ascii 1.0\ncomment by hand\nelement material 1\n"
              "property int unused\n" +
                  kPlyHeader +
                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                  "9\n0 0 0 255 2 1 2 0.5\n1 0 0 7 0 1.5\n0 1 0 8 1 0 -2\n3 0 1 2\n");
  EXPECT_EQ(values(whole.vertices.points), (Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(values(field_of(whole.vertices, "T").values), (Numbers{0.5, 1.5, -2}));
  EXPECT_EQ(field_of(whole.vertices, "red").values.type(), Array::Type::uint8);
  EXPECT_EQ(values(field_of(whole.vertices, "red").values), (Numbers{255, 7, 8}));
  ASSERT_EQ(whole.triangles.size(), 1u);
  EXPECT_EQ(whole.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST_F(ReadPoints, FromBinaryPly) {
  const std::string header =
      "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
      "property short s\nend_header\n";
  std::string little, big;
  const auto append = [&](auto value) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    little += raw;
    big += std::string(raw.rbegin(), raw.rend());
  };
  for (int i = 0; i < 2; ++i) {
    for (const double x : {1.5 * i, -2.0, 1e300}) append(x);
    append(static_cast<std::int16_t>(-300 * i));
  }
  for (const auto& [format, bytes] :
       {std::pair{"binary_little_endian", little}, {"binary_big_endian", big}}) {
    const std::string start = std::string("ply\nformat ") + format + " 1.0\n" + header;
    const PointSet points = surface("a.ply", start + bytes).vertices;
    EXPECT_EQ(values(points.points), (Numbers{0, -2, 1e300, 1.5, -2, 1e300}));
    EXPECT_EQ(values(field_of(points, "s").values), (Numbers{0, -300}));
    for (std::size_t cut = 1; cut < bytes.size(); cut += 5)
      EXPECT_NE(refused("cut.ply", start + bytes.substr(0, cut)).find("truncated"),
                std::string::npos);
  }
}

TEST_F(ReadPoints, NamesWhatIsWrongWithAPly) {
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(refused("a.ply", start + "element vertex 2\n" + xyz + "end_header\n0 0 0\n0 up 0\n"),
            "vertex 1 of 2, property y: 'up' is no number");
  EXPECT_EQ(refused("b.ply", start + "element vertex 1\n" + xyz + "end_header\n0 0 inf\n"),
            "vertex 0 of 1, property z: the coordinate is inf, and must be finite");
  EXPECT_EQ(refused("c.ply", start + "element vertex 1\n" + xyz +
                                 "element face 1\nproperty list uchar int vertex_index\n"
                                 "end_header\n0 0 0\n3 0 1 2\n"),
            "face 0 has vertex 1, and there are 1; write the file again");
  EXPECT_NE(refused("d.ply", start + "element vertex 99999999999\n" + xyz + "end_header\n0 0 0\n")
                .find("truncated"),
            std::string::npos);
  EXPECT_NE(refused("e.ply", start + "element vertex 1\nproperty float x\nend_header\n0\n")
                .find("no properties x, y and z"),
            std::string::npos);
  EXPECT_NE(refused("f.ply", "ply\nelement vertex 1\nend_header\n").find("no format"),
            std::string::npos);
  EXPECT_NE(refused("g.ply", start + "element vertex 1\nproperty quux x\nend_header\n")
                .find("'quux' is no type"),
            std::string::npos);
}

std::string poly_data(const std::string& cells) {
  return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n"
         "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n" +
         cells + "POINT_DATA 5\nSCALARS s float\nLOOKUP_TABLE default\n1 2 3 4 5\n";
}

std::string vtp(const std::string& verts) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"4\" NumberOfVerts=\"" +
         std::string(verts.empty() ? "0" : "1") +
         "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\"><PointData "
         "Scalars=\"T\"><DataArray type=\"Float32\" Name=\"T\" format=\"ascii\">1 2 3 4</DataArray>"
         "</PointData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>" +
         verts + "</Piece></PolyData></VTKFile>\n";
}

TEST_F(ReadPoints, FromVtksDataSets) {
  const std::string verts =
      "<Verts><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray></Verts>";
  for (const std::string& text : {vtp(""), vtp(verts)}) {
    const PointSet points = surface("a.vtp", text).vertices;
    EXPECT_EQ(points.point_count(), 4u);
    EXPECT_EQ(points.active_field, "T");
    EXPECT_EQ(values(field_of(points, "T").values), (Numbers{1, 2, 3, 4}));
  }
  for (const std::string cells : {"", "VERTICES 5 10\n1 0\n1 1\n1 2\n1 3\n1 4\n"}) {
    const TriangleSurface read_back = surface("b.vtk", poly_data(cells));
    EXPECT_EQ(read_back.vertices.point_count(), 5u);
    EXPECT_TRUE(read_back.triangles.empty());
    EXPECT_EQ(values(field_of(read_back.vertices, "s").values), (Numbers{1, 2, 3, 4, 5}));
  }
  const std::string grid =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
      "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 2 6\n1 0\n3 1 2 3\nCELL_TYPES 2\n1\n2\n";
  EXPECT_EQ(surface("c.vtk", grid).vertices.point_count(), 4u);
}

TEST_F(ReadPoints, SurfacesFromVtksReaders) {
  const TriangleSurface quads = surface("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(quads.triangles.size(), 2u);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_NE(notices[0].find("1 polygons cut into triangles"), std::string::npos) << notices[0];
  const TriangleSurface facet = surface(
      "b.stl",
      "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 "
      "0\n  endloop\n endfacet\nendsolid a\n");
  EXPECT_EQ(facet.triangles.size(), 1u);
  EXPECT_EQ(facet.vertices.point_count(), 3u);
  EXPECT_EQ(surface("c.vtk", poly_data("POLYGONS 1 4\n3 0 1 2\n")).triangles.size(), 1u);
  EXPECT_NE(refused("d.vtk", poly_data("LINES 1 3\n2 0 1\n")).find("neither points alone"),
            std::string::npos);
  EXPECT_NE(refused("e.vtk", poly_data("POLYGONS 1 4\n3 0 1 9\n")).find("uses point 9 of 5"),
            std::string::npos);
}

TEST_F(ReadPoints, RefusesWhatHasCellsAlready) {
  const std::string grid =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
      "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  EXPECT_EQ(refused("a.vtk", grid), "has volume cells already; render it as it is");
}

TEST_F(ReadPoints, BecomeAMeshWithANotice) {
  const auto file = write("a.csv", "x,y,z,T\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n0,0,1,5\n");
  if (!has_engine(TetrahedralizationEngine::automatic)) {
    EXPECT_NE(error_of(file).find("PLUME_WITH_TETGEN"), std::string::npos);
    GTEST_SKIP() << "SKIPPED FOR LACK OF AN ENGINE";
  }
  for (const auto& [engine, name] : {std::pair{TetrahedralizationEngine::tetgen, "TetGen"},
                                     {TetrahedralizationEngine::cgal, "CGAL"}}) {
    if (!has_engine(engine)) continue;
    const Read result = read(file, {.engine = engine});
    EXPECT_EQ(result.mesh.cell_count(), 1u);
    EXPECT_EQ(values(field(result.mesh, "T")->values), (Numbers{1, 2, 3, 4}));
    EXPECT_TRUE(result.was_told(std::string("5 points became 1 tetrahedra (by ") + name));
    EXPECT_TRUE(result.was_told("1 points in the place of an earlier one: left out: 4"));
    EXPECT_TRUE(result.was_told("1 of the points left out have other values"));
  }
  const std::string flat = error_of(write("flat.csv", "0,0,0\n1,0,0\n0,1,0\n1,1,0\n"));
  EXPECT_NE(flat.find("flat.csv: points without cells: "), std::string::npos) << flat;
  EXPECT_NE(flat.find("in the plane of point 0 (0, 0, 0)"), std::string::npos) << flat;
}

TEST_F(ReadPoints, OfSeveralPiecesAreOneSet) {
  if (!has_engine(TetrahedralizationEngine::automatic))
    GTEST_SKIP() << "SKIPPED FOR LACK OF AN ENGINE";
  write("part.vtp", vtp(""));
  const auto file = write(
      "a.vtm",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
      "byte_order=\"LittleEndian\"><vtkMultiBlockDataSet><DataSet index=\"0\" file=\"part.vtp\"/>"
      "<DataSet index=\"1\" file=\"part.vtp\"/></vtkMultiBlockDataSet></VTKFile>\n");
  const Read result = read(file);
  EXPECT_TRUE(result.was_told("8 points became 1 tetrahedra"));
}

TEST_F(ReadPoints, OfASurfaceAreNotTakenUnasked) {
  const std::string message = error_of(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_NE(message.find("no volume cells, only 1 triangle"), std::string::npos) << message;
  EXPECT_NE(message.find("plume tetrahedralize"), std::string::npos) << message;
}

}  // namespace
}  // namespace plume::test
