# The Debian package: `tools/package deb`, or cpack in the build folder. It holds what `cmake --install` puts under
# /usr, finished by debian/finish.cmake.
set(BALLFLOW_PACKAGE_CONTACT "ballflow maintainers <maintainers@ballflow.invalid>" CACHE STRING
  "Whom the Debian package names as its maintainer: set it to your own name before you hand packages on")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ballflow)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${BALLFLOW_PACKAGE_CONTACT})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_BALLFLOW_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian/finish.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "dataflow engine for unions of balls")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Pipelines of typed nodes are read from JSON files and run in parallel, and
every intermediate result is cached by its content. Nodes compute with
unions of balls: polar balls of a scan, a small set of them with a proven
bound, stable medial axes, Minkowski sums, closed surfaces, collision
spheres of robots.
.
The package has the program, its node libraries and graphs, the Python
module, and what is needed to build node libraries and programs of one's
own.")
# dpkg-shlibdeps looks at every ELF file of the package, so at node libraries, too, which the program opens by itself.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Embree is opened when a picture is drawn, libcurl when an upstream is on a server; nothing in the files says so.
set(opened libembree3.so.3=libembree3-3 libcurl.so.4=libcurl4)
foreach(pair IN LISTS opened)
  string(REPLACE "=" ";" pair ${pair})
  list(GET pair 0 file)
  list(GET pair 1 package)
  file(GLOB file /usr/lib/*/${file})
  execute_process(COMMAND dpkg-query --search ${file} OUTPUT_VARIABLE owner ERROR_QUIET)
  if(owner MATCHES "^([^:, ]+)")
    set(package ${CMAKE_MATCH_1})
  endif()
  list(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ${package})
endforeach()
list(JOIN CPACK_DEBIAN_PACKAGE_DEPENDS ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
# The Python package and nodes in Python want it; the program does not.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-numpy)
if(TARGET ballflow_python)
  set(CPACK_BALLFLOW_PYTHON ${BALLFLOW_PYTHON_DIR}/ballflow)
endif()
# For who builds against the headers and static libraries.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "python3, cmake, g++, nlohmann-json3-dev, libtbb-dev, libcgal-dev, libboost-dev, libssl-dev, libzstd-dev, zlib1g-dev")
include(CPack)
