// Steps of files that hold several, and of several files: found, read in any order, and what stays.
#include "plume/io/time_series.h"

#include <vtkDoubleArray.h>
#include <vtkExodusIIWriter.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridAlgorithm.h>
#include <vtk_cgns.h>
#include VTK_CGNS(cgnslib.h)

#include <algorithm>
#include <future>

#include "plume/datasets/generate.h"
#include "plume/io/find_files.h"
#include "plume/io/numbered_name.h"
#include "plume/io/write_mesh.h"
#include "plume/io/write_pvd.h"
#include "plume/mesh/error.h"
#include "plume/mesh/same_mesh.h"
#include "read_test_files.h"

namespace plume::test {
namespace {

using SeriesFiles = FileTest;

TEST(NumberedName, MakesAndReadsNumbers) {
  for (const std::string text : {"frame_%d.png", "%04d", "100%%_%012d", "a%5d_%01d.vtu"}) {
    const auto name = NumberedName::in(text);
    ASSERT_TRUE(name) << text;
    for (const std::uint64_t number : {0u, 7u, 10u, 9999u, 10000u, 4294967295u})
      EXPECT_EQ(name->number_in(name->at(number)), number) << name->at(number);
  }
  EXPECT_EQ(NumberedName::in("f_%04d.png")->at(12), "f_0012.png");
  EXPECT_EQ(NumberedName::in("100%%_%d")->at(5), "100%_5");
  for (const std::string text : {"plain.png", "50%.png", "%i", "%5d", "%0d", "%00d", "%019d", "%"})
    EXPECT_FALSE(NumberedName::in(text)) << text;
  const auto name = *NumberedName::in("t%02d.vtu");
  for (const std::string other : {"t1.vtu", "t001.vtu", "t.vtu", "t+1.vtu", "t-1.vtu", "t12.vtk",
                                  "x12.vtu", "t1 .vtu", "t99999999999999999999.vtu"})
    EXPECT_FALSE(name.number_in(other)) << other;
  EXPECT_THROW(NumberedName::in("%d_%03d"), Error);
}

TEST(NaturalOrder, CountsDigitsAsNumbers) {
  const std::vector<std::string> ordered{"a",
                                         "a01",
                                         "a1",
                                         "a1b",
                                         "a2",
                                         "a10",
                                         "a10x2",
                                         "a10x10",
                                         "a99999999999999999999",
                                         "a100000000000000000000",
                                         "b",
                                         "b-1"};
  std::vector<std::string> shuffled(ordered.rbegin(), ordered.rend());
  std::sort(shuffled.begin(), shuffled.end(), natural_less);
  EXPECT_EQ(shuffled, ordered);
  for (const std::string& a : ordered)
    for (const std::string& b : ordered)
      EXPECT_EQ(int{natural_less(a, b)} + int{natural_less(b, a)}, a == b ? 0 : 1) << a << " " << b;
}

std::vector<std::string> names(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> list;
  for (const auto& file : files) list.push_back(file.filename().string());
  return list;
}

TEST_F(SeriesFiles, AreFoundByPatternsInTheOrderOfTheirNumbers) {
  for (const std::string name : {"t_10.vtu", "t_9.vtu", "t_0.vtu", "t_009.vtu", "t_x.vtu",
                                 "t_1.vtk", "[a]_2.vtu", "[a]_1.vtu", "a_3.vtu"})
    write(name, "x");
  const auto find = [&](const std::string& pattern) {
    return names(find_files(path(pattern).string()));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(find("t_%d.vtu"), (Names{"t_0.vtu", "t_9.vtu", "t_10.vtu"}));
  EXPECT_EQ(find("t_%03d.vtu"), (Names{"t_009.vtu"}));
  EXPECT_EQ(find("t_?.vtu"), (Names{"t_0.vtu", "t_9.vtu", "t_x.vtu"}));
  EXPECT_EQ(find("t_[0-9]*.vt?"),
            (Names{"t_0.vtu", "t_1.vtk", "t_009.vtu", "t_9.vtu", "t_10.vtu"}));
  // In a printf-like pattern, wildcards are what they look like.
  EXPECT_EQ(find("[a]_%d.vtu"), (Names{"[a]_1.vtu", "[a]_2.vtu"}));
  // A file of that very name is no pattern.
  EXPECT_FALSE(is_file_pattern(path("[a]_1.vtu").string()));
  EXPECT_TRUE(is_file_pattern(path("[b]_1.vtu").string()));
  EXPECT_FALSE(is_file_pattern(path("t_1.vtu").string()));
  for (const std::string pattern : {"none_*.vtu", "none_%d.vtu", "nowhere/t_*.vtu"}) {
    try {
      TimeSeries series(path(pattern).string());
      ADD_FAILURE() << pattern;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(pattern + ": no file matches"), std::string::npos);
    }
  }
}

// Steps read in a wild order from one TimeSeries, in another thread, are those that fresh readers
// read; and nothing that is read later changes them. Says whether points and cells stay.
bool reads_as_one_by_one(const std::filesystem::path& file, const std::vector<double>& times) {
  TimeSeries series(file.string());
  EXPECT_EQ(series.size(), times.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < times.size(); ++i) {
    order.insert(order.begin(), i);
    order.push_back(i);
  }
  std::vector<Mesh> meshes;
  for (const std::size_t step : order) {
    const auto read = std::async(std::launch::async, [&] { return series.read(step); }).get();
    EXPECT_EQ(read.time, times[step]);
    EXPECT_EQ(series.time(step), times[step]);
    meshes.push_back(read.mesh);
  }
  bool stays = true;
  for (std::size_t i = 0; i < order.size(); ++i) {
    SCOPED_TRACE("step " + std::to_string(order[i]));
    const Mesh alone = read_mesh(file, {.time_step = static_cast<int>(order[i])});
    EXPECT_TRUE(same_points_and_cells(meshes[i], alone));
    stays = stays && same_points_and_cells(meshes[i], meshes[0]);
    EXPECT_EQ(meshes[i].fields.size(), alone.fields.size());
    for (std::size_t f = 0; f < std::min(meshes[i].fields.size(), alone.fields.size()); ++f) {
      EXPECT_EQ(meshes[i].fields[f].name, alone.fields[f].name);
      EXPECT_EQ(values(meshes[i].fields[f].values), values(alone.fields[f].values));
    }
  }
  return stays;
}

// Two tetrahedra whose pressure at a time t is 100 t + the point's number.
class PressureInTime : public vtkUnstructuredGridAlgorithm {
 public:
  static PressureInTime* New();
  vtkTypeMacro(PressureInTime, vtkUnstructuredGridAlgorithm) std::vector<double> times;

 protected:
  PressureInTime() { SetNumberOfInputPorts(0); }

  using Pipeline = vtkStreamingDemandDrivenPipeline;
  int RequestInformation(vtkInformation*, vtkInformationVector**,
                         vtkInformationVector* output) override {
    vtkInformation* const information = output->GetInformationObject(0);
    information->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    const double range[] = {times.front(), times.back()};
    information->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override {
    vtkInformation* const information = output->GetInformationObject(0);
    const double time = information->Has(Pipeline::UPDATE_TIME_STEP())
                            ? information->Get(Pipeline::UPDATE_TIME_STEP())
                            : times.front();
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> pressure;
    pressure->SetName("pressure");
    for (int i = 0; i < 5; ++i) {
      points->InsertNextPoint(i == 1 || i == 4, i == 2 || i == 4, i == 3 || i == 4);
      pressure->InsertNextValue(100 * time + i);
    }
    auto* const grid = vtkUnstructuredGrid::GetData(output);
    grid->Initialize();
    grid->Allocate(2);
    grid->SetPoints(points);
    for (const auto& cell : {std::array<vtkIdType, 4>{0, 1, 2, 3}, {1, 2, 3, 4}})
      grid->InsertNextCell(10, 4, cell.data());
    grid->GetPointData()->AddArray(pressure);
    grid->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
PressureInTime* PressureInTime::New() { VTK_STANDARD_NEW_BODY(PressureInTime); }

TEST_F(SeriesFiles, OfExodusHoldStepsOfOneMesh) {
  vtkNew<PressureInTime> source;
  source->times = {0.25, 0.5, 2};
  vtkNew<vtkExodusIIWriter> writer;
  const std::string file = path("pressure.ex2").string();
  writer->SetFileName(file.c_str());
  writer->SetInputConnection(source->GetOutputPort());
  writer->WriteAllTimeStepsOn();
  writer->SetStoreDoubles(1);
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_TRUE(reads_as_one_by_one(file, {0.25, 0.5, 2}));
  for (const int step : {0, 1, 2}) {
    const Mesh mesh = read_mesh(file, {.time_step = step});
    const double t = source->times[static_cast<std::size_t>(step)];
    EXPECT_EQ(range(*field(mesh, "pressure")), (std::array<double, 2>{100 * t, 100 * t + 4}));
  }
  EXPECT_FALSE(TimeSeries(file).range("pressure", Association::point));
}

// An EnSight geometry of two tetrahedra, the last point of which is at (1, 1, z).
std::string ensight_geometry(const std::string& z) {
  return "box\nbox\nnode id off\nelement id off\npart\n         1\nall\ncoordinates\n         5\n"
         "0.0\n1.0\n0.0\n0.0\n1.0\n0.0\n0.0\n1.0\n0.0\n1.0\n0.0\n0.0\n0.0\n1.0\n" +
         z +
         "\ntetra4\n         2\n         1         2         3         4\n"
         "         2         3         4         5\n";
}

std::string ensight_case(const std::string& geometry) {
  return "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: " + geometry +
         "\nVARIABLE\nscalar per node: 1 pressure text.p**\nTIME\ntime set: 1\n"
         "number of steps: 3\nfilename start number: 8\nfilename increment: 1\n"
         "time values: 0.0 0.5 1.25\n";
}

TEST_F(SeriesFiles, OfEnSightHoldVariablesAndGeometriesInTime) {
  for (const std::string step : {"08", "09", "10"}) {
    write("text.p" + step,
          "pressure\npart\n         1\ncoordinates\n1.\n2.\n3.\n4.\n" + step + "\n");
    write("text.g" + step, ensight_geometry("1." + step));
  }
  write("text.geo", ensight_geometry("1.0"));
  EXPECT_TRUE(reads_as_one_by_one(write("stays.case", ensight_case("text.geo")), {0, 0.5, 1.25}));
  const auto moves = write("moves.case", ensight_case("1 text.g**"));
  EXPECT_FALSE(reads_as_one_by_one(moves, {0, 0.5, 1.25}));
  const Mesh last = read_mesh(moves);
  EXPECT_FLOAT_EQ(last.points.at<float>(14), 1.1f);
  EXPECT_EQ(range(*field(last, "pressure")), (std::array<double, 2>{1, 10}));
}

TEST_F(OpenFoamCase, HoldsStepsOfOneMesh) {
  write_case();
  EXPECT_TRUE(reads_as_one_by_one(path("case"), {0, 1}));
  TimeSeries series(path("case").string());
  EXPECT_EQ(series.describe(1), "step 1 (time 1)");
}

TEST_F(SeriesFiles, OfCgnsHoldOneSolutionAStep) {
  const std::string file = path("steps.cgns").string();
  int id = 0, base = 0, zone = 0, index = 0;
  ASSERT_EQ(cg_open(file.c_str(), CG_MODE_WRITE, &id), CG_OK);
  ASSERT_EQ(cg_base_write(id, "Base", 3, 3, &base), CG_OK);
  const cgsize_t size[] = {5, 2, 0};
  ASSERT_EQ(cg_zone_write(id, base, "Zone", size, CGNS_ENUMV(Unstructured), &zone), CG_OK);
  const std::vector<double> axes[] = {{0, 1, 0, 0, 1}, {0, 0, 1, 0, 1}, {0, 0, 0, 1, 1}};
  const char* const axis_names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
  for (int a = 0; a < 3; ++a)
    ASSERT_EQ(cg_coord_write(id, base, zone, CGNS_ENUMV(RealDouble), axis_names[a], axes[a].data(),
                             &index),
              CG_OK);
  const cgsize_t cells[] = {1, 2, 3, 4, 2, 3, 4, 5};
  ASSERT_EQ(cg_section_write(id, base, zone, "Cells", CGNS_ENUMV(TETRA_4), 1, 2, 0, cells, &index),
            CG_OK);
  const std::vector<double> times{0.5, 1.5, 4};
  std::string pointers;
  for (int step = 0; step < 3; ++step) {
    std::string name = "Solution" + std::to_string(step);
    int solution = 0;
    ASSERT_EQ(cg_sol_write(id, base, zone, name.c_str(), CGNS_ENUMV(Vertex), &solution), CG_OK);
    std::vector<double> density;
    for (int p = 0; p < 5; ++p) density.push_back(10 * step + p);
    ASSERT_EQ(cg_field_write(id, base, zone, solution, CGNS_ENUMV(RealDouble), "Density",
                             density.data(), &index),
              CG_OK);
    name.resize(32, ' ');
    pointers += name;
  }
  ASSERT_EQ(cg_biter_write(id, base, "TimeIterValues", 3), CG_OK);
  ASSERT_EQ(cg_goto(id, base, "BaseIterativeData_t", 1, "end"), CG_OK);
  const cgsize_t count = 3, letters[] = {32, 3};
  ASSERT_EQ(cg_array_write("TimeValues", CGNS_ENUMV(RealDouble), 1, &count, times.data()), CG_OK);
  ASSERT_EQ(cg_ziter_write(id, base, zone, "ZoneIterativeData"), CG_OK);
  ASSERT_EQ(cg_goto(id, base, "Zone_t", zone, "ZoneIterativeData_t", 1, "end"), CG_OK);
  ASSERT_EQ(
      cg_array_write("FlowSolutionPointers", CGNS_ENUMV(Character), 2, letters, pointers.data()),
      CG_OK);
  ASSERT_EQ(cg_close(id), CG_OK);

  EXPECT_TRUE(reads_as_one_by_one(file, times));
  EXPECT_EQ(range(*field(read_mesh(file, {.time_step = 1}), "Density")),
            (std::array<double, 2>{10, 14}));
}

// Steps of the wake, whose mesh stays, as single files and as a list.
class StreetFiles : public FileTest {
 protected:
  static constexpr std::array<double, 3> times{0, 1.25, 3.5};
  Mesh at(double time) const { return generate("vortex-street", {.size = 6, .time = time}); }
  void write_steps() const {
    std::vector<PvdEntry> entries;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::string name = "street_" + std::to_string(8 + i) + ".vts";
      write_mesh(at(times[i]), path(name));
      entries.push_back({times[i], name});
    }
    write_pvd(entries, path("street.pvd"));
  }
};

TEST_F(StreetFiles, AreStepsByAListOrByAPattern) {
  write_steps();
  EXPECT_TRUE(reads_as_one_by_one(path("street.pvd"), {0, 1.25, 3.5}));
  TimeSeries by_name(path("street_%d.vts").string());
  ASSERT_EQ(by_name.size(), 3u);
  EXPECT_EQ(by_name.file(2), path("street_10.vts"));
  EXPECT_FALSE(by_name.time(2));
  EXPECT_EQ(by_name.describe(2), "step 2 (" + path("street_10.vts").string() + ")");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto read = by_name.read(i);
    EXPECT_FALSE(read.time);
    EXPECT_TRUE(same_points_and_cells(read.mesh, at(times[i])));
    EXPECT_EQ(values(field(read.mesh, "vorticity")->values),
              values(field(at(times[i]), "vorticity")->values));
  }
}

TEST_F(StreetFiles, SayTheRangeOfAFieldOverAllSteps) {
  write_steps();
  std::array<double, 2> all{1e9, -1e9};
  for (const double time : times) {
    const auto one = range(*field(at(time), "vorticity"));
    all = {std::min(all[0], one[0]), std::max(all[1], one[1])};
  }
  for (const std::string name : {"street.pvd", "street_*.vts"}) {
    const TimeSeries series(path(name).string());
    const auto found = series.range("vorticity", Association::point);
    ASSERT_TRUE(found) << name;
    EXPECT_FLOAT_EQ(static_cast<float>((*found)[0]), static_cast<float>(all[0]));
    EXPECT_FLOAT_EQ(static_cast<float>((*found)[1]), static_cast<float>(all[1]));
    EXPECT_FALSE(series.range("vorticity", Association::cell));
    EXPECT_FALSE(series.range("pressure", Association::point));
  }
  // A legacy file's header does not say it, so nobody knows that of all.
  write_mesh(at(0), path("street_11.vtk"));
  EXPECT_FALSE(TimeSeries(path("street_*.vt?").string()).range("vorticity", Association::point));
}

// VTK's reader of legacy files says that the time is 0, whatever it is.
TEST_F(StreetFiles, MaySayTheirTime) {
  const std::string file =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "FIELD FieldData 1\nTimeValue 1 1 double\n2.5\n"
      "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"
      "POINT_DATA 4\nSCALARS s float\nLOOKUP_TABLE default\n1 2 3 4\n";
  TimeSeries series(write("one.vtk", file).string());
  EXPECT_EQ(series.size(), 1u);
  EXPECT_FALSE(series.time(0));
  EXPECT_EQ(series.read(0).time, 2.5);
}

}  // namespace
}  // namespace plume::test
