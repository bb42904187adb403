# How everything here is compiled: C++20, warnings and sanitizers, and the functions that folders call.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

option(MENINAS_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
set(MENINAS_SANITIZE "" CACHE STRING "Sanitizers to compile with, as for -fsanitize= (e.g. address,undefined)")

# Release objects carry no paths, so checkouts in different folders can share them.
# Debug information names its folder, and a debugger must not be sent to another checkout.
find_program(MENINAS_CCACHE ccache)
if(PROJECT_IS_TOP_LEVEL AND MENINAS_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${MENINAS_CCACHE})
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    set(CMAKE_CXX_COMPILER_LAUNCHER
      env CCACHE_NOHASHDIR=1 "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_SLOPPINESS=pch_defines,time_macros ${MENINAS_CCACHE})
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess) # ccache asks for it where headers are precompiled
  endif()
endif()

# Contracted multiply-adds would give different bits on different processors.
# Square roots need not set errno, nor selections between lanes be branches: what is computed stays the same.
add_compile_options(-ffp-contract=off -fno-math-errno -fno-trapping-math)
if(MENINAS_SANITIZE)
  add_compile_options(-fsanitize=${MENINAS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${MENINAS_SANITIZE})
  # GCC cannot follow initialisation through the instrumented code and warns about the standard library itself.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
if(MENINAS_SANITIZE MATCHES thread)
  # Every program is linked with it; that it is there by then, the first library sees to (CMakeLists.txt).
  add_library(meninas_tsan_tasks OBJECT ${CMAKE_CURRENT_LIST_DIR}/../tests/support/tsan_tasks.cpp)
  add_link_options($<TARGET_OBJECTS:meninas_tsan_tasks>)
endif()

add_library(meninas_options INTERFACE)
target_compile_options(meninas_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${MENINAS_WARNINGS_AS_ERRORS}>:-Werror>)
# The compiler collects no garbage below 1.5 GB, more than any source needs: 4 to 8 % of its time, for a quarter more memory.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(meninas_options INTERFACE "SHELL:--param ggc-min-expand=400" "SHELL:--param ggc-min-heapsize=1500000")
endif()
# The standard library checks its preconditions wherever speed is not the point.
target_compile_definitions(meninas_options INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

# Headers that most sources read are compiled once for all libraries, and once more for those that only read and write (-O1).
# nlohmann/json.hpp is not among them: it instantiates templates by itself, which costs every source 0.6 s.
set(MENINAS_COMMON_HEADERS <glm/glm.hpp> <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <numeric>
  <optional> <set> <span> <string> <string_view> <unordered_map> <utility> <vector> <fmt/format.h> <fmt/ranges.h>
  <tbb/enumerable_thread_specific.h> <tbb/parallel_for.h>)

# A release reads the headers of a chapter once: the sources of one folder are compiled as one. Where single sources change all day,
# -DMENINAS_UNITY_BUILD=OFF compiles each by itself, as the presets with debug information do.
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  option(MENINAS_UNITY_BUILD "Compile the sources of one folder as one" OFF)
else()
  option(MENINAS_UNITY_BUILD "Compile the sources of one folder as one" ON)
endif()

# meninas_chapters(meninas_scenes): the sources of each folder of that library are compiled as one, and those of folders that stand
# one behind the other in its list together while they are at most 40: most of a source's time goes into what another has read as well.
function(meninas_chapters target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MENINAS_UNITY_BUILD} UNITY_BUILD_MODE GROUP)
  # The file of a chapter names its sources by whole paths, which messages and packages should not know.
  target_compile_options(${target} PRIVATE "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH chapter)
    string(REPLACE "/" "_" chapter "chapter_${chapter}")
    list(APPEND chapters ${chapter})
    list(APPEND sources_of_${chapter} ${source})
  endforeach()
  list(REMOVE_DUPLICATES chapters)
  set(together 0)
  foreach(chapter IN LISTS chapters)
    list(LENGTH sources_of_${chapter} length)
    math(EXPR together "${together} + ${length}")
    if(together EQUAL length OR together GREATER 40)
      set(group ${chapter})
      set(together ${length})
    endif()
    set_property(SOURCE ${sources_of_${chapter}} PROPERTY UNITY_GROUP ${group})
  endforeach()
endfunction()

# Nothing but the precompiled headers: meninas_headers, meninas_headers_quick. A library needs a source, if an empty one.
function(meninas_precompile name)
  file(CONFIGURE OUTPUT headers.cpp CONTENT "// no code: ProjectOptions.cmake\n")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/headers.cpp)
  target_link_libraries(${name} PRIVATE meninas_options glm::glm fmt::fmt TBB::tbb)
  target_precompile_headers(${name} PRIVATE ${MENINAS_COMMON_HEADERS})
  target_compile_options(${name} PRIVATE ${ARGN})
endfunction()

set(MENINAS_HEADERS meninas_headers) # whose precompiled headers the libraries of a folder read

# meninas_quick_chapters(meninas_scenes gltf report): no ray is traced in these folders of the library,
# and the compiler's time is worth more than the program's: -O1. To be called after the library is linked to others.
function(meninas_quick_chapters target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH chapter)
    if(chapter IN_LIST ARGN)
      list(APPEND quick ${source})
    endif()
  endforeach()
  list(REMOVE_ITEM sources ${quick})
  add_library(${target}_quick OBJECT ${quick})
  set_target_properties(${target} PROPERTIES SOURCES "${sources}")
  meninas_chapters(${target})
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_quick>)
  get_target_property(includes ${target} INCLUDE_DIRECTORIES)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  target_include_directories(${target}_quick PRIVATE ${includes})
  target_compile_features(${target}_quick PRIVATE cxx_std_20)
  target_compile_options(${target}_quick PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(${target}_quick PRIVATE ${libraries})
  target_precompile_headers(${target}_quick REUSE_FROM meninas_headers_quick)
  meninas_chapters(${target}_quick)
endfunction()

# meninas_library(scenes a.cpp b.cpp): the library of one folder; includes are written from the project's root.
function(meninas_library folder)
  add_library(meninas_${folder} STATIC ${ARGN})
  add_library(meninas::${folder} ALIAS meninas_${folder})
  target_include_directories(meninas_${folder} PUBLIC ${PROJECT_SOURCE_DIR})
  target_compile_features(meninas_${folder} PUBLIC cxx_std_20)
  target_link_libraries(meninas_${folder} PRIVATE meninas_options fmt::fmt TBB::tbb) # the last two: for the precompiled headers
  target_precompile_headers(meninas_${folder} REUSE_FROM ${MENINAS_HEADERS})
  meninas_chapters(meninas_${folder})
endfunction()

# meninas_module(decoder a.cpp b.cpp): meninas_decoder.so, which the program opens where it is first used (image/module_file.h).
function(meninas_module name)
  add_library(meninas_${name} MODULE ${ARGN})
  target_include_directories(meninas_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(meninas_${name} PRIVATE meninas_options)
  set_target_properties(meninas_${name} PROPERTIES
    PREFIX ""
    CXX_VISIBILITY_PRESET hidden
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/meninas)
  install(TARGETS meninas_${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/meninas COMPONENT program)
endfunction()

# meninas_tests(scenes a_test.cpp): the tests of one folder, one executable, found by CTest one by one.
function(meninas_tests folder)
  add_executable(${folder}_tests ${ARGN})
  target_link_libraries(${folder}_tests PRIVATE meninas_options meninas_test_support GTest::gmock GTest::gtest_main)
  target_precompile_headers(${folder}_tests PRIVATE
    <glm/glm.hpp> <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string> <string_view> <vector> <gmock/gmock.h> <gtest/gtest.h>)
  # ctest -L physics: closed forms and invariants; -L pictures: whatever renders; -L quick: the rest.
  set(label quick)
  if(folder STREQUAL physics)
    set(label physics)
  elseif(folder MATCHES "raytrace|reference|regression|cli")
    set(label pictures)
  endif()
  gtest_discover_tests(${folder}_tests TEST_PREFIX ${folder}. DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label})
endfunction()
