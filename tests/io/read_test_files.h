/// Files for the tests of reading and writing meshes: made on the spot, or public data sets.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"
#include "plume/mesh/mesh.h"

namespace plume::test {

/// A test with a directory of its own, removed afterwards.
class FileTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  std::filesystem::path path(const std::string& name) const { return directory_ / name; }
  /// Writes a file and gives its path.
  std::filesystem::path write(const std::string& name, const std::string& contents) const;

 private:
  std::filesystem::path directory_;
};

/// A cube next to two half cubes, so that it has seven faces and is a polyhedron, at the times 0
/// and 1; cell i's `p` at time t is 10 (i + 1) + t.
class OpenFoamCase : public FileTest {
 protected:
  /// Into the folder "case".
  void write_case() const;
};

std::string contents_of(const std::filesystem::path& file);

/// A public data set's file; empty when it is not there, for PLUME_SKIP_WITHOUT.
std::filesystem::path dataset(const std::string& name);

#define PLUME_SKIP_WITHOUT(file)                                                        \
  if ((file).empty())                                                                   \
  GTEST_SKIP() << "SKIPPED FOR LACK OF DATA: set PLUME_DATASETS to the directory that " \
                  "holds bluntfin, combustor and formats"

/// The message of the Error that reading throws, empty (and a failure) when it throws none.
std::string error_of(const std::filesystem::path& file, const ReadOptions& options = {});

/// What read_mesh() says besides.
struct Read {
  Mesh mesh;
  std::vector<std::string> notices;

  bool was_told(const std::string& part) const;
};
Read read(const std::filesystem::path& file, const ReadOptions& options = {});

const Field* field(const Mesh& mesh, const std::string& name);
std::vector<double> values(const Array& array);
std::array<double, 2> range(const Field& field);

/// Sum of the values times their numbers, so that two meshes differ in it unless they are the same
/// in the same order.
double fingerprint(const Array& array);

/// Bytes with each group of `width` from `begin` on reversed.
std::string swapped(const std::string& bytes, std::size_t width, std::size_t begin = 0);

}  // namespace plume::test
