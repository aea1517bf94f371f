#include "plume/io/write_pvd.h"

#include <fmt/format.h>

#include "plume/io/whole_file.h"

namespace plume {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace

void write_pvd(const std::vector<PvdEntry>& entries, const std::filesystem::path& file) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const PvdEntry& entry : entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time,
                        escaped(entry.file));
  text += "</Collection>\n</VTKFile>\n";
  write_whole_file(file, text);
}

}  // namespace plume
