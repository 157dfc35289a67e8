# What `cmake --install` puts where, and the package that find_package(ballflow) finds:
#
#   bin/ballflow
#   lib/ballflow/<family>.so              node libraries; the executable looks in ../lib/ballflow
#   include/ballflow/*                    the boundary, the SDK and the engine
#   include/ballflow/geometry/<family>/   options structs, functions and data types of the algorithms
#   <libdir>/libballflow_*.a, <libdir>/cmake/ballflow/
#   share/man/man1, share/bash-completion, share/zsh, share/fish
#   share/ballflow/python/ballflow/       what runs nodes that are written in Python
#   share/ballflow/graphs, share/ballflow/schemas, share/ballflow/viewer.html (where npm is)
include(CMakePackageConfigHelpers)

get_property(geometry_targets GLOBAL PROPERTY BALLFLOW_GEOMETRY_TARGETS)
get_property(plugin_targets GLOBAL PROPERTY BALLFLOW_PLUGIN_TARGETS)
get_property(viewer_target GLOBAL PROPERTY BALLFLOW_VIEWER_TARGET)
set(programs ballflow)

# Man pages and completion of shells: the program describes itself.
set(described ${CMAKE_BINARY_DIR}/described)
add_custom_command(OUTPUT ${described}/man/man1/ballflow.1
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${described}
  COMMAND ballflow __share ${described}
  DEPENDS ballflow
  COMMENT "Writing man pages and completion"
  VERBATIM)
add_custom_target(ballflow_described ALL DEPENDS ${described}/man/man1/ballflow.1)
install(DIRECTORY ${described}/ DESTINATION ${CMAKE_INSTALL_DATADIR})

# What users run, without the tests.
add_custom_target(ballflow_programs DEPENDS ${programs} ${plugin_targets} ${viewer_target} ballflow_described)

install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS ${plugin_targets} LIBRARY DESTINATION lib/ballflow)
install(TARGETS ballflow_sdk ballflow_artifact_types ballflow_engine ${geometry_targets} EXPORT ballflowTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY engine/include/ballflow DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(DIRECTORY nodes/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ballflow/geometry FILES_MATCHING PATTERN "*.hpp")
foreach(folder graphs schemas)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/ballflow)
  endif()
endforeach()

# What processes that run nodes in Python need.
foreach(file _artifact _errors _failures _node _source _source_text _worker)
  install(FILES tools/python/ballflow/${file}.py DESTINATION ${CMAKE_INSTALL_DATADIR}/ballflow/python/ballflow)
endforeach()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ballflow)
install(EXPORT ballflowTargets NAMESPACE ballflow:: DESTINATION ${package_dir})
set(program ${CMAKE_INSTALL_BINDIR}/ballflow)
configure_package_config_file(cmake/ballflowConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/cmake/ballflowConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS program)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/cmake/ballflowConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  cmake/BallflowNodeLibrary.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/cmake/ballflowConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/cmake/ballflowConfigVersion.cmake
  DESTINATION ${package_dir})
