# plume::openimageio, which the tests read pictures with: it shares no code with what wrote them but what
# it calls itself.
#
# Debian's OpenImageIO config names tools, Python modules and OpenCV headers that its -dev package
# does not bring, and fails without them; header and libraries are all that is needed.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util)
if(OPENIMAGEIO_INCLUDE_DIR AND OPENIMAGEIO_LIBRARY AND OPENIMAGEIO_UTIL_LIBRARY
   AND NOT TARGET plume::openimageio)
  add_library(plume::openimageio INTERFACE IMPORTED)
  target_include_directories(plume::openimageio SYSTEM INTERFACE ${OPENIMAGEIO_INCLUDE_DIR})
  target_link_libraries(plume::openimageio INTERFACE ${OPENIMAGEIO_LIBRARY}
                                                     ${OPENIMAGEIO_UTIL_LIBRARY})
endif()
if(NOT TARGET plume::openimageio)
  message(FATAL_ERROR "OpenImageIO is not installed (Debian: libopenimageio-dev)")
endif()
