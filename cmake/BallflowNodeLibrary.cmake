# ballflow_node_library(name SOURCES file.cpp ... [TESTS file_test.cpp ...] [GRAPHS graph.json ...])
#
# For node libraries outside of ballflow's repository. Makes the node library <name>.so. Each file of TESTS becomes a
# program and a test that passes when it returns 0; each graph becomes a test that runs it with the library.
macro(ballflow_node_library)
  enable_testing()  # sets a variable of the caller, which is why this is no function
  ballflow_make_node_library(${ARGV})
endmacro()

function(ballflow_make_node_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;TESTS;GRAPHS" ${ARGN})
  if(NOT ARG_SOURCES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "ballflow_node_library(name SOURCES file.cpp ... [TESTS ...] [GRAPHS ...])")
  endif()
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_options(${name} PRIVATE -Wl,--no-undefined)
  set_target_properties(${name} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden)
  set(programs)
  foreach(test IN LISTS ARG_TESTS)
    get_filename_component(stem ${test} NAME_WE)
    add_executable(${stem} ${test})
    add_test(NAME ${stem} COMMAND ${stem})
    list(APPEND programs ${stem})
  endforeach()
  foreach(target IN ITEMS ${name} ${programs})
    # As in ballflow itself: the same bytes on every machine.
    target_compile_options(${target} PRIVATE -ffp-contract=off -frounding-math)
    target_compile_features(${target} PRIVATE cxx_std_20)
    target_link_libraries(${target} PRIVATE ballflow::artifact_types)
  endforeach()
  foreach(graph IN LISTS ARG_GRAPHS)
    add_test(NAME ${graph} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
      COMMAND ${BALLFLOW_PROGRAM} --plugin $<TARGET_FILE:${name}> run --no-cache ${graph})
  endforeach()
endfunction()
