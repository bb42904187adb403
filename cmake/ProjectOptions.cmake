# How everything here is compiled: C++20, warnings and sanitizers, on one interface target that the folders link privately.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(MENINAS_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
set(MENINAS_SANITIZE "" CACHE STRING "Sanitizers to compile with, as for -fsanitize= (e.g. address,undefined)")

add_library(meninas_options INTERFACE)
target_compile_options(meninas_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# Contracted multiply-adds would give different bits on different processors.
target_compile_options(meninas_options INTERFACE -ffp-contract=off)
if(MENINAS_WARNINGS_AS_ERRORS)
  target_compile_options(meninas_options INTERFACE -Werror)
endif()
if(MENINAS_SANITIZE)
  target_compile_options(meninas_options INTERFACE -fsanitize=${MENINAS_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(meninas_options INTERFACE -fsanitize=${MENINAS_SANITIZE})
endif()

# meninas_library(scenes a.cpp b.cpp): the library of one folder; includes are written from the project's root.
function(meninas_library folder)
  add_library(meninas_${folder} STATIC ${ARGN})
  add_library(meninas::${folder} ALIAS meninas_${folder})
  target_include_directories(meninas_${folder} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/meninas>)
  target_compile_features(meninas_${folder} PUBLIC cxx_std_20)
  target_link_libraries(meninas_${folder} PRIVATE $<BUILD_INTERFACE:meninas_options>)
  set_target_properties(meninas_${folder} PROPERTIES EXPORT_NAME ${folder})
endfunction()

# meninas_tests(scenes a_test.cpp): the tests of one folder, one executable, found by CTest one by one.
function(meninas_tests folder)
  add_executable(${folder}_tests ${ARGN})
  target_link_libraries(${folder}_tests PRIVATE meninas_options meninas_test_support GTest::gmock GTest::gtest_main)
  target_compile_definitions(${folder}_tests PRIVATE MENINAS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(${folder}_tests TEST_PREFIX ${folder}. DISCOVERY_TIMEOUT 60)
endfunction()
