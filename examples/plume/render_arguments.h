/// What `plume render` is told.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"

namespace plume::command {

struct RenderArguments {
  std::string mesh, solution, output = "picture.png", field, association, size = "1024x768";
  std::string view = "iso", camera, transfer_function, transfer_range, mode = "volume";
  std::string integrator, order, cell_data = "constant", background = "white", stats;
  std::string interval_form = "exponential";
  std::string interval_way = "split";
  std::vector<std::string> channels, isosurfaces, intervals, lights, clip_planes, surfaces, walls;
  std::vector<std::string> others;  // --with
  std::string material, clip_box, time, gray_range, overlap = "add";
  double azimuth = 0, elevation = 0, zoom = 1, opacity_scale = 1, view_angle = 0;
  double unit_distance = 0;
  std::optional<double> early_termination, tolerance;
  int orbit = 0, samples = 1, threads = 0, bits = 8;
  bool compact = false, no_volume = false, parallel = false, merge_points = false, quiet = false,
       verbose = false;
  bool no_read_ahead = false;
};

/// Names on the command line and what they stand for.
inline const std::vector<std::pair<std::string, IntegratorKind>> kIntegrators{
    {"closed-form", IntegratorKind::closed_form},
    {"table", IntegratorKind::table},
    {"table2", IntegratorKind::second_order_table},
    {"midpoint", IntegratorKind::midpoint},
    {"reference", IntegratorKind::reference}};
inline const std::vector<std::pair<std::string, CellData>> kCellData{
    {"constant", CellData::constant}, {"averaged", CellData::averaged}};
inline const std::vector<std::pair<std::string, IntervalForm>> kIntervalForms{
    {"exponential", IntervalForm::exponential}, {"linear", IntervalForm::linear}};
inline const std::vector<std::pair<std::string, IntervalWay>> kIntervalWays{
    {"split", IntervalWay::split}, {"table", IntervalWay::table}};
inline const std::vector<std::pair<std::string, Overlap>> kOverlaps{
    {"add", Overlap::add}, {"first", Overlap::first}, {"refuse", Overlap::refuse}};
inline const std::vector<std::pair<std::string, ScalarOrder>> kOrders{
    {"1", ScalarOrder::linear},
    {"2", ScalarOrder::quadratic},
    {"3", ScalarOrder::cubic},
    {"adaptive", ScalarOrder::adaptive}};

template <class T>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, T>>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return names;
}

template <class T>
T chosen(const std::vector<std::pair<std::string, T>>& choices, const std::string& name) {
  for (const auto& choice : choices)
    if (choice.first == name) return choice.second;
  return choices.front().second;  // CLI11 has checked the name
}

inline bool asks_for(const std::vector<std::string>& channels, const char* name) {
  return std::find(channels.begin(), channels.end(), name) != channels.end();
}

Mode mode_named(const std::string& name);

/// Parts of these options that other commands have as well: which mesh and which field of it; from
/// where it is seen; by which colours. They are written to `args`, which must outlive the command.
void add_mesh_options(CLI::App& command, RenderArguments& args);
void add_camera_options(CLI::App& command, RenderArguments& args);
void add_color_options(CLI::App& command, RenderArguments& args);

/// Adds all options to the command; they are written to `args`, which must outlive it.
void add_render_options(CLI::App& command, RenderArguments& args);

}  // namespace plume::command
