#include "plume/io/read_fluent_case.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr int end_of_file = std::filebuf::traits_type::eof();

struct FileEnds {};

// Sections are lists in parentheses: "(13 (zone first last ...)(body))", numbers in hexadecimal but
// for the section's own.
class Sections {
 public:
  explicit Sections(const std::filesystem::path& file) {
    buffer_.open(file, std::ios::in | std::ios::binary);
  }

  struct Section {
    int index = 0;
    /// The numbers of the list that comes first in it.
    std::vector<std::uint64_t> header;
  };

  /// The next section, false at the end of the file. Throws FileEnds within one.
  bool next(Section& section) {
    int c = buffer_.sbumpc();
    while (c != end_of_file && c != '(') c = buffer_.sbumpc();
    if (c == end_of_file) return false;
    section = {};
    depth_ = 1;
    while (std::isdigit(peek())) section.index = section.index * 10 + (take() - '0');
    while (std::isspace(peek())) take();
    if (is_about_items(section.index) && peek() == '(') read_header(section.header);
    skip_rest(section.index);
    return true;
  }

  static bool is_about_items(int index) {
    const int kind = index % 1000, form = index / 1000;
    return (kind == 10 || kind == 12 || kind == 13) && (form == 0 || form == 2 || form == 3);
  }

 private:
  int peek() {
    const int c = buffer_.sgetc();
    if (c == end_of_file) throw FileEnds{};
    return c;
  }
  int take() {
    const int c = peek();
    buffer_.sbumpc();
    if (c == '(') ++depth_;
    if (c == ')') --depth_;
    return c;
  }

  void read_header(std::vector<std::uint64_t>& numbers) {
    take();
    for (std::string word; depth_ > 1;) {
      const int c = take();
      if (std::isxdigit(c)) {
        word += static_cast<char>(c);
        continue;
      }
      // Sixteen digits are more than any count has, and all that fit.
      if (!word.empty()) numbers.push_back(std::stoull(word.substr(0, 16), nullptr, 16));
      word.clear();
    }
  }

  void skip_rest(int index) {
    // The body of a binary section may have any bytes in it, parentheses too.
    if (index >= 2000) {
      const std::string mark = "End of Binary Section";
      for (std::size_t matched = 0; matched < mark.size();) {
        const int c = take();
        matched = c == mark[matched] ? matched + 1 : c == mark[0] ? 1 : 0;
      }
      depth_ = 1;
    }
    while (depth_ > 0) take();
  }

  std::filebuf buffer_;
  int depth_ = 0;
};

}  // namespace

void check_fluent_case(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    throw Error(file.string() + ": " + what +
                "; the file is truncated or no Fluent file, write it "
                "again");
  };
  constexpr std::array names{"nodes", "cells", "faces"};
  std::array<std::uint64_t, 3> declared{}, found{};
  Sections sections(file);
  Sections::Section section;
  try {
    while (sections.next(section)) {
      if (!Sections::is_about_items(section.index) || section.header.size() < 3) continue;
      const int kind = section.index % 1000;
      const std::size_t item = kind == 10 ? 0 : kind == 12 ? 1 : 2;
      const auto zone = section.header[0], first = section.header[1], last = section.header[2];
      // Zone 0 declares how many there are in all.
      if (zone == 0)
        declared[item] = last;
      else if (last >= first)
        found[item] += last - first + 1;
    }
  } catch (const FileEnds&) {
    fail("ends within section " + std::to_string(section.index));
  }
  for (std::size_t item = 0; item < names.size(); ++item) {
    if (found[item] < declared[item])
      fail("declares " + std::to_string(declared[item]) + " " + names[item] + " and holds " +
           std::to_string(found[item]));
    if (found[item] == 0) fail(std::string("holds no ") + names[item]);
  }
}

}  // namespace plume
