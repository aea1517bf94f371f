# What `cmake --install` puts where, by component (docs/embedding.md says what is promised):
#
#   core  headers and static libraries without VTK: plume::core
#   io    files in and out, with VTK, libpng and OpenEXR: plume::io
#   c     the C interface, one shared library that needs nothing of ours: plume::c
#   vtk   VTK's classes, a mapper and an image filter, with what VTK draws with: plume::vtk
#
# and the `plume` command. Nothing installed names a place of the build or of the installation.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(PLUME_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/plume)
set(PLUME_INSTALL_PKGCONFIGDIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

function(plume_install name component headers)
  set_target_properties(plume_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(plume_${name} PUBLIC cxx_std_20)
  install(TARGETS plume_${name} EXPORT plume-${component})
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plume/${name})
  list(TRANSFORM headers PREPEND ${name}/)
  set_property(GLOBAL APPEND PROPERTY PLUME_PUBLIC_HEADERS ${headers})
endfunction()

# The linker's options for VTK's libraries, for those who link to what is installed by pkg-config.
function(plume_link_options variable)
  set(link "")
  foreach(library ${ARGN})
    get_target_property(file ${library} LOCATION)
    if(file MATCHES "/lib([^/]*)[.](so|a)[^/]*$")
      string(APPEND link " -l${CMAKE_MATCH_1}")
    endif()
  endforeach()
  set(${variable} ${link} PARENT_SCOPE)
endfunction()

# Once all folders are there.
function(plume_install_package)
  add_library(plume_core INTERFACE)
  add_library(plume::core ALIAS plume_core)
  target_link_libraries(plume_core INTERFACE plume_lib)
  set_target_properties(plume_core PROPERTIES EXPORT_NAME core)
  install(TARGETS plume_core EXPORT plume-core)
  install(TARGETS plume)
  set(components core io c)
  set(packages plume plume-io plume-c)
  if(TARGET plume_vtk)
    list(APPEND components vtk)
    list(APPEND packages plume-vtk)
  endif()
  foreach(component ${components})
    install(EXPORT plume-${component} NAMESPACE plume:: DESTINATION ${PLUME_INSTALL_CMAKEDIR})
  endforeach()

  configure_package_config_file(cmake/plume-config.cmake.in plume-config.cmake
                                INSTALL_DESTINATION ${PLUME_INSTALL_CMAKEDIR})
  # Before 1.0 a minor version may change anything.
  write_basic_package_version_file(plume-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/plume-config.cmake
                ${PROJECT_BINARY_DIR}/plume-config-version.cmake
          DESTINATION ${PLUME_INSTALL_CMAKEDIR})

  file(RELATIVE_PATH up /prefix/${PLUME_INSTALL_PKGCONFIGDIR} /prefix)
  foreach(package ${packages})
    configure_file(cmake/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${PLUME_INSTALL_PKGCONFIGDIR})
  endforeach()
endfunction()
