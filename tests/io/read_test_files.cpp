#include "read_test_files.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "plume/mesh/error.h"

namespace plume::test {

void FileTest::SetUp() {
  const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
  directory_ = std::filesystem::temp_directory_path() /
               (std::string("plume_") + info->test_suite_name() + "_" + info->name() + "_" +
                std::to_string(::getpid()));
  std::filesystem::remove_all(directory_);
  std::filesystem::create_directories(directory_);
}

void FileTest::TearDown() { std::filesystem::remove_all(directory_); }

std::filesystem::path FileTest::write(const std::string& name, const std::string& contents) const {
  const auto file = path(name);
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << contents;
  return file;
}

void OpenFoamCase::write_case() const {
  const auto file = [](const std::string& type, const std::string& name, const std::string& body) {
    return "FoamFile\n{\nversion 2.0;\nformat ascii;\nclass " + type + ";\nobject " + name +
           ";\n}\n" + body;
  };
  const auto mesh = [&](const std::string& name, const std::string& type, const std::string& body) {
    write("case/constant/polyMesh/" + name, file(type, name, body));
  };
  mesh("points", "vectorField",
       "16\n(\n(0 0 0)\n(0 1 0)\n(0 0 1)\n(0 1 1)\n(1 0 0)\n(1 0.5 0)\n(1 1 0)\n(1 0 1)\n"
       "(1 0.5 1)\n(1 1 1)\n(2 0 0)\n(2 0.5 0)\n(2 1 0)\n(2 0 1)\n(2 0.5 1)\n(2 1 1)\n)\n");
  mesh("faces", "faceList",
       "16\n(\n4(4 5 8 7)\n4(5 6 9 8)\n4(5 8 14 11)\n4(0 2 3 1)\n4(0 4 7 2)\n4(1 3 9 6)\n"
       "5(0 1 6 5 4)\n5(2 7 8 9 3)\n4(4 10 13 7)\n4(10 11 14 13)\n4(4 5 11 10)\n4(7 13 14 8)\n"
       "4(6 9 15 12)\n4(11 12 15 14)\n4(5 6 12 11)\n4(8 14 15 9)\n)\n");
  mesh("owner", "labelList", "16\n(\n0\n0\n1\n0\n0\n0\n0\n0\n1\n1\n1\n1\n2\n2\n2\n2\n)\n");
  mesh("neighbour", "labelList", "3\n(\n1\n2\n2\n)\n");
  mesh("boundary", "polyBoundaryMesh",
       "1\n(\nwalls\n{\ntype wall;\nnFaces 13;\nstartFace 3;\n}\n)\n");
  write("case/system/controlDict",
        file("dictionary", "controlDict",
             "startTime 0;\nendTime 1;\ndeltaT 1;\nwriteControl timeStep;\nwriteInterval 1;\n"));
  for (const std::string time : {"0", "1"})
    write("case/" + time + "/p",
          file("volScalarField", "p",
               "dimensions [0 2 -2 0 0 0 0];\ninternalField nonuniform List<scalar>\n3\n(\n1" +
                   time + "\n2" + time + "\n3" + time +
                   "\n)\n;\nboundaryField\n{\nwalls\n{\ntype zeroGradient;\n}\n}\n"));
}

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::filesystem::path dataset(const std::string& name) {
  const char* const given = std::getenv("PLUME_DATASETS");
  const std::filesystem::path directory =
      given ? std::filesystem::path(given)
            : std::filesystem::path(PLUME_SOURCE_DIR) / ".." / "shared" / "datasets";
  const auto file = directory / name;
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

std::string error_of(const std::filesystem::path& file, const ReadOptions& options) {
  try {
    read_mesh(file, options);
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << file << " was read without an error";
  return {};
}

bool Read::was_told(const std::string& part) const {
  return std::any_of(notices.begin(), notices.end(), [&](const std::string& notice) {
    return notice.find(part) != std::string::npos;
  });
}

Read read(const std::filesystem::path& file, const ReadOptions& options) {
  Read result;
  result.mesh = read_mesh(file, options,
                          [&](const std::string& notice) { result.notices.push_back(notice); });
  return result;
}

const Field* field(const Mesh& mesh, const std::string& name) {
  for (const Field& candidate : mesh.fields)
    if (candidate.name == name) return &candidate;
  ADD_FAILURE() << "no field " << name;
  return nullptr;
}

std::vector<double> values(const Array& array) {
  return array.visit([](auto span) { return std::vector<double>(span.begin(), span.end()); });
}

std::array<double, 2> range(const Field& field) {
  const auto all = values(field.values);
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  return {*low, *high};
}

double fingerprint(const Array& array) {
  double sum = 0, number = 1;
  for (const double value : values(array)) sum += value * number++;
  return sum;
}

std::string swapped(const std::string& bytes, std::size_t width, std::size_t begin) {
  std::string result = bytes;
  for (std::size_t i = begin; i + width <= bytes.size(); i += width)
    std::reverse(result.begin() + static_cast<std::ptrdiff_t>(i),
                 result.begin() + static_cast<std::ptrdiff_t>(i + width));
  return result;
}

}  // namespace plume::test
