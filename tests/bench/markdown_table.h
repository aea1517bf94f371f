/// A table in markdown, padded so that it reads as plain text too.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace plume::bench {

/// Characters, not bytes, of a text in UTF-8.
inline std::size_t character_count(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Rows of as many cells as the first one, which is the header.
inline std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], character_count(row[i]));
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += '|';
    for (std::size_t i = 0; i < widths.size(); ++i)
      text += ' ' + rows[r][i] + std::string(widths[i] - character_count(rows[r][i]), ' ') + " |";
    text += '\n';
    if (r > 0) continue;
    text += '|';
    for (const std::size_t width : widths) text += std::string(width + 2, '-') + '|';
    text += '\n';
  }
  return text;
}

}  // namespace plume::bench
