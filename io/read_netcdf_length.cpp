#include "plume/io/read_netcdf_length.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "plume/io/read_file.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

struct HeaderEnds {};

// Big-endian numbers of a netCDF header, one after the other.
class Header {
 public:
  Header(const std::filesystem::path& file, int version)
      : stream_(file, std::ios::binary),
        version_(version),
        size_(std::filesystem::file_size(file)) {
    stream_.seekg(4);
  }

  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = stream_.get();
      if (byte == std::ifstream::traits_type::eof()) throw HeaderEnds{};
      value = value << 8 | static_cast<std::uint64_t>(byte);
    }
    return value;
  }
  std::uint64_t count() { return number(version_ == 5 ? 8 : 4); }
  std::uint64_t offset() { return number(version_ == 1 ? 4 : 8); }
  /// Elements of a list, each of which takes at least eight bytes of the header.
  std::uint64_t list_length() {
    number(4);
    const std::uint64_t length = count();
    if (length > size_ / 8) throw HeaderEnds{};
    return length;
  }
  void skip(std::uint64_t bytes) {
    if (bytes > size_) throw HeaderEnds{};
    stream_.ignore(static_cast<std::streamsize>((bytes + 3) / 4 * 4));
  }
  void skip_name() { skip(count()); }

 private:
  std::ifstream stream_;
  int version_;
  std::uint64_t size_;
};

std::uint64_t bytes_of_type(std::uint64_t type) {
  constexpr std::uint64_t bytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  if (type < 1 || type >= std::size(bytes)) throw HeaderEnds{};
  return bytes[type];
}

void skip_attributes(Header& header) {
  const std::uint64_t count = header.list_length();
  for (std::uint64_t i = 0; i < count; ++i) {
    header.skip_name();
    const std::uint64_t bytes = bytes_of_type(header.number(4));
    header.skip(header.count() * bytes);
  }
}

struct Variable {
  std::uint64_t begin = 0;
  /// Of all values, or of one record's.
  std::uint64_t bytes = 0;
  bool has_records = false;
};

// The length that the header implies, but for padding at the end.
std::uint64_t netcdf_length(const std::filesystem::path& file, int version) {
  Header header(file, version);
  const std::uint64_t records = header.count();
  // A file that is still being written does not know its number of records.
  const bool streaming = records == (version == 5 ? ~std::uint64_t{0} : 0xffffffffu);
  std::vector<std::uint64_t> dimensions(header.list_length());
  for (auto& dimension : dimensions) {
    header.skip_name();
    dimension = header.count();
  }
  skip_attributes(header);
  std::vector<Variable> variables(header.list_length());
  std::uint64_t record_bytes = 0, record_variables = 0;
  for (Variable& variable : variables) {
    header.skip_name();
    const std::uint64_t axes = header.count();
    std::uint64_t values = 1;
    for (std::uint64_t axis = 0; axis < axes; ++axis) {
      const std::uint64_t dimension = header.count();
      if (dimension >= dimensions.size()) throw HeaderEnds{};
      // The one dimension without a length is that of the records.
      if (axis == 0 && dimensions[dimension] == 0)
        variable.has_records = true;
      else
        values *= dimensions[dimension];
    }
    skip_attributes(header);
    variable.bytes = values * bytes_of_type(header.number(4));
    header.count();
    variable.begin = header.offset();
    if (!variable.has_records) continue;
    record_bytes += (variable.bytes + 3) / 4 * 4;
    ++record_variables;
  }
  // A single record variable is not padded.
  if (record_variables == 1)
    for (const Variable& variable : variables)
      if (variable.has_records) record_bytes = variable.bytes;
  std::uint64_t length = 0;
  for (const Variable& variable : variables) {
    if (variable.has_records && (records == 0 || streaming)) continue;
    const std::uint64_t before = variable.has_records ? (records - 1) * record_bytes : 0;
    length = std::max(length, variable.begin + before + variable.bytes);
  }
  return length;
}

// Little-endian.
std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
  if (at + size > bytes.size()) throw HeaderEnds{};
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::uint64_t hdf5_length(const std::string& start) {
  const std::uint64_t version = number_at(start, 8, 1);
  // Where the addresses are, and how wide: base, another one, end of file.
  const std::size_t width = number_at(start, version >= 2 ? 9 : 13, 1);
  const std::size_t addresses = version >= 2 ? 12 : version == 1 ? 28 : 24;
  if (width != 4 && width != 8) throw HeaderEnds{};
  return number_at(start, addresses + 2 * width, width);
}

}  // namespace

void check_netcdf_or_hdf5_length(const std::filesystem::path& file) {
  const std::string start = first_bytes(file, 64);
  const std::uint64_t length = std::filesystem::file_size(file);
  std::uint64_t needed = 0;
  try {
    if (looks_like_netcdf(start)) needed = netcdf_length(file, start[3]);
    if (looks_like_hdf5(start)) needed = hdf5_length(start);
  } catch (const HeaderEnds&) {
    throw Error(file.string() + ": its header is damaged or truncated; copy it again");
  }
  if (length < needed)
    throw Error(file.string() + ": truncated: its header speaks of " + std::to_string(needed) +
                " bytes, and it has " + std::to_string(length) + "; copy it again");
}

}  // namespace plume
