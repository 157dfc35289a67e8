# Compiler settings of the whole tree, and the three functions that make its targets.

# Reproducible floating point on every x86-64: no -march=native, no fused multiply-add, no fast-math.
# -frounding-math: CGAL's interval arithmetic changes the rounding mode.
add_compile_options(-ffp-contract=off -frounding-math)
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-maybe-uninitialized)  # false alarms inside inlined library code at -O2
endif()
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

if(BALLFLOW_SANITIZE)
  add_compile_options(-fsanitize=${BALLFLOW_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${BALLFLOW_SANITIZE})
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

set(BALLFLOW_PLUGIN_DIR ${CMAKE_BINARY_DIR}/lib/ballflow)

# ballflow_node_family(family LIBRARIES ... EXCEPT file.cpp ...): the calling folder is a family of nodes.
#
# ballflow_geometry_<family>: every *.cpp that is no adapter and not excepted, a static library that sees nodes/ and no engine.
# ballflow_node_<family>: the adapters *.node.cpp and plugin.cpp, a plugin in lib/ballflow/<family>.so.
function(ballflow_node_family family)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;EXCEPT" ${ARGN})
  file(GLOB algorithms CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB adapters CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.node.cpp ${CMAKE_CURRENT_SOURCE_DIR}/plugin.cpp)
  foreach(file IN LISTS ARG_EXCEPT)
    list(REMOVE_ITEM algorithms ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  if(adapters)
    list(REMOVE_ITEM algorithms ${adapters})
  endif()
  if(NOT algorithms)
    return()
  endif()
  set(geometry ballflow_geometry_${family})
  add_library(${geometry} STATIC ${algorithms})
  target_include_directories(${geometry} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/nodes>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/ballflow/geometry>)
  target_link_libraries(${geometry} PUBLIC ${ARG_LIBRARIES})
  set_target_properties(${geometry} PROPERTIES EXPORT_NAME geometry_${family})
  set_property(GLOBAL APPEND PROPERTY BALLFLOW_GEOMETRY_TARGETS ${geometry})
  if(adapters)
    set(plugin ballflow_node_${family})
    add_library(${plugin} MODULE ${adapters})
    target_link_libraries(${plugin} PRIVATE ${geometry} ballflow_artifact_types)
    set_target_properties(${plugin} PROPERTIES PREFIX "" OUTPUT_NAME ${family}
      LIBRARY_OUTPUT_DIRECTORY ${BALLFLOW_PLUGIN_DIR})
    target_link_options(${plugin} PRIVATE -Wl,--no-undefined)
    set_property(GLOBAL APPEND PROPERTY BALLFLOW_PLUGIN_TARGETS ${plugin})
  endif()
endfunction()

# ballflow_test(name LIBRARIES ...): one executable of every *.cpp in the calling folder; each TEST is a
# ctest test of its own.
function(ballflow_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "LIBRARIES;LABELS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    return()
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(BALLFLOW_SANITIZE)
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")  # sanitizers slow the algorithms down by 3 to 10
  endif()
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} ballflow_test_support GTest::gtest_main)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    TEST_PREFIX "${name}: " PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}")
endfunction()

# ballflow_fuzzer(name source LIBRARIES ...): a program of libFuzzer, with clang and -DBALLFLOW_FUZZERS=ON only.
function(ballflow_fuzzer name source)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  if(NOT BALLFLOW_FUZZERS)
    return()
  endif()
  add_executable(${name} ${source})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  add_dependencies(ballflow_fuzzers ${name})
endfunction()
