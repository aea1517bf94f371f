# What is in tests/bench.
# Benchmarks: ./dev bench. The walkers that are compared are tested too.
find_package(benchmark REQUIRED)
add_library(plume_bench_walkers STATIC
  bench/agreement.cpp
  bench/bench_meshes.cpp
  bench/bench_views.cpp
  bench/bench_walkers.cpp
  bench/interleaved.cpp
  bench/measured_on.cpp
  bench/packet_walker.cpp
  bench/passage_consumers.cpp
  bench/plucker_passages.cpp
  bench/plucker_walker.cpp
  bench/segment_lanes.cpp
  bench/trilinear_field.cpp)
plume_flags(plume_bench_walkers)
target_compile_definitions(plume_bench_walkers PRIVATE PLUME_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
target_link_libraries(plume_bench_walkers PUBLIC plume_lib plume_io plume_datasets PRIVATE fmt::fmt)
add_executable(plume_bench
  bench/build_bench.cpp
  bench/cells_bench.cpp
  bench/counted_memory.cpp
  bench/plume_bench.cpp
  bench/regular_bench.cpp
  bench/result_table.cpp
  bench/root_finding_bench.cpp
  bench/walker_bench.cpp)
plume_flags(plume_bench)
target_link_libraries(plume_bench PRIVATE plume_bench_walkers benchmark::benchmark fmt::fmt)
plume_test(bench
  SOURCES borrowed_arrays_test.cpp build_memory_test.cpp counted_memory.cpp grid_walkers_test.cpp
          peers_test.cpp plucker_walker_test.cpp scaling/power_law.cpp scaling/power_law_test.cpp
          segment_lanes_test.cpp
  LINK plume_bench_walkers plume_peer_ways TBB::tbb)

# Every integrator's error and time: docs/integrators.md.
add_executable(plume_integrator_bench
  bench/integrator_bench.cpp
  bench/integrator_costs.cpp
  bench/integrator_errors.cpp
  bench/second_order_errors.cpp)
plume_flags(plume_integrator_bench)
target_link_libraries(plume_integrator_bench PRIVATE plume_bench_walkers plume_reference fmt::fmt)
add_test(NAME "bench: the table of integrators is made"
         COMMAND plume_integrator_bench --segments=140 --rounds=1 --quick)
set_tests_properties("bench: the table of integrators is made" PROPERTIES
                     FAIL_REGULAR_EXPRESSION "[ |]-?nan[ |,];[ |]-?inf[ |,]")

# Whole frames. VTK is compiled in one file.
add_library(plume_vtk_frames STATIC bench/vtk_frames.cpp)
plume_flags(plume_vtk_frames)
target_link_libraries(plume_vtk_frames PUBLIC plume_lib plume_io
                      PRIVATE VTK::RenderingCore VTK::RenderingVolume)
add_executable(plume_frame_bench
  bench/frame_bench.cpp
  bench/frame_scenes.cpp
  bench/hexahedra_frames.cpp
  bench/empty_space_frames.cpp
  bench/empty_cells_frames.cpp
  bench/hierarchy_frames.cpp
  bench/interval_frames.cpp
  bench/mode_frames.cpp
  bench/order_frames.cpp
  bench/peer_frames.cpp
  bench/scalar_error.cpp
  bench/thread_scaling.cpp
  bench/tolerance_frames.cpp)
plume_flags(plume_frame_bench)
target_link_libraries(plume_frame_bench PRIVATE plume_bench_walkers plume_isoparametric_reference
  plume_vtk_frames fmt::fmt)
add_test(NAME "bench: the frames compared with VTK's are of the same thing"
         COMMAND plume_frame_bench --peers --size=48 --rounds=1)
add_test(NAME "bench: modes by packets are the twin's"
         COMMAND plume_frame_bench --modes --size=32 --rounds=1)
add_test(NAME "bench: frames of hexahedra are of the same thing as of tetrahedra, and nearer by order"
         COMMAND plume_frame_bench --hexahedra --size=32 --rounds=1)
add_test(NAME "bench: what passes over empty space sees what a walk through it sees"
         COMMAND plume_frame_bench --empty-space --size=64 --cells=24 --rounds=1)
add_test(NAME "bench: isosurfaces through the hierarchy are those that are walked to"
         COMMAND plume_frame_bench --hierarchy --size=64 --cells=12 --rounds=1)
add_test(NAME "bench: intervals, isosurfaces and light by packets are of the same thing as ray by ray"
         COMMAND plume_frame_bench --intervals --size=48 --rounds=1)
add_test(NAME "bench: walkers of hexahedra and of other cells do the same work"
         COMMAND plume_bench --resolution=32 --rounds=1 --table
                 "--benchmark_filter=^hexahedra/twisted|^cells/")

# Plume beside other renderers on the same rays: docs/evidence.md. A file for each of them.
add_library(plume_peer_ways STATIC
  bench/embree_locator.cpp
  bench/fixed_step.cpp
  bench/peer_scene.cpp
  bench/peer_table.cpp
  bench/ray_cast_ways.cpp
  bench/voxel_samples.cpp
  bench/vtk_locator.cpp
  bench/vtk_z_sweep.cpp)
plume_flags(plume_peer_ways)
target_link_libraries(plume_peer_ways PUBLIC plume_bench_walkers embree
                      PRIVATE plume_vtk_frames VTK::CommonDataModel VTK::FiltersGeneral
                              VTK::RenderingCore VTK::RenderingVolume TBB::tbb fmt::fmt)
find_package(X11)
if(TARGET VTK::RenderingVolumeOpenGL2 AND TARGET X11::X11)
  target_sources(plume_peer_ways PRIVATE bench/vtk_projected_tetrahedra.cpp bench/x_display.cpp)
  target_compile_definitions(plume_peer_ways PUBLIC PLUME_WITH_VTK_OPENGL)
  target_link_libraries(plume_peer_ways PRIVATE VTK::RenderingOpenGL2 VTK::RenderingVolumeOpenGL2
                                                X11::X11)
else()
  message(WARNING "VTK's OpenGL or libX11 is not installed (Debian: libvtk9-dev, libx11-dev): VTK's "
                  "projected tetrahedra are NOT compared with.")
endif()
# Written against their documentation and sources; Debian 12 has no packages, so that the suite does
# not build them.
find_package(openvkl 2 QUIET)
if(openvkl_FOUND)
  target_sources(plume_peer_ways PRIVATE bench/openvkl_samples.cpp)
  target_compile_definitions(plume_peer_ways PUBLIC PLUME_WITH_OPENVKL)
  target_link_libraries(plume_peer_ways PRIVATE openvkl::openvkl openvkl::openvkl_module_cpu_device)
else()
  message(STATUS "Open VKL 2 is not installed: its samples are not compared with.")
endif()
find_package(Viskores QUIET)
if(TARGET viskores::rendering)
  target_sources(plume_peer_ways PRIVATE bench/viskores_walk.cpp)
  target_compile_definitions(plume_peer_ways PUBLIC PLUME_WITH_VISKORES)
  target_link_libraries(plume_peer_ways PRIVATE viskores::rendering)
else()
  message(STATUS "Viskores is not installed: its walk is not compared with.")
endif()
add_executable(plume_peers
  bench/frame_scenes.cpp
  bench/plume_peers.cpp
  ../examples/plume/console.cpp
  ../examples/plume/parse.cpp
  ../examples/plume/render_choices.cpp
  ../examples/plume/surface_options.cpp)
plume_flags(plume_peers)
target_link_libraries(plume_peers PRIVATE plume_peer_ways CLI11::CLI11 fmt::fmt)
add_test(NAME "bench: peers are compared with"
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/bench/peers_test.sh $<TARGET_FILE:plume>
                 $<TARGET_FILE:plume_peers>)
find_program(PLUME_XVFB_RUN xvfb-run)
if(PLUME_XVFB_RUN AND TARGET X11::X11)
  add_test(NAME "bench: projected tetrahedra on a screen of their own"
           COMMAND ${PLUME_XVFB_RUN} -a $<TARGET_FILE:test_bench> --gtest_filter=Peers.projected*)
  set_tests_properties("bench: projected tetrahedra on a screen of their own" PROPERTIES
                       FAIL_REGULAR_EXPRESSION "NOT tested")
else()
  message(WARNING "xvfb is not installed (Debian: xvfb, xauth): VTK's projected tetrahedra are NOT "
                  "tested without a display.")
endif()

# What the papers report, beside ours: docs/papers.md.
add_executable(plume_papers
  bench/frame_scenes.cpp
  bench/papers/el_hajjar.cpp
  bench/papers/frame_rates.cpp
  bench/papers/intervals_table.cpp
  bench/papers/naive_plucker.cpp
  bench/papers/paper_tables.cpp
  bench/papers/plume_papers.cpp
  bench/papers/stand_in_fields.cpp
  bench/papers/thesis_cells.cpp
  bench/papers/thesis_frames.cpp
  bench/papers/thesis_meshes.cpp
  bench/papers/thesis_walks.cpp)
plume_flags(plume_papers)
target_link_libraries(plume_papers PRIVATE plume_bench_walkers fmt::fmt)
add_test(NAME "bench: the papers' tables are made" COMMAND plume_papers all --quick)
set_tests_properties("bench: the papers' tables are made" PROPERTIES
                     FAIL_REGULAR_EXPRESSION "[ |]-?nan[ |,];[ |]-?inf[ |,]")

# How cost grows: docs/scaling.md.
add_executable(plume_scaling
  bench/counted_memory.cpp
  bench/frame_scenes.cpp
  bench/scaling/plume_scaling.cpp
  bench/scaling/power_law.cpp
  bench/scaling/scale_cells.cpp
  bench/scaling/scale_depth.cpp
  bench/scaling/scale_pictures.cpp
  bench/scaling/scaling_frames.cpp
  bench/scaling/scaling_series.cpp)
plume_flags(plume_scaling)
target_link_libraries(plume_scaling PRIVATE plume_bench_walkers TBB::tbb fmt::fmt)
add_test(NAME "bench: cost against all that it grows with is measured" COMMAND plume_scaling all --quick)
set_tests_properties("bench: cost against all that it grows with is measured" PROPERTIES
                     FAIL_REGULAR_EXPRESSION "[ |]-?nan[ |,];[ |]-?inf[ |,]")

# A curvilinear grid as a file of tetrahedra: what tests/charts.sh measures besides the grid.
add_executable(plume_cut_grid bench/cut_grid.cpp)
plume_flags(plume_cut_grid)
target_link_libraries(plume_cut_grid PRIVATE plume_bench_walkers)
# All charts of the documentation anew, which takes a while: docs/choosing.md.
add_custom_target(plume_charts
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/charts.sh ${PROJECT_SOURCE_DIR}/docs/charts ${CMAKE_BINARY_DIR}
  DEPENDS plume plume_cut_grid $<TARGET_NAME_IF_EXISTS:plume_peers> VERBATIM USES_TERMINAL)
