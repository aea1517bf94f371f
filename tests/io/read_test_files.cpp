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
