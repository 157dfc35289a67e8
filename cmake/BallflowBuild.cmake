# Compiler settings of the whole tree, and the functions that make its targets.

# Reproducible floating point on every x86-64: no -march=native, no fused multiply-add, no fast-math.
# -frounding-math: CGAL's interval arithmetic changes the rounding mode. Installed targets hand these flags on, since
# headers compute too; ballflow_node_library() sets them by itself.
set(BALLFLOW_FLOATING_POINT -ffp-contract=off -frounding-math)
add_compile_options(${BALLFLOW_FLOATING_POINT})
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # False alarms inside inlined library code at -O2; array-bounds: std::string operator+ (GCC bug 105651).
  add_compile_options(-Wno-maybe-uninitialized -Wno-array-bounds)
endif()
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

if(BALLFLOW_SANITIZE)
  add_compile_options(-fsanitize=${BALLFLOW_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(BALLFLOW_SANITIZE MATCHES undefined)
    add_compile_options(-fno-sanitize=vptr) # CGAL 5.5 casts faces of arrangements to another type than theirs
  endif()
  add_link_options(-fsanitize=${BALLFLOW_SANITIZE})
endif()

# With CMAKE_UNITY_BUILD the files of a target are one translation unit. From nothing that takes less than half the
# time, after an edit it takes more: tools/build --together asks for it, where there is no tree yet.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-subobject-linkage)  # a name of an anonymous namespace in another file than the first
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # Without these two ccache does not look at files that use a precompiled header.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endif()

# Headers that nearly every file of an area includes are compiled once for it, a second less for each of some hundred
# files. Every file includes what it uses all the same. The first target of an area owns the result.
set(BALLFLOW_COMMON_HEADERS <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <map> <memory>
  <nlohmann/json.hpp> <optional> <set> <sstream> <string> <string_view> <unordered_map> <utility> <vector>)
set(BALLFLOW_GEOMETRY_HEADERS <CGAL/Exact_predicates_inexact_constructions_kernel.h>)
set(BALLFLOW_ALGORITHM_HEADERS <algorithm> <array> <cmath> <cstdint> <memory> <optional> <span> <string> <tbb/parallel_for.h>
  <utility> <vector>)
set(BALLFLOW_TEST_HEADERS <gtest/gtest.h> ${BALLFLOW_COMMON_HEADERS})
set(BALLFLOW_ORACLE_HEADERS ${BALLFLOW_TEST_HEADERS})
function(ballflow_precompile area target)
  get_property(owner GLOBAL PROPERTY BALLFLOW_PRECOMPILED_${area})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    target_precompile_headers(${target} PRIVATE ${BALLFLOW_${area}_HEADERS})
    set_property(GLOBAL PROPERTY BALLFLOW_PRECOMPILED_${area} ${target})
  endif()
endfunction()

set(BALLFLOW_PLUGIN_DIR ${CMAKE_BINARY_DIR}/lib/ballflow)

# The floors of the house (floors.txt): who may include whom.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/floors.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/floors.txt floors REGEX "^[a-z]")
foreach(floor IN LISTS floors)
  string(REGEX REPLACE "#.*" "" floor "${floor}")
  string(REGEX MATCH "^([a-z_/]+):(.*)$" floor "${floor}")
  separate_arguments(seen UNIX_COMMAND "${CMAKE_MATCH_2}")
  set(BALLFLOW_SEES_${CMAKE_MATCH_1} ${seen})
endforeach()

# ballflow_include_root(var name folder): a folder in which only <name> can be found, a link to `folder`. With it on
# the include path "<name>/x.hpp" is found and nothing of the folders beside it.
function(ballflow_include_root var name folder)
  string(REPLACE "/" "_" root ${folder})
  set(root ${CMAKE_BINARY_DIR}/floors/${root})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${root}/${name} SYMBOLIC)
  set(${var} ${root} PARENT_SCOPE)
endfunction()

# ballflow_engine_floor(name): the calling folder, as objects of the engine. Headers of floors below are found as
# "base/quote.hpp", public ones as "ballflow/graph.hpp".
function(ballflow_engine_floor name)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  set(floor ballflow_engine_${name})
  add_library(${floor} OBJECT ${sources})
  ballflow_precompile(COMMON ${floor})
  ballflow_include_root(root ${name} engine/src/${name})
  target_include_directories(${floor} PUBLIC ${root})
  target_link_libraries(${floor} PUBLIC ballflow_sdk nlohmann_json::nlohmann_json TBB::tbb Threads::Threads PRIVATE OpenSSL::Crypto)
  foreach(seen IN LISTS BALLFLOW_SEES_engine/${name})
    if(NOT seen STREQUAL "engine/sdk")
      string(REPLACE "engine/" "ballflow_engine_" seen ${seen})
      target_link_libraries(${floor} PUBLIC ${seen})
    endif()
  endforeach()
  target_sources(ballflow_engine PRIVATE $<TARGET_OBJECTS:${floor}>)
endfunction()

# ballflow_node_family(family LIBRARIES ...): the calling folder is a floor of nodes/.
#
# ballflow_geometry_<family>: every *.cpp that is no adapter, a library that sees what floors.txt says, and no engine.
# ballflow_node_<family>: the adapters *.node.cpp and plugin.cpp, a plugin in lib/ballflow/<family>.so.
function(ballflow_node_family family)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  file(GLOB algorithms CONFIGURE_DEPENDS *.cpp)
  file(GLOB adapters CONFIGURE_DEPENDS *.node.cpp *.type.cpp plugin.cpp)
  list(REMOVE_ITEM algorithms ${adapters})
  list(FILTER adapters EXCLUDE REGEX "\\.type\\.cpp$")
  set(geometry ballflow_geometry_${family})
  set(libraries ${ARG_LIBRARIES})
  foreach(seen IN LISTS BALLFLOW_SEES_nodes/${family})
    string(REPLACE "nodes/" "ballflow_geometry_" seen ${seen})
    list(APPEND libraries ${seen})
  endforeach()
  ballflow_include_root(root ${family} nodes/${family})
  set(visible $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/ballflow/geometry>)
  if(algorithms)
    add_library(${geometry} STATIC ${algorithms})
    target_include_directories(${geometry} PUBLIC ${visible})
    target_link_libraries(${geometry} PUBLIC ${libraries})
    # Each algorithm instantiates templates of its own, so that together they take no less time; types have none.
    if(NOT family STREQUAL "types")
      set_target_properties(${geometry} PROPERTIES UNITY_BUILD OFF)
    endif()
    if("CGAL::CGAL" IN_LIST ARG_LIBRARIES)
      ballflow_precompile(GEOMETRY ${geometry})
    else()
      ballflow_precompile(ALGORITHM ${geometry})
    endif()
  else()
    add_library(${geometry} INTERFACE)
    target_include_directories(${geometry} INTERFACE ${visible})
    target_link_libraries(${geometry} INTERFACE ${libraries})
  endif()
  target_compile_options(${geometry} INTERFACE "$<INSTALL_INTERFACE:${BALLFLOW_FLOATING_POINT}>")
  set_target_properties(${geometry} PROPERTIES EXPORT_NAME geometry_${family})
  target_link_libraries(ballflow_geometry INTERFACE ${geometry})
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

# ballflow_tool_floor(name folder LIBRARIES ... SOURCES ...): a folder of tools/ballflow as a library; the floors
# that it sees come from floors.txt, libraries of others from LIBRARIES.
function(ballflow_tool_floor name folder)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;SOURCES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${ARG_SOURCES})
  set(floor ballflow_${name})
  add_library(${floor} STATIC ${sources})
  ballflow_precompile(COMMON ${floor})
  string(REGEX REPLACE "/.*" "" top ${folder})
  ballflow_include_root(root ${top} tools/ballflow/${top})
  target_include_directories(${floor} PUBLIC ${root})
  foreach(seen IN LISTS BALLFLOW_SEES_tools/${folder})
    if(seen MATCHES "^engine/")
      target_link_libraries(${floor} PUBLIC ballflow_engine)
    elseif(seen STREQUAL "nodes/types")
      target_link_libraries(${floor} PUBLIC ballflow_artifact_types)
    elseif(seen MATCHES "^nodes/(.*)")
      target_link_libraries(${floor} PUBLIC ballflow_geometry_${CMAKE_MATCH_1})
    elseif(seen MATCHES "([a-z]+)$")
      target_link_libraries(${floor} PUBLIC ballflow_${CMAKE_MATCH_1})
    endif()
  endforeach()
  target_link_libraries(${floor} PRIVATE ${ARG_LIBRARIES})
endfunction()

# ballflow_test(name LIBRARIES ...): one executable of every *.cpp in the calling folder; each TEST is a
# ctest test of its own, but those of the suite TOGETHER, which are one: there are hundreds, and each takes less time
# than the start of a process. What is tested is optimised as always; the tests themselves are compiled in less time,
# and where they compute much, beside the algorithms, with -O1.
function(ballflow_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT;TOGETHER" "LIBRARIES;LABELS;FIXTURES" ${ARGN})
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
  # Messages of tests are full of operator+, see above.
  target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
  if("ballflow_geometry" IN_LIST ARG_LIBRARIES)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    ballflow_precompile(ORACLE ${name})
  else()
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O0>)
    ballflow_precompile(TEST ${name})
  endif()
  # A property without a value would take the next one for it.
  set(properties TIMEOUT ${ARG_TIMEOUT})
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  if(ARG_FIXTURES)
    list(APPEND properties FIXTURES_REQUIRED "${ARG_FIXTURES}")
  endif()
  set(filter)
  if(ARG_TOGETHER)
    set(filter TEST_FILTER "-${ARG_TOGETHER}.*")
    add_test(NAME "${name}: ${ARG_TOGETHER}" COMMAND ${name} --gtest_filter=${ARG_TOGETHER}.* --gtest_brief=1)
    set_tests_properties("${name}: ${ARG_TOGETHER}" PROPERTIES ${properties})
  endif()
  gtest_discover_tests(${name} ${filter} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    TEST_PREFIX "${name}: " PROPERTIES ${properties})
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
