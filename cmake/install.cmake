# What `cmake --install` puts where, by component (docs/embedding.md says what is promised):
#
#   core  headers and static libraries without VTK: plume::core
#   io    files in and out, with VTK and OpenImageIO: plume::io
#   c     the C interface, one shared library that needs nothing of ours: plume::c
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

# Once all folders are there.
function(plume_install_package)
  add_library(plume_core INTERFACE)
  add_library(plume::core ALIAS plume_core)
  target_link_libraries(plume_core INTERFACE plume_lib)
  set_target_properties(plume_core PROPERTIES EXPORT_NAME core)
  install(TARGETS plume_core EXPORT plume-core)
  install(TARGETS plume)
  foreach(component core io c)
    install(EXPORT plume-${component} NAMESPACE plume:: DESTINATION ${PLUME_INSTALL_CMAKEDIR})
  endforeach()

  configure_package_config_file(cmake/plume-config.cmake.in plume-config.cmake
                                INSTALL_DESTINATION ${PLUME_INSTALL_CMAKEDIR})
  # Before 1.0 a minor version may change anything.
  write_basic_package_version_file(plume-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/plume-config.cmake
                ${PROJECT_BINARY_DIR}/plume-config-version.cmake cmake/openimageio.cmake
          DESTINATION ${PLUME_INSTALL_CMAKEDIR})

  file(RELATIVE_PATH up /prefix/${PLUME_INSTALL_PKGCONFIGDIR} /prefix)
  foreach(package plume plume-io plume-c)
    configure_file(cmake/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${PLUME_INSTALL_PKGCONFIGDIR})
  endforeach()
endfunction()
