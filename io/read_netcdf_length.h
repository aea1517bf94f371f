/// The libraries below VTK read a truncated netCDF file as zeros where it is missing, and print
/// what they think of a truncated HDF5 file. So its length is checked before they see it.
#pragma once

#include <filesystem>

namespace plume {

/// Throws Error unless the netCDF (classic, 64-bit offset, 64-bit data) or HDF5 file is as long as
/// its own header says; nothing is asked of other files. Format: the NetCDF Users' Guide, "File
/// Format Specifications"; the HDF5 File Format Specification, "Format Superblock".
void check_netcdf_or_hdf5_length(const std::filesystem::path& file);

}  // namespace plume
